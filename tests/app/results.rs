//! The cache of answers, background work and the executor that tests drive.

use std::hash::{Hash, Hasher};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, Scope, ScopedJoinHandle};
use std::time::Duration;

use chromascope::jobs::{Background, Executor, Job};
use chromascope::results::Results;
use chromascope_core::query::{Ask, Query};
use chromascope_core::render::Stop;

/// A query answered through a channel: the test decides when and with what; a closed channel makes it fail.
#[derive(Clone)]
struct Slow {
    begun: Sender<()>,
    answers: Arc<Mutex<Receiver<Option<u32>>>>,
}

impl PartialEq for Slow {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.answers, &other.answers)
    }
}

impl Eq for Slow {}

impl Hash for Slow {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}

impl Query for Slow {
    type Answer = u32;
    const NAME: &'static str = "slow";

    fn answer(&self, _: &impl Ask) -> u32 {
        self.begun.send(()).expect("the test listens");
        let answer = self.answers.lock().unwrap_or_else(PoisonError::into_inner).recv();
        answer.ok().flatten().expect("an answer")
    }
}

fn slow() -> (Slow, Sender<Option<u32>>, Receiver<()>) {
    let ((begun, begins), (answer, answers)) = (channel(), channel());
    (Slow { begun, answers: Arc::new(Mutex::new(answers)) }, answer, begins)
}

fn asks<'s>(scope: &'s Scope<'s, '_>, results: &Results, slow: &Slow) -> ScopedJoinHandle<'s, u32> {
    let (results, slow) = (results.clone(), slow.clone());
    scope.spawn(move || *results.ask(&slow))
}

fn until_one_waits(results: &Results) {
    while results.counts().get("slow").is_none_or(|count| count.waits == 0) {
        thread::yield_now();
    }
}

#[test]
fn two_askers_of_one_question_compute_it_once() {
    let (results, (slow, answer, begins)) = (Results::default(), slow());
    thread::scope(|scope| {
        let first = asks(scope, &results, &slow);
        begins.recv().expect("asked");
        let second = asks(scope, &results, &slow);
        until_one_waits(&results);
        answer.send(Some(7)).expect("awaited");
        assert_eq!([first, second].map(|thread| thread.join().expect("answered")), [7, 7]);
    });
    let count = results.counts()["slow"];
    assert_eq!((count.misses, count.hits, results.known(&slow).as_deref()), (1, 1, Some(&7)));
}

#[test]
fn who_waits_for_what_is_stopped_or_fails_computes_it() {
    for is_stopped in [true, false] {
        let (results, (slow, answer, begins)) = (Results::default(), slow());
        let stop: Arc<AtomicBool> = Arc::default();
        thread::scope(|scope| {
            let first = asks(scope, &results.until(Stop::at(Arc::clone(&stop))), &slow);
            begins.recv().expect("asked");
            let second = asks(scope, &results, &slow);
            until_one_waits(&results);
            stop.store(true, Ordering::Relaxed);
            answer.send(is_stopped.then_some(0)).expect("awaited");
            assert_eq!(first.join().ok(), is_stopped.then_some(0));
            begins.recv().expect("asked");
            answer.send(Some(7)).expect("awaited");
            assert_eq!(second.join().expect("answered"), 7, "what was stopped is not stored");
        });
    }
}

#[test]
fn who_is_stopped_and_a_thread_of_the_pool_wait_for_nobody() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    for in_pool in [true, false] {
        let (results, (slow, answer, begins)) = (Results::default(), slow());
        thread::scope(|scope| {
            asks(scope, &results, &slow);
            begins.recv().expect("asked");
            let (theirs, second) = (results.until(Stop::at(Arc::new(AtomicBool::new(!in_pool)))), slow.clone());
            let ask = move || *theirs.ask(&second);
            let pool = &pool;
            scope.spawn(move || if in_pool { pool.install(ask) } else { ask() });
            begins.recv().expect("asked");
            answer.send(Some(7)).expect("awaited");
            answer.send(Some(7)).expect("awaited");
        });
        assert_eq!((results.counts()["slow"].misses, results.counts()["slow"].waits), (2, 0), "{in_pool}");
    }
}

/// A number; those from 10 on take half of what a kind may take.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Large(u8);

impl Query for Large {
    type Answer = u8;
    const NAME: &'static str = "large";
    const CAPACITY: usize = 3;

    fn bytes(answer: &u8) -> usize {
        if *answer < 10 { 1 } else { 128 << 20 }
    }

    fn answer(&self, _: &impl Ask) -> u8 {
        self.0
    }
}

#[test]
fn many_questions_are_answered_in_order_and_each_once() {
    let results = Results::default();
    let queries: Vec<Large> = [3, 1, 3, 2].map(Large).into();
    let answers: Vec<u8> = results.ask_all(&queries[..2]).iter().map(|answer| **answer).collect();
    assert_eq!(answers, [3, 1]);
    let answers: Vec<u8> = results.ask_all(&queries).iter().map(|answer| **answer).collect();
    assert_eq!((answers, results.counts()["large"].misses), (vec![3, 1, 3, 2], 3));
    assert!(results.ask_all::<Large>(&[]).is_empty());
}

#[test]
fn what_was_asked_for_least_recently_goes_first() {
    let results = Results::default();
    let ask = |numbers: &[u8]| numbers.iter().for_each(|number| drop(results.ask(&Large(*number))));
    let known = |numbers: [u8; 4]| numbers.map(|number| results.known(&Large(number)).is_some());
    ask(&[1, 2, 3, 1, 4]);
    assert_eq!(known([1, 2, 3, 4]), [true, false, true, true], "by number");
    ask(&[10, 11, 12]);
    assert_eq!(known([4, 10, 11, 12]), [false, false, true, true], "by memory");
}

