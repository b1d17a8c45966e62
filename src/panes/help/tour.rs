//! The tour's bar below the conditions: what to look at, live numbers, and the way on.

use chromascope_core::query::DifferenceError;
use egui::{Align, Button, Layout, Rect, RichText, Ui, UiBuilder, Vec2};

use crate::command::{Command, TourMove};
use crate::document::{Diagram, SetKind};
use crate::figures::render::headline::{Detail, Measure};
use crate::format::fixed;
use crate::panes::context::PaneContext;
use crate::scene::{ComparedSensor, Scene};
use crate::theme::{ROW, UNIT};
use crate::view::tour::{STEPS, TourNumbers, TourStep};

pub const HEIGHT: f32 = 100.0;
const BUTTONS: f32 = 216.0;

pub fn show(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let Some((index, step)) = context.view.tour.and_then(|index| Some((index, STEPS.get(index)?))) else { return };
    let theme = context.theme;
    ui.painter().rect_filled(rect, 0.0, theme.plot);
    let inner = rect.shrink2(Vec2::new(2.0 * UNIT, UNIT));
    let words = inner.with_max_x(inner.right() - BUTTONS - 4.0 * UNIT);
    let mut left = ui.new_child(UiBuilder::new().id_salt("tour words").max_rect(words));
    left.set_clip_rect(words.intersect(ui.clip_rect()));
    left.spacing_mut().item_spacing.y = 2.0;
    left.label(RichText::new(format!("{} of {}  {}", index + 1, STEPS.len(), step.title)).strong());
    left.label(step.text);
    left.label(RichText::new(numbers(step, context)).small());
    let place = inner.with_min_x(inner.right() - BUTTONS);
    let to_left = Layout::right_to_left(Align::Center);
    let mut right = ui.new_child(UiBuilder::new().id_salt("tour buttons").max_rect(place).layout(to_left));
    let size = Vec2::new(64.0, ROW);
    let last = index + 1 == STEPS.len();
    let hint = "Your document and layout come back as they were (Esc)";
    if right.add(Button::new("End").min_size(size)).on_hover_text(hint).clicked() {
        context.push(Command::Tour(TourMove::End));
    }
    if right.add_enabled(!last, Button::new("Next").min_size(size)).clicked() {
        context.push(Command::Tour(TourMove::Next));
    }
    if right.add_enabled(index > 0, Button::new("Back").min_size(size)).clicked() {
        context.push(Command::Tour(TourMove::Back));
    }
}

fn numbers(step: &TourStep, context: &PaneContext<'_>) -> String {
    let scene = &context.scene;
    let sources = scene.sources();
    let cameras = || sources.iter().filter(|source| source.kind == SetKind::Camera && source.visible);
    let list = |parts: Vec<String>| parts.join("   ");
    match step.numbers {
        TourNumbers::LocusLengths => {
            let shown = sources.iter().filter(|source| source.is_reference).chain(cameras());
            let length = |s: &ComparedSensor| {
                let locus = scene.locus(s.kind, &s.name).ok()?;
                Some(format!("{} {}", s.label, fixed(locus.length_xy(), 3)))
            };
            format!("Length in xy:   {}", list(shown.filter_map(length).collect()))
        }
        TourNumbers::NearestTemperatures => {
            let nearest = |s: &ComparedSensor| {
                let nearest = scene.nearest_to_reference(s.kind, &s.name, Diagram::Xy)?;
                Some(format!("{} {} K", s.label, fixed(nearest.kelvin, 0)))
            };
            format!("Minimum at:   {}", list(cameras().filter_map(nearest).collect()))
        }
        TourNumbers::PatchDifferences => {
            let words = cameras().filter_map(|camera| patches_of(scene, camera));
            format!("{}:   {}", scene.difference_name(), words.collect::<Vec<_>>().join("\n"))
        }
        TourNumbers::RenderedDifferences => rendered(context),
    }
}

/// Differences of the colored patches through a camera.
fn patches_of(scene: &Scene<'_>, camera: &ComparedSensor) -> Option<String> {
    let patches = scene.patches().ok()?;
    let differences: Vec<Result<f64, DifferenceError>> = scene.differences(camera.kind, &camera.name).ok()?;
    let decimals = scene.document.difference.decimals;
    let colored = patches.patches().iter().zip(differences).filter(|(patch, _)| !patch.name.starts_with("white"));
    let words = colored.filter_map(|(patch, value)| Some(format!("{} {}", patch.name, fixed(value.ok()?, decimals))));
    Some(format!("{}: {}", camera.label, words.collect::<Vec<_>>().join(", ")))
}

/// Differences of the rendered material, once the pictures are there.
fn rendered(context: &PaneContext<'_>) -> String {
    let made = context.render_service.frame().and_then(|frame| Some((frame, frame.made()?)));
    let Some((frame, made)) = made else { return "The pictures are being rendered.".to_owned() };
    let measure = Measure::of_frame(frame);
    let pairs = frame.sources.iter().zip(made.differences).filter(|(source, _)| !source.is_reference);
    let words = pairs.filter_map(|(source, difference)| {
        let difference = difference.as_ref()?;
        Some(format!("{} {}", source.label, measure.words(difference, Detail::Number)))
    });
    format!("Facing the light:   {}", words.collect::<Vec<_>>().join("   "))
}
