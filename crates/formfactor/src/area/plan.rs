//! Cells and rules without cuts at events, by what rules may err by: found before anything is evaluated.
use super::estimate::RULES;
use crate::shapes::cell::{Cell, halves};

/// What each rule may err by on a cell.
pub(super) type Errors = [f64; RULES.len()];

/// A cell with a rule, and what that may err by.
#[derive(Debug)]
pub(super) struct Planned {
    pub(super) cell: Cell,
    pub(super) order: usize,
    pub(super) error: f64,
}

/// The nodes of a rule.
fn nodes(order: usize) -> usize {
    RULES[order].len().pow(2)
}

/// Cells with the cheapest rules that are good enough each, if few cells and nodes will do. `tolerance` is for a cell of all of
/// the source, and `whole` what all that could be seen of it is.
pub(super) fn plan(
    mut coarse: Vec<Cell>,
    [tolerance, whole]: [f64; 2],
    mut left: usize,
    share: impl Fn(&Cell) -> f64,
    errors: impl Fn(&Cell) -> Errors,
) -> Option<Vec<Planned>> {
    let mut found = Vec::with_capacity(coarse.len());
    while let Some(cell) = coarse.pop() {
        let (share, errors) = (share(&cell), errors(&cell));
        let is_fair = |order: &usize| errors[*order] <= share * tolerance * fair_share(*order);
        let is_faint = || whole <= tolerance * fair_share(RULES.len() - 1);
        if let Some(order) = (0..RULES.len()).find(is_fair) {
            left = left.checked_sub(nodes(order))?;
            found.push(Planned { cell, order, error: errors[order] });
        } else if is_faint() {
            // All that could be seen is within the tolerance.
            left = left.checked_sub(nodes(FAINT))?;
            found.push(Planned { cell, order: FAINT, error: share * whole });
        } else if coarse.len() + found.len() < MOST_CELLS {
            coarse.extend(halves(cell));
        } else {
            return None;
        }
    }
    Some(found)
}

/// The rule for what is within the tolerance altogether.
const FAINT: usize = 1;

/// Into so many cells a piece is halved.
const MOST_CELLS: usize = 16;

/// What share of what is allowed a rule may take. Rules of n nodes a side cost n^2 and err by slopes / n^2. So a sum of many
/// squared errors costs least where each errs in proportion to n.
fn fair_share(order: usize) -> f64 {
    0.75 * RULES[order].len() as f64 / RULES[RULES.len() - 1].len() as f64
}
