//! Polygons that see and hide each other.
use crate::comparators::comparator;
use crate::error::{refused, stopped, wrong};
use crate::points::{Points, points};
use crate::polygons::{Arrays, polygons};
use crate::tolerance::{Asked, limits};
use formfactor::{AreaFormFactor, ExchangeRow, FormFactor};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use python_run::{each, watched};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Polygons that see and hide each other.
#[pyclass(frozen, module = "formfactor._formfactor")]
pub(crate) struct Enclosure(formfactor::Enclosure);

/// Rows of numbers: where each begins, of which polygons, the numbers, and their errors.
type Rows<'py> = (
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

#[pymethods]
impl Enclosure {
    #[new]
    fn new(py: Python<'_>, arrays: Arrays<'_>) -> PyResult<Self> {
        let polygons = polygons(py, "polygon", &arrays)?;
        Ok(Self(py.detach(|| formfactor::Enclosure::new(polygons))))
    }

    fn __len__(&self) -> usize {
        self.0.polygons().len()
    }

    /// The polygons' areas.
    fn areas<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.0.polygons().iter().map(formfactor::PlanarPolygon::area))
    }

    /// The polygons' unit normals (n, 3).
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let normals = self.0.polygons().iter().flat_map(|polygon| polygon.normal().to_array());
        PyArray1::from_iter(py, normals).reshape([self.0.polygons().len(), 3])
    }

    /// From points to polygons, to all if none are named: rows of what is not nothing for certain, by places among those named.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        from: Points<'py>,
        to: Option<Vec<usize>>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Rows<'py>> {
        let from = points(&from, self.0.polygons().len())?;
        let to = self.named(to)?;
        let done = Done::new(from.len());
        let rows: Vec<Vec<Entry>> = watched(py, done.reports(progress), |stop| {
            each(
                from.len(),
                || (),
                |_, i| {
                    let mut row = vec![];
                    for (place, id) in (0..).zip(&to) {
                        not_stopped(stop)?;
                        let FormFactor { value, error_bound } = self.0.form_factor(&from[i], *id);
                        if value != 0.0 || error_bound != 0.0 {
                            row.push((place, value, error_bound));
                        }
                    }
                    done.add(1);
                    Ok(row)
                },
            )
        })?;
        arrays(py, rows.iter().map(|row| row.iter().copied()))
    }

    /// From points to polygons by an approximate method.
    fn approximate_rows<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        parameters: &Bound<'py, PyDict>,
        from: Points<'py>,
        to: Option<Vec<usize>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (method, to) = (comparator(method, parameters)?, self.named(to)?);
        let from = points(&from, self.0.polygons().len())?;
        let rows = watched(
            py,
            |_| Ok(()),
            |stop| {
                each(
                    from.len(),
                    || (),
                    |_, i| {
                        not_stopped(stop)?;
                        Ok(method.row(&self.0, &from[i], &to))
                    },
                )
            },
        )?;
        PyArray1::from_iter(py, rows.into_iter().flatten()).reshape([from.len(), to.len()])
    }

    /// From polygon to polygon: the value, an estimate of its error (a bound on it, if wanted), and the work.
    fn area_form_factor(
        &self,
        py: Python<'_>,
        from: usize,
        to: usize,
        tolerance: Asked,
        per_pair: Option<u64>,
        bounded: bool,
    ) -> PyResult<(f64, f64, u64)> {
        self.named(Some(vec![from, to]))?;
        let tolerance = tolerance.tolerance()?;
        watched(
            py,
            |_| Ok(()),
            |stop| {
                let is_stopped = || stop.load(Ordering::Relaxed);
                let limits = limits(per_pair, &is_stopped);
                if bounded {
                    let found =
                        self.0.bounded_area_form_factor(from, to, tolerance, &limits).map_err(wrong)?;
                    return found.map(|f| (f.value, f.error_bound, f.evaluations)).ok_or_else(stopped);
                }
                let found = self.0.area_form_factor(from, to, tolerance, &limits).map_err(wrong)?;
                found.map(|f| (f.value, f.error_estimate, f.evaluations)).ok_or_else(stopped)
            },
        )
    }

    /// What each of the polygons from `first` to before `last` exchanges with those behind it.
    fn exchange_rows<'py>(
        &self,
        py: Python<'py>,
        span: [usize; 2],
        tolerance: Asked,
        per_pair: Option<u64>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Rows<'py>> {
        let ([first, last], count) = (span, self.0.polygons().len());
        if first > last || last > count {
            return Err(wrong(format!("there are {count} rows, not those from {first} to {last}")));
        }
        let tolerance = tolerance.tolerance()?;
        let pairs = |row: usize| count - 1 - row;
        let done = Done::new((first..last).map(pairs).sum());
        let rows: Vec<ExchangeRow> = watched(py, done.reports(progress), |stop| {
            let is_stopped = || stop.load(Ordering::Relaxed);
            let limits = limits(per_pair, &is_stopped);
            each(
                last - first,
                || (),
                |_, i| {
                    let row = self.0.exchange_row(first + i, tolerance, &limits).map_err(wrong)?;
                    done.add(pairs(first + i));
                    row.ok_or_else(stopped)
                },
            )
        })?;
        arrays(py, rows.iter().map(|row| row.with.iter().map(|with| (with.to, with.area, with.error))))
    }

    /// From a polygon to all that it sees.
    fn area_row<'py>(
        &self,
        py: Python<'py>,
        from: usize,
        tolerance: Asked,
        per_pair: Option<u64>,
    ) -> PyResult<Rows<'py>> {
        self.named(Some(vec![from]))?;
        let tolerance = tolerance.tolerance()?;
        let row = watched(
            py,
            |_| Ok(()),
            |stop| {
                let is_stopped = || stop.load(Ordering::Relaxed);
                let row = self.0.area_row(from, tolerance, &limits(per_pair, &is_stopped)).map_err(wrong)?;
                let entry = |(to, factor): &(usize, AreaFormFactor)| {
                    Ok((u32::try_from(*to)?, factor.value, factor.error_estimate))
                };
                row.ok_or_else(stopped)?.iter().map(entry).collect::<PyResult<Vec<Entry>>>()
            },
        )?;
        arrays(py, std::iter::once(row.iter().copied()))
    }
}

