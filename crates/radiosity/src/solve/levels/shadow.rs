//! What a polygon, or the faces of a body that are seen, hide from a point, whatever else there is.
use crate::extent::Extent;
use formfactor::{DifferentialArea, PlanarPolygon};
use glam::DVec3;

/// What is nearer than this share of its distance to the rim of a shadow is not in it, for certain.
const NEAR: f64 = 1e-9;
/// What is as near as that to the horizon is on it.
const LEVEL: f64 = 1e-14;
/// The shadows of polygons with more corners are not looked at.
const MANY: usize = 16;

/// The convex cone from a point through polygons that continue each other, behind these.
#[derive(Debug)]
pub(super) struct Shadow {
    from: DVec3,
    /// Unit normals of the planes through the point and an edge, which point into the shadow.
    sides: Vec<DVec3>,
    /// Those of the polygons, and how far away their planes are.
    behind: Vec<(DVec3, f64)>,
}

impl Shadow {
    /// The shadow of the first of some polygons that has no hole and few corners, and of those of the others that share edges with it; nothing where it
    /// is not convex, or one is seen from within its plane.
    ///
    /// Edges that two of them share are on no rim. Seen from the point all run around the same way: where what is left bounds a convex cone, every way
    /// in it meets one of them.
    ///
    /// Edges on the horizon bound nothing that is above it.
    pub(super) fn of(polygons: &[&PlanarPolygon], viewer: &DifferentialArea) -> Option<Shadow> {
        let from = viewer.position();
        let mut rim: Vec<[DVec3; 2]> = Vec::new();
        let mut behind = Vec::new();
        for polygon in polygons {
            let mut loops = polygon.loops();
            let Some(outline) =
                loops.next().filter(|outline| outline.len() <= MANY && loops.next().is_none())
            else {
                continue;
            };
            let distance = polygon.normal().dot(outline[0] - from);
            let is_front = distance > 0.0;
            let edges = outline.iter().zip(outline.iter().cycle().skip(1));
            let edges: Vec<[DVec3; 2]> =
                edges.map(|(a, b)| if is_front { [*a, *b] } else { [*b, *a] }).collect();
            let is_known = |[a, b]: &[DVec3; 2]| rim.contains(&[*b, *a]);
            if !rim.is_empty() && !edges.iter().any(is_known) {
                continue;
            }
            behind.push((distance.signum() * polygon.normal(), distance.abs()));
            for [a, b] in edges {
                match rim.iter().position(|edge| *edge == [b, a]) {
                    Some(known) => drop(rim.swap_remove(known)),
                    None => rim.push([a, b]),
                }
            }
        }
        let sides: Vec<DVec3> =
            rim.iter().map(|[a, b]| (*a - from).cross(*b - *a).normalize_or_zero()).collect();
        let is_inside = |[place, _]: &[DVec3; 2]| {
            let way = *place - from;
            sides.iter().all(|side| side.dot(way) >= -NEAR * way.length())
        };
        let is_cone = (3..=MANY).contains(&sides.len()) && rim.iter().all(is_inside);
        let is_before = behind.iter().all(|(_, distance)| *distance > 0.0 && distance.is_finite());
        let is_horizon = |[a, b]: &[DVec3; 2], side: &DVec3| {
            let is_level = |way: DVec3| viewer.normal().dot(way).abs() <= LEVEL * way.length();
            is_level(*a - from) && is_level(*b - from) && side.dot(viewer.normal()) > 0.0
        };
        let sides = rim.iter().zip(sides).filter(|(edge, side)| !is_horizon(edge, side));
        let sides = sides.map(|(_, side)| side).collect();
        (is_cone && is_before).then_some(Shadow { from, sides, behind })
    }

