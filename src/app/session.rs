//! The session as a file: its name and mark in the title, saving, changes by other programs, templates; and closing of the
//! window, once everything is saved or the user decides otherwise.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use egui::{Align2, Context, Key, RichText, TextEdit, Ui, Vec2, ViewportCommand};

use super::ChromascopeApp;
use crate::action::history::History;
use crate::command::{Command, SessionCommand};
use crate::document::imported::Fingerprint;
use crate::document::{Document, SessionFile, session};
use crate::files::{DocumentSource, FileForm, MakeBytes, OpenedDocument, SaveRequest, SavedFile, template_name};
use crate::panes::{self, widgets};
use crate::theme::Theme;
use crate::view::template::{TEMPLATES, Template};
use crate::view::{Offer, SavedView, Weight};
use crate::workspaces::PaneKind;

/// Description of the session where it is saved under a name.
const SESSION: &str = "the session";
/// Description of the document where it is saved elsewhere.
const DOCUMENT: &str = "the document";
const WIDTH: f32 = 420.0;

#[derive(Default)]
pub(super) struct SessionState {
    /// Files as this window last read or wrote them, with their documents.
    known: HashMap<PathBuf, (Fingerprint, Arc<Document>)>,
    /// True while the file is written, and true if it is to be written once more after that.
    writing: [bool; 2],
    /// The document that is being saved under a name.
    named: Option<Arc<Document>>,
    /// A file that another program wrote to, about which the user is asked.
    changed: Option<PathBuf>,
    template: Option<String>,
    title: String,
    /// The document that was compared with its file last, and the result.
    compared: Option<(Document, bool)>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Closing {
    #[default]
    No,
    /// The user is asked about changes that could not be saved.
    Asked,
    /// A path prompt is open, for the document as it was then.
    Elsewhere(Arc<Document>),
    /// Nothing holds it up.
    Agreed,
}

impl SessionState {
    /// Drops what is still asked or to be written, because another document takes the place of this one.
    fn end_saving(&mut self) {
        (self.writing[1], self.named, self.changed, self.template) = (false, None, None, None);
    }

    /// Closes an open question; returns whether there was one.
    pub(super) fn escape(&mut self) -> bool {
        self.changed.take().is_some() | self.template.take().is_some()
    }
}

impl ChromascopeApp {
    /// The user's own document, also while the tour is played.
    pub(super) fn own_document(&self) -> &Document {
        self.interrupted.as_ref().map_or(&self.history, |own| &own.history).document()
    }

    fn own_history(&mut self) -> &mut History {
        self.interrupted.as_mut().map_or(&mut self.history, |own| &mut own.history)
    }

    /// Looks at the file of the session that the program begins with.
    pub(super) fn begin_session(&mut self) {
        self.view.templates = self.files.templates();
        if self.history.document().session.is_some() {
            self.files.look_at_session(self.history.document().clone());
        }
    }

    pub(super) fn know_session(&mut self, file: SessionFile, document: Arc<Document>) {
        self.session.known.insert(file.path, (file.fingerprint, document));
        self.session.compared = None;
    }

    /// True if the document has changes that its file has not, or no file.
    fn is_unsaved(&mut self) -> bool {
        // By fields: the result is noted beside it.
        let document = self.interrupted.as_ref().map_or(&self.history, |own| &own.history).document();
        match &self.session.compared {
            Some((known, unsaved)) if known == document => *unsaved,
            _ => {
                let known = document.session.as_ref().and_then(|file| self.session.known.get(&file.path));
                let unsaved = known.is_none_or(|(_, saved)| !saved.is_same_session(document));
                self.session.compared = Some((document.clone(), unsaved));
                unsaved
            }
        }
    }

    pub(super) fn show_title(&mut self, ctx: &Context) {
        let unsaved = self.is_unsaved();
        let document = self.own_document();
        let title = match &document.session {
            Some(file) => {
                let name = file.path.file_stem().unwrap_or_default().to_string_lossy();
                format!("{}{name} – Chromascope", if unsaved { "*" } else { "" })
            }
            None if *document == document.start.document() => "Chromascope".to_owned(),
            None => "*Untitled – Chromascope".to_owned(),
        };
        if title != self.session.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.session.title = title;
        }
    }

