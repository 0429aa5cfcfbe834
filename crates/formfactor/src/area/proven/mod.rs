//! Form factors between polygons as intervals that hold for certain.
//!
//! The source is cut into cells from which the target and the shadows on it have one shape. There the form factor from a point is
//! an analytic function of the point, and [Taylor models](crate::numeric::taylor) of its parts say how far a polynomial may be from
//! it anywhere on the cell. What a cell is not known to see lies between nothing and all of the target. The cell with the largest
//! error is next: cut along the line on which a vertex seems to meet an edge, or halved.
mod chart;
mod curtain;
mod factor;
mod sector;
mod sight;

use super::clip::before;
use super::integral::{Allowed, Integral, most};
use super::patch::{MOST_CORNERS, Patch};
use super::point::Near;
use crate::numeric::taylor::Taylor;
use crate::scene::apart::are_apart;
use crate::scene::surfaces::Surface;
use crate::shapes::cell::fan;
use chart::Chart;
use curtain::Divide;
use factor::Sight;
use glam::DVec3;
use sector::{Cast, Sector, cast};
use sight::Visible;
use std::{cmp::Ordering, collections::BinaryHeap, rc::Rc};

/// A cell and what is known of it.
#[derive(Debug)]
struct Known {
    patch: Patch,
    /// The integral lies within `error` of `value`.
    value: f64,
    error: f64,
    /// No point of it has a larger form factor.
    most: f64,
    /// The occluders that may matter.
    near: Rc<[usize]>,
    /// Whether it sees one shape, so that only halves are known better.
    is_seen: bool,
    number: u64,
}

impl PartialEq for Known {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Known {}

impl PartialOrd for Known {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Known {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error).then(other.number.cmp(&self.number))
    }
}

/// The integral of the point form factors over a source.
#[derive(Debug)]
pub(super) struct Proof<'p> {
    normal: DVec3,
    target: Vec<Vec<DVec3>>,
    occluders: &'p [Near<'p>],
    /// How far what is given may lie from where it stands.
    deviation: f64,
    cells: BinaryHeap<Known>,
    /// The sum of the errors as cells come and go, up to rounding.
    error: f64,
    value: f64,
    count: u64,
    evaluations: u64,
}

