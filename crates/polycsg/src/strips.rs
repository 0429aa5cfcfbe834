//! An index over boxes: vertical strips, in each the boxes by their lower side.
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
//! as integers: the index may report too much and never too little.

use crate::predicates::Segment;
use crate::truth::index;
use std::cmp::Ordering;
use std::ops::Range;

/// Entries of a strip that this many make worth sorting into one more strip.
const BOXES_PER_STRIP: usize = 192;

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
    ids: Vec<u32>,
    extents: Vec<Extent>,
    /// The largest `y1` of the strip's entries up to this one.
    highest: Vec<i32>,
    boxes: Vec<(u32, Extent)>,
    keys: Vec<u64>,
}

impl Strips {
    /// Indexes the boxes of segments with their ids.
    pub(crate) fn build(&mut self, segments: impl Iterator<Item = (u32, Segment)> + Clone) {
        self.measure(segments.clone());
        self.boxes.clear();
        for (id, segment) in segments {
            let extent = self.extent(segment);
            self.boxes.push((id, extent));
        }
        let count = self.strip_count();
        self.count_entries(count);
        self.fill();
        self.sort();
    }

    fn measure(&mut self, segments: impl Iterator<Item = (u32, Segment)>) {
        let (mut low, mut high) = (glam::DVec2::MAX, glam::DVec2::MIN);
        for (_, [a, b]) in segments {
            low = low.min(a).min(b);
            high = high.max(a).max(b);
        }
        self.x = Scale::new(low.x, high.x);
        self.y = Scale::new(low.y, high.y);
    }

    fn extent(&self, [a, b]: Segment) -> Extent {
        let (ax, bx, ay, by) = (self.x.map(a.x), self.x.map(b.x), self.y.map(a.y), self.y.map(b.y));
        Extent { x0: ax.min(bx), x1: ax.max(bx), y0: ay.min(by), y1: ay.max(by) }
    }

    /// As many strips as keep about 192 boxes in each, and a box in 1.25 strips on the average at most.
    fn strip_count(&self) -> usize {
        let n = self.boxes.len();
        let by_number = n / BOXES_PER_STRIP;
        let widths: u64 = self.boxes.iter().map(|(_, b)| u64::from(b.x1.abs_diff(b.x0))).sum();
        let by_width = ((n as u64) << 29).checked_div(widths).unwrap_or(u64::MAX);
        by_number.min(usize::try_from(by_width).unwrap_or(usize::MAX)).max(1)
    }

    fn strip(x: i32, count: usize) -> usize {
        (usize::try_from(x).unwrap_or(0) * count) >> 31
    }

    fn strips_of(extent: Extent, count: usize) -> Range<usize> {
        Strips::strip(extent.x0, count)..Strips::strip(extent.x1, count) + 1
    }

    fn count_entries(&mut self, count: usize) {
        self.starts.clear();
        self.starts.resize(count + 2, 0);
        for &(_, extent) in &self.boxes {
            for strip in Strips::strips_of(extent, count) {
                self.starts[strip + 2] += 1;
            }
        }
        for strip in 2..count + 2 {
            self.starts[strip] += self.starts[strip - 1];
        }
    }

    /// Puts (lower side, box) keys into the strips; afterwards `starts[s]..starts[s + 1]` are strip s's entries.
    fn fill(&mut self) {
        let count = self.starts.len() - 2;
        self.keys.clear();
        self.keys.resize(self.starts[count + 1] as usize, 0);
        for (i, &(_, extent)) in self.boxes.iter().enumerate() {
            for strip in Strips::strips_of(extent, count) {
                let at = self.starts[strip + 1];
                self.keys[at as usize] = u64::from(extent.y0.unsigned_abs()) << 32 | i as u64;
                self.starts[strip + 1] += 1;
            }
        }
        self.starts.pop();
    }

    fn sort(&mut self) {
        self.ids.clear();
        self.extents.clear();
        self.highest.clear();
        for strip in 0..self.starts.len() - 1 {
            let entries = self.starts[strip] as usize..self.starts[strip + 1] as usize;
            self.keys[entries.clone()].sort_unstable();
            let mut highest = 0;
            for &key in &self.keys[entries] {
                let (id, extent) = self.boxes[(key & 0xffff_ffff) as usize];
                highest = extent.y1.max(highest);
                self.ids.push(id);
                self.extents.push(extent);
                self.highest.push(highest);
            }
        }
    }

