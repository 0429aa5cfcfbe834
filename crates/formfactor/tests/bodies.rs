//! Bodies that are not convex, open, inside out, crossing themselves or doubled: what an enclosure leaves out of them hides nothing. Each form
//! factor is that past all other polygons one by one, which knows of no bodies.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon, form_factor};
use proptest::prelude::*;

/// Cells to each side of a block of them.
const SIDE: usize = 3;

/// What is made of the cells' faces.
#[derive(Clone, Debug)]
struct Block {
    /// Which cells are full, a bit for each.
    cells: u32,
    /// Faces that are not there, that are turned inside out, and that are cut in two triangles.
    holes: Vec<usize>,
    turned: Vec<usize>,
    cut: Vec<usize>,
    /// Triangles between corners of cells, which may pass through everything.
    across: Vec<[usize; 3]>,
    /// The corners of cells are moved by so many eighths, along x by their height and along y by x.
    slant: [i32; 2],
}

impl Block {
    fn is_full(&self, [x, y, z]: [usize; 3]) -> bool {
        [x, y, z].iter().all(|at| (1..=SIDE).contains(at))
            && self.cells >> (x - 1 + SIDE * (y - 1 + SIDE * (z - 1))) & 1 == 1
    }

    fn corner(&self, number: usize) -> DVec3 {
        let count = SIDE + 1;
        let [x, y, z] = [number % count, number / count % count, number / count / count % count];
        let [x, y, z] = [x, y, z].map(|at| f64::from(u32::try_from(at).unwrap()));
        let [by_height, by_x] = self.slant.map(|eighths| f64::from(eighths) / 8.0);
        DVec3::new(x + by_height * z, y + by_x * x, z)
    }

    /// The faces between full cells and empty ones, fronts outward.
    fn squares(&self) -> Vec<[usize; 4]> {
        let range = || 0..=SIDE + 1;
        let cells = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
        let face = |cell: [usize; 3], axis: usize| {
            let mut next = cell;
            next[axis] += 1;
            let [here, there] = [cell, next].map(|cell| self.is_full(cell));
            // The corners of the face that the two cells share, counted from the first full layer.
            let corner = |u: usize, v: usize| {
                let mut at = next.map(|at| at.wrapping_sub(1));
                at[(axis + 1) % 3] += u;
                at[(axis + 2) % 3] += v;
                at[0] + (SIDE + 1) * (at[1] + (SIDE + 1) * at[2])
            };
            (here != there).then(|| {
                let square = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if here { square } else { [square[0], square[3], square[2], square[1]] }
            })
        };
        cells.flat_map(|cell| (0..3).filter_map(move |axis| face(cell, axis))).collect()
    }

    fn polygons(&self) -> Vec<PlanarPolygon> {
        let squares = self.squares();
        let count = squares.len().max(1);
        let has = |list: &[usize], index: usize| list.iter().any(|at| at % count == index);
        let mut loops: Vec<Vec<usize>> = Vec::new();
        for (index, square) in squares.into_iter().enumerate().filter(|(index, _)| !has(&self.holes, *index))
        {
            let [a, b, c, d] =
                if has(&self.turned, index) { [square[0], square[3], square[2], square[1]] } else { square };
            if has(&self.cut, index) {
                loops.extend([vec![a, b, c], vec![a, c, d]]);
            } else {
                loops.push(vec![a, b, c, d]);
            }
        }
        loops.extend(self.across.iter().map(|triangle| triangle.to_vec()));
        let polygon = |corners: &Vec<usize>| {
            PlanarPolygon::new([corners.iter().map(|corner| self.corner(*corner)).collect::<Vec<_>>()]).ok()
        };
        loops.iter().filter_map(polygon).collect()
    }
}

fn block() -> impl Strategy<Value = Block> {
    let some = |most: usize| prop::collection::vec(0usize..64, 0..=most);
    let across = prop::collection::vec(prop::array::uniform3(0usize..64), 0..3);
    let slant = prop_oneof![Just([0, 0]), prop::array::uniform2(-4..=4)];
    (0u32..1 << 27, 0u32..1 << 27, some(4), some(2), some(6), across, slant).prop_map(
        |(cells, others, holes, turned, cut, across, slant)| Block {
            cells: cells & others,
            holes,
            turned,
            cut,
            across,
            slant,
        },
    )
}

/// Where dA is: on a polygon, as many eighths along its first two sides, or at a place in eighths that may lie on anything.
type Place = (Option<(usize, [i32; 2])>, [i32; 3], [i32; 3]);

fn place() -> impl Strategy<Value = Place> {
    let on = prop::option::of((0usize..200, prop::array::uniform2(1i32..=3)));
    (on, prop::array::uniform3(-8i32..=32), prop::array::uniform3(-2i32..=2))
}

fn eighths(at: [i32; 3]) -> DVec3 {
    DVec3::from_array(at.map(|eighths| f64::from(eighths) / 8.0))
}

fn check(block: &Block, (on, at, normal): Place) -> Result<(), TestCaseError> {
    let polygons = block.polygons();
    prop_assume!(!polygons.is_empty() && normal != [0; 3]);
    let from = match on.map(|(index, at)| (index % polygons.len(), at)) {
        Some((owner, [u, v])) => {
            let corners = polygons[owner].loops().next().unwrap();
            let [u, v] = [u, v].map(|eighths| f64::from(eighths) / 8.0);
            let position = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
            DifferentialArea::new(position, polygons[owner].normal()).unwrap().owned_by(owner)
        }
        None => DifferentialArea::new(eighths(at), eighths(normal)).unwrap(),
    };
    compare(&polygons, &from)
}