    pub fn title(&self) -> &str {
        &self.session.title
    }

    /// Opens a document in place of this one. This one is saved on its own if its file has not all of it.
    pub(super) fn open_document(&mut self, source: DocumentSource) {
        let is_safe = !self.is_unsaved();
        let recent = self.view.saved.recent.clone();
        self.files.open_document(source, self.history.document().clone(), is_safe, recent);
    }

    pub(super) fn session_command(&mut self, command: SessionCommand) {
        match command {
            SessionCommand::New(template) => self.new_session(template),
            SessionCommand::NewFrom(path) => self.open_document(DocumentSource::Template(path)),
            SessionCommand::Save => self.save_session(false),
            SessionCommand::SaveAs => self.save_session_as(),
            SessionCommand::SaveTemplate => self.session.template = Some(String::new()),
            SessionCommand::RemoveTemplate(path) => {
                self.files.remove_template(&path);
                self.view.templates = self.files.templates();
            }
        }
    }

    fn new_session(&mut self, template: Option<&'static str>) {
        let known = template.and_then(|name| TEMPLATES.iter().find(|template| template.name == name));
        let document = known.map_or_else(Document::default, Template::document);
        self.open_document(DocumentSource::New(known.map_or("New session", |known| known.name), Box::new(document)));
    }

    /// Puts a document that was read in the place of this one, as one step.
    pub(super) fn take_document(&mut self, opened: OpenedDocument) {
        self.end_tour();
        let OpenedDocument { source, mut document, newer, aside, lost, other, before } = opened;
        if before != *self.history.document() {
            // The document changed meanwhile: its current state is saved.
            return self.open_document(source);
        }
        let name = source.name();
        let mut newer: Vec<String> = newer.map(|newer| format!("It was {newer}")).into_iter().collect();
        let earlier = session::peek_view(&document);
        if let Some((mut view, refused)) = session::take_view::<SavedView>(&mut document) {
            view.mend(|pane| panes::by_kind(pane).is_some());
            if let Some(earlier) = &earlier {
                view.open_earlier(earlier);
            }
            (self.view.numerics, self.view.card) = (false, None);
            self.view.saved.take_session(view);
            if !refused.is_empty() {
                newer.push(format!("Parts of its view are not understood: {}.", refused.join(", ")));
            }
        }
        // Ranges of axes and the order of tables are those of the document before.
        self.view.reset_plots = true;
        self.view.maximized = None;
        if matches!(source, DocumentSource::New(..)) {
            for look in self.view.saved.looks.values_mut() {
                (look.sorting, look.filter) = (None, String::new());
            }
        }
        document.part_names(self.catalog.names());
        // Questions and writes that are under way are about the document before.
        self.session.end_saving();
        let (step, words) = match &source {
            DocumentSource::File(path) => {
                self.view.remember_file(path.clone());
                (format!("Open {name}"), format!("Opened {name}."))
            }
            _ => (format!("New: {name}"), format!("Began {name}.")),
        };
        if let Some(file) = document.session.clone() {
            self.know_session(file, Arc::new(document.clone()));
        }
        self.step(|history| history.replace(step, document));
        let saved = if aside { " The previous document was saved: File, Recovered documents." } else { "" };
        let words = format!("{words}{saved} Ctrl+Z undoes this.");
        match lost.first() {
            None if newer.is_empty() => self.view.say(words),
            None => {
                self.view.say(format!("{words} {}", newer.join(" ")));
                self.view.status.weight = Weight::Warning;
            }
            Some(first) => self.view.fail(format!("{words} Parts that could not be read are missing: {first}.")),
        }
        if let Some(first) = other.first() {
            let which = match other.len() {
                1 => format!("{} differs", crate::format::file_name(first)),
                count => format!("{count} files differ"),
            };
            self.view.status.text += &[" ", &which, " here: the session's own curves are used."].concat();
            self.view.offer(other.into_iter().map(Offer::Open).collect(), true);
        }
        if let DocumentSource::New(name, _) = source
            && let Some(template) = TEMPLATES.iter().find(|template| template.name == name)
        {
            // How the session before was looked at could hide the answer.
            let fresh = SavedView::default();
            self.view.saved = SavedView {
                metrics: fresh.metrics,
                tables: fresh.tables,
                diagram_fit: fresh.diagram_fit,
                swatch_layout: fresh.swatch_layout,
                swatch_style: fresh.swatch_style,
                spectra_layout: fresh.spectra_layout,
                difference_bars: fresh.difference_bars,
                render: fresh.render,
                ..std::mem::take(&mut self.view.saved)
            };
            self.push(Command::GoTo(template.pane));
            // Matrix and errors need the height of the window; Esc goes back.
            if template.pane == PaneKind::CORRECTION {
                self.push(Command::Maximize(template.pane));
            }
        }
        self.view.other_documents = self.files.other_documents();
    }

