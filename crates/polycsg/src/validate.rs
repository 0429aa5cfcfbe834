//! Checks the promises of a region, exactly.

use crate::base::{id::index, meter::Meter};
use crate::predicates::{Segment, Side, is_inside, side};
use crate::region::{Invalid, Region, rings::ring_edges};
use crate::spatial::slabs::SlabDecomposition;

impl Region {
    /// Checks the promises of this type, exactly, wherever the value comes from. Expected O(n log n).
    ///
    /// # Errors
    /// [`Invalid`] names the first broken promise.
    pub fn validate(&self) -> Result<(), Invalid> {
        let edges: Vec<Segment> = self.rings().flat_map(ring_edges).collect();
        let (mut slabs, meter) = (SlabDecomposition::default(), Meter::default());
        let numbered = (0..index(edges.len())).map(|edge| (edge, [2 * edge, 2 * edge + 1]));
        slabs.build(edges.iter().flatten().copied(), numbered, &meter).expect("no limit was given");
        let contact =
            |[i, j]: [u32; 2]| Invalid::Contact { edge: i.min(j) as usize, other: i.max(j) as usize };
        // An edge without length lies in the end of the one before it or behind it.
        let is_empty = |edge: u32| edges[edge as usize][0] == edges[edge as usize][1];
        let meets_next =
            |&[i, j]: &[u32; 2]| edges[i as usize][1] == edges[j as usize][0] && (is_empty(i) || is_empty(j));
        let neighbours = (1..index(edges.len())).map(|j| [j - 1, j]);
        let mut found = neighbours.into_iter().find(meets_next).map(contact);
        found = found.or_else(|| slabs.duplicates().next().map(contact));
        let note = |i, j| {
            if found.is_none() && meet_wrongly(edges[i as usize], edges[j as usize]) {
                found = Some(contact([i, j]));
            }
        };
        slabs.pairs(&meter, note).expect("no limit was given");
        if let Some(contact) = found {
            return Err(contact);
        }
        // Without contacts nothing can be cut or rounded: evaluation can only find another structure.
        if self.evaluated_again() == *self { Ok(()) } else { Err(Invalid::Structure) }
    }
}

/// Whether two edges have any point in common but one end of each.
fn meet_wrongly(s: Segment, t: Segment) -> bool {
    let sides =
        [side(s[0], s[1], t[0]), side(s[0], s[1], t[1]), side(t[0], t[1], s[0]), side(t[0], t[1], s[1])];
    let common_ends = t.iter().filter(|p| s.contains(p)).count();
    let touches = [(s, t[0]), (s, t[1]), (t, s[0]), (t, s[1])]
        .into_iter()
        .zip(sides)
        .any(|((edge, p), side)| side == Side::On && is_inside(edge, p));
    let crosses = !sides.contains(&Side::On) && sides[0] != sides[1] && sides[2] != sides[3];
    common_ends == 2 || touches || crosses
}
