//! The curves on show, made once for all frames in which nothing of them changes.

use std::sync::Arc;

use super::drawn::{self, Curves, DRAWN};
use super::on_show::ImportSelection;

/// At most so many points are drawn on screen in all.
const POINTS: usize = 80_000;

/// The curves of what was on show last.
#[derive(Clone, Debug)]
pub struct CurveCache {
    of: ImportSelection,
    curves: Result<Arc<Pair>, String>,
}

/// Curves, and the same with no more points than can be seen.
#[derive(Debug)]
struct Pair {
    all: Curves,
    seen: Curves,
}

impl CurveCache {
    /// The curves of what is on show: those kept, if they are of the same.
    pub fn of(shown: &ImportSelection, before: Option<Self>) -> Self {
        if let Some(before) = before.filter(|before| before.of.is_same(shown)) {
            return before;
        }
        let curves = Curves::of(shown, DRAWN).map(|all| {
            let most = (POINTS / all.drawn.len().max(1)).clamp(64, 4096);
            let mut seen = all.clone();
            seen.drawn.iter_mut().for_each(|curve| curve.points = drawn::thinned(&curve.points, most));
            Arc::new(Pair { all, seen })
        });
        Self { of: shown.clone(), curves }
    }

    /// The curves with all their points; or why there are none.
    pub fn all(&self) -> Result<&Curves, &str> {
        self.curves.as_ref().map(|pair| &pair.all).map_err(String::as_str)
    }

    /// The curves with the points that can be seen.
    pub fn seen(&self) -> Option<&Curves> {
        self.curves.as_ref().ok().map(|pair| &pair.seen)
    }
}
