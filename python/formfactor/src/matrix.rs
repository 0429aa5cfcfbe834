//! Matrices of form factors between polygons.
use crate::error::wrong;
use formfactor::{Exchange, ExchangeRow, FactorMatrix};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

/// Form factors between polygons as compressed sparse rows.
#[pyclass(frozen, module = "formfactor._formfactor")]
pub(crate) struct Matrix(FactorMatrix);

/// The number of the first polygon, and what it and those after it exchange with those behind: where each row begins, with which
/// polygons, the areas, and estimates of their errors.
type Given<'py> = (
    usize,
    PyReadonlyArray1<'py, i64>,
    PyReadonlyArray1<'py, u32>,
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray1<'py, f64>,
);

/// Areas, starts, columns, values and errors.
type Parts<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

#[pymethods]
impl Matrix {
    /// From rows of exchange areas in any order.
    #[new]
    fn new(py: Python<'_>, areas: PyReadonlyArray1<'_, f64>, shards: Vec<Given<'_>>) -> PyResult<Self> {
        let areas = areas.as_slice()?;
        let mut rows = vec![];
        for shard in &shards {
            read(shard, areas.len(), &mut rows)?;
        }
        Ok(Self(py.detach(|| FactorMatrix::new(areas, rows))))
    }

    /// Areas, starts, columns, values and errors.
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Parts<'py>> {
        let starts: Result<Vec<i64>, _> = self.0.starts().iter().map(|start| i64::try_from(*start)).collect();
        Ok((
            PyArray1::from_slice(py, self.0.areas()),
            PyArray1::from_vec(py, starts?),
            PyArray1::from_slice(py, self.0.columns()),
            PyArray1::from_slice(py, self.0.values()),
            PyArray1::from_slice(py, self.0.errors()),
        ))
    }

    /// What each row lacks of 1.
    fn defects<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.0.defects())
    }

    /// With space as one more receiver.
    fn with_space(&self, py: Python<'_>) -> Self {
        Self(py.detach(|| self.0.clone().with_space()))
    }

    /// Without small factors, rows' sums kept.
    fn without_below(&self, py: Python<'_>, threshold: f64) -> PyResult<Self> {
        if threshold.is_nan() {
            return Err(wrong("the threshold is NaN; give a number"));
        }
        Ok(Self(py.detach(|| self.0.without_below(threshold))))
    }

    /// With rows that add to 1 and reciprocity; the largest defect before, and the largest change.
    fn closed(&self, py: Python<'_>) -> PyResult<(Self, f64, f64)> {
        let (closed, closure) = py.detach(|| self.0.closed()).map_err(wrong)?;
        Ok((Self(closed), closure.defect, closure.change))
    }

    /// Of groups of polygons.
    fn grouped(&self, py: Python<'_>, groups: PyReadonlyArray1<'_, i64>) -> PyResult<Self> {
        let groups: Result<Vec<usize>, _> =
            groups.as_slice()?.iter().map(|group| usize::try_from(*group)).collect();
        let groups = groups.map_err(|_| wrong("groups are counted from 0"))?;
        if groups.len() != self.0.len() {
            return Err(wrong(format!("there are {} rows and {} groups", self.0.len(), groups.len())));
        }
        let mut named: Vec<usize> = groups.clone();
        named.sort_unstable();
        named.dedup();
        if named.last().is_some_and(|last| *last + 1 != named.len()) {
            return Err(wrong("a group has no polygon; count them from 0 without a gap"));
        }
        Ok(Self(py.detach(|| self.0.grouped(&groups))))
    }

    /// Of gray surfaces.
    fn with_emittances(&self, py: Python<'_>, emittances: PyReadonlyArray1<'_, f64>) -> PyResult<Self> {
        let emittances = emittances.as_slice()?;
        Ok(Self(py.detach(|| self.0.with_emittances(emittances)).map_err(wrong)?))
    }
}

fn read(shard: &Given<'_>, count: usize, rows: &mut Vec<ExchangeRow>) -> PyResult<()> {
    let (first, starts, columns, areas, errors) = shard;
    let (starts, columns, areas, errors) =
        (starts.as_slice()?, columns.as_slice()?, areas.as_slice()?, errors.as_slice()?);
    let entries = i64::try_from(columns.len())?;
    let are_starts = starts.first() == Some(&0) && starts.last() == Some(&entries) && starts.is_sorted();
    let is_whole = are_starts
        && areas.len() == columns.len()
        && errors.len() == columns.len()
        && first.checked_add(starts.len() - 1).is_some_and(|last| last <= count);
    if !is_whole {
        return Err(wrong("these are no rows of this enclosure"));
    }
    for (i, ends) in starts.windows(2).enumerate() {
        let span = usize::try_from(ends[0])?..usize::try_from(ends[1])?;
        let from = first + i;
        let exchange = |at: usize| Exchange { to: columns[at], area: areas[at], error: errors[at] };
        let with: Vec<Exchange> = span.map(exchange).collect();
        let are_behind = with.iter().all(|other| (from + 1..count).contains(&(other.to as usize)));
        if !are_behind || !with.is_sorted_by(|one, next| one.to < next.to) {
            return Err(wrong(format!("row {from} is none of this enclosure")));
        }
        rows.push(ExchangeRow { from, with });
    }
    Ok(())
}