    /// Leaves one of each group of segments that `compare` finds equal: the one with the smallest id, which comes first
    /// in the pairs returned.
    pub(crate) fn unite(&mut self, compare: impl Fn(u32, u32) -> Ordering) -> Vec<[u32; 2]> {
        let mut same = Vec::new();
        let mut run = Vec::new();
        let count = self.starts.len() - 1;
        for strip in 0..count {
            let extents = &self.extents[self.entries(strip)];
            let mut start = self.entries(strip).start;
            // Equal segments have one lower side, and start in one strip.
            for equal in extents.chunk_by(|a, b| a.y0 == b.y0) {
                if equal.len() > 1 {
                    let ids = start..start + equal.len();
                    run.clear();
                    run.extend(
                        ids.filter(|&i| Strips::strip(self.extents[i].x0, count) == strip)
                            .map(|i| self.ids[i]),
                    );
                    run.sort_unstable_by(|&a, &b| compare(a, b).then(a.cmp(&b)));
                    for group in run.chunk_by(|&a, &b| compare(a, b) == Ordering::Equal) {
                        same.extend(group[1..].iter().map(|&follows| [group[0], follows]));
                    }
                }
                start += equal.len();
            }
        }
        if !same.is_empty() {
            self.remove(&same);
        }
        same
    }

    /// Removes the second id of each pair.
    fn remove(&mut self, same: &[[u32; 2]]) {
        let last = self.ids.iter().max().map_or(0, |&id| id as usize + 1);
        let mut follows = vec![false; last];
        same.iter().for_each(|pair| follows[pair[1] as usize] = true);
        let (ids, extents) = (std::mem::take(&mut self.ids), std::mem::take(&mut self.extents));
        let starts = std::mem::replace(&mut self.starts, vec![0]);
        self.highest.clear();
        for strip in starts.windows(2) {
            let mut highest = 0;
            for i in strip[0] as usize..strip[1] as usize {
                if !follows[ids[i] as usize] {
                    highest = extents[i].y1.max(highest);
                    self.ids.push(ids[i]);
                    self.extents.push(extents[i]);
                    self.highest.push(highest);
                }
            }
            self.starts.push(index(self.ids.len()));
        }
    }

    fn entries(&self, strip: usize) -> Range<usize> {
        self.starts[strip] as usize..self.starts[strip + 1] as usize
    }

    /// Calls `visit` once for each pair of ids whose boxes meet, in an order that depends on the boxes alone.
    pub(crate) fn pairs(&self, mut visit: impl FnMut(u32, u32)) {
        let count = self.starts.len() - 1;
        for strip in 0..count {
            let entries = self.entries(strip);
            for i in entries.clone() {
                let a = self.extents[i];
                for j in i + 1..entries.end {
                    let b = self.extents[j];
                    if b.y0 > a.y1 {
                        break;
                    }
                    let meets = b.x0 <= a.x1 && a.x0 <= b.x1;
                    if meets && Strips::strip(a.x0.max(b.x0), count) == strip {
                        visit(self.ids[i], self.ids[j]);
                    }
                }
            }
        }
    }

    /// Calls `visit` for the boxes at abscissa `x` that reach below `y`, from the highest lower side down, until no
    /// box left reaches the height that the last call returned (`None`: nothing found yet).
    pub(crate) fn below(&self, x: f64, y: f64, mut visit: impl FnMut(u32) -> Option<f64>) {
        let count = self.starts.len() - 1;
        let (xm, ym) = (self.x.map(x), self.y.map(y));
        let entries = self.entries(Strips::strip(xm, count));
        let end = entries.start + self.extents[entries.clone()].partition_point(|b| b.y0 <= ym);
        let mut best = None;
        for i in (entries.start..end).rev() {
            if best.is_some_and(|height| self.highest[i] < self.y.map(height)) {
                return;
            }
            let b = self.extents[i];
            if b.x0 <= xm && xm <= b.x1 {
                best = visit(self.ids[i]);
            }
        }
    }
}
