//! Rows of several quantities in one table, each determined by the row's label.

use crate::grid::RawCurve;
use crate::header::Header;
use crate::header_terms;
use crate::report::Part;
use crate::role::{Quantity, Values};

/// Quantity of a row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Label {
    text: String,
    line: usize,
    quantity: Option<Quantity>,
    /// True if it is an absorbance, which is no quantity of its own.
    absorbance: bool,
}

impl Label {
    pub(super) fn of(cell: &str, line: usize) -> Self {
        let alone = !cell.trim().contains(|c: char| !c.is_alphabetic());
        let absorbance = alone && header_terms::values(cell) == Some(Values::Absorbance);
        let quantity = header_terms::quantity(cell).filter(|_| alone && !absorbance);
        Self { text: crate::text::excerpt(cell), line, quantity, absorbance }
    }

    pub(super) fn is_said(&self) -> bool {
        self.quantity.is_some() || self.absorbance
    }

    fn goes_with(&self, other: &Self) -> bool {
        (self.quantity, self.absorbance) == (other.quantity, other.absorbance)
    }

    /// Applies the label's information to all remaining rows.
    fn tell(&self, header: &mut Header) {
        header.mentioned = None;
        header.role = self.quantity.and_then(Quantity::role).map(|role| (self.line, role)).or(header.role);
        header.quantity = self.quantity.map(|quantity| (self.line, quantity)).or(header.quantity);
        header.values = self.absorbance.then_some((self.line, Values::Absorbance)).or(header.values);
    }
}

/// The column before the values with the kind of each row, if its header says so.
pub(super) fn column(leading: &[&str]) -> Option<usize> {
    const HEADS: [&str; 8] =
        ["mode", "technique", "quantity", "measurement", "measurement type", "measurement mode", "data type", "type"];
    leading.iter().position(|head| HEADS.iter().any(|wanted| head.trim().eq_ignore_ascii_case(wanted)))
}

/// Selects the rows of one quantity if there are several: the first, or the requested one. Returns all as parts.
pub(super) fn settle(
    curves: &mut Vec<RawCurve>,
    labels: &[Option<Label>],
    wanted: usize,
    header: &mut Header,
) -> Vec<Part> {
    let Some(labels) = labels.iter().cloned().collect::<Option<Vec<Label>>>() else { return Vec::new() };
    if !labels.iter().any(Label::is_said) || labels.len() != curves.len() {
        return Vec::new();
    }
    let mut kinds: Vec<(&Label, usize)> = Vec::new();
    for label in &labels {
        match kinds.iter_mut().find(|(kind, _)| kind.goes_with(label)) {
            Some((_, count)) => *count += 1,
            None => kinds.push((label, 1)),
        }
    }
    let taken = kinds.get(wanted).map_or(kinds[0].0, |(label, _)| label);
    taken.tell(header);
    if kinds.len() < 2 {
        return Vec::new();
    }
    let mut rows = labels.iter();
    curves.retain(|_| rows.next().is_none_or(|label| label.goes_with(taken)));
    let part = |(label, count): &(&Label, usize)| Part {
        line: label.line,
        name: label.text.clone(),
        curves: *count,
        rows: *count,
    };
    kinds.iter().map(part).collect()
}
