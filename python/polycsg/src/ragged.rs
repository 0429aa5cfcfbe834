//! Arrays of multipolygons as one array of vertices and three of offsets: where the rings begin in the vertices, the polygons in the
//! rings, and the features in the polygons. The layout is that of GeoArrow and of `shapely.to_ragged_array`.
use crate::error::{GeometryError, of_feature};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use polycsg::{Csg, DVec2, FillRule, Region};
use pyo3::prelude::*;

/// Offsets as they come.
#[derive(FromPyObject)]
pub(crate) enum Offsets<'py> {
    Wide(PyReadonlyArray1<'py, i64>),
    Narrow(PyReadonlyArray1<'py, i32>),
}

/// Offsets to read.
#[derive(Clone, Copy)]
enum Steps<'a> {
    Wide(&'a [i64]),
    Narrow(&'a [i32]),
}

impl Steps<'_> {
    fn len(self) -> usize {
        match self {
            Steps::Wide(steps) => steps.len(),
            Steps::Narrow(steps) => steps.len(),
        }
    }

    /// Checked to be in range.
    fn at(self, i: usize) -> usize {
        let step = match self {
            Steps::Wide(steps) => steps[i],
            Steps::Narrow(steps) => i64::from(steps[i]),
        };
        usize::try_from(step).unwrap_or_default()
    }

    /// Checks that they begin at 0 or later, never fall, and end at `count` or before.
    fn check(self, name: &str, count: usize) -> PyResult<()> {
        let value = |i: usize| match self {
            Steps::Wide(steps) => steps[i],
            Steps::Narrow(steps) => i64::from(steps[i]),
        };
        let most = i64::try_from(count)?;
        let is_fine = self.len() > 0
            && value(0) >= 0
            && value(self.len() - 1) <= most
            && (1..self.len()).all(|i| value(i - 1) <= value(i));
        let complaint = || format!("offsets of {name} must begin at 0, never fall and end at {count} at most");
        if is_fine { Ok(()) } else { Err(GeometryError::new_err(complaint())) }
    }
}

impl<'py> Offsets<'py> {
    fn steps(&self) -> PyResult<Steps<'_>> {
        Ok(match self {
            Offsets::Wide(array) => Steps::Wide(array.as_slice()?),
            Offsets::Narrow(array) => Steps::Narrow(array.as_slice()?),
        })
    }
}

/// Arrays as Python gives them: vertices (n, 2), and offsets of rings, polygons and features.
pub(crate) type Arrays<'py> = (PyReadonlyArray2<'py, f64>, Offsets<'py>, Offsets<'py>, Offsets<'py>);

/// Features to read.
#[derive(Clone, Copy)]
pub(crate) struct Ragged<'a> {
    vertices: &'a [[f64; 2]],
    rings: Steps<'a>,
    polygons: Steps<'a>,
    features: Steps<'a>,
}

impl<'a> Ragged<'a> {
    pub(crate) fn of(arrays: &'a Arrays<'_>) -> PyResult<Self> {
        let (vertices, rings, polygons, features) = arrays;
        let (vertices, []) = vertices.as_slice()?.as_chunks::<2>() else {
            return Err(GeometryError::new_err("vertices must have two columns"));
        };
        let found =
            Self { vertices, rings: rings.steps()?, polygons: polygons.steps()?, features: features.steps()? };
        found.rings.check("rings", vertices.len())?;
        found.polygons.check("polygons", found.rings.len() - 1)?;
        found.features.check("features", found.polygons.len() - 1)?;
        Ok(found)
    }

    /// How many features there are.
    pub(crate) fn len(self) -> usize {
        self.features.len() - 1
    }

    /// How many vertices there are.
    pub(crate) fn vertices(self) -> usize {
        self.vertices.len()
    }

    /// The rings of a feature, without the vertex that closes each.
    fn rings(self, feature: usize) -> impl Iterator<Item = &'a [[f64; 2]]> {
        let of = |steps: Steps<'a>, [first, last]: [usize; 2]| [steps.at(first), steps.at(last)];
        let [first, last] = of(self.polygons, of(self.features, [feature, feature + 1]));
        (first..last).map(move |ring| {
            let [first, last] = of(self.rings, [ring, ring + 1]);
            match &self.vertices[first..last] {
                [open @ .., end] if open.first() == Some(end) => open,
                ring => ring,
            }
        })
    }

    /// A feature as an operand.
    pub(crate) fn operand(self, feature: usize, rule: FillRule) -> PyResult<Csg<'static>> {
        Csg::from_rings(self.rings(feature), rule).map_err(|error| of_feature(feature, error))
    }
}

/// Features in the making.
#[derive(Default)]
pub(crate) struct Built {
    vertices: Vec<f64>,
    rings: Vec<i64>,
    polygons: Vec<i64>,
    features: Vec<i64>,
}

impl Built {
    /// Of regions, in their order.
    pub(crate) fn of<'r>(regions: impl IntoIterator<Item = &'r Region>) -> Self {
        let mut built = Built { rings: vec![0], polygons: vec![0], features: vec![0], ..Built::default() };
        for region in regions {
            for polygon in region.polygons() {
                built.ring(polygon.outer());
                polygon.holes().for_each(|hole| built.ring(hole));
                built.polygons.push(end(built.rings.len() - 1));
            }
            built.features.push(end(built.polygons.len() - 1));
        }
        built
    }

    /// Adds a ring with its first vertex again at its end.
    fn ring(&mut self, ring: &[DVec2]) {
        self.vertices.extend(ring.iter().chain(ring.first()).flat_map(|p| p.to_array()));
        self.rings.push(end(self.vertices.len() / 2));
    }

    /// As arrays of numpy, in the order of [`Arrays`].
    pub(crate) fn into_python<'py>(self, py: Python<'py>) -> PyResult<Returned<'py>> {
        let count = self.vertices.len() / 2;
        let vertices = PyArray1::from_vec(py, self.vertices).reshape([count, 2])?;
        let [rings, polygons, features] =
            [self.rings, self.polygons, self.features].map(|offsets| PyArray1::from_vec(py, offsets));
        Ok((vertices, rings, polygons, features))
    }
}

/// What is given back.
pub(crate) type Returned<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
);

fn end(place: usize) -> i64 {
    i64::try_from(place).unwrap_or(i64::MAX)
}

/// The rule of a name.
pub(crate) fn rule(name: &str) -> PyResult<FillRule> {
    match name {
        "evenodd" => Ok(FillRule::EvenOdd),
        "nonzero" => Ok(FillRule::NonZero),
        "positive" => Ok(FillRule::Positive),
        _ => Err(pyo3::exceptions::PyValueError::new_err(format!(
            "fill is \"evenodd\", \"nonzero\" or \"positive\", not {name:?}"
        ))),
    }
}
