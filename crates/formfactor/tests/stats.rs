//! What is counted: what was left out, and why.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon, Stats};

/// A square about the axis at some height, seen from below from its front.
fn square(half: f64, height: f64) -> PlanarPolygon {
    moved(half, DVec3::Z * height)
}

fn moved(half: f64, middle: DVec3) -> PlanarPolygon {
    let corners = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
    PlanarPolygon::new([corners.map(|[x, y]| middle + half * DVec3::new(x, y, 0.0))]).unwrap()
}

fn stats(occluders: Vec<PlanarPolygon>) -> Stats {
    let polygons = [vec![square(1.0, 2.0)], occluders].concat();
    let from = DifferentialArea::new(DVec3::new(0.05, 0.02, 0.0), DVec3::Z).unwrap();
    Enclosure::new(polygons).form_factor_with_stats(&from, 0).1
}

#[test]
fn nothing_in_between_is_none() {
    let stats = stats(vec![]);
    assert_eq!((stats.none, stats.partial, stats.total, stats.looked_at), (1, 0, 0, 0));
}

#[test]
fn what_is_elsewhere_is_not_looked_at_or_culled() {
    // Beside, behind, below the horizon, and edge-on.
    let aside =
        vec![moved(0.1, DVec3::new(9.0, 0.0, 1.0)), square(3.0, 3.0), square(3.0, -1.0), square(3.0, 0.0)];
    let stats = stats(aside);
    assert_eq!((stats.none, stats.partial, stats.culled), (1, 0, stats.looked_at));
}

#[test]
fn one_that_covers_is_total() {
    let stats = stats(vec![square(0.6, 1.0)]);
    assert_eq!((stats.total, stats.partial, stats.csg_edges), (1, 0, 0));
}

#[test]
fn convex_occluders_need_no_csg() {
    let stats = stats(vec![square(0.2, 1.0), moved(0.2, DVec3::new(0.17, 0.13, 0.9))]);
    assert_eq!((stats.partial, stats.traced, stats.csg_edges), (1, 1, 0));
}

#[test]
fn a_frame_needs_no_csg() {
    let corners =
        |half: f64| [[-half, half, 1.0], [half, half, 1.0], [half, -half, 1.0], [-half, -half, 1.0]];
    let frame = PlanarPolygon::new([corners(0.4), corners(0.2)]).unwrap();
    let stats = stats(vec![frame]);
    assert_eq!((stats.partial, stats.traced, stats.csg_edges), (1, 1, 0));
}

#[test]
fn loops_that_cross_need_csg() {
    let turned = [[-0.3, 0.3, 1.0], [0.4, 0.3, 1.0], [0.4, -0.3, 1.0], [-0.3, -0.3, 1.0]];
    let other = [[-0.4, 0.2, 1.0], [0.3, 0.2, 1.0], [0.3, -0.2, 1.0], [-0.4, -0.2, 1.0]];
    let stats = stats(vec![PlanarPolygon::new([turned, other]).unwrap()]);
    assert_eq!((stats.partial, stats.traced), (1, 0));
    assert!(stats.csg_edges >= 12);
}

#[test]
fn what_passes_through_the_targets_plane_is_clipped() {
    let board =
        PlanarPolygon::new([[[0.1, -0.3, 1.0], [0.1, 0.4, 1.0], [0.3, 0.4, 3.0], [0.3, -0.3, 3.0]]]).unwrap();
    let stats = stats(vec![board]);
    assert_eq!((stats.partial, stats.clipped), (1, 1));
}

#[test]
fn counts_add_up() {
    let (a, b) = (stats(vec![square(0.2, 1.0)]), stats(vec![square(0.6, 1.0)]));
    let sum: Stats = [a, b].into_iter().sum();
    assert_eq!((sum.partial, sum.total, sum.looked_at), (1, 1, a.looked_at + b.looked_at));
    assert_eq!(sum, a + b);
}

