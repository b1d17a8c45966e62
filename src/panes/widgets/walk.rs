//! Walking through a pane with the arrow keys: points of a diagram, swatches, curves.

use chromascope_core::patch_set::PatchSet;
use egui::{Key, Modifiers, Ui};

use crate::panes::context::PaneContext;
use crate::plot_item::{PlotItem, SensorId};
use crate::view::Status;
use crate::workspaces::PaneKind;

/// True if keys mean a pane: it has the keyboard, and no control and no list does.
pub fn has_keys(ui: &Ui, pane: PaneKind, context: &PaneContext<'_>) -> bool {
    context.view.focused == Some(pane)
        && context.view.palette.is_none()
        && ui.memory(|memory| memory.focused().is_none())
        && !egui::Popup::is_any_open(ui.ctx())
}

/// Moves along the rows of a pane's items: arrows move, Enter selects. The item under the keyboard is marked and read like one
/// under the pointer. Returns whether it moved.
pub fn along(
    ui: &Ui,
    pane: PaneKind,
    context: &mut PaneContext<'_>,
    rows: impl FnOnce(&PaneContext<'_>) -> Vec<Vec<PlotItem>>,
) -> bool {
    if !has_keys(ui, pane, context) {
        return false;
    }
    let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)).cast_signed();
    let right = pressed(Key::ArrowRight) - pressed(Key::ArrowLeft);
    let down = pressed(Key::ArrowDown) - pressed(Key::ArrowUp);
    if right != 0 || down != 0 {
        (context.view.by_keyboard, context.view.status) = (true, Status::default());
        let rows: Vec<Vec<PlotItem>> = rows(context).into_iter().filter(|row| !row.is_empty()).collect();
        let now = context.view.cursor.as_ref().or(context.view.selected.as_ref());
        context.view.cursor = moved(&rows, now, [right, down]);
        ui.ctx().request_repaint();
    }
    let Some(cursor) = context.view.cursor.clone() else { return false };
    if context.view.next_hovered.is_none() {
        context.view.hover(Some(&cursor));
    }
    if pressed(Key::Enter) > 0 {
        context.view.click(Some(&cursor));
    }
    right != 0 || down != 0
}

/// The item so many places right and down of another; the first where there is none.
fn moved(rows: &[Vec<PlotItem>], from: Option<&PlotItem>, [right, down]: [isize; 2]) -> Option<PlotItem> {
    let place = from.and_then(|from| {
        rows.iter().enumerate().find_map(|(row, items)| Some((row, items.iter().position(|item| item == from)?)))
    });
    let Some((row, column)) = place else { return rows.first()?.first().cloned() };
    let row = row.saturating_add_signed(down).min(rows.len() - 1);
    let last = rows[row].len() - 1;
    Some(rows[row][column.saturating_add_signed(right).min(last)].clone())
}

/// Rows of patches, one for each visible sensor, as the diagram and the swatches show them.
pub fn patches_by_sensor(context: &PaneContext<'_>) -> Vec<Vec<PlotItem>> {
    let Ok(set) = context.scene.patches() else { return Vec::new() };
    let sensors = context.scene.sources().into_iter().filter(|source| source.visible);
    sensors.map(|source| patches(&set, Some(&SensorId { kind: source.kind, name: source.name }))).collect()
}

/// The curves of the spectra: the light, the patches, the visible sensors.
pub fn curves(context: &PaneContext<'_>) -> Vec<Vec<PlotItem>> {
    let reflectances = context.scene.patches().map_or_else(|_| Vec::new(), |set| patches(&set, None));
    let sensors = context.scene.sources().into_iter().filter(|source| source.visible);
    let sensors = sensors.map(|source| PlotItem::Sensor(SensorId { kind: source.kind, name: source.name }));
    vec![vec![PlotItem::Light], reflectances, sensors.collect()]
}

/// The patches of a set, of a sensor or as such.
pub fn patches(set: &PatchSet, source: Option<&SensorId>) -> Vec<PlotItem> {
    let patch = |patch: &str| PlotItem::Patch { source: source.cloned(), patch: patch.to_owned() };
    set.patches().iter().map(|known| patch(&known.name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_stay_within_rows_of_unequal_length() {
        let patch = |name: &str| PlotItem::Patch { source: None, patch: name.to_owned() };
        let rows = [vec![patch("a"), patch("b"), patch("c")], vec![patch("d")]];
        let go = |from: Option<&str>, step| moved(&rows, from.map(patch).as_ref(), step);
        assert_eq!(go(None, [1, 0]), Some(patch("a")));
        assert_eq!(go(Some("elsewhere"), [0, 1]), Some(patch("a")));
        assert_eq!(go(Some("b"), [1, 0]), Some(patch("c")));
        assert_eq!(go(Some("c"), [1, 0]), Some(patch("c")));
        assert_eq!(go(Some("c"), [0, 1]), Some(patch("d")));
        assert_eq!(go(Some("d"), [-1, -1]), Some(patch("a")));
        assert_eq!(moved(&[], None, [1, 0]), None);
    }
}
