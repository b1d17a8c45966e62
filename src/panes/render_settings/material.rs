//! The lists of reflectances: of the mesh, and of the head's garment.

use egui::Ui;

use super::set;
use crate::catalog::Entry;
use crate::document::SetKind;
use crate::panes::context::PaneContext;
use crate::panes::widgets::facts;
use crate::panes::widgets::pick_list::{self, Line};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Skin,
    Garment,
}

/// The head without a garment.
const BARE: &str = "None: bare shoulders";

/// A list of all reflectances that is filtered as one types: the user's own, then the built-in ones by file.
pub(super) fn choice(ui: &mut Ui, part: Part, context: &mut PaneContext<'_>) {
    let mut names = Vec::new();
    let width = ui.available_width();
    let settings = &context.scene.document.render;
    let (what, hint, now) = match part {
        Part::Skin => ("Material", "Reflectance of the surface", settings.material.clone()),
        Part::Garment => {
            let hint = "Reflectance of the head's garment; its surface is that of the rest. Figures 8 and 9 have none.";
            ("Garment", hint, settings.garment.clone().unwrap_or_else(|| BARE.to_owned()))
        }
    };
    let chosen = pick_list::drop_down(ui, (what, hint), &now, width, &context.theme, || {
        let own = context.scene.entries(SetKind::Chart).filter(Entry::is_own);
        let mut entries: Vec<Entry> = own.chain(context.scene.entries(SetKind::Material)).collect();
        entries.sort_by_cached_key(|entry| (!entry.is_own(), entry.also.clone()));
        let mut lines: Vec<Line> = Vec::new();
        let mut last = None;
        if part == Part::Garment {
            lines.push(Line::new(BARE, now == BARE));
            names.push(BARE.to_owned());
        }
        for entry in entries {
            let facts = facts::provenance(&context.scene, &entry);
            let Entry { name, short, also, .. } = entry;
            let group = also.unwrap_or_else(|| "Others".to_owned());
            if last.as_ref() != Some(&group) {
                lines.push(Line::heading(&group));
                names.push(String::new());
            }
            lines.push(Line { also: format!("{short} {group}"), facts, ..Line::new(&name, name == now) });
            names.push(name);
            last = Some(group);
        }
        lines
    });
    if let Some(name) = chosen.map(|index| names.swap_remove(index)) {
        set(context, what, |settings| match part {
            Part::Skin => settings.material = name,
            Part::Garment => settings.garment = (name != BARE).then_some(name),
        });
    }
}
