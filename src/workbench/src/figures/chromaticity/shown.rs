//! The part of the chromaticity diagram that is shown: held while the data move, eased to a new fit.

use chromascope_text::choices;
use serde::{Deserialize, Serialize};

use crate::document::imported::Fingerprint;
use crate::document::{Diagram, Subset};
use crate::plot_item::SensorId;

/// Values at the ends of x and of y.
pub type Ranges = [[f64; 2]; 2];

choices! {
    /// Extent of the diagram.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum DiagramFit {
        #[default]
        Data = "data", "Data", "Fit to loci and patches, again if pressed again";
        Whole = "full", "Full diagram", "The full spectral locus";
    }
}

/// Seconds from one fit to the next.
const EASE: f64 = 0.15;

/// Choices that a fit belongs to: other sensors and patches are fitted anew, another light is not.
#[derive(Clone, Debug, PartialEq)]
pub struct FitKey {
    pub diagram: Diagram,
    pub fit: DiagramFit,
    /// The sensors that are fitted, sorted.
    pub sensors: Vec<SensorId>,
    /// The chart, the contents of the file it was read from, and how many of its patches.
    pub patches: (String, Option<Fingerprint>, Subset),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    pub shown: Ranges,
    /// The data: what a lens shows of the whole diagram.
    pub data: Ranges,
}

#[derive(Clone, Debug, Default)]
pub struct DiagramView {
    held: Option<Held>,
    /// Ranges that the user zoomed or panned to, if any.
    pub zoomed: Option<Ranges>,
}

#[derive(Clone, Debug)]
struct Held {
    key: FitKey,
    from: Ranges,
    to: Fit,
    start: f64,
    now: Ranges,
}

impl DiagramView {
    /// The ranges to show now, none before the first [`Self::hold`].
    pub fn fit(&self) -> Option<Fit> {
        self.held.as_ref().map(|held| Fit { shown: held.now, ..held.to })
    }

    /// What a saved figure shows: the fit that is held here, if its choices are the same, and what is zoomed to, if the
    /// coordinates are.
    #[must_use]
    pub fn for_paper(&self, key: &FitKey) -> Self {
        let is_other = self.held.as_ref().is_some_and(|held| held.key.diagram != key.diagram);
        let held = self.held.clone().filter(|held| held.key == *key);
        let held = held.map(|held| Held { now: held.to.shown, ..held });
        Self { held, zoomed: self.zoomed.filter(|_| !is_other) }
    }

    /// Holds the ranges, eased over 150 ms to those of `fit` where the key changed or `refit` is asked for. `seconds` is the
    /// frame's time. Returns true while they move.
    pub fn hold(&mut self, key: FitKey, refit: bool, seconds: f64, fit: impl FnOnce(&FitKey) -> Fit) -> bool {
        let held = self.held.take();
        let mut held = match held {
            Some(held) if held.key == key && !refit => held,
            held => {
                let to = fit(&key);
                // Other coordinates are another place: nothing moves there.
                let from = held.filter(|held| held.key.diagram == key.diagram).map(|held| held.now);
                let from = if refit { self.zoomed.take().or(from) } else { from };
                Held { key, from: from.unwrap_or(to.shown), to, start: seconds, now: to.shown }
            }
        };
        let share = ((seconds - held.start) / EASE).clamp(0.0, 1.0);
        held.now = eased(held.from, held.to.shown, share);
        let moves = held.now != held.to.shown;
        self.held = Some(held);
        moves
    }
}

/// Ranges on the way, fast at first.
fn eased(from: Ranges, to: Ranges, share: f64) -> Ranges {
    let rest = if share < 1.0 { (1.0 - share).powi(3) } else { 0.0 };
    [0, 1].map(|axis| [0, 1].map(|end| to[axis][end] + rest * (from[axis][end] - to[axis][end])))
}
