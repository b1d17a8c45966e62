//! View of the Figure page: its paper, its zoom, and the figure made last.

use chromascope_text::choices;
use std::sync::Arc;
use std::time::Duration;

use chromascope_figure::Figure;
use serde::{Deserialize, Serialize};

use crate::export::Paper;
use crate::workspaces::PaneKind;

/// Settings of figures on paper, saved between runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PageLook {
    /// The paper.
    pub paper: Paper,
    /// Size of the page on screen.
    pub zoom: PageZoom,
    /// Unit of lengths.
    pub unit: LengthUnit,
}

impl Default for PageLook {
    fn default() -> Self {
        let paper = Paper { width_mm: Some(Paper::ONE_COLUMN_MM), ..Paper::default() };
        Self { paper, zoom: PageZoom::default(), unit: LengthUnit::default() }
    }
}

choices! {
    /// Size of a page on screen.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum PageZoom {
        #[default]
        Fit = "fit", "Fit", "The whole page";
        TrueSize = "true", "True size", "As large as on paper, where a screen has 96 points per inch";
        Double = "double", "200 %", "Twice as large as on paper";
    }
}

impl PageZoom {
    /// Points on screen for each point on paper at true size: screens have 96 points per inch.
    pub const TRUE: f64 = 96.0 / 72.0;

    /// Points on screen for each point on paper, for a page that fits at `fit`.
    pub fn scale(self, fit: f64) -> f64 {
        match self {
            Self::Fit => fit,
            Self::TrueSize => Self::TRUE,
            Self::Double => 2.0 * Self::TRUE,
        }
    }
}

/// Unit of lengths on paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LengthUnit {
    /// Millimeters.
    #[default]
    Millimeter,
    /// Inches.
    Inch,
}

impl LengthUnit {
    /// Length in millimeters.
    pub const fn mm(self) -> f64 {
        match self {
            Self::Millimeter => 1.0,
            Self::Inch => 25.4,
        }
    }

    /// Symbol.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Millimeter => "mm",
            Self::Inch => "in",
        }
    }
}

/// State of the Figure page.
#[derive(Debug, Default)]
pub struct PageView {
    /// The pane that is shown as a page; `None` while panes are shown.
    pub open: Option<PaneKind>,
    made: Option<MadeFigure>,
}

#[derive(Debug)]
struct MadeFigure {
    of: (PaneKind, Paper),
    /// Time of egui in seconds.
    at: f64,
    figure: Option<Arc<Figure>>,
}

impl PageView {
    /// Seconds between two figures while neither pane nor paper change: moving the pointer makes none.
    const PAUSE: f64 = 0.1;

    /// The figure made last while it is fresh, and for how long it still is; after that, [`Self::keep`] takes another.
    pub fn fresh(&self, of: (PaneKind, Paper), now: f64) -> Option<(Option<Arc<Figure>>, Duration)> {
        let made = self.made.as_ref().filter(|made| made.of == of)?;
        let age = now - made.at;
        (0.0..Self::PAUSE).contains(&age).then(|| (made.figure.clone(), Duration::from_secs_f64(Self::PAUSE - age)))
    }

    /// Keeps a figure that was made. One equal to the last leaves that in place.
    pub fn keep(&mut self, of: (PaneKind, Paper), now: f64, figure: Option<Figure>) -> Option<Arc<Figure>> {
        let last = self.made.take().and_then(|made| made.figure);
        let figure = match (last, figure) {
            (Some(last), Some(figure)) if *last == figure => Some(last),
            (_, figure) => figure.map(Arc::new),
        };
        self.made = Some(MadeFigure { of, at: now, figure: figure.clone() });
        figure
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_is_fresh_for_a_while_and_an_equal_one_leaves_it_in_place() {
        let mut view = PageView::default();
        let of = (PaneKind::SPECTRA, Paper::default());
        assert!(view.fresh(of, 1.0).is_none());
        let first = view.keep(of, 1.0, Some(Figure::new("Spectra", [1.0; 2]))).expect("a figure");
        let (fresh, rest) = view.fresh(of, 1.04).expect("fresh");
        assert!(Arc::ptr_eq(&fresh.expect("a figure"), &first) && (rest.as_secs_f64() - 0.06).abs() < 1e-9);
        assert!(view.fresh((of.0, Paper { dpi: 600.0, ..of.1 }), 1.04).is_none(), "another paper");
        assert!(view.fresh(of, 1.11).is_none(), "some time later");
        let again = view.keep(of, 1.11, Some(Figure::new("Spectra", [1.0; 2]))).expect("a figure");
        assert!(Arc::ptr_eq(&again, &first));
        let other = view.keep(of, 1.3, Some(Figure::new("Spectra", [2.0; 2]))).expect("a figure");
        assert!(!Arc::ptr_eq(&other, &first));
    }
}
