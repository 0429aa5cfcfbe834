//! Polygons that share lines as those of buildings do: frames, steps and boards on a grid, whose edges run along each other in part, seen
//! from points in their planes. Doubles and polygon Booleans, which share no topology, have one value within their bounds.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::DQuat;
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon, by_hierarchy, form_factor, unoccluded};
use proptest::prelude::*;

/// A rectangle on a grid plane: the axis that it is perpendicular to, how far along, and its corners.
type Board = (usize, i32, [i32; 2], [i32; 2]);

/// A board, which of the shapes below it has, and how far it is off the grid.
type Thing = (Board, u8, [f64; 3]);

/// How a scene is turned and moved.
type Pose = (f64, [f64; 3], [f64; 3]);

fn board() -> impl Strategy<Value = Board> {
    (0usize..3, -3..4, prop::array::uniform2(-4..4), prop::array::uniform2(1..6))
}

fn pose() -> impl Strategy<Value = Pose> {
    let moved = prop::array::uniform3(-1e3..1e3);
    prop_oneof![
        Just((0.0, [0.0, 0.0, 1.0], [0.0; 3])),
        (0.0..6.0, prop::array::uniform3(-1.0..1.0), moved),
        (0.0..6.0, Just([0.0, 0.0, 1.0]), Just([0.0; 3])),
    ]
}

/// Nothing, or about as much as roundings are, or a little more.
fn nudge() -> impl Strategy<Value = [f64; 3]> {
    let size =
        prop_oneof![4 => Just(0.0), 1 => Just(1e-15), 1 => Just(3e-14), 1 => Just(1e-12), 1 => Just(1e-10)];
    (size, prop::array::uniform3(-1.0..1.0)).prop_map(|(size, way)| way.map(|way| way * size))
}

/// A board; with a hole if it is large enough, or a corner cut out of it.
fn loops(((_, _, low, size), shape, [_, across, up]): Thing) -> Vec<Vec<[f64; 2]>> {
    let [x, y] = [f64::from(low[0]) + across, f64::from(low[1]) + up];
    let [w, h] = size.map(f64::from);
    let outer = vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
    let hole =
        vec![[x + 1.0, y + 1.0], [x + w - 1.0, y + 1.0], [x + w - 1.0, y + h - 1.0], [x + 1.0, y + h - 1.0]];
    match shape {
        0 if w > 2.0 && h > 2.0 => vec![outer, hole],
        1 if w > 1.0 && h > 1.0 => {
            vec![vec![[x, y], [x + w, y], [x + w, y + 1.0], [x + 1.0, y + 1.0], [x + 1.0, y + h], [x, y + h]]]
        }
        _ => vec![outer],
    }
}

fn placed(thing: Thing, (angle, axis, moved): Pose) -> Option<PlanarPolygon> {
    let (normal, height) = (thing.0.0, f64::from(thing.0.1) + thing.2[0]);
    let turn = DQuat::from_axis_angle(DVec3::from(axis).try_normalize()?, angle);
    let place = |[u, v]: [f64; 2]| {
        let mut point = [0.0; 3];
        (point[normal], point[(normal + 1) % 3], point[(normal + 2) % 3]) = (height, u, v);
        turn * DVec3::from(point) + DVec3::from(moved)
    };
    let loops: Vec<Vec<DVec3>> =
        loops(thing).iter().map(|ring| ring.iter().map(|p| place(*p)).collect()).collect();
    PlanarPolygon::new(loops).ok()
}

fn scene() -> impl Strategy<Value = (Pose, Vec<Thing>, [i32; 3], usize, bool)> {
    let things = prop::collection::vec((board(), 0u8..4, nudge()), 2..14);
    (pose(), things, prop::array::uniform3(-6..7), 0usize..3, any::<bool>())
}

/// Compares both ways.
fn compare(
    (pose, things, at, axis, is_half): (Pose, Vec<Thing>, [i32; 3], usize, bool),
) -> Result<(), TestCaseError> {
    let polygons: Vec<PlanarPolygon> = things.iter().filter_map(|thing| placed(*thing, pose)).collect();
    let (angle, way, moved) = pose;
    let turn = DVec3::from(way).try_normalize().map(|way| DQuat::from_axis_angle(way, angle));
    let (Some(turn), Some((target, others))) = (turn, polygons.split_first()) else {
        return Ok(());
    };
    let at = DVec3::from(at.map(|c| f64::from(c) / if is_half { 2.0 } else { 1.0 }));
    let normal = turn * DVec3::AXES[axis];
    let from = DifferentialArea::new(turn * at + DVec3::from(moved), normal).unwrap();
    agree(&from, target, others)
}

