//! One feature that is asked often.
use crate::alone::{evaluate, regions};
use crate::built::{Built, Returned};
use crate::input::Features;
use crate::ragged::rule;
use crate::run::{each, run};
use numpy::{PyArray1, PyReadonlyArray2};
use polycsg::{Csg, DVec2, Location, PreparedRegion, Scratch};
use pyo3::prelude::*;

/// One feature with what makes questions about it fast.
#[pyclass(frozen, module = "polycsg._polycsg")]
pub(crate) struct Prepared(PreparedRegion);

#[pymethods]
impl Prepared {
    #[new]
    fn new(py: Python<'_>, features: Features<'_>, fill: &str) -> PyResult<Self> {
        let (features, rule) = (features.read()?, rule(fill)?);
        let prepared = run(py, features.vertices(), |stop| {
            Ok(regions(features, rule, stop)?.into_iter().next().unwrap_or_default().into())
        })?;
        Ok(Self(prepared))
    }

    /// What each feature has in common with it.
    fn clip<'py>(&self, py: Python<'py>, features: Features<'py>, fill: &str) -> PyResult<Returned<'py>> {
        let (features, rule) = (features.read()?, rule(fill)?);
        let built = run(py, features.vertices(), |stop| {
            let clip = |scratch: &mut Scratch, i: usize| {
                evaluate(&(features.operand(i, rule)? & Csg::from(&self.0)), i, scratch, stop)
            };
            Ok(Built::of(&each(features.len(), stop, clip)?))
        })?;
        built.into_python(py)
    }

    /// Where points lie: 1 inside, 0 on the boundary, -1 outside.
    fn locate<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i8>>> {
        let points = points.as_slice()?.as_chunks::<2>().0;
        let place = |p: &[f64; 2]| match self.0.locate(DVec2::from(*p)) {
            Location::Inside => 1,
            Location::Boundary => 0,
            Location::Outside => -1,
        };
        let found = run(py, points.len(), |stop| each(points.len(), stop, |_, i| Ok(place(&points[i]))))?;
        Ok(PyArray1::from_vec(py, found))
    }
}
