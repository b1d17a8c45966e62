//! Queries and those who answer them.

use crate::render::Stop;
use std::hash::Hash;
use std::sync::Arc;

/// A question: a value with everything its answer depends on. Threads may share it and its answer.
pub trait Query: Clone + Eq + Hash + Send + Sync + 'static {
    /// Answer.
    type Answer: Send + Sync + 'static;

    /// A name for counters.
    const NAME: &'static str;
    /// True if an answer is whole even if [`Ask::stop`] was set while it was made: it, and all it asks, do not look at that.
    const WHOLE: bool = false;

    /// Number of answers cached where memory limits; the least recently used go first.
    const KEPT: usize = 256;

    /// About how much memory an answer takes, in bytes; 0 for what is not worth counting.
    fn bytes(_: &Self::Answer) -> usize {
        0
    }

    /// Computes the answer, asking others on the way.
    fn answer(&self, ask: &impl Ask) -> Self::Answer;
}

/// Somebody who answers questions.
pub trait Ask {
    /// The answer to a question, computed or remembered.
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer>;

    /// Says when answers are no longer wanted. What is then returned may be incomplete and is not to be kept.
    fn stop(&self) -> Stop {
        Stop::NEVER
    }
}

/// Answers every question by computing it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Direct;

impl Ask for Direct {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        Arc::new(query.answer(self))
    }
}
