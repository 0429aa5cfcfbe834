//! Tolerances and limits as Python gives them.
use crate::error::wrong;
use formfactor::{Limits, Tolerance};
use pyo3::prelude::*;

/// Of each entry, of each entry as a share of it, and of the sum of a row.
#[derive(Clone, Copy, FromPyObject)]
pub(crate) enum Asked {
    Each(f64),
    All(f64, f64, f64),
}

impl Asked {
    pub(crate) fn tolerance(self) -> PyResult<Tolerance> {
        let tolerance = match self {
            Asked::Each(tolerance) => tolerance.into(),
            Asked::All(absolute, relative, row) => Tolerance { absolute, relative, row },
        };
        let Tolerance { absolute, relative, row } = tolerance;
        let is_good =
            [absolute, relative, row].iter().all(|t| *t >= 0.0) && absolute.max(relative) > 0.0 && row > 0.0;
        if is_good { Ok(tolerance) } else { Err(wrong(formfactor::Error::BadTolerance)) }
    }
}

/// So many evaluations for each pair at most, and a stop.
pub(crate) fn limits(per_pair: Option<u64>, stop: &(dyn Fn() -> bool + Sync)) -> Limits<'_> {
    let all = Limits { stop, ..Limits::default() };
    per_pair.map_or(all, |per_pair| Limits { per_pair, ..all })
}
