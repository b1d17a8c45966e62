//! Menus, tabs of the workspaces, undo and redo, the command palette.

use egui::{Align, Atom, Button, Layout, Rect, Ui, UiBuilder, Vec2};

use super::context::PaneContext;
use crate::action::Action;
use crate::action::history::History;
use crate::command::{Command, REPORTS, SessionCommand, THEMES, TourMove, shortcut_of};
use crate::document::start::Start;
use crate::export::FigureForm;
use crate::export::profile::CorrectionForm;
use crate::panes::widgets::{self, Icon, conditions, icon_button, pick_list};
use crate::theme::{Surround, UNIT};
use crate::view::template::TEMPLATES;
use crate::view::tour::Tour;
use crate::workspaces::{PaneKind, Side, Workspace};

const GUTTER: Vec2 = Vec2::new(14.0, 12.0);

pub fn show(ui: &mut Ui, rect: Rect, history: &History, context: &mut PaneContext<'_>) {
    let layout = Layout::left_to_right(Align::Center);
    let inner = rect.shrink2(Vec2::new(UNIT, 0.0));
    let mut bar = ui.new_child(UiBuilder::new().id_salt("menu bar").max_rect(inner).layout(layout));
    let menus = egui::MenuBar::new().ui(&mut bar, |ui| {
        ui.menu_button("File", |ui| file(ui, context));
        ui.menu_button("Edit", |ui| edit(ui, history, context));
        ui.menu_button("View", |ui| view(ui, context));
        ui.menu_button("Help", |ui| help(ui, context)).response.rect.max.x
    });
    let beside = rect.with_min_x(menus.inner + 4.0 * UNIT);
    tabs(&mut ui.new_child(UiBuilder::new().id_salt("tabs").max_rect(beside).layout(layout)), rect, context);
    let to_left = Layout::right_to_left(Align::Center);
    let mut right = ui.new_child(UiBuilder::new().id_salt("menu right").max_rect(inner).layout(to_left));
    let find = Button::new("Find anything").shortcut_text("Ctrl+K");
    if right.add(find).on_hover_text("Find a command or a data set by name").clicked() {
        context.push(Command::FindAnything);
    }
    step_button(&mut right, true, history.redo_name(), context);
    step_button(&mut right, false, history.undo_name(), context);
}

fn tabs(ui: &mut Ui, rect: Rect, context: &mut PaneContext<'_>) {
    let theme = context.theme;
    for workspace in Workspace::ALL {
        let on = context.view.saved.workspace == workspace && !context.view.numerics;
        let fill = if on { theme.control } else { theme.panel };
        let response =
            ui.add(Button::selectable(on, workspace.label()).fill(fill).min_size(Vec2::new(72.0, rect.height())));
        if workspace == Workspace::Data {
            unseen_dot(ui, &response, context);
        }
        if on {
            ui.painter().hline(response.rect.x_range(), rect.top() + 1.0, egui::Stroke::new(2.0, theme.text));
        }
        if response.clicked() {
            context.push(Command::Show(workspace));
        }
    }
}

fn unseen_dot(ui: &Ui, tab: &egui::Response, context: &PaneContext<'_>) {
    let count = context.view.import.unseen.len();
    if count == 0 {
        return;
    }
    ui.painter().circle_filled(tab.rect.right_top() + Vec2::new(-7.0, 9.0), 3.0, context.theme.warning);
    let files = if count == 1 { "1 file".to_owned() } else { format!("{count} files") };
    let words = format!("Data: {files} to check");
    widgets::labeled(tab, egui::Role::Button, &words);
    tab.clone().on_hover_text(words);
}

fn step_button(ui: &mut Ui, forward: bool, step: Option<&str>, context: &mut PaneContext<'_>) {
    let (icon, word, command) =
        if forward { (Icon::Redo, "Redo", Command::Redo) } else { (Icon::Undo, "Undo", Command::Undo) };
    let name = step.map_or_else(|| format!("Nothing to {}", word.to_lowercase()), |step| format!("{word}: {step}"));
    let response = ui.add_enabled_ui(step.is_some(), |ui| icon_button(ui, icon, &name)).inner;
    if response.on_disabled_hover_text(&name).clicked() {
        context.push(command);
    }
}

fn item(ui: &mut Ui, words: &str, command: Command, context: &mut PaneContext<'_>) {
    enabled_item(ui, true, words, command, context);
}

fn enabled_item(ui: &mut Ui, enabled: bool, words: &str, command: Command, context: &mut PaneContext<'_>) {
    let button = keyed(ui, Button::new(words), &command, context);
    if ui.add_enabled(enabled, button).clicked() {
        context.push(command);
        ui.close();
    }
}

