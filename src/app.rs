//! The window: handles events, runs commands and shows panes.

mod commands;
mod frame;
mod measuring;
mod opening;
mod path_prompt;
mod saving;
mod session;
mod startup;
mod tour;

use egui::{Event, Ui};

use crate::action::history::History;
use crate::catalog::Catalog;
use crate::catalog::meshes::MeshStore;
use crate::catalog::opened::Opened;
use crate::catalog::recorded_store::RecordedStore;
use crate::catalog::spectral_images::ImageStore;
use crate::command::{Command, key_bindings};
use crate::files::Files;
use crate::jobs::{Executor, Later};
use crate::panes;
use crate::panes::context::PaneStates;
use crate::plot_item::PlotItem;
use crate::profiler::{Measured, Profiler};
use crate::render_service::RenderService;
use crate::results::Results;
use crate::theme;
use crate::view::import::{ImportItem, ImportView};
use crate::view::{ReportOn, SavedView, View};
use crate::workspaces::Arrangement;

pub use startup::{WindowError, run};

const LAYOUT_KEY: &str = "layout";

pub struct ChromascopeApp {
    pub history: History,
    pub catalog: Catalog,
    pub results: Results,
    pub view: View,
    files: Files,
    pub meshes: MeshStore,
    pub images: ImageStore,
    pub opened: Opened,
    recorded: RecordedStore,
    pub later: Later,
    /// Subject of the report whose folder is asked for.
    report_on: Option<ReportOn>,
    pub states: PaneStates,
    pub render_service: RenderService,
    pub profiler: Profiler,
    commands: Vec<Command>,
    /// Files named at the start that are not read yet: a single one is put to use.
    at_start: std::collections::BTreeSet<std::path::PathBuf>,
    /// The latest reading of each set that was read again.
    last_read: std::collections::HashMap<String, u64>,
    arrangement: Arrangement,
    /// When the program began, until the time of the first frame is reported.
    first_frame: Option<std::time::Instant>,
    /// The control that had the keyboard in the last frame.
    focus: Option<egui::Id>,
    closing: session::Closing,
    session: session::SessionState,
    /// What the user had before the tour.
    interrupted: Option<tour::Interrupted>,
    place: startup::WindowPlace,
    ctx: egui::Context,
}

impl ChromascopeApp {
    /// Starts with a document, in a context that is given the program's looks.
    pub fn new(ctx: &egui::Context, history: History, saved: SavedView, files: Files) -> Self {
        Self::on(&Executor::default(), ctx, history, saved, files)
    }

    pub fn on(
        executor: &Executor,
        ctx: &egui::Context,
        history: History,
        mut saved: SavedView,
        mut files: Files,
    ) -> Self {
        saved.mend(|pane| panes::by_kind(pane).is_some());
        theme::apply(ctx);
        files.wake(ctx);
        let repaint = || {
            let ctx = ctx.clone();
            move || ctx.request_repaint()
        };
        let opened = Opened::on(executor, repaint());
        opened.recall(saved.import.failing.clone());
        let import = ImportView { unseen: saved.import.unseen.clone(), ..ImportView::default() };
        let catalog = Catalog::built_in();
        let mut app = Self {
            history: history.with_names_apart(catalog.names()),
            catalog,
            results: executor.results(),
            view: View { saved, import, other_documents: files.other_documents(), ..View::default() },
            files,
            meshes: MeshStore::on(executor, repaint()),
            images: ImageStore::on(executor, repaint()),
            opened,
            recorded: RecordedStore::on(executor, repaint()),
            later: Later::on(executor, repaint()),
            states: PaneStates::default(),
            report_on: None,
            render_service: RenderService::on(executor, repaint()),
            profiler: Profiler { measured: Measured::default() },
            commands: Vec::new(),
            at_start: std::collections::BTreeSet::new(),
            last_read: std::collections::HashMap::new(),
            arrangement: Arrangement::default(),
            first_frame: None,
            focus: None,
            closing: session::Closing::default(),
            session: session::SessionState::default(),
            interrupted: None,
            place: startup::WindowPlace::default(),
            ctx: ctx.clone(),
        };
        app.begin_session();
        app
    }

    pub fn saved_view(&self) -> SavedView {
        let mut saved = self.own_view().clone();
        saved.import.failing = self.opened.failing();
        let own = &self.history.document().own;
        saved.import.unseen.clone_from(&self.view.import.unseen);
        saved.import.unseen.retain(|item| match item {
            ImportItem::Set(name) => own.iter().any(|set| set.name == *name),
            ImportItem::File(file) => saved.import.failing.iter().any(|failing| failing.fingerprint == *file),
        });
        saved
    }

    pub fn is_asking(&self) -> bool {
        self.files.is_asking()
    }