/// The faces of a box, fronts outward.
fn cuboid(low: DVec3, high: DVec3) -> Vec<PlanarPolygon> {
    let corner = |i: usize| {
        let pick = |bit: usize, axis: usize| if i & bit == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2))
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().map(|face| PlanarPolygon::new([face.map(corner)]).unwrap()).collect()
}

#[test]
fn of_a_closed_body_only_the_near_side_is_looked_at() {
    let solid = cuboid(DVec3::new(-0.3, -0.2, 0.8), DVec3::new(-0.1, 0.1, 1.2));
    // dA sees its underside and one of its sides.
    let near: Vec<PlanarPolygon> = [0, 5].map(|i| solid[i].clone()).to_vec();
    let polygons =
        |occluders: Vec<PlanarPolygon>| Enclosure::new([vec![square(1.0, 2.0)], occluders].concat());
    let from = DifferentialArea::new(DVec3::new(0.05, 0.02, 0.0), DVec3::Z).unwrap();
    let (whole, stats) = polygons(solid.clone()).form_factor_with_stats(&from, 0);
    let (silhouette, near) = polygons(near).form_factor_with_stats(&from, 0);
    assert_eq!(whole, silhouette);
    assert_eq!((stats.looked_at, stats.csg_edges, near.looked_at), (2, 0, 2));
    // Through a hole that faces dA the far side is seen, so that it counts. One that faces away changes nothing.
    let open = polygons(solid[..5].to_vec()).form_factor_with_stats(&from, 0);
    assert_eq!(open.1.looked_at, 5);
    let (behind, stats) =
        polygons(solid[..1].iter().chain(&solid[2..]).cloned().collect()).form_factor_with_stats(&from, 0);
    assert_eq!((behind, stats.looked_at), (whole, 2));
}

#[test]
fn a_face_of_a_closed_body_is_not_looked_for_behind_the_others() {
    let solid = cuboid(DVec3::new(0.3, -0.2, 0.8), DVec3::new(0.6, 0.1, 1.2));
    let from = DifferentialArea::new(DVec3::new(0.05, 0.02, 0.0), DVec3::Z).unwrap();
    let board = moved(0.05, DVec3::new(0.2, 0.0, 0.5));
    let room = |solid: &[PlanarPolygon]| Enclosure::new([solid, std::slice::from_ref(&board)].concat());
    for face in 0..solid.len() {
        let (closed, stats) = room(&solid).form_factor_with_stats(&from, face);
        // With a hole in it that faces away, still no more is looked at than what faces dA.
        let mut open = solid.clone();
        open.swap_remove(if face == 5 { 4 } else { 5 });
        let (alone, all) = room(&open).form_factor_with_stats(&from, face.min(4));
        assert_eq!(closed, alone);
        let is_seen = all.looked_at > 0;
        assert_eq!(stats.looked_at, u64::from(is_seen), "the board alone");
        assert_eq!(all.looked_at, if is_seen { 2 } else { 0 }, "the board and the other side that dA sees");
    }
    // It sees the underside and one side.
    let seen = (0..6).filter(|face| room(&solid).form_factor(&from, *face).value > 0.0).count();
    assert_eq!(seen, 2);
}

#[test]
fn from_inside_a_body_its_walls_hide() {
    let solid = cuboid(DVec3::new(-0.3, -0.2, -0.5), DVec3::new(0.3, 0.3, 1.2));
    let from = DifferentialArea::new(DVec3::new(0.05, 0.02, 0.0), DVec3::Z).unwrap();
    let polygons = [vec![square(1.0, 2.0)], solid].concat();
    assert_eq!(Enclosure::new(polygons).form_factor(&from, 0).value, 0.0);
}

