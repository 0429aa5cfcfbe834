//! What asks each feature for itself, or all for one.
use crate::built::{Built, Returned};
use crate::error::of_feature;
use crate::input::Features;
use crate::ragged::{Ragged, rule};
use crate::run::{each, run};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use polycsg::{Csg, FillRule, Limits, Region, Scratch};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Each feature as a valid one.
#[pyfunction]
pub(crate) fn repaired<'py>(py: Python<'py>, features: Features<'py>, fill: &str) -> PyResult<Returned<'py>> {
    let (features, rule) = (features.read()?, rule(fill)?);
    let built = run(py, features.vertices(), |stop| Ok(Built::of(&regions(features, rule, stop)?)))?;
    built.into_python(py)
}

/// All features as one.
#[pyfunction]
pub(crate) fn united<'py>(py: Python<'py>, features: Features<'py>, fill: &str) -> PyResult<Returned<'py>> {
    let (features, rule) = (features.read()?, rule(fill)?);
    let built = run(py, features.vertices(), |stop| {
        let operands: PyResult<Vec<Csg>> = (0..features.len()).map(|i| features.operand(i, rule)).collect();
        Ok(Built::of([&evaluate(&Csg::union(operands?), 0, &mut Scratch::default(), stop)?]))
    })?;
    built.into_python(py)
}

/// The area of each feature.
#[pyfunction]
pub(crate) fn areas<'py>(
    py: Python<'py>,
    features: Features<'py>,
    fill: &str,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (features, rule) = (features.read()?, rule(fill)?);
    let areas: Vec<f64> = run(py, features.vertices(), |stop| {
        let is_stopped = || stop.load(Ordering::Relaxed);
        let area = |scratch: &mut Scratch, i: usize| {
            let operand = features.operand(i, rule)?;
            let boundary = operand.try_boundary(scratch, Limits::default().stop(&is_stopped));
            boundary.map(|boundary| boundary.area()).map_err(|error| of_feature(None, i, error))
        };
        each(features.len(), stop, area)
    })?;
    Ok(PyArray1::from_vec(py, areas))
}

/// Corners, and the feature of each triangle.
type Triangles<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray1<i64>>);

/// The triangles (n, 3, 2) of all features, and the feature that each is of.
#[pyfunction]
pub(crate) fn triangles<'py>(
    py: Python<'py>,
    features: Features<'py>,
    fill: &str,
) -> PyResult<Triangles<'py>> {
    let (features, rule) = (features.read()?, rule(fill)?);
    let (corners, owners) = run(py, features.vertices(), |stop| {
        let regions = regions(features, rule, stop)?;
        let found = each(regions.len(), stop, |_, i| Ok(regions[i].triangulate()))?;
        let owners = (0..).zip(&found).flat_map(|(i, part)| part.iter().map(move |_| i));
        let corners = found.iter().flatten().flatten().flat_map(|p| p.to_array());
        Ok((corners.collect::<Vec<f64>>(), owners.collect::<Vec<i64>>()))
    })?;
    let corners = PyArray1::from_vec(py, corners).reshape([owners.len(), 3, 2])?;
    Ok((corners, PyArray1::from_vec(py, owners)))
}

/// Each feature as a region.
pub(crate) fn regions(features: Ragged<'_>, rule: FillRule, stop: &AtomicBool) -> PyResult<Vec<Region>> {
    let region = |scratch: &mut Scratch, i: usize| evaluate(&features.operand(i, rule)?, i, scratch, stop);
    each(features.len(), stop, region)
}

pub(crate) fn evaluate(
    expression: &Csg<'_>,
    feature: usize,
    scratch: &mut Scratch,
    stop: &AtomicBool,
) -> PyResult<Region> {
    let is_stopped = || stop.load(Ordering::Relaxed);
    let found = expression.try_evaluate_with(scratch, Limits::default().stop(&is_stopped));
    found.map_err(|error| of_feature(None, feature, error))
}
