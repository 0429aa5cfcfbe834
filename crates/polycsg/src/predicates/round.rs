//! The crossing of two edges, each coordinate rounded once to the nearest double.

use super::exact::{Ratio, scaled_integers};
use super::{Segment, order::lexicographic};
use crate::double::Double;
use glam::DVec2;
use std::cmp::Ordering;

/// The crossing of two edges that cross properly, both coordinates correctly rounded (ties to even).
///
/// Depends on the two edges as point sets only, not on their order or direction.
pub(crate) fn crossing_point(e: Segment, f: Segment) -> DVec2 {
    crossing_in_double_double(e, f).unwrap_or_else(|| {
        let [x, y] = crossing_ratio(e, f);
        DVec2::new(x.to_f64(), y.to_f64())
    })
}

/// The exact crossing of two edges that cross properly.
#[cold]
pub(crate) fn crossing_ratio(e: Segment, f: Segment) -> [Ratio; 2] {
    let ([ax, ay, bx, by, cx, cy, dx, dy], scale) =
        scaled_integers([e[0].x, e[0].y, e[1].x, e[1].y, f[0].x, f[0].y, f[1].x, f[1].y]);
    let n = (&cx - &ax) * (&dy - &ay) - (&cy - &ay) * (&dx - &ax);
    let m = (&cx - &bx) * (&dy - &by) - (&cy - &by) * (&dx - &bx);
    let w = &n - m;
    [
        Ratio::new(&ax * &w + (bx - &ax) * &n, w.clone(), scale),
        Ratio::new(&ay * &w + (by - &ay) * &n, w, scale),
    ]
}

/// 2^-98: more than the relative error of any of the few operations in a row below.
const RELATIVE: f64 = f64::from_bits((1023 - 98) << 52);

/// Where no operation below overflows and no low part is lost: coordinates are 0 or in 2^-200 … 2^200.
fn in_window(x: f64) -> bool {
    const LOW: f64 = f64::from_bits((1023 - 200) << 52);
    const HIGH: f64 = f64::from_bits((1023 + 200) << 52);
    x == 0.0 || (LOW..=HIGH).contains(&x.abs())
}

/// The doubled area of (f, p), and the sum of the two products' sizes.
fn area(f: Segment, p: DVec2) -> (Double, f64) {
    let (ux, uy) = (Double::sum(f[0].x, -p.x), Double::sum(f[0].y, -p.y));
    let (vx, vy) = (Double::sum(f[1].x, -p.x), Double::sum(f[1].y, -p.y));
    let (l, r) = (ux.times(vy), uy.times(vx));
    (l.minus(r), l.hi.abs() + r.hi.abs())
}

/// The rounded crossing, when double-double arithmetic proves both roundings.
pub(super) fn crossing_in_double_double(e: Segment, f: Segment) -> Option<DVec2> {
    // One direction of e, so that the answer has one history; the answer itself is the same from any.
    let e = if lexicographic(e[0], e[1]) == Ordering::Greater { [e[1], e[0]] } else { e };
    if ![e[0], e[1], f[0], f[1]].iter().all(|p| in_window(p.x) && in_window(p.y)) {
        return None;
    }
    let ((n, size_n), (m, size_m)) = (area(f, e[0]), area(f, e[1]));
    let w = n.minus(m);
    let t = n.over(w);
    // n and m have opposite signs: |w| = |n| + |m|, and an error d in either moves t by at most 2 d / |w|.
    let t_error = RELATIVE * (2.0 * (size_n + size_m) / w.hi.abs() + 1.0);
    let coordinate = |a: f64, b: f64| {
        let run = Double::sum(b, -a);
        let at = Double { hi: a, lo: 0.0 }.plus(run.times(t));
        let error = t_error * run.hi.abs() + RELATIVE * (a.abs() + b.abs());
        let stays = |lo: f64| at.hi + lo == at.hi;
        (stays(at.lo + 2.0 * error) && stays(at.lo - 2.0 * error)).then_some(at.hi)
    };
    // On an axis-parallel edge one coordinate needs no arithmetic.
    let x = if f[0].x == f[1].x { f[0].x } else { coordinate(e[0].x, e[1].x)? };
    let y = if f[0].y == f[1].y { f[0].y } else { coordinate(e[0].y, e[1].y)? };
    Some(DVec2::new(x, y))
}
