//! Tables of one camera model against each other: those of the library, recovered ones and the user's.

use chromascope_core::patch_set::PatchSet;
use chromascope_core::query::{Ask, Query, Shared};
use chromascope_core::recovery::{TableDifference, open_ends};
use chromascope_core::spectral::{GridSpectrum, Sensor};
use chromascope_figure::{Cell, Column, Table};

use super::metrics::SetPlace;
use super::recorded::CHANNELS;
use super::recovery::sensors;
use super::{Result, Scene};
use crate::catalog::names::{folded, model_of};
use crate::document::{CIE_1931, SetKind};
use crate::format::fixed;

/// Meaning of the columns of [`insert`].
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

/// Inserts the differences and open ends of each row's table behind its name.
pub fn insert(table: &mut Table, rows: &[ModelTable]) {
    let value = |of: &ModelTable, value: &dyn Fn(&TableDifference) -> f64| match &of.difference {
        None => Cell::Empty,
        Some(Err(why)) => Cell::Missing(why.clone()),
        Some(Ok(difference)) => value(difference).into(),
    };
    let column = |key: &str, name: &str, unit: &str| Column {
        decimals: Some(2),
        hint: COLUMNS.to_owned(),
        ..Column::quantity(key, name, unit)
    };
    let delta_e = rows.iter().map(|row| value(row, &|of| of.delta_e));
    table.insert(1, column("from_first_delta_e2000", "ΔE*00 from first", ""), delta_e);
    for c in 0..3 {
        let key = format!("curve_{}_percent", ["r", "g", "b"][c]);
        let curves = rows.iter().map(|row| value(row, &|of| 100.0 * of.curves[c]));
        table.insert(2 + c, column(&key, &format!("{} curve", CHANNELS[c]), "%"), curves);
    }
    table.insert(5, column(ENDS, "ends above 5 %", ""), rows.iter().map(|row| ends(row).into()));
}