    /// Saves the session in its file, or asks for one.
    fn save_session(&mut self, replaces: bool) {
        let Some(mut file) = self.own_document().session.clone() else { return self.save_session_as() };
        if self.session.writing[0] {
            self.session.writing[1] = true;
            return;
        }
        if let Some((fingerprint, _)) = self.session.known.get(&file.path) {
            file.fingerprint = *fingerprint;
        }
        self.session.writing = [true, false];
        let (document, make) = self.file_to_save();
        self.files.save_session(file, document, make, replaces);
    }

    fn save_session_as(&mut self) {
        let (document, make) = self.file_to_save();
        let name = document.session.as_ref().map(|file| crate::format::file_name(&file.path));
        self.session.named = Some(document);
        let name = name.unwrap_or_else(session_name);
        let forms = vec![FileForm { extension: session::ENDING, make, beside: None }];
        self.files.ask_to_save(SaveRequest::new(SESSION, name, forms));
    }

    /// The document with the making of its session's file.
    fn file_to_save(&self) -> (Arc<Document>, MakeBytes) {
        let document = Arc::new(self.own_document().clone());
        let (written, view) = (Arc::clone(&document), self.own_view().for_session());
        let text = move || session::to_session(&written, &view).map_err(|error| error.to_string());
        (document, Arc::new(move || text().map(String::into_bytes)))
    }

    /// Handles a file that was saved: a document saved elsewhere no longer holds the window open, and a session has a name.
    pub(super) fn saved(&mut self, ctx: &Context, saved: SavedFile) {
        self.view.say(saved.message);
        if let Closing::Elsewhere(document) = &self.closing
            && saved.what == DOCUMENT
        {
            // Later changes are not in that file.
            if **document == *self.history.document() {
                self.close(ctx);
            } else {
                self.closing = Closing::Asked;
            }
        }
        if saved.what != SESSION {
            return;
        }
        self.view.remember_file(saved.file.path.clone());
        let Some(document) = self.session.named.take() else { return };
        self.own_history().set_session(&saved.file);
        self.know_session(saved.file, document);
    }

    pub(super) fn wrote_session(&mut self, file: SessionFile, document: Arc<Document>) {
        if self.own_document().session.as_ref().is_some_and(|now| now.path == file.path) {
            self.own_history().set_session(&file);
        }
        self.view.say(format!("Saved {}.", file.path.display()));
        self.know_session(file, document);
        if std::mem::take(&mut self.session.writing)[1] {
            self.save_session(false);
        }
    }

    /// Handles a session that was not written: a question, or the reason.
    pub(super) fn did_not_write_session(&mut self, outcome: Result<PathBuf, String>) {
        self.session.writing = [false; 2];
        match outcome {
            Ok(path) => self.session.changed = Some(path),
            Err(why) => self.view.fail(why),
        }
    }

    fn save_template(&mut self, name: &str) {
        let (_, make) = self.file_to_save();
        match make().and_then(|bytes| self.files.save_template(name, &bytes)) {
            Ok(()) => self.view.say(format!("Saved the template {name}: File, New from template.")),
            Err(why) => self.view.fail(format!("The template is not saved: {why}.")),
        }
        self.view.templates = self.files.templates();
    }

