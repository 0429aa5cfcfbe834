//! Diffuse colours that reflect all light, dimmed as reading does.
use super::file::{File, XmlNode};
use super::material::{Dimmable, dimmable};
use super::primitive::surfaces;
use super::{splice::Edit, walk::Instance};
use crate::io::error::FileError;
use crate::io::words::{decimal, list};
use crate::repair::BRIGHTEST;
use std::collections::{BTreeMap, BTreeSet};

/// The edits to the colours of primitives, given by instance and index; `None` where one has a spectrum in their place. A primitive without
/// a colour needs none.
pub(super) fn dimmed_colours<'a>(
    file: &File<'a>,
    instances: &[Instance<'a>],
    dimmed: &BTreeSet<[usize; 2]>,
) -> Result<Option<Vec<Edit>>, FileError> {
    let mut edits = BTreeMap::new();
    for &[instance, primitive] in dimmed {
        let Some(instance) = instances.get(instance) else { continue };
        let symbol = surfaces(instance.geometry).nth(primitive).and_then(|node| node.attribute("material"));
        match dimmable(file, instance.element, symbol)? {
            Dimmable::Spectrum => return Ok(None),
            Dimmable::Colour(element) => edits.extend(lowered(file, element)?),
            Dimmable::Neither => {}
        }
    }
    Ok(Some(edits.into_iter().map(|(start, (end, text))| (start..end, text)).collect()))
}

/// Where a colour's numbers begin, where they end, and what takes their place.
fn lowered<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<Option<(usize, (usize, String))>, FileError> {
    let mut numbers = file.numbers(element)?;
    numbers.iter_mut().take(3).for_each(|band| *band = band.min(BRIGHTEST));
    let range = element.first_child().map(|inner| inner.range());
    Ok(range.map(|range| (range.start, (range.end, list(numbers.iter().map(decimal))))))
}
