//! Cells that may be refined, and the sums over them.
use crate::shapes::cell::Cell;
use std::{cmp::Ordering, collections::BinaryHeap};

/// A cell that was integrated over.
#[derive(Debug)]
pub(super) struct Open {
    pub(super) cell: Cell,
    pub(super) value: f64,
    pub(super) error: f64,
    /// What cuts that were not made may change, if events were cut.
    pub(super) left_out: Option<f64>,
    /// Its rule's place in the list.
    pub(super) order: usize,
    /// Whether its error is as likely to go either way: that of a rule of few nodes where some is hidden, after cuts.
    pub(super) is_rough: bool,
    /// The constants of what fine rules err by that the last differences say.
    pub(super) constants: [f64; 3],
    /// What the finest rule may leave.
    pub(super) last: f64,
}

impl Open {
    /// A cell that was not integrated over yet.
    pub(super) fn over(cell: Cell, left_out: Option<f64>) -> Self {
        Self {
            cell,
            value: 0.0,
            error: 0.0,
            left_out,
            order: 0,
            is_rough: false,
            constants: [0.0; 3],
            last: 0.0,
        }
    }
}

/// A cell and when it came.
#[derive(Debug)]
struct Numbered(Open, usize);

impl PartialEq for Numbered {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Numbered {}

impl PartialOrd for Numbered {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Numbered {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.error.total_cmp(&other.0.error).then(other.1.cmp(&self.1))
    }
}

/// All cells, the one with the largest error first.
#[derive(Debug, Default)]
pub(super) struct Queue {
    cells: BinaryHeap<Numbered>,
    count: usize,
    /// The sums as cells come and go, up to rounding.
    pub(super) value: f64,
    errors: Totals,
}

/// Sums of errors.
#[derive(Clone, Copy, Debug, Default)]
struct Totals {
    /// Of those that may all have one sign.
    alike: f64,
    /// Of rules of few nodes, and of their squares.
    rough: f64,
    squares: f64,
}

/// What of the errors of rules of few nodes may have one sign.
const BIAS: f64 = 0.125;

impl Totals {
    fn add(&mut self, cell: &Open, sign: f64) {
        if cell.is_rough {
            self.rough += sign * cell.error;
            self.squares += sign * cell.error * cell.error;
        } else {
            self.alike += sign * cell.error;
        }
    }

    /// What all may err by: rules of few nodes on different cells mostly err either way.
    fn sum(&self) -> f64 {
        self.alike + BIAS * self.rough + self.squares.max(0.0).sqrt()
    }
}

impl Queue {
    pub(super) fn push(&mut self, cell: Open) {
        self.value += cell.value;
        self.errors.add(&cell, 1.0);
        self.count += 1;
        self.cells.push(Numbered(cell, self.count));
    }

    /// The cell with the largest error, if it has any.
    pub(super) fn pop(&mut self) -> Option<Open> {
        if self.cells.peek()?.0.error == 0.0 {
            return None;
        }
        let Numbered(worst, _) = self.cells.pop()?;
        self.value -= worst.value;
        self.errors.add(&worst, -1.0);
        Some(worst)
    }

    /// What all may err by.
    pub(super) fn error(&self) -> f64 {
        self.errors.sum()
    }

    /// The integral and its error, summed in the order in which the cells came about.
    pub(super) fn sum(&self) -> (f64, f64) {
        let mut cells: Vec<&Numbered> = self.cells.iter().collect();
        cells.sort_unstable_by_key(|cell| cell.1);
        let mut errors = Totals::default();
        cells.iter().for_each(|cell| errors.add(&cell.0, 1.0));
        (cells.iter().map(|cell| cell.0.value).sum(), errors.sum())
    }
}
