//! Undo: the previous documents.

use std::collections::VecDeque;

use chromascope_core::query::Shared;

use super::Action;
use crate::document::imported::ImportedSet;
use crate::document::names::BuiltInNames;
use crate::document::{Document, SessionFile};

const DEPTH: usize = 10_000;
/// Largest number of steps that are reloads: each holds another reading of a file.
const RELOADS: usize = 20;

/// One step: its name, and the document before (undo) or after it (redo). Documents share their sets.
#[derive(Clone, Debug)]
struct Step {
    name: String,
    document: Document,
    /// Action that later changes of the same gesture must extend to be merged into this step; `None` if not a gesture.
    action: Option<Action>,
    begins: bool,
    reloads: bool,
}

#[derive(Clone, Debug, Default)]
pub struct History {
    document: Document,
    undo: VecDeque<Step>,
    redo: Vec<Step>,
    /// True if a gesture (a drag) is going on, whose changes are one step.
    gesture: bool,
}

impl History {
    pub fn new(document: Document) -> Self {
        Self { document, ..Self::default() }
    }

    /// Renames imported sets of the document whose names built-in sets have: a session may come from another version.
    #[must_use]
    pub fn with_names_apart(mut self, built_in: &BuiltInNames) -> Self {
        self.document.part_names(built_in);
        self
    }

    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Carries out an action. A change that changes nothing is no step.
    pub fn apply(&mut self, action: &Action) {
        let Some(before) = self.change(action) else { return };
        let continues = self.gesture
            && self
                .undo
                .back()
                .is_some_and(|step| step.action.as_ref().is_some_and(|before| before.is_same_gesture(action)));
        if continues {
            // Named by where it ends.
            if let Some(step) = self.undo.back_mut() {
                step.name = action.name();
            }
        } else {
            let kept = action.is_same_gesture(action).then(|| action.clone());
            self.push(Step { name: action.name(), document: before, action: kept, begins: false, reloads: false });
        }
        self.gesture = true;
    }

    /// The document before a change; none for one that changes nothing.
    fn change(&mut self, action: &Action) -> Option<Document> {
        let before = self.document.clone();
        action.apply(&mut self.document);
        let has_changed = before != self.document;
        if has_changed {
            self.redo.clear();
        }
        has_changed.then_some(before)
    }

    fn push(&mut self, step: Step) {
        self.undo.push_back(step);
        if self.undo.len() > DEPTH {
            self.undo.pop_front();
        }
    }

    /// Replaces the document by that of another session, as a step of its own.
    pub fn replace(&mut self, name: String, document: Document) {
        let before = std::mem::replace(&mut self.document, document);
        self.redo.clear();
        self.undo.push_back(Step { name, document: before, action: None, begins: true, reloads: false });
        self.gesture = false;
    }

    /// Notes the file that the session is saved in, for all of its steps.
    pub fn set_session(&mut self, file: &SessionFile) {
        let before = self.undo.iter_mut().rev().take_while(|step| !step.begins);
        let after = self.redo.iter_mut().rev().take_while(|step| !step.begins);
        for document in before.chain(after).map(|step| &mut step.document).chain([&mut self.document]) {
            document.session = Some(file.clone());
        }
    }

    /// Carries out a reload of changed files: one undo reverts successive ones.
    pub fn reload(&mut self, action: &Action) {
        let Some(before) = self.change(action) else { return };
        let name = action.name();
        match self.undo.back_mut().filter(|step| step.reloads) {
            Some(step) if step.name == name => {}
            Some(step) => "Reload files".clone_into(&mut step.name),
            None => self.push(Step { name, document: before, action: None, begins: false, reloads: true }),
        }
        self.forget_readings();
    }

    /// Of a file that changes again and again between other steps, the oldest readings but one give way to the next.
    fn forget_readings(&mut self) {
        let reloads: Vec<usize> = (0..self.undo.len()).filter(|&index| self.undo[index].reloads).collect();
        let &[first, second, ..] = reloads.as_slice() else { return };
        if reloads.len() <= RELOADS {
            return;
        }
        self.undo.remove(second);
        let after = self.undo.get(second).map_or(&self.document, |step| &step.document).own.clone();
        for step in self.undo.range_mut(first + 1..second) {
            for set in &mut step.document.own {
                let is_later = |later: &&Shared<ImportedSet>| {
                    later.name == set.name && later.role == set.role && later.path == set.path
                };
                if let Some(later) = after.iter().find(is_later) {
                    *set = later.clone();
                }
            }
        }
    }

    /// The pointer was released, or nothing was dragged: what comes is a new step.
    pub fn end_gesture(&mut self) {
        self.gesture = false;
    }

    pub fn undo_name(&self) -> Option<&str> {
        self.undo.back().map(|step| step.name.as_str())
    }

    pub fn redo_name(&self) -> Option<&str> {
        self.redo.last().map(|step| step.name.as_str())
    }

    pub fn undo(&mut self) {
        if let Some(step) = self.undo.pop_back() {
            let after = std::mem::replace(&mut self.document, step.document);
            self.redo.push(Step { document: after, ..step });
        }
        self.gesture = false;
    }

    pub fn redo(&mut self) {
        if let Some(step) = self.redo.pop() {
            let before = std::mem::replace(&mut self.document, step.document);
            self.undo.push_back(Step { document: before, ..step });
        }
        self.gesture = false;
    }
}
