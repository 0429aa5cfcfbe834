//! The light after one reflection, two, and so on, for whoever watches.
use super::exchange::Exchange;
use super::gather::gather;
use crate::solve::{magnitude::largest, progress::Moment, run::Run, state::Column};
use std::sync::Arc;

/// More reflections are not shown.
const MOST: usize = 100;

/// Shows the light after each reflection, where the options ask for it, until no more than the tolerance is left to be sent. The run is as
/// before afterwards.
pub(super) fn show(run: &mut Run<'_>, exchange: &Exchange, columns: &[Arc<Column>]) {
    if !run.options.record {
        return;
    }
    let (shot, shots) = (sent(run), run.shooters.shots);
    let before = (run.light.clone(), run.bound.clone(), run.ledger.clone(), run.unshot.clone());
    run.shooters.set(&vec![0.0; shot.len()]);
    run.light.receive_all(vec![0.0; run.light.radiosity.len()]);
    for bounce in 0..=MOST {
        run.measure();
        if run.show(Moment::Bounce(bounce)).is_break() || largest(&run.unshot) <= run.options.tolerance {
            break;
        }
        (0..run.shooters.len()).for_each(|piece| drop(run.shooters.shoot(piece)));
        run.light.receive_all(gather(exchange, columns, &run.light, &sent(run)));
    }
    run.shooters.set(&shot);
    run.shooters.shots = shots;
    (run.light, run.bound, run.ledger, run.unshot) = before;
    run.shooters.measure(&run.light);
}

/// What every piece has shot: pieces × bands.
fn sent(run: &Run<'_>) -> Vec<f64> {
    (0..run.shooters.len()).flat_map(|piece| run.shooters.shot(piece).to_vec()).collect()
}