/// Twice a number; 13 cannot be doubled.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Doubled(u32);

impl Query for Doubled {
    type Answer = u32;
    const NAME: &'static str = "doubled";

    fn answer(&self, _: &impl Ask) -> u32 {
        assert_ne!(self.0, 13, "no luck");
        2 * self.0
    }
}

fn doubling() -> (Executor, Background<Doubled>) {
    let executor = Executor::driven();
    let worker = Background::on(&executor, || ());
    (executor, worker)
}

/// The latest answer, whether it is of the latest request, and how many stages of that are finished.
fn shown(worker: &Background<Doubled>) -> Option<(u32, bool, usize)> {
    worker.shown().map(|shown| (*shown.answer, shown.current, worker.progress().1))
}

#[test]
fn stages_come_one_by_one_and_the_latest_request_wins() {
    let (executor, worker) = doubling();
    worker.ask(vec![Doubled(1), Doubled(2)]);
    assert_eq!((shown(&worker), worker.busy()), (None, Some(Duration::ZERO)));
    assert!(executor.run_one("doubled"));
    assert_eq!(shown(&worker), Some((2, true, 1)));
    executor.advance(Duration::from_secs(3));
    assert_eq!(worker.busy(), Some(Duration::from_secs(3)));
    worker.ask(vec![Doubled(5)]);
    assert_eq!((shown(&worker), worker.busy()), (Some((2, false, 0)), Some(Duration::ZERO)));
    executor.run_all();
    assert_eq!((shown(&worker), worker.busy()), (Some((10, true, 1)), None));
    assert_eq!(executor.results().counts()["doubled"].misses, 2, "the stage of the request before was not made");
}

#[test]
fn of_many_each_answer_is_known_once_it_is_made() {
    let (executor, worker) = doubling();
    let all: Vec<Doubled> = (1..=3).map(Doubled).collect();
    worker.ask(all.clone());
    executor.run_one("doubled");
    executor.run_one("doubled");
    let known: Vec<_> = all.iter().map(|query| executor.results().known(query).as_deref().copied()).collect();
    assert_eq!((known, worker.progress().1), (vec![Some(2), Some(4), None], 2));
}

#[test]
fn what_nobody_looks_at_is_not_made() {
    let (executor, worker) = doubling();
    worker.ask(vec![Doubled(1)]);
    worker.rest();
    executor.run_all();
    assert_eq!((shown(&worker), worker.busy(), executor.results().counts().len()), (None, None, 0));
}

#[test]
fn a_panic_fails_its_request_alone() {
    let (_executor, worker) = doubling();
    worker.ask(vec![Doubled(13)]);
    worker.wait();
    assert!(worker.failure().is_some_and(|why| why.contains("no luck")) && worker.busy().is_none());
    worker.ask(vec![Doubled(4)]);
    worker.wait();
    assert_eq!((shown(&worker), worker.failure()), (Some((8, true, 1)), None));
}

#[test]
fn a_thread_answers_too() {
    let worker = Background::on(&Executor::default(), || ());
    worker.ask(vec![Doubled(1), Doubled(2)]);
    worker.wait();
    assert_eq!(shown(&worker), Some((4, true, 2)));
}

#[test]
fn driven_work_runs_only_when_told_to() {
    let (executor, runs) = (Executor::driven(), Arc::new(AtomicUsize::new(0)));
    for name in ["files", "meshes"] {
        let counted = Arc::clone(&runs);
        executor
            .spawn(name, move || {
                counted.fetch_add(1, Ordering::Relaxed);
            })
            .expect("queued");
    }
    assert_eq!((executor.queued(), runs.load(Ordering::Relaxed)), (vec!["files".to_owned(), "meshes".to_owned()], 0));
    assert!(executor.run_one("meshes") && !executor.run_one("meshes"));
    assert_eq!((executor.queued(), runs.load(Ordering::Relaxed)), (vec!["files".to_owned()], 1));
    assert!(executor.run_next() && !executor.run_next());
    assert_eq!(runs.load(Ordering::Relaxed), 2);
}

/// Work of a name, which says it.
macro_rules! said {
    ($work:ident, $name:literal) => {
        #[derive(Clone)]
        struct $work(u32, Arc<Mutex<String>>);

        impl PartialEq for $work {
            fn eq(&self, other: &Self) -> bool {
                self.0 == other.0
            }
        }

        impl Job for $work {
            type Answer = ();
            const NAME: &'static str = $name;

            fn run(&self, _: &Results) -> Arc<()> {
                self.1.lock().unwrap().push_str($name);
                Arc::default()
            }
        }
    };
}

said!(A, "a");
said!(B, "b");

#[test]
fn repeated_work_goes_to_the_end_of_the_queue() {
    let (executor, said) = (Executor::driven(), Arc::new(Mutex::new(String::new())));
    let (a, b) = (Background::on(&executor, || ()), Background::on(&executor, || ()));
    a.ask((1..=3).map(|stage| A(stage, Arc::clone(&said))).collect());
    b.ask(vec![B(1, Arc::clone(&said))]);
    executor.run_all();
    assert_eq!(*said.lock().unwrap(), "abaa");
}

#[test]
fn the_clock_moves_only_when_told_to() {
    let executor = Executor::driven();
    let clock = executor.clock();
    let begun = clock.now();
    assert_eq!(clock.since(begun), Duration::ZERO);
    executor.advance(Duration::from_millis(250));
    assert_eq!(clock.since(begun), Duration::from_millis(250));
}
