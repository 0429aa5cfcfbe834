//! csg
use crate::{Boundary, Error, Region, Scratch};
use glam::DVec2;
use std::ops::{BitAnd, BitOr, BitXor, Sub};
/// stub
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FillRule { /// e
 EvenOdd, /// n
 NonZero, /// p
 Positive }
/// stub
#[derive(Clone, Debug)]
pub struct Csg<'a> { r: Option<&'a Region> }
impl<'a> From<&'a Region> for Csg<'a> { fn from(r: &'a Region) -> Self { Csg { r: Some(r) } } }
impl<'a> Csg<'a> {
    /// raw rings as a leaf
    pub fn rings<R, P>(_rings: R, _rule: FillRule) -> Result<Csg<'a>, Error>
    where R: IntoIterator, R::Item: AsRef<[P]>, P: Copy + Into<DVec2> { unimplemented!() }
    /// union of many (regions by reference or Csg by value); empty iterator: the empty set
    pub fn union<I>(_operands: I) -> Csg<'a> where I: IntoIterator, I::Item: Into<Csg<'a>> { unimplemented!() }
    /// intersection of many; empty iterator: the empty set
    pub fn intersection<I>(_operands: I) -> Csg<'a> where I: IntoIterator, I::Item: Into<Csg<'a>> { unimplemented!() }
    /// odd number of operands
    pub fn symmetric_difference<I>(_operands: I) -> Csg<'a> where I: IntoIterator, I::Item: Into<Csg<'a>> { unimplemented!() }
    /// eval
    pub fn evaluate(&self) -> Region { unimplemented!() }
    /// eval with reused buffers
    pub fn evaluate_in(&self, _scratch: &mut Scratch) -> Region { let _ = self.r; unimplemented!() }
    /// directed pieces, unchecked, no rings
    pub fn boundary<'s>(&self, _scratch: &'s mut Scratch) -> Boundary<'s> { unimplemented!() }
}
impl<'a> BitOr for Csg<'a> { type Output = Self; fn bitor(self, _o: Self) -> Self { unimplemented!() } }
impl<'a> BitAnd for Csg<'a> { type Output = Self; fn bitand(self, _o: Self) -> Self { unimplemented!() } }
impl<'a> BitXor for Csg<'a> { type Output = Self; fn bitxor(self, _o: Self) -> Self { unimplemented!() } }
impl<'a> Sub for Csg<'a> { type Output = Self; fn sub(self, _o: Self) -> Self { unimplemented!() } }
