//! Color correction: method, matrix, errors, and export.

mod controls;

use std::sync::Arc;

use chromascope_core::correction::RgbTransform;
use chromascope_core::query::correction::CorrectionUnder;
use chromascope_core::query::{Ask as _, PatchColorsQuery};
use chromascope_figure::{Cell, Table};
use egui::{Id, Label, Rect, RichText, ScrollArea, Sense, Ui, Vec2};

use super::context::{Pane, PaneContext};
use crate::document::SetKind;
use crate::export::profile::{CorrectionFile, CorrectionFileError, CorrectionFileQuery, aligned, check_lines};
use crate::figures::correction as figure;
use crate::paint::{self, PlotOptions};
use crate::panes::widgets;
use crate::panes::widgets::table::{DataTable, Drawn};
use crate::theme::UNIT;
use crate::workspaces::PaneKind;

pub const PANE: Pane =
    Pane::new(PaneKind::CORRECTION, "Correction", show).tab("Matrix").figure(&figure::KIND).under_conditions();

fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    widgets::scrolling_pane(ui, &PANE, rect, context, |ui, context| {
        ui.spacing_mut().item_spacing = Vec2::new(2.0 * UNIT, UNIT);
        let Some(camera) = controls::camera(ui, context) else { return };
        controls::files(ui, context);
        let answer = refreshed(&camera, context);
        let ratio = answer.as_ref().ok().and_then(|file| file.as_ref());
        controls::stated(ui, &camera, ratio.map(|file| file.ratio), context);
        controls::method(ui, context);
        controls::training(ui, context);
        match answer {
            Err(error) => {
                ui.add(Label::new(RichText::new(error).color(context.theme.error)).wrap());
            }
            Ok(None) => {
                ui.weak("computing…");
            }
            Ok(Some(file)) => sheet(ui, &file, context),
        }
    });
}

/// The correction of a camera; that under other conditions while it is made.
fn refreshed(camera: &str, context: &mut PaneContext<'_>) -> Result<Option<Arc<CorrectionFile>>, String> {
    let view = &mut context.view.correction;
    let query = CorrectionFileQuery::new(&context.scene, view.request(&context.scene, camera));
    let made = query.map_err(|error| error.to_string()).and_then(|query| {
        let made = context.later.ask(PANE.kind, vec![query]).current()?;
        made.map(|made| (*made).clone()).transpose().map_err(|error| error.to_string())
    });
    match made {
        Ok(made) => view.shown = made.or(view.shown.take().filter(|file| file.of.camera == camera)),
        Err(error) => {
            view.shown = None;
            return Err(error);
        }
    }
    Ok(view.shown.clone())
}

fn sheet(ui: &mut Ui, file: &CorrectionFile, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    for (index, (name, under)) in file.unders().enumerate() {
        ui.push_id(index, |ui| under_light(ui, file, name, under, context));
    }
    controls::second_light(ui, context);
    if let Some(Err(error)) = &file.sheet.second {
        ui.add(Label::new(RichText::new(error.to_string()).color(theme.error)).wrap());
    }
    between(ui, file, context);
    match file.dng() {
        Ok(dng) => {
            section(ui, "DNG matrices", Some(&dng), "Copy the DNG matrices");
            for line in dng.lines() {
                ui.add(Label::new(RichText::new(line).monospace()).wrap());
            }
        }
        Err(error @ CorrectionFileError::Ratio { .. }) => {
            section(ui, "DNG matrices", None, "");
            ui.add(Label::new(RichText::new(error.to_string()).color(theme.warning)).wrap());
        }
        Err(_) => {}
    }
    aces(ui, file, context);
    ui.add_space(2.0 * UNIT);
}

fn under_light(ui: &mut Ui, file: &CorrectionFile, name: &str, under: &CorrectionUnder, context: &PaneContext<'_>) {
    let theme = context.theme;
    let kelvin = under.temperature.map_or(String::new(), |kelvin| format!(", {:.0} K", kelvin.get()));
    let matrix = file.transform_text(under);
    section(ui, &format!("XYZ from balanced RGB under {name}{kelvin}"), Some(&matrix), "Copy the matrix, all digits");
    match &under.report.transform {
        RgbTransform::Matrix(matrix) => mono(ui, &aligned(*matrix, 4)),
        RgbTransform::RootPolynomial(_) => mono(ui, &matrix),
    }
    section(ui, "Errors over the training reflectances", None, "");
    errors(ui, file, under, context);
    section(ui, "White, and narrow blue LEDs (20 nm)", None, "");
    let checks: Vec<_> = std::iter::once(&under.report.white).chain(&under.report.blue).collect();
    let lines: Vec<[String; 2]> = checks.iter().map(|check| check_lines(check, file.of.metric)).collect();
    for (at, [numbers, remark]) in lines.iter().enumerate() {
        mono(ui, numbers);
        // What holds for several lights is said once, below the last.
        if lines.get(at + 1).is_none_or(|next| next[1] != *remark) {
            let color = if checks[at].is_negative() { theme.warning } else { theme.weak };
            ui.add(Label::new(RichText::new(remark).small().color(color)).wrap());
        }
    }
}

