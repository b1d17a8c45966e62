//! Carrying out commands. Each change of the document passes here, forwards, back or to another document: what is selected
//! follows to its new names.

use std::cmp::Ordering;
use std::path::PathBuf;
use std::sync::Arc;

use chromascope_core::query::Shared;
use chromascope_figure::{Figure, FigureRoom, Table};
use egui::ViewportCommand;
use image::RgbaImage;

use super::ChromascopeApp;
use crate::action::history::History;
use crate::action::{Action, CompareAction};
use crate::catalog::chart_picture::is_picture;
use crate::catalog::opened::{CLIPBOARD, Request};
use crate::command::Command;
use crate::document::SetKind;
use crate::document::imported::ImportedSet;
use crate::export::{self, ExportError, FigureForm};
use crate::figures::kind::{FigureKind, Need};
use crate::figures::look::FigureLook;
use crate::files::{DocumentSource, FileEvent, FileForm, SaveRequest};
use crate::panes;
use crate::profiler::{Profiler, SceneRunJob};
use crate::scene::Scene;
use crate::view::RenderMode;
use crate::view::import::{ImportItem, Stop};
use crate::view::{PickState, SavedView, Shows, Status};
use crate::workspaces::{Layout, PaneKind, Side, Slot, Workspace};

impl ChromascopeApp {
    /// Finished dialogs and writes, files that changed.
    pub(super) fn take_files(&mut self, ctx: &egui::Context) {
        for event in self.files.poll() {
            match event {
                FileEvent::Open(paths) if std::mem::take(&mut self.view.recorded.opening) => {
                    let (pictures, tables): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| is_picture(path));
                    tables.into_iter().take(1).for_each(|path| self.read_recorded(path));
                    for path in pictures {
                        self.measure_from(path);
                    }
                }
                FileEvent::Open(paths) if self.report_on.is_some() => self.begin_report(&paths),
                FileEvent::Open(paths) => self.open(paths.into_iter().map(Request::Path).collect()),
                FileEvent::Changed(paths) => self.read_changed(&paths),
                FileEvent::Said(message) => self.view.say(message),
                FileEvent::Saved(saved) => self.saved(ctx, saved),
                FileEvent::SessionSaved(file, document) => self.wrote_session(file, document),
                FileEvent::SessionChanged(path) => self.did_not_write_session(Ok(path)),
                FileEvent::SessionFailed(why) => self.did_not_write_session(Err(why)),
                FileEvent::SessionKnown(file, document) => self.know_session(file, document),
                FileEvent::Document(opened) => self.take_document(*opened),
                FileEvent::Failed(message) => self.view.fail(message),
            }
        }
    }

    pub(super) fn carry_out(&mut self, ctx: &egui::Context) {
        for command in std::mem::take(&mut self.commands) {
            self.end_tour_before(&command);
            self.carry_out_one(ctx, command);
        }
    }

    fn carry_out_one(&mut self, ctx: &egui::Context, command: Command) {
        if command.shows_panes() || command == Command::FocusSearch {
            self.view.page = None;
        }
        match command {
            Command::Do(action) => {
                let action = self.for_pictures(action);
                self.change(&action);
            }
            Command::Undo => {
                let step = self.history.undo_name().map(|name| format!("Undone: {name}."));
                self.travel(History::undo, step);
            }
            Command::Redo => {
                let step = self.history.redo_name().map(|name| format!("Redone: {name}."));
                self.travel(History::redo, step);
            }
            Command::Open | Command::OpenRecorded | Command::OpenFolder | Command::Report(_) => {
                self.ask_for_files(&command);
            }
            Command::StopReport => {
                self.stop_report();
            }
            Command::Session(command) => self.session_command(command),
            Command::OpenDocument(path) => self.open_document(DocumentSource::File(path)),
            Command::RemoveDocument(path) => {
                self.files.remove_document(&path);
                self.view.other_documents = self.files.other_documents();
            }
            Command::OpenPath(path) => self.open(vec![Request::Path(path)]),
            Command::Paste(text) => {
                let bytes = text.into_bytes().into();
                self.open(vec![Request::Bytes { name: CLIPBOARD.to_owned(), bytes }]);
            }
            Command::ShowImport(item, line) => self.show_import(item, line),
            Command::SetOverrides(item, overrides) => {
                self.view.import.tried.insert(item, *overrides);
            }
            Command::DiscardOverrides => {
                let shown = self.view.import.selected.clone();
                shown.map(|item| self.view.import.tried.remove(&item));
            }
            Command::ForgetChoices(item) => self.forget_choices(&item),
            Command::UseFile(fingerprint, overrides) => self.open(vec![Request::Known(fingerprint, overrides)]),
            Command::UseParts(fingerprint, parts, overrides) => self.use_parts(fingerprint, &parts, &overrides),
            Command::UseForAlike(item) => self.use_for_alike(&item),
            Command::ForgetFile(fingerprint) => self.opened.forget(fingerprint),
            Command::ReadAgain(name) => self.read_again(&name),
            Command::StopReading => {
                self.stop_reading();
            }
            Command::MeasureScene => self.measure(),
            Command::MeasureWorkload(workload) => Profiler::run_bench(&self.later, workload),
            Command::StopMeasuring => Profiler::stop(&self.later),
            Command::FigurePage(pane) => self.figure_page(ctx, self.pictured(pane)),
            Command::Export(pane, format) => self.export(pane, format),
            Command::ExportExr(source) => self.export_exr(&source),
            Command::CopySet(kind, name) => self.copy_set(ctx, kind, &name),
            Command::SaveSet(kind, name, form) => self.save_set(kind, &name, form),
            Command::SaveCorrection(form) => self.save_correction(form),
            Command::SaveProfile(camera, form, bytes) => self.save_profile(&camera, form, &bytes),
            Command::CopyPicture(pane) => self.copy_picture(ctx, self.pictured(pane)),
            Command::CopyCard(pane) => self.copy_card(ctx, pane),
            Command::SaveCard(pane) => self.save_card(pane),
            Command::CopyNumbers(pane) => self.copy_numbers(ctx, self.pictured(pane)),
            Command::Show(workspace) => self.show_workspace(workspace),
            Command::Maximize(pane) => self.maximize(pane),
            Command::Toggle(side) => self.toggle(side),
            Command::ResetView => self.view.reset_plots = true,
            Command::ResetLayout => {
                self.view.saved.layout = Layout::default();
                self.view.saved.tables = SavedView::default().tables;
                (self.view.maximized, self.view.card) = (None, None);
            }
            Command::SetTheme(preference) => ctx.set_theme(preference),
            Command::Look(key, place) => self.view.choose(key, place),
            Command::Select(item) => self.view.selected = Some(item),
            Command::Help(page, block) => self.view.help.open(page, block),
            Command::Tour(to) => self.tour(to),
            Command::ToggleAbout => self.view.about = !self.view.about,
            Command::FocusSearch if self.view.help.page.is_some() => self.view.help.focus_search = true,
            Command::FocusSearch => self.focus_search(),
            Command::FindAnything => self.view.palette = Some(PickState::default()),
            Command::FocusTemperature => self.view.focus_temperature = true,
            Command::ToggleSource(index) => self.toggle_source(index),
            Command::Pin => self.pin(),
            Command::ToggleDifference => self.toggle_difference(),
            Command::Escape => self.escape(),
            Command::NextPane => self.next_pane(ctx),
            Command::GoTo(pane) => self.go_to(ctx, pane),
            Command::Seek(pane, control) => self.seek(ctx, pane, control),
            Command::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
    }

    /// Leads to the filter of the library, or outside Data to the search for cameras.
    fn focus_search(&mut self) {
        if self.view.saved.workspace != Workspace::Data {
            self.view.show(PaneKind::COMPARED);
            self.view.adding = true;
        }
        (self.view.maximized, self.view.focus_search) = (None, true);
    }

    fn read_recorded(&mut self, path: PathBuf) {
        self.recorded.read_again(&path);
        self.view.recorded.path = Some(path);
    }

    fn copy_card(&mut self, ctx: &egui::Context, pane: PaneKind) {
        if let Some(card) = self.card(pane) {
            self.copy_image(ctx, pane, "card", card.picture());
        }
    }

    fn maximize(&mut self, pane: PaneKind) {
        if pane.is_controls() {
            let words = format!("{} keeps its size: click a pane with pictures, then press F.", panes::title(pane));
            return self.view.say(words);
        }
        self.view.maximized = if self.view.maximized == Some(pane) { None } else { Some(pane) };
    }

    /// A choice of light or white balance; where pictures of their own light are visible, it is for them too.
    fn for_pictures(&self, action: Action) -> Action {
        use crate::action::{ImportedAction::Use, SceneAction};
        let is_light = match &action {
            Action::Scene(scene) => matches!(
                scene,
                SceneAction::SetLight(_)
                    | SceneAction::SetFilter(..)
                    | SceneAction::ClearFilters
                    | SceneAction::SetWhite(_)
            ),
            Action::Imported(Use(kind, _)) => matches!(kind, SetKind::Illuminant | SetKind::Filter),
            _ => false,
        };
        let is_seen = self.arrangement.shows(PaneKind::RENDER);
        if is_light && is_seen && self.history.document().render.sunlight {
            return Action::ForPictures(Box::new(action));
        }
        action
    }

    fn ask_for_files(&mut self, command: &Command) {
        self.view.recorded.opening = *command == Command::OpenRecorded;
        self.report_on = None;
        match command {
            Command::Report(on) => {
                self.report_on = Some(*on);
                self.files.ask_for_folder("Folder in which the report's own folder is made");
            }
            Command::OpenFolder => self.files.ask_for_folder("Open all spectra of a folder"),
            _ => self.files.ask_to_open(),
        }
    }

    pub(super) fn show_workspace(&mut self, workspace: Workspace) {
        self.view.saved.workspace = workspace;
        (self.view.maximized, self.view.card) = (None, None);
        (self.view.column_over, self.view.numerics) = (false, false);
        // Keys and exports never refer to a pane that is not visible.
        if !self.view.focused.is_some_and(|pane| self.view.is_shown(pane)) {
            self.view.focused = self.view.saved.layout.places(workspace)[0];
        }
    }

    /// Shows what is at a side of Compare, or hides it. In a narrow window the right column overlaps the rest.
    fn toggle(&mut self, side: Side) {
        let view = &mut self.view;
        if view.saved.workspace != Workspace::Compare || view.numerics {
            return view.say("Columns are hidden in Compare only.");
        }
        view.maximized = None;
        match side {
            Side::Left => view.saved.layout.left ^= true,
            Side::Right if self.arrangement.narrow => view.column_over ^= true,
            Side::Right => view.saved.layout.right ^= true,
            Side::Lower => view.saved.layout.toggle_lower(),
        }
    }

    fn toggle_source(&mut self, index: usize) {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        if let Some(source) = scene.sources().into_iter().nth(index) {
            let action = CompareAction::SetVisible(source.kind, source.name, !source.visible);
            self.history.apply(&Action::Compare(action));
        }
    }

    /// Toggles the bars under swatches or, for pictures, the difference maps.
    fn toggle_difference(&mut self) {
        let mode = &mut self.view.saved.render.mode;
        match (self.view.focused, *mode) {
            (Some(PaneKind::RENDER), RenderMode::Difference) => *mode = RenderMode::Grid,
            (Some(PaneKind::RENDER), _) => *mode = RenderMode::Difference,
            _ => self.view.saved.difference_bars ^= true,
        }
    }

    fn pin(&mut self) {
        if self.view.focused == Some(PaneKind::RENDER)
            && self.view.selected.is_none()
            && let Some(place) = self.view.render.hovered.clone()
        {
            self.view.render.pinned = Some(place);
            return;
        }
        let Some(thing) = self.view.selected.clone() else {
            self.view.say("Select something first: click a point, a swatch or a curve.");
            return;
        };
        match self.view.pinned.iter().position(|pinned| *pinned == thing) {
            Some(index) => {
                self.view.pinned.remove(index);
            }
            None => self.view.pinned.push(thing),
        }
    }

    /// One step back: reading a mesh, palette, help, overlay, finer pictures, selection, pixel, pins, maximized pane, single
    /// picture, message.
    fn escape(&mut self) {
        if self.files.prompt_mut().take().is_some() || self.session.escape() {
            return;
        }
        if !self.view.status.offers.is_empty() && self.view.palette.is_none() {
            self.view.status = crate::view::Status::default();
            return;
        }
        if std::mem::take(&mut self.view.keeps_escape)
            || self.stop_opening()
            || self.stop_reading()
            || self.stop_report()
        {
            return;
        }
        if Profiler::busy(&self.later).is_some() {
            Profiler::stop(&self.later);
            self.view.say("Measuring stopped. Earlier results are unchanged.");
            return;
        }
        let rendering = self.arrangement.shows(PaneKind::RENDER);
        let view = &mut self.view;
        if view.palette.take().is_some() || view.help.escape() || std::mem::take(&mut view.about) {
            return;
        }
        if view.page.take().is_some() || std::mem::take(&mut view.column_over) {
            return;
        }
        if rendering && self.render_service.is_waiting() && !view.render.cancelled {
            view.render.cancelled = true;
            view.say("Rendering stopped; the pictures so far are unchanged.");
            return;
        }
        if view.cursor.take().is_some() || view.card.take().is_some() || std::mem::take(&mut view.adding) {
            return;
        }
        if view.selected.take().is_some() || (rendering && view.render.pinned.take().is_some()) {
            return;
        }
        if !std::mem::take(&mut view.pinned).is_empty() || view.maximized.take().is_some() {
            return;
        }
        let mode = &mut view.saved.render.mode;
        if rendering && *mode != RenderMode::Grid {
            *mode = RenderMode::Grid;
            return;
        }
        if std::mem::take(&mut view.numerics) {
            return;
        }
        view.by_keyboard = false;
        if view.status != crate::view::Status::default() {
            view.status = crate::view::Status::default();
            return;
        }
        self.end_tour();
    }

    fn measure(&mut self) {
        let document = self.history.document();
        let scene = Scene { document, catalog: &self.catalog, results: &self.results };
        let own = self.meshes.chosen(&document.render.mesh);
        Profiler::run(&self.later, SceneRunJob::of(&scene, own.as_ref(), self.view.saved.render.orbit));
        self.view.numerics = true;
        if matches!(self.view.shows, Shows::Bench(_)) {
            self.view.shows = Shows::default();
        }
    }

    /// Moves to the next pane, or to the next part of one that has several, with the keyboard focus.
    fn next_pane(&mut self, ctx: &egui::Context) {
        let mut shown = self.arrangement.panes.clone();
        // As they are read: column by column, from above.
        shown
            .sort_by(|(_, a), (_, b)| (a.left(), a.top()).partial_cmp(&(b.left(), b.top())).unwrap_or(Ordering::Equal));
        let shown: Vec<PaneKind> = shown.into_iter().map(|(pane, _)| pane).collect();
        let import = &mut self.view.import;
        let picks =
            self.opened.preview().and_then(|preview| preview.table.clone().ok()).is_some_and(|t| t.curves.len() > 1);
        if self.view.focused == Some(PaneKind::INTERPRETATION) && import.stop == Some(Stop::Switches) && picks {
            (import.stop, import.focus) = (Some(Stop::Picker), Some(Stop::Picker));
            return;
        }
        let now = self.view.focused.and_then(|focused| shown.iter().position(|pane| *pane == focused));
        let next = now.map_or(0, |index| (index + 1) % shown.len().max(1));
        if let Some(pane) = shown.get(next).copied() {
            self.give_keyboard(ctx, pane);
        }
    }

    /// Shows a pane, in its own workspace unless this one shows it, and gives it the keyboard.
    fn go_to(&mut self, ctx: &egui::Context, pane: PaneKind) {
        let view = &mut self.view;
        if view.maximized != Some(pane) {
            view.maximized = None;
        }
        view.show(pane);
        view.column_over = matches!(pane.slot(), Slot::Selection | Slot::Settings);
        self.give_keyboard(ctx, pane);
    }

    fn seek(&mut self, ctx: &egui::Context, pane: PaneKind, control: &'static str) {
        self.go_to(ctx, pane);
        if panes::by_kind(pane).is_some_and(|pane| pane.settings.is_some()) {
            self.view.settings_of = Some(pane);
            self.go_to(ctx, PaneKind::SETTINGS);
        }
        panes::widgets::seek(ctx, control);
    }

    fn give_keyboard(&mut self, ctx: &egui::Context, pane: PaneKind) {
        let import = &mut self.view.import;
        (self.view.focused, self.view.by_keyboard, self.view.cursor) = (Some(pane), true, None);
        import.stop = match self.view.focused {
            Some(PaneKind::IMPORT) => Some(Stop::Files),
            Some(PaneKind::INTERPRETATION) => Some(Stop::Switches),
            _ => None,
        };
        import.focus = import.stop;
        // A figure that waits for a file or a second light may have nothing to print.
        let has_all = |kind: &FigureKind| matches!(kind.needs, Need::Nothing | Need::Pictures(_));
        let figure = panes::by_kind(pane).and_then(|pane| pane.figure);
        let prints = figure.is_some_and(|kind| has_all(kind) || self.on_paper(pane).is_some());
        let keys = match (pane.is_controls(), prints) {
            (true, _) => "",
            (false, true) => " (F fills the window, Ctrl+E prints)",
            (false, false) => " (F fills the window)",
        };
        self.view.say(format!("{}{keys}", panes::title(pane)));
        // Keys that are meant for the next pane must not move what the last one had.
        ctx.memory_mut(|memory| memory.focused().map(|id| memory.surrender_focus(id)));
    }

    pub fn look(&self, pane: PaneKind, scene: &Scene<'_>) -> FigureLook {
        panes::context::look(pane, (scene, &self.view), &self.render_service, &self.profiler, &self.opened)
    }

    fn pictured(&self, pane: PaneKind) -> PaneKind {
        self.view.pictured(pane, |kind| panes::by_kind(kind).is_some_and(|pane| pane.figure.is_some()))
    }

    /// Shows a pane as the printed page, or goes back to where the page was opened.
    fn figure_page(&mut self, ctx: &egui::Context, pane: PaneKind) {
        let places = self.view.places().into_iter().flatten();
        let all = std::iter::once(pane).chain(places).chain([PaneKind::CHROMATICITY]);
        // A pane whose figure waits for data, such as curves without a file, leaves the page to another.
        let pane = all.into_iter().find(|pane| self.on_paper(*pane).is_some()).unwrap_or(pane);
        if self.view.page.take().is_none() && self.printed(pane).is_some() {
            self.view.page = Some(pane);
            self.view.say(format!("{} as it is printed. Esc goes back.", panes::title(pane)));
        }
        ctx.memory_mut(|memory| memory.focused().map(|id| memory.surrender_focus(id)));
    }

    /// The pane's figure as on screen, or a message that it has none.
    pub(super) fn figure(&mut self, pane: PaneKind) -> Option<Figure> {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let figure = panes::figure(pane, &scene, &self.look(pane, &scene), FigureRoom::default());
        self.checked(pane, figure)
    }

    /// The pane's figure on paper, or a message that it has none.
    fn printed(&mut self, pane: PaneKind) -> Option<Figure> {
        let figure = self.on_paper(pane);
        self.checked(pane, figure)
    }

    fn on_paper(&self, pane: PaneKind) -> Option<Figure> {
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        let kind = panes::by_kind(pane)?.figure?;
        kind.on_paper(&self.view.saved.page.paper, &scene, &self.look(pane, &scene))
    }

    fn checked(&mut self, pane: PaneKind, figure: Option<Figure>) -> Option<Figure> {
        if figure.is_none() {
            self.view.fail(format!("{} has no figure now.", panes::title(pane)));
        }
        figure
    }

    /// Asks where to save a pane's figure. The path's extension decides the form; the requested one is offered.
    fn export(&mut self, pane: PaneKind, form: FigureForm) {
        let Some(figure) = self.printed(pane) else { return };
        let (numbers, paper) = (self.numbers(pane, &figure), self.view.saved.page.paper);
        let shared = Arc::new((figure, numbers));
        let others = FigureForm::ALL.into_iter().filter(|other| *other != form);
        let forms = std::iter::once(form).chain(others).map(|form| {
            let shared = Arc::clone(&shared);
            let make = move || form.bytes(&shared.0, &shared.1, &paper).map_err(|error| error.to_string());
            FileForm::new(form.key(), make)
        });
        let name = format!("{}.{}", self.file_stem(pane), form.key());
        let what = format!("{} as {}", panes::title(pane), form.label());
        self.files.ask_to_save(SaveRequest::new(what, name, forms.collect()));
    }

    fn file_stem(&self, pane: PaneKind) -> String {
        let title = panes::title(pane).to_lowercase();
        match (pane, self.view.shows) {
            (PaneKind::METHODS, Shows::Bench(workload)) => workload.key().to_owned(),
            (PaneKind::METHODS, Shows::Scene(subject)) => format!("{title}-{}", subject.title().to_lowercase()),
            _ => title,
        }
    }

    fn copy_picture(&mut self, ctx: &egui::Context, pane: PaneKind) {
        let Some(figure) = self.printed(pane) else { return };
        let paper = self.view.saved.page.paper;
        let picture = export::png(&export::svg(&figure, &paper.colors(), paper), paper.pixels_per_point());
        self.copy_image(ctx, pane, "picture", picture);
    }

    /// Puts a picture of a pane on the clipboard, and says so.
    fn copy_image(&mut self, ctx: &egui::Context, pane: PaneKind, what: &str, made: Result<RgbaImage, ExportError>) {
        match made {
            Ok(picture) => {
                let size = [picture.width() as usize, picture.height() as usize];
                ctx.copy_image(egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw()));
                let [width, height] = size;
                self.view.say(format!("{}: {what} copied, {width} × {height} pixels.", panes::title(pane)));
            }
            Err(error) => self.view.fail(error.to_string()),
        }
    }

    fn copy_numbers(&mut self, ctx: &egui::Context, pane: PaneKind) {
        if let Some(figure) = self.figure(pane) {
            ctx.copy_text(self.numbers(pane, &figure).to_tsv());
            self.view.say(format!("{}: {} rows of numbers copied.", panes::title(pane), figure.table.rows.len()));
        }
    }

    /// The numbers of a pane as they leave the program: with the conditions they were made under, where they depend on them.
    fn numbers(&self, pane: PaneKind, figure: &Figure) -> Table {
        if !panes::by_kind(pane).is_some_and(|pane| pane.under_conditions) {
            return figure.table.clone();
        }
        let scene = Scene { document: self.history.document(), catalog: &self.catalog, results: &self.results };
        figure.table.clone().with_constants(scene.conditions())
    }

    pub(super) fn autosave(&mut self, ctx: &egui::Context) {
        let document = self.interrupted.as_ref().map_or(&self.history, |own| &own.history).document();
        self.files.autosave(document, ctx);
    }

    pub fn compares(&self, kind: SetKind, name: &str) -> bool {
        self.history.document().compared(kind, name).is_some()
    }
}

