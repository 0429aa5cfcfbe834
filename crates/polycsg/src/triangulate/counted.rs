//! Points that count as work how often spade asks where they are.
//!
//! Nothing else that spade calls is ours, and it can return from the middle of its work in one way only: by unwinding. So this is
//! where a limit that is met ends it; the caller sees an error. Without limits, points are spade's own.

use crate::base::meter::{Meter, Refusal, Tally};
use spade::{HasPosition, Point2};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// See the module's page.
#[derive(Clone, Copy, Debug)]
pub(super) struct CountedPoint<'p, 'm> {
    point: Point2<f64>,
    tally: &'p RefCell<Tally<'m>>,
}

impl HasPosition for CountedPoint<'_, '_> {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        let counted = self.tally.borrow_mut().add(1);
        match counted {
            Err(error) if cfg!(panic = "unwind") => resume_unwind(Box::new(error)),
            _ => self.point,
        }
    }
}

/// Does something with counted points.
///
/// # Errors
/// Those of the meter's limits.
pub(super) fn with_counted<R>(
    points: Vec<Point2<f64>>,
    meter: &Meter<'_>,
    work: impl FnOnce(Vec<CountedPoint<'_, '_>>) -> Result<R, Refusal>,
) -> Result<R, Refusal> {
    let tally = RefCell::new(meter.tally());
    let counted = points.into_iter().map(|point| CountedPoint { point, tally: &tally }).collect();
    // What is under way is dropped, and nobody sees it half done.
    catch_unwind(AssertUnwindSafe(|| work(counted))).unwrap_or_else(|cause| match cause.downcast() {
        Ok(error) => Err(*error),
        Err(cause) => resume_unwind(cause),
    })
}