/// The row of an enclosure, and the form factors past all others.
fn compare(polygons: &[PlanarPolygon], from: &DifferentialArea) -> Result<(), TestCaseError> {
    let row = Enclosure::new(polygons.to_vec()).row(from);
    for target in (0..polygons.len()).filter(|target| Some(*target) != from.owner()) {
        let is_other = |id: &usize| *id != target && Some(*id) != from.owner();
        let others: Vec<PlanarPolygon> =
            (0..polygons.len()).filter(is_other).map(|id| polygons[id].clone()).collect();
        let [found, wanted] = [row[target], form_factor(from, &polygons[target], &others)];
        let off = (found.value - wanted.value).abs();
        // An owner's neighbours in its plane, which rounding lifts, hide what it lifts above the horizon where nobody owns dA.
        let lifted = 1e-30;
        prop_assert!(
            off <= found.error_bound + wanted.error_bound + lifted,
            "{target}: {found:?} is not {wanted:?}"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn what_is_left_out_of_a_body_hides_nothing(block in block(), place in place()) {
        check(&block, place)?;
    }
}

/// A staircase of three steps: from before it as many faces are looked at as face dA, whether or not it stands open on the ground.
#[test]
fn of_a_body_that_is_not_convex_only_what_faces_da_is_looked_at() {
    let cells = [[1, 1, 1], [2, 1, 1], [3, 1, 1], [2, 1, 2], [3, 1, 2], [3, 1, 3]];
    let bit = |[x, y, z]: [usize; 3]| 1 << (x - 1 + SIDE * (y - 1 + SIDE * (z - 1)));
    let stairs = Block {
        cells: cells.map(bit).iter().sum(),
        holes: Vec::new(),
        turned: Vec::new(),
        cut: Vec::new(),
        across: Vec::new(),
        slant: [0; 2],
    };
    let wall = [[9.0, -9.0, 0.0], [9.0, -9.0, 9.0], [9.0, 9.0, 9.0], [9.0, 9.0, 0.0]];
    let wall = PlanarPolygon::new([wall]).unwrap();
    let from = DifferentialArea::new(DVec3::new(-4.0, -2.0, 0.25), DVec3::X).unwrap();
    let closed = stairs.polygons();
    let on_the_ground = closed.iter().filter(|face| face.normal() != DVec3::NEG_Z).cloned().collect();
    let faces_da =
        |face: &&PlanarPolygon| face.normal().dot(from.position() - face.loops().next().unwrap()[0]) > 0.0;
    // Three risers, and six squares of the side.
    assert_eq!(closed.iter().filter(faces_da).count(), 9);
    let hidden = form_factor(&from, &wall, &closed);
    for body in [closed, on_the_ground] {
        let scene = Enclosure::new([body, vec![wall.clone()]].concat());
        let (found, stats) = scene.form_factor_with_stats(&from, scene.polygons().len() - 1);
        assert_eq!(stats.looked_at, 9);
        assert!((found.value - hidden.value).abs() <= found.error_bound + hidden.error_bound);
    }
}

/// A body that crosses itself, drawn from the side: one loop winds around what is in it the other way than the other one, so that what hides
/// the board in there is a back with no front before it.
///
/// ```text
///    D           B
///    |\         /|
///    |b \     /  |
///    |    \ /    |      The sides A B and C D pass through each other.
///    |    / \    |
///    A  /     \  C
/// ```
#[test]
fn what_passes_through_a_face_counts() {
    let [a, b, c, d] = [[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 1.0]];
    let place = |[x, z]: [f64; 2], y: f64| DVec3::new(x, y, z);
    let side = |p, q| vec![place(p, -1.0), place(q, -1.0), place(q, 1.0), place(p, 1.0)];
    let end = |p, q, r, y| vec![place(p, y), place(q, y), place(r, y)];
    let outline = [side(a, b), side(b, c), side(c, d), side(d, a)];
    let ends = [end(c, b, a, -1.0), end(d, c, a, -1.0), end(a, b, c, 1.0), end(a, c, d, 1.0)];
    let board = [[0.1, -0.5], [0.1, 0.5], [0.4, 0.5], [0.4, -0.5]].map(|[x, y]| DVec3::new(x, y, 0.6));
    for is_turned in [false, true] {
        let turn = |points: &Vec<DVec3>| {
            let points: Vec<DVec3> =
                if is_turned { points.iter().rev().copied().collect() } else { points.clone() };
            PlanarPolygon::new([points]).unwrap()
        };
        let mut polygons: Vec<PlanarPolygon> = outline.iter().chain(&ends).map(turn).collect();
        polygons.push(PlanarPolygon::new([board]).unwrap());
        for (at, normal) in [([0.5, 0.0, -2.0], [0.0, 0.0, 1.0]), ([-2.0, 0.0, 0.5], [1.0, 0.0, 0.0])] {
            let from = DifferentialArea::new(DVec3::from(at), DVec3::from(normal)).unwrap();
            compare(&polygons, &from).unwrap();
        }
    }
}
