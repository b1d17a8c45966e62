//! Settings of the reader: each shows the decision with its confidence, and accepts another choice. Tables of a file that
//! contains several: each ticked one is imported as a set of its own.

use std::collections::BTreeSet;

use egui::{Checkbox, CollapsingHeader, RichText, ScrollArea, Ui};
use spectral_file::{
    Certainty, Decided, DecimalMark, Delimiter, Orientation, Part, ReadOptions, ReadReport, Reader, Role, SpectralFile,
    Values, WavelengthUnit,
};

use super::{CONTENT, CONTENT_SHORT, Closed, list};
use crate::command::Command;
use crate::document::imported::ImportOverrides;
use crate::figures::curves::ImportSelection;
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::theme::{ROW, Theme, UNIT};

/// Head of the switches of a file's format where none of them is in doubt.
const SETTLED: &str = "File format: all certain";

const COLUMNS: usize = 60;
const PARTS: usize = 1000;

/// The list of a setting: the user's choice, the automatic decision, and the options.
fn switch<T: Copy + PartialEq>(
    ui: &mut Ui,
    theme: &Theme,
    (words, width, wordy): (&str, f32, bool),
    wish: &mut Option<T>,
    decided: Option<&Decided<T>>,
    choices: &[(T, &str)],
) {
    let name = |value: T| {
        let known = choices.iter().find(|(choice, _)| *choice == value);
        known.map_or_else(|| "Other".to_owned(), |(_, words)| (*words).to_owned())
    };
    // In a narrow pane, the first word or two distinguish the choices.
    let name = |value: T| if wordy { name(value) } else { short(&name(value)).to_owned() };
    let closed = closed(wish.map(name), decided, name, wordy);
    let mut entries = vec![(CONTENT.to_owned(), wish.is_none())];
    entries.extend(choices.iter().map(|(choice, words)| ((*words).to_owned(), *wish == Some(*choice))));
    if let Some(index) = list(ui, theme, words, &closed, &entries, width) {
        *wish = index.checked_sub(1).and_then(|index| choices.get(index)).map(|(choice, _)| *choice);
    }
}

/// The closed list: the choice, else the automatic decision, if known.
fn closed<T: Copy>(
    wish: Option<String>,
    decided: Option<&Decided<T>>,
    name: impl Fn(T) -> String,
    wordy: bool,
) -> Closed {
    if let Some(value) = wish {
        return Closed { value, how: "chosen".to_owned(), guess: false, why: "Chosen by hand".to_owned() };
    }
    let Some(decided) = decided.filter(|decided| decided.certainty != Certainty::Chosen) else {
        let value = if wordy { CONTENT } else { CONTENT_SHORT };
        return Closed { value: value.to_owned(), ..Closed::default() };
    };
    let guess = decided.certainty.is_doubtful();
    let sure = match decided.certainty {
        Certainty::Guess => "guess",
        Certainty::Open => "open",
        Certainty::Certain | Certainty::Chosen => "certain",
    };
    Closed { value: name(decided.value), how: sure.to_owned(), guess, why: decided.why.clone() }
}

fn short(words: &str) -> &str {
    ["Down", "Across", "Table"].into_iter().find(|short| words.starts_with(short)).unwrap_or(words)
}

pub(super) fn show(ui: &mut Ui, shown: &ImportSelection, overrides: &mut ImportOverrides, theme: &Theme) {
    // The result of the last preview is shown as long as no newer one is available.
    let table = shown.table();
    let reading = table.map(|table| &table.reading);
    let options = &mut overrides.options;
    let whole = ui.available_width() - 2.0;
    let decided = table.map(|table| &table.role);
    switch(ui, theme, ("This is a", whole, true), &mut options.role, decided, Role::CHOICES);
    let decided = reading.map(|reading| &reading.values);
    switch(ui, theme, ("Values are", whole, true), &mut options.values, decided, Values::CHOICES);
    let is_settled = shown.error().is_none() && reading.is_some_and(|reading| is_certain(reading, options));
    if is_settled {
        let head = RichText::new(SETTLED).small();
        let whole = whole - ui.spacing().indent;
        CollapsingHeader::new(head).id_salt(SETTLED).show(ui, |ui| format(ui, shown, options, theme, whole));
    } else {
        format(ui, shown, options, theme, whole);
    }
}

fn is_certain(reading: &ReadReport, options: &ReadOptions) -> bool {
    let certainties = [
        reading.wavelength_unit.certainty,
        reading.reader.certainty,
        reading.decimal_mark.certainty,
        reading.delimiter.certainty,
        reading.orientation.certainty,
    ];
    let asked = ReadOptions { role: options.role, values: options.values, ..ReadOptions::default() };
    // Which of several tables is read is a choice that stays in sight.
    certainties.iter().all(|certainty| *certainty == Certainty::Certain) && *options == asked && reading.parts.len() < 2
}

