//! Texts of the diagram: what is named first, and how a line's name is told from another line's.

use chromascope_figure::{InkRole, Label, Labels, Mark, Panel, Place, TextSize};

/// Distance that sensors' names keep from markers of patches, in points.
const CLEARANCE: f64 = 8.0;
/// Distance of two lines' ends below which a name beside one could be the other's.
const CROWDED: f64 = 16.0;

/// Rank of a label: the lower one is placed first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// A patch that is pointed at or chosen: never left out.
    Pointed,
    Patch,
    Light,
    White,
    Temperature,
    Sensor,
    Ground,
}

/// A small text of a rank, without a leader.
pub(super) fn label(rank: Rank, text: impl Into<String>, ink: InkRole, places: Vec<Place>) -> (Rank, Label) {
    let size = if rank <= Rank::Patch { TextSize::Body } else { TextSize::Small };
    let clearance = if rank == Rank::Sensor { CLEARANCE } else { 0.0 };
    (rank, Label { size, clearance, always: rank == Rank::Pointed, ..Label::new(text, ink, places) })
}

/// Places labels among the marks of a panel in order of rank, the reference's name before other sensors'.
pub(super) fn placed(mut all: Vec<(Rank, Label)>, panel: &Panel) -> Vec<Mark> {
    let mut labels = Labels::new(panel);
    all.sort_by_key(|(rank, label)| (*rank, label.ink.role != InkRole::Reference));
    let names: Vec<String> = all.iter().map(|(_, label)| label.text.clone()).collect();
    let end = |label: &Label| Some(labels.projection().at(*label.starts.last()?));
    let sensors = all.iter().filter(|(rank, _)| *rank == Rank::Sensor);
    let ends: Vec<[f64; 2]> = sensors.filter_map(|(_, label)| end(label)).collect();
    for (rank, label) in &mut all {
        let Some([x, y]) = end(label).filter(|_| *rank == Rank::Sensor) else { continue };
        if matches!(label.ink.role, InkRole::Sensor(_)) {
            label.shorter = shortened(&label.text, &names);
        }
        let is_crowded = ends.iter().filter(|end| (end[0] - x).hypot(end[1] - y) < CROWDED).count() > 1;
        // The reference's line is thick enough to be told by itself.
        if is_crowded && label.ink.role != InkRole::Reference {
            // Leaders from ends that lie close together could be each other's.
            label.starts.truncate(1);
            label.prefers_leader = true;
        }
    }
    for (_, label) in &all {
        labels.place(label);
    }
    labels.into_marks()
}

/// A camera's name without what stands in brackets, and without its maker too, where no other name holds the same.
fn shortened(name: &str, names: &[String]) -> Vec<String> {
    let model = name.split_once(" (").map_or(name, |(model, _)| model);
    let is_alone = |short: &&str| names.iter().filter(|other| other.contains(*short)).count() == 1;
    let without_maker = model.split_once(' ').map(|(_, rest)| rest);
    [Some(model), without_maker].into_iter().flatten().filter(is_alone).map(str::to_owned).collect()
}
