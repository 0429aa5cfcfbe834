//! An index over edges for inputs where boxes tell nothing: long edges beside one another.
//!
//! The plane is cut into slabs at the edges' ends, taken from left to right (of one abscissa, from below), halved again
//! and again. In the widest slabs that it crosses from side to side, an edge *spans*:
//!
//! ```text
//!    slab            a, b, d, c span and do not meet: they are the slab's rungs, in one order at both sides.
//!   |      d_|__     e spans and crosses: it is compared with the rungs that it has between its two heights,
//!   |_c__----|-      and handed on to the halves of the slab for what else it may meet.
//!  _|--  _f /|       f ends here: it is compared with the rungs between its heights where it enters and where it
//!   |b__/__/_|__     ends, and handed on likewise.
//!  _|__a__/__|__
//!   |    e   |       So an edge costs O(log n) in each of O(log n) slabs, and each crossing O(log n) at most.
//! ```
//!
//! Edges that run within the heights' error of a rung from side to side *follow* it: whatever comes near the rung is
//! compared with them too, and like the rung they are not handed on. Otherwise edges that all but coincide, as shadows of
//! parallel edges do, would be compared in every slab.
//!
//! Heights are floats with a bound on their error: the index reports too much and never too little. Two edges with a
//! common end are reported only if they may meet elsewhere too, so that a fan of edges costs no more than other edges.

#[cfg(test)]
mod tests;

use crate::predicates::{Side, height_order, lexicographic, side};
use crate::truth::index;
use glam::DVec2;
use std::cmp::Ordering;
use std::ops::Range;

/// So many edges are compared with one another, each with each.
const FEW: usize = 8;

/// No span.
const NONE: u32 = u32::MAX;

/// An edge, by the ranks of its ends among all distinct ends.
#[derive(Clone, Copy, Debug)]
struct Bar {
    ranks: [u32; 2],
    id: u32,
}

/// An edge from side to side of a slab: its heights there, and whether they are its ends.
#[derive(Clone, Copy, Debug)]
struct Span {
    heights: [f64; 2],
    line: Line,
    bar: Bar,
    is_end: [bool; 2],
}

/// The line through an edge: by its left end and its slope, which is NaN where it would not do.
#[derive(Clone, Copy, Debug)]
struct Line {
    start: DVec2,
    slope: f64,
}

/// A slab by the ranks of the points at its sides.
type Slab = [u32; 2];

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct Slabs {
    /// The distinct ends in their order.
    ends: Vec<DVec2>,
    sorted: Vec<(DVec2, u32)>,
    /// Per point its rank.
    ranks: Vec<u32>,
    /// The edges, those with the same ends one after the other; `bars` has the first of each kind.
    all: Vec<Bar>,
    bars: Vec<Bar>,
    /// Two heights that differ by more differ.
    slack: f64,
    /// Whether all coordinates lie where slopes neither overflow nor lose bits.
    has_slopes: bool,
    /// The edges of the slab at hand, of its half at hand, and so on, with their places in `bars` for ids.
    open: Vec<Bar>,
    spans: Vec<Span>,
    rungs: Vec<Span>,
    /// The spans that follow a rung, by its place.
    followers: Vec<(usize, Bar)>,
    /// The rungs that start in the slab's left point, and those that end in its right one.
    fans: [Range<usize>; 2],
    tops: Vec<u32>,
    before: Vec<u32>,
    found: Vec<[u32; 2]>,
    /// Points by rank, and of each one the bar found below it.
    queries: Vec<(u32, u32)>,
    nearest: Vec<u32>,
}