#[test]
fn a_body_on_a_slope_hides_all_from_what_it_stands_on() {
    // The slope z = x / 3, a prism on it, and a ceiling. Points of the slope are rounded to either side of it.
    let polygon = |corners: [[f64; 3]; 4]| PlanarPolygon::new([corners]).unwrap();
    let slope = polygon([[0.0, 0.0, 0.0], [3.0, 0.0, 1.0], [3.0, 3.0, 1.0], [0.0, 3.0, 0.0]]);
    let ceiling = polygon([[0.0, 0.0, 5.0], [0.0, 3.0, 5.0], [3.0, 3.0, 5.0], [3.0, 0.0, 5.0]]);
    let (low, high) = (0.75, 2.25);
    let base = [[low, low, 0.25], [high, low, 0.75], [high, high, 0.75], [low, high, 0.25]];
    let top = base.map(|[x, y, _]| [x, y, 2.0]);
    let [a, b, c, d] = base;
    let mut polygons = vec![slope, ceiling, polygon([d, c, b, a]), polygon(top)];
    polygons.extend((0..4).map(|i| polygon([base[i], base[(i + 1) % 4], top[(i + 1) % 4], top[i]])));
    let room = Enclosure::new(polygons);
    let seen = |x: f64| {
        let normal = DVec3::new(-1.0, 0.0, 3.0);
        let from = DifferentialArea::new(DVec3::new(x, 1.3, x / 3.0), normal).unwrap().owned_by(0);
        let alone = room.form_factor(&from, 1).value;
        assert_eq!(alone, room.form_factors(&[from], 1)[0].value);
        alone
    };
    for i in 0..100u32 {
        assert_eq!(seen(0.8 + 0.014 * f64::from(i)), 0.0);
        assert!(seen(2.3 + 0.005 * f64::from(i)) > 0.0);
    }
}

/// Planes through dA and the edges of a square that it hardly rises above are almost the square's own: walls on both sides of that pass through
/// all of them.
#[test]
fn what_stands_beside_a_target_is_not_looked_at_where_it_is_seen_at_a_grazing_angle() {
    let square =
        PlanarPolygon::new([[[3.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 1.0, 0.0], [3.0, 1.0, 0.0]]]).unwrap();
    let wall = |k: u32| {
        let y = 2.0 + 0.5 * f64::from(k / 2);
        let y = if k % 2 == 0 { y } else { -y };
        let corners = [[1.0, y, -1.0], [5.0, y, -1.0], [5.0, y + 0.2, 1.0], [1.0, y + 0.2, 1.0]];
        PlanarPolygon::new([corners]).unwrap()
    };
    // One that doubles decide, and one whose loops cross each other.
    let standing =
        |[y, z]: [[f64; 2]; 2]| [[2.0, y[0], z[0]], [2.0, y[1], z[0]], [2.0, y[1], z[1]], [2.0, y[0], z[1]]];
    let plain = PlanarPolygon::new([standing([[0.4, 1.5], [-1.0, 1.0]])]).unwrap();
    let crossing =
        PlanarPolygon::new([standing([[0.4, 1.5], [-1.0, 1.0]]), standing([[0.3, 0.6], [-0.9, 1.1]])])
            .unwrap();
    for (above, board) in
        [1e-3, 1e-6, 1e-9].into_iter().flat_map(|above| [(above, &plain), (above, &crossing)])
    {
        let from = DifferentialArea::new(DVec3::new(0.0, 0.5, above), DVec3::X).unwrap();
        let [few, many] = [4, 400].map(|count| {
            let polygons = [&square, board].into_iter().cloned().chain((0..count).map(wall));
            Enclosure::new(polygons.collect()).form_factor_with_stats(&from, 0)
        });
        assert_eq!(few.0, many.0);
        // The exact route takes what is in one leaf of the tree.
        let is_exact = board.loops().count() > 1;
        let most = if is_exact { 4 } else { 1 };
        assert!(few.0.value > 0.0 && many.1.looked_at <= most, "{above}: {}", many.1.looked_at);
        assert_eq!(many.1.csg_edges > 0, is_exact);
    }
}
