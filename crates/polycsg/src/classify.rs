//! classify
use crate::{Membership, Region};
use glam::DVec2;
/// piece of the segment
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval { /// a
 pub start: DVec2, /// b
 pub end: DVec2, /// m
 pub membership: Membership }
/// stub: errs on a non-finite segment
pub fn classify(_segment: [DVec2; 2], _region: &Region) -> Result<Vec<Interval>, crate::Error> { unimplemented!() }
