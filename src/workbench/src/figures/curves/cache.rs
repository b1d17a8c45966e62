//! Cache of the selected item's curves, valid for all frames in which they do not change.

use std::sync::Arc;

use super::drawn::{self, Curves, DRAWN};
use super::import_selection::ImportSelection;

/// Maximum total number of points drawn on screen.
const POINTS: usize = 80_000;

/// The curves of the last selected item.
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
    /// The curves of the selected item: the cached ones, if still valid.
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
