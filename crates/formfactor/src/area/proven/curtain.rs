//! Planes through a point that moves in a cell and a fixed edge, where they meet, and on which side of others that is.
use super::chart::{Chart, Varying};
use crate::numeric::taylor::{TERMS, Taylor};
use glam::DVec3;

/// The plane through the point and an edge; inside is to the left as the point sees the edge run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Curtain {
    pub(super) ends: [DVec3; 2],
}

/// A corner of what the point sees: a direction.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bearing {
    /// To a vertex.
    Point(DVec3),
    /// To where an edge seems to cross the next one.
    Crossing([Curtain; 2]),
    /// Away from where an edge seems to cross the next one.
    Opposite([Curtain; 2]),
}

/// On which side of a curtain a corner is, for all points of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sign {
    /// Inside, but for points of a share of the cell.
    Inside(f64),
    /// Outside, but for points of a share of the cell.
    Outside(f64),
    /// On it, up to the deviation.
    On,
    /// Inside for some, outside for others.
    Unclear(Divide),
}

/// What parts a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Divide {
    /// `c + a u + b v` changes its sign.
    Line([f64; 3]),
    /// A curve, or what is so near that its series does not converge: only smaller cells help.
    Curve,
}

/// A linear sign that is wrong on no more than this share of the cell counts.
const TOUCH: f64 = 1e-6;

/// A sign of higher degree that may be wrong on no more than this share of the cell counts.
const CURVED: f64 = 0.5;

impl Bearing {
    /// The direction from the middle of a cell.
    pub(super) fn middle(&self, chart: &Chart) -> DVec3 {
        let normals = |both: &[Curtain; 2]| both.map(|curtain| curtain.normal(chart)[0]);
        match self {
            Self::Point(point) => chart.toward(*point)[0],
            Self::Crossing(both) => normals(both)[1].cross(normals(both)[0]),
            Self::Opposite(both) => normals(both)[0].cross(normals(both)[1]),
        }
    }
}

impl Sign {
    /// Of a product.
    fn times(self, other: Self) -> Self {
        match (self, other) {
            (Self::Unclear(_), _) => self,
            (_, Self::Unclear(_)) => other,
            (Self::On, _) | (_, Self::On) => Self::On,
            (Self::Inside(a), Self::Inside(b)) | (Self::Outside(a), Self::Outside(b)) => Self::Inside(a + b),
            (Self::Inside(a), Self::Outside(b)) | (Self::Outside(a), Self::Inside(b)) => Self::Outside(a + b),
        }
    }

    fn turned(self) -> Self {
        self.times(Self::Outside(0.0))
    }

    /// The share of the cell on which it may be wrong.
    pub(super) fn doubt(self) -> f64 {
        match self {
            Self::Inside(share) | Self::Outside(share) => share,
            Self::On | Self::Unclear(_) => 0.0,
        }
    }
}

/// The sign of `c + a u + b v` on a cell; magnitudes up to `least` are roundings.
pub(super) fn linear_sign(chart: &Chart, line: [f64; 3], least: f64) -> Sign {
    let (low, high) = chart.range(line);
    if low >= -least && high <= least {
        return Sign::On;
    }
    if low >= -least {
        return Sign::Inside(0.0);
    }
    if high <= least {
        return Sign::Outside(0.0);
    }
    let below = chart.share_below(line);
    if below <= TOUCH {
        Sign::Inside(doubt(below))
    } else if below >= 1.0 - TOUCH {
        Sign::Outside(doubt(1.0 - below))
    } else {
        Sign::Unclear(Divide::Line(line))
    }
}

/// A share of a cell, raised by what roundings may change; none is none.
fn doubt(share: f64) -> f64 {
    if share > 0.0 { share + 1e-12 } else { 0.0 }
}

impl Curtain {
    /// Its normal inward, as long as the edge's line is away from the point.
    pub(super) fn normal(&self, chart: &Chart) -> Varying {
        let way = (self.ends[1] - self.ends[0]).normalize_or_zero();
        let [at, u, v] = chart.toward(self.ends[0]);
        [way.cross(at), way.cross(u), way.cross(v)]
    }

    /// Where `point` is.
    pub(super) fn side(&self, chart: &Chart, point: DVec3, deviation: f64) -> Sign {
        if self.ends.contains(&point) {
            return Sign::On;
        }
        let depth = self.depth(chart, point);
        linear_sign(chart, depth, 2.0 * deviation * reach(self.normal(chart)))
    }

    /// Its normal times the way to `point`.
    pub(super) fn depth(&self, chart: &Chart, point: DVec3) -> [f64; 3] {
        let way = point - self.ends[0];
        self.normal(chart).map(|n| n.dot(way))
    }

    /// The other end, if `point` is one, and whether `point` is the first.
    fn other_end(&self, point: DVec3) -> Option<(DVec3, bool)> {
        let [a, b] = self.ends;
        if a == point { Some((b, true)) } else { (b == point).then_some((a, false)) }
    }

    /// The end that two have in common.
    fn shared_end(&self, other: &Self) -> Option<DVec3> {
        self.ends.into_iter().find(|end| other.ends.contains(end))
    }

    /// On which side of this one the crossing of two others is, where this one and `near` have an end in common.
    ///
    /// With normals N = b x a the crossing of I and O is along O x I, and W . (O x I) = I . (W x O). Where W and O run from
    /// q to w and to o, W x O is -[w, q, o] q.
    fn side_by_end(
        &self,
        chart: &Chart,
        near: &Self,
        far: &Self,
        end: DVec3,
        deviation: f64,
    ) -> Option<Sign> {
        let ((other, is_first), (near_other, near_is_first)) = (self.other_end(end)?, near.other_end(end)?);
        let volume = Self { ends: [end, other] }.side(chart, near_other, deviation);
        let sign = volume.times(far.side(chart, end, deviation));
        Some(if is_first == near_is_first { sign.turned() } else { sign })
    }