impl Slabs {
    /// Indexes edges between points, given by the numbers of their ends, under their ids.
    pub(crate) fn build(
        &mut self,
        points: impl Iterator<Item = DVec2>,
        edges: impl Iterator<Item = (u32, [u32; 2])>,
    ) {
        self.rank(points);
        let bar = |(id, ends): (u32, [u32; 2])| {
            let [a, b] = ends.map(|point| self.ranks[point as usize]);
            Bar { ranks: [a.min(b), a.max(b)], id }
        };
        self.all.clear();
        self.all.extend(edges.map(bar).filter(|bar| bar.ranks[0] < bar.ranks[1]));
        self.all.sort_unstable_by_key(|bar| (bar.ranks, bar.id));
        self.bars.clear();
        self.bars.extend(self.all.chunk_by(|a, b| a.ranks == b.ranks).map(|same| same[0]));
        let highest = self.ends.iter().fold(0.0, |y: f64, p| y.max(p.y.abs()));
        self.slack = highest * SLACK + f64::MIN_POSITIVE;
        let is_moderate = |x: f64| x == 0.0 || (LEAST..=1.0 / LEAST).contains(&x.abs());
        self.has_slopes = self.ends.iter().all(|p| is_moderate(p.x) && is_moderate(p.y));
    }

    fn rank(&mut self, points: impl Iterator<Item = DVec2>) {
        self.sorted.clear();
        self.sorted.extend(points.zip(0..));
        self.sorted.sort_unstable_by(|a, b| lexicographic(a.0, b.0).then(a.1.cmp(&b.1)));
        self.ends.clear();
        self.ranks.clear();
        self.ranks.resize(self.sorted.len(), 0);
        for &(point, number) in &self.sorted {
            if self.ends.last() != Some(&point) {
                self.ends.push(point);
            }
            self.ranks[number as usize] = index(self.ends.len() - 1);
        }
    }

    /// The points by their numbers, those in one place together.
    pub(crate) fn places(&self) -> impl Iterator<Item = impl Iterator<Item = u32> + '_> + '_ {
        self.sorted.chunk_by(|a, b| a.0 == b.0).map(|place| place.iter().map(|&(_, number)| number))
    }

    /// The edges that have both ends in common with another one before them, with the first such.
    pub(crate) fn copies(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let same = self.all.chunk_by(|a, b| a.ranks == b.ranks);
        same.flat_map(|same| same[1..].iter().map(|bar| [same[0].id, bar.id]))
    }

    /// Calls `visit` once for each pair of edges that may meet but in one common end or both, by their ids; of edges with
    /// both ends in common, one stands for all against another such.
    pub(crate) fn pairs(&mut self, mut visit: impl FnMut(u32, u32)) {
        self.find();
        for i in 0..self.found.len() {
            let [e, f] = self.found[i].map(|bar| self.copies_of(bar));
            visit(self.all[e.start].id, self.all[f.start].id);
            f.clone().skip(1).for_each(|g| visit(self.all[e.start].id, self.all[g].id));
            e.skip(1).for_each(|g| visit(self.all[g].id, self.all[f.start].id));
        }
    }

    /// The places in `all` of the edges that a bar stands for.
    fn copies_of(&self, bar: u32) -> Range<usize> {
        let ranks = self.bars[bar as usize].ranks;
        let start = self.all.partition_point(|bar| bar.ranks < ranks);
        start..start + self.all[start..].iter().take_while(|bar| bar.ranks == ranks).count()
    }

    /// For each of some of the points the edge right below it, by its id: of the edges that a ray straight down from just
    /// right of the point meets the first, edges that start in the point passed over.
    pub(crate) fn below(&mut self, points: &[u32], found: &mut Vec<Option<u32>>) {
        self.queries.clear();
        self.queries.extend((0..).zip(points).map(|(place, &point)| (self.ranks[point as usize], place)));
        self.queries.sort_unstable();
        self.nearest.clear();
        self.nearest.resize(points.len(), NONE);
        self.open.clear();
        self.open.extend(self.bars.iter().zip(0..).map(|(bar, id)| Bar { id, ..*bar }));
        if let Some(last) = index(self.ends.len()).checked_sub(1) {
            let queries = 0..self.queries.len();
            self.look_down([0, last], 0, queries);
        }
        found.clear();
        let id = |&bar: &u32| self.bars.get(bar as usize).map(|bar| bar.id);
        found.extend(self.nearest.iter().map(id));
    }