fn format(ui: &mut Ui, shown: &ImportSelection, options: &mut ReadOptions, theme: &Theme, whole: f32) {
    let gap = 2.0 * UNIT;
    let half = ((whole - gap) / 2.0).floor();
    let table = shown.table();
    let reading = table.map(|table| &table.reading);
    let unit = reading.map(|reading| &reading.wavelength_unit);
    let columns = columns(table, options.reader);
    pair(ui, gap, |ui| {
        switch(ui, theme, ("Wavelengths in", half, false), &mut options.wavelength_unit, unit, WavelengthUnit::CHOICES);
        let decided = reading.map(|reading| &reading.reader);
        let readers = Reader::ALL.map(|reader| (reader, reader.label));
        switch(ui, theme, ("Read by", half, false), &mut options.reader, decided, &readers);
    });
    if columns {
        pair(ui, gap, |ui| {
            let decided = reading.map(|reading| &reading.decimal_mark);
            switch(ui, theme, ("Decimal mark", half, false), &mut options.decimal_mark, decided, DecimalMark::CHOICES);
            let decided = reading.map(|reading| &reading.delimiter);
            switch(ui, theme, ("Columns split by", half, false), &mut options.delimiter, decided, Delimiter::CHOICES);
        });
        pair(ui, gap, |ui| {
            let decided = reading.map(|reading| &reading.orientation);
            let words = ("Wavelengths run", half, false);
            switch(ui, theme, words, &mut options.orientation, decided, Orientation::CHOICES);
            let across = options.orientation == Some(Orientation::Across)
                || (options.orientation.is_none() && decided.is_some_and(|d| d.value == Orientation::Across));
            if !across {
                column(ui, shown, &mut options.wavelength_column, theme, half);
            }
        });
    }
    part(ui, table, &mut options.part, theme, whole);
    let mut raw = options.raw == Some(true);
    if columns
        && ui
            .checkbox(&mut raw, "Import raw columns")
            .on_hover_text("Dark, reference and sample counts, temperatures and times, beside the spectra")
            .changed()
    {
        options.raw = raw.then_some(true);
    }
}

fn pair(ui: &mut Ui, gap: f32, add: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        add(ui);
    });
}

fn columns(table: Option<&SpectralFile>, wish: Option<Reader>) -> bool {
    let known = table.map(|table| table.reading.reader.value);
    wish.or(known).is_none_or(|reader| reader == Reader::TABLE)
}

fn column(ui: &mut Ui, shown: &ImportSelection, wish: &mut Option<usize>, theme: &Theme, width: f32) {
    let table = shown.table();
    let decided = table.and_then(|table| table.reading.wavelength_column);
    let curves = table.map_or(0, |table| table.curves.len());
    let names = header(shown);
    let known = names.len().max(curves + 1).max(decided.unwrap_or(1)).max(wish.unwrap_or(1));
    let last = known.clamp(2, COLUMNS);
    let name = |column: usize| match names.get(column - 1) {
        Some(name) if !name.is_empty() => format!("{column}: {name}"),
        _ => format!("Column {column}"),
    };
    let value = wish.or(decided);
    let how = if wish.is_some() { "chosen".to_owned() } else { String::new() };
    let closed = Closed { value: value.map_or_else(|| CONTENT_SHORT.to_owned(), name), how, ..Closed::default() };
    let mut entries = vec![(CONTENT.to_owned(), wish.is_none())];
    entries.extend((1..=last).map(|column| (name(column), *wish == Some(column))));
    if let Some(index) = list(ui, theme, "Wavelength column", &closed, &entries, width) {
        *wish = (index > 0).then_some(index);
    }
}

fn header(shown: &ImportSelection) -> Vec<String> {
    let line = || {
        let reading = &shown.table()?.reading;
        let preview = shown.look.as_ref()?.preview.as_ref().ok()?;
        Some((preview.line(reading.header_line?)?, reading.delimiter.value))
    };
    let Some((line, delimiter)) = line() else { return Vec::new() };
    let cells: Vec<&str> = match delimiter {
        Delimiter::Comma => line.split(',').take(COLUMNS).collect(),
        Delimiter::CommaSpace => line.split(", ").take(COLUMNS).collect(),
        Delimiter::Semicolon => line.split(';').take(COLUMNS).collect(),
        Delimiter::Tab => line.split('\t').take(COLUMNS).collect(),
        Delimiter::Bar => line.split('|').take(COLUMNS).collect(),
        // Names may hold spaces too.
        Delimiter::Spaces | Delimiter::Elements => Vec::new(),
    };
    let tidy = |cell: &&str| cell.trim().trim_matches('"').trim_start_matches('#').trim().to_owned();
    cells.iter().map(tidy).collect()
}

fn part(ui: &mut Ui, table: Option<&SpectralFile>, wish: &mut Option<usize>, theme: &Theme, width: f32) {
    let known = table.map_or(&[][..], |table| &table.reading.parts);
    if known.len() < 2 && wish.is_none() {
        return;
    }
    let name = |part: usize| match part.checked_sub(1) {
        None => "All, side by side".to_owned(),
        Some(place) => name_of(part, known.get(place)),
    };
    let told = |part: usize| {
        let one = part.checked_sub(1).and_then(|place| known.get(place));
        one.map_or_else(String::new, |p| format!(", {} of {} rows", count(p.curves, "curve"), p.rows))
    };
    let closed = closed(wish.map(name), table.map(|table| &table.reading.part), name, true);
    let mut entries = vec![(CONTENT.to_owned(), wish.is_none())];
    let last = known.len().max(wish.unwrap_or(1)).min(PARTS);
    entries.extend((1..=last).map(|part| (format!("{}{}", name(part), told(part)), *wish == Some(part))));
    if let Some(index) = list(ui, theme, "Part", &closed, &entries, width) {
        *wish = (index > 0).then_some(index);
    }
}

fn count(number: usize, word: &str) -> String {
    if number == 1 { format!("1 {word}") } else { format!("{number} {word}s") }
}

const ROWS: usize = 5;

fn name_of(part: usize, known: Option<&Part>) -> String {
    match known {
        Some(known) if !known.name.is_empty() => format!("{part}: {}", known.name),
        Some(known) => format!("{part}: line {}", known.line),
        None => format!("Part {part}"),
    }
}

pub(super) fn parts(ui: &mut Ui, shown: &ImportSelection, context: &mut PaneContext<'_>) {
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
            let words = name_of(part, parts.get(row));
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
