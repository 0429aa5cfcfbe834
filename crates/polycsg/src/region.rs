//! region
use crate::{Error, FillRule};
use glam::DVec2;
/// stub
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region { points: Vec<DVec2> }
/// stub
#[derive(Clone, Copy, Debug)]
pub struct Polygon<'r> { region: &'r Region }
/// stub
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location { /// in
 Inside, /// out
 Outside, /// on
 Boundary }
impl<'r> Polygon<'r> {
    /// counter-clockwise
    pub fn outer(&self) -> &'r [DVec2] { &self.region.points }
    /// clockwise
    pub fn holes(&self) -> impl Iterator<Item = &'r [DVec2]> + use<'r> { std::iter::empty() }
    /// number of polygons around it
    pub fn depth(&self) -> usize { 0 }
}
impl Region {
    /// rings: anything like Vec<Vec<DVec2>>, &[Vec<[f64; 2]>], [[DVec2; 4]; 1]
    pub fn from_rings<R, P>(_rings: R, _rule: FillRule) -> Result<Region, Error>
    where R: IntoIterator, R::Item: AsRef<[P]>, P: Copy + Into<DVec2> { unimplemented!() }
    /// u
    pub fn union(&self, _other: &Region) -> Region { unimplemented!() }
    /// i
    pub fn intersection(&self, _other: &Region) -> Region { unimplemented!() }
    /// d
    pub fn difference(&self, _other: &Region) -> Region { unimplemented!() }
    /// x
    pub fn symmetric_difference(&self, _other: &Region) -> Region { unimplemented!() }
    /// polygons, outermost first
    pub fn polygons(&self) -> impl Iterator<Item = Polygon<'_>> { std::iter::empty() }
    /// all rings: each polygon's outer ring (counter-clockwise), then its holes (clockwise)
    pub fn rings(&self) -> impl Iterator<Item = &[DVec2]> { std::iter::empty() }
    /// e
    pub fn is_empty(&self) -> bool { self.points.is_empty() }
    /// a
    pub fn area(&self) -> f64 { unimplemented!() }
    /// l
    pub fn locate(&self, _point: DVec2) -> Location { unimplemented!() }
}
