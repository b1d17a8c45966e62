//! Choice of the file's curves.

use egui::{Id, RichText, ScrollArea, TextEdit, Ui};

use crate::catalog::import::TAKEN_AT_FIRST;
use crate::document::imported::ImportOverrides;
use crate::figures::curves::ImportSelection;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::theme::{ROW, UNIT};
use crate::view::import::Stop;

use super::{hold, step};

const POINTER: &str = "pointer over curves taken";
const ROWS: usize = 6;
const SEARCHED: usize = 8;

pub(super) fn show(
    ui: &mut Ui,
    shown: &ImportSelection,
    overrides: &mut ImportOverrides,
    context: &mut PaneContext<'_>,
) {
    let Some(table) = shown.table().filter(|table| table.curves.len() > 1) else {
        widgets::hover_curve(ui, POINTER, false, None, context);
        return;
    };
    let count = table.curves.len();
    let mut taken = vec![false; count];
    for place in shown.taken() {
        if let Some(taken) = taken.get_mut(place) {
            *taken = true;
        }
    }
    let before = taken.clone();
    ui.add_space(UNIT);
    ui.label(format!("{} of {count} imported", before.iter().filter(|taken| **taken).count()));
    if count >= SEARCHED {
        let field = TextEdit::singleline(&mut context.view.import.search).hint_text("Search curves");
        let field = ui.add(field.desired_width(f32::INFINITY));
        widgets::labeled(&field, egui::Role::TextInput, "Search curves");
    }
    let wanted = context.view.import.search.trim().to_lowercase();
    let names = table.curves.iter().enumerate();
    let found: Vec<usize> = names
        .filter(|(_, curve)| wanted.is_empty() || curve.name.to_lowercase().contains(&wanted))
        .map(|(place, _)| place)
        .collect();
    buttons(ui, &found, &mut taken);
    let mut under = None;
    if found.is_empty() {
        widgets::note(ui, "No curve of this name.");
    }
    let pitch = ROW + ui.spacing().item_spacing.y;
    let height = pitch * found.len().min(ROWS) as f32;
    let mut area = ScrollArea::vertical().id_salt("imported curves").max_height(height).auto_shrink([false, true]);
    let wanted = wanted_row(ui, found.len(), context);
    if let Some(row) = wanted {
        area = area.vertical_scroll_offset((row as f32 * pitch - (height - pitch) / 2.0).max(0.0));
    }
    let mut focused = None;
    ui.spacing_mut().interact_size.y = ROW;
    let output = area.show_rows(ui, ROW, found.len(), |ui, rows| {
        for row in rows {
            let Some(&place) = found.get(row) else { continue };
            let curve = &table.curves[place];
            let mut words = RichText::new(&curve.name);
            if context.view.import.hovered_curve == Some(place) {
                words = words.strong();
            }
            let response = ui.add(egui::Checkbox::new(&mut taken[place], words));
            if wanted == Some(row) {
                response.request_focus();
            }
            if response.has_focus() {
                hold(ui, &response);
                focused = Some(row);
            }
            if response.hovered() || response.has_focus() {
                under = Some(place);
            }
            let [first, last] = [curve.wavelengths_nm.first(), curve.wavelengths_nm.last()];
            if let Some((first, last)) = first.zip(last) {
                let gaps =
                    if curve.missing > 0 { format!(", {} without a value", curve.missing) } else { String::new() };
                response.on_hover_text(format!(
                    "{}: {} samples, {first}–{last} nm{gaps}",
                    curve.name,
                    curve.values.len()
                ));
            }
        }
    });
    ui.data_mut(|data| data.insert_temp(row_with_keyboard(), focused));
    let inside = focused.is_some() || ui.rect_contains_pointer(output.inner_rect);
    widgets::hover_curve(ui, POINTER, inside, under, context);
    if !taken.contains(&true) {
        let stays = if shown.set.is_some() { " The data set is unchanged until one is." } else { "" };
        ui.label(RichText::new(format!("No curve is selected.{stays}")).small().color(context.theme.warning));
    }
    if taken != before {
        overrides.taken = Some((0..count).filter(|place| taken[*place]).collect());
    }
}

fn row_with_keyboard() -> Id {
    Id::unique("curve with the keyboard")
}

/// The row that is to have the keyboard now: the next one by an arrow, or the first of all when the list is reached.
fn wanted_row(ui: &Ui, count: usize, context: &mut PaneContext<'_>) -> Option<usize> {
    if context.view.import.takes_keyboard(Stop::Picker) {
        return (count > 0).then_some(0);
    }
    let row: usize = ui.data(|data| data.get_temp::<Option<usize>>(row_with_keyboard())).flatten()?;
    let step = step(ui);
    row.checked_add_signed(step).filter(|row| step != 0 && *row < count)
}

fn buttons(ui: &mut Ui, found: &[usize], taken: &mut [bool]) {
    ui.horizontal(|ui| {
        if ui.button("All").on_hover_text("Select all that are listed").clicked() {
            set(taken, found, true);
        }
        if ui.button("None").on_hover_text("Deselect all that are listed").clicked() {
            set(taken, found, false);
        }
        if found.len() > TAKEN_AT_FIRST
            && ui
                .button(format!("First {TAKEN_AT_FIRST}"))
                .on_hover_text("Select only the first that are listed")
                .clicked()
        {
            taken.fill(false);
            set(taken, &found[..TAKEN_AT_FIRST], true);
        }
    });
}

fn set(taken: &mut [bool], places: &[usize], to: bool) {
    for place in places {
        taken[*place] = to;
    }
}
