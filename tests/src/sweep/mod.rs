//! Form factors by an angular sweep: no projection on the target, no polygon Booleans, no contour sum.
//!
//! With theta from dA's normal and phi around it, F = 1/(2 pi) integral over phi of the measure of what is seen in
//! s = sin^2(theta). For each phi the half-plane through the normal meets every polygon in segments, which are intervals
//! of s; from the target's are taken those where an occluder is nearer. Between neighbouring azimuths at which a vertex
//! lies or two edges cross, the measure is smooth in phi: Gauss's rule, halved until it agrees with itself.
//!
//! What only coordinates can decide (which side dA is on, what is coplanar) is decided in rationals.
mod breaks;
mod half_plane;
mod integrate;
mod planes;

use glam::DVec3;

/// Loops of a planar polygon, even-odd; as a target, loop 0 is counter-clockwise seen from the front.
pub type Loops = Vec<Vec<DVec3>>;

/// A form factor and what the sweep says of its own error: its last two steps' difference, and rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// The form factor.
    pub value: f64,
    /// An estimate of its error.
    pub error: f64,
}

/// The form factor from a differential area at `position` that looks along `normal` to `target` past `occluders`.
///
/// Vertices must be exactly coplanar. Rules as in `formfactor`: occluders block for 0 < t < 1, none that is coplanar with
/// the target or whose plane contains dA; dA on or behind the target's plane sees 0.
pub fn form_factor(position: DVec3, normal: DVec3, target: &Loops, occluders: &[Loops]) -> Sweep {
    if !planes::is_before(target, position) {
        return Sweep { value: 0.0, error: 0.0 };
    }
    let blocks = |occluder: &&Loops| {
        !planes::contains(occluder, &[position]) && !planes::contains(target, &occluder.concat())
    };
    let frame = frame(normal);
    let sighted = |loops: &Loops| Sighted::new(loops, position, &frame);
    let occluders: Vec<Sighted> = occluders.iter().filter(blocks).map(sighted).collect();
    let target = sighted(target);
    let breaks = breaks::azimuths(&target, &occluders);
    integrate::over(&breaks, |azimuth| half_plane::seen(azimuth, &target, &occluders))
}

/// A polygon as dA sees it: z along the normal.
#[derive(Clone, Debug)]
struct Sighted {
    loops: Loops,
    /// A direction d meets the plane at 1/t = nearness . d.
    nearness: DVec3,
}

impl Sighted {
    fn new(loops: &Loops, position: DVec3, frame: &[DVec3; 3]) -> Sighted {
        let local = |p: &DVec3| DVec3::from(frame.map(|axis| axis.dot(*p - position)));
        let loops: Loops = loops.iter().map(|l| l.iter().map(local).collect()).collect();
        let normal = planes::newell(&loops[0]);
        Sighted { nearness: normal / normal.dot(loops[0][0]), loops }
    }

    fn edges(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        self.loops.iter().flat_map(|l| l.iter().copied().zip(l.iter().copied().cycle().skip(1)))
    }
}

fn frame(normal: DVec3) -> [DVec3; 3] {
    let normal = normal.normalize();
    let (u, v) = normal.any_orthonormal_pair();
    [u, v, normal]
}
