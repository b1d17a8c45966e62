//! Patch through one sensor compared with the reference, or through all; a blackbody through a sensor.

use chromascope_core::colorimetry::Metric;
use chromascope_core::query::{DifferenceError, LocusPoint, PatchColor, compare};
use chromascope_figure::InkRole;
use egui::text::LayoutJob;
use egui::{FontId, Rect, Sense, TextFormat, TextStyle, Ui, Vec2};

use super::numbers::{self, Point, blackbody_of, color_of, difference_of, index_of, points_table};
use super::{
    assumptions, buttons, copy_text, failure, head, held_words, label_of, no_difference, reference_id, show_assumptions,
};
use crate::document::Light;
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::panes::widgets::{self, focus_rim, lines};
use crate::plot_item::{PlotItem, SensorId};
use crate::scene::{ComparedSensor, Scene};
use crate::theme::{HEADING, ROW, TEXT, Theme, UNIT};

const PAIR: f32 = 40.0;

fn held_of(scene: &Scene<'_>, patch: &str) -> Option<String> {
    let set = scene.patches().ok()?;
    let found = set.patches().iter().find(|p| p.name == patch)?;
    held_words(&format!("Patch {patch}"), found.grid.assumed())
}

/// The number a patch has in its whole chart, with its name.
fn title(scene: &Scene<'_>, patch: &str) -> String {
    let header = scene.chart_entry(&scene.document.chart).ok().and_then(|entry| entry.header);
    let number = header.and_then(|header| header.columns.iter().position(|column| column == patch));
    let number = number.or_else(|| index_of(scene, patch));
    match number {
        // Charts without patch names are numbered already.
        Some(index) if patch.parse::<u32>().is_err() => format!("Patch {} {patch}", index + 1),
        _ => format!("Patch {patch}"),
    }
}

fn pair(ui: &mut Ui, theme: &Theme, left: &PatchColor, right: Option<&PatchColor>, height: f32, width: f32) {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(width, height), Sense::hover());
    widgets::labeled(&response, egui::Role::Image, "Swatches: left the reference, right the sensor");
    ui.painter().rect_filled(rect, 0.0, theme.surround);
    let inner = rect.shrink(if height > 30.0 { 1.5 * UNIT } else { 3.0 });
    let middle = inner.center().x;
    let halves = [inner.with_max_x(middle), inner.with_min_x(middle)];
    for (half, color) in halves.into_iter().zip([left, right.unwrap_or(left)]) {
        ui.painter().rect_filled(half, 0.0, theme.role(InkRole::Rgb(color.srgb.bytes)));
        if color.srgb.clipped {
            let corner = half.right_top();
            let notch = vec![corner, corner - Vec2::new(7.0, 0.0), corner + Vec2::new(0.0, 7.0)];
            ui.painter().add(egui::Shape::convex_polygon(notch, theme.surround, egui::Stroke::NONE));
        }
    }
}