/// A polygon, a number, and its error.
type Entry = (u32, f64, f64);

impl Enclosure {
    /// Polygons by their ids, checked; all if none are named.
    fn named(&self, ids: Option<Vec<usize>>) -> PyResult<Vec<usize>> {
        let count = self.0.polygons().len();
        let ids = ids.unwrap_or_else(|| (0..count).collect());
        match ids.iter().find(|id| **id >= count) {
            Some(id) => Err(refused("", format!("there are {count} polygons, none has the number {id}"))),
            None => Ok(ids),
        }
    }
}

fn arrays<'py>(
    py: Python<'py>,
    rows: impl Iterator<Item = impl Iterator<Item = Entry>>,
) -> PyResult<Rows<'py>> {
    let (mut starts, mut columns, mut values, mut errors) = (vec![0], vec![], vec![], vec![]);
    for row in rows {
        for (column, value, error) in row {
            columns.push(column);
            values.push(value);
            errors.push(error);
        }
        starts.push(i64::try_from(columns.len())?);
    }
    Ok((
        PyArray1::from_vec(py, starts),
        PyArray1::from_vec(py, columns),
        PyArray1::from_vec(py, values),
        PyArray1::from_vec(py, errors),
    ))
}

fn not_stopped(stop: &AtomicBool) -> PyResult<()> {
    if stop.load(Ordering::Relaxed) { Err(stopped()) } else { Ok(()) }
}

/// How much is done.
struct Done {
    so_far: AtomicU64,
    all: u64,
}

impl Done {
    fn new(all: usize) -> Self {
        Self { so_far: AtomicU64::new(0), all: all as u64 }
    }

    fn add(&self, more: usize) {
        self.so_far.fetch_add(more as u64, Ordering::Relaxed);
    }

    /// Calls a function of Python's with what is done and with all that there is, where that has changed.
    fn reports(&self, progress: Option<Py<PyAny>>) -> impl FnMut(Python<'_>) -> PyResult<()> + Send {
        let mut last = None;
        move |py| {
            let so_far = Some(self.so_far.load(Ordering::Relaxed));
            match &progress {
                Some(progress) if so_far != last => {
                    last = so_far;
                    progress.call1(py, (so_far, self.all)).map(|_| ())
                }
                _ => Ok(()),
            }
        }
    }
}
