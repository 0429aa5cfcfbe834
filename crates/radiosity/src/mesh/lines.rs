//! What the points inside a patch are kept apart from: pieces of its boundary and of the lines across it, and the points on them.
use super::flat_index::FlatIndex;
use glam::DVec2;

/// The lines so far.
pub(super) struct InnerLines {
    pieces: FlatIndex,
    /// The points, under their numbers.
    points: FlatIndex,
}

impl InnerLines {
    /// The pieces of a boundary, and its points.
    pub(super) fn new(pieces: Vec<[DVec2; 2]>, points: &[DVec2]) -> InnerLines {
        let points = points.iter().map(|&point| [point, point]).collect();
        InnerLines { pieces: FlatIndex::new(pieces), points: FlatIndex::new(points) }
    }

    /// Adds the next point.
    pub(super) fn push_point(&mut self, point: DVec2) {
        self.points.push([point, point]);
    }

    /// Adds a piece of a line.
    pub(super) fn push_piece(&mut self, ends: [DVec2; 2]) {
        self.pieces.push(ends);
    }

    /// The first point within a distance.
    pub(super) fn known(&self, flat: DVec2, distance: f64) -> Option<usize> {
        let near = self.points.around(flat, distance).filter(|(_, [at, _])| at.distance(flat) < distance);
        near.map(|(index, _)| index).min()
    }

    /// Whether a piece comes within a distance of a point.
    pub(super) fn are_near(&self, point: DVec2, distance: f64) -> bool {
        let near = |(_, [a, b]): (usize, [DVec2; 2])| {
            let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            point.distance_squared(a.lerp(b, along)) < distance * distance
        };
        self.pieces.around(point, distance).any(near)
    }
}
