//! The keyboard in the switches and lists: arrows go from entry to entry, Enter takes.

use egui::{EventFilter, Id, Key, Response, Ui};

fn first_switch() -> Id {
    Id::unique("keyboard to the first switch")
}

pub(super) fn to_first(ui: &Ui) {
    ui.data_mut(|data| data.insert_temp(first_switch(), true));
}

/// True if this is the first switch and takes the keyboard.
pub(super) fn first(ui: &Ui) -> bool {
    ui.data_mut(|data| data.remove_temp::<bool>(first_switch())).unwrap_or(false)
}

/// True if a list closed since the last frame by a click on another control.
pub(super) fn closed(ui: &Ui, list: Id, open: bool) -> bool {
    let key = list.with("was open");
    let was: bool = ui.data(|data| data.get_temp(key)).unwrap_or(false);
    if was != open {
        ui.data_mut(|data| data.insert_temp(key, open));
    }
    was && !open && !ui.input(|input| input.pointer.any_click())
}

pub(super) fn step(ui: &Ui) -> isize {
    ui.input(|input| isize::from(input.key_pressed(Key::ArrowDown)) - isize::from(input.key_pressed(Key::ArrowUp)))
}

/// Prevents arrow keys from moving the focus to a neighboring control.
pub(super) fn hold(ui: &Ui, entry: &Response) {
    let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(entry.id, filter));
}

/// The entries of an open list: the one that is on has the keyboard first.
pub(super) fn within(ui: &Ui, entries: &[Response], on: usize) {
    let pass = ui.ctx().cumulative_pass_nr();
    let left = Id::unique("list that was left");
    if entries.iter().any(Response::clicked) {
        ui.data_mut(|data| data.insert_temp(left, pass));
    }
    let Some(now) = entries.iter().position(Response::has_focus) else {
        // A list in which something was chosen is drawn again before it closes.
        let closes = ui.data(|data| data.get_temp::<u64>(left)).is_some_and(|left| pass <= left + 2);
        if let Some(entry) = entries.get(on).filter(|_| !closes) {
            entry.request_focus();
        }
        return;
    };
    hold(ui, &entries[now]);
    if let Some(next) = now.checked_add_signed(step(ui)).and_then(|next| entries.get(next)).filter(|_| step(ui) != 0) {
        next.request_focus();
        next.scroll_to_me(None);
    }
}