impl ChromascopeApp {
    pub(super) fn change(&mut self, action: &Action) {
        self.step(|history| history.apply(action));
    }

    /// Goes to another state of the document; the selection in Import follows sets to their new names, and sensors that are
    /// no longer compared are deselected.
    pub(super) fn step(&mut self, go: impl FnOnce(&mut History)) {
        let before = self.history.document();
        let (own, compared) = (before.own.clone(), before.compared.clone());
        go(&mut self.history);
        self.view.let_go_of_removed(&compared, &self.history.document().compared);
        self.view.import.follow_names(&own, &self.history.document().own);
        self.follow_selection(&own);
    }

    /// Keeps the same contents visible when a step turned the selected file into a set, or removed that set.
    fn follow_selection(&mut self, before: &[Shared<ImportedSet>]) {
        let own = &self.history.document().own;
        let now = match &self.view.import.selected {
            Some(ImportItem::Set(name)) if !own.iter().any(|set| set.name == *name) => {
                let gone = before.iter().find(|set| set.name == *name).and_then(|set| set.fingerprint);
                gone.filter(|file| self.opened.file(*file).is_some()).map(ImportItem::File)
            }
            Some(ImportItem::File(file)) => {
                let made = own.iter().find(|set| set.fingerprint == Some(*file));
                made.map(|set| ImportItem::Set(set.name.clone()))
            }
            _ => None,
        };
        if let Some(now) = now {
            self.view.import.select(now);
        }
    }

    /// Undoes or redoes a step. Messages about a step that was undone are cleared.
    pub(super) fn travel(&mut self, go: impl FnOnce(&mut History), words: Option<String>) {
        let before = self.history.document().clone();
        self.step(go);
        if before != *self.history.document() {
            // Earlier messages may refer to something that no longer exists.
            self.view.status = Status::default();
            self.view.say(words.unwrap_or_default());
        }
    }
}
