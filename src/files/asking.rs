//! Path requests: in the system's dialog, or in the window where there is none.

use std::path::{Path, PathBuf};

use super::Files;
use super::dialogs::{Answer, Question};
use super::event::{FileEvent, Note, SavedFile};
use super::request::{self, FileForm, PathPrompt, SaveRequest};
use crate::atomic::{files_beside, paths_beside, write_atomically, write_with};
use crate::document::SessionFile;
use crate::document::imported::Fingerprint;
use crate::format::{file_name, io_reason};

pub(super) struct Waiting {
    ticket: u64,
    request: Option<SaveRequest>,
}

impl Files {
    pub fn ask_to_open(&mut self) {
        self.in_dialog(Question::Files, None);
    }

    pub fn ask_for_folder(&mut self, title: &'static str) {
        self.in_dialog(Question::Folder { title }, None);
    }

    /// Prepares data to save in the background, then asks where to; the error is a message.
    pub fn make_to_save(&mut self, make: impl FnOnce() -> Result<SaveRequest, String> + Send + 'static) {
        self.making = true;
        self.in_background(move || [make().map_or_else(Note::NotMade, Note::ToSave)]);
    }

    /// Asks where to save. Replaces the subject of an open prompt; a typed path stays, with the extension of the new
    /// subject if it had one of the earlier subject.
    pub fn ask_to_save(&mut self, request: SaveRequest) {
        if let Some(prompt) = &mut self.prompt
            && let Some(before) = &prompt.save
        {
            if prompt.text == before.name {
                prompt.text.clone_from(&request.name);
            } else if let Some(stem) = before.stem_of(&prompt.text) {
                prompt.text = format!("{stem}.{}", request.extension());
            }
            prompt.typed();
            (prompt.save, prompt.focus) = (Some(request), true);
            return;
        }
        let title = format!("Save {}", request.what);
        let endings = request.forms.iter().map(|form| form.extension).collect();
        let question = Question::Save { title, name: request.name.clone(), endings };
        self.in_dialog(question, Some(request));
    }

    /// Runs a dialog on a thread (on a Mac they must stay on this one).
    fn in_dialog(&mut self, question: Question, request: Option<SaveRequest>) {
        self.ticket += 1;
        let ticket = self.ticket;
        self.waiting = Some(Waiting { ticket, request: request.clone() });
        let Some(dialogs) = self.dialogs.clone() else {
            self.note(Note::Answered(ticket, Answer::Missing, request));
            return;
        };
        let (sender, wake) = (self.sender.clone(), self.wake.clone());
        let run = move || {
            // A dialog that breaks is as good as none.
            let ask = std::panic::AssertUnwindSafe(|| dialogs.ask(&question));
            let answer = std::panic::catch_unwind(ask).unwrap_or(Answer::Missing);
            // The receiver is gone only when the window is.
            let _closed = sender.send(Note::Answered(ticket, answer, request));
            if let Some(ctx) = wake {
                ctx.request_repaint();
            }
        };
        if cfg!(target_os = "macos") {
            run();
        } else {
            self.spawn("file dialog", run);
        }
    }

    pub(super) fn answered(&mut self, ticket: u64, answer: Answer, request: Option<SaveRequest>) {
        let waited = self.waiting.take_if(|waiting| waiting.ticket == ticket).is_some();
        match (answer, request) {
            // If the wait was stopped, the path prompt is already open.
            (Answer::Missing, request) if waited => self.ask_for_path(request, ticket),
            (Answer::Missing | Answer::Cancelled, _) => {}
            (Answer::Chosen(paths), request) => {
                self.prompt.take_if(|prompt| prompt.ticket == ticket);
                match (request, paths.as_slice()) {
                    (None, _) => self.note(Note::Event(FileEvent::Open(paths))),
                    (Some(request), [path, ..]) => {
                        let text = path.display().to_string();
                        // The dialog has confirmed replacing an existing file.
                        let replaces = Some(path.clone());
                        let prompt = PathPrompt::new(Some(request), ticket);
                        self.save_to(path, PathPrompt { text, replaces, no_dialog: false, ..prompt });
                    }
                    (Some(_), []) => {}
                }
            }
        }
    }

    /// True while a path is requested, or will be immediately: keys are meant for that.
    pub fn is_asking(&self) -> bool {
        self.is_waiting() || self.prompt.is_some()
    }

