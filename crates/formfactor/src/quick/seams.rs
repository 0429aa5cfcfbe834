//! Seams: edges that two cones have, one on either side, as neighbours in a mesh do. All around a seam is hidden, so it bounds nothing.
//!
//! ```text
//!    _________
//!    \  / \  /     Of four triangles in a row only the outline may be visible. Where many cones are behind each other it is most
//!     \/___\/      of what has to be compared: what has seams only on all sides hides others, but has nothing to be hidden.
//! ```
use super::cone::{CornerId, OneCone};
use glam::DVec3;

/// The edges of cones.
#[derive(Debug, Default)]
pub(super) struct Seams {
    edges: Vec<SeamEdge>,
    /// For each a number that those of a seam share, and its place among them.
    alike: Vec<(u64, u32)>,
}

/// An edge between vertices as given, by its number.
#[derive(Clone, Copy, Debug)]
struct SeamEdge {
    number: usize,
    ends: [DVec3; 2],
}

impl Seams {
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.alike.clear();
    }

    /// Adds the edges of a cone, the first of which has a number.
    pub(super) fn push(&mut self, cone: OneCone, first: usize) {
        for index in 0..cone.edges.len() {
            if let [Some(start), Some(end)] = cone.ends(index).map(CornerId::given) {
                let place = u32::try_from(self.edges.len()).unwrap_or(u32::MAX);
                self.alike.push((mixed(start).wrapping_add(mixed(end)), place));
                self.edges.push(SeamEdge { number: first + index, ends: [start, end] });
            }
        }
    }

    /// Calls back with the numbers of all edges that run the other way in another cone.
    ///
    /// Takes O(n log n) for n edges.
    pub(super) fn for_each(&mut self, mut found: impl FnMut(usize)) {
        self.alike.sort_unstable();
        for alike in self.alike.chunk_by(|(one, _), (other, _)| one == other) {
            let edges = || alike.iter().map(|(_, place)| &self.edges[*place as usize]);
            for SeamEdge { number, ends: [start, end] } in edges() {
                if edges().any(|other| other.ends == [*end, *start]) {
                    found(*number);
                }
            }
        }
    }
}

/// A number that equal vertices have, and hardly any others.
fn mixed(vertex: DVec3) -> u64 {
    vertex.to_array().iter().fold(0, |sum: u64, coordinate| {
        (sum.rotate_left(29) ^ coordinate.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
    })
}
