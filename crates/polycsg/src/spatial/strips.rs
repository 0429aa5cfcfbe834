//! An index over boxes: vertical strips, each with its boxes sorted by their lower sides.
//!
//! ```text
//!   strip 0   strip 1   strip 2          A box stands in each strip that it touches.
//!  |  ┌────┐ |         |         |       Two boxes that overlap are reported in one strip only:
//!  |  │ ┌──┼─┼───┐     |         |       that of the larger of their left sides.
//!  |  └─┼──┘ |   │  ┌──┼───┐     |
//!  |    └────┼───┘  └──┼───┘     |
//! ```
//!
//! Coordinates are mapped to 31-bit integers by one weakly monotone function, so that boxes which meet as reals meet
//! as integers: the index may report too much and never too little. A few boxes stay as they are, and are all compared.

use crate::base::meter::{Meter, Refusal};
use crate::base::parts::{Numbered, PART};
use crate::base::{id::index, sort::sort_on, threads::Threads};
use glam::DVec2;
use std::ops::Range;

/// A strip for each so many boxes.
const BOXES_PER_STRIP: usize = 192;

/// So many boxes are quicker compared than sorted.
const FEW: usize = 32;

/// Entries are passed over so many at a time where none reaches high enough.
const ROW: usize = 16;

/// So many boxes are compared at a time, without branches, so that the compiler can use vectors.
const LANES: usize = 8;

/// Whether two boxes meet. Differences of doubles have the signs of the exact ones, and vectors take them two at a time.
#[inline]
pub(super) fn boxes_meet([low, high]: [DVec2; 2], [other_low, other_high]: [DVec2; 2]) -> bool {
    let common = (high - other_low).min(other_high - low);
    common.min_element() >= 0.0
}

/// A box in the index's integers.
#[derive(Clone, Copy, Debug)]
struct Extent {
    x0: i32,
    x1: i32,
    y0: i32,
    y1: i32,
}

/// A weakly monotone map of an interval to 0 … 2^31 - 1.
#[derive(Clone, Copy, Debug, Default)]
struct Scale {
    half_low: f64,
    factor: f64,
}

impl Scale {
    fn new(low: f64, high: f64) -> Scale {
        // Halves, so that the width of any finite interval is finite.
        let (half_low, half_width) = (low * 0.5, high * 0.5 - low * 0.5);
        let factor = if half_width > 0.0 { (2_147_483_647.0 / half_width).min(f64::MAX) } else { 0.0 };
        Scale { half_low, factor }
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the cast saturates, which keeps the map monotone")]
    fn map(self, x: f64) -> i32 {
        ((x * 0.5 - self.half_low) * self.factor) as i32
    }
}

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct Strips {
    x: Scale,
    y: Scale,
    starts: Vec<u32>,
    /// Of each entry the box and its sides, strip by strip.
    ids: Vec<u32>,
    x0: Vec<i32>,
    x1: Vec<i32>,
    y0: Vec<i32>,
    y1: Vec<i32>,
    /// The largest `y1` of the strip's entries up to this one.
    highest: Vec<i32>,
    /// The largest `y1` of so many entries in a row.
    tops: Vec<i32>,
    boxes: Vec<Extent>,
    /// A few boxes, in place of all the rest.
    few: Vec<[DVec2; 2]>,
    keys: Vec<u64>,
}

impl Strips {
    /// Indexes boxes, given by their lower left and upper right corners, under their numbers.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn build(
        &mut self,
        boxes: impl ExactSizeIterator<Item = [DVec2; 2]> + Clone,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.few.clear();
        if boxes.len() <= FEW {
            self.boxes.clear();
            self.few.extend(boxes);
            return Ok(());
        }
        let (mut low, mut high) = (DVec2::MAX, DVec2::MIN);
        meter.for_all(boxes.clone(), |[a, b]| {
            low = low.min(a);
            high = high.max(b);
        })?;
        (self.x, self.y) = (Scale::new(low.x, high.x), Scale::new(low.y, high.y));
        self.boxes.clear();
        let extent = |[a, b]: [DVec2; 2]| {
            let (x0, y0, x1, y1) = (self.x.map(a.x), self.y.map(a.y), self.x.map(b.x), self.y.map(b.y));
            Extent { x0, x1, y0, y1 }
        };
        meter.extend(&mut self.boxes, boxes.map(extent))?;
        let count = self.strip_count();
        self.count_entries(count, meter)?;
        self.fill(meter)?;
        self.sort(meter)?;
        self.arrange(meter)
    }