    fn find(&mut self) {
        self.found.clear();
        self.open.clear();
        self.open.extend(self.bars.iter().zip(0..).map(|(bar, id)| Bar { id, ..*bar }));
        if let Some(last) = index(self.ends.len()).checked_sub(1) {
            self.look_into([0, last], 0);
        }
        self.found.sort_unstable();
        self.found.dedup();
    }

    /// Finds the pairs of the open edges from `start` on that may meet in a slab, and forgets these edges.
    fn look_into(&mut self, slab: Slab, start: usize) {
        self.sort_out_spans(slab, start);
        while !self.spans.is_empty() {
            self.choose_rungs();
            self.sort_out_followers();
            self.compare_followers(slab);
            for i in 0..self.spans.len() {
                self.compare(self.spans[i].bar, slab, true);
            }
            for i in start..self.open.len() {
                self.compare(self.open[i], slab, true);
            }
            if slab[1] - slab[0] > 1 {
                self.open.extend(self.spans.drain(..).map(|span| span.bar));
            }
        }
        let end = self.open.len();
        if end - start <= FEW {
            self.compare_all(slab, start..end);
        } else {
            let middle = slab[0].midpoint(slab[1]);
            for half in [[slab[0], middle], [middle, slab[1]]] {
                self.open_again(half, start..end);
                self.look_into(half, end);
            }
        }
        self.open.truncate(start);
    }

    /// Opens those of some open edges once more that have more than a point in a half of their slab.
    fn open_again(&mut self, half: Slab, open: Range<usize>) {
        for i in open {
            let bar = self.open[i];
            if bar.ranks[0] < half[1] && bar.ranks[1] > half[0] {
                self.open.push(bar);
            }
        }
    }

    /// Finds what is below those of the queries, sorted by rank, that lie in a slab but not at its right side.
    fn look_down(&mut self, slab: Slab, start: usize, queries: Range<usize>) {
        let within =
            |rank: u32| queries.start + self.queries[queries.clone()].partition_point(|q| q.0 < rank);
        let queries = within(slab[0])..within(slab[1]);
        if queries.is_empty() {
            return self.open.truncate(start);
        }
        self.sort_out_spans(slab, start);
        while !self.spans.is_empty() {
            self.choose_rungs();
            queries.clone().for_each(|query| self.look_at_rungs(query, slab));
            if slab[1] - slab[0] > 1 {
                self.open.extend(self.spans.drain(..).map(|span| span.bar));
            }
        }
        let end = self.open.len();
        if end - start <= FEW {
            for query in queries {
                for i in start..end {
                    self.look_at(query, self.open[i]);
                }
            }
        } else {
            let middle = slab[0].midpoint(slab[1]);
            for half in [[slab[0], middle], [middle, slab[1]]] {
                self.open_again(half, start..end);
                self.look_down(half, end, queries.clone());
            }
        }
        self.open.truncate(start);
    }

    /// Takes the highest rung below a query.
    fn look_at_rungs(&mut self, query: usize, slab: Slab) {
        let rank = self.queries[query].0;
        let p = self.ends[rank as usize];
        let at = |rung: &Span| if rank == slab[0] { rung.heights[0] } else { self.height_inside(rung, rank) };
        let first = self.rungs.partition_point(|rung| at(rung) + self.slack < p.y);
        let last = first + self.rungs[first..].iter().take_while(|rung| at(rung) <= p.y + self.slack).count();
        for i in (first.saturating_sub(1)..last).rev() {
            if self.look_at(query, self.rungs[i].bar) {
                return;
            }
        }
    }

