//! Features as Python gives them.
use crate::held::HeldFeatures;
use crate::ragged::{Ragged, Steps};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Offsets as numpy has them.
#[derive(FromPyObject)]
pub(crate) enum Offsets<'py> {
    Wide(PyReadonlyArray1<'py, i64>),
    Narrow(PyReadonlyArray1<'py, i32>),
}

/// Vertices (n, 2), and offsets of rings, polygons and features; none where each is of one.
pub(crate) type Arrays<'py> =
    (PyReadonlyArray2<'py, f64>, Offsets<'py>, Option<Offsets<'py>>, Option<Offsets<'py>>);

/// Arrays of numpy's, or what is held on this side.
#[derive(FromPyObject)]
pub(crate) enum Features<'py> {
    Arrays(Arrays<'py>),
    Held(PyRef<'py, HeldFeatures>),
}

impl Offsets<'_> {
    fn steps(&self) -> PyResult<Steps<'_>> {
        Ok(match self {
            Offsets::Wide(array) => Steps::Wide(array.as_slice()?),
            Offsets::Narrow(array) => Steps::Narrow(array.as_slice()?),
        })
    }
}

impl Features<'_> {
    /// To read, checked.
    pub(crate) fn read(&self) -> PyResult<Ragged<'_>> {
        let (vertices, rings, polygons, features) = match self {
            Features::Held(held) => return held.read(),
            Features::Arrays(arrays) => arrays,
        };
        let polygons = polygons.as_ref().map(Offsets::steps).transpose()?;
        let features = features.as_ref().map(Offsets::steps).transpose()?;
        Ragged::new(vertices.as_slice()?, rings.steps()?, polygons, features)
    }
}
