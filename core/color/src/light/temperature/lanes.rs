//! Many colors side by side: what lies scattered in memory is fetched one by one, the arithmetic is done in wide registers.

use super::pieces::{Found, Pieces, Seen, TERMS, UNIT, index};
use super::start::{Start, between};
use crate::colorimetry::Uv60;
use crate::math::array::{array, each};
use multiversion::multiversion;

/// Colors per run: enough for any register, few enough for the nearest cache beside the pieces.
pub(super) const LANES: usize = 32;

type Row = [f64; LANES];

/// Colors with what their searches need, coefficient by coefficient, and what was found.
#[derive(Clone, Debug)]
pub(super) struct Lanes {
    u: Row,
    v: Row,
    cells: [[u32; LANES]; 2],
    within: [Row; 2],
    corners: [[f32; LANES]; 4],
    start: Row,
    pieces: [u32; LANES],
    middle: [Row; 3],
    own: [Row; TERMS],
    du: [Row; TERMS],
    dv: [Row; TERMS],
    kelvins: Row,
    duv: Row,
    good: [bool; LANES],
}

impl Lanes {
    pub(super) const NOTHING: Self = Self {
        u: [0.0; LANES],
        v: [0.0; LANES],
        cells: [[0; LANES]; 2],
        within: [[0.0; LANES]; 2],
        corners: [[0.0; LANES]; 4],
        start: [0.0; LANES],
        pieces: [0; LANES],
        middle: [[0.0; LANES]; 3],
        own: [[0.0; LANES]; TERMS],
        du: [[0.0; LANES]; TERMS],
        dv: [[0.0; LANES]; TERMS],
        kelvins: [0.0; LANES],
        duv: [0.0; LANES],
        good: [false; LANES],
    };

    /// Searches for up to [`LANES`] colors; in the lanes beyond them stays what was there.
    pub(super) fn solve(&mut self, start: &Start, pieces: &Pieces, colors: &[Uv60]) {
        for (lane, color) in colors.iter().enumerate().take(LANES) {
            (self.u[lane], self.v[lane]) = (color.u, color.v);
        }
        solve(self, start, pieces);
    }

    /// Temperature found for one color, if the search ended in the domain.
    #[inline]
    pub(super) fn found(&self, lane: usize) -> Option<Found> {
        self.good[lane].then(|| Found { kelvins: self.kelvins[lane], duv: self.duv[lane], good: true })
    }
}

/// Compiled for several instruction sets, the best chosen at run time; no operation is fused, so all of them give the same
/// bits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd", "x86_64+avx2", "aarch64+neon"))]
fn solve(lanes: &mut Lanes, start: &Start, pieces: &Pieces) {
    for lane in 0..LANES {
        let place = start.place(Uv60 { u: lanes.u[lane], v: lanes.v[lane] });
        (lanes.cells[0][lane], lanes.cells[1][lane]) = (place.column, place.row);
        (lanes.within[0][lane], lanes.within[1][lane]) = (place.right, place.up);
    }
    for lane in 0..LANES {
        let corners = start.cell(lanes.cells[0][lane], lanes.cells[1][lane]);
        for k in 0..4 {
            lanes.corners[k][lane] = corners[k];
        }
    }
    for lane in 0..LANES {
        let corners = array(|k| lanes.corners[k][lane]);
        let mired = between(corners, lanes.within[0][lane], lanes.within[1][lane]);
        (lanes.start[lane], lanes.pieces[lane]) = (mired, index(mired));
    }
    // Four at a time: written lane by lane, the stores would take longer than all of the arithmetic.
    for first in (0..LANES).step_by(4) {
        let piece = |lane: usize| pieces.get(lanes.pieces[first + lane]);
        let four = [piece(0), piece(1), piece(2), piece(3)];
        let run = first..first + 4;
        for k in 0..TERMS {
            lanes.own[k][run.clone()].copy_from_slice(&each(four, |piece| piece.own[k]));
            lanes.du[k][run.clone()].copy_from_slice(&each(four, |piece| piece.du[k]));
            lanes.dv[k][run.clone()].copy_from_slice(&each(four, |piece| piece.dv[k]));
        }
        lanes.middle[0][run.clone()].copy_from_slice(&each(four, |piece| piece.middle.u));
        lanes.middle[1][run.clone()].copy_from_slice(&each(four, |piece| piece.middle.v));
        lanes.middle[2][run].copy_from_slice(&each(four, |piece| piece.mired));
    }
    for lane in 0..LANES {
        let column = |rows: &[Row; TERMS]| -> [f64; TERMS] { array(|k| rows[k][lane]) };
        let [u, v, mired] = array(|c| lanes.middle[c][lane]);
        let color = Uv60 { u: lanes.u[lane], v: lanes.v[lane] };
        let seen = Seen::new(color, Uv60 { u, v }, column(&lanes.own), column(&lanes.du), column(&lanes.dv));
        let found = seen.solve((lanes.start[lane] - mired) * (1.0 / UNIT), mired);
        (lanes.kelvins[lane], lanes.duv[lane], lanes.good[lane]) = (found.kelvins, found.duv, found.good);
    }
}