    /// As many strips as keep about 192 boxes in each, and a box in 1.25 strips on the average at most.
    fn strip_count(&self) -> usize {
        let n = self.boxes.len();
        let by_number = n / BOXES_PER_STRIP;
        let widths: u64 = self.boxes.iter().map(|b| u64::from(b.x1.abs_diff(b.x0))).sum();
        let by_width = ((n as u64) << 29).checked_div(widths).unwrap_or(u64::MAX);
        by_number.min(usize::try_from(by_width).unwrap_or(usize::MAX)).max(1)
    }

    #[inline]
    fn strip(x: i32, count: usize) -> usize {
        (usize::try_from(x).unwrap_or(0) * count) >> 31
    }

    fn strips_of(extent: Extent, count: usize) -> Range<usize> {
        Strips::strip(extent.x0, count)..Strips::strip(extent.x1, count) + 1
    }

    fn count_entries(&mut self, count: usize, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.starts.clear();
        self.starts.resize(count + 2, 0);
        meter.for_each(&self.boxes[..], |&extent| {
            for strip in Strips::strips_of(extent, count) {
                self.starts[strip + 2] += 1;
            }
        })?;
        for strip in 2..count + 2 {
            self.starts[strip] += self.starts[strip - 1];
        }
        Ok(())
    }

    /// Puts (lower side, box) keys into the strips; afterwards `starts[s]..starts[s + 1]` are strip s's entries.
    fn fill(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        let count = self.starts.len() - 2;
        meter.fill(&mut self.keys, 0, self.starts[count + 1] as usize)?;
        meter.for_each(Numbered(&self.boxes), |(i, &extent)| {
            for strip in Strips::strips_of(extent, count) {
                let at = self.starts[strip + 1];
                self.keys[at as usize] = u64::from(extent.y0.unsigned_abs()) << 32 | u64::from(i);
                self.starts[strip + 1] += 1;
            }
        })?;
        self.starts.pop();
        Ok(())
    }

    fn sort(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        let mut rest = &mut self.keys[..];
        let strips = self.starts.windows(2).map(move |ends| {
            let (strip, others) = std::mem::take(&mut rest).split_at_mut((ends[1] - ends[0]) as usize);
            rest = others;
            strip
        });
        let threads = Threads::for_edges(self.boxes.len());
        threads.try_for_each(strips, |strip| {
            meter.spend(strip.len())?;
            sort_on(threads, strip, u64::cmp, meter)
        })
    }

    /// Puts the boxes into the order of their keys.
    fn arrange(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        for side in [&mut self.x0, &mut self.x1, &mut self.y0, &mut self.y1, &mut self.highest] {
            side.clear();
        }
        self.ids.clear();
        let mut tally = meter.tally();
        for strip in 0..self.starts.len() - 1 {
            let entries = self.entries(strip);
            let mut highest = 0;
            for keys in self.keys[entries].chunks(PART) {
                for &key in keys {
                    let id = key & 0xffff_ffff;
                    let extent = self.boxes[id as usize];
                    highest = extent.y1.max(highest);
                    self.ids.push(index(id as usize));
                    self.x0.push(extent.x0);
                    self.x1.push(extent.x1);
                    self.y0.push(extent.y0);
                    self.y1.push(extent.y1);
                    self.highest.push(highest);
                }
                tally.add(keys.len())?;
            }
        }
        self.tops.clear();
        self.tops.extend(self.y1.chunks(ROW).map(|row| row.iter().copied().fold(0, i32::max)));
        Ok(())
    }

    fn entries(&self, strip: usize) -> Range<usize> {
        self.starts[strip] as usize..self.starts[strip + 1] as usize
    }

    /// The number of strips.
    pub(crate) fn len(&self) -> usize {
        if self.boxes.is_empty() { 1 } else { self.starts.len() - 1 }
    }

    /// Calls `visit` once for each pair of boxes that meet in some of the strips, in an order that depends on the boxes
    /// alone.
    ///
    /// Gives up, and returns false, when `visit` does, or when more than so many blocks of boxes must be looked at.
    ///
    /// # Errors
    /// Those of the meter's limits, as each block is work, and that of the first visit with one.
    pub(crate) fn pairs_within(
        &self,
        strips: Range<usize>,
        mut blocks: usize,
        meter: &Meter<'_>,
        mut visit: impl FnMut(u32, u32) -> Result<bool, Refusal>,
    ) -> Result<bool, Refusal> {
        if self.boxes.is_empty() {
            return self.few_pairs(visit);
        }
        let mut tally = meter.tally();
        for strip in strips {
            let entries = self.entries(strip);
            for i in entries.clone() {
                let mut go_on = Ok(true);
                let looked_at = self.above(i, entries.end, |j| {
                    if go_on == Ok(true) && self.is_first(strip, i, j) {
                        go_on = visit(self.ids[i], self.ids[j]);
                    }
                });
                if !go_on? || looked_at > blocks {
                    return Ok(false);
                }
                blocks -= looked_at;
                tally.add(looked_at + 1)?;
            }
        }
        Ok(true)
    }

