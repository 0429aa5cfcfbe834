//! The azimuths between which what is seen is smooth.
use super::Sighted;
use glam::DVec3;
use std::f64::consts::PI;

/// An arc on the sphere of directions: an edge, or the whole circle where two planes meet.
#[derive(Clone, Copy, Debug)]
struct Arc {
    /// Unit normal of its plane.
    normal: DVec3,
    ends: Option<[DVec3; 2]>,
}

/// How far outside of an arc a crossing may seem to lie: breaks too many only cost time.
const MARGIN: f64 = 1e-9;

impl Arc {
    fn of(a: DVec3, b: DVec3) -> Option<Arc> {
        let normal = a.cross(b).try_normalize()?;
        Some(Arc { normal, ends: Some([a.normalize(), b.normalize()]) })
    }

    fn holds(&self, direction: DVec3) -> bool {
        self.ends.is_none_or(|[a, b]| {
            a.cross(direction).dot(self.normal) > -MARGIN && direction.cross(b).dot(self.normal) > -MARGIN
        })
    }
}

/// The azimuths of vertices, of crossings on the sphere, of edges at the horizon; sorted, from -pi to pi.
pub(super) fn azimuths(target: &Sighted, occluders: &[Sighted]) -> Vec<f64> {
    let all = || std::iter::once(target).chain(occluders);
    let mut arcs: Vec<Arc> = all().flat_map(Sighted::edges).filter_map(|(a, b)| Arc::of(a, b)).collect();
    // Where an occluder passes through the target's plane it begins to hide.
    let meet = |o: &Sighted| (o.nearness - target.nearness).try_normalize();
    arcs.extend(occluders.iter().filter_map(meet).map(|normal| Arc { normal, ends: None }));
    arcs.push(Arc { normal: DVec3::Z, ends: None });
    let mut found = vec![-PI, PI];
    found.extend(all().flat_map(|polygon| polygon.loops.iter().flatten()).map(|p| p.y.atan2(p.x)));
    for (i, a) in arcs.iter().enumerate() {
        found.extend(arcs[..i].iter().flat_map(|b| crossings(a, b)).map(|d| d.y.atan2(d.x)));
    }
    found.extend(arcs.iter().flat_map(near_the_horizon));
    found.sort_by(f64::total_cmp);
    found
}

/// Azimuths around the two at which a circle that passes close to the zenith drops to the horizon: it does so within an
/// angle that no rule would find.
fn near_the_horizon(arc: &Arc) -> Vec<f64> {
    let flat = arc.normal.truncate();
    let within = arc.normal.z.abs() / flat.length();
    let mut found = Vec::new();
    let mut step = within;
    while step > 0.0 && step < 0.5 {
        for side in [flat.perp(), -flat.perp()] {
            found.extend([side.to_angle() - step, side.to_angle() + step]);
        }
        step *= 8.0;
    }
    found.retain(|azimuth| azimuth.abs() < PI);
    found
}

/// The directions not below the horizon at which two arcs cross.
fn crossings(a: &Arc, b: &Arc) -> impl Iterator<Item = DVec3> {
    let cross = a.normal.cross(b.normal).try_normalize();
    let both = cross.into_iter().flat_map(|d| [d, -d]);
    both.filter(|d| d.z > -MARGIN && a.holds(*d) && b.holds(*d))
}
