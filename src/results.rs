//! What has been computed: the only cache. A question that equals one asked before is not computed again.

use std::any::{Any, TypeId};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::time::{Duration, Instant};

use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Stop;

/// Answers that were not asked for in this many frames are let go.
const FRAMES_KEPT: u64 = 240;

/// Counters of one kind of question.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Answers that were remembered.
    pub hits: u64,
    /// Answers that were computed.
    pub misses: u64,
    /// Time spent computing, questions asked on the way included.
    pub time: Duration,
    /// Time spent computing, without questions asked on the way.
    pub own_time: Duration,
}

/// One kind of question's answers.
struct Answers<Q: Query> {
    known: HashMap<Q, Known<Q::Answer>>,
}

struct Known<A> {
    answer: Arc<A>,
    asked: u64,
    bytes: usize,
}

/// The most memory that the answers of one kind take where answers are counted; the last one stays, however large.
const BYTES: usize = 256 << 20;

impl<Q: Query> Answers<Q> {
    /// Lets go of what was asked for least recently, until no more than these are left.
    fn keep(&mut self, count: usize, bytes: usize) {
        let mut all: usize = self.known.values().map(|known| known.bytes).sum();
        while self.known.len() > 1 && (self.known.len() > count || all > bytes) {
            let oldest = self.known.iter().min_by_key(|(_, known)| known.asked).map(|(query, _)| query.clone());
            let Some(known) = oldest.and_then(|oldest| self.known.remove(&oldest)) else { return };
            all = all.saturating_sub(known.bytes);
        }
    }
}

/// Lets go of old answers, whatever their type.
trait Forget {
    fn forget(&mut self, before: u64);
    fn as_any(&mut self) -> &mut dyn Any;
}

impl<Q: Query> Forget for Answers<Q> {
    fn forget(&mut self, before: u64) {
        self.known.retain(|_, known| known.asked >= before);
    }

    fn as_any(&mut self) -> &mut dyn Any {
        self
    }
}

/// Remembers answers, on one thread.
#[derive(Default)]
pub struct Results {
    bounded: bool,
    stop: RefCell<Stop>,
    clock: Cell<u64>,
    asked_on_the_way: Cell<Duration>,
    answers: RefCell<HashMap<TypeId, Box<dyn Forget>>>,
    counts: RefCell<BTreeMap<&'static str, Count>>,
    frame: Cell<u64>,
    frame_time: Cell<Duration>,
    last_work: Cell<Duration>,
    depth: Cell<u32>,
}

impl Results {
    /// Remembers as many answers of each kind as the kind says are worth keeping, however old: for pictures, whose parts are
    /// large, and of which the costliest are asked for least often.
    pub fn bounded() -> Self {
        Self { bounded: true, ..Self::default() }
    }

    /// Says when answers are no longer wanted. Those that were being made then are not remembered.
    pub fn stop_at(&self, stop: Stop) {
        self.stop.replace(stop);
    }

    /// Closes a frame's book: what was not asked for in a long while is let go.
    pub fn end_frame(&self) {
        let frame = self.frame.get() + 1;
        self.frame.set(frame);
        if self.frame_time.get() > Duration::ZERO {
            self.last_work.set(self.frame_time.replace(Duration::ZERO));
        }
        if !self.bounded && frame.is_multiple_of(FRAMES_KEPT) {
            let before = frame.saturating_sub(FRAMES_KEPT);
            self.answers.borrow_mut().values_mut().for_each(|answers| answers.forget(before));
        }
    }

    /// The time that the last frame that computed anything spent computing.
    pub fn last_work(&self) -> Duration {
        self.last_work.get()
    }

    /// Hits, misses and time of each kind of question since the start.
    pub fn counts(&self) -> BTreeMap<&'static str, Count> {
        self.counts.borrow().clone()
    }

    fn remembered<Q: Query>(&self, query: &Q) -> Option<Arc<Q::Answer>> {
        let mut all = self.answers.borrow_mut();
        let answers = all.get_mut(&TypeId::of::<Q>())?.as_any().downcast_mut::<Answers<Q>>()?;
        let known = answers.known.get_mut(query)?;
        known.asked = self.now();
        Some(Arc::clone(&known.answer))
    }

    fn remember<Q: Query>(&self, query: &Q, answer: &Arc<Q::Answer>) {
        let mut all = self.answers.borrow_mut();
        let slot = all.entry(TypeId::of::<Q>()).or_insert_with(|| Box::new(Answers::<Q> { known: HashMap::new() }));
        if let Some(answers) = slot.as_any().downcast_mut::<Answers<Q>>() {
            let known = Known { answer: Arc::clone(answer), asked: self.now(), bytes: Q::bytes(answer) };
            answers.known.insert(query.clone(), known);
            if self.bounded {
                answers.keep(Q::KEPT, BYTES);
            }
        }
    }

    /// Frames, or where answers are counted, questions.
    fn now(&self) -> u64 {
        if self.bounded { self.clock.replace(self.clock.get() + 1) } else { self.frame.get() }
    }

    fn count(&self, name: &'static str, change: impl FnOnce(&mut Count)) {
        change(self.counts.borrow_mut().entry(name).or_default());
    }
}

impl Ask for Results {
    fn ask<Q: Query>(&self, query: &Q) -> Arc<Q::Answer> {
        if let Some(answer) = self.remembered(query) {
            self.count(Q::NAME, |count| count.hits += 1);
            return answer;
        }
        let start = Instant::now();
        self.depth.set(self.depth.get() + 1);
        let before = self.asked_on_the_way.replace(Duration::ZERO);
        // No cell is borrowed here: the answer may ask further questions.
        let answer = Arc::new(query.answer(self));
        self.depth.set(self.depth.get() - 1);
        let time = start.elapsed();
        let on_the_way = self.asked_on_the_way.replace(before + time);
        self.count(Q::NAME, |count| {
            count.misses += 1;
            count.time += time;
            count.own_time += time.saturating_sub(on_the_way);
        });
        if !Q::WHOLE && self.stop.borrow().is_set() {
            return answer;
        }
        if self.depth.get() == 0 {
            self.frame_time.set(self.frame_time.get() + time);
        }
        self.remember(query, &answer);
        answer
    }

    fn stop(&self) -> Stop {
        self.stop.borrow().clone()
    }
}
