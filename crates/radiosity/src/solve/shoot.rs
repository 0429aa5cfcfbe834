//! Progressive refinement with substructuring.
use super::run::Run;
use crate::Error;

/// Shoots until light and bound are within the tolerance (true), or a limit is met (false).
///
/// The brightest piece shoots what its mean is ahead of what it has shot. A piece over which B varies too much is split
/// in two, which inherit what it has shot; their next shots, of either sign, mend what the coarser piece had got wrong.
pub(super) fn shoot(run: &mut Run<'_>) -> Result<bool, Error> {
    loop {
        if run.weigh() {
            return Ok(true);
        }
        if run.report().is_break() || run.shooters.shots >= run.options.max_shots {
            return Ok(false);
        }
        let brightest = run.shooters.brightest();
        if !run.shooters.split(brightest, &run.light, run.options.spread) {
            let column = run.factors.column(run.shooters.node(brightest))?;
            run.light.receive(&column, &run.shooters.shoot(brightest));
        }
    }
}
