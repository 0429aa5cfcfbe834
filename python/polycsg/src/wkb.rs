//! Polygons as well-known binary: ISO's and PostGIS's dialects are read, ISO's is written.
use crate::built::Built;
use crate::error::{no_polygon, unreadable};
use crate::held::HeldFeatures;
use crate::input::Features;
use crate::ragged::Ragged;
use arrow_buffer::NullBuffer;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyBytes;

const POLYGON: u32 = 3;
const MULTIPOLYGON: u32 = 6;

/// The kinds of geometries by their numbers.
const KINDS: [&str; 8] = [
    "Geometry",
    "Point",
    "LineString",
    "Polygon",
    "MultiPoint",
    "MultiLineString",
    "MultiPolygon",
    "GeometryCollection",
];

/// What is left to read.
struct Reader<'a> {
    bytes: &'a [u8],
    is_little: bool,
}

/// What a geometry begins with.
struct Header {
    kind: u32,
    /// How many numbers a vertex has.
    dimension: usize,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (found, rest) = self.bytes.split_first_chunk().ok_or("the bytes end too early")?;
        self.bytes = rest;
        Ok(*found)
    }

    fn integer(&mut self) -> Result<u32, String> {
        let bytes = self.take()?;
        Ok(if self.is_little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    }

    /// A count of parts of at least some bytes each.
    fn count(&mut self, bytes: usize) -> Result<usize, String> {
        let count = self.integer()? as usize;
        let fits = count.checked_mul(bytes).is_some_and(|all| all <= self.bytes.len());
        if fits { Ok(count) } else { Err("the bytes end too early".into()) }
    }

    fn number(&mut self) -> Result<f64, String> {
        let bytes = self.take()?;
        Ok(if self.is_little { f64::from_le_bytes(bytes) } else { f64::from_be_bytes(bytes) })
    }

    fn header(&mut self) -> Result<Header, String> {
        self.is_little = match self.take()? {
            [0] => false,
            [1] => true,
            [other] => return Err(format!("the order of bytes is 0 or 1, not {other}")),
        };
        let word = self.integer()?;
        let has = |bit: u32| word >> bit & 1 == 1;
        if has(29) {
            self.integer()?; // the coordinates' system
        }
        let (dialect, kind) = ((word & 0x0fff_ffff) / 1000, (word & 0x0fff_ffff) % 1000);
        let more = [has(31), has(30)].map(usize::from).iter().sum::<usize>();
        let dimension = 2 + more.max([0, 1, 1, 2].get(dialect as usize).copied().unwrap_or_default());
        Ok(Header { kind, dimension })
    }

    fn polygon(&mut self, dimension: usize, built: &mut Built) -> Result<(), String> {
        for _ in 0..self.count(4)? {
            for _ in 0..self.count(8 * dimension)? {
                let (x, y) = (self.number()?, self.number()?);
                built.vertices.extend([x, y]);
                (2..dimension).try_for_each(|_| self.number().map(|_| ()))?;
            }
            built.end_ring();
        }
        built.end_polygon();
        Ok(())
    }

    fn feature(&mut self, built: &mut Built) -> Result<(), String> {
        let header = self.header()?;
        match header.kind {
            POLYGON => self.polygon(header.dimension, built)?,
            MULTIPOLYGON => {
                for _ in 0..self.count(9)? {
                    let part = self.header()?;
                    if part.kind != POLYGON {
                        return Err(refused(part.kind));
                    }
                    self.polygon(part.dimension, built)?;
                }
            }
            other => return Err(refused(other)),
        }
        if self.bytes.is_empty() { Ok(()) } else { Err(format!("{} bytes too many", self.bytes.len())) }
    }
}

fn refused(kind: u32) -> String {
    match KINDS.get(kind as usize) {
        Some(kind) => no_polygon(kind),
        None => format!("there is no kind {kind} of geometry"),
    }
}

/// Features from bytes, none where they are missing.
pub(crate) fn parsed<'b>(
    features: impl Iterator<Item = Option<&'b [u8]>>,
    metadata: Option<String>,
) -> PyResult<HeldFeatures> {
    let (mut built, mut present) = (Built::default(), Vec::new());
    for (i, bytes) in features.enumerate() {
        let read = |bytes| Reader { bytes, is_little: true }.feature(&mut built);
        bytes.map_or(Ok(()), read).map_err(|error| unreadable(format!("feature {i}: {error}")))?;
        built.end_feature();
        present.push(bytes.is_some());
    }
    let present = Some(NullBuffer::from(present)).filter(|present| present.null_count() > 0);
    Ok(HeldFeatures::of(built, present, metadata))
}

/// Features of a list of bytes, None where they are missing.
#[pyfunction]
pub(crate) fn of_wkb(py: Python<'_>, features: Vec<Option<PyBackedBytes>>) -> PyResult<HeldFeatures> {
    py.detach(|| parsed(features.iter().map(|bytes| bytes.as_deref()), None))
}

/// Each feature as a multipolygon in bytes.
#[pyfunction]
pub(crate) fn to_wkb<'py>(py: Python<'py>, features: Features<'py>) -> PyResult<Vec<Bound<'py, PyBytes>>> {
    let features = features.read()?;
    let all: Vec<Vec<u8>> = py.detach(|| (0..features.len()).map(|i| written(features, i)).collect());
    Ok(all.iter().map(|bytes| PyBytes::new(py, bytes)).collect())
}

fn written(features: Ragged<'_>, feature: usize) -> Vec<u8> {
    let polygons: Vec<_> = features.polygons(feature).collect();
    let mut bytes = header(MULTIPOLYGON, polygons.len());
    for rings in polygons {
        bytes.extend(header(POLYGON, rings.len()));
        for ring in rings.map(|ring| features.ring(ring)) {
            let closed = ring.iter().chain(ring.first());
            bytes.extend(counted(closed.clone().count()));
            bytes.extend(closed.flatten().flat_map(|x| x.to_le_bytes()));
        }
    }
    bytes
}

fn header(kind: u32, count: usize) -> Vec<u8> {
    [&[1], &kind.to_le_bytes()[..], &counted(count)].concat()
}

fn counted(count: usize) -> [u8; 4] {
    u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes()
}
