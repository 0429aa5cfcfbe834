//! Sessions, shapes and answers that the tests share.
#![allow(dead_code, unreachable_pub, reason = "each test uses its part")]
#![allow(clippy::cast_possible_truncation, reason = "numbers in tests are small")]
use arrow_array::cast::AsArray;
use arrow_array::{ArrayRef, BinaryArray, RecordBatch, StringArray};
use datafusion::datasource::MemTable;
use datafusion::prelude::{SessionConfig, SessionContext};
use datafusion_common::{DataFusionError, Result};
use polycsg_datafusion::{Error, Functions};
use std::sync::Arc;

/// A ring as its corners, the first not repeated.
pub type Ring = Vec<[f64; 2]>;

/// A square between two corners on the diagonal.
pub fn square(low: f64, high: f64) -> Ring {
    vec![[low, low], [high, low], [high, high], [low, high]]
}

pub fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Ring {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}

/// Polygons as the WKB of a multipolygon, written independently of the crate.
pub fn wkb(polygons: &[Vec<Ring>]) -> Vec<u8> {
    let parts = polygons.iter().flat_map(|rings| polygon_wkb(rings));
    [1].into_iter().chain(word(6)).chain(word(polygons.len())).chain(parts).collect()
}

/// Rings as the WKB of a polygon.
pub fn polygon_wkb(rings: &[Ring]) -> Vec<u8> {
    let mut bytes: Vec<u8> = [1].into_iter().chain(word(3)).chain(word(rings.len())).collect();
    for ring in rings {
        let closed = ring.iter().chain(ring.first());
        bytes.extend(word(closed.clone().count()));
        bytes.extend(closed.flatten().flat_map(|x| x.to_le_bytes()));
    }
    bytes
}

pub fn point_wkb(x: f64, y: f64) -> Vec<u8> {
    [1].into_iter().chain(word(1)).chain([x, y].into_iter().flat_map(f64::to_le_bytes)).collect()
}

fn word(count: usize) -> [u8; 4] {
    u32::try_from(count).expect("a small count").to_le_bytes()
}

/// A session with the functions and so many partitions.
pub fn session(partitions: usize) -> SessionContext {
    session_of(SessionConfig::new().with_target_partitions(partitions), Functions::default())
}

pub fn session_of(config: SessionConfig, functions: Functions) -> SessionContext {
    let mut context = SessionContext::new_with_config(config);
    functions.register(&mut context).expect("the session takes them");
    context
}

/// A key and a geometry.
pub type Row<'k> = (&'k str, Option<Vec<u8>>);

/// A table of a key and a geometry, in partitions.
pub fn add_table(context: &SessionContext, name: &str, partitions: &[Vec<Row<'_>>]) {
    let batch = |rows: &Vec<Row<'_>>| {
        let keys: StringArray = rows.iter().map(|(key, _)| Some(*key)).collect();
        let geometries: BinaryArray = rows.iter().map(|(_, geometry)| geometry.as_deref()).collect();
        let columns: [(&str, ArrayRef, bool); 2] =
            [("key", Arc::new(keys), false), ("geom", Arc::new(geometries), true)];
        RecordBatch::try_from_iter_with_nullable(columns).expect("two columns of one length")
    };
    let batches: Vec<Vec<RecordBatch>> = partitions.iter().map(|rows| vec![batch(rows)]).collect();
    let table = MemTable::try_new(batches[0][0].schema(), batches).expect("one schema");
    context.register_table(name, Arc::new(table)).expect("a new name");
}

/// The answer to a query, in one batch.
pub async fn answer(context: &SessionContext, sql: &str) -> Result<RecordBatch> {
    let frame = context.sql(sql).await?;
    let schema = Arc::new(frame.schema().as_arrow().clone());
    let batches = frame.collect().await?;
    Ok(arrow_select::concat::concat_batches(&schema, &batches)?)
}

/// The only value of a query.
pub async fn value(context: &SessionContext, sql: &str) -> Result<datafusion_common::ScalarValue> {
    let batch = answer(context, sql).await?;
    assert_eq!((batch.num_rows(), batch.num_columns()), (1, 1));
    datafusion_common::ScalarValue::try_from_array(batch.column(0), 0)
}

/// The binaries of a column.
pub fn binaries(batch: &RecordBatch, column: usize) -> Vec<Option<Vec<u8>>> {
    batch.column(column).as_binary::<i32>().iter().map(|bytes| bytes.map(<[u8]>::to_vec)).collect()
}

/// The crate's own error behind the engine's.
pub fn own(error: &DataFusionError) -> Option<&Error> {
    match error.find_root() {
        DataFusionError::External(error) => error.downcast_ref(),
        _ => None,
    }
}

/// As SQL.
pub fn literal(bytes: &[u8]) -> String {
    let digits: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("X'{digits}'")
}

/// Numbers that look random, between 0 and 1.
pub struct Random(pub u64);

impl Random {
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.number() * count as f64) as usize
    }

    /// Moves everything somewhere.
    pub fn shuffle<T>(&mut self, all: &mut [T]) {
        (1..all.len()).for_each(|i| all.swap(i, self.below(i + 1)));
    }

    pub fn octagon(&mut self, side: f64, radius: f64) -> Ring {
        let [x, y] = [self.number() * side, self.number() * side];
        let corner = |i: u32| {
            let angle = f64::from(i) * std::f64::consts::FRAC_PI_4;
            [x + radius * angle.cos(), y + radius * angle.sin()]
        };
        (0..8).map(corner).collect()
    }
}
