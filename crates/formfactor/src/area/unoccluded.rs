//! Two polygons with nothing else about.
use super::AreaFormFactor;
use super::factor;
use super::integral::Allowed;
use super::pair::unobstructed;
use super::tolerance::Tolerance;
use crate::error::Error;
use crate::scene::surfaces::Surface;
use crate::shapes::polygon::PlanarPolygon;

/// The form factor from one polygon to another where nothing is in between and each is wholly before the other's plane: in closed form, without
/// an [`Enclosure`](crate::Enclosure). `None` where one reaches behind the other, or roundings leave more than the tolerance.
///
/// Takes a few microseconds; the contour integrals of edges that touch take more than those of polygons apart.
///
/// # Errors
/// [`Error::BadTolerance`] unless the tolerance is positive.
///
/// ```
/// use formfactor::{PlanarPolygon, unoccluded_area};
/// // Unit squares with a common edge.
/// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
/// let wall = PlanarPolygon::new([[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]])?;
/// let f = unoccluded_area(&floor, &wall, 1e-9)?;
/// assert!(f.is_some_and(|f| (f.value - 0.200_043_776_075_400_86).abs() < 1e-9));
/// # Ok::<(), formfactor::Error>(())
/// ```
pub fn unoccluded_area(
    from: &PlanarPolygon,
    to: &PlanarPolygon,
    tolerance: f64,
) -> Result<Option<AreaFormFactor>, Error> {
    Tolerance::from(tolerance).check()?;
    let [one, other] = [from, to].map(|polygon| Surface::new(polygon, 0, None));
    let absolute = tolerance * one.area.min(other.area);
    let (of_root, equal) = (f64::INFINITY, f64::INFINITY);
    let allowed = Allowed { absolute, relative: 0.0, of_root, equal, evaluations: 0 };
    Ok(unobstructed(&one, &other, &allowed).map(|found| factor(&found, one.area)))
}
