//! Whether one surface hides all of a tile from another: the convex hull of both passes through it.
use super::tiling::Tile;
use formfactor::PlanarPolygon;
use glam::DVec3;

/// Whether a polygon without holes stands between two tiles so that each way from one to the other ends at it; ways past its edges that are
/// nearer than `near` do not count. All ways pass its plane within the hull of those from corner to corner.
pub(super) fn hides(polygon: &PlanarPolygon, tiles: [&Tile; 2], near: f64) -> bool {
    let mut loops = polygon.loops();
    let (Some(outline), None) = (loops.next(), loops.next()) else { return false };
    let (normal, origin) = (polygon.normal(), outline[0]);
    let heights = tiles.map(|tile| {
        tile.outline.places().map(|place| (place, normal.dot(place - origin))).collect::<Vec<_>>()
    });
    let is_on = |end: usize, side: f64| heights[end].iter().all(|(_, height)| side * height >= -near);
    // What lies in its plane may be seen from its own side.
    let is_off = heights.iter().all(|end| end.iter().any(|(_, height)| height.abs() > near));
    let is_between = (is_on(0, 1.0) && is_on(1, -1.0)) || (is_on(0, -1.0) && is_on(1, 1.0));
    let inside = |place: DVec3| {
        let edges = outline.iter().zip(outline.iter().cycle().skip(1));
        edges
            .map(|(a, b)| (*a, normal.cross(b - a)))
            .all(|(a, inward)| inward.dot(place - a) >= -near * inward.length())
    };
    let mut ways = heights[0].iter().flat_map(|from| heights[1].iter().map(move |to| [*from, *to]));
    let is_stopped = |[(from, above), (to, below)]: [(DVec3, f64); 2]| {
        if above.abs().max(below.abs()) <= near {
            return inside(from) && inside(to);
        }
        inside(from + (above / (above - below)).clamp(0.0, 1.0) * (to - from))
    };
    is_off && is_between && ways.all(is_stopped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use crate::solve::levels::tiling::Tiling;

    /// A square at a height, of half the given side, turned up or down.
    fn square(z: f64, half: f64, is_up: bool) -> Patch {
        let mut corners = [[-half, -half], [half, -half], [half, half], [-half, half]]
            .map(|[x, y]| DVec3::new(x, y, z))
            .to_vec();
        if !is_up {
            corners.reverse();
        }
        let polygon = PlanarPolygon::new([corners]).unwrap();
        Patch::new(format!("at {z}"), polygon, vec![0.5], vec![1.0])
    }

    fn is_hidden(screen: &Patch) -> bool {
        let patches = vec![square(0.0, 1.0, true), square(2.0, 3.0, false)];
        let scene = Scene { patches, bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        hides(&screen.polygon, [&tiling.tiles[0], &tiling.tiles[1]], 1e-9)
    }

    /// Half way between squares of half sides 1 and 3 the hull has one of 2.
    #[test]
    fn a_screen_hides_what_it_covers() {
        assert!(is_hidden(&square(1.0, 2.0, true)) && is_hidden(&square(1.0, 2.1, false)));
        assert!(!is_hidden(&square(1.0, 1.999, true)));
        assert!(is_hidden(&square(0.5, 1.5, true)) && !is_hidden(&square(1.5, 2.4, true)));
        // Before and behind both, and in the plane of the first, it hides nothing.
        for z in [-1.0, 0.0, 3.0] {
            assert!(!is_hidden(&square(z, 9.0, false)), "{z}");
        }
    }

    /// Floor and ceiling on both sides of a wall have their edges in its plane.
    #[test]
    fn a_wall_that_reaches_floor_and_ceiling_parts_them() {
        let patch = |corners: [[f64; 3]; 4]| {
            let polygon = PlanarPolygon::new([corners.map(DVec3::from)]).unwrap();
            Patch::new("", polygon, vec![0.5], vec![1.0])
        };
        let floor = patch([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let ceiling = patch([[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, 0.0, 1.0]]);
        let wall = |top: f64| patch([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, top], [0.0, 0.0, top]]);
        let scene = Scene { patches: vec![floor, ceiling], bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        let parts = |top| hides(&wall(top).polygon, [&tiling.tiles[0], &tiling.tiles[1]], 1e-9);
        assert!(parts(1.0) && !parts(0.999));
    }

    #[test]
    fn a_hole_and_a_notch_let_light_through() {
        let outline = square(1.0, 4.0, true).polygon.loops().next().unwrap().to_vec();
        let hole = square(1.0, 0.1, false).polygon.loops().next().unwrap().to_vec();
        let mut notched = outline.clone();
        notched.insert(1, DVec3::new(0.0, 0.0, 1.0));
        for rings in [vec![outline, hole], vec![notched]] {
            let patch = Patch { polygon: PlanarPolygon::new(rings).unwrap(), ..square(1.0, 1.0, true) };
            assert!(!is_hidden(&patch));
        }
    }
}
