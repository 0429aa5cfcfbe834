//! Reads the operands' rings. Rings that are near in the plane are stored one after the other.

use super::{END, EdgeRing, Edges, Origin};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort_on, threads::Threads};
use crate::expression::{bounds::ResultBounds, csg::Csg, csg::Token, winding::WindingNumbers};
use crate::predicates::Window;
use crate::region::rings::Rings;
use glam::DVec2;

/// More rings than this are sorted, so that what lies close in the plane lies close in memory.
const FEW_RINGS: usize = 64;

/// Rings of more points are cut down to what the result's bounds see of them.
const FEW_POINTS: usize = if cfg!(any(test, fuzzing)) { 3 } else { 64 };

/// A ring by its first point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RingKey {
    point: DVec2,
    /// The operand, and where it stands in the expression.
    operand: u32,
    token: u32,
    ring: u32,
}

/// Lists the rings of all operands, or of those alone that are not prepared; returns whether these are all.
fn list_rings(csg: &Csg<'_>, all: bool, keys: &mut Vec<RingKey>) -> bool {
    keys.clear();
    let (mut operand, mut whole) = (0, true);
    for (token, leaf) in (0..).zip(csg.postfix()) {
        let Some(rings) = leaf.rings() else { continue };
        if !all && matches!(leaf, Token::Prepared(_)) {
            whole = false;
        } else {
            let key = |(ring, points): (u32, &[DVec2])| RingKey { point: points[0], operand, token, ring };
            keys.extend((0..).zip(rings.iter()).map(key));
        }
        operand += 1;
    }
    whole
}

/// Whether each ring lies about as near to the one before it as it would when sorted by columns.
fn are_near(rings: &[RingKey]) -> bool {
    let (mut low, mut high, mut way) = (DVec2::MAX, DVec2::MIN, DVec2::ZERO);
    for (a, b) in rings.iter().zip(&rings[1..]) {
        low = low.min(b.point);
        high = high.max(b.point);
        way += (b.point - a.point).abs();
    }
    let columns = DVec2::splat(rings.len() as f64).powf(0.5);
    way.cmple(4.0 * columns * (high - low)).all()
}

/// Sorts by columns of about as many rings as there are columns, up and down in turn.
fn sort_by_place(rings: &mut [RingKey], meter: &Meter<'_>) -> Result<(), Refusal> {
    let threads = Threads::for_edges(rings.len());
    let rightward = |a: &RingKey, b: &RingKey| {
        a.point.x.total_cmp(&b.point.x).then((a.operand, a.ring).cmp(&(b.operand, b.ring)))
    };
    sort_on(threads, rings, rightward, meter)?;
    let column = rings.len().isqrt().max(1);
    threads.try_for_each(rings.chunks_mut(column).enumerate(), |(i, rings)| {
        rings.sort_unstable_by(|a, b| {
            let upward = a.point.y.total_cmp(&b.point.y).then((a.operand, a.ring).cmp(&(b.operand, b.ring)));
            if i % 2 == 0 { upward } else { upward.reverse() }
        });
        meter.spend(rings.len())
    })
}

impl Edges {
    /// Reads the operands, without the rings that miss the result's bounds. Repeated points are dropped, and rings that have
    /// fewer than three others left.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn collect(
        &mut self,
        csg: &Csg<'_>,
        winding: &WindingNumbers,
        bounds: &ResultBounds,
        all: &mut Vec<RingKey>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.clear();
        let window = bounds.window();
        let whole = list_rings(csg, window.is_none(), all);
        if all.len() > FEW_RINGS && !are_near(all) {
            sort_by_place(all, meter)?;
        }
        let mut tally = meter.tally();
        for &place in &*all {
            if let Some(rings) = csg.token(place.token as usize).rings() {
                tally.add(rings.closed(place.ring as usize).len())?;
                self.add_ring(rings, place, winding, bounds, window.as_ref());
            }
        }
        if let (Some(window), false) = (window, whole) {
            let leaves = csg.postfix().filter(|leaf| leaf.rings().is_some());
            for (leaf, operand) in leaves.zip(0..) {
                if let Token::Prepared(prepared) = leaf {
                    let before = self.len();
                    self.add_prepared(prepared, operand, winding.counter(operand as usize), &window);
                    tally.add(self.len() - before)?;
                }
            }
        }
        Ok(())
    }

    fn add_ring(
        &mut self,
        rings: &Rings,
        place: RingKey,
        winding: &WindingNumbers,
        bounds: &ResultBounds,
        window: Option<&Window>,
    ) {
        let (operand, ring) = (place.operand, place.ring as usize);
        let counter = winding.counter(operand as usize);
        // What bounds nothing is an edge alone, not the way there and back.
        let (is_open, fewest) = (counter.is_none(), if counter.is_none() { 1 } else { 3 });
        let (start, points) = (index(self.points.len()), rings.closed(ring));
        let points = if is_open { &points[..2] } else { points };
        if !bounds.meets(points) {
            return;
        }
        let origin = Origin { operand, edge: index(rings.start(ring)) };
        let repeats = points.windows(2).any(|pair| pair[0] == pair[1]);
        if !repeats && window.is_some_and(|window| self.add_if_cut(points, origin, counter, window)) {
            return;
        }
        if repeats {
            self.add_distinct(points, origin);
        } else {
            self.points.extend_from_slice(points);
        }
        if self.points.len() < start as usize + fewest + 1 {
            self.points.truncate(start as usize);
            self.origins.truncate(start as usize);
            return;
        }
        let slots = start..index(self.points.len());
        if !self.origins.is_empty() && self.origins.len() < self.points.len() {
            self.origins
                .extend(slots.clone().map(|slot| Origin { operand, edge: origin.edge + slot - start }));
        }
        self.ring.resize(self.points.len(), index(self.rings.len()));
        self.rings.push(EdgeRing {
            start,
            end: slots.end - 1,
            is_open,
            counter,
            winds: 1,
            also: END,
            origin,
        });
    }

    /// Adds a ring of many points that leaves a window by what the window sees of it; false, if it is to be added whole.
    fn add_if_cut(
        &mut self,
        points: &[DVec2],
        origin: Origin,
        counter: Option<u32>,
        window: &Window,
    ) -> bool {
        points.len() > FEW_POINTS
            && points.iter().any(|&p| window.outer_sides(p, p) != 0)
            && self.add_seen(points, origin, counter, window)
    }

    /// Stores the origin of each slot.
    pub(super) fn store_origins(&mut self) {
        if self.origins.is_empty() {
            let mut origins = std::mem::take(&mut self.origins);
            origins.extend((0..index(self.points.len())).map(|slot| self.origin(slot)));
            self.origins = origins;
        }
    }

    /// The points of a ring that differ from the next one, and the first of them again.
    fn add_distinct(&mut self, points: &[DVec2], origin: Origin) {
        let start = self.points.len();
        self.store_origins();
        for (pair, edge) in points.windows(2).zip(origin.edge..) {
            if pair[0] != pair[1] {
                self.points.push(pair[0]);
                self.origins.push(Origin { operand: origin.operand, edge });
            }
        }
        if self.points.len() > start {
            self.points.push(self.points[start]);
            self.origins.push(origin);
        }
    }
}
