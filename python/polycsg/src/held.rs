//! Features that are held on this side of the border: those of Arrow, which are not copied, and those read from WKB.
use crate::built::{Built, Returned};
use crate::ragged::{Ragged, Steps};
use arrow_array::OffsetSizeTrait;
use arrow_buffer::{NullBuffer, OffsetBuffer, ScalarBuffer};
use numpy::PyArray1;
use pyo3::prelude::*;

/// Offsets as Arrow has them.
pub(crate) enum HeldOffsets {
    Wide(ScalarBuffer<i64>),
    Narrow(ScalarBuffer<i32>),
}

impl HeldOffsets {
    pub(crate) fn of<O: OffsetSizeTrait>(offsets: &OffsetBuffer<O>) -> Self {
        let (buffer, length) = (offsets.inner().inner().clone(), offsets.len());
        if O::IS_LARGE {
            Self::Wide(ScalarBuffer::new(buffer, 0, length))
        } else {
            Self::Narrow(ScalarBuffer::new(buffer, 0, length))
        }
    }

    fn steps(&self) -> Steps<'_> {
        match self {
            Self::Wide(offsets) => Steps::Wide(offsets),
            Self::Narrow(offsets) => Steps::Narrow(offsets),
        }
    }
}

/// Features on this side, in the order of [`Ragged`].
#[pyclass(frozen, module = "polycsg._polycsg")]
pub(crate) struct HeldFeatures {
    pub(crate) coordinates: ScalarBuffer<f64>,
    pub(crate) rings: HeldOffsets,
    pub(crate) polygons: HeldOffsets,
    /// None where each feature is a polygon.
    pub(crate) features: Option<HeldOffsets>,
    /// Which features are there; all, if none.
    pub(crate) present: Option<NullBuffer>,
    /// GeoArrow's metadata: JSON that may name the coordinates' system.
    #[pyo3(get)]
    pub(crate) metadata: Option<String>,
}

impl HeldFeatures {
    pub(crate) fn of(built: Built, present: Option<NullBuffer>, metadata: Option<String>) -> Self {
        let [rings, polygons, features] =
            [built.rings, built.polygons, built.features].map(|offsets| HeldOffsets::Wide(offsets.into()));
        Self {
            coordinates: built.vertices.into(),
            rings,
            polygons,
            features: Some(features),
            present,
            metadata,
        }
    }

    pub(crate) fn read(&self) -> PyResult<Ragged<'_>> {
        let features = self.features.as_ref().map(HeldOffsets::steps);
        let ragged =
            Ragged::new(&self.coordinates, self.rings.steps(), Some(self.polygons.steps()), features)?;
        Ok(ragged.with_present(self.present.as_ref()))
    }
}

#[pymethods]
impl HeldFeatures {
    fn __len__(&self) -> PyResult<usize> {
        Ok(self.read()?.len())
    }

    /// Which features are missing; None where none is.
    fn missing<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<bool>>> {
        let present = self.present.as_ref().filter(|present| present.null_count() > 0)?;
        Some(PyArray1::from_iter(py, present.iter().map(|is_there| !is_there)))
    }

    /// A copy as arrays of numpy.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Returned<'py>> {
        Built::copied(self.read()?).into_python(py)
    }
}