fn keyed<'a>(ui: &Ui, button: Button<'a>, command: &Command, context: &PaneContext<'_>) -> Button<'a> {
    match shortcut_of(command, focused(context)) {
        Some(shortcut) => button.shortcut_text(ui.ctx().format_shortcut(&shortcut)),
        None => button,
    }
}

fn focused(context: &PaneContext<'_>) -> PaneKind {
    context.view.keyed()
}

fn pictured(context: &PaneContext<'_>) -> PaneKind {
    context.view.pictured(focused(context), |kind| context.pane(kind).is_some_and(|pane| pane.figure.is_some()))
}

fn file(ui: &mut Ui, context: &mut PaneContext<'_>) {
    item(ui, "New", SessionCommand::New(None).into(), context);
    ui.menu_button("New from template", |ui| templates(ui, context));
    ui.separator();
    item(ui, "Open…", Command::Open, context);
    item(ui, "Open folder…", Command::OpenFolder, context);
    item(ui, "Measure a camera from a photograph", Command::GoTo(PaneKind::MEASURE), context);
    let recent = context.view.saved.recent.clone();
    if !recent.is_empty() {
        ui.menu_button("Open recent", |ui| {
            for path in recent {
                let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
                context.item(ui, &name, &path.display().to_string(), Command::OpenPath(path));
            }
        });
    }
    let kept = context.view.other_documents.clone();
    if !kept.is_empty() {
        ui.menu_button("Recovered documents", |ui| {
            for (path, age) in kept {
                let words = format!("Document of another window, {age}");
                let menu = ui.menu_button(words, |ui| {
                    let hint = "The current document is saved here first";
                    context.item(ui, "Open", hint, Command::OpenDocument(path.clone()));
                    context.item(ui, "Delete", "", Command::RemoveDocument(path.clone()));
                });
                menu.response.on_hover_text(path.display().to_string());
            }
        });
    }
    ui.separator();
    item(ui, "Save", SessionCommand::Save.into(), context);
    item(ui, "Save as…", SessionCommand::SaveAs.into(), context);
    item(ui, "Save as template…", SessionCommand::SaveTemplate.into(), context);
    ui.separator();
    if ui.add(Button::new("Paste data").shortcut_text("Ctrl+V")).clicked() {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::RequestPaste);
        ui.close();
    }
    ui.separator();
    let pane = pictured(context);
    let words = format!("Figure page of {}", context.title(pane));
    item(ui, &words, Command::FigurePage(pane), context);
    for form in [FigureForm::Pdf, FigureForm::Svg, FigureForm::Png] {
        let words = format!("Export {} as {}…", context.title(pane), form.label());
        item(ui, &words, Command::Export(pane, form), context);
    }
    item(ui, &format!("Export numbers of {}…", context.title(pane)), Command::Export(pane, FigureForm::Csv), context);
    if let Some(camera) = context.view.camera(&context.scene) {
        ui.menu_button(format!("Color correction of {}", camera.name), |ui| {
            for form in CorrectionForm::ALL {
                item(ui, form.words().0, Command::SaveCorrection(form), context);
            }
        });
    }
    ui.menu_button("Report", |ui| {
        for (on, words) in REPORTS {
            item(ui, words, Command::Report(on), context);
        }
    });
    ui.separator();
    if ui.add(Button::new("Quit").shortcut_text("Ctrl+Q")).clicked() {
        context.push(Command::Quit);
    }
}

fn templates(ui: &mut Ui, context: &mut PaneContext<'_>) {
    for template in &TEMPLATES {
        let response = ui.button(template.name);
        let mut beside = egui::Tooltip::for_enabled(&response);
        // Not over the next entries.
        beside.popup = beside.popup.align(egui::RectAlign::RIGHT_START);
        beside.show(|ui| ui.label(template.summary));
        if response.clicked() {
            context.push(SessionCommand::New(Some(template.name)));
            ui.close();
        }
    }
    let own = context.view.templates.clone();
    if !own.is_empty() {
        ui.separator();
    }
    for (name, path) in own {
        let menu = ui.menu_button(name, |ui| {
            for (words, command) in [
                ("New", SessionCommand::NewFrom(path.clone())),
                ("Delete", SessionCommand::RemoveTemplate(path.clone())),
            ] {
                context.item(ui, words, "", command);
            }
        });
        menu.response.on_hover_text(path.display().to_string());
    }
}

