//! Whether two convex sets are apart: a search for a direction that separates them.
use glam::DVec3;

/// After so many directions the sets count as meeting.
const MOST: usize = 12;

/// A gap counts when it is larger than this share of the sets' extents.
const CLEAR: f64 = 1e-12;

/// Whether the convex hulls of two sets of points are apart, for certain. Each direction that does not separate them is
/// reflected by that between the points found farthest along it [Chung and Wang 1996].
pub(crate) fn are_apart(one: &[DVec3], other: &[DVec3], towards: DVec3) -> bool {
    let mut direction = towards;
    for _ in 0..MOST {
        let (Some(p), Some(q)) = (farthest(one, direction), farthest(other, -direction)) else { return true };
        let way = q - p;
        let gap = direction.dot(way);
        if gap > CLEAR * direction.length() * (p.abs() + q.abs()).element_sum() {
            return true;
        }
        let Some(way) = way.try_normalize() else { return false };
        direction -= 2.0 * direction.dot(way) * way;
    }
    false
}

fn farthest(points: &[DVec3], direction: DVec3) -> Option<DVec3> {
    let (first, rest) = points.split_first()?;
    let start = (*first, first.dot(direction));
    let best = rest.iter().fold(start, |best, p| {
        let reach = p.dot(direction);
        if reach > best.1 { (*p, reach) } else { best }
    });
    Some(best.0)
}
