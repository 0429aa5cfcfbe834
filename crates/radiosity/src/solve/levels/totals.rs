//! What whole tiles exchange is known: the links between their parts are made to add up to it.
use super::budget::BandLight;
use super::flow::square;
use super::link::Link;
use super::tiling::Tiling;
use formfactor::{AreaFormFactor, Limits, Tolerance};
use rayon::prelude::*;

/// How exact totals are, as a share of themselves and of the error asked for; or as a share of what patches receive and of the error asked for,
/// all totals of a patch together and each alike, where that is more.
const EXACT: f64 = 0.1;
/// What totals are wrong by, as a share of what they say: of 3852 between patches of rooms of seven kinds and of the built-in scenes 67 were off by
/// more, 26 by more than twice this, and half of them by less than a ten-thousandth. Those that ran out of points are the furthest from what they say.
const TRUTH: f64 = 0.125;
/// No form factor is found better than to this.
const LEAST: f64 = 1e-8;
/// Totals that are as good as this share of themselves are believed, whatever the links' errors are said to be.
const GOOD: f64 = 0.05;
/// Point form factors for one total, …
const MOST: u64 = 1 << 12;
/// … and for one that is wrong by more than this share of what its patches may be wrong by in all.
const MANY: u64 = 1 << 16;
const MUCH: f64 = 0.2;
/// Where there are many, none is found between whose tiles more may stand, as between a wall and all of a ground: a point costs as much more, and
/// what matters of it is told by links of parts.
const BETWEEN: usize = 128;
/// Links without an error take part with this share of what they carry.
const EVEN: f64 = 1e-3;

/// For each pair of whole tiles that are linked, what they exchange, where that is known.
#[derive(Debug, Default)]
pub(super) struct Totals(Vec<Option<Total>>);

/// What a pair exchanges, and how wrong that may be.
#[derive(Clone, Copy, Debug)]
struct Total {
    power: f64,
    error: f64,
}

/// How exact the total of a pair is to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    absolute: f64,
    relative: f64,
    /// More than this is wrong with a patch.
    needed: f64,
}

impl Totals {
    /// How exact the total of each link of whole tiles is to be, for light that is to be right within such an error; where there are many, of those
    /// that may carry more than that of all that reaches one of their patches.
    pub(super) fn wanted(
        tiling: &Tiling<'_>,
        links: &[Link],
        lights: &[BandLight],
        error: f64,
        are_many: bool,
    ) -> Vec<Option<Wanted>> {
        let wanted = |([share, whole], link): ([f64; 2], &Link)| {
            let is_much = link.transfer.exchange[0] + link.error() > error * whole;
            let matters = !are_many || (is_much && link.among.len() <= BETWEEN);
            matters.then_some(Wanted {
                absolute: EXACT * error * share,
                relative: EXACT * error,
                needed: MUCH * error * whole,
            })
        };
        shares(tiling, links, lights).into_iter().zip(links).map(wanted).collect()
    }

    /// Finds those of the next links, past all that stands between their tiles.
    pub(super) fn find(&mut self, tiling: &Tiling<'_>, links: &[Link], wanted: &[Option<Wanted>]) {
        let total = |(link, wanted): (&Link, &Option<Wanted>)| total(tiling, link, wanted.as_ref()?);
        self.0.par_extend(links.par_iter().zip(wanted).map(total));
    }

    /// Whether it is known that all that a pair could exchange is hidden.
    pub(super) fn is_hidden(&self, pair: usize) -> bool {
        self.0.get(pair).copied().flatten().is_some_and(|total| total.power + total.error == 0.0)
    }

    /// Makes the links add up to the totals though what each carries is scaled.
    pub(super) fn restore(&self, links: &mut [Link], scales: &[f64]) {
        let mut found = vec![0.0; self.0.len()];
        for (link, scale) in links.iter().zip(scales) {
            found.get_mut(link.pair).into_iter().for_each(|sum| *sum += link.exchange[0] * scale);
        }
        for link in links.iter_mut().filter(|link| link.of_total.is_some()) {
            let Some(total) = self.0.get(link.pair).copied().flatten() else { continue };
            if found[link.pair] > 0.0 {
                link.carry(link.exchange[0] * total.power / found[link.pair]);
            }
        }
    }

