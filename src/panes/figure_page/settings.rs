//! Settings of the paper, and what to do with the page.

use chromascope_text::{Look, Number, Pick, Setting, Settings as _, Value};
use egui::{DragValue, Rect, Response, ScrollArea, Ui};

use super::inside;
use crate::command::Command;
use crate::export::page::PageFacts;
use crate::export::paper::{LOOK, SIZE};
use crate::export::{FigureForm, Paper};
use crate::panes::context::PaneContext;
use crate::panes::widgets;
use crate::panes::widgets::pick_list::{self, Line};
use crate::theme::{ROW, UNIT};
use crate::view::{LengthUnit, PageLook};
use crate::workspaces::PaneKind;

const NAMES: f32 = 72.0;
const WIDTHS: [(f64, &str); 2] =
    [(Paper::ONE_COLUMN_MM, "One column, 85 mm"), (Paper::TWO_COLUMNS_MM, "Two columns, 174 mm")];

pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    (kind, facts): (PaneKind, Option<PageFacts>),
    context: &mut PaneContext<'_>,
) {
    let mut child = inside(ui, "page settings", rect);
    ScrollArea::vertical().id_salt("page settings").auto_shrink(false).show(&mut child, |ui| {
        ui.set_max_width(rect.width() - 5.0 * UNIT);
        ui.add_space(UNIT);
        ui.strong(format!("Figure: {}", context.title(kind)));
        let before = context.view.saved.page;
        let mut look = before;
        size(ui, &mut look, facts, context);
        ui.add_space(UNIT);
        dress(ui, &mut look.paper, (kind, facts), context);
        if look != before {
            context.view.saved.page = look;
            ui.ctx().request_repaint();
        }
        ui.add_space(2.0 * UNIT);
        buttons(ui, kind, context);
        ui.add_space(UNIT);
        if let Some(facts) = facts {
            widgets::note(ui, in_words(&facts, &look.paper));
        }
        ui.add_space(2.0 * UNIT);
    });
}

/// Size of page, text and lines, and the resolution of pixels.
fn size(ui: &mut Ui, look: &mut PageLook, facts: Option<PageFacts>, context: &mut PaneContext<'_>) {
    let paper = &mut look.paper;
    let preset = WIDTHS.iter().find(|(mm, _)| paper.width_mm == Some(*mm) && paper.height_mm.is_none());
    let shown = preset.map_or("Own size", |(_, words)| words);
    let words = WIDTHS.map(|(_, words)| words);
    let (combo, chosen) = drop_down(ui, ("Size", "Width of the page"), shown, &words, context);
    if let Some(index) = chosen {
        (paper.width_mm, paper.height_mm) = (Some(WIDTHS[index].0), None);
    }
    if std::mem::take(&mut context.view.tab_enters) {
        combo.request_focus();
    }
    let size = facts.map_or([Paper::ONE_COLUMN_MM; 2], |facts| facts.size_mm());
    ui.horizontal(|ui| {
        let mut width = paper.width_mm.unwrap_or(size[0]);
        if length(ui, "Width", &mut width, look.unit) {
            paper.width_mm = Some(width);
        }
        for unit in LengthUnit::ALL {
            ui.selectable_value(&mut look.unit, unit, unit.label());
        }
    });
    ui.horizontal(|ui| {
        let mut height = paper.height_mm.unwrap_or(size[1]);
        if length(ui, "Height", &mut height, look.unit) {
            paper.height_mm = Some(height);
        }
        let mut own = paper.height_mm.is_none();
        let hint = "The height that the figure has at this width";
        if ui.checkbox(&mut own, "Automatic").on_hover_text(hint).changed() {
            paper.height_mm = (!own).then_some(height);
        }
    });
    ui.horizontal_wrapped(|ui| {
        for setting in Paper::ALL.iter().filter(|setting| setting.group == SIZE) {
            if let Value::Number(value) = &setting.value
                && value.step.is_some()
            {
                number(ui, setting, value, paper);
            }
        }
    });
}

/// Style, legend, axes and what is left out.
fn dress(ui: &mut Ui, paper: &mut Paper, (kind, facts): (PaneKind, Option<PageFacts>), context: &PaneContext<'_>) {
    let is_diagram = kind == PaneKind::CHROMATICITY;
    let has = |key: &str| match key {
        "legend" => facts.is_some_and(|facts| facts.has_legend),
        "axis_titles" => facts.is_some_and(|facts| facts.has_titles),
        "ranges" => is_diagram || context.view.zoomed.contains_key(&kind),
        "numbers" | "strip" | "patches" | "loci" => is_diagram,
        "x_range" | "y_range" => facts.is_some_and(|facts| facts.has_plot),
        _ => true,
    };
    for setting in Paper::ALL.iter().filter(|setting| setting.group == LOOK && has(setting.key)) {
        match &setting.value {
            Value::Choice(pick) => choice(ui, setting, pick, paper, context),
            Value::Switch(get, set) => {
                let mut on = get(paper);
                if ui.checkbox(&mut on, setting.name).changed() {
                    set(paper, on);
                }
            }
            Value::Pair(pair) => ends(ui, setting, &pair[..], paper, context),
            _ => {}
        }
    }
}

