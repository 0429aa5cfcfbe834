//! Radiosity along a line that is drawn on a surface.
//!
//! ```text
//! chart    a profile as SVG
//! scale    round numbers on an axis
//! line     the elements that a line crosses
//! data     what a profile holds
//! error    why there is none
//! ```
//! A profile is not sampled: interpolated radiosity is linear within an element, so that the places where the line enters and
//! leaves elements tell all of it.
mod chart;
mod data;
mod error;
mod line;
mod scale;

pub use data::{Crossing, Profile, ProfilePoint};
pub use error::ProfileError;

use crate::record::Record;
use crate::table::{columns, table};
use glam::DVec3;
use line::Stretch;

/// Radiosity along the line between two places: on the patch of that name, or on the surface that the line lies on, which may be
/// several patches in one plane that face the same way. Ends may be off the plane by a millionth of the scene's size.
///
/// Takes O(n) for n elements.
///
/// # Errors
/// [`ProfileError`] when the line does not lie on one surface.
///
/// ```
/// use radiosity::{Options, Record, glam::DVec3, profile::profile, scenes, solve};
/// use std::ops::ControlFlow;
///
/// let scene = scenes::scene("furnace").expect("a built-in scene");
/// let solution = solve(&scene, &Options::mesh(60), |_| ControlFlow::Continue(()))?;
/// let record = Record::new("furnace", &scene, &solution);
/// // Across the floor of the unit cube, in which radiosity is 1 everywhere.
/// let profile = profile(&record, [DVec3::new(0.1, 0.2, 0.0), DVec3::new(0.9, 0.7, 0.0)], None)?;
/// assert!(profile.crossings.iter().all(|crossing| crossing.patch == "floor"));
/// assert!(profile.points().all(|point| (point.radiosity[0] - 1.0).abs() < 1e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn profile(record: &Record, ends: [DVec3; 2], patch: Option<&str>) -> Result<Profile, ProfileError> {
    let length = ends[0].distance(ends[1]);
    if !(length > 0.0 && length.is_finite()) {
        return Err(ProfileError::Ends);
    }
    let stretches = match patch {
        Some(name) => line::on_patch(record, ends, name)?,
        None => line::on_any(record, ends)?,
    };
    Ok(Profile {
        scene: record.scene.clone(),
        ends,
        bands: record.bands,
        wavelengths: record.wavelengths.clone(),
        crossings: stretches.iter().map(|stretch| crossing(record, ends, stretch)).collect(),
    })
}

fn crossing(record: &Record, ends: [DVec3; 2], stretch: &Stretch) -> Crossing {
    let length = ends[0].distance(ends[1]);
    let [patch, corners @ ..] = record.elements[stretch.element];
    let point = |share: f64| {
        let place = ends[0].lerp(ends[1], share);
        let weights = line::weights(corners.map(|corner| record.vertices[corner]), place);
        let value = |band: usize| {
            let values = corners.map(|corner| record.vertex_radiosity[corner * record.bands + band]);
            (0..3).map(|corner| weights[corner] * values[corner]).sum()
        };
        ProfilePoint { distance: share * length, place, radiosity: (0..record.bands).map(value).collect() }
    };
    let own = stretch.element * record.bands..(stretch.element + 1) * record.bands;
    let of = &record.patches[patch];
    Crossing {
        patch: of.name.clone(),
        estimate: of.estimate.iter().zip(&of.reflectance).map(|(error, rho)| error * rho).collect(),
        element: stretch.element,
        radiosity: record.radiosity[own].to_vec(),
        ends: stretch.shares.map(point),
    }
}

impl Profile {
    /// All places: for each element where the line enters it, then where it leaves it.
    pub fn points(&self) -> impl Iterator<Item = &ProfilePoint> {
        self.crossings.iter().flat_map(|crossing| &crossing.ends)
    }

    /// Comma-separated values, two rows for each element: the distance from the start, the place, the patch, the element, the
    /// interpolated radiosity per band, and that of the element; then what the patch's radiosity may be off by, where that is known.
    #[must_use]
    pub fn csv(&self) -> String {
        let groups = ["radiosity", "element_radiosity", "estimate"];
        let groups = &groups[..if self.is_estimated() { 3 } else { 2 }];
        let first = ["distance", "x", "y", "z", "patch", "element"].map(Into::into);
        let header = first.into_iter().chain(columns(groups, self.bands));
        let row = |(crossing, point): (&Crossing, &ProfilePoint)| {
            let [x, y, z] = point.place.to_array();
            let numbers = [point.distance, x, y, z].map(|number| number.to_string());
            let names = [crossing.patch.clone(), crossing.element.to_string()];
            let values = point.radiosity.iter().chain(&crossing.radiosity).chain(&crossing.estimate);
            let values = values.map(ToString::to_string);
            numbers.into_iter().chain(names).chain(values).collect()
        };
        let rows =
            self.crossings.iter().flat_map(|crossing| crossing.ends.iter().map(move |end| (crossing, end)));
        table(header.collect(), rows.map(row))
    }

    /// Whether it is known what the light may be off by.
    fn is_estimated(&self) -> bool {
        self.crossings.iter().any(|crossing| !crossing.estimate.is_empty())
    }

    /// A drawing: interpolated radiosity as thick lines, that of the elements as thin ones, for each band; of more than six
    /// bands six, evenly picked. What the patches' radiosity may be off by is a band around the thick lines, where it is known.
    #[must_use]
    pub fn svg(&self) -> String {
        chart::svg(self)
    }
}
