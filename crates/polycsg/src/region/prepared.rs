//! A region with an index over its edges.

use super::rings::{Rings, ring_edges};
use super::{Location, Look, Region, look_down};
use crate::base::corners::corners;
use crate::predicates::Window;
use crate::spatial::chord_tree::{ChordTree, Sight};
use glam::DVec2;
use std::ops::ControlFlow;

/// A [`Region`] with an index over its edges, for many questions about one region.
///
/// Built once in O(n log n) for n edges, immutable, and shared by any number of threads. Beside the region's own 16 bytes for
/// each point, the index takes at most 20 bytes for each edge and 160 bytes for each ring.
///
/// As an operand of an expression it is the same set as its region, bit for bit in every result. Where the other operands confine
/// the result to a box, as in `small & prepared` and `small - prepared`, only the edges near that box are read: O(k + log n) for k of
/// them.
///
/// ```
/// use polycsg::{Csg, DVec2, FillRule, Location, PreparedRegion, Region};
/// let corner = |i: u32| DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 10_000.0) * 100.0;
/// let disk = PreparedRegion::from(Region::from_rings([(0..10_000).map(corner).collect::<Vec<_>>()], FillRule::NonZero)?);
/// assert_eq!(disk.locate(DVec2::new(60.0, 70.0)), Location::Inside);
/// let tile = Region::from_rings([[[99.0, 0.0], [101.0, 0.0], [101.0, 2.0], [99.0, 2.0]]], FillRule::NonZero)?;
/// assert!(disk.intersects(&tile) && !disk.contains(&tile));
/// let rest = (Csg::from(&tile) - Csg::from(&disk)).evaluate(); // reads some 40 of the 10 000 edges
/// assert_eq!(rest, tile.difference(disk.region()));
/// # Ok::<(), polycsg::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PreparedRegion {
    region: Region,
    tree: ChordTree,
}

impl From<Region> for PreparedRegion {
    fn from(region: Region) -> PreparedRegion {
        PreparedRegion { tree: ChordTree::build(region.rings_of()), region }
    }
}

impl PreparedRegion {
    /// The region.
    #[must_use]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// Whether a point lies inside, outside or on the boundary, exactly, as [`Region::locate`] tells it. O(log n), plus one
    /// step for each run of edges whose box and narrowest band contain the point.
    #[must_use]
    pub fn locate(&self, point: DVec2) -> Location {
        if !point.is_finite() {
            return Location::Outside;
        }
        self.locate_window(&Window::new(point, point))
    }

    /// Where a whole window lies; on the boundary, if any edge is in it.
    pub(crate) fn locate_window(&self, window: &Window) -> Location {
        let points = self.rings().points();
        let mut inside = false;
        let beside = self.view(window, |sight| match sight {
            Sight::Ring(_) => ControlFlow::Continue(()),
            Sight::Edge(_) => ControlFlow::Break(()),
            Sight::Chord(ends, _) => {
                let hits = look_down(ends.map(|slot| points[slot as usize]), window.low);
                inside ^= matches!(hits, Look::Hits);
                ControlFlow::Continue(())
            }
        });
        match (beside, inside) {
            (ControlFlow::Break(()), _) => Location::Boundary,
            (_, true) => Location::Inside,
            (_, false) => Location::Outside,
        }
    }

    pub(crate) fn rings(&self) -> &Rings {
        self.region.rings_of()
    }

    /// The box around the region; none if that is empty.
    pub(crate) fn bounds(&self) -> Option<[DVec2; 2]> {
        self.tree.bounds()
    }

    /// What a window sees of the region; see [`ChordTree::view`].
    pub(crate) fn view(
        &self,
        window: &Window,
        show: impl FnMut(Sight) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.tree.view(self.rings().points(), window, show)
    }
}

impl Region {
    /// The box around it.
    pub(crate) fn window(&self) -> Window {
        let [low, high] = corners(self.rings.points());
        Window::new(low, high)
    }
}

/// Whether a closed chain of points runs around a point, an odd number of times; it does not pass the point.
pub(crate) fn surrounds(ring: &[DVec2], p: DVec2) -> bool {
    ring_edges(ring).filter(|&edge| matches!(look_down(edge, p), Look::Hits)).count() % 2 == 1
}
