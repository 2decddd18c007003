//! A record of a rig of one's own, as it is opened.

use std::sync::Arc;

use quadtank_record::{ColumnMeaning, Mapping, NamedUnit, Record, RecordError, Table, Unit};

/// A file that was opened as a record.
#[derive(Clone, Debug)]
pub struct OpenRecord {
    /// Its name.
    pub name: String,
    /// What is in it, if it is a table.
    pub table: Option<Arc<Table>>,
    /// What its columns are said to be.
    pub mapping: Mapping,
    /// The record that follows, or why there is none.
    pub found: Result<Arc<Record>, RecordError>,
    /// Columns whose unit was chosen by hand.
    chosen: Vec<usize>,
    /// What the level sensors give (V/m), for levels in volts.
    sensor_gain: f64,
}

impl OpenRecord {
    /// Reads a file, with columns that mean what their names say.
    pub fn read(name: String, bytes: &[u8], sensor_gain: f64) -> Self {
        match Table::read(bytes) {
            Ok(table) => {
                let mapping = Mapping::guess(&table);
                let found = Record::of(&table, &mapping, sensor_gain).map(Arc::new);
                Self { name, table: Some(Arc::new(table)), mapping, found, chosen: Vec::new(), sensor_gain }
            }
            Err(error) => Self::refused(name, error),
        }
    }

    /// A file that is no table.
    pub fn refused(name: String, error: RecordError) -> Self {
        Self { name, table: None, mapping: Mapping::empty(0), found: Err(error), chosen: Vec::new(), sensor_gain: 1.0 }
    }

    /// The record, if there is one.
    pub fn record(&self) -> Option<&Record> {
        self.found.as_deref().ok()
    }

    /// Columns without a known unit, with the unit that their names give; the default unit was assumed for them.
    pub fn assumed(&self) -> Vec<(usize, NamedUnit)> {
        let columns = self.table.iter().flat_map(|table| table.columns.iter().zip(&self.mapping.0).enumerate());
        let named = columns.filter_map(|(index, (column, meaning))| {
            let named = NamedUnit::of(&column.name, (*meaning)?.signal);
            let is_said = matches!(named, NamedUnit::Known(_)) || self.chosen.contains(&index);
            (!is_said).then_some((index, named))
        });
        named.collect()
    }

    /// Sets the unit of a column.
    pub fn set_unit(&mut self, column: usize, unit: Unit) {
        if let Some(meaning) = self.mapping.0.get(column).copied().flatten() {
            self.chosen.push(column);
            self.set_meaning(column, Some(ColumnMeaning { unit, ..meaning }));
        }
    }

    /// Says what a column is.
    pub fn set_meaning(&mut self, column: usize, meaning: Option<ColumnMeaning>) {
        let Some(table) = &self.table else { return };
        if let Some(place) = self.mapping.0.get_mut(column) {
            *place = meaning;
        }
        self.found = Record::of(table, &self.mapping, self.sensor_gain).map(Arc::new);
    }
}
