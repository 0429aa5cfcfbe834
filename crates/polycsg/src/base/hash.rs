//! A number for a point, to tell it from others quickly. Equal numbers are always checked by the points.

use glam::DVec2;

/// The bits of both coordinates, mixed: also in sums of two, which tell edges.
#[inline]
pub(crate) fn mixed(p: DVec2) -> u64 {
    let product = p.x.to_bits().wrapping_mul(0xff51_afd7_ed55_8ccd) ^ p.y.to_bits().rotate_left(32);
    let product = (product ^ product >> 29).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    product ^ product >> 32
}
