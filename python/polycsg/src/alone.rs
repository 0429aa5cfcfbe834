//! What asks each feature for itself, or all for one.
use crate::error::of_feature;
use crate::ragged::{Arrays, Built, Ragged, Returned, rule};
use crate::run::run;
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use polycsg::{Csg, DVec2, Limits, Location, Region, Scratch};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Each feature as a valid one.
#[pyfunction]
pub(crate) fn repaired<'py>(py: Python<'py>, features: Arrays<'py>, fill: &str) -> PyResult<Returned<'py>> {
    let regions = regions(py, Ragged::of(&features)?, fill)?;
    Built::of(&regions).into_python(py)
}

/// All features as one.
#[pyfunction]
pub(crate) fn united<'py>(py: Python<'py>, features: Arrays<'py>, fill: &str) -> PyResult<Returned<'py>> {
    let (features, rule) = (Ragged::of(&features)?, rule(fill)?);
    let region = run(py, features.vertices(), |stop| {
        let operands: PyResult<Vec<Csg>> = (0..features.len()).map(|i| features.operand(i, rule)).collect();
        evaluate(&Csg::union(operands?), 0, &mut Scratch::default(), stop)
    })?;
    Built::of([&region]).into_python(py)
}

/// The area of each feature.
#[pyfunction]
pub(crate) fn areas<'py>(
    py: Python<'py>,
    features: Arrays<'py>,
    fill: &str,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (features, rule) = (Ragged::of(&features)?, rule(fill)?);
    let areas: Vec<f64> = run(py, features.vertices(), |stop| {
        let area = |scratch: &mut Scratch, i: usize| {
            Ok(evaluate(&features.operand(i, rule)?, i, scratch, stop)?.area())
        };
        (0..features.len()).into_par_iter().map_init(Scratch::default, area).collect()
    })?;
    Ok(PyArray1::from_vec(py, areas))
}

pub(crate) fn place(location: Location) -> i8 {
    match location {
        Location::Inside => 1,
        Location::Boundary => 0,
        Location::Outside => -1,
    }
}

/// The triangles (n, 3, 2) of all features, and the feature that each is of.
#[pyfunction]
pub(crate) fn triangles<'py>(
    py: Python<'py>,
    features: Arrays<'py>,
    fill: &str,
) -> PyResult<(Bound<'py, PyArray3<f64>>, Bound<'py, PyArray1<i64>>)> {
    let regions = regions(py, Ragged::of(&features)?, fill)?;
    let found: Vec<Vec<[DVec2; 3]>> =
        py.detach(|| regions.par_iter().map(Region::triangulate).collect());
    let owners = found.iter().enumerate().flat_map(|(i, part)| part.iter().map(move |_| i as i64));
    let owners: Vec<i64> = owners.collect();
    let corners: Vec<f64> = found.iter().flatten().flatten().flat_map(|p| p.to_array()).collect();
    let corners = PyArray1::from_vec(py, corners).reshape([owners.len(), 3, 2])?;
    Ok((corners, PyArray1::from_vec(py, owners)))
}

/// Each feature as a region.
pub(crate) fn regions(py: Python<'_>, features: Ragged<'_>, fill: &str) -> PyResult<Vec<Region>> {
    let rule = rule(fill)?;
    run(py, features.vertices(), |stop| {
        let region =
            |scratch: &mut Scratch, i: usize| evaluate(&features.operand(i, rule)?, i, scratch, stop);
        (0..features.len()).into_par_iter().map_init(Scratch::default, region).collect()
    })
}

pub(crate) fn evaluate(
    expression: &Csg<'_>,
    feature: usize,
    scratch: &mut Scratch,
    stop: &AtomicBool,
) -> PyResult<Region> {
    let is_stopped = || stop.load(Ordering::Relaxed);
    let found = expression.try_evaluate_with(scratch, Limits::default().stop(&is_stopped));
    found.map_err(|error| of_feature(feature, error))
}
