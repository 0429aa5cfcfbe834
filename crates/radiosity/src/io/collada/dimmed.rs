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
    let mut edits: BTreeMap<usize, Edit> = BTreeMap::new();
    for &[instance, primitive] in dimmed {
        let Some(instance) = instances.get(instance) else { continue };
        let symbol = surfaces(instance.geometry).nth(primitive).and_then(|node| node.attribute("material"));
        match dimmable(file, instance.element, symbol)? {
            Dimmable::Spectrum => return Ok(None),
            // Many polygons have one colour.
            Dimmable::Colour(element) => {
                edits.extend(lowered(file, element)?.map(|edit| (edit.0.start, edit)));
            }
            Dimmable::Neither => {}
        }
    }
    Ok(Some(edits.into_values().collect()))
}

/// New numbers for a colour.
fn lowered<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<Option<Edit>, FileError> {
    let mut numbers = file.numbers(element)?;
    numbers.iter_mut().take(3).for_each(|band| *band = band.min(BRIGHTEST));
    let range = element.first_child().map(|inner| inner.range());
    Ok(range.map(|range| (range, list(numbers.iter().map(decimal)))))
}
