//! Tables of a file that contains several: each ticked one is imported as a set of its own.

use std::collections::BTreeSet;

use egui::{Checkbox, ScrollArea, Ui};
use spectral_file::Part;

use crate::command::Command;
use crate::figures::curves::ImportSelection;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::theme::{ROW, UNIT};

const ROWS: usize = 5;

pub(super) fn name(part: usize, known: Option<&Part>) -> String {
    match known {
        Some(known) if !known.name.is_empty() => format!("{part}: {}", known.name),
        Some(known) => format!("{part}: line {}", known.line),
        None => format!("Part {part}"),
    }
}

pub(super) fn show(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
    let (Some(table), Some(file)) = (shown.table(), &shown.file) else { return };
    let parts = &table.reading.parts;
    if parts.len() < 2 {
        return;
    }
    let fingerprint = file.origin.fingerprint;
    let own = context.scene.document.own.iter().filter(|set| set.fingerprint == Some(fingerprint));
    let used: BTreeSet<usize> = own.filter_map(|set| set.overrides.options.part).collect();
    widgets::note(ui, "Parts, each as a separate data set");
    let mut ticked = std::mem::take(&mut context.view.import.parts);
    ticked.retain(|part| *part <= parts.len() && !used.contains(part));
    let free = (1..=parts.len()).filter(|part| !used.contains(part));
    let height = (ROW + ui.spacing().item_spacing.y) * parts.len().min(ROWS) as f32;
    let area = ScrollArea::vertical().id_salt("parts").max_height(height).auto_shrink([false, true]);
    ui.spacing_mut().interact_size.y = ROW;
    let free: Vec<usize> = free.collect();
    area.show_rows(ui, ROW, parts.len(), |ui, rows| {
        for row in rows {
            let part = row + 1;
            let mut on = used.contains(&part) || ticked.contains(&part);
            let words = name(part, parts.get(row));
            let response = ui.add_enabled(!used.contains(&part), Checkbox::new(&mut on, words));
            if response.changed() && !ticked.remove(&part) {
                ticked.insert(part);
            }
            response.on_disabled_hover_text("Already imported");
        }
    });
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = UNIT;
        if ui.button("All parts").on_hover_text("Tick all parts that are not imported yet").clicked() {
            ticked.extend(&free);
        }
        let words = match ticked.len() {
            1 => "Import 1 part".to_owned(),
            count => format!("Import {count} parts"),
        };
        let hint = "Import each ticked part; can be undone";
        let button = ui.add_enabled(!ticked.is_empty(), egui::Button::new(words)).on_hover_text(hint);
        if button.on_disabled_hover_text("No part is ticked").clicked() {
            let taken: Vec<usize> = std::mem::take(&mut ticked).into_iter().collect();
            context.push(Command::UseParts(fingerprint, taken, Box::new(shown.overrides.clone())));
        }
    });
    context.view.import.parts = ticked;
}
