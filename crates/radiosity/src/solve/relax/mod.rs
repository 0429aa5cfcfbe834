//! The matrix of all pieces, solved at once: rounds of solving and splitting.
//!
//! ```text
//! bounces             what is known of the solution, reflection by reflection, for whoever watches
//! cg, gmres, gauss    three ways to solve
//! gather              from what the pieces send to what every element receives
//! balance             one band's light: x = e + ρ F x
//! exchange            mean form factors between pieces, made to close
//! ```
mod balance;
mod bounces;
mod cg;
mod exchange;
mod gather;
mod gauss;
mod gmres;

use super::magnitude::{largest, mean_by_itself};
use super::{options::Method, run::Run, state::Column};
use crate::error::Error;
use balance::Balance;
use cg::conjugate_gradients;
use exchange::Exchange;
use gather::gather;
use gauss::eliminate;
use gmres::gmres;
use std::{ops::ControlFlow, sync::Arc};

/// More pieces than this, and their matrix exceeds 2 GiB.
const MOST: usize = 1 << 14;
/// Times that a band is solved for what rounding left.
const REPEATS: usize = 8;

/// Solves for all pieces, splits those over which the light varies, and so on until none does (true), or a limit is met
/// (false).
pub(super) fn relax(run: &mut Run<'_>, method: Method) -> Result<bool, Error> {
    if method == Method::Matrix {
        (0..run.shooters.len()).for_each(|piece| run.shooters.split_wholly(piece, &run.light));
    }
    loop {
        let Some(columns) = columns(run)? else { return Ok(false) };
        let exchange = exchange(run, &columns, method);
        let solved = solve_bands(run, &exchange, method);
        let shot: Vec<f64> = (0..columns.len()).flat_map(|piece| run.shooters.shot(piece).to_vec()).collect();
        run.light.receive_all(gather(&exchange, &columns, &run.light, &shot));
        run.shooters.measure(&run.light);
        if solved.is_break() {
            return Ok(false);
        }
        if method == Method::Matrix || !run.shooters.split_all(&run.light, run.options.spread) {
            let solved = run.is_solved();
            bounces::show(run, &exchange, &columns);
            return Ok(solved);
        }
    }
}

/// The columns of all pieces; nothing when the watcher wants to stop.
fn columns(run: &mut Run<'_>) -> Result<Option<Vec<Arc<Column>>>, Error> {
    let pieces = run.shooters.len();
    if pieces > MOST {
        return Err(Error::Size { pieces });
    }
    let mut columns = Vec::with_capacity(pieces);
    for piece in 0..pieces {
        if run.report().is_break() {
            return Ok(None);
        }
        let Some(column) = run.column(run.shooters.node(piece))? else { return Ok(None) };
        columns.push(column);
    }
    Ok(Some(columns))
}

/// The mean factors, as the method wants them.
fn exchange(run: &mut Run<'_>, columns: &[Arc<Column>], method: Method) -> Exchange {
    let rooms = run.rooms.as_ref().expect("rooms are followed before pieces are relaxed");
    let mut exchange = Exchange::new(run.factors.subdivision, &run.light, rooms, &run.shooters, columns);
    if method == Method::Cg {
        exchange.symmetrise();
    }
    run.scaling = Some(exchange.scaling);
    exchange
}

/// Solves band after band; what the pieces have shot is brought up to date, in any case.
fn solve_bands(run: &mut Run<'_>, exchange: &Exchange, method: Method) -> ControlFlow<()> {
    let bands = run.light.bands;
    let mut shot: Vec<f64> =
        (0..run.shooters.len()).flat_map(|piece| run.shooters.shot(piece).to_vec()).collect();
    let mut solved = ControlFlow::Continue(());
    for band in run.light.live().collect::<Vec<_>>() {
        let balance = balance(run, exchange, band);
        let mut x: Vec<f64> = shot.iter().skip(band).step_by(bands).copied().collect();
        solved = solve_band(run, &balance, band, &mut x, method);
        shot.iter_mut().skip(band).step_by(bands).zip(x).for_each(|(shot, x)| *shot = x);
        if solved.is_break() {
            break;
        }
    }
    run.shooters.set(&shot);
    solved
}

