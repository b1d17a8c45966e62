//! Places of one file's curves in its text.

use std::ops::Range;

use crate::decision::{Orientation, Reader, WavelengthUnit};
use crate::dialect_trial::Layout;
use crate::grid::{Grid, Origins};
use crate::preview::mark::{LeftOut, Mark, What};
use crate::preview::tables::{self, Across, Down};
use crate::report::SpectralFile;
use crate::watch::{Place, PlaceKind, Places};

/// Line, column or bytes of each sample, name and setting, recorded while a file was read. Made by
/// [`read_marked`](crate::read_marked).
#[derive(Debug, Clone)]
pub struct Marker {
    /// The lines of settings, in ascending order.
    settings: Vec<u32>,
    first_line: usize,
    /// The curves that were read, by which a marker of another file is known.
    curves: usize,
    unit: WavelengthUnit,
    plan: Plan,
}

#[derive(Debug, Clone)]
enum Plan {
    Down(Down),
    Across(Across),
    /// Each sample by its bytes, in the order of the text.
    Placed(Vec<Place>),
}

impl Marker {
    /// Takes over what was recorded; [`take_curves`](Self::take_curves) completes it.
    pub(crate) fn new(places: Places<'_>, grid: &Grid, layout: &Layout, reader: Reader, unit: WavelengthUnit) -> Self {
        let plan = match (&layout.across, reader, layout.orientation.value) {
            (Some(across), Reader::TABLE, Orientation::Across) => {
                Plan::Across(Across::new(layout, across, places.line(across.line), unit))
            }
            (_, Reader::TABLE, _) => Plan::Down(Down::new(grid, layout, unit)),
            _ => Plan::Placed(places.used()),
        };
        let mut settings = grid.header.noted.clone();
        settings.sort_unstable();
        Self { settings, first_line: layout.first_line, curves: 0, unit, plan }
    }

    pub(crate) fn take_curves(&mut self, origins: &Origins) {
        let uncertain = origins.uncertain.clone();
        let origins = &origins.curves;
        self.curves = origins.len();
        let by_curve = origins.iter().enumerate().map(|(curve, origin)| (*origin, curve));
        if let Plan::Across(across) = &mut self.plan {
            across.rows = by_curve.collect();
            across.uncertain = uncertain;
            return;
        }
        let mut curves = vec![None; origins.iter().max().map_or(0, |last| last + 1)];
        by_curve.for_each(|(origin, curve)| curves[origin] = Some(curve));
        match &mut self.plan {
            Plan::Down(down) => (down.curves, down.uncertain) = (curves, uncertain.into_iter().collect()),
            Plan::Placed(all) => all.retain_mut(|place| {
                let curve = curves.get(place.origin as usize).copied().flatten();
                place.origin = curve.unwrap_or_default() as u32;
                place.wavelength = self.unit.nanometers(place.wavelength);
                curve.is_some()
            }),
            Plan::Across(_) => {}
        }
    }

    pub(super) fn marks(
        &self,
        (number, start): (usize, usize),
        line: &str,
        window: &Range<usize>,
        file: &SpectralFile,
    ) -> Vec<Mark> {
        if file.curves.len() != self.curves {
            return Vec::new();
        }
        let marks = match &self.plan {
            Plan::Down(down) => down.marks(number, line, window, file),
            Plan::Across(across) => across.marks(number, line, window, file),
            Plan::Placed(all) => placed(all, start, line, window, file),
        };
        let above = number < self.first_line || matches!(self.plan, Plan::Placed(_));
        if !marks.is_empty() || !above || self.settings.binary_search(&(number as u32)).is_err() {
            return marks;
        }
        tables::line_mark(line, window, What::Setting)
    }
}

fn placed(all: &[Place], start: usize, line: &str, window: &Range<usize>, file: &SpectralFile) -> Vec<Mark> {
    let first = all.partition_point(|piece| (piece.end as usize) < start.saturating_add(window.start));
    let last = start + line.len().min(window.end);
    let pieces = all[first..].iter().take_while(|piece| (piece.start as usize) < last);
    let marks = pieces.filter_map(|piece| {
        let range = (piece.start as usize).checked_sub(start)?..piece.end as usize - start;
        let written = line.get(range.clone())?;
        Some(Mark { range, what: what(piece, written, file)? })
    });
    marks.collect()
}

fn what(place: &Place, written: &str, file: &SpectralFile) -> Option<What> {
    let curve = place.origin as usize;
    Some(match place.kind {
        PlaceKind::Wavelength => What::Wavelength(place.wavelength),
        PlaceKind::Value => tables::value(tables::number(written)?, curve, place.wavelength, file),
        PlaceKind::Block | PlaceKind::Check => What::Block(curve),
        PlaceKind::Repeated => What::LeftOut(LeftOut::Repeated),
        PlaceKind::Averaged => What::LeftOut(LeftOut::Averaged),
    })
}
