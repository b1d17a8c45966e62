//! Queries, their evaluators, and the immutable values that they share.

use chromascope_render::render::Stop;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Deref;
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

/// An immutable value with its content hash taken once.
///
/// Values are equal if they share an allocation, or if hash *and* contents are equal: hashes alone are never trusted. A
/// recomputed value with the same contents equals the old one, so that nothing that depends on it is recomputed.
#[derive(Debug)]
pub struct Shared<T> {
    value: Arc<T>,
    hash: u64,
}

impl<T: Hash> Shared<T> {
    /// Takes a value and its hash.
    pub fn new(value: T) -> Self {
        let mut hasher = DefaultHasher::new();
        value.hash(&mut hasher);
        Self { value: Arc::new(value), hash: hasher.finish() }
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self { value: Arc::clone(&self.value), hash: self.hash }
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T: PartialEq> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.value, &other.value) || (self.hash == other.hash && self.value == other.value)
    }
}

impl<T: Eq> Eq for Shared<T> {}

impl<T> Hash for Shared<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.hash.hash(state);
    }
}