fn edit(ui: &mut Ui, history: &History, context: &mut PaneContext<'_>) {
    let named =
        |word: &str, step: Option<&str>| step.map_or_else(|| word.to_owned(), |step| format!("{word} ({step})"));
    enabled_item(ui, history.undo_name().is_some(), &named("Undo", history.undo_name()), Command::Undo, context);
    enabled_item(ui, history.redo_name().is_some(), &named("Redo", history.redo_name()), Command::Redo, context);
    ui.separator();
    let pane = pictured(context);
    if ui.add(Button::new(format!("Copy numbers of {}", context.title(pane))).shortcut_text("Ctrl+C")).clicked() {
        context.push(Command::CopyNumbers(pane));
        ui.close();
    }
    item(ui, &format!("Copy picture of {}", context.title(pane)), Command::CopyPicture(pane), context);
    item(ui, &format!("Copy {} as card", context.title(pane)), Command::CopyCard(pane), context);
    ui.separator();
    item(ui, "Pin the selection", Command::Pin, context);
    item(ui, "Find anything…", Command::FindAnything, context);
    ui.separator();
    for start in Start::ALL {
        item(ui, &format!("Start: {}", start.label()), Command::Do(Action::Start(start)), context);
    }
    item(ui, "Reset to the first screen", Command::Do(Action::Reset), context);
}

fn gutter(on: bool) -> Atom<'static> {
    Atom::paint(GUTTER, move |ui, place| {
        if on {
            pick_list::tick(ui.painter(), place.rect.center(), place.fallback_text_color);
        }
    })
}

fn ticked(ui: &mut Ui, on: bool, words: &str, hint: &str, command: impl Into<Command>, context: &mut PaneContext<'_>) {
    let command = command.into();
    let button = keyed(ui, Button::new((gutter(on), words)), &command, context);
    let mut response = ui.add(button);
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, on, words));
    if !hint.is_empty() {
        response = response.on_hover_text(hint);
    }
    if response.clicked() {
        context.push(command);
        ui.close();
    }
}

fn sides(ui: &mut Ui, context: &mut PaneContext<'_>) {
    let layout = &context.view.saved.layout;
    let right = if context.view.column_over { true } else { layout.right };
    for (side, on, words) in [
        (Side::Left, layout.left, "Compared sensors"),
        (Side::Right, right, "Selection and settings"),
        (Side::Lower, layout.compare[1].is_some(), "Lower view"),
    ] {
        ticked(ui, on, words, "", Command::Toggle(side), context);
    }
}

fn view(ui: &mut Ui, context: &mut PaneContext<'_>) {
    if context.view.saved.workspace == Workspace::Compare {
        sides(ui, context);
        ui.separator();
    }
    let pane = focused(context);
    let maximized = context.view.maximized == Some(pane);
    if !pane.is_controls() {
        ticked(ui, maximized, &format!("Maximize {}", context.title(pane)), "", Command::Maximize(pane), context);
    }
    ticked(ui, false, "Reset view", "", Command::ResetView, context);
    ticked(ui, false, "Reset layout", "", Command::ResetLayout, context);
    ui.separator();
    ui.menu_button((gutter(false), "Difference"), |ui| {
        for (line, action) in conditions::differences(&context.scene) {
            if let Some(action) = action {
                ticked(ui, line.on, &line.words, &line.note, action, context);
            }
        }
        ui.separator();
        let bars = context.view.saved.difference_bars;
        ticked(ui, bars, "Bars under swatches", "", Command::ToggleDifference, context);
    });
    ui.menu_button((gutter(false), "Theme"), |ui| {
        let now = ui.ctx().options(|options| options.theme_preference);
        for (preference, words) in THEMES {
            ticked(ui, now == preference, words, "", Command::SetTheme(preference), context);
        }
    });
    let still = context.view.saved.reduced_motion;
    ticked(ui, still, "Reduce motion", "", Command::Look("reduced_motion", usize::from(!still)), context);
    ui.menu_button((gutter(false), "Surround of swatches"), |ui| {
        for (place, surround) in Surround::ALL.into_iter().enumerate() {
            let on = context.view.saved.surround == surround;
            ticked(ui, on, surround.label(), "", Command::Look("surround", place), context);
        }
    });
}

fn help(ui: &mut Ui, context: &mut PaneContext<'_>) {
    for tour in Tour::ALL {
        item(ui, tour.label(), Command::Tour(TourMove::Begin(tour)), context);
    }
    ui.separator();
    for page in crate::help::pages() {
        item(ui, &page.title, Command::Help(page.name, 0), context);
    }
    ui.separator();
    item(ui, "Numerics", Command::GoTo(PaneKind::METHODS), context);
    item(ui, "About Chromascope", Command::ToggleAbout, context);
}
