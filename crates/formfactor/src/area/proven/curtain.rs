//! Planes through a point that moves in a cell and a fixed edge, where they meet, and on which side of others that is.
use super::chart::{Chart, Varying};
use crate::numeric::taylor::Taylor;
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
        Sign::Inside(below + ROUNDED)
    } else if below >= 1.0 - TOUCH {
        Sign::Outside(1.0 - below + ROUNDED)
    } else {
        Sign::Unclear(Divide::Line(line))
    }
}

/// What a share of a cell may be off by.
const ROUNDED: f64 = 1e-12;

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
    fn from_end(&self, point: DVec3) -> Option<(DVec3, bool)> {
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
    fn side_by_end(&self, chart: &Chart, near: &Self, far: &Self, end: DVec3, deviation: f64) -> Option<Sign> {
        let ((other, is_first), (near_other, near_is_first)) = (self.from_end(end)?, near.from_end(end)?);
        let volume = Self { ends: [end, other] }.side(chart, near_other, deviation);
        let sign = volume.times(far.side(chart, end, deviation));
        Some(if is_first == near_is_first { sign.turned() } else { sign })
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
        let normals = [self, &outward, &inward].map(|curtain| curtain.normal(chart));
        let least = deviation * normals.map(reach).iter().product::<f64>() / chart_size(chart, self);
        sign_of(chart, &determinant(normals), least)
    }

    /// Where a corner is.
    pub(super) fn side_of(&self, chart: &Chart, bearing: &Bearing, deviation: f64) -> Sign {
        match bearing {
            Bearing::Point(point) => self.side(chart, *point, deviation),
            Bearing::Crossing(both) if both.contains(self) => Sign::On,
            Bearing::Crossing(both) => self.side_of_crossing(chart, *both, deviation),
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
        Sign::Inside(outside + ROUNDED)
    } else if inside <= CURVED {
        Sign::Outside(inside + ROUNDED)
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

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [[1, 2], [2, 0], [0, 1]].map(|[i, j]| a[i] * b[j] - a[j] * b[i])
}

/// Of three vectors.
pub(super) fn determinant([a, b, c]: [Varying; 3]) -> Taylor {
    dot(&models(a), &cross(&models(b), &models(c)))
}
