//! Lines on a patch, of which a ground may have as many as there are houses on it.
use super::boxes::Boxes;
use crate::extent::Extent;
use glam::DVec2;

/// Lines in the frame of a patch, and a tree of the boxes around them.
pub(super) struct LineTree {
    pub(super) ends: Vec<[DVec2; 2]>,
    boxes: Boxes,
}

impl LineTree {
    pub(super) fn of(ends: Vec<[DVec2; 2]>) -> LineTree {
        let extents: Vec<Extent> = ends.iter().map(|line| extent(line.iter().copied())).collect();
        LineTree { boxes: Boxes::around(&extents), ends }
    }

    /// Looks at the lines whose boxes are nearer to that around some places than `reach`, until one of them ends the search: whether one did.
    pub(super) fn any_near(
        &self,
        places: impl Iterator<Item = DVec2>,
        reach: f64,
        mut ends: impl FnMut(usize) -> bool,
    ) -> bool {
        let around = extent(places);
        self.boxes.any(|extent| !extent.is_near(&around, reach), |line| ends(line as usize))
    }
}

fn extent(places: impl Iterator<Item = DVec2>) -> Extent {
    Extent::of_points(places.map(|place| place.extend(0.0)))
}
