//! Some features in a row, and what all features of a layer share.
use super::areas::{Areas, Reading};
use super::crs::Crs;
use arrow_array::{RecordBatch, RecordBatchOptions};
use arrow_schema::{ArrowError, SchemaRef};

/// What all features of a layer share.
#[derive(Clone, Debug)]
pub(crate) struct Layer {
    /// What messages call it: the file's name.
    pub(crate) name: String,
    /// Its columns, the geometry left out.
    pub(crate) schema: SchemaRef,
    pub(crate) crs: Crs,
}

/// Features in a row: each is a row of `attributes`.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    /// The number of the first feature, as the file's are counted from 0.
    pub(crate) first: usize,
    /// None where there is no geometry.
    pub(crate) areas: Vec<Option<Areas>>,
    pub(crate) attributes: RecordBatch,
}

/// A batch is full with so many features, or so many vertices: some megabytes.
const MOST_FEATURES: usize = 1024;
const MOST_VERTICES: usize = 1 << 16;

/// The geometries of a batch in the making.
#[derive(Debug, Default)]
pub(crate) struct Gathered {
    pub(crate) areas: Vec<Option<Areas>>,
    vertices: usize,
    /// The first feature of the file that lost more than x and y.
    pub(crate) flattened: Option<usize>,
    /// The number of the next feature.
    pub(crate) next: usize,
}

impl Gathered {
    pub(crate) fn push(&mut self, reading: Reading) {
        if reading.is_flattened {
            self.flattened.get_or_insert(self.next);
        }
        self.vertices += reading.areas.as_ref().map_or(0, Areas::vertices);
        self.areas.push(reading.areas);
        self.next += 1;
    }

    pub(crate) fn is_full(&self) -> bool {
        self.areas.len() >= MOST_FEATURES || self.vertices >= MOST_VERTICES
    }

    /// The batch so far, with its attributes.
    pub(crate) fn take(&mut self, attributes: RecordBatch) -> Batch {
        let areas = std::mem::take(&mut self.areas);
        self.vertices = 0;
        Batch { first: self.next - areas.len(), areas, attributes }
    }
}

/// Columns as a table of so many rows, also where there are no columns.
pub(crate) fn table(
    schema: SchemaRef,
    columns: Vec<arrow_array::ArrayRef>,
    rows: usize,
) -> Result<RecordBatch, ArrowError> {
    RecordBatch::try_new_with_options(schema, columns, &RecordBatchOptions::new().with_row_count(Some(rows)))
}