    /// The same where this one and `near` run along parallel edges: where W runs along w and O along w or -w, W x O is [w, a, b] w or
    /// its opposite, for a and b the ways to a point of each, and [w, a, b] is W . b.
    fn side_by_way(&self, chart: &Chart, near: &Self, far: &Self, deviation: f64) -> Option<Sign> {
        let [way, near_way] = [self, near].map(|curtain| curtain.ends[1] - curtain.ends[0]);
        if way.cross(near_way).length() > deviation * way.length() {
            return None;
        }
        let along = way.normalize_or_zero();
        let normal = far.normal(chart);
        let across = linear_sign(chart, normal.map(|n| n.dot(along)), 2.0 * deviation);
        let sign = self.side(chart, near.ends[0], deviation).times(across);
        Some(if way.dot(near_way) > 0.0 { sign } else { sign.turned() })
    }

    /// On which side of this one the crossing of two others is.
    fn side_of_crossing(&self, chart: &Chart, [inward, outward]: [Self; 2], deviation: f64) -> Sign {
        let by_end = |near: &Self, far: &Self| {
            let end = self.shared_end(near)?;
            self.side_by_end(chart, near, far, end, deviation)
        };
        if let Some(sign) = by_end(&outward, &inward) {
            return sign;
        }
        if let Some(sign) = by_end(&inward, &outward) {
            return sign.turned();
        }
        if let Some(sign) = self.side_by_way(chart, &outward, &inward, deviation) {
            return sign;
        }
        if let Some(sign) = self.side_by_way(chart, &inward, &outward, deviation) {
            return sign.turned();
        }
        let normals = [self, &outward, &inward].map(|curtain| curtain.normal(chart));
        let least = deviation * normals.map(reach).iter().product::<f64>() / chart_size(chart, self);
        sign_of(chart, &determinant(normals), least)
    }

    /// Where a corner is.
    pub(super) fn side_of(&self, chart: &Chart, bearing: &Bearing, deviation: f64) -> Sign {
        match bearing {
            Bearing::Point(point) => self.side(chart, *point, deviation),
            Bearing::Crossing(both) | Bearing::Opposite(both) if both.contains(self) => Sign::On,
            Bearing::Crossing(both) => self.side_of_crossing(chart, *both, deviation),
            Bearing::Opposite(both) => self.side_of_crossing(chart, *both, deviation).turned(),
        }
    }
}

/// A length that makes a deviation an angle: how far an edge is from the middle of the cell.
fn chart_size(chart: &Chart, curtain: &Curtain) -> f64 {
    chart.toward(curtain.ends[0])[0].length().max(chart.toward(curtain.ends[1])[0].length())
}

/// A bound on its length.
fn reach(vector: Varying) -> f64 {
    vector.iter().map(|v| v.length()).sum()
}

/// The sign of a polynomial: it is clear where its linear part outweighs the rest.
fn sign_of(chart: &Chart, model: &Taylor, least: f64) -> Sign {
    let [c, a, b] = [0, 1, 2].map(|i| model.terms[i]);
    let bend = model.bend();
    let (low, high) = chart.range([c, a, b]);
    if low - bend >= -least && high + bend <= least {
        return Sign::On;
    }
    let outside = chart.share_below([c - bend, a, b]);
    let inside = chart.share_below([-c - bend, -a, -b]);
    if outside <= CURVED && outside <= inside {
        Sign::Inside(doubt(outside))
    } else if inside <= CURVED {
        Sign::Outside(doubt(inside))
    } else {
        Sign::Unclear(Divide::Curve)
    }
}

pub(super) type Vector = [Taylor; 3];

/// A varying vector as models of its components.
pub(super) fn models([c, a, b]: Varying) -> Vector {
    [0, 1, 2].map(|i| Taylor::linear([c[i], a[i], b[i]]))
}

pub(super) fn dot(a: &Vector, b: &Vector) -> Taylor {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The terms of a product of two, of degree 2.
fn product([p, pu, pv]: Varying, [q, qu, qv]: Varying) -> [DVec3; 6] {
    [
        p.cross(q),
        p.cross(qu) + pu.cross(q),
        p.cross(qv) + pv.cross(q),
        pu.cross(qu),
        pu.cross(qv) + pv.cross(qu),
        pv.cross(qv),
    ]
}

/// The cross product of two, `scale` times as long.
pub(super) fn cross(p: Varying, q: Varying) -> (Vector, f64) {
    let terms = product(p, q);
    let scale = terms[0].length().recip();
    let size = reach(p) * reach(q) * scale;
    let component = |i: usize| {
        let mut all = [0.0; TERMS];
        all.iter_mut().zip(terms).for_each(|(term, vector)| *term = vector[i] * scale);
        Taylor::polynomial(all, size)
    };
    ([0, 1, 2].map(component), scale)
}

/// p . (q x r)
pub(super) fn determinant([p, q, r]: [Varying; 3]) -> Taylor {
    let [c, u, v, uu, uv, vv] = product(q, r);
    let [p, pu, pv] = p;
    let terms = [
        p.dot(c),
        p.dot(u) + pu.dot(c),
        p.dot(v) + pv.dot(c),
        p.dot(uu) + pu.dot(u),
        p.dot(uv) + pu.dot(v) + pv.dot(u),
        p.dot(vv) + pv.dot(v),
        pu.dot(uu),
        pu.dot(uv) + pv.dot(uu),
        pu.dot(vv) + pv.dot(uv),
        pv.dot(vv),
    ];
    Taylor::polynomial(terms, reach([p, pu, pv]) * reach(q) * reach(r))
}
