//! Files that change on disk.

use super::*;
use crate::jobs::Executor;

/// Writes a file periodically for ten seconds, to a window that is drawn on events and when it requested a repaint.
/// Returns how often the file was to be read, and how often the window was drawn.
fn readings(every: Duration) -> (usize, usize) {
    let executor = Executor::driven();
    let clock = executor.clock();
    let path = PathBuf::from("/measured.csv");
    let mut heard = Heard { files: BTreeSet::from([path.clone()]), ..Heard::default() };
    let (mut read, mut drawn) = (0, 0);
    let mut draw_at: Option<Duration> = None;
    while clock.now() < Duration::from_secs(10) {
        executor.advance(every);
        let is_news = heard.written(path.clone(), clock.now());
        if is_news || draw_at.is_some_and(|at| at <= clock.now()) {
            let (files, again) = heard.due(clock.now());
            draw_at = again.map(|after| clock.now() + after);
            (read, drawn) = (read + files.len(), drawn + 1);
        }
    }
    (read, drawn)
}

#[test]
fn a_file_that_never_rests_is_read_now_and_then_and_the_window_rests() {
    for milliseconds in [1, 10, 100, 250] {
        let (read, drawn) = readings(Duration::from_millis(milliseconds));
        assert!((5..=20).contains(&read), "read {read} times in ten seconds, written every {milliseconds} ms");
        assert!(drawn <= 80, "drawn {drawn} times in ten seconds, written every {milliseconds} ms");
    }
}

#[test]
fn a_file_that_was_written_once_is_read_as_soon_as_it_rests() {
    let path = PathBuf::from("/measured.csv");
    let mut heard = Heard { files: BTreeSet::from([path.clone()]), ..Heard::default() };
    let at = Duration::from_secs(5);
    assert!(heard.written(path.clone(), at));
    assert_eq!(heard.due(at), (Vec::new(), Some(REST)));
    assert_eq!(heard.due(at + REST), (vec![path.clone()], None));
    assert_eq!(heard.due(at + RESTLESS), (Vec::new(), None), "it is read once");
    // Written again immediately: at most two reads per second.
    let at = at + REST;
    assert!(heard.written(path.clone(), at));
    assert_eq!(heard.due(at + REST), (Vec::new(), Some(APART.saturating_sub(REST))));
    assert_eq!(heard.due(at + APART), (vec![path], None));
}

#[test]
fn what_is_written_beside_the_files_is_no_news() {
    let mut heard = Heard { files: BTreeSet::from([PathBuf::from("/a.csv")]), ..Heard::default() };
    assert!(!heard.written(PathBuf::from("/b.csv"), Duration::ZERO) && !heard.gone(PathBuf::from("/b.csv")));
    assert_eq!(heard.due(Duration::from_secs(9)), (Vec::new(), None));
}
