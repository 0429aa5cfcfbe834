//! The lines on a patch along which tiles are cut: light jumps where something else touches it.
use super::line_tree::LineTree;
use super::tile::Outline;
use crate::extent::Extent;
use crate::mesh::frame::Frame;
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};

/// What is small beside a patch is small beside the scene or, where that is less, beside so many times the patch.
const WIDE: f64 = 100.0;
/// Edges of other patches are contacts within this share of that.
const NEAR: f64 = 1e-9;
/// Parts that differ by less than this share are alike.
const ALIKE: f64 = 1e-6;
/// Of a contact that is inside an outline there is at least this share of the outline's long axis.
const LEAST: f64 = 1e-4;
/// An outline is cut along a contact of which at least this share is inside of what is of any other.
const MUCH: f64 = 0.5;

/// Where a patch is cut.
#[derive(Debug)]
pub(super) struct Base {
    pub(super) frame: Frame,
    /// What lengths on it are small beside.
    pub(super) scale: f64,
    pub(super) contacts: LineTree,
}

impl Base {
    /// Of a patch in a scene of some size; `contacts` finds the edges of others that touch it within a thousandth of a length.
    pub(super) fn of(
        polygon: &PlanarPolygon,
        size: f64,
        contacts: impl FnOnce(f64) -> Vec<[DVec3; 2]>,
    ) -> Base {
        let (frame, Extent { low, high }) = (Frame::new(polygon), Extent::around(polygon));
        let scale = size.min(WIDE * (high - low).length());
        let flat = |ends: [DVec3; 2]| ends.map(|end| frame.flatten(end));
        let contacts = LineTree::of(contacts(1e3 * NEAR * scale).into_iter().map(flat).collect());
        Base { frame, scale, contacts }
    }

    /// Of the contacts of which much is inside an outline, the one along which a cut leaves the smallest parts: a ground with many houses is cut in
    /// halves, not house by house.
    pub(super) fn contact_in(&self, outline: &Outline) -> Option<[DVec2; 2]> {
        let inside = self.inside(outline);
        let longest = inside.iter().map(|(length, _)| *length).fold(0.0, f64::max);
        let long = inside.iter().filter(|(length, _)| *length >= MUCH * longest);
        let parts = long.map(|(_, line)| (outline.diagonal_of_parts(*line), *line));
        parts.reduce(|a, b| if b.0 < (1.0 - ALIKE) * a.0 { b } else { a }).map(|(_, line)| line)
    }

    /// Whether a contact is inside an outline.
    pub(super) fn is_crossed(&self, outline: &Outline) -> bool {
        !self.inside(outline).is_empty()
    }

    /// The contacts in an outline, and how much of each is inside.
    fn inside(&self, outline: &Outline) -> Vec<(f64, [DVec2; 2])> {
        let near = self.contacts.near(outline).into_iter().map(|line| self.contacts.ends[line]);
        let inside = near.map(|line| (outline.within(line), line));
        inside.filter(|(length, _)| *length > LEAST * outline.axes[0].length()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::convex::PlacedCorner;
    use std::array;

    /// A ground under n × n houses of some width, from the first or the last on, cut until no part has any of a house's edges inside: the depth of each part.
    fn parts_of_a_ground(n: u32, width: impl Fn(u32) -> f64, is_reversed: bool) -> Vec<usize> {
        let end = f64::from(2 * n);
        let square = |[x, y]: [f64; 2], side: f64| -> [DVec3; 4] {
            let ways = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
            ways.map(|[u, v]| DVec3::new(x + u, y + v, 0.0))
        };
        let corners = square([0.0; 2], end);
        let house = |k: u32| square([k % n, k / n].map(|at| 2.0 * f64::from(at) + 0.5), width(k));
        let turn = |k: u32| if is_reversed { n * n - 1 - k } else { k };
        let edges = (0..n * n)
            .map(turn)
            .map(house)
            .flat_map(|c| array::from_fn::<_, 4, _>(|k| [c[k], c[(k + 1) % 4]]));
        let base = Base::of(&PlanarPolygon::new([corners]).unwrap(), end, |_| edges.collect());
        let placed = |place: DVec3| -> PlacedCorner { (base.frame.flatten(place), place) };
        let whole = Outline::new(corners.map(placed).to_vec()).unwrap();
        let (mut open, mut depths) = (vec![(0, whole)], Vec::new());
        while let Some((depth, outline)) = open.pop() {
            match base.contact_in(&outline) {
                None => depths.push(depth),
                Some([start, end]) => {
                    let halves = outline.cut([start, end - start], |flat| base.frame.lift(flat)).unwrap();
                    open.extend(halves.map(|half| (depth + 1, half)));
                }
            }
        }
        depths
    }

    #[test]
    fn a_ground_with_many_houses_is_cut_in_halves() {
        let widths: [fn(u32) -> f64; 2] = [|_| 1.0, |k| 0.6 + f64::from(k * 7919 % 97) / 120.0];
        for doublings in [2, 3, 4] {
            for (width, is_reversed) in widths.iter().flat_map(|width| [(width, false), (width, true)]) {
                let depths = parts_of_a_ground(1 << doublings, width, is_reversed);
                assert!(depths.len() > 1 << (2 * doublings));
                let deepest = depths.into_iter().max().unwrap();
                assert!(deepest <= 2 * (doublings + 2), "{deepest} of {doublings}");
            }
        }
    }
}