    /// Takes an edge if it is below a query, and higher than what was found; returns whether it is below.
    fn look_at(&mut self, query: usize, bar: Bar) -> bool {
        let (rank, place) = self.queries[query];
        let p = self.ends[rank as usize];
        let [a, b] = bar.ranks.map(|rank| self.ends[rank as usize]);
        let is_below = bar.ranks[0] < rank && rank < bar.ranks[1] && side(a, b, p) == Side::Left;
        if is_below {
            let nearest = &mut self.nearest[place as usize];
            let before = self.bars.get(*nearest as usize);
            let before = before.map(|bar| bar.ranks.map(|rank| self.ends[rank as usize]));
            if before.is_none_or(|before| height_order([a, b], before, p.x) == Ordering::Greater) {
                *nearest = bar.id;
            }
        }
        is_below
    }

    /// Takes the open edges that span a slab, and sorts them by their heights.
    fn sort_out_spans(&mut self, slab: Slab, start: usize) {
        let mut kept = start;
        for i in start..self.open.len() {
            let bar = self.open[i];
            if bar.ranks[0] <= slab[0] && slab[1] <= bar.ranks[1] {
                let line = self.line(bar);
                let heights = slab.map(|rank| self.height(bar.ranks, line, rank));
                let is_end = [0, 1].map(|side| bar.ranks[side] == slab[side]);
                self.spans.push(Span { heights, line, bar, is_end });
            } else {
                self.open[kept] = bar;
                kept += 1;
            }
        }
        self.open.truncate(kept);
        self.spans.sort_unstable_by(|a, b| {
            let by_side = |side: usize| a.heights[side].total_cmp(&b.heights[side]);
            by_side(0).then_with(|| by_side(1)).then(a.bar.id.cmp(&b.bar.id))
        });
    }

    /// Moves as many spans as may be, none of which meets another, to the rungs: the longest increasing subsequence by
    /// patience sorting.
    fn choose_rungs(&mut self) {
        let Slabs { spans, rungs, tops, before, slack, .. } = self;
        tops.clear();
        before.clear();
        for (i, span) in spans.iter().enumerate() {
            let pile = tops.partition_point(|&top| is_below(&spans[top as usize], span, 1, *slack));
            let below = pile.checked_sub(1).map_or(NONE, |pile| tops[pile]);
            let fits = below == NONE || {
                let below = &spans[below as usize];
                is_below(below, span, 0, *slack) && is_below(below, span, 1, *slack)
            };
            before.push(below);
            if fits {
                match tops.get_mut(pile) {
                    Some(top) => *top = index(i),
                    None => tops.push(index(i)),
                }
            }
        }
        rungs.clear();
        let mut next = tops.last().copied().unwrap_or(NONE);
        while next != NONE {
            rungs.push(spans[next as usize]);
            spans[next as usize].bar.id = NONE;
            next = before[next as usize];
        }
        rungs.reverse();
        spans.retain(|span| span.bar.id != NONE);
        self.fans = [0, 1].map(|side| {
            let start = self.rungs.iter().position(|rung| rung.is_end[side]).unwrap_or(0);
            start..start + self.rungs[start..].iter().take_while(|rung| rung.is_end[side]).count()
        });
    }

    /// Takes the spans that follow a rung.
    fn sort_out_followers(&mut self) {
        let Slabs { spans, rungs, followers, slack, .. } = self;
        followers.clear();
        spans.retain(|span| {
            let at = rungs.partition_point(|rung| rung.heights[0] + *slack < span.heights[0]);
            let is_near =
                |rung: &Span, side: usize| (rung.heights[side] - span.heights[side]).abs() <= *slack;
            let near = rungs[at..].iter().take_while(|rung| is_near(rung, 0));
            // Of a fan all are near there: those that end alike and are near on the other side are few.
            let mut near = near.take(FEW).zip(at..);
            let found = near.find(|(rung, _)| rung.is_end == span.is_end && is_near(rung, 1));
            followers.extend(found.map(|(_, place)| (place, span.bar)));
            found.is_none()
        });
        followers.sort_unstable_by_key(|&(place, bar)| (place, bar.id));
    }

