//! The half-edges around each junction, by angle.

use super::{Arrangement, NONE, by_turn};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort};
use crate::contacts::contact::PartnerKind;
use crate::edges::Edges;
use crate::predicates::Compass;
use std::cmp::Ordering;

impl Arrangement {
    /// Lists the half-edges of each junction by angle, and unites those that leave it in one direction.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn gather(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.list_half_edges(edges, meter)?;
        self.representatives.clear();
        self.next.clear();
        let (mut around, mut leaving) = (std::mem::take(&mut self.around), std::mem::take(&mut self.leaving));
        let mut tally = meter.tally();
        for junction in 0..index(self.junction_count()) {
            let span = self.span(junction);
            let half_edges = &mut around[span.start as usize..span.end as usize];
            let compass = |half_edge: u32| Compass::of(self.direction(edges, half_edge));
            leaving.clear();
            leaving.extend(half_edges.iter().map(|&h| (compass(h) as u64) << 32 | u64::from(h)));
            tally.add(leaving.len())?;
            sort_by_compass(&mut leaving, half_edges, meter)?;
            let mut rest = half_edges;
            for alike in leaving.chunk_by(|g, h| g >> 32 == h >> 32) {
                let (half_edges, others) = rest.split_at_mut(alike.len());
                rest = others;
                if alike.len() > 1 {
                    self.sort_within(edges, half_edges, meter)?;
                }
            }
        }
        (self.around, self.leaving) = (around, leaving);
        Ok(())
    }

    /// Sorts half-edges that leave a junction alike by angle, and unites those that overlap.
    fn sort_within(
        &mut self,
        edges: &Edges,
        half_edges: &mut [u32],
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        if Compass::of(self.direction(edges, half_edges[0])).is_axis() {
            self.unite(half_edges);
            return Ok(());
        }
        let order = |g: u32, h: u32| by_turn(self.direction(edges, g), self.direction(edges, h));
        sort(half_edges, |&g, &h| order(g, h).then(g.cmp(&h)), meter)?;
        let mut rest = &*half_edges;
        while let [first, others @ ..] = rest {
            let order = |h: &u32| by_turn(self.direction(edges, *first), self.direction(edges, *h));
            let count = 1 + others.iter().take_while(|h| order(h) == Ordering::Equal).count();
            self.unite(&rest[..count]);
            rest = &rest[count..];
        }
        Ok(())
    }

    /// Lists the half-edges junction by junction; afterwards `starts[j]..starts[j + 1]` are those of junction j.
    fn list_half_edges(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        let mut around = std::mem::take(&mut self.around);
        around.clear();
        around.resize(self.starts.last().copied().unwrap_or(0) as usize, 0);
        meter.for_each(0..index(self.sub_edges.len()), |sub_edge| {
            if let [NONE, junction] = self.starting[self.node(sub_edge) as usize] {
                let previous = self.previous(edges, sub_edge);
                let kind = self.sub_edges[sub_edge as usize].partner.kind();
                let leaving = (kind != PartnerKind::End).then_some(2 * sub_edge);
                let arriving = (kind != PartnerKind::First).then_some(2 * previous + 1);
                for half_edge in leaving.into_iter().chain(arriving) {
                    let at = &mut self.starts[junction as usize + 1];
                    around[*at as usize] = half_edge;
                    *at += 1;
                }
            }
        })?;
        self.starts.pop();
        self.around = around;
        Ok(())
    }

    /// Links overlapping sub-edges, given by their half-edges in order; at their other ends it was or will be done alike.
    fn unite(&mut self, overlapping: &[u32]) {
        if self.next.is_empty() && overlapping.len() > 1 {
            self.representatives.extend(0..index(self.sub_edges.len()));
            self.next.resize(self.sub_edges.len(), NONE);
        }
        let representative = overlapping[0] >> 1;
        for pair in overlapping.windows(2) {
            let [sub_edge, next] = [pair[0] >> 1, pair[1] >> 1];
            self.next[sub_edge as usize] = next;
            self.representatives[next as usize] = representative;
        }
    }
}

/// Sorts half-edges behind their compasses, and lists them: a few by how many are before each, without branches.
#[expect(clippy::cast_possible_truncation, reason = "the lower half is the half-edge")]
fn sort_by_compass(leaving: &mut [u64], half_edges: &mut [u32], meter: &Meter<'_>) -> Result<(), Refusal> {
    const FEW: usize = 8;
    if leaving.len() <= FEW {
        let mut sorted = [0; FEW];
        for &half_edge in &*leaving {
            sorted[leaving.iter().filter(|&&other| other < half_edge).count()] = half_edge;
        }
        leaving.copy_from_slice(&sorted[..leaving.len()]);
    } else {
        sort(leaving, u64::cmp, meter)?;
    }
    half_edges.iter_mut().zip(leaving).for_each(|(half_edge, sorted)| *half_edge = *sorted as u32);
    Ok(())
}
