//! Queries and their evaluators.

use crate::render::Stop;
use std::hash::Hash;
use std::sync::Arc;

/// Query: a value that contains everything its answer depends on. Threads may share it and its answer.
pub trait Query: Clone + Eq + Hash + Send + Sync + 'static {
    /// Answer.
    type Answer: Send + Sync + 'static;

    /// A name for counters.
    const NAME: &'static str;
    /// True if an answer is complete even if [`Ask::stop`] was set meanwhile: neither it nor its nested queries check that.
    const ALWAYS_COMPLETE: bool = false;

    /// Number of answers cached where memory limits; the least recently used go first.
    const CAPACITY: usize = 256;

    /// About how much memory an answer takes, in bytes; 0 for what is not worth counting.
    fn bytes(_: &Self::Answer) -> usize {
        0
    }

    /// Computes the answer, evaluating other queries as needed.
    fn answer(&self, ask: &impl Ask) -> Self::Answer;
}

/// Evaluator of queries.
pub trait Ask {
    /// Returns the answer to a query, computed or cached.
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer>;

    /// Returns the answers to queries of one kind, in their order; an evaluator may compute them in parallel.
    fn ask_all<Q: Query>(&self, queries: &[Q]) -> Vec<Arc<Q::Answer>> {
        queries.iter().map(|query| self.ask(query)).collect()
    }

    /// Stop flag of the evaluation. An answer computed after it was set may be incomplete and must not be cached.
    fn stop(&self) -> Stop {
        Stop::NEVER
    }
}

/// Evaluator without a cache.
#[derive(Clone, Copy, Debug, Default)]
pub struct Direct;

impl Ask for Direct {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        Arc::new(query.answer(self))
    }
}
