//! What a polygon leaves free of dA's hemisphere, without the cancellation of 1 - F.
//!
//! When the zenith lies inside a convex polygon, the free part is a ring of skirts: below each edge from a to b the part
//! of the hemisphere between the edge and the horizon. With A = a x b, z along the normal and h across it,
//!
//! 2 pi F(skirt) = phi - beta A_z / |A| = (phi - beta) + beta A_h^2 / (|A| (|A| + A_z)),
//! tan(phi - beta) = (A_z a_z b_z - (a_h . b_h) A_h^2 / (|A| + A_z)) / ((a_h . b_h)(a . b) + A_z |A|),
//!
//! where phi is the azimuth between a and b, beta the angle between them, and the azimuths add to 2 pi.
use crate::exact::lambert::{Direction, swept};
use crate::exact::{horizon::Vertex, view::View};
use crate::form_factor::FormFactor;
use crate::numeric::offset::{accurate_cross, accurate_dot};
use crate::numeric::rounding::ROUNDING;
use crate::pipeline::unoccluded;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// `1 - F` for a polygon with nothing in between, without the cancellation of a subtraction.
///
/// A large convex polygon close above dA leaves little of the hemisphere free. Where dA's normal is along an axis the result
/// keeps its digits however little that is; elsewhere what rounding the unit normal changes is in the bound.
///
/// ```
/// use formfactor::{DVec3, DifferentialArea, PlanarPolygon, unoccluded_complement};
/// // A square of side 2e9 at distance 1.
/// let (from, s) = (DifferentialArea::new(DVec3::ZERO, DVec3::Z)?, 1e9);
/// let sky = PlanarPolygon::new([[[-s, s, 1.0], [s, s, 1.0], [s, -s, 1.0], [-s, -s, 1.0]]])?;
/// let free = unoccluded_complement(&from, &sky);
/// assert!(free.value > 0.0 && free.value < 1e-17 && free.error_bound < 1e-13 * free.value);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[must_use]
pub fn unoccluded_complement(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    let summed = skirts(from, to);
    if let Some(free) = summed.filter(|free| free.error_bound <= FINE * free.value) {
        return free;
    }
    let factor = unoccluded(from, to);
    let rest =
        FormFactor { value: 1.0 - factor.value, error_bound: (factor.error_bound + ROUNDING).min(1.0) };
    summed.filter(|free| free.error_bound < rest.error_bound).unwrap_or(rest)
}

/// The relative error up to which the sum over the skirts is good enough.
const FINE: f64 = 1e-13;

/// The sum over the skirts, when the zenith lies inside the polygon.
fn skirts(from: &DifferentialArea, to: &PlanarPolygon) -> Option<FormFactor> {
    let view = View::new(from, to)?;
    if !to.is_convex() {
        return None;
    }
    let vertices: Vec<&Vertex> = view.loops.iter().flatten().collect();
    let directions: Vec<Direction> = vertices.iter().map(|vertex| scaled(vertex.direction())).collect();
    let mut free = FormFactor { value: 0.0, error_bound: view.facing_error + tilt(from) };
    for (i, a) in directions.iter().enumerate() {
        let next = (i + 1) % directions.len();
        let b = &directions[next];
        if vertices[i].is_on_horizon && vertices[next].is_on_horizon {
            // Nothing is below it. The skirts beside it do not share its ends' errors.
            free.error_bound += (a.error + b.error) / PI;
            continue;
        }
        // Seen from the front the loop is counter-clockwise, seen from above clockwise.
        let skirt = skirt(from.normal(), b.toward, a.toward)?;
        free.value += skirt.value;
        free.error_bound += skirt.error_bound + swept(*a, *b);
    }
    let rounding =
        4.0 * ROUNDING * free.value * f64::from(u32::try_from(directions.len()).unwrap_or(u32::MAX));
    Some(FormFactor { value: free.value.clamp(0.0, 1.0), error_bound: free.error_bound + rounding })
}

/// A direction of the length of a unit, so that no product overflows: by a power of two, which rounds nothing.
fn scaled(direction: Direction) -> Direction {
    let largest = direction.toward.abs().max_element();
    let exponent = largest.log2().floor().clamp(-1000.0, 1000.0);
    Direction { toward: direction.toward * (-exponent).exp2(), ..direction }
}

/// The skirt's form factor; `None` when the zenith is not to the left of the edge.
fn skirt(normal: DVec3, a: DVec3, b: DVec3) -> Option<FormFactor> {
    let cross = accurate_cross(a, b);
    let (length, rise) = (cross.length(), accurate_dot(normal, cross));
    if rise <= 0.0 {
        return None;
    }
    let (lean, lean_error) = squared_lean(normal, cross);
    let (a_z, b_z, cosine) = (accurate_dot(normal, a), accurate_dot(normal, b), accurate_dot(a, b));
    let flat = cosine - a_z * b_z;
    let (raised, leaning) = (rise * a_z * b_z, lean / (length + rise));
    let (top, base) = (raised - flat * leaning, flat * cosine + rise * length);
    let beta = length.atan2(cosine);
    let value = top.atan2(base) + beta * leaning / length;
    // The edge's plane may contain the normal but for rounding.
    let rise_error = 8.0 * ROUNDING * length;
    let top_error = 24.0 * ROUNDING * (raised.abs() + (cosine.abs() + (a_z * b_z).abs()) * leaning)
        + flat.abs() * lean_error / (length + rise)
        + rise_error * ((a_z * b_z).abs() + flat.abs() * leaning / (length + rise));
    let base_error =
        24.0 * ROUNDING * ((flat * cosine).abs() + (a_z * b_z * cosine).abs()) + rise_error * length;
    let turned = (base.abs() * top_error + top.abs() * base_error) / (top * top + base * base);
    let lost = beta * (24.0 * ROUNDING * leaning + lean_error / (length + rise)) / length;
    let error_bound = (turned + lost + 8.0 * ROUNDING * value.abs()) / TAU;
    Some(FormFactor { value: value / TAU, error_bound })
}

/// The squared length of the part of `cross` across the normal, and a bound on its error.
fn squared_lean(normal: DVec3, cross: DVec3) -> (f64, f64) {
    let across = accurate_cross(normal, cross);
    let (n, c) = (normal.abs(), cross.abs());
    let terms = DVec3::new(n.y * c.z + n.z * c.y, n.z * c.x + n.x * c.z, n.x * c.y + n.y * c.x);
    let error = 8.0 * ROUNDING * terms.length();
    let lean = across.length();
    (lean * lean, 2.0 * lean * error + error * error + 8.0 * ROUNDING * lean * lean)
}

/// A bound on the angle between the unit normal and the normal as given.
fn tilt(from: &DifferentialArea) -> f64 {
    let given = from.given_normal() / from.given_normal().abs().max_element();
    accurate_cross(given, from.normal()).length() / given.length() * (1.0 + 16.0 * ROUNDING)
}
