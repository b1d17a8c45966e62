//! Items of the rows of a figure's numbers.

use std::collections::HashMap;

use chromascope_figure::{Cell, Table};

use crate::plot_item::{PlotItem, SensorId};
use crate::scene::Scene;

/// Columns that identify the item of a row.
pub(super) struct RowItems {
    sensor: Option<usize>,
    patch: Option<usize>,
    temperature: Option<usize>,
    /// Sensors by label; none for a label that several have.
    sensors: HashMap<String, Option<SensorId>>,
}

impl RowItems {
    /// Finds the columns of a table.
    pub(super) fn of(scene: &Scene<'_>, table: &Table) -> Self {
        let mut sensors: HashMap<String, Option<SensorId>> = HashMap::new();
        for source in scene.sources() {
            let id = SensorId { kind: source.kind, name: source.name };
            sensors.entry(source.label).and_modify(|known| *known = None).or_insert(Some(id));
        }
        let [sensor, patch, temperature] = ["sensor", "patch", "temperature_k"].map(|key| table.place(key));
        Self { sensor, patch, temperature, sensors }
    }

    /// True if no row has an item.
    pub(super) fn is_empty(&self) -> bool {
        self.sensor.is_none()
    }

    pub(super) fn of_row(&self, row: &[Cell]) -> Option<PlotItem> {
        let cell = |column: Option<usize>| row.get(column?);
        let source = self.sensors.get(cell(self.sensor)?.text()?)?.clone()?;
        if let Some(patch) = cell(self.patch).and_then(Cell::text) {
            return Some(PlotItem::Patch { source: Some(source), patch: patch.to_owned() });
        }
        match cell(self.temperature).and_then(Cell::number) {
            Some(kelvin) => Some(PlotItem::Radiator { source, kelvin }),
            None => Some(PlotItem::Sensor(source)),
        }
    }
}
