//! Arrays of multipolygons as one array of vertices and three of offsets: where the rings begin in the vertices, the polygons in the
//! rings, and the features in the polygons. The layout is that of GeoArrow and of `shapely.to_ragged_array`.
use crate::error::{of_feature, unreadable};
use arrow_buffer::NullBuffer;
use polycsg::{Csg, FillRule};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::ops::Range;

/// Offsets to read.
#[derive(Clone, Copy)]
pub(crate) enum Steps<'a> {
    Wide(&'a [i64]),
    Narrow(&'a [i32]),
    /// So many, of one each.
    Each(usize),
}

impl Steps<'_> {
    fn len(self) -> usize {
        match self {
            Steps::Wide(steps) => steps.len(),
            Steps::Narrow(steps) => steps.len(),
            Steps::Each(count) => count + 1,
        }
    }

    fn value(self, i: usize) -> i64 {
        match self {
            Steps::Wide(steps) => steps[i],
            Steps::Narrow(steps) => i64::from(steps[i]),
            Steps::Each(_) => i64::try_from(i).unwrap_or(i64::MAX),
        }
    }

    /// Checked before.
    fn at(self, i: usize) -> usize {
        usize::try_from(self.value(i)).unwrap_or_default()
    }

    fn span(self, i: usize) -> Range<usize> {
        self.at(i)..self.at(i + 1)
    }

    /// How many parts there are, which begin at 0 or later, never step back, and end at `count` or before.
    fn check(self, name: &str, count: usize) -> PyResult<usize> {
        let most = i64::try_from(count)?;
        if self.len() == 0 {
            return Err(unreadable(format!("offsets of {name} are empty; give at least one, 0")));
        }
        let steps_back = |&i: &usize| self.value(i) < if i == 0 { 0 } else { self.value(i - 1) };
        if let Some(i) = (0..self.len()).find(|i| steps_back(i) || self.value(*i) > most) {
            let value = self.value(i);
            return Err(unreadable(format!(
                "offset {i} of {name} is {value}: offsets must not step back, nor lie outside of 0 to {count}"
            )));
        }
        Ok(self.len() - 1)
    }
}

/// Features to read.
#[derive(Clone, Copy)]
pub(crate) struct Ragged<'a> {
    vertices: &'a [[f64; 2]],
    rings: Steps<'a>,
    polygons: Steps<'a>,
    features: Steps<'a>,
    /// Which features are there; all, if none.
    present: Option<&'a NullBuffer>,
    /// Which of several operands this is, for messages.
    operand: Option<usize>,
}

impl<'a> Ragged<'a> {
    pub(crate) fn new(
        coordinates: &'a [f64],
        rings: Steps<'a>,
        polygons: Option<Steps<'a>>,
        features: Option<Steps<'a>>,
    ) -> PyResult<Self> {
        let (vertices, []) = coordinates.as_chunks::<2>() else {
            return Err(unreadable("vertices have two columns"));
        };
        let count = rings.check("rings", vertices.len())?;
        let polygons = polygons.unwrap_or(Steps::Each(count));
        let count = polygons.check("polygons", count)?;
        let features = features.unwrap_or(Steps::Each(count));
        features.check("features", count)?;
        Ok(Self { vertices, rings, polygons, features, present: None, operand: None })
    }

    pub(crate) fn with_present(self, present: Option<&'a NullBuffer>) -> Self {
        Self { present, ..self }
    }

    pub(crate) fn as_operand(self, operand: usize) -> Self {
        Self { operand: Some(operand), ..self }
    }

    /// How many features there are.
    pub(crate) fn len(self) -> usize {
        self.features.len() - 1
    }

    /// How many vertices there are.
    pub(crate) fn vertices(self) -> usize {
        self.vertices.len()
    }

    /// The polygons of a feature, of which each is the numbers of its rings.
    pub(crate) fn polygons(self, feature: usize) -> impl Iterator<Item = Range<usize>> {
        let is_there = self.present.is_none_or(|present| present.is_valid(feature));
        let polygons = if is_there { self.features.span(feature) } else { 0..0 };
        polygons.map(move |polygon| self.polygons.span(polygon))
    }

    /// A ring without the vertex that closes it.
    pub(crate) fn ring(self, ring: usize) -> &'a [[f64; 2]] {
        match self.given_ring(ring) {
            [open @ .., end] if open.first() == Some(end) => open,
            ring => ring,
        }
    }

    /// A ring's vertices as they were given: the first one may stand once more at the end.
    pub(crate) fn given_ring(self, ring: usize) -> &'a [[f64; 2]] {
        &self.vertices[self.rings.span(ring)]
    }

    /// A feature as an operand.
    pub(crate) fn operand(self, feature: usize, rule: FillRule) -> PyResult<Csg<'static>> {
        let rings = self.polygons(feature).flatten().map(|ring| self.ring(ring));
        Csg::from_rings(rings, rule).map_err(|error| of_feature(self.operand, feature, error))
    }
}

/// The rule of a name.
pub(crate) fn rule(name: &str) -> PyResult<FillRule> {
    match name {
        "evenodd" => Ok(FillRule::EvenOdd),
        "nonzero" => Ok(FillRule::NonZero),
        "positive" => Ok(FillRule::Positive),
        _ => Err(PyValueError::new_err(format!(
            "fill is \"evenodd\", \"nonzero\" or \"positive\", not {name:?}"
        ))),
    }
}
