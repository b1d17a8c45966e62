//! The list of reflectances.

use egui::Ui;

use super::set;
use crate::catalog::Entry;
use crate::document::SetKind;
use crate::panes::context::PaneContext;
use crate::panes::widgets::pick_list::{self, Line};

/// A list of all reflectances that is filtered as one types: the user's own, then the built-in ones by file.
pub(super) fn choice(ui: &mut Ui, now: &str, context: &mut PaneContext<'_>) {
    let mut names = Vec::new();
    let width = ui.available_width();
    let hint = "Reflectance of the surface";
    let chosen = pick_list::drop_down(ui, ("Material", hint), now, width, &context.theme, || {
        let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
        let mut entries: Vec<Entry> = own.chain(context.scene.entries(SetKind::Material)).collect();
        entries.sort_by_cached_key(|entry| (!entry.is_own(), entry.also.clone()));
        let mut lines: Vec<Line> = Vec::new();
        let mut last = None;
        for Entry { name, short, also, .. } in entries {
            let group = also.unwrap_or_else(|| "Others".to_owned());
            if last.as_ref() != Some(&group) {
                lines.push(Line::heading(&group));
                names.push(String::new());
            }
            lines.push(Line { also: format!("{short} {group}"), ..Line::new(&name, name == now) });
            names.push(name);
            last = Some(group);
        }
        lines
    });
    if let Some(name) = chosen.map(|index| names.swap_remove(index)) {
        set(context, "Material", |settings| settings.material = name);
    }
}