fn agree(
    from: &DifferentialArea,
    target: &PlanarPolygon,
    others: &[PlanarPolygon],
) -> Result<(), TestCaseError> {
    let exact = by_hierarchy(from, target, others);
    let scene = Enclosure::new([std::slice::from_ref(target), others].concat());
    let (found, stats) = scene.form_factor_with_stats(from, 0);
    let [rough, fine] = [ROUGH, FINE].map(|within| scene.form_factor_within(from, 0, target, within));
    for found in [found, rough, fine] {
        let off = (found.value - exact.value).abs();
        prop_assert!(
            off <= found.error_bound + exact.error_bound,
            "{found:?} is not {exact:?} by {off}; {stats:?}"
        );
    }
    prop_assert!(rough.error_bound <= f64::max(ROUGH, found.error_bound), "{rough:?} {found:?}");
    // Close to the target's plane, rounding the vertices of what is visible turns the boundary by more.
    let corner = target.loops().flatten().next().copied().unwrap_or_default();
    if target.normal().dot(from.position() - corner) > 1e-2 {
        let boundary = scene.visible_boundary(from, 0, target);
        let summed = boundary.iter().map(|arc| lambert(from, arc)).sum::<f64>();
        prop_assert!(
            (summed - exact.value).abs() <= 2.0 * ROUGH + exact.error_bound,
            "{summed} along the boundary, not {exact:?}"
        );
    }
    Ok(())
}

/// A term of Lambert's sum.
fn lambert(from: &DifferentialArea, [a, b]: &[DVec3; 2]) -> f64 {
    let normal = b.cross(*a);
    let tilt = normal.try_normalize().map_or(0.0, |normal| normal.dot(from.normal()));
    normal.length().atan2(a.dot(*b)) * tilt / std::f64::consts::TAU
}

/// A point of a line through two of a few points: which two, and how far along in quarters.
type OnLine = (usize, usize, i32);

/// The corners of a triangle, and how far each is moved.
type Slanted = ([OnLine; 3], f64);

fn on_line() -> impl Strategy<Value = OnLine> {
    (0usize..5, 0usize..5, -4..9)
}

/// A few points, triangles with corners on lines through them, which rounding puts beside these, and where dA is.
fn slanted() -> impl Strategy<Value = ([[f64; 3]; 5], Vec<Slanted>, OnLine, [f64; 3])> {
    let points = prop::array::uniform5(prop::array::uniform3(-3.0..3.0));
    let size = prop_oneof![4 => Just(0.0), 1 => Just(1e-15), 1 => Just(3e-14), 1 => Just(1e-12)];
    let triangles = prop::collection::vec((prop::array::uniform3(on_line()), size), 2..12);
    (points, triangles, on_line(), prop::array::uniform3(-1.0..1.0))
}

/// Compares both ways.
fn compare_slanted(
    points: [[f64; 3]; 5],
    triangles: &[Slanted],
    at: OnLine,
    normal: [f64; 3],
) -> Result<(), TestCaseError> {
    let points = points.map(DVec3::from);
    let place = |(one, other, quarters): OnLine| {
        points[one] + (points[other] - points[one]) * (f64::from(quarters) / 4.0)
    };
    let triangle = |(corners, moved): &Slanted| {
        let off = |corner: OnLine| place(corner) + DVec3::new(1.0, -0.6, 0.3) * (moved * f64::from(corner.2));
        PlanarPolygon::new([corners.map(off)]).ok()
    };
    let polygons: Vec<PlanarPolygon> = triangles.iter().filter_map(triangle).collect();
    let from = DifferentialArea::new(place(at), DVec3::from(normal));
    if let (Ok(from), Some((target, others))) = (from, polygons.split_first()) {
        return agree(&from, target, others);
    }
    Ok(())
}

/// What will do for some, and for others.
const ROUGH: f64 = 1e-9;
const FINE: f64 = 1e-11;

/// On the grid.
const ON: [f64; 3] = [0.0; 3];

/// What clipping leaves of a frame at the target's plane has an edge of one rounding, whose plane leads anywhere.
#[test]
fn a_frame_that_ends_at_the_targets_plane() {
    let pose = (2.088_747_791_939_261, [0.0, 0.0, 1.0], [0.0; 3]);
    let things = vec![((0, -3, [0, 2], [5, 1]), 0, ON), ((1, 1, [-2, -3], [5, 3]), 0, ON)];
    compare((pose, things, [5, -2, -3], 2, false)).unwrap();
}

