//! The curves of one set of the library in a small panel, and the names of curves in such.

use chromascope_core::query::Ask;
use chromascope_core::spectral::SpectralDistribution;
use chromascope_core::spectral::grid::{FIRST_NM, LAST_NM};
use chromascope_figure::{
    Anchor, Axis, Ink, InkRole, Label, Labels, Mark, Panel, Place as LabelPlace, Rect, Shape, Ticks,
};

use crate::catalog::load::{LoadError, curves};
use crate::catalog::{Entry, Place};
use crate::document::SetKind;
use crate::plot_item::PickIndex;

/// Largest number of curves drawn of a set; of more, evenly chosen ones.
const MOST: usize = 48;

/// The curves of a set: sensitivities and lights to their largest value, reflectances and transmittances as they are. None where
/// nothing is known about what they are.
pub fn panel(ask: &impl Ask, entry: &Entry, role: InkRole, size: [f64; 2]) -> Result<Option<Panel>, LoadError> {
    let all = curves(&entry.place, ask)?;
    let drawn = drawn(entry, &all);
    if drawn.is_empty() {
        return Ok(None);
    }
    let values = || drawn.iter().flat_map(|(_, points)| points.iter().map(|point| point[1]));
    let (low, high) = (values().fold(0.0, f64::min), values().fold(f64::MIN_POSITIVE, f64::max));
    let few = drawn.len() <= 4;
    let x = Axis::new("wavelength (nm)", [FIRST_NM, LAST_NM]).with_ticks(Ticks::Auto).with_grid(true);
    // Room for the axis title below the curves.
    let y = Axis::hidden([low - 0.2 * high, high * if few && drawn.len() > 1 { 1.5 } else { 1.12 }]);
    let mut panel = Panel::new(format!("Curves of {}", entry.name), Rect::from_min_size([0.0, 0.0], size), x, y);
    for (name, points) in &drawn {
        let line = Shape::Line { points: points.clone(), closed: false };
        let width = if few { 1.5 } else { 1.0 };
        panel.marks.push(Mark::new(PickIndex::NONE, name.as_str(), line).with_stroke(role, width));
    }
    if all.len() > drawn.len() {
        panel.note = format!("{} of {} curves", drawn.len(), all.len());
    }
    if few && drawn.len() > 1 {
        let mut labels = Labels::new(&panel);
        for name in drawn.iter().filter_map(|(name, points)| at_peak(name, points)) {
            name.place(&mut labels);
        }
        panel.marks.extend(labels.into_marks());
    }
    Ok(Some(panel))
}

/// The same without axes and names, for a cell of a table.
pub fn sparkline(ask: &impl Ask, entry: &Entry, role: InkRole, size: [f64; 2]) -> Result<Option<Panel>, LoadError> {
    let all = curves(&entry.place, ask)?;
    let drawn = drawn(entry, &all);
    let high =
        drawn.iter().flat_map(|(_, points)| points.iter().map(|point| point[1])).fold(f64::MIN_POSITIVE, f64::max);
    let [x, y] = [Axis::hidden([FIRST_NM, LAST_NM]), Axis::hidden([-0.05 * high, 1.05 * high])];
    let mut panel = Panel::new(String::new(), Rect::from_min_size([0.0, 0.0], size), x, y);
    for (_, points) in drawn {
        let line = Shape::Line { points, closed: false };
        panel.marks.push(Mark::new(PickIndex::NONE, "", line).with_stroke(role, 1.0));
    }
    Ok((!panel.marks.is_empty()).then_some(panel))
}

/// Names and points of the curves that are drawn.
fn drawn(entry: &Entry, all: &[(String, SpectralDistribution)]) -> Vec<(String, Vec<[f64; 2]>)> {
    let relative = matches!(entry.kind, SetKind::Camera | SetKind::Observer | SetKind::Illuminant | SetKind::Unsorted);
    let channels = if let Place::Own(set) = &entry.place { set.channels } else { [0, 1, 2] };
    let chosen: Vec<&(String, SpectralDistribution)> = if entry.kind == SetKind::Camera && all.len() > 3 {
        channels.iter().filter_map(|&channel| all.get(channel)).collect()
    } else {
        let count = all.len().min(MOST);
        (0..count).filter_map(|index| all.get(index * all.len() / count)).collect()
    };
    let curve = |(name, curve): &(String, SpectralDistribution)| {
        let within = |nm: f64| (FIRST_NM..=LAST_NM).contains(&nm);
        let samples = curve.wavelengths_nm().iter().copied().zip(curve.values().iter().copied());
        let points: Vec<[f64; 2]> = samples.filter(|(nm, _)| within(*nm)).map(|(nm, value)| [nm, value]).collect();
        let peak = points.iter().map(|point| point[1]).fold(0.0, f64::max);
        let scale = if relative && peak > 0.0 { peak } else { 1.0 };
        (name.clone(), points.into_iter().map(|[nm, value]| [nm, value / scale]).collect())
    };
    chosen.into_iter().map(curve).collect()
}

/// The name of a curve at its peak.
fn at_peak(name: &str, points: &[[f64; 2]]) -> Option<Name> {
    let at = points.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]))?;
    Some(Name { text: channel_symbol(name), ink: Ink::new(InkRole::Text), points: vec![at] })
}

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
        // No farther: a letter beside another curve would name that one.
        let above = [8.0, -8.0, 16.0, -16.0].map(|x| (Anchor::BOTTOM, [x, -3.0]));
        let at = |sides: &[(Anchor, [f64; 2])]| -> Vec<LabelPlace> {
            let places = self.points.iter().flat_map(|at| sides.iter().map(|(anchor, offset)| (*at, *anchor, *offset)));
            places.map(|(at, anchor, offset)| LabelPlace { at, anchor, offset }).collect()
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
