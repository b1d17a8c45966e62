//! Closing of the window, once everything is saved or the user decides otherwise.

use std::sync::Arc;

use egui::{Align2, Context, RichText, Ui, Vec2, ViewportCommand, Window};

use super::ChromascopeApp;
use crate::document::{Document, session};
use crate::files::{FileForm, SaveRequest};
use crate::theme::Theme;

/// Description of the document where it is saved elsewhere.
const DOCUMENT: &str = "the document";
const WIDTH: f32 = 420.0;

/// Progress of closing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Closing {
    /// Not requested.
    #[default]
    No,
    /// The user is asked about changes that could not be saved.
    Asked,
    /// A path prompt is open, for the document as it was then.
    Elsewhere(Arc<Document>),
    /// Nothing holds it up.
    Agreed,
}

impl ChromascopeApp {
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

    /// Handles a completed save: the document saved elsewhere no longer holds the window open.
    pub(super) fn saved(&mut self, ctx: &Context, what: &str) {
        if let Closing::Elsewhere(document) = &self.closing
            && what == DOCUMENT
        {
            // Later changes are not in that file.
            if **document == *self.history.document() {
                self.close(ctx);
            } else {
                self.closing = Closing::Asked;
            }
        }
    }

    fn close(&mut self, ctx: &Context) {
        self.closing = Closing::Agreed;
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    /// Shows the prompt, if it is open.
    pub(super) fn ask_about_closing(&mut self, ui: &Ui, theme: &Theme) {
        if self.closing != Closing::Asked {
            return;
        }
        let why = self.files.standing().into_iter().next().map(|standing| standing.words).unwrap_or_default();
        let window = Window::new("Your changes are not saved")
            .id(egui::Id::unique("closing"))
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, Vec2::new(0.0, 96.0));
        let content = |ui: &mut Ui| {
            ui.set_max_width(WIDTH);
            ui.label(RichText::new(why).color(theme.error));
            ui.horizontal(|ui| {
                let document = || Arc::new(self.history.document().clone());
                let elsewhere = ui.button("Save elsewhere…").clicked().then(|| Closing::Elsewhere(document()));
                let anyway = ui.button("Close without saving").clicked().then_some(Closing::Agreed);
                let cancel = ui.button("Cancel").clicked().then_some(Closing::No);
                elsewhere.or(anyway).or(cancel)
            })
            .inner
        };
        match window.show(ui.ctx(), content).and_then(|shown| shown.inner).flatten() {
            Some(Closing::Agreed) => self.close(ui.ctx()),
            Some(Closing::Elsewhere(document)) => {
                self.closing = Closing::Elsewhere(Arc::clone(&document));
                self.save_document_elsewhere(document);
            }
            Some(next) => self.closing = next,
            None => {}
        }
    }

    /// Asks where to save the document, with all of its sets in one file.
    fn save_document_elsewhere(&mut self, document: Arc<Document>) {
        let make = move || session::to_json(&document).map(String::into_bytes).map_err(|error| error.to_string());
        self.files.ask_to_save(SaveRequest {
            what: DOCUMENT.to_owned(),
            name: format!("session.{}", session::ENDING),
            forms: vec![FileForm::new(session::ENDING, make)],
            note: String::new(),
        });
    }
}