impl<'p> Proof<'p> {
    pub(super) fn new(from: &Surface, to: &Surface, occluders: &'p [Near<'p>], deviation: f64) -> Self {
        let mut proof = Self {
            normal: from.face[1],
            target: before(&to.pieces, from.face),
            occluders,
            deviation,
            cells: BinaryHeap::new(),
            error: 0.0,
            value: 0.0,
            count: 0,
            evaluations: 0,
        };
        let most = most(from, to);
        let mut near: Vec<usize> = (0..occluders.len()).collect();
        let size = |i: &usize| occluders[*i].radius / occluders[*i].middle.distance(from.middle);
        // Large shadows first: what they hide is left out of the sums over the others.
        near.sort_by(|i, j| size(j).total_cmp(&size(i)));
        let near: Rc<[usize]> = near.into();
        if !proof.target.is_empty() {
            for piece in before(&from.pieces, to.face) {
                for cell in fan(&piece) {
                    proof.open(Patch::of(&cell), most, &near);
                }
            }
        }
        proof
    }

    /// Refines until the error is within what is allowed or the evaluations end; `None` when stopped. The error has `known` in it,
    /// and what is small beside that is not refined.
    pub(super) fn integrate(
        mut self,
        known: f64,
        allowed: &Allowed,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<Integral> {
        while self.evaluations < allowed.evaluations {
            if is_cancelled() {
                return None;
            }
            let tolerance = allowed.error(self.value, self.value) * (1.0 - SUMMED) - known;
            if self.error <= tolerance.max(known / 16.0) {
                break;
            }
            let Some(worst) = self.cells.pop().filter(|worst| worst.error > 0.0) else { break };
            self.value -= worst.value;
            self.error -= worst.error;
            self.refine(&worst);
        }
        let mut cells = self.cells.into_vec();
        cells.sort_unstable_by_key(|cell| cell.number);
        let value = cells.iter().map(|cell| cell.value).sum();
        let error = cells.iter().map(|cell| cell.error).sum::<f64>() * (1.0 + SUMMED) + known;
        Some(Integral { value, error, evaluations: self.evaluations })
    }

    /// Adds a cell of which nothing is known but what it sees at most.
    fn open(&mut self, patch: Patch, most: f64, near: &Rc<[usize]>) {
        if patch.count + 1 >= MOST_CORNERS {
            fan(patch.corners()).iter().for_each(|cell| self.open(Patch::of(cell), most, near));
            return;
        }
        let half = most * patch.area() / 2.0;
        self.add(Known {
            patch,
            value: half,
            error: half,
            most,
            near: near.clone(),
            is_seen: false,
            number: 0,
        });
    }

    fn add(&mut self, mut cell: Known) {
        self.count += 1;
        cell.number = self.count;
        self.value += cell.value;
        self.error += cell.error;
        self.cells.push(cell);
    }

    /// Looks from a cell, or from its parts.
    fn refine(&mut self, cell: &Known) {
        let chart = Chart::of(cell.patch);
        if cell.is_seen {
            self.part(&chart, Divide::Curve, cell.most, &cell.near);
            return;
        }
        self.evaluations += 1;
        let near = self.near(&chart, &cell.near);
        let sight = Sight { chart: &chart, normal: self.normal, deviation: self.deviation };
        let wholes: Option<Vec<Taylor>> =
            self.sectors().map(|sector| sight.factor(&sector.corners)).collect();
        let Some(wholes) = wholes else {
            self.part(&chart, Divide::Curve, cell.most, &near);
            return;
        };
        let most = wholes.iter().map(Taylor::reach).sum::<f64>().min(cell.most);
        match self.look(&sight, &near) {
            Ok(sum) => self.add(known(cell, &chart, &sum, most, near)),
            Err(divide) => self.part(&chart, divide, most, &near),
        }
    }

    /// What all of a cell sees past the occluders that may matter.
    fn look(&self, sight: &Sight, near: &[usize]) -> Result<Visible, Divide> {
        let casts: Result<Vec<Option<Cast>>, Divide> =
            near.iter().map(|i| cast(sight.chart, &self.occluders[*i], self.deviation)).collect();
        let casts = casts?;
        let shadows: Vec<&Cast> = casts.iter().flatten().collect();
        let mut sum = Visible { model: Taylor::ZERO, stray: 0.0 };
        for sector in self.sectors() {
            let own = sight.rest(&sector, &shadows)?;
            sum = Visible { model: sum.model + own.model, stray: sum.stray + own.stray };
        }
        Ok(sum)
    }

    /// The pieces of the target.
    fn sectors(&self) -> impl Iterator<Item = Sector> {
        self.target.iter().filter_map(|piece| Sector::of(piece, self.deviation))
    }

    /// Those of some occluders that reach between a cell and the target.
    fn near(&self, chart: &Chart, among: &[usize]) -> Rc<[usize]> {
        let hull: Vec<DVec3> =
            chart.patch.corners().iter().chain(self.target.iter().flatten()).copied().collect();
        let middle = hull.iter().sum::<DVec3>() / hull.len() as f64;
        let is_near = |i: &&usize| {
            let occluder = &self.occluders[**i];
            !are_apart(&hull, &occluder.corners, occluder.middle - middle)
        };
        among.iter().filter(is_near).copied().collect()
    }

    /// Opens the parts of a cell, which see no more than `most`.
    fn part(&mut self, chart: &Chart, divide: Divide, most: f64, near: &Rc<[usize]>) {
        let parts = match divide {
            Divide::Line(line) => chart.cut(line),
            Divide::Curve => {
                let occluders = near.iter().flat_map(|i| &self.occluders[*i].corners);
                let points = self.target.iter().flatten().chain(occluders).copied();
                chart.halves(chart.turning_axis(points))
            }
        };
        parts.into_iter().filter(|part| part.count > 2).for_each(|part| self.open(part, most, near));
    }
}

/// What sums over cells may be off by, as a share of the sum.
const SUMMED: f64 = 1e-9;

/// A cell that sees one shape.
fn known(cell: &Known, chart: &Chart, sum: &Visible, most: f64, near: Rc<[usize]>) -> Known {
    let [value, error] = chart.integral(&sum.model);
    let error = error + sum.stray * chart.area;
    let (low, high) = ((value - error).max(0.0), (value + error).min(most * chart.area));
    let value = f64::midpoint(low, high);
    let error = (high - value).max(value - low);
    Known { patch: cell.patch, value, error, most, near, is_seen: true, number: 0 }
}