/// Of the target a sliver of some roundings is above the horizon; to take its edge for the occluder's would turn it over.
#[test]
fn a_target_that_ends_at_the_horizon() {
    let axis = [-0.087_581_645_451_194_19, -0.452_038_266_789_703_55, -0.445_737_502_565_118_3];
    let pose = (3.399_987_406_062_801, axis, [0.0, 0.0, -88.699_585_741_950_33]);
    let things = vec![((2, -2, [0, 1], [3, 3]), 2, ON), ((2, 0, [-3, 1], [5, 3]), 2, ON)];
    compare((pose, things, [3, 4, 3], 1, false)).unwrap();
}

/// All edges of the occluder lie at the horizon but for roundings, as the target's lower one does; one of them is a little further off.
#[test]
fn a_point_within_roundings_of_a_board() {
    let pose = (1.745_874_482_673_570_4, [0.0, 0.0, 1.0], [0.0; 3]);
    let target = ((1, -1, [2, -1], [1, 1]), 0, [0.0, 6.310_468_052_618_088e-11, 6.125_714_538_050_427e-11]);
    let board = ((0, 0, [-1, -2], [1, 4]), 0, [1.122_428_320_580_509_2e-14, 0.0, 0.0]);
    compare((pose, vec![target, board], [0, -1, 0], 0, true)).unwrap();
}

/// One edge lies along the target's and along another occluder's, which is clearly inside of the target's, but by a trillionth.
#[test]
fn three_slanted_edges_that_are_nearly_one() {
    let points = [
        [-2.546_709_171_718_676, -1.381_623_028_895_733_6, 0.0],
        [-0.887_129_099_006_848, 0.0, 0.824_139_551_253_509_8],
        [0.0; 3],
        [2.589_217_384_820_243_3, -1.495_230_254_441_000_3, 2.275_410_381_447_365],
        [0.0, 0.0, 1.942_958_720_401_273_7],
    ];
    let triangles = [
        ([(0, 0, 0), (0, 2, 1), (1, 3, 0)], 0.0),
        ([(1, 0, 1), (3, 1, -2), (0, 2, 1)], 0.0),
        ([(0, 0, 0), (3, 1, -1), (0, 1, 1)], 0.0),
        ([(0, 3, 1), (2, 0, 0), (1, 0, 1)], 1e-12),
        ([(1, 0, 0), (0, 0, -1), (0, 2, 0)], 1e-15),
    ];
    compare_slanted(points, &triangles, (3, 0, 0), [0.0, 0.0, -1.0]).unwrap();
}

/// The target's edge meets one of two that count as one at so small an angle that it would meet the other one elsewhere.
#[test]
fn an_edge_that_meets_two_that_count_as_one() {
    let points = [
        [0.738_450_824_418_293_2, 1.001_122_278_478_265_8, -1.015_805_753_001_476_1],
        [0.374_651_485_135_021_8, 2.753_216_406_556_782, 0.470_706_765_141_580_7],
        [-1.037_799_467_064_887_1, -1.943_759_050_996_730_4, -2.715_848_728_720_225],
        [1.026_914_589_566_196_9, 0.0, 0.772_704_115_338_334_2],
        [1.016_321_608_417_13, 2.579_140_309_959_725_7, 0.121_411_905_511_605_18],
    ];
    let triangles = [
        ([(4, 4, 0), (3, 1, -1), (2, 1, 6)], 0.0),
        ([(4, 2, 3), (4, 0, -4), (0, 2, 0)], 3e-14),
        ([(0, 2, 1), (2, 4, 4), (0, 4, 5)], 0.0),
    ];
    compare_slanted(points, &triangles, (3, 0, 1), [1.0, 0.0, 0.0]).unwrap();
}

