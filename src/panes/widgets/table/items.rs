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
        let column = |name: &str| table.columns.iter().position(|head| head == name);
        let mut sensors: HashMap<String, Option<SensorId>> = HashMap::new();
        for source in scene.sources() {
            let id = SensorId { kind: source.kind, name: source.name };
            sensors.entry(source.label).and_modify(|known| *known = None).or_insert(Some(id));
        }
        Self { sensor: column("sensor"), patch: column("patch"), temperature: column("temperature_k"), sensors }
    }

    /// True if no row has an item.
    pub(super) fn is_empty(&self) -> bool {
        self.sensor.is_none()
    }

    pub(super) fn of_row(&self, row: &[Cell]) -> Option<PlotItem> {
        let text = |column: Option<usize>| match row.get(column?) {
            Some(Cell::Text(text)) => Some(text.as_str()),
            _ => None,
        };
        let source = self.sensors.get(text(self.sensor)?)?.clone()?;
        if let Some(patch) = text(self.patch) {
            return Some(PlotItem::Patch { source: Some(source), patch: patch.to_owned() });
        }
        match self.temperature.and_then(|column| row.get(column)) {
            Some(Cell::Number(kelvin)) => Some(PlotItem::Radiator { source, kelvin: *kelvin }),
            _ => Some(PlotItem::Sensor(source)),
        }
    }
}