    pub(super) fn ask_about_session(&mut self, ui: &Ui, theme: &Theme) {
        self.ask_about_closing(ui, theme);
        if let Some(path) = self.session.changed.clone() {
            let words = format!(
                "Another program, or another window, wrote to {} since it was read or written here.",
                path.display()
            );
            let answer = window(ui, "session", "The file changed on disk", |ui| {
                ui.label(RichText::new(words).color(theme.warning));
                ui.horizontal(|ui| {
                    let choices = ["Save as…", "Open that version", "Replace it", "Cancel"];
                    choices.into_iter().filter(|words| ui.button(*words).clicked()).last()
                })
                .inner
            });
            let Some(answer) = answer else { return };
            self.session.changed = None;
            match answer {
                "Save as…" => self.save_session_as(),
                "Replace it" => self.save_session(true),
                "Open that version" => self.push(Command::OpenDocument(path)),
                _ => {}
            }
        }
        let Some(mut name) = self.session.template.take() else { return };
        let own: Vec<String> = self.view.templates.iter().map(|(name, _)| name.clone()).collect();
        let answer = window(ui, "session", "Save as a template", |ui| {
            let field = ui.add(TextEdit::singleline(&mut name).hint_text("Name").desired_width(WIDTH));
            widgets::labeled(&field, egui::Role::TextInput, "Name of the template");
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if !entered && ui.memory(|memory| memory.focused().is_none()) {
                field.request_focus();
            }
            let replaces = own.contains(&template_name(&name));
            if replaces {
                ui.colored_label(theme.warning, "A template has this name.");
            }
            ui.horizontal(|ui| {
                let is_named = !name.trim().is_empty();
                let words = if replaces { "Replace" } else { "Save" };
                // Enter alone replaces nothing.
                let entered = entered && is_named && !replaces;
                let saves = ui.add_enabled(is_named, egui::Button::new(words)).clicked() || entered;
                let cancels = ui.button("Cancel").clicked();
                saves.then_some(true).or(cancels.then_some(false))
            })
            .inner
        });
        match answer {
            Some(true) => self.save_template(name.trim()),
            Some(false) => {}
            None => self.session.template = Some(name),
        }
    }

    /// Holds the window open while its document cannot be saved.
    pub(super) fn mind_closing(&mut self, ctx: &Context) {
        if self.closing == Closing::Asked && self.files.is_saved() {
            self.close(ctx);
        }
        if !ctx.input(|input| input.viewport().close_requested()) || self.closing == Closing::Agreed {
            return;
        }
        self.end_tour();
        if self.files.save_document(self.history.document()).is_err() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.closing = Closing::Asked;
        }
    }

    fn close(&mut self, ctx: &Context) {
        self.closing = Closing::Agreed;
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    fn ask_about_closing(&mut self, ui: &Ui, theme: &Theme) {
        if self.closing != Closing::Asked {
            return;
        }
        let why = self.files.standing().into_iter().next().map(|standing| standing.words).unwrap_or_default();
        let answer = window(ui, "closing", "Your changes are not saved", |ui| {
            ui.label(RichText::new(why).color(theme.error));
            ui.horizontal(|ui| {
                let document = || Arc::new(self.history.document().clone());
                let elsewhere = ui.button("Save elsewhere…").clicked().then(|| Closing::Elsewhere(document()));
                let anyway = ui.button("Close without saving").clicked().then_some(Closing::Agreed);
                let cancel = ui.button("Cancel").clicked().then_some(Closing::No);
                elsewhere.or(anyway).or(cancel)
            })
            .inner
        });
        match answer {
            Some(Closing::Agreed) => self.close(ui.ctx()),
            Some(Closing::Elsewhere(document)) => {
                self.closing = Closing::Elsewhere(Arc::clone(&document));
                // With all of its sets in one file.
                let make =
                    move || session::to_json(&document).map(String::into_bytes).map_err(|error| error.to_string());
                let forms = vec![FileForm::new(session::ENDING, make)];
                self.files.ask_to_save(SaveRequest::new(DOCUMENT, session_name(), forms));
            }
            Some(next) => self.closing = next,
            None => {}
        }
    }
}

fn session_name() -> String {
    format!("session.{}", session::ENDING)
}

fn window<R>(ui: &Ui, id: &'static str, title: &str, content: impl FnOnce(&mut Ui) -> Option<R>) -> Option<R> {
    let shown = widgets::window(title, id, (Align2::CENTER_TOP, Vec2::new(0.0, 96.0))).show(ui.ctx(), |ui| {
        ui.set_max_width(WIDTH);
        content(ui)
    });
    shown.and_then(|shown| shown.inner).flatten()
}
