//! Progressive refinement with substructuring.
use super::{progress::Moment, run::Run};
use crate::error::Error;

/// How shooting ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shooting {
    /// Light and bound are within the tolerance.
    Converged,
    /// The watcher or a limit of the options ended it.
    Stopped,
    /// So many shots as were granted are done.
    Spent,
}

/// Shoots until light and bound are within the tolerance, or a limit is met; `granted` shots at most.
///
/// The strongest piece shoots what its mean is ahead of what it has shot; once little power is left, the brightest one,
/// however small it is: its radiosity is what the bound is made of. A piece over which B varies too much is split
/// in two, which inherit what it has shot; their next shots, of either sign, correct what the coarser piece had got wrong.
pub(super) fn shoot(run: &mut Run<'_>, granted: usize) -> Result<Shooting, Error> {
    loop {
        if run.measure() {
            return Ok(Shooting::Converged);
        }
        let next = run.next();
        let moment = Moment::Shot(run.shooters.shots, run.shooters.elements(next));
        if run.show(moment).is_break() || run.shooters.shots >= run.options.max_shots {
            return Ok(Shooting::Stopped);
        }
        if run.shooters.shots >= granted {
            return Ok(Shooting::Spent);
        }
        // A piece that was split shoots in a later round, as its halves.
        if !run.shooters.split(next, &run.light, run.options.spread) {
            let Some(column) = run.column(run.shooters.node(next))? else { return Ok(Shooting::Stopped) };
            run.light.receive(&column, &run.shooters.shoot(next));
        }
    }
}
