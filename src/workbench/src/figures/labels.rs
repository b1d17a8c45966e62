//! Names of curves in small plots.

use chromascope_figure::{Anchor, Ink, Label, Labels, Place};

/// A text that names a curve.
#[derive(Clone)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) ink: Ink,
    /// Points of the curve beside which it may stand, the best first.
    pub(super) points: Vec<[f64; 2]>,
}

impl Name {
    /// Places the text beside the first point with room, else above one and to its side.
    pub(super) fn place(&self, labels: &mut Labels) -> bool {
        let sides = [
            (Anchor::BOTTOM, [0.0, -3.0]),
            (Anchor::TOP, [0.0, 6.0]),
            (Anchor::RIGHT_BOTTOM, [-4.0, -2.0]),
            (Anchor::LEFT_BOTTOM, [4.0, -2.0]),
            (Anchor::LEFT_BOTTOM, [9.0, -2.0]),
        ];
        let above = [8.0, -8.0, 16.0, -16.0, 24.0, -24.0, 32.0, -32.0].map(|x| (Anchor::BOTTOM, [x, -3.0]));
        let at = |sides: &[(Anchor, [f64; 2])]| -> Vec<Place> {
            let places = self.points.iter().flat_map(|at| sides.iter().map(|(anchor, offset)| (*at, *anchor, *offset)));
            places.map(|(at, anchor, offset)| Place { at, anchor, offset }).collect()
        };
        labels.place(&Label::new(&self.text, self.ink, [at(&sides), at(&above)].concat()))
    }
}

/// Symbol of a channel: the letter of a color, or the color-matching function's own.
pub(super) fn channel_symbol(channel: &str) -> String {
    match channel {
        "red" | "green" | "blue" => channel[..1].to_uppercase(),
        symbol => symbol.to_owned(),
    }
}
