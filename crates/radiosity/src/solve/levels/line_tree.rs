//! Lines on a patch, of which a ground may have as many as there are houses on it.
use super::boxes::Boxes;
use super::tile::Outline;
use crate::extent::Extent;
use glam::DVec2;

/// What is beside an outline by less than this share of its size may be on its rim.
const RIM: f64 = 1e-6;

/// Lines in the frame of a patch, and a tree of the boxes around them.
#[derive(Debug)]
pub(super) struct LineTree {
    pub(super) ends: Vec<[DVec2; 2]>,
    boxes: Boxes,
}

impl LineTree {
    /// O(n log² n) for n lines.
    pub(super) fn of(ends: Vec<[DVec2; 2]>) -> LineTree {
        let extents: Vec<Extent> = ends.iter().map(|line| extent(line.iter().copied())).collect();
        LineTree { boxes: Boxes::around(&extents), ends }
    }

    /// The lines that may pass through an outline, or along its rim, in their order.
    pub(super) fn near(&self, outline: &Outline) -> Vec<usize> {
        let around = extent(outline.corners.iter().map(|(flat, _)| *flat));
        let near = self.boxes.find(|extent| !extent.is_near(&around, RIM * around.diagonal()));
        near.into_iter().map(|line| line as usize).collect()
    }

    /// Whether what is asked for holds for one of the lines that may be nearer to a place than `reach`.
    pub(super) fn any_near(&self, place: DVec2, reach: f64, is: impl Fn([DVec2; 2]) -> bool) -> bool {
        let at = extent([place].into_iter());
        self.boxes.any(|extent| !extent.is_near(&at, reach), |line| is(self.ends[line as usize]))
    }
}

/// The box around places in a frame.
fn extent(places: impl Iterator<Item = DVec2>) -> Extent {
    Extent::of_points(places.map(|flat| flat.extend(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_line_that_rounding_puts_beside_the_rim_is_near() {
        let corners = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.3], [0.0, 0.3]].map(|flat| (flat.into(), DVec3::ZERO));
        let outline = Outline::new(corners.to_vec()).unwrap();
        let at = |x: f64| [DVec2::new(x, 0.1), DVec2::new(x, 0.2)];
        let is_near = |x: f64| !LineTree::of(vec![at(x)]).near(&outline).is_empty();
        assert!(0.1 + 0.2 > 0.3 && is_near(0.1 + 0.2) && is_near(-1e-17) && !is_near(0.301));
    }
}