/// The point is off the occluder, over which it lies, by 5e-18, and a vertex of that is a last bit off one of the target: both are rounded to
/// one place as seen from the point, so that the occluder seemed to touch the target's side from outside. It hides all of it.
#[test]
fn a_vertex_a_last_bit_off_the_targets() {
    let points = [
        [0.0, 1.239_612_513_429_305_5, 0.0],
        [-0.257_801_070_808_344_6, 0.770_554_917_219_021_6, -0.841_855_977_158_455_4],
        [-1.990_719_486_697_143, 1.973_032_812_021_548, 0.0],
        [0.193_025_923_356_414_36, 0.0, 1.714_343_871_646_337],
        [-0.564_625_568_773_027_8, 1.533_370_457_845_986, 1.104_090_348_579_764],
    ];
    let triangles = [([(2, 0, 0), (4, 4, 0), (3, 0, 0)], 0.0), ([(1, 3, 4), (3, 4, 1), (3, 1, 7)], 0.0)];
    compare_slanted(points, &triangles, (1, 1, 0), [0.0, 0.0, 1.0]).unwrap();
}

/// Almost all of the target is below the horizon. Where its edges are cut, doubles say by how much the places of the cuts may be off; where they
/// did not, 2e-18 was found of 6e-20.
#[test]
fn a_target_of_which_almost_nothing_rises() {
    let triangle = |corners: [[f64; 3]; 3]| PlanarPolygon::new([corners.map(DVec3::from)]).unwrap();
    let target = triangle([[-1.0, 1.0, -3.0], [0.0, 0.0, 2.0], [-2.0, -1.0, 1.0]]);
    let occluder = triangle([[0.0, 0.0, 0.0], [-1.0, -2.0, 1.0], [0.0, 0.0, -1.0]]);
    for halvings in 20..60 {
        let position = DVec3::new(-1.5, -1.5, 1.0) + 0.5_f64.powi(halvings);
        let from = DifferentialArea::new(position, DVec3::new(-2.0, -2.0, 2.0)).unwrap();
        let seen = form_factor(&from, &target, std::slice::from_ref(&occluder));
        let alone = unoccluded(&from, &target);
        assert!(
            (seen.value - alone.value).abs() <= seen.error_bound + alone.error_bound,
            "{seen:?}, {alone:?}"
        );
    }
}

/// Boards in rows leave the target in more pieces than it pays to keep.
#[test]
fn a_crowd_of_boards() {
    for size in [1.0, 1e-50, 1e50] {
        crowd(size);
    }
}

fn crowd(size: f64) {
    let square = |corner: DVec3, [u, v]: [DVec3; 2]| {
        PlanarPolygon::new([[corner, corner + u, corner + u + v, corner + v].map(|p| p * size)]).unwrap()
    };
    let target = square(DVec3::new(-2.0, -2.0, 2.0), [DVec3::Y * 4.0, DVec3::X * 4.0]);
    let place =
        |index: i32| DVec3::new(f64::from(index % 20), f64::from(index / 20), 0.0) * 0.1 - DVec3::splat(1.0);
    let board = |index| square(place(index) + DVec3::Z * 2.0, [DVec3::X * 0.05, DVec3::Y * 0.07]);
    let from = DifferentialArea::new(DVec3::new(0.01, 0.02, 0.0) * size, DVec3::new(0.1, 0.2, 1.0)).unwrap();
    for count in [1, 20, 100, 400] {
        agree(&from, &target, &(0..count).map(board).collect::<Vec<_>>()).unwrap();
    }
}

/// The board is cut at the target's plane, where its place is rounded by 5e-6 of dA's height over it.
#[test]
fn a_board_that_is_cut_where_da_is_close_to_the_target() {
    let nudge = [-9.109473673732843e-11, 9.52018747843351e-11, 7.067630970427351e-11];
    let things = vec![((1, 2, [3, 1], [1, 5]), 0, nudge), ((2, 3, [0, 0], [2, 4]), 2, [0.0; 3])];
    compare(((0.0, [0.0, 0.0, 1.0], [0.0; 3]), things, [0, 4, 0], 2, true)).unwrap();
}

#[test]
fn a_board_with_a_corner_cut_out_that_ends_at_the_targets_plane() {
    let things = vec![
        ((1, -3, [0, 0], [1, 3]), 0, [0.0; 3]),
        ((0, 2, [-3, 0], [4, 2]), 1, [0.0, -6.0506946833738205e-16, 0.0]),
    ];
    compare(((0.0, [0.0, 0.0, 1.0], [0.0; 3]), things, [0, 0, -4], 2, false)).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5_000))]

    #[test]
    fn doubles_agree_with_booleans_where_edges_run_along_each_other(scene in scene()) {
        compare(scene)?;
    }
    #[test]
    fn doubles_agree_with_booleans_on_slanted_lines((points, triangles, at, normal) in slanted()) {
        compare_slanted(points, &triangles, at, normal)?;
    }
}