    /// True while a dialog or the path box is opening and has no keyboard focus yet.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some() || self.making || self.prompt.as_ref().is_some_and(|prompt| prompt.focus)
    }

    /// Stops waiting for a dialog: the path is requested in the window. Returns whether one was waited for.
    pub fn stop_waiting(&mut self) -> bool {
        let made = std::mem::take(&mut self.making);
        // Running preparations cannot be stopped; their result is dropped.
        self.unwanted += usize::from(made);
        let Some(Waiting { ticket, request }) = self.waiting.take() else { return made };
        self.ask_for_path(request, ticket);
        true
    }

    /// The path that is being requested in the window, where there is no dialog.
    pub fn prompt_mut(&mut self) -> &mut Option<PathPrompt> {
        &mut self.prompt
    }

    /// Takes the path typed. One that cannot be taken stays, with the reason.
    pub fn take_prompt(&mut self) {
        let Some(prompt) = self.prompt.take() else { return };
        let text = prompt.text.trim();
        if text.is_empty() {
            self.prompt = Some(prompt.refused("Type a path."));
            return;
        }
        let path = request::expanded(text, self.home.as_deref());
        if prompt.save.is_some() {
            self.save_to(&path, prompt);
        } else if let Some(why) = request::cannot_open(&path) {
            self.prompt = Some(prompt.refused(why));
        } else {
            self.note(Note::Event(FileEvent::Open(vec![path])));
        }
    }

    fn save_to(&mut self, path: &Path, prompt: PathPrompt) {
        let Some(request) = prompt.save.clone() else { return };
        if path.is_dir() {
            let why = format!("{} is a folder: add a name.", path.display());
            return self.ask_again(prompt.refused(why));
        }
        let (path, form) = match request.target(path) {
            Ok(target) => target,
            Err(why) => return self.ask_again(prompt.refused(why)),
        };
        let taken = paths_beside(&path).into_iter().find(|beside| beside.exists());
        if let Some(taken) = taken.filter(|_| form.beside.is_some() && !path.exists()) {
            let why = format!("{} exists: choose another name.", taken.display());
            return self.ask_again(prompt.refused(why));
        }
        if path.exists() && prompt.replaces.as_ref() != Some(&path) {
            let prompt = PathPrompt { failure: None, candidates: Vec::new(), focus: true, ..prompt };
            return self.ask_again(PathPrompt { replaces: Some(path), ..prompt });
        }
        self.in_background(move || {
            let event = write(&path, &form, &request);
            let again = match &event {
                FileEvent::Failed(why) => Some(Note::NotSaved(prompt.refused(why))),
                _ => None,
            };
            [Note::Event(event)].into_iter().chain(again)
        });
    }

    /// Asks for another path, unless another prompt is open: then the failure is only reported.
    fn ask_again(&mut self, prompt: PathPrompt) {
        if self.prompt.is_none() {
            self.prompt = Some(prompt);
        } else if let Some(why) = prompt.failure {
            self.note(Note::Event(FileEvent::Failed(why)));
        }
    }

    pub fn complete_prompt(&self) {
        let Some(typed) = self.prompt.as_ref().map(|prompt| prompt.text.clone()) else { return };
        let home = self.home.clone();
        self.in_background(move || [Note::Completed(request::complete(&typed, home.as_deref()))]);
    }

    pub(super) fn completed(&mut self, done: request::Completed) {
        // The completion applies only if the text is unchanged.
        if let Some(prompt) = self.prompt.as_mut().filter(|prompt| prompt.text == done.of) {
            prompt.typed();
            (prompt.text, prompt.candidates, prompt.to_end) = (done.text, done.candidates, true);
        }
    }

    fn ask_for_path(&mut self, save: Option<SaveRequest>, ticket: u64) {
        match (&mut self.prompt, save) {
            (Some(PathPrompt { save: Some(_), .. }), Some(request)) => self.ask_to_save(request),
            (Some(prompt), None) => prompt.focus = true,
            (prompt, save) => *prompt = Some(PathPrompt::new(save, ticket)),
        }
    }
}

fn write(path: &Path, form: &FileForm, SaveRequest { what, note, .. }: &SaveRequest) -> FileEvent {
    let bytes = match (form.make)() {
        Ok(bytes) => bytes,
        Err(sentence) => return FileEvent::Failed(sentence),
    };
    let beside = form.beside.as_ref().map_or_else(Vec::new, |beside| files_beside(path, beside).into());
    let listed = |words: &str, is_there: bool| {
        let of = |(path, text): &&(PathBuf, Option<String>)| text.is_some() == is_there && (is_there || path.exists());
        let names: Vec<String> = beside.iter().filter(of).map(|(path, _)| file_name(path)).collect();
        if names.is_empty() { String::new() } else { format!(", {words} {}", names.join(" and ")) }
    };
    let words = listed("described in", true) + &listed("without the former", false);
    match write_with(&beside, |_, error| error, || write_atomically(path, &bytes)) {
        Ok(()) => {
            let note = if note.is_empty() { String::new() } else { format!(": {note}") };
            let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
            let file = SessionFile { path: absolute, fingerprint: Fingerprint::of(&bytes) };
            let message = format!("Saved {}{words}{note}.", file.path.display());
            FileEvent::Saved(SavedFile { message, what: what.clone(), file })
        }
        Err(error) => {
            FileEvent::Failed(format!("Cannot write {}: {}. Your work is safe.", path.display(), io_reason(&error)))
        }
    }
}