pub(super) fn one(ui: &mut Ui, id: &SensorId, patch: &str, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    head(ui, id, context);
    widgets::note(ui, format!("{}, light {}", title(&scene, patch), scene.light_name()));
    let reference = reference_id(&scene);
    let is_reference = reference == *id;
    let colors = color_of(&scene, id, patch).and_then(|own| Ok((own, color_of(&scene, &reference, patch)?)));
    let (own, seen) = match colors {
        Ok((Some(own), Some(seen))) => (own, seen),
        Ok(_) => return widgets::note(ui, "This patch is not visible."),
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    let right = if context.view.blink || is_reference { None } else { Some(&own) };
    let width = ui.available_width();
    pair(ui, &theme, &seen, right, PAIR, width);
    if own.srgb.clipped {
        widgets::note(ui, "Notched corner: outside the screen's gamut; the numbers are not clipped.");
    }
    if !is_reference {
        difference(ui, id, patch, context);
    }
    let mut points = vec![Point::of_patch("reference", Some(seen))];
    if !is_reference {
        let difference = difference_of(&scene, id, patch).and_then(Result::ok);
        points.push(Point { difference, ..Point::of_patch(id.kind.label(), Some(own)) });
    }
    let item = PlotItem::Patch { source: Some(id.clone()), patch: patch.to_owned() };
    points_table(ui, points, &item, context);
    let label = label_of(&scene, id);
    let mut words = assumptions(&scene, id, &label);
    words.extend(held_of(&scene, patch));
    show_assumptions(ui, words);
}

/// The difference in large type with its rank, or why there is none.
fn difference(ui: &mut Ui, id: &SensorId, patch: &str, context: &PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    let Ok(differences) = scene.differences(id.kind, &id.name) else { return };
    let measure = scene.document.difference;
    match index_of(&scene, patch).and_then(|index| differences.get(index).copied()) {
        Some(Ok(value)) => {
            ui.horizontal(|ui| {
                let format = |size| TextFormat {
                    font_id: FontId::proportional(size),
                    color: theme.text,
                    valign: egui::Align::Center,
                    ..TextFormat::default()
                };
                let mut job = LayoutJob::default();
                job.append(&format!("{} ", scene.difference_name()), 0.0, format(TEXT));
                job.append(&fixed(value, measure.decimals), 0.0, format(HEADING + 2.0));
                ui.label(job);
                ui.add_space(UNIT);
                if let Some(rank) = rank(value, &differences) {
                    widgets::note(ui, rank);
                }
            });
        }
        Some(Err(reason)) => widgets::note(ui, no_difference(reason)),
        None => {}
    }
}

pub(super) fn rank(value: f64, all: &[Result<f64, DifferenceError>]) -> Option<String> {
    let known: Vec<f64> = all.iter().filter_map(|d| d.ok()).collect();
    if known.len() < 2 {
        return None;
    }
    let place = known.iter().filter(|other| **other > value).count() + 1;
    let of = known.len();
    Some(match place {
        1 => format!("worst of {of}"),
        _ if place == of => format!("best of {of}"),
        _ => format!("rank {place} of {of}"),
    })
}

pub(super) fn across(ui: &mut Ui, patch: &str, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    ui.strong(title(&scene, patch));
    widgets::note(ui, format!("{}, light {}", scene.document.chart, scene.light_name()));
    let seen = match color_of(&scene, &reference_id(&scene), patch) {
        Ok(Some(seen)) => seen,
        Ok(None) => return widgets::note(ui, "This patch is not visible."),
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    widgets::note(ui, format!("left: reference; right: sensor; {}", scene.difference_name()));
    for source in scene.sources().into_iter().filter(|source| source.visible) {
        source_row(ui, &source, patch, &seen, context);
    }
    let mut words: Vec<String> = held_of(&scene, patch).into_iter().collect();
    if let Ok(light) = scene.light() {
        words.extend(held_words(&format!("Light {}", scene.light_name()), light.grid.assumed()));
    }
    buttons_without_copy(ui, context);
    show_assumptions(ui, words);
}

fn buttons_without_copy(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let scene = context.scene;
    let selected = context.view.selected.clone();
    if buttons(ui, context)
        && let Some(PlotItem::Patch { patch, .. }) = selected
    {
        let shown: Vec<ComparedSensor> = scene.sources().into_iter().filter(|source| source.visible).collect();
        let point = |s: &ComparedSensor| {
            let id = SensorId { kind: s.kind, name: s.name.clone() };
            let difference = difference_of(&scene, &id, &patch).and_then(Result::ok).filter(|_| !s.is_reference);
            Point { difference, ..Point::of_patch(&s.label, color_of(&scene, &id, &patch).ok().flatten()) }
        };
        let points: Vec<Point> = shown.iter().map(point).collect();
        copy_text(ui, numbers::table(&scene, &points).to_tsv(), context);
    }
}

fn source_row(ui: &mut Ui, source: &ComparedSensor, patch: &str, seen: &PatchColor, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    let id = SensorId { kind: source.kind, name: source.name.clone() };
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW + UNIT), Sense::click());
    let own = color_of(&scene, &id, patch);
    let difference = difference_of(&scene, &id, patch);
    let (words, hint) = match (&own, difference) {
        (Err(error), _) => ("–".to_owned(), Some(error.to_string())),
        _ if source.is_reference => (String::new(), None),
        (_, Some(Ok(value))) => (fixed(value, scene.document.difference.decimals), None),
        (_, Some(Err(reason))) => ("–".to_owned(), Some(no_difference(reason))),
        _ => ("–".to_owned(), None),
    };
    widgets::labeled(&response, egui::Role::Button, format!("{}, {patch} {words}", source.label));
    if response.hovered() || response.has_focus() {
        let rim = focus_rim(&response, &theme);
        ui.painter().rect(rect, 3.0, theme.control, rim, egui::StrokeKind::Inside);
    }
    let key = Rect::from_min_size(rect.min, Vec2::new(lines::KEY, rect.height()));
    lines::key(ui.painter(), key, source, &theme);
    let swatches =
        Rect::from_min_max(egui::pos2(rect.right() - 122.0, rect.top() + 1.0), rect.max - Vec2::new(62.0, 1.0));
    let label = Rect::from_x_y_ranges(key.right() + 2.0 * UNIT..=swatches.left() - UNIT, rect.y_range());
    lines::name(ui, label, &source.label, TextStyle::Body, theme.text);
    if let Ok(Some(own)) = &own {
        let mut place =
            ui.new_child(egui::UiBuilder::new().id_salt(("pair", source.kind, &source.name)).max_rect(swatches));
        pair(&mut place, &theme, seen, (!source.is_reference).then_some(own), swatches.height(), swatches.width());
    }
    let column = rect.shrink2(Vec2::new(UNIT, 0.0));
    lines::right_aligned(ui, column, &words, TextStyle::Monospace, theme.text);
    if response.clicked() {
        context.view.selected = Some(PlotItem::Patch { source: Some(id), patch: patch.to_owned() });
    }
    if let Some(hint) = hint {
        response.on_hover_text(hint);
    }
}