    /// Shares what is missing of each total, or too much, among its links by their errors, where the total is better known than they are.
    pub(super) fn share(&self, links: &mut [Link]) {
        let mut found = vec![[0.0; 3]; self.0.len()];
        let weight = |link: &Link| link.error() + EVEN * link.transfer.exchange[0];
        for link in links.iter() {
            let Some([sum, weights, errors]) = found.get_mut(link.pair) else { continue };
            *sum += link.transfer.exchange[0];
            *weights += weight(link);
            *errors += link.error();
        }
        for link in links.iter_mut() {
            let Some(total) = self.0.get(link.pair).copied().flatten() else { continue };
            let [sum, weights, errors] = found[link.pair];
            let is_better = total.error < errors.max(GOOD * total.power);
            let change = if is_better { (total.power - sum) * weight(link) / weights } else { 0.0 };
            link.carry(link.transfer.exchange[0] + change);
            let share =
                if total.power > 0.0 { link.exchange[0] / total.power } else { weight(link) / weights };
            link.of_total = is_better.then_some(total.error * share);
            link.most = if is_better { total.power + total.error } else { f64::INFINITY };
        }
    }
}

/// For each link how much it would exchange, were all that an end receives shared alike by its links, and were all of it its own; of both ends
/// the less.
fn shares(tiling: &Tiling<'_>, links: &[Link], lights: &[BandLight]) -> Vec<[f64; 2]> {
    let patch_of = |end: usize| tiling.tiles[end].patch;
    let mut counts = vec![0.0; tiling.scene.patches.len()];
    links.iter().flat_map(|link| link.ends).for_each(|end| counts[patch_of(end)] += 1.0);
    let of = |light: &BandLight, [here, there]: [usize; 2]| {
        // What seems dark so far counts as if it were as bright as others.
        let bright = square(light.sent[there]).sqrt().max(light.mean);
        let whole = light.unit[here] / bright;
        [whole / counts[patch_of(here)], whole]
    };
    let share = |link: &Link| {
        let [one, other] = link.ends;
        let ends = lights.iter().flat_map(|light| [of(light, [one, other]), of(light, [other, one])]);
        ends.fold([f64::INFINITY; 2], |least, end| [0, 1].map(|k| least[k].min(end[k])))
    };
    links.iter().map(share).collect()
}

/// What the ends of a link exchange, if that can be found.
fn total(tiling: &Tiling<'_>, link: &Link, wanted: &Wanted) -> Option<Total> {
    let found = within(tiling, link, wanted, MOST)?;
    if found.error <= wanted.needed { Some(found) } else { within(tiling, link, wanted, MANY) }
}

/// The same from so many points.
fn within(tiling: &Tiling<'_>, link: &Link, wanted: &Wanted, points: u64) -> Option<Total> {
    let [one, other] = link.ends.map(|end| &tiling.tiles[end]);
    let absolute = if points > MOST { wanted.needed } else { wanted.absolute };
    let absolute = (absolute / one.area.min(other.area) / TRUTH).clamp(LEAST, 1.0);
    let tolerance = Tolerance { absolute, relative: wanted.relative / TRUTH, row: f64::INFINITY };
    let limits = Limits { per_pair: points, ..Limits::default() };
    let parts = [one, other].map(|tile| (tile.surface, &tile.polygon));
    let AreaFormFactor { value, error_estimate, evaluations, .. } =
        tiling.enclosure.area_form_factor(parts[0], parts[1], tolerance, &limits).ok()??;
    // Points that see nothing do not tell that there is nothing; one occluder that hides all does.
    let is_known = value > 0.0 || error_estimate > 0.0 || evaluations == 0;
    // What may be nothing counts as nothing.
    let error = TRUTH * error_estimate;
    let [power, error] = if value > error { [value, error] } else { [0.0, value + error] };
    is_known.then_some(Total { power: one.area * power, error: one.area * error })
}
