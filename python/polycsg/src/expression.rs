//! Expressions of arrays of features, one by one.
use crate::alone::evaluate;
use crate::built::{Built, Returned};
use crate::input::Features;
use crate::ragged::{Ragged, rule};
use crate::run::{each, run};
use polycsg::{Csg, FillRule, PreparedRegion, Scratch};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// A word of an expression in postfix form.
#[derive(Clone, Copy)]
enum Word {
    /// Takes the next operand.
    Next,
    Union,
    Intersection,
    Difference,
    SymmetricDifference,
}

impl Word {
    fn of(name: &str) -> PyResult<Self> {
        match name {
            "" => Ok(Self::Next),
            "|" => Ok(Self::Union),
            "&" => Ok(Self::Intersection),
            "-" => Ok(Self::Difference),
            "^" => Ok(Self::SymmetricDifference),
            _ => Err(PyValueError::new_err(format!("no operation has the name {name:?}"))),
        }
    }

    /// Puts on the stack what becomes of its top, or none if there is too little.
    fn apply<'a>(self, stack: &mut Vec<Csg<'a>>, next: impl FnOnce() -> Option<Csg<'a>>) -> Option<()> {
        let found = match self {
            Self::Next => next()?,
            operation => {
                let (other, one) = (stack.pop()?, stack.pop()?);
                match operation {
                    Self::Union | Self::Next => one | other,
                    Self::Intersection => one & other,
                    Self::Difference => one - other,
                    Self::SymmetricDifference => one ^ other,
                }
            }
        };
        stack.push(found);
        Some(())
    }
}

/// An expression in postfix form of arrays of features, some of which may have a single feature that goes with all of the others.
#[pyfunction]
pub(crate) fn evaluated<'py>(
    py: Python<'py>,
    operands: Vec<Features<'py>>,
    program: Vec<String>,
    fill: &str,
) -> PyResult<Returned<'py>> {
    let rule = rule(fill)?;
    let operands: PyResult<Vec<Ragged>> =
        operands.iter().enumerate().map(|(i, operand)| Ok(operand.read()?.as_operand(i))).collect();
    let program: PyResult<Vec<Word>> = program.iter().map(|word| Word::of(word)).collect();
    let (operands, program) = (operands?, program?);
    let count = count(&operands)?;
    let vertices = operands.iter().map(|operand| operand.vertices()).sum();
    let built = run(py, vertices, |stop| {
        let sides: PyResult<Vec<Side>> =
            operands.iter().map(|side| Side::of(*side, count, rule, stop)).collect();
        let sides = sides?;
        let combine =
            |scratch: &mut Scratch, i: usize| evaluate(&expression(&sides, &program, i)?, i, scratch, stop);
        Ok(Built::of(&each(count, stop, combine)?))
    })?;
    built.into_python(py)
}

fn expression<'a>(sides: &'a [Side<'_>], program: &[Word], feature: usize) -> PyResult<Csg<'a>> {
    let leaves: PyResult<Vec<Csg>> = sides.iter().map(|side| side.operand(feature)).collect();
    let (mut leaves, mut stack) = (leaves?.into_iter(), Vec::new());
    let is_whole = program.iter().all(|word| word.apply(&mut stack, || leaves.next()).is_some());
    let found = stack.pop().filter(|_| is_whole && stack.is_empty());
    found.ok_or_else(|| PyValueError::new_err("operators and operands do not fit together"))
}

/// How many features come out.
fn count(operands: &[Ragged<'_>]) -> PyResult<usize> {
    let mut count = 1;
    for operand in operands {
        match operand.len() {
            1 => {}
            len if count == 1 || count == len => count = len,
            len => return Err(PyValueError::new_err(format!("{count} features do not go with {len}"))),
        }
    }
    Ok(count)
}

/// The operands of one side.
enum Side<'a> {
    /// A feature for each of the others'.
    Each(Ragged<'a>, FillRule),
    /// One for all.
    Prepared(Box<PreparedRegion>),
}

impl<'a> Side<'a> {
    fn of(features: Ragged<'a>, count: usize, rule: FillRule, stop: &AtomicBool) -> PyResult<Self> {
        if features.len() == count {
            return Ok(Self::Each(features, rule));
        }
        let region = evaluate(&features.operand(0, rule)?, 0, &mut Scratch::default(), stop)?;
        Ok(Self::Prepared(Box::new(region.into())))
    }

    fn operand(&self, feature: usize) -> PyResult<Csg<'_>> {
        match self {
            Self::Each(features, rule) => features.operand(feature, *rule),
            Self::Prepared(region) => Ok(region.as_ref().into()),
        }
    }
}