pub(super) fn blackbody(ui: &mut Ui, id: &SensorId, kelvin: f64, context: &mut PaneContext<'_>) {
    let (scene, theme) = (context.scene, context.theme);
    head(ui, id, context);
    widgets::note(ui, format!("blackbody, {} K = {} mired", fixed(kelvin, 0), fixed(1e6 / kelvin, 1)));
    let reference = reference_id(&scene);
    let is_reference = reference == *id;
    let points = blackbody_of(&scene, id, kelvin).and_then(|own| Ok((own, blackbody_of(&scene, &reference, kelvin)?)));
    let (own, seen) = match points {
        Ok((Some(own), Some(seen))) => (own, seen),
        Ok(_) => return,
        Err(error) => return failure(ui, &theme, &error.to_string()),
    };
    if own.xy.is_none() {
        widgets::note(ui, "Chromaticity undefined (X + Y + Z = 0).");
    }
    let mut points = vec![Point::of_blackbody("reference", Some(seen))];
    if !is_reference {
        distance(ui, id, &own, &seen, context);
        points.push(Point::of_blackbody(id.kind.label(), Some(own)));
    }
    match scene.document.light {
        Light::BlackBody => widgets::note(ui, "The light on the scene is a blackbody of the marked temperature."),
        Light::Daylight => {
            let words =
                "The light on the scene is daylight of the marked temperature; the locus is that of blackbodies.";
            widgets::note(ui, words);
        }
        Light::Set(_) => {}
    }
    points_table(ui, points, &PlotItem::Radiator { source: id.clone(), kelvin }, context);
    let label = label_of(&scene, id);
    show_assumptions(ui, assumptions(&scene, id, &label));
}

fn distance(ui: &mut Ui, id: &SensorId, own: &LocusPoint, seen: &LocusPoint, context: &PaneContext<'_>) {
    let comparable = context.scene.comparable(id.kind, &id.name).unwrap_or(Ok(()));
    let xy = comparable.and_then(|()| compare::difference(Metric::XY, seen, own));
    let uv = comparable.and_then(|()| compare::difference(Metric::UV_PRIME, seen, own));
    match (xy, uv) {
        (Ok(xy), Ok(uv)) => {
            ui.label(format!("Δxy {}   Δu′v′ {}", fixed(xy, 4), fixed(uv, 4)))
                .on_hover_text("Distance from the reference at the same temperature");
        }
        (Err(reason), _) | (_, Err(reason)) => widgets::note(ui, no_difference(reason)),
    }
}
