//! Booleans of two arrays of features, one by one.
use crate::alone::evaluate;
use crate::ragged::{Arrays, Built, Ragged, Returned, rule};
use crate::run::run;
use polycsg::{Csg, FillRule, PreparedRegion, Region, Scratch};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;

#[derive(Clone, Copy)]
enum Operation {
    Union,
    Intersection,
    Difference,
    SymmetricDifference,
}

impl Operation {
    fn of(name: &str) -> PyResult<Self> {
        match name {
            "union" | "|" => Ok(Self::Union),
            "intersection" | "&" => Ok(Self::Intersection),
            "difference" | "-" => Ok(Self::Difference),
            "symmetric_difference" | "^" => Ok(Self::SymmetricDifference),
            _ => Err(PyValueError::new_err(format!("no operation has the name {name:?}"))),
        }
    }

    fn apply<'a>(self, one: Csg<'a>, other: Csg<'a>) -> Csg<'a> {
        match self {
            Self::Union => one | other,
            Self::Intersection => one & other,
            Self::Difference => one - other,
            Self::SymmetricDifference => one ^ other,
        }
    }
}

/// The features of two arrays combined, of which one may have a single feature that goes with all of the other.
#[pyfunction]
pub(crate) fn overlay<'py>(
    py: Python<'py>,
    operation: &str,
    one: Arrays<'py>,
    other: Arrays<'py>,
    fill: &str,
) -> PyResult<Returned<'py>> {
    let (operation, rule) = (Operation::of(operation)?, rule(fill)?);
    let (one, other) = (Ragged::of(&one)?, Ragged::of(&other)?);
    let count = count([one.len(), other.len()])?;
    let built = run(py, one.vertices() + other.vertices(), |stop| {
        let sides = [Side::of(one, count, rule)?, Side::of(other, count, rule)?];
        let combine = |scratch: &mut Scratch, i: usize| combined(operation, &sides, i, scratch, stop);
        let regions: PyResult<Vec<Region>> =
            (0..count).into_par_iter().map_init(Scratch::default, combine).collect();
        Ok(Built::of(&regions?))
    })?;
    built.into_python(py)
}

/// An expression of features in postfix form: an empty word takes the next operand, an operator the last two results.
#[pyfunction]
pub(crate) fn evaluated<'py>(
    py: Python<'py>,
    operands: Vec<Arrays<'py>>,
    program: Vec<String>,
    fill: &str,
) -> PyResult<Returned<'py>> {
    let rule = rule(fill)?;
    let operands: PyResult<Vec<Ragged>> = operands.iter().map(Ragged::of).collect();
    let operands = operands?;
    let vertices = operands.iter().map(|operand| operand.vertices()).sum();
    let region = run(py, vertices, |stop| {
        let leaves: PyResult<Vec<Csg>> = operands.iter().map(|operand| operand.operand(0, rule)).collect();
        evaluate(&expression(leaves?, &program)?, 0, &mut Scratch::default(), stop)
    })?;
    Built::of([&region]).into_python(py)
}

fn expression<'a>(leaves: Vec<Csg<'a>>, program: &[String]) -> PyResult<Csg<'a>> {
    let mut leaves = leaves.into_iter();
    let mut found: Vec<Csg> = Vec::new();
    for word in program {
        let next = if word.is_empty() {
            leaves.next()
        } else {
            let operation = Operation::of(word)?;
            let (other, one) = (found.pop(), found.pop());
            one.zip(other).map(|(one, other)| operation.apply(one, other))
        };
        found.push(next.ok_or_else(|| PyValueError::new_err("an operator lacks an operand"))?);
    }
    found.pop().ok_or_else(|| PyValueError::new_err("there is no expression"))
}

fn count([one, other]: [usize; 2]) -> PyResult<usize> {
    match (one, other) {
        (one, other) if one == other => Ok(one),
        (1, many) | (many, 1) => Ok(many),
        _ => Err(PyValueError::new_err(format!("{one} features do not go with {other}"))),
    }
}

fn combined(
    operation: Operation,
    [one, other]: &[Side<'_>; 2],
    feature: usize,
    scratch: &mut Scratch,
    stop: &AtomicBool,
) -> PyResult<Region> {
    evaluate(&operation.apply(one.operand(feature)?, other.operand(feature)?), feature, scratch, stop)
}

/// The operands of one side.
enum Side<'a> {
    /// A feature for each of the other side's.
    Each(Ragged<'a>, FillRule),
    /// One for all.
    Prepared(PreparedRegion),
}

impl<'a> Side<'a> {
    fn of(features: Ragged<'a>, count: usize, rule: FillRule) -> PyResult<Self> {
        if features.len() == count {
            return Ok(Self::Each(features, rule));
        }
        Ok(Self::Prepared(features.operand(0, rule)?.evaluate().into()))
    }

    fn operand(&self, feature: usize) -> PyResult<Csg<'_>> {
        match self {
            Self::Each(features, rule) => features.operand(feature, *rule),
            Self::Prepared(region) => Ok(region.into()),
        }
    }
}
