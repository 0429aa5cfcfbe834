//! Materials of any number of bands: in a COLLADA `<extra>` of this program's own, which other programs pass over.
//!
//! ```xml
//! <effect id="…">…
//!   <extra><technique profile="radiosity">
//!     <reflectance>.343 .445 …</reflectance>   <!-- a value for each band -->
//!     <emission>0 0 …</emission>               <!-- radiance; left out where nothing is emitted -->
//!   </technique></extra>
//! </effect>
//! …
//! <COLLADA>…
//!   <extra><technique profile="radiosity"><wavelengths>400 404 …</wavelengths></technique></extra>   <!-- in nm -->
//! </COLLADA>
//! ```
//!
//! What COLLADA has no word for, the factor of a texture's colours, is kept so as well, within `<texture>`: `<factor>.3 .3 .3</factor>`.
use super::file::{File, XmlNode, child, children};
use crate::io::error::{Fault, FileError};
use crate::io::surface::finish::Spectra;
use crate::scene::patch::Patch;

/// What technique is this program's.
pub(super) const PROFILE: &str = "radiosity";

/// What an effect says of its bands; nothing where it has but colours.
pub(super) fn spectra<'a>(file: &File<'a>, effect: XmlNode<'a>) -> Result<Option<Spectra>, FileError> {
    let Some(own) = own(effect) else { return Ok(None) };
    let reflectance = values(file, file.child(own, "reflectance")?)?;
    let Some(element) = child(own, "emission") else {
        let emission = vec![0.0; reflectance.len()];
        return Ok(Some(Spectra { reflectance, emission }));
    };
    let emission = values(file, element)?;
    let (found, wanted) = (emission.len(), reflectance.len());
    if found != wanted {
        return Err(file.fault(element, Fault::Count { found, wanted }));
    }
    Ok(Some(Spectra { reflectance, emission }))
}

/// How many bands the patches have, and their wavelengths. A patch of fewer bands than the others is refused by the
/// solver, by its name.
pub(super) fn bands<'a>(file: &File<'a>, patches: &[Patch]) -> Result<(usize, Vec<f64>), FileError> {
    let bands = patches.iter().map(|patch| patch.reflectance.len()).max().unwrap_or(3);
    let Some(element) = own(file.root).and_then(|own| child(own, "wavelengths")) else {
        return Ok((bands, Vec::new()));
    };
    let wavelengths = values(file, element)?;
    if wavelengths.len() != bands {
        return Err(file.fault(element, Fault::Count { found: wavelengths.len(), wanted: bands }));
    }
    Ok((bands, wavelengths))
}

/// This program's technique among an element's extras.
pub(super) fn own<'a>(element: XmlNode<'a>) -> Option<XmlNode<'a>> {
    let techniques = children(element, "extra").flat_map(|extra| children(extra, "technique"));
    techniques.into_iter().find(|technique| technique.attribute("profile") == Some(PROFILE))
}

/// One number or more, none below 0.
pub(super) fn values<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<Vec<f64>, FileError> {
    let numbers = file.numbers(element)?;
    if numbers.is_empty() {
        return Err(file.fault(element, Fault::Count { found: 0, wanted: 1 }));
    }
    match numbers.iter().find(|value| **value < 0.0) {
        Some(&value) => Err(file.fault(element, Fault::Negative { what: "value", value })),
        None => Ok(numbers),
    }
}
