//! Pairs that are far apart: a few samples of the plain kernel.
use crate::scene::surfaces::Surface;
use crate::shapes::cell::Nodes;
use glam::DVec3;
use std::f64::consts::PI;

/// The rule errs by less than this times the fourth power of the surfaces' radii over their distance, by the largest value that the
/// kernel can have there.
pub(super) const ERROR: f64 = 0.1;

/// The double integral of cos cos / (pi r^2) over two surfaces by four nodes of each cell.
pub(super) fn exchange(one: &Surface, other: &Surface) -> f64 {
    let normals = [one.face[1], other.face[1]];
    one.nodes.iter().map(|p| other.nodes.iter().map(|q| cells(p, q, normals)).sum::<f64>()).sum()
}

/// Over two cells.
fn cells(p: &Nodes, q: &Nodes, [n, m]: [DVec3; 2]) -> f64 {
    let mut sums = [0.0; 4];
    for i in 0..4 {
        for j in 0..4 {
            let (x, y, z) = (q.x[j] - p.x[i], q.y[j] - p.y[i], q.z[j] - p.z[i]);
            let square = x * x + y * y + z * z;
            let rise = n.x * x + n.y * y + n.z * z;
            let fall = m.x * x + m.y * y + m.z * z;
            sums[j] -= p.weights[i] * q.weights[j] * rise * fall / (square * square);
        }
    }
    sums.iter().sum::<f64>() / PI
}
