//! How `polycsg` fares on a kind of nasty input: the columns in which polygon libraries are compared.
use crate::against::{self, Verdict, area_between, csg, leaf, shapes, twice_area};
use crate::generators::{KINDS, Pair, nasty};
use crate::oracle::{Arrangement, Operation, Outline};
use crate::validity;
use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};
use polycsg::Region;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// What the four operations on all inputs of a kind showed.
#[derive(Debug, Default)]
pub struct Row {
    /// Name of the kind.
    pub kind: &'static str,
    /// Evaluations: four for each input.
    pub evaluations: usize,
    /// Evaluations that panicked.
    pub panics: usize,
    /// Results that are no valid region, by the exact check of this package.
    pub invalid: usize,
    /// Results whose area is wrong by more than a thousandth, and by more than rounding each vertex explains.
    pub gross: usize,
    /// Results between which and the exact set more area lies than rounding each vertex explains.
    pub lost: usize,
    /// Results with a vertex that is no input vertex bit for bit, no crossing rounded once and no cut by a repair; and,
    /// where nothing was repaired, results that are not the oracle's boundary bit for bit.
    pub strayed: usize,
    /// Results whose rounded boundary met itself and was repaired.
    pub repaired: usize,
    /// The largest area between a result and the exact set, over the area that rounding each vertex explains.
    pub worst: f64,
    /// The longest evaluation, each the shortest of three: what a busy machine adds is no property of the input.
    pub slowest: Duration,
    /// What failed, each with its input.
    pub failures: Vec<String>,
}

/// Evaluates every operation on the first `inputs` of a kind (an index into [`KINDS`]).
pub fn survey(kind: usize, inputs: u64) -> Row {
    let mut row = Row { kind: KINDS[kind].0, ..Row::default() };
    for pair in (0..inputs).map(|seed| nasty(kind, seed)) {
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        for operation in Operation::ALL {
            row.add(&pair, operation, &arrangement);
        }
    }
    row
}

impl Row {
    fn add(&mut self, pair: &Pair, operation: Operation, arrangement: &Arrangement) {
        self.evaluations += 1;
        let expression = || csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate();
        let Ok(result) = catch_unwind(AssertUnwindSafe(expression)) else {
            self.panics += 1;
            self.fail(pair, operation, "panicked");
            return;
        };
        self.slowest = self.slowest.max(shortest(expression));
        let outline = arrangement.operation(operation);
        if let Err(e) = validity::check(&shapes(&result)) {
            self.invalid += 1;
            self.fail(pair, operation, &e);
        }
        if is_gross(&result, &outline) {
            self.gross += 1;
            self.fail(pair, operation, "a gross error");
        }
        self.add_set(pair, operation, &result);
        match against::check(pair, operation, arrangement) {
            Ok(Verdict::Exact) => {}
            Ok(Verdict::Repaired) => self.repaired += 1,
            Err(e) => {
                self.strayed += 1;
                self.fail(pair, operation, &e);
            }
        }
    }

    fn add_set(&mut self, pair: &Pair, operation: Operation, result: &Region) {
        let operands = [pair.a.clone(), pair.b.clone()];
        let [between, reach] =
            area_between(result, &operands, |classes| operation.of(classes[0], classes[1]));
        let is_lost = between > reach;
        let share = if reach.is_zero() { reach } else { between / reach };
        self.worst = self.worst.max(share.to_f64().unwrap_or(f64::INFINITY));
        if is_lost {
            self.lost += 1;
            self.fail(pair, operation, "not the exact set");
        }
    }

    fn fail(&mut self, pair: &Pair, operation: Operation, what: &str) {
        self.failures.push(format!("{} {operation:?}: {what}", pair.name));
    }
}

/// Whether the area is wrong by more than a thousandth, and by more than rounding each vertex explains.
fn is_gross(region: &Region, outline: &Outline<'_>) -> bool {
    let exact = outline.area();
    let error = (twice_area(region) / BigInt::from(2) - &exact).abs();
    error > exact / BigInt::from(1000) && error > outline.area_of_one_ulp()
}

fn shortest(evaluate: impl Fn() -> Region) -> Duration {
    let timed = || {
        let start = Instant::now();
        evaluate();
        start.elapsed()
    };
    timed().min(timed()).min(timed())
}
