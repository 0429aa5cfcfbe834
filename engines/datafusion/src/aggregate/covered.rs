//! Features of a union that lie in the interior of another one: they change no bit of it.
use super::state::{bounds, is_outline, rings};
use crate::error::Error;
use crate::validity::is_exact;
use polycsg::{Csg, DVec2, FillRule, PreparedRegion, Region, Scratch};

/// So many of the largest features are looked at as covers.
const COVERS: usize = 8;

/// A cover with more edges costs more than what it covers.
const MOST_BYTES: usize = 1 << 20;

/// A feature and the box around it.
struct Boxed<'s> {
    feature: &'s [u8],
    bounds: [DVec2; 2],
    is_covered: bool,
}

/// The features without those that lie in the interior of one of the largest, box and all.
pub(crate) fn without_covered(features: Vec<&[u8]>) -> Result<Vec<&[u8]>, Error> {
    let boxed = |feature| Ok(Boxed { feature, bounds: bounds(feature)?, is_covered: false });
    let mut all: Vec<Boxed> = features.into_iter().map(boxed).collect::<Result<_, Error>>()?;
    for cover in largest(&all) {
        let inside = |other: &Boxed| !other.is_covered && surrounds(all[cover].bounds, other.bounds);
        let inside: Vec<usize> = (0..all.len()).filter(|&i| inside(&all[i])).collect();
        if inside.is_empty() || all[cover].is_covered {
            continue;
        }
        let Some(region) = exact_region(all[cover].feature)? else { continue };
        for i in inside {
            all[i].is_covered = has_in_its_interior(&region, all[i].bounds);
        }
    }
    Ok(all.into_iter().filter(|boxed| !boxed.is_covered).map(|boxed| boxed.feature).collect())
}

/// The features with the largest boxes, largest first.
fn largest(all: &[Boxed]) -> Vec<usize> {
    let extent = |i: &usize| {
        let size = all[*i].bounds[1] - all[*i].bounds[0];
        -(size.x * size.y)
    };
    let is_cover = |i: &usize| all[*i].feature.len() <= MOST_BYTES && !is_outline(all[*i].feature);
    let mut order: Vec<usize> = (0..all.len()).filter(is_cover).collect();
    let by_extent = |i: &usize, j: &usize| extent(i).total_cmp(&extent(j));
    if order.len() > COVERS {
        order.select_nth_unstable_by(COVERS, by_extent);
        order.truncate(COVERS);
    }
    order.sort_by(by_extent);
    order
}

fn surrounds([low, high]: [DVec2; 2], [inner_low, inner_high]: [DVec2; 2]) -> bool {
    low.cmplt(inner_low).all() && inner_high.cmplt(high).all()
}

/// A feature as a region, if that is the same set: evaluating a feature that crosses itself would round.
fn exact_region(feature: &[u8]) -> Result<Option<PreparedRegion>, Error> {
    let (rings, mut scratch) = (rings(feature)?, Scratch::default());
    let contacts = 16 * feature.len(); // no more than what it takes to find that it is not valid
    if !is_exact(&rings, contacts, &mut scratch) {
        return Ok(None);
    }
    let read = Csg::from_rings(&rings, FillRule::EvenOdd);
    let region = read.and_then(|read| read.try_evaluate_with(&mut scratch, contacts));
    Ok(region.ok().map(PreparedRegion::from))
}

/// Whether a box lies in the interior: one that is larger by the least that a float can tell lies in the closed region.
fn has_in_its_interior(region: &PreparedRegion, [low, high]: [DVec2; 2]) -> bool {
    let (left, bottom, right, top) =
        (low.x.next_down(), low.y.next_down(), high.x.next_up(), high.y.next_up());
    let larger = [[left, bottom], [right, bottom], [right, top], [left, top]];
    Region::from_rings([larger], FillRule::NonZero).is_ok_and(|larger| region.contains(&larger))
}
