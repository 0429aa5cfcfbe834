//! Points with normals, and single form factors from them.
use crate::error::refused;
use crate::polygons::{Arrays, polygons};
use formfactor::{DVec3, DifferentialArea, FormFactor, PlanarPolygon};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Positions and normals (n, 3), and the polygons that the points lie on, -1 for none.
pub(crate) type Points<'py> =
    (PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>, Option<PyReadonlyArray1<'py, i64>>);

/// Points of an enclosure of so many polygons.
pub(crate) fn points(points: &Points<'_>, polygons: usize) -> PyResult<Vec<DifferentialArea>> {
    let (positions, normals, owners) = points;
    let (positions, normals) =
        (positions.as_slice()?.as_chunks::<3>().0, normals.as_slice()?.as_chunks::<3>().0);
    let owners = owners.as_ref().map(|owners| owners.as_slice()).transpose()?;
    if positions.len() != normals.len() || owners.is_some_and(|owners| owners.len() != positions.len()) {
        return Err(refused("", "there are not as many positions as normals and owners"));
    }
    let point = |i: usize| {
        let named = |error: &dyn std::fmt::Display| refused(format!("point {i}: "), error);
        let [position, normal] = [positions[i], normals[i]].map(DVec3::from);
        let area = DifferentialArea::new(position, normal).map_err(|error| named(&error))?;
        match owners.map_or(-1, |owners| owners[i]) {
            -1 => Ok(area),
            owner => match usize::try_from(owner) {
                Ok(id) if id < polygons => Ok(area.owned_by(id)),
                _ => Err(named(&format!("there is no polygon {owner}"))),
            },
        }
    };
    (0..positions.len()).map(point).collect()
}

fn single(position: [f64; 3], normal: [f64; 3]) -> PyResult<DifferentialArea> {
    DifferentialArea::new(position.into(), normal.into()).map_err(|error| refused("", error))
}

fn target(py: Python<'_>, arrays: &Arrays<'_>) -> PyResult<PlanarPolygon> {
    polygons(py, "target", arrays)?.into_iter().next().ok_or_else(|| refused("", "there is no target"))
}

/// From a point to a polygon past others: the value and a bound on its error.
#[pyfunction]
pub(crate) fn form_factor(
    py: Python<'_>,
    position: [f64; 3],
    normal: [f64; 3],
    to: Arrays<'_>,
    occluders: Arrays<'_>,
) -> PyResult<(f64, f64)> {
    let (from, to, occluders) =
        (single(position, normal)?, target(py, &to)?, polygons(py, "occluder", &occluders)?);
    let FormFactor { value, error_bound } = py.detach(|| formfactor::form_factor(&from, &to, &occluders));
    Ok((value, error_bound))
}

/// 1 less the form factor to a polygon with nothing in between.
#[pyfunction]
pub(crate) fn unoccluded_complement(
    py: Python<'_>,
    position: [f64; 3],
    normal: [f64; 3],
    to: Arrays<'_>,
) -> PyResult<(f64, f64)> {
    let (from, to) = (single(position, normal)?, target(py, &to)?);
    let FormFactor { value, error_bound } = py.detach(|| formfactor::unoccluded_complement(&from, &to));
    Ok((value, error_bound))
}

/// The rings of the part of a polygon that a point sees past others.
#[pyfunction]
pub(crate) fn visible_part<'py>(
    py: Python<'py>,
    position: [f64; 3],
    normal: [f64; 3],
    to: Arrays<'py>,
    occluders: Arrays<'py>,
) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
    let (from, to, occluders) =
        (single(position, normal)?, target(py, &to)?, polygons(py, "occluder", &occluders)?);
    let part = py.detach(|| formfactor::visible_part(&from, &to, &occluders));
    let ring = |ring: Vec<DVec3>| {
        let numbers: Vec<f64> = ring.iter().flat_map(|p| p.to_array()).collect();
        PyArray1::from_vec(py, numbers).reshape([ring.len(), 3])
    };
    part.rings().map(ring).collect()
}