/// Ends of an axis; equal ones for the figure's own.
fn ends(
    ui: &mut Ui,
    setting: &Setting<Paper>,
    pair: &[(&str, &str, Number<Paper>)],
    paper: &mut Paper,
    context: &PaneContext<'_>,
) {
    row(ui, setting.name, context, |ui| {
        for (name, hint, number) in pair {
            let mut value = (number.get)(paper);
            let [low, high] = number.slider;
            let field =
                DragValue::new(&mut value).range(low..=high).speed(0.01).max_decimals(4).prefix(format!("{name} "));
            let hint = format!("{}: {hint}. {}", setting.name, setting.help);
            if ui.add(field.update_while_editing(false)).on_hover_text(hint).changed() {
                (number.set)(paper, value);
            }
        }
    });
}

fn buttons(ui: &mut Ui, kind: PaneKind, context: &mut PaneContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let mut save = |ui: &mut Ui, words: &str, form: FigureForm| {
            let hint = if form.is_numbers() { "The numbers behind the figure" } else { "The figure as shown here" };
            context.item(ui, words, hint, Command::Export(kind, form));
        };
        let [pdf, svg, png, rest @ ..] = FigureForm::ALL;
        save(ui, &format!("Save {}…", pdf.label()), pdf);
        save(ui, &format!("{}…", svg.label()), svg);
        save(ui, &format!("{}…", png.label()), png);
        ui.menu_button("More", |ui| {
            for form in rest {
                save(ui, &format!("{}…", form.label()), form);
            }
        });
    });
    ui.horizontal(|ui| {
        context.button(ui, "Copy picture", "At this resolution (Ctrl+Shift+C)", Command::CopyPicture(kind));
        context.button(ui, "Done", "Back to the panes (Esc)", Command::FigurePage(kind));
    });
}

/// Measures of the page in a sentence or two.
fn in_words(facts: &PageFacts, paper: &Paper) -> String {
    let [width, height] = facts.size_mm();
    let measures = [
        Some(format!("{width:.0} × {height:.0} mm")),
        facts.smallest_text_pt.map(|points| format!("smallest text {points:.1} pt")),
        facts.thinnest_line_pt.map(|points| format!("thinnest line {points:.2} pt")),
    ];
    let measures: Vec<String> = measures.into_iter().flatten().collect();
    let own_height = paper.height_mm.is_some_and(|wanted| (height - wanted).abs() > 1.0);
    let own_height = if own_height { " Its rows or pictures have their own height." } else { "" };
    let apart = facts.lightness_apart.map_or_else(String::new, |apart| {
        let told = if apart < PageFacts::TOLD_APART { "not told apart" } else { "told apart" };
        format!(" Without color, the inks of the legend are {told} (least ΔL* {apart:.0}).")
    });
    format!("{}.{own_height}{apart}", measures.join(", "))
}

fn row<R>(ui: &mut Ui, name: &str, context: &PaneContext<'_>, control: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        let (place, _) = ui.allocate_exact_size(egui::vec2(NAMES, ROW), egui::Sense::hover());
        widgets::lines::elided(ui, place, name, egui::TextStyle::Small, context.theme.weak);
        control(ui)
    })
    .inner
}

fn choice(ui: &mut Ui, setting: &Setting<Paper>, pick: &Pick<Paper>, paper: &mut Paper, context: &PaneContext<'_>) {
    let (all, now) = ((pick.all)(), (pick.get)(paper));
    let chosen = if pick.look == Look::List {
        let words: Vec<&str> = all.iter().map(|words| words.label).collect();
        let hint = all[now].why;
        drop_down(ui, (setting.name, hint), all[now].label, &words, context).1
    } else {
        let lines: Vec<_> = all.iter().enumerate().map(|(index, words)| (index, words.label, words.why)).collect();
        row(ui, setting.name, context, |ui| widgets::segmented(ui, &lines, now))
    };
    if let Some(index) = chosen {
        (pick.set)(paper, index);
    }
}

fn drop_down(
    ui: &mut Ui,
    words: (&str, &str),
    shown: &str,
    lines: &[&str],
    context: &PaneContext<'_>,
) -> (Response, Option<usize>) {
    row(ui, words.0, context, |ui| {
        let lines = || lines.iter().map(|line| Line::new(*line, *line == shown)).collect();
        pick_list::combo(ui, words, shown, 190.0, &context.theme, lines)
    })
}

fn length(ui: &mut Ui, name: &str, mm: &mut f64, unit: LengthUnit) -> bool {
    let (mut value, [low, high]) = (*mm / unit.mm(), Paper::SIDE_MM.map(|mm| mm / unit.mm()));
    let (speed, decimals) = if unit == LengthUnit::Inch { (0.01, 2) } else { (0.5, 1) };
    let field = DragValue::new(&mut value)
        .range(low..=high)
        .speed(speed)
        .max_decimals(decimals)
        .custom_formatter(|value, _| short(value))
        .suffix(format!(" {}", unit.label()))
        .update_while_editing(false);
    let label = ui.label(name);
    let changed = ui.add(field).labelled_by(label.id).changed();
    if changed {
        *mm = value * unit.mm();
    }
    changed
}

fn number(ui: &mut Ui, setting: &Setting<Paper>, number: &Number<Paper>, paper: &mut Paper) {
    let mut value = (number.get)(paper);
    let [low, high] = number.slider;
    let field = DragValue::new(&mut value)
        .range(low..=high)
        .speed(number.step.unwrap_or(1.0))
        .max_decimals(2)
        .custom_formatter(|value, _| short(value))
        .suffix(number.unit)
        .update_while_editing(false);
    let label = ui.label(setting.name);
    if ui.add(field).labelled_by(label.id).on_hover_text(setting.help).changed() {
        (number.set)(paper, value);
    }
}

fn short(value: f64) -> String {
    format!("{}", (100.0 * value).round() / 100.0)
}
