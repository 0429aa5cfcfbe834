//! Whether one region contains another one, and whether two meet. Nothing is rounded.

use crate::expression::csg::Csg;
use crate::pipeline::scratch::Scratch;
use crate::predicates::{Segment, Side, Window, side};
use crate::region::{Location, Region, prepared::PreparedRegion, rings::ring_edges};
use crate::spatial::chord_tree::Sight;
use std::ops::ControlFlow;

impl PreparedRegion {
    /// As [`Region::contains`], in O(m + k log(m + k)) for m edges of the other region and k of this one near its box.
    #[must_use]
    pub fn contains(&self, other: &Region) -> bool {
        match self.locate_window(&other.window()) {
            Location::Inside => true,
            Location::Outside => other.is_empty(),
            Location::Boundary => covers(&Csg::from(self), other),
        }
    }

    /// As [`Region::intersects`], in O(m log n + k log k) for m edges of the other region, n of this one, k of them near its box.
    #[must_use]
    pub fn intersects(&self, other: &Region) -> bool {
        match self.locate_window(&other.window()) {
            Location::Inside => true,
            Location::Outside => false,
            Location::Boundary => {
                let common = Csg::from(self) & Csg::from(other);
                self.touches(other) || !common.boundary(&mut Scratch::default()).is_empty()
            }
        }
    }

    /// Whether the boundaries have a point in common.
    fn touches(&self, other: &Region) -> bool {
        let points = self.rings().points();
        other.rings().flat_map(ring_edges).any(|edge| {
            let window = Window::new(edge[0].min(edge[1]), edge[0].max(edge[1]));
            let apart = self.view(&window, |sight| match sight {
                Sight::Edge(e) if meet(edge, [points[e as usize], points[e as usize + 1]]) => {
                    ControlFlow::Break(())
                }
                _ => ControlFlow::Continue(()),
            });
            apart.is_break()
        })
    }
}

impl Region {
    /// Whether every point of another region is one of this one, both taken with their boundaries: two equal regions contain one
    /// another, and so does a region what touches its boundary from inside. The empty set is contained in every region.
    /// Exact. Expected O((n + k) log n) for n edges with k contacts.
    ///
    /// ```
    /// use polycsg::{FillRule, Region};
    /// let square = |x: f64, size: f64| {
    ///     Region::from_rings([[[x, 0.0], [x + size, 0.0], [x + size, size], [x, size]]], FillRule::NonZero)
    /// };
    /// let (a, b, c) = (square(0.0, 4.0)?, square(0.0, 1.0)?, square(4.0, 1.0)?);
    /// assert!(a.contains(&b) && !b.contains(&a)); // though their boundaries touch
    /// assert!(a.intersects(&c) && !b.intersects(&c)); // touching is enough
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn contains(&self, other: &Region) -> bool {
        covers(&Csg::from(self), other)
    }

    /// Whether the two regions have any point in common, both taken with their boundaries: regions that touch in one point do.
    /// Exact. Expected O((n + k) log n) for n edges with k contacts.
    #[must_use]
    pub fn intersects(&self, other: &Region) -> bool {
        PreparedRegion::from(self.clone()).intersects(other)
    }
}

/// Whether nothing is left of a region without a set. What is left would have interior points, as the region is the closure of
/// its interior, and the set is closed.
fn covers(set: &Csg<'_>, region: &Region) -> bool {
    (Csg::from(region) - set.clone()).boundary(&mut Scratch::default()).is_empty()
}

/// Whether two edges have a point in common, where the second meets the box of the first.
fn meet(s: Segment, t: Segment) -> bool {
    let apart = |line: Segment, ends: Segment| {
        let sides = ends.map(|p| side(line[0], line[1], p));
        sides[0] == sides[1] && sides[0] != Side::On
    };
    !apart(s, t) && !apart(t, s)
}
