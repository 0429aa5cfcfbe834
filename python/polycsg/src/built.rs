//! Features in the making.
use crate::ragged::Ragged;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use polycsg::{DVec2, Region};
use pyo3::prelude::*;

/// Features in the order of [`crate::ragged::Ragged`].
pub(crate) struct Built {
    pub(crate) vertices: Vec<f64>,
    pub(crate) rings: Vec<i64>,
    pub(crate) polygons: Vec<i64>,
    pub(crate) features: Vec<i64>,
}

impl Default for Built {
    fn default() -> Self {
        Self { vertices: vec![], rings: vec![0], polygons: vec![0], features: vec![0] }
    }
}

impl Built {
    /// Of regions, in their order.
    pub(crate) fn of<'r>(regions: impl IntoIterator<Item = &'r Region>) -> Self {
        let mut built = Built::default();
        for region in regions {
            for polygon in region.polygons() {
                built.region_ring(polygon.outer());
                polygon.holes().for_each(|hole| built.region_ring(hole));
                built.end_polygon();
            }
            built.end_feature();
        }
        built
    }

    /// Of features, rings closed.
    pub(crate) fn copied(features: Ragged<'_>) -> Self {
        let mut built = Built::default();
        for feature in 0..features.len() {
            for polygon in features.polygons(feature) {
                for ring in polygon.map(|ring| features.ring(ring)) {
                    built.vertices.extend(ring.iter().chain(ring.first()).flatten());
                    built.end_ring();
                }
                built.end_polygon();
            }
            built.end_feature();
        }
        built
    }

    /// Adds a ring with its first vertex again at its end.
    fn region_ring(&mut self, ring: &[DVec2]) {
        self.vertices.extend(ring.iter().chain(ring.first()).flat_map(|p| p.to_array()));
        self.end_ring();
    }

    pub(crate) fn end_ring(&mut self) {
        self.rings.push(offset(self.vertices.len() / 2));
    }

    pub(crate) fn end_polygon(&mut self) {
        self.polygons.push(offset(self.rings.len() - 1));
    }

    pub(crate) fn end_feature(&mut self) {
        self.features.push(offset(self.polygons.len() - 1));
    }

    /// As arrays of numpy.
    pub(crate) fn into_python<'py>(self, py: Python<'py>) -> PyResult<Returned<'py>> {
        let count = self.vertices.len() / 2;
        let vertices = PyArray1::from_vec(py, self.vertices).reshape([count, 2])?;
        let [rings, polygons, features] =
            [self.rings, self.polygons, self.features].map(|offsets| PyArray1::from_vec(py, offsets));
        Ok((vertices, rings, polygons, features))
    }
}

/// Vertices, and offsets of rings, polygons and features.
pub(crate) type Returned<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
);

fn offset(place: usize) -> i64 {
    i64::try_from(place).unwrap_or(i64::MAX)
}
