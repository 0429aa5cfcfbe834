//! Progressive refinement with substructuring.
use super::{progress::Moment, run::Run};
use crate::error::Error;

/// Shoots until light and bound are within the tolerance (true), or a limit is met (false).
///
/// The strongest piece shoots what its mean is ahead of what it has shot; once little power is left, the brightest one,
/// however small it is: its radiosity is what the bound is made of. A piece over which B varies too much is split
/// in two, which inherit what it has shot; their next shots, of either sign, correct what the coarser piece had got wrong.
pub(super) fn shoot(run: &mut Run<'_>) -> Result<bool, Error> {
    loop {
        if run.measure() {
            return Ok(true);
        }
        let next = run.next();
        let moment = Moment::Shot(run.shooters.shots, run.shooters.elements(next));
        if run.show(moment).is_break() || run.shooters.shots >= run.options.max_shots {
            return Ok(false);
        }
        // A piece that was split shoots in a later round, as its halves.
        if !run.shooters.split(next, &run.light, run.options.spread) {
            let column = run.factors.column(run.shooters.node(next))?;
            run.light.receive(&column, &run.shooters.shoot(next));
        }
    }
}