    /// Has something done in the next frame.
    pub fn push(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Keys, clipboard and dropped files become commands.
    fn take_input(&mut self, ctx: &egui::Context) {
        if self.files.is_asking() {
            return self.keep_keys_for_path(ctx);
        }
        if ctx.input(|input| input.pointer.any_pressed()) {
            (self.view.by_keyboard, self.view.cursor) = (false, None);
        }
        frame::leave_offer(ctx);
        frame::enter_pane(ctx, &mut self.view);
        let typing = ctx.text_edit_focused();
        let focused = self.view.keyed();
        // All keys belong to an open list or menu, which Escape closes.
        let is_free = !egui::Popup::is_any_open(ctx);
        for binding in key_bindings(focused).into_iter().filter(|_| is_free) {
            if binding.rests_while_typing && (typing || ctx.egui_wants_keyboard_input()) {
                continue;
            }
            if ctx.input_mut(|input| take_key(input, binding.shortcut)) {
                // What is typed next belongs to the field that opens.
                let opens_field = matches!(binding.command, Command::FindAnything | Command::FocusTemperature);
                self.commands.push(binding.command);
                if opens_field {
                    break;
                }
            }
        }
        let is_free = is_free && !typing;
        self.view.blink = is_free && ctx.input(|input| input.key_down(egui::Key::B) && input.modifiers.is_none());
        let events = ctx.input(|input| input.events.clone());
        for event in events.into_iter().filter(|_| is_free) {
            match event {
                Event::Paste(text) => self.commands.push(Command::Paste(text)),
                Event::Copy if !self.view.table_copies => self.commands.push(Command::CopyNumbers(focused)),
                _ => {}
            }
        }
        if ctx.input(|input| !input.pointer.any_down()) {
            self.history.end_gesture();
        }
    }

    /// While a path is requested, no key is a shortcut, and until the prompt or dialog has the keyboard focus all keys are
    /// discarded. Esc closes the prompt, and opens it where a dialog fails to appear.
    fn keep_keys_for_path(&mut self, ctx: &egui::Context) {
        self.view.blink = false;
        let escape = ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape));
        if self.files.is_waiting() {
            let is_key = |event: &Event| {
                matches!(
                    event,
                    Event::Key { .. } | Event::Text(_) | Event::Paste(_) | Event::Copy | Event::Cut | Event::Ime(_)
                )
            };
            ctx.input_mut(|input| input.events.retain(|event| !is_key(event)));
            if escape && self.files.stop_waiting() {
                return;
            }
        }
        if escape {
            self.commands.push(Command::Escape);
        }
        if ctx.input(|input| !input.pointer.any_down()) {
            self.history.end_gesture();
        }
    }
}

/// Takes a key out of the input, with the text that a keyboard types by it: a field that it opens must not receive its letter.
fn take_key(input: &mut egui::InputState, shortcut: egui::KeyboardShortcut) -> bool {
    let is_pressed = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => {
            *key == shortcut.logical_key && modifiers.matches_logically(shortcut.modifiers)
        }
        _ => false,
    };
    let before = input.events.len();
    while let Some(at) = input.events.iter().position(is_pressed) {
        let typed = usize::from(matches!(input.events.get(at + 1), Some(Event::Text(_))));
        input.events.drain(at..=at + typed);
    }
    input.events.len() < before
}

impl eframe::App for ChromascopeApp {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        self.results.end_frame();
        self.place.follow(ctx, frame);
        self.take_files(ctx);
        self.take_dropped(ctx);
        self.take_opened();
        self.take_scenes();
        self.take_report();
        self.take_input(ctx);
        frame::into_sight(ctx, &mut self.focus);
        self.carry_out(ctx);
        self.autosave(ctx);
        self.show_title(ctx);
        self.mind_closing(ctx);
        if ctx.input(|input| input.events.iter().any(|event| matches!(event, Event::WindowFocused(true)))) {
            self.view.other_documents = self.files.other_documents();
        }
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.view.point = None;
        self.view.draw_in(ui.input(|input| input.time));
        if self.view.locus_share.is_some() {
            ui.ctx().request_repaint();
        }
        self.view.table_copies = false;
        self.view.keeps_escape = false;
        let document = self.history.document();
        let source = self.view.selected.as_ref().and_then(PlotItem::source);
        self.view.selected_elsewhere = source.is_some_and(|id| document.compared(id.kind, &id.name).is_none())
            || matches!(self.view.selected, Some(PlotItem::DataSet { .. }));
        self.show(ui);
        self.view.reset_plots = false;
        let hovered = self.view.next_hovered.take();
        if hovered != self.view.hovered {
            self.view.hovered = hovered;
            // Another frame marks the hovered item in panes that were already drawn.
            ui.ctx().request_repaint();
        }
        let focus_moved = ui.memory(egui::Memory::focused) != self.focus;
        if !self.commands.is_empty() || focus_moved {
            ui.ctx().request_repaint();
        }
        if let Some(start) = self.first_frame.take() {
            log::info!("first frame after {} ms", start.elapsed().as_millis());
        }
    }

    /// Called now and then, and at the end. Nothing goes into eframe's own storage, which then writes nothing.
    fn save(&mut self, _: &mut dyn eframe::Storage) {
        self.save_layout(false);
    }

    fn on_exit(&mut self, _: Option<&eframe::glow::Context>) {
        self.end_tour();
        self.save_layout(true);
        if let Err(why) = self.files.save_document(self.history.document()) {
            log::error!("the document is not saved: {why}");
        }
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }
}
