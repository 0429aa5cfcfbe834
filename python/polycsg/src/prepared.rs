//! One feature that is asked often.
use crate::alone::{place, regions};
use crate::ragged::{Arrays, Built, Ragged, Returned};
use crate::run::run;
use numpy::{PyArray1, PyReadonlyArray2};
use polycsg::{DVec2, Limits, PreparedRegion};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::Ordering;

/// One feature with what makes questions about it fast.
#[pyclass(frozen, module = "polycsg._polycsg")]
pub(crate) struct Prepared(PreparedRegion);

#[pymethods]
impl Prepared {
    #[new]
    fn new(py: Python<'_>, features: Arrays<'_>, fill: &str) -> PyResult<Self> {
        let region = regions(py, Ragged::of(&features)?, fill)?.into_iter().next();
        Ok(Self(region.unwrap_or_default().into()))
    }

    /// What each feature has in common with it.
    fn clip<'py>(&self, py: Python<'py>, features: Arrays<'py>, fill: &str) -> PyResult<Returned<'py>> {
        let features = Ragged::of(&features)?;
        let regions = regions(py, features, fill)?;
        let clipped = run(py, features.vertices(), |stop| {
            let is_stopped = || stop.load(Ordering::Relaxed);
            self.0
                .try_clip_all(&regions, Limits::default().stop(&is_stopped))
                .map_err(|error| crate::error::of_feature(0, error))
        })?;
        Built::of(&clipped).into_python(py)
    }

    /// Where points lie: 1 inside, 0 on the boundary, -1 outside.
    fn locate<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i8>>> {
        let points = points.as_slice()?.as_chunks::<2>().0;
        let found: Vec<i8> =
            py.detach(|| points.par_iter().map(|p| place(self.0.locate(DVec2::from(*p)))).collect());
        Ok(PyArray1::from_vec(py, found))
    }
}