    /// Calls `visit` for each pair of every `step`-th box and one behind it in its strip, until it returns false or more
    /// than so many blocks of boxes were looked at. Returns of how many boxes one was looked at, and the blocks.
    pub(crate) fn sample(
        &self,
        step: usize,
        most_blocks: usize,
        mut visit: impl FnMut(u32, u32) -> bool,
    ) -> (usize, usize) {
        let (mut boxes, mut blocks, mut go_on) = (0, 0, true);
        let all =
            (0..self.len()).flat_map(|strip| self.entries(strip).step_by(step).map(move |i| (strip, i)));
        for (strip, i) in all {
            if !go_on || blocks > most_blocks {
                break;
            }
            boxes += 1;
            blocks += self.above(i, self.entries(strip).end, |j| {
                if go_on && self.is_first(strip, i, j) {
                    go_on = visit(self.ids[i], self.ids[j]);
                }
            });
        }
        (self.ids.len().div_ceil(boxes.max(1)), blocks)
    }

    /// Whether of all strips in which two boxes meet one is the first.
    #[inline]
    fn is_first(&self, strip: usize, i: usize, j: usize) -> bool {
        let count = self.starts.len() - 1;
        count == 1 || Strips::strip(self.x0[i].max(self.x0[j]), count) == strip
    }

    fn few_pairs(&self, mut visit: impl FnMut(u32, u32) -> Result<bool, Refusal>) -> Result<bool, Refusal> {
        for (j, &b) in (0..).zip(&self.few) {
            for (i, &a) in (0..j).zip(&self.few) {
                if boxes_meet(a, b) && !visit(i, j)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// Calls `visit` for the entries behind `i` whose boxes meet that of `i`; returns how many blocks it looked at.
    #[inline]
    fn above(&self, i: usize, end: usize, mut visit: impl FnMut(usize)) -> usize {
        let (x0, x1, y1) = (self.x0[i], self.x1[i], self.y1[i]);
        let mut j = i + 1;
        while j < end && self.y0[j] <= y1 {
            let lanes = j..end.min(j + LANES);
            let sides = self.x0[lanes.clone()].iter().zip(&self.x1[lanes.clone()]).zip(&self.y0[lanes]);
            let meets = |((&b0, &b1), &y0): ((&i32, &i32), &i32)| (b0 <= x1) & (x0 <= b1) & (y0 <= y1);
            let mut mask = 0_u32;
            for (lane, sides) in sides.enumerate() {
                mask |= u32::from(meets(sides)) << lane;
            }
            while mask != 0 {
                visit(j + mask.trailing_zeros() as usize);
                mask &= mask - 1;
            }
            j += LANES;
        }
        (j - i) / LANES
    }

    /// Calls `visit` for the boxes at abscissa `x` that reach below `y`, from the highest lower side down, until no
    /// box left reaches the height that the last call returned (`None`: nothing found yet), or until `left` boxes were
    /// looked at; counts these down.
    pub(crate) fn below(&self, x: f64, y: f64, left: &mut usize, mut visit: impl FnMut(u32) -> Option<f64>) {
        if self.boxes.is_empty() {
            return (0..index(self.few.len())).for_each(|i| _ = visit(i));
        }
        let count = self.starts.len() - 1;
        let (xm, ym) = (self.x.map(x), self.y.map(y));
        let entries = self.entries(Strips::strip(xm, count));
        let end = entries.start + self.y0[entries.clone()].partition_point(|&y0| y0 <= ym);
        let mut lowest = 0;
        let mut i = end;
        while i > entries.start && self.highest[i - 1] >= lowest && *left > 0 {
            *left -= 1;
            if i % ROW == 0 && i >= entries.start + ROW && self.tops[i / ROW - 1] < lowest {
                i -= ROW;
                continue;
            }
            i -= 1;
            if self.x0[i] <= xm && xm <= self.x1[i] && self.y1[i] >= lowest {
                lowest = visit(self.ids[i]).map_or(0, |height| self.y.map(height));
            }
        }
    }
}
