//! Parts of leaves, over which light is shown as linear.
use super::flow::Linear;
use super::tile::Outline;
use glam::DVec2;

/// A part of a leaf.
#[derive(Clone, Debug)]
pub(super) struct LeafPart {
    /// Which of the leaves.
    pub(super) leaf: usize,
    pub(super) outline: Outline,
    /// What it receives, band by band, where that is known.
    plane: Vec<Linear>,
}

impl LeafPart {
    /// A part of which it is not known what it receives.
    pub(super) fn new(leaf: usize, outline: Outline) -> LeafPart {
        LeafPart { leaf, outline, plane: Vec::new() }
    }

    /// The same, of which that is known.
    pub(super) fn receiving(self, plane: Vec<Linear>) -> LeafPart {
        LeafPart { plane, ..self }
    }

    /// What is received at a place inside of it, if that is known.
    pub(super) fn inside(&self, at: DVec2) -> Option<Vec<f64>> {
        let linear = self.outline.linear(at);
        let light = || self.plane.iter().map(|plane| value(*plane, linear).max(0.0)).collect();
        (!self.plane.is_empty() && self.outline.holds(at)).then(light)
    }
}

/// The linear light that five points receive, band by band: from the centroid and the tips of the axes.
pub(super) fn planes(light: &[f64]) -> Vec<Linear> {
    let bands = light.len() / 5;
    let plane = |band: usize| {
        let at = |point: usize| light[point * bands + band];
        [at(0), (at(1) - at(2)) / 2.0, (at(3) - at(4)) / 2.0]
    };
    (0..bands).map(plane).collect()
}

/// What linear light is where the two linear functions are so much.
pub(super) fn value([mean, first, second]: Linear, [a, b]: [f64; 2]) -> f64 {
    mean + a * first + b * second
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn what_is_linear_is_known_inside_and_on_no_side() {
        let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]];
        let placed = corners.map(|[x, y]| (DVec2::new(x, y), DVec3::new(x, y, 0.0)));
        let outline = Outline::new(placed.to_vec()).unwrap();
        let light = |at: DVec2| [1.0 + 2.0 * at.x - 0.5 * at.y, 4.0 - at.x];
        let seen: Vec<f64> = outline.points().into_iter().flat_map(light).collect();
        let part = LeafPart::new(0, outline);
        let within = DVec2::new(2.9, 0.3);
        assert_eq!(part.inside(within), None, "nothing is known");
        let part = part.receiving(planes(&seen));
        let found = part.inside(within).unwrap();
        assert!(
            found.iter().zip(light(within)).all(|(found, light)| (found - light).abs() < 1e-4),
            "{found:?}"
        );
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [3.0, 0.5], [1.0, 1.5], [-1.0, 0.5]] {
            assert_eq!(part.inside(DVec2::new(x, y)), None, "{x} {y}");
        }
    }
}
