//! How one table was read from a text.

use std::ops::Range;

use super::super::{Decision, Orientation, Reader, Table, photons};
use super::Preview;
use super::across::Across;
use super::down::Down;
use super::mark::Mark;
use super::settings::Settings;
use super::stream::Placed;
use super::{cells, lists, pairs, squeezed};

/// How one table was read from a text: which line, column or number belongs to which curve. Made by [`Preview::marker`].
#[derive(Debug, Clone)]
pub struct Marker {
    settings: Settings,
    plan: Plan,
}

#[derive(Debug, Clone)]
enum Plan {
    Down(Down),
    Across(Across),
    /// Every piece that was understood, in the order of the text.
    Placed(Vec<Placed>),
}

impl Marker {
    pub(super) fn new(preview: &Preview, table: &Table) -> Self {
        let reading = &table.reading;
        // Photons and powers per frequency are other numbers than those written.
        let converted = |note: &Decision| note.what == photons::DECISION && note.value.contains("converted");
        let plan = match (reading.reader.value, reading.orientation.value) {
            _ if reading.notes.iter().any(converted) => Plan::Placed(Vec::new()),
            (Reader::Table, Orientation::Down) => Plan::Down(Down::new(preview, table)),
            (Reader::Table, Orientation::Across) => Plan::Across(Across::new(preview, table)),
            (Reader::Jcamp, _) => Plan::Placed(squeezed::jcamp(preview, table)),
            (Reader::Cgats | Reader::Camspec | Reader::Dcamprof, _) => Plan::Placed(lists::place(preview, table)),
            (Reader::Cxf, _) => {
                let points = pairs::place(preview, table);
                Plan::Placed(if points.is_empty() { lists::place(preview, table) } else { points })
            }
            (Reader::Enlighten, _) => Plan::Placed(Vec::new()),
            (Reader::Labels | Reader::Alternate | Reader::Tm27 | Reader::Rawtoaces, _) => {
                Plan::Placed(pairs::place(preview, table))
            }
        };
        Self { settings: Settings::of(reading), plan }
    }

    pub(super) fn marks(
        &self,
        number: usize,
        line: &str,
        window: Range<usize>,
        table: &Table,
        preview: &Preview,
    ) -> Vec<Mark> {
        let marks = match &self.plan {
            Plan::Down(down) => down.marks(number, line, &window, table),
            Plan::Across(across) => across.marks(number, line, &window, table),
            Plan::Placed(all) => placed(all, preview.start(number).unwrap_or(0), line, &window, table),
        };
        let above = match &self.plan {
            Plan::Down(_) | Plan::Across(_) => number < table.reading.first_data_line,
            Plan::Placed(_) => true,
        };
        if !marks.is_empty() || !above {
            return marks;
        }
        let setting = self.settings.mark(line, &table.reading);
        setting.filter(|mark| cells::touches(&mark.range, &window)).into_iter().collect()
    }
}

/// The placed pieces of one line.
fn placed(all: &[Placed], start: usize, line: &str, window: &Range<usize>, table: &Table) -> Vec<Mark> {
    let first = all.partition_point(|piece| (piece.end as usize) < start.saturating_add(window.start));
    let last = start + line.len().min(window.end);
    let pieces = all[first..].iter().take_while(|piece| (piece.start as usize) < last);
    let inside = pieces.filter(|piece| piece.start as usize >= start && piece.end as usize <= start + line.len());
    inside
        .filter_map(|piece| piece.mark(start, line, table))
        .filter(|mark| line.get(mark.range.clone()).is_some())
        .collect()
}
