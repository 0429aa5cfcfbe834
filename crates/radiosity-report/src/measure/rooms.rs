//! Closed rooms with boxes in them: every row of their matrices adds to 1.
use formfactor::{DVec3, Enclosure, PlanarPolygon};

/// A room: a cube of side 10 with n × n quads on each wall, and boxes of half-size 0.3 to 0.7 in it that touch nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosedRoom {
    pub(crate) tiles: u32,
    pub(crate) boxes: usize,
}

impl ClosedRoom {
    pub(crate) fn name(self) -> String {
        let surfaces = 6 * self.tiles as usize * self.tiles as usize + 6 * self.boxes;
        format!("a room of {surfaces} surfaces, {} boxes", self.boxes)
    }

    pub(crate) fn enclosure(self) -> Enclosure {
        let walls = sides([DVec3::ZERO, DVec3::splat(10.0)], self.tiles, false);
        let boxes = boxes(self.boxes);
        let boxes = boxes.iter().flat_map(|corners| sides(*corners, 1, true));
        Enclosure::new(walls.into_iter().chain(boxes).collect())
    }
}

/// What is left between boxes, and between them and the walls.
const GAP: f64 = 0.05;

/// The lowest and the highest corner of each box: of a sequence, those that lie apart from all before.
fn boxes(count: usize) -> Vec<[DVec3; 2]> {
    let mut boxes: Vec<[DVec3; 2]> = Vec::new();
    let corners = (1..).map(|index| {
        let [x, y, z, a, b, c] = spread(index);
        let half = 0.3 + 0.4 * DVec3::new(a, b, c);
        let middle = 1.0 + 8.0 * DVec3::new(x, y, z);
        [middle - half, middle + half]
    });
    for [low, high] in corners {
        if boxes.len() == count {
            break;
        }
        let is_apart = |other: &[DVec3; 2]| {
            let gaps = (low - other[1]).max(other[0] - high);
            gaps.max_element() > GAP
        };
        if boxes.iter().all(is_apart) {
            boxes.push([low, high]);
        }
    }
    boxes
}

/// Spread over the unit cube: the fractions of multiples of powers of the root of x^7 = x + 1 (after Roberts 2018).
fn spread(index: u32) -> [f64; 6] {
    const ROOT: f64 = 1.112_775_684_278_706;
    [1, 2, 3, 4, 5, 6].map(|power| (f64::from(index) * ROOT.powi(-power)).fract())
}

/// The six sides of a box, each in n × n rectangles, with their fronts outward or inward. Neighbours share the bits of their corners.
fn sides([low, high]: [DVec3; 2], n: u32, is_outward: bool) -> Vec<PlanarPolygon> {
    let at = |axis: usize, i: u32| {
        let share = f64::from(i) / f64::from(n);
        low[axis] * (1.0 - share) + high[axis] * share
    };
    let side = |(axis, end): (usize, u32)| {
        let [u, v] = if (end > 0) == is_outward { [1, 2] } else { [2, 1] }.map(|next| (axis + next) % 3);
        let corner = move |i: u32, j: u32| {
            let mut corner = DVec3::ZERO;
            (corner[axis], corner[u], corner[v]) = (at(axis, end), at(u, i), at(v, j));
            corner
        };
        let tiles = (0..n * n).map(|tile| (tile % n, tile / n));
        let ring = move |(i, j)| [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        tiles.map(ring).map(|ring| PlanarPolygon::new([ring]).expect("a rectangle"))
    };
    (0..3).flat_map(|axis| [(axis, 0), (axis, n)]).flat_map(side).collect()
}
