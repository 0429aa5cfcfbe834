//! What whole tiles exchange is known: the links between their parts are made to add up to it.
use super::link::Link;
use super::tiling::Tiling;
use formfactor::{AreaFormFactor, Limits, Tolerance};
use rayon::prelude::*;

/// How exact totals are, as a share of the error asked for, and never better than so much of a form factor.
const EXACT: f64 = 0.1;
const LEAST: f64 = 1e-8;
/// Totals that are less exact than so many times that are of no use.
const USELESS: f64 = 10.0;
/// Point form factors for one total.
const MOST: u64 = 1 << 12;
/// Pairs of which totals are found: with more patches each pair matters less.
const PAIRS: usize = 20_000;
/// Links without an error take part with this share of what they carry.
const EVEN: f64 = 1e-3;

/// For each pair of whole tiles that are linked, what they exchange, where that is known.
#[derive(Debug, Default)]
pub(super) struct Totals(Vec<Option<f64>>);

impl Totals {
    /// Of the links of whole tiles, past all that stands between them, for light that is to be right within such an error.
    pub(super) fn of(tiling: &Tiling<'_>, links: &[Link], error: f64) -> Totals {
        if links.len() > PAIRS {
            return Totals::default();
        }
        Totals(links.par_iter().map(|link| total(tiling, link, EXACT * error)).collect())
    }

    /// Shares what is missing of each total, or too much, among its links by their errors.
    pub(super) fn share(&self, links: &mut [Link]) {
        let mut found = vec![[0.0; 2]; self.0.len()];
        let weight = |link: &Link| link.error() + EVEN * link.transfer.exchange[0];
        for link in links.iter() {
            let Some([sum, weights]) = found.get_mut(link.pair) else { continue };
            *sum += link.transfer.exchange[0];
            *weights += weight(link);
        }
        for link in links.iter_mut() {
            let Some(total) = self.0.get(link.pair).copied().flatten() else { continue };
            let [sum, weights] = found[link.pair];
            link.carry(link.transfer.exchange[0] + (total - sum) * weight(link) / weights);
        }
    }
}

/// What the ends of a link exchange, if that can be found.
fn total(tiling: &Tiling<'_>, link: &Link, relative: f64) -> Option<f64> {
    let [one, other] = link.ends.map(|end| &tiling.tiles[end]);
    let tolerance = Tolerance { absolute: LEAST, relative, row: f64::INFINITY };
    let limits = Limits { per_pair: MOST, ..Limits::default() };
    let parts = [one, other].map(|tile| (tile.surface, &tile.polygon));
    let AreaFormFactor { value, error_estimate, .. } =
        tiling.enclosure.area_form_factor(parts[0], parts[1], tolerance, &limits).ok()??;
    (error_estimate <= USELESS * (relative * value).max(LEAST)).then_some(one.area * value)
}
