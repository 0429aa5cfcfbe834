//! Slabs without width: parts of a vertical line, between two ends on it.
//!
//! Edges that are not vertical are in one point there. Where two of them meet, they do so in the next slab to the left or
//! right that has a width, at its side; so only vertical edges are compared, with one another and with all others.

use super::segments::{RankedSegment, Slab};
use super::{SlabDecomposition, order::Order};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort};
use std::{cmp::Ordering, ops::Range};

impl SlabDecomposition {
    /// Finds the pairs that may meet in a slab without width, of the edges passing from `base` on and others that start in it.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn look_into_column(
        &mut self,
        slab: Slab,
        base: usize,
        starts: Range<usize>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let mut column = std::mem::take(&mut self.column);
        column.clear();
        column.extend(self.passing[base..].iter().map(|passing| passing.segment).chain(self.edges(starts)));
        let is_vertical = |segment: &RankedSegment| self.is_column(segment.ranks);
        let count = column.iter().filter(|segment| is_vertical(segment)).count();
        meter.spend(column.len())?;
        if count > 0 {
            let key = |segment: &RankedSegment| (!is_vertical(segment), segment.ranks, segment.id);
            sort(&mut column, |a, b| key(a).cmp(&key(b)), meter)?;
        }
        self.column = column;
        if count == 0 {
            return Ok(());
        }
        self.sort_keys(slab, count, meter)?;
        (0..count).try_for_each(|i| {
            self.compare_vertical(i, count);
            self.found.check(meter)
        })
    }

    /// Sorts the edges from a place on by their heights in a slab; then exactly what heights do not tell apart, unless
    /// all that comes near is asked for.
    fn sort_keys(&mut self, slab: Slab, start: usize, meter: &Meter<'_>) -> Result<(), Refusal> {
        let mut keys = std::mem::take(&mut self.keys);
        keys.clear();
        keys.extend(self.column[start..].iter().zip(index(start)..).map(|(&segment, place)| {
            let rank = slab[0].clamp(segment.ranks[0], segment.ranks[1]);
            (self.clip(segment, [rank, segment.ranks[1]]).heights[0], place)
        }));
        let by_height = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        sort(&mut keys, by_height, meter)?;
        let order = self.order();
        if order.is_exact {
            for tied in keys.chunk_by_mut(|a, b| b.0 - a.0 <= order.slack).filter(|tied| tied.len() > 1) {
                let exactly = |a: &(f64, u32), b: &(f64, u32)| {
                    let [e, f] = [a, b].map(|key| self.column[key.1 as usize]);
                    let is_told = (a.0 - b.0).abs() > order.slack;
                    let by_sides = if is_told { Ordering::Equal } else { order.at(e, f, slab[0]) };
                    by_sides.then(by_height(a, b))
                };
                sort(tied, exactly, meter)?;
            }
        }
        self.keys = keys;
        Ok(())
    }

    /// Finds the vertical edges behind a vertical one, and the others, that it may meet.
    fn compare_vertical(&mut self, i: usize, others: usize) {
        let order = Order { ends: &self.ends, slack: self.slack, is_exact: self.reach == 0.0 };
        let SlabDecomposition { column, keys, found, slack, .. } = self;
        let segment = column[i];
        let ends = segment.ranks.map(|rank| (rank, order.ends[rank as usize].y));
        let to_end = |key: &(f64, u32), (rank, y): (u32, f64)| {
            let is_tied = (key.0 - y).abs() <= *slack;
            match (is_tied, order.is_exact) {
                (false, _) => key.0.total_cmp(&y),
                (true, false) => Ordering::Equal,
                (true, true) => order.to_point(column[key.1 as usize], rank),
            }
        };
        let upright = column[i + 1..others].iter().take_while(|other| other.ranks[0] < segment.ranks[1]);
        let first = keys.partition_point(|key| to_end(key, ends[0]).is_lt());
        let level = keys[first..].iter().take_while(|key| to_end(key, ends[1]).is_le());
        let level = level.map(|key| &column[key.1 as usize]);
        let level = level.filter(|other| other.ranks.iter().all(|rank| !segment.ranks.contains(rank)));
        found.add(upright.chain(level).map(|other| ([segment.id, other.id], true)), false);
    }
}