    /// Finds the pairs of followers and rungs, and of followers of one rung or of rungs near one another, that may meet in
    /// a slab.
    fn compare_followers(&mut self, slab: Slab) {
        for i in 0..self.followers.len() {
            self.compare(self.followers[i].1, slab, false);
        }
        for (i, &(place, e)) in self.followers.iter().enumerate() {
            let [left, right] = self.rungs[place].heights;
            let are_near = |other: usize| {
                let heights = self.rungs[other].heights;
                heights[0] - left <= 3.0 * self.slack || heights[1] - right <= 3.0 * self.slack
            };
            for &(_, f) in self.followers[i + 1..].iter().take_while(|(other, _)| are_near(*other)) {
                if self.may_meet(e, f, slab) {
                    self.found.push([e.id.min(f.id), e.id.max(f.id)]);
                }
            }
        }
    }

    /// Finds the rungs, and if asked for their followers, that an edge may meet in a slab.
    fn compare(&mut self, bar: Bar, slab: Slab, with_followers: bool) {
        let line = self.line(bar);
        let (near_left, left) = self.position(bar, line, 0, slab, None);
        // Most edges meet none, and are between the same two all the way.
        let (near_right, right) = self.position(bar, line, 1, slab, Some(left.start));
        let crossed = if left.end < right.start { left.end..right.start } else { right.end..left.start };
        let any = |rungs: &Range<usize>| rungs.start < rungs.end;
        for rungs in near_left.into_iter().chain(near_right).chain([crossed]).filter(any) {
            let all = if with_followers { &self.followers[..] } else { &[] };
            let first = all.partition_point(|&(place, _)| place < rungs.start);
            let followers = all[first..].iter().take_while(|&&(place, _)| place < rungs.end);
            let near =
                self.rungs[rungs.clone()].iter().map(|rung| rung.bar).chain(followers.map(|&(_, bar)| bar));
            self.found.extend(near.map(|other| [bar.id.min(other.id), bar.id.max(other.id)]));
        }
    }

    /// Of the place where an edge enters or leaves a slab or ends in it, the rungs that may go through it, and those
    /// between which it lies; rungs that start or end in it with the edge count for the second only.
    fn position(
        &self,
        bar: Bar,
        line: Line,
        side: usize,
        slab: Slab,
        guess: Option<usize>,
    ) -> ([Range<usize>; 2], Range<usize>) {
        let rank = bar.ranks[side].clamp(slab[0], slab[1]);
        let height = self.height(bar.ranks, line, rank);
        let at = |rung: &Span| {
            if rank == slab[side] { rung.heights[side] } else { self.height_inside(rung, rank) }
        };
        // Followers are within one slack of their rung, and may touch within one more.
        let is_below = |rung: &Span| at(rung) + 3.0 * self.slack < height;
        let may_touch = |rung: &Span| at(rung) <= height + 3.0 * self.slack;
        let fits = |&guess: &usize| {
            self.rungs[..guess].last().is_none_or(is_below) && !self.rungs.get(guess).is_some_and(is_below)
        };
        let first = guess.filter(fits).unwrap_or_else(|| self.rungs.partition_point(is_below));
        let last = match self.rungs.get(first) {
            Some(rung) if may_touch(rung) => first + self.rungs[first..].partition_point(may_touch),
            _ => first,
        };
        let fan = self.fans[side].clone();
        if bar.ranks[side] == slab[side] && !fan.is_empty() {
            ([first..fan.start, fan.end..last], fan)
        } else {
            ([first..last, 0..0], first..last)
        }
    }