/// What the correction mends: a bar up to the mean, a line up to the 95 % quantile, and the worst color.
fn errors(ui: &mut Ui, file: &CorrectionFile, under: &CorrectionUnder, context: &PaneContext<'_>) {
    let (scene, theme, report) = (&context.scene, context.theme, &under.report);
    let rows = [("uncorrected", report.before), ("training", report.training), ("leave-one-out", report.left_out)];
    let head = format!("{} of {}", file.of.metric, report.count);
    let mut table = Table::new([head.as_str(), "", "mean", "95 %", "max", "worst"]);
    for column in &mut table.columns {
        column.decimals = Some(2);
    }
    let rendering = scene.rendering_of(SetKind::Observer, &scene.document.reference).ok();
    let patches = &file.of.training;
    let colors =
        rendering.map(|rendering| scene.results.ask(&PatchColorsQuery { rendering, patches: patches.clone() }));
    for (label, summary) in rows {
        let Some(of) = summary else {
            table.push([label, "", "", "", "", "undefined"].map(Cell::from));
            continue;
        };
        let color = colors.as_ref().and_then(|colors| Some((**colors).as_ref().ok()?.get(of.worst)?.srgb.bytes));
        let name = patches.patches().get(of.worst).map_or("", |patch| &patch.name);
        let worst = Cell::from(name).with(|note| {
            note.swatch = color.map(|color| [color; 2]);
            name.clone_into(&mut note.hint);
        });
        let [mean, p95, max] = [of.mean, of.p95, of.max].map(Cell::from);
        table.push([Cell::from(label), Cell::from(""), mean, p95, max, worst]);
    }
    let longest = rows.iter().filter_map(|(_, of)| Some(of.as_ref()?.p95)).fold(f64::MIN_POSITIVE, f64::max);
    let draw = |painter: &egui::Painter, place: Rect, row: usize| {
        let Some(of) = rows[row].1 else { return };
        let at = |value: f64| place.left() + place.width() * (value / longest) as f32;
        painter.hline(at(of.mean)..=at(of.p95), place.center().y, egui::Stroke::new(1.5, theme.weak));
        painter.rect_filled(place.with_max_x(at(of.mean)), 0.0, theme.weak);
    };
    let drawn = Drawn { column: 1, width: 84.0, draw: &draw };
    DataTable::new(PANE.kind, &format!("errors {head}"), &table).with_drawn(drawn).show_compact(ui, context);
}

fn section(ui: &mut Ui, caption: &str, copied: Option<&str>, hint: &str) {
    ui.add_space(UNIT);
    ui.horizontal_wrapped(|ui| {
        ui.strong(caption);
        if let Some(text) = copied
            && ui.small_button("Copy").on_hover_text(hint).clicked()
        {
            ui.ctx().copy_text(text.to_owned());
        }
    });
}

/// Aligned lines; a narrow pane scrolls them sideways.
fn mono(ui: &mut Ui, text: &str) {
    ScrollArea::horizontal().id_salt(text).auto_shrink([false, true]).show(ui, |ui| {
        ui.add(Label::new(RichText::new(text).monospace()).extend());
    });
}

fn between(ui: &mut Ui, file: &CorrectionFile, context: &mut PaneContext<'_>) {
    let width = ui.available_width();
    let size = Vec2::new(width, (0.5 * width).clamp(120.0, 220.0));
    let Some(panel) = figure::panel(file, [f64::from(size.x), f64::from(size.y)]) else { return };
    section(ui, "Blackbodies between the two lights, by ForwardMatrix", None, "");
    ui.horizontal_wrapped(|ui| {
        for (name, role) in figure::key(file) {
            ui.label(RichText::new(name).small().color(context.theme.ink(chromascope_figure::Ink::new(role))));
        }
    });
    let (area, _) = ui.allocate_exact_size(size, Sense::hover());
    let options = PlotOptions { zoomable: false, reset: context.view.reset_plots, ..PlotOptions::default() };
    let shown = paint::plot(ui, Id::unique("two lights"), &panel, &context.theme, area, options);
    if let Some([mired, _]) = shown.hovered
        && let Some(lines) = figure::at(file, mired)
    {
        widgets::read_at_pointer(&shown.response, &lines);
    }
}

fn aces(ui: &mut Ui, file: &CorrectionFile, context: &PaneContext<'_>) {
    match &file.idt {
        Ok(idt) => {
            section(ui, "ACES IDT (rawtoaces)", Some(&aligned(idt.matrix, 7)), "Copy the IDT matrix");
            mono(ui, &file.idt_text(idt));
        }
        Err(error) => {
            section(ui, "ACES IDT (rawtoaces)", None, "");
            ui.add(Label::new(RichText::new(error.to_string()).color(context.theme.error)).wrap());
        }
    }
}
