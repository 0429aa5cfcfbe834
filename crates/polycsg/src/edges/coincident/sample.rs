//! Whether many edges coincide, by the ends of all edges where they are few, and of those at some points where they are many.
//! The points are chosen by their digits, so that the order of the input, its scale and quarter turns do not matter.

use crate::base::meter::{Meter, Refusal};
use crate::base::parts::Numbered;
use crate::base::{hash::mixed, id::index, threads::Threads};
use crate::edges::Edges;
use glam::DVec2;

/// Fewer edges are not worth a look.
const FEW: usize = 16;

/// So many edges are all looked at.
const MANY: usize = 1024;

/// At so many points edges are looked at, and at one in so many at least.
const POINTS: usize = 32;
const RAREST: usize = 256;

/// It pays where one edge in so many coincides with another one.
const SHARE: usize = 16;

/// The buffers of the sample.
#[derive(Debug, Default)]
pub(super) struct EdgeSample {
    /// A set of keys by some of their bits.
    seen: Vec<u64>,
    keys: Vec<(u64, u32)>,
}

impl EdgeSample {
    /// Whether to look for the edges that coincide.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn pays(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<bool, Refusal> {
        match edges.len() {
            ..FEW => Ok(false),
            FEW..MANY => Ok(self.of_all(edges)),
            MANY.. => self.at_some_points(edges, meter),
        }
    }

    fn of_all(&mut self, edges: &Edges) -> bool {
        let words = edges.len().next_power_of_two();
        self.seen.clear();
        self.seen.resize(words, 0);
        let shift = 32 - (64 * words).ilog2();
        let mut coincide = 0;
        for ring in edges.rings() {
            let mut key = mixed(edges.point(ring.start));
            for &point in &edges.points()[ring.start as usize + 1..=ring.end as usize] {
                let next_key = mixed(point);
                let bit = (spread(key.wrapping_add(next_key)) >> shift) as usize;
                let word = &mut self.seen[bit / 64];
                coincide += usize::from(*word >> (bit % 64) & 1 == 1);
                *word |= 1 << (bit % 64);
                key = next_key;
            }
        }
        SHARE * coincide > edges.len()
    }

    fn at_some_points(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<bool, Refusal> {
        let shift = 64 - (edges.len() / POINTS).min(RAREST).ilog2();
        self.keys.clear();
        Threads::for_edges(edges.len()).list(edges.len(), &mut self.keys, |slots, keys| {
            let first = index(slots.start);
            meter.for_each(Numbered(&edges.points()[slots]), |(i, &p)| {
                if digits(p) >> shift == 0 && edges.is_vertex(first + i) {
                    keys.extend(edges.at(first + i).map(|edge| (key(edges, edge), edge)));
                }
            })
        })?;
        self.keys.sort_unstable();
        self.keys.dedup();
        let count = self.keys.len();
        self.keys.dedup_by_key(|&mut (key, _)| key);
        Ok(SHARE * (count - self.keys.len()) > count)
    }
}

/// A number made of the digits of a point's coordinates: not of their signs, exponents and order.
#[inline]
fn digits(p: DVec2) -> u64 {
    let of = |x: f64| {
        let product = (x.to_bits() & ((1 << 52) - 1)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        product ^ product >> 32
    };
    of(p.x).wrapping_add(of(p.y)).wrapping_mul(0xc4ce_b9fe_1a85_ec53)
}

/// Equal for edges with the same ends, and hardly ever for others.
fn key(edges: &Edges, edge: u32) -> u64 {
    let [a, b] = edges.segment(edge).map(mixed);
    a.wrapping_add(b)
}

/// A sum of two keys, spread over all bits.
#[inline]
fn spread(key: u64) -> u32 {
    (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as u32
}