/// The balance of one band, with the pieces' mean emittance and absorptance.
fn balance<'e>(run: &Run<'_>, exchange: &'e Exchange, band: usize) -> Balance<'e> {
    let light = &run.light;
    let mean = |values: &[f64]| {
        let mut sums = vec![0.0; exchange.areas.len()];
        for (element, piece) in exchange.pieced() {
            sums[piece] += light.areas[element] * values[element * light.bands + band];
        }
        sums.iter().zip(&exchange.areas).map(|(sum, area)| sum / area).collect::<Vec<f64>>()
    };
    let absorptance: Vec<f64> = light.reflectance.iter().map(|rho| 1.0 - rho).collect();
    Balance::new(exchange, mean(&light.given()), mean(&absorptance))
}

/// Solves one band from what x holds; again for the true residual while that helps.
fn solve_band(
    run: &mut Run<'_>,
    balance: &Balance<'_>,
    band: usize,
    x: &mut [f64],
    method: Method,
) -> ControlFlow<()> {
    // Black pieces send what they emit: they are no unknowns.
    for piece in (0..x.len()).filter(|&piece| balance.reflectance[piece] == 0.0) {
        x[piece] = balance.emittance[piece];
    }
    let mut residual = balance.residual(x);
    let mut before = f64::INFINITY;
    let mut going = ControlFlow::Continue(());
    // The methods update their residual step by step, so that it drifts from the true one: solve again for that, while it
    // halves each time.
    for _ in 0..REPEATS {
        let near = settle(run, balance, band, x, &residual, largest(&residual));
        if near || going.is_break() || 2.0 * largest(&residual) > before {
            break;
        }
        before = largest(&residual);
        let mut watch = |x: &[f64], residual: &[f64], largest: f64| {
            if settle(run, balance, band, x, residual, largest) {
                return ControlFlow::Break(());
            }
            run.products += 1;
            going = run.report();
            going
        };
        match method {
            Method::Matrix => x.iter_mut().zip(eliminate(balance, &residual)).for_each(|(x, d)| *x += d),
            Method::Gmres => gmres(balance, x, &mut residual, &mut watch),
            _ => conjugate_gradients(balance, x, &mut residual, &mut watch),
        }
        residual = balance.residual(x);
    }
    going
}

/// Notes bound and ledger of a band whose residual is nowhere above `largest`; tells whether it is solved.
fn settle(
    run: &mut Run<'_>,
    balance: &Balance<'_>,
    band: usize,
    x: &[f64],
    residual: &[f64],
    largest: f64,
) -> bool {
    let areas = &balance.exchange.areas;
    let power =
        |values: &mut dyn Iterator<Item = f64>| values.zip(areas).map(|(v, area)| v * area).sum::<f64>();
    run.bound[band] = balance.bound(largest);
    let emitted = run.light.emitted[band];
    let [mut absorbed, mut escaped] = balance.spend(x);
    let [kept, missed] = run.light.spent_directly();
    absorbed += kept[band];
    escaped += missed[band];
    let unshot = power(&mut residual.iter().copied());
    let ledger = &mut run.ledger;
    (ledger.absorbed[band], ledger.escaped[band], ledger.unshot[band]) = (absorbed, escaped, unshot);
    ledger.defect[band] = ledger.remainder(band);
    // A method may know less of the residual itself than of its largest entry.
    run.unshot[band] = power(&mut residual.iter().map(|r| r.abs().min(largest))) / emitted;
    let reflected: Vec<f64> = x.iter().zip(&balance.emittance).map(|(x, e)| (x - e).abs()).collect();
    let brightness = mean_by_itself(&reflected, areas, 1)[0];
    run.unshot[band] <= run.options.tolerance && run.within(run.bound[band], brightness)
}
