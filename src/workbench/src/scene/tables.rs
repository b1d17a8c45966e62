//! Tables of one camera model against each other: those of the library, recovered ones and the user's.

use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{Ask, Query, Shared};
use chromascope_core::recovery::{TableDifference, open_ends};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use chromascope_figure::{Cell, Column, Field, Table};

use super::metrics::SetPlace;
use super::recorded::CHANNELS;
use super::recovery::sensors;
use super::{Result, Scene};
use crate::catalog::names::{folded, model_of};
use crate::document::{CIE_1931, SetKind};
use crate::format::fixed;

/// Meaning of [`FIELDS`].
pub const COLUMNS: &str = "Mean ΔE*00 of the chart's patches between this table and the first, each through its own matrix; RMS of the \
    difference of the curves relative to the first's, at the scale that fits best; ends of a curve above 5 % of its peak, beyond which \
    it is unknown.";

/// Key of the column of open ends.
pub const ENDS: &str = "open_ends";

/// A table of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelTable {
    /// Difference from the first table, or the reason that there is none; none of the first itself.
    pub difference: Option<Result<TableDifference, String>>,
    /// Ends above 5 % of the peak: channel, wavelength in nanometers, share of the peak.
    pub ends: Vec<(usize, f64, f64)>,
}

/// Question for the tables of a model, which are loaded where it is answered.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ModelTablesQuery {
    tables: Vec<SetPlace>,
    light: Shared<GridSpectrum>,
    observer: Shared<Sensor>,
    patches: Shared<PatchSet>,
}

impl Query for ModelTablesQuery {
    type Answer = Result<Vec<ModelTable>>;
    const NAME: &'static str = "tables of a model";
    const CAPACITY: usize = 4;

    fn answer(&self, ask: &impl Ask) -> Self::Answer {
        let tables = sensors(&self.tables, ask)?;
        let from_first = |table: &Sensor| {
            let difference = TableDifference::new([&tables[0].1, table], &self.light, &self.observer, &self.patches);
            difference.map_err(|error| error.to_string())
        };
        let of = |(at, (_, table)): (usize, &(_, Sensor))| ModelTable {
            difference: (at > 0).then(|| from_first(table)),
            ends: open_ends(table),
        };
        Ok(tables.iter().enumerate().map(of).collect())
    }
}

impl Scene<'_> {
    /// Names of the tables of a camera's model, that of this name first. A final parenthesis is no part of a model, nor are case and
    /// punctuation.
    pub fn tables_of(&self, camera: &str) -> Vec<String> {
        let model = |name: &str| folded(model_of(name));
        let names = self.entries(SetKind::Camera).map(|entry| entry.name);
        let mut tables: Vec<String> = names.filter(|name| model(name) == model(camera)).collect();
        tables.sort_by_key(|name| name != camera);
        tables
    }

    /// Question for tables by their names, under the light and on the chart of the scene.
    pub fn model_tables(&self, names: &[String]) -> Result<ModelTablesQuery> {
        let kind = SetKind::Camera;
        let place = |name: &String| Ok(SetPlace { kind, name: name.clone(), place: self.entry(kind, name)?.place });
        Ok(ModelTablesQuery {
            tables: names.iter().map(place).collect::<Result<_>>()?,
            light: self.light()?.grid,
            observer: self.sensor(SetKind::Observer, CIE_1931)?,
            patches: self.patches()?,
        })
    }
}

/// Ends in words; empty without any.
pub fn ends(of: &ModelTable) -> String {
    let end = |(c, nm, share): &(usize, f64, f64)| {
        format!("{} at {} nm: {} %", CHANNELS[*c], fixed(*nm, 0), fixed(100.0 * share, 0))
    };
    of.ends.iter().map(end).collect::<Vec<_>>().join(", ")
}

/// Columns of what distinguishes a table from the first.
pub const FIELDS: [Field<ModelTable>; 5] = [
    from_first(["from_first_delta_e2000", "ΔE*00 to first", ""], |of| value(of, |of| of.delta_e)),
    from_first(["curve_r_percent", "R curve", "%"], |of| value(of, |of| 100.0 * of.curves[0])),
    from_first(["curve_g_percent", "G curve", "%"], |of| value(of, |of| 100.0 * of.curves[1])),
    from_first(["curve_b_percent", "B curve", "%"], |of| value(of, |of| 100.0 * of.curves[2])),
    Field::quantity([ENDS, "ends above 5 %", ""], |of| ends(of).into()),
];

const fn from_first(names: [&'static str; 3], cell: fn(&ModelTable) -> Cell) -> Field<ModelTable> {
    Field { decimals: Some(2), ..Field::quantity(names, cell) }
}

fn value(of: &ModelTable, value: fn(&TableDifference) -> f64) -> Cell {
    match &of.difference {
        None => Cell::Empty,
        Some(Err(why)) => Cell::Missing(why.clone()),
        Some(Ok(difference)) => value(difference).into(),
    }
}

/// Inserts these columns behind the name of each row's table.
pub fn insert(table: &mut Table, rows: &[ModelTable]) {
    for (at, field) in FIELDS.iter().enumerate() {
        let column = Column { hint: COLUMNS.to_owned(), ..field.into() };
        table.insert(1 + at, column, rows.iter().map(field.cell));
    }
}
