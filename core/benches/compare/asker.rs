//! Somebody who remembers what a running program would remember.

use chromascope_core::query::{Ask, Query};
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// Keeps every answer; a linear search stands for the program's map, which at these numbers costs about the same.
#[derive(Default)]
pub(crate) struct Remembering {
    known: RefCell<Vec<Known>>,
}

/// A question and its answer.
type Known = (Box<dyn Any>, Box<dyn Any>);

impl Remembering {
    /// Forgets all answers but the first ones.
    pub(crate) fn keep(&self, count: usize) {
        self.known.borrow_mut().truncate(count);
    }

    pub(crate) fn len(&self) -> usize {
        self.known.borrow().len()
    }
}

impl Ask for Remembering {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        let found = self.known.borrow().iter().find_map(|(question, answer)| {
            let same = question.downcast_ref::<Q>().is_some_and(|known| known == query);
            if same { answer.downcast_ref::<Arc<Q::Answer>>().cloned() } else { None }
        });
        found.unwrap_or_else(|| {
            let answer = Arc::new(query.answer(self));
            self.known.borrow_mut().push((Box::new(query.clone()), Box::new(Arc::clone(&answer))));
            answer
        })
    }
}