    /// Whether all of a box is in it, for certain.
    pub(super) fn holds(&self, extent: &Extent) -> bool {
        let [low, high] = [extent.low - self.from, extent.high - self.from];
        let near = NEAR * low.abs().max(high.abs()).length();
        let least = |along: &DVec3| (*along * low).min(*along * high).element_sum();
        self.sides.iter().all(|side| least(side) > near)
            && self.behind.iter().all(|(along, distance)| least(along) > distance + near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 3]]) -> PlanarPolygon {
        PlanarPolygon::new([corners.iter().copied().map(DVec3::from).collect::<Vec<_>>()]).unwrap()
    }

    fn extent(low: [f64; 3], high: [f64; 3]) -> Extent {
        Extent { low: low.into(), high: high.into() }
    }

    fn viewer(place: [f64; 3]) -> DifferentialArea {
        DifferentialArea::new(place.into(), DVec3::new(1.0, 1.0, 1.0)).unwrap()
    }

    /// At twice the distance a square of side 2 hides one of side 4.
    #[test]
    fn a_shadow_holds_what_is_behind_its_polygon_alone() {
        let mut corners = vec![[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]];
        for _ in 0..2 {
            let shadow = Shadow::of(&[&polygon(&corners)], &viewer([0.0; 3])).unwrap();
            assert!(shadow.holds(&extent([-1.99, -1.99, 2.0], [1.99, 1.99, 3.0])));
            assert!(!shadow.holds(&extent([-1.99, -1.99, 2.0], [2.01, 1.99, 3.0])));
            assert!(!shadow.holds(&extent([-0.1, -0.1, 1.0], [0.1, 0.1, 3.0])), "touches the polygon");
            assert!(!shadow.holds(&extent([-0.1, -0.1, 0.5], [0.1, 0.1, 0.6])), "stands before it");
            assert!(!shadow.holds(&extent([-0.1, -0.1, -3.0], [0.1, 0.1, -2.0])), "stands behind the point");
            corners.reverse();
        }
    }

    /// Two faces of a block hide what is behind their edge, seen from before it.
    #[test]
    fn faces_of_a_block_have_one_shadow() {
        let left = polygon(&[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 0.0]]);
        let right = polygon(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
        let other = polygon(&[[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [6.0, 0.0, 1.0], [5.0, 0.0, 1.0]]);
        let from = &viewer([-2.0, -2.0, 0.5]);
        let hidden = extent([1.5, 1.5, 0.4], [2.0, 2.0, 0.6]);
        let shadow = Shadow::of(&[&left, &other, &right], from).unwrap();
        assert!(shadow.holds(&hidden));
        assert!(!shadow.holds(&extent([1.5, 1.5, 0.4], [2.0, 2.0, 1.6])), "higher");
        assert!(!shadow.holds(&extent([-0.5, -0.5, 0.4], [2.0, 2.0, 0.6])), "before them");
        let alone = [[&left], [&right]].map(|face| Shadow::of(&face, from).unwrap());
        assert!(alone.iter().all(|shadow| !shadow.holds(&hidden)));
    }

    /// From the ground a wall on it hides what stands on the ground behind it, and from below the ground not all of that.
    #[test]
    fn a_wall_on_the_horizon_hides_what_stands_on_it() {
        let wall = |height: f64| {
            polygon(&[[1.0, -1.0, 0.0], [1.0, -1.0, height], [1.0, 1.0, height], [1.0, 1.0, 0.0]])
        };
        let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
        let box_on_ground = extent([2.0, -1.0, 0.0], [3.0, 1.0, 1.5]);
        assert!(Shadow::of(&[&wall(1.0)], &from).unwrap().holds(&box_on_ground));
        assert!(!Shadow::of(&[&wall(0.7)], &from).unwrap().holds(&box_on_ground), "too low");
        assert!(!Shadow::of(&[&wall(-1.0)], &from).unwrap().holds(&box_on_ground), "below the ground");
        let below = DifferentialArea::new(DVec3::new(0.0, 0.0, -0.1), DVec3::Z).unwrap();
        assert!(!Shadow::of(&[&wall(1.0)], &below).unwrap().holds(&box_on_ground));
    }

    #[test]
    fn what_is_not_convex_has_many_corners_or_is_seen_edge_on_has_none() {
        let notched = [[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [-0.5, -0.5, 1.0], [-1.0, 1.0, 1.0]];
        assert!(Shadow::of(&[&polygon(&notched)], &viewer([0.0; 3])).is_none());
        let round = |count: u32| {
            let corner = |k: u32| {
                let (sine, cosine) = (f64::from(k) / f64::from(count) * std::f64::consts::TAU).sin_cos();
                [cosine, sine, 1.0]
            };
            polygon(&(0..count).map(corner).collect::<Vec<_>>())
        };
        assert!(Shadow::of(&[&round(16)], &viewer([0.0; 3])).is_some());
        assert!(Shadow::of(&[&round(17)], &viewer([0.0; 3])).is_none());
        let square = polygon(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert!(Shadow::of(&[&square], &viewer([3.0, 0.5, 0.0])).is_none());
    }
}