    /// Finds the pairs among a few edges that may meet in a slab.
    fn compare_all(&mut self, slab: Slab, open: Range<usize>) {
        for i in open.clone() {
            for j in open.start..i {
                let [e, f] = [self.open[i], self.open[j]];
                if self.may_meet(e, f, slab) {
                    self.found.push([e.id.min(f.id), e.id.max(f.id)]);
                }
            }
        }
    }

    fn may_meet(&self, e: Bar, f: Bar, slab: Slab) -> bool {
        let (r, s) = (e.ranks, f.ranks);
        let (left, right) = (r[0].max(s[0]).max(slab[0]), r[1].min(s[1]).min(slab[1]));
        if left >= right {
            return false;
        }
        let lines = [self.line(e), self.line(f)];
        let order = |rank: u32| {
            let (y, z) = (self.height(r, lines[0], rank), self.height(s, lines[1], rank));
            if (y - z).abs() > self.slack { y.total_cmp(&z) } else { Ordering::Equal }
        };
        let fans = [r[0] == s[0] && r[0] == left, r[1] == s[1] && r[1] == right];
        match fans {
            [false, false] => {
                let order_left = order(left);
                order_left == Ordering::Equal || order_left != order(right)
            }
            [true, _] => order(right) == Ordering::Equal,
            [_, true] => order(left) == Ordering::Equal,
        }
    }

    #[inline]
    fn line(&self, bar: Bar) -> Line {
        let [a, b] = bar.ranks.map(|rank| self.ends[rank as usize]);
        let is_slanted = self.has_slopes && a.x != b.x;
        Line { start: a, slope: if is_slanted { (b.y - a.y) / (b.x - a.x) } else { f64::NAN } }
    }

    /// Where an edge has a rank, as a height; wrong by a quarter of the slack at most.
    #[inline]
    fn height(&self, ranks: [u32; 2], line: Line, rank: u32) -> f64 {
        let p = self.ends[rank as usize];
        if ranks.contains(&rank) { p.y } else { self.height_at(ranks, line, p) }
    }

    /// The same, for a rank between the edge's ends.
    #[inline]
    fn height_inside(&self, span: &Span, rank: u32) -> f64 {
        self.height_at(span.bar.ranks, span.line, self.ends[rank as usize])
    }

    /// The slope is wrong by 3u of itself, its product by 5u, which is 10u times the larger height at most, and the sum by
    /// 2u of that (u = 2^-53).
    #[inline]
    fn height_at(&self, ranks: [u32; 2], line: Line, p: DVec2) -> f64 {
        if line.slope.is_nan() {
            self.height_anywhere(ranks, p)
        } else {
            line.start.y + (p.x - line.start.x) * line.slope
        }
    }

    /// The same for all coordinates. With t the part of the way: t is wrong by 3u t, 1 - t by 3u t + u, the products and
    /// their sum by 2u each: less than 10u times the larger height.
    #[cold]
    fn height_anywhere(&self, ranks: [u32; 2], p: DVec2) -> f64 {
        let [a, b] = ranks.map(|rank| self.ends[rank as usize]);
        let run = b.x - a.x;
        if run == 0.0 {
            return p.y;
        }
        let halves = |x: f64| x * 0.5 - a.x * 0.5;
        let t = if run.is_finite() { (p.x - a.x) / run } else { halves(p.x) / halves(b.x) };
        a.y * (1.0 - t) + b.y * t
    }
}

/// Coordinates between this and its inverse have slopes.
const LEAST: f64 = f64::from_bits((1023 - 400) << 52);

/// `64u`, see [`Slabs::height`]: rungs keep their computed order between the slab's sides, too.
const SLACK: f64 = 64.0 * (f64::EPSILON / 2.0);

/// Whether a span lies below another one at a side, or both end there in one point.
#[inline]
fn is_below(a: &Span, b: &Span, side: usize, slack: f64) -> bool {
    a.heights[side] + slack < b.heights[side] || (a.is_end[side] && b.is_end[side])
}
