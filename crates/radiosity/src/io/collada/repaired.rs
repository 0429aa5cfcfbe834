//! The file with its polygons repaired: the old text, in which polygons that were cut give way to their pieces.
//!
//! ```text
//! <source> positions … new ones behind      pieces keep the vertices that they had
//! <source> places of the pieces' pictures
//! <vertices>
//! <polylist> what was not cut
//! <polylist> what stays of one side         <extra> with <double_sided> 0
//! <polylist> or <polygons> the pieces       of the same material
//! ```
//!
//! A geometry that several nodes instance gets a copy for each that changed.
use super::dimmed::dimmed_colours;
use super::file::{File, XmlNode};
use super::kept::kept;
use super::pieces::cut_pieces;
use super::primitive::{layout, primitives, rows};
use super::splice::{Edit, Splice, copied_doors, spliced};
use super::vertices::GeometryVertices;
use super::walk::{Instance, walk};
use crate::escape::escape;
use crate::io::error::FileError;
use crate::io::surface::changes::{Changes, Pieces};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The new text; `None` where the file's arrays have no room for more vertices, where spectra were dimmed, or what changed is no geometry.
pub(super) fn repaired(
    text: &str,
    file: &File<'_>,
    (changes, dimmed): &(Changes<'_>, BTreeSet<[usize; 2]>),
) -> Result<Option<String>, FileError> {
    let instances = walk(file)?.instances;
    let copied = copied_doors(instances.iter());
    let mut splice = Splice::new(text, file);
    let Some(colours) = dimmed_colours(file, &instances, dimmed)? else { return Ok(None) };
    for (range, colour) in colours {
        splice.edit(Vec::new(), range, colour);
    }
    for (index, pieces) in changes {
        // A lamp that is no geometry has no place in the text.
        let Some(instance) = instances.get(*index) else { return Ok(None) };
        let Some(edits) = edits(&mut splice, instance, pieces)? else { return Ok(None) };
        let shared = instances.iter().filter(|other| other.geometry == instance.geometry).count() > 1;
        if !shared {
            edits.into_iter().for_each(|(range, text)| splice.edit(Vec::new(), range, text));
            continue;
        }
        let path = splice.open(&instance.visit.via, &copied);
        let geometry = spliced(text, instance.geometry.range(), &edits);
        let Some((id, copy)) = renamed(&mut splice, instance, &geometry) else { return Ok(None) };
        let end = instance.geometry.range().end;
        splice.edit(Vec::new(), end..end, format!("\n{copy}"));
        splice.point_at(instance, &id, path)?;
    }
    splice.render(0..text.len(), &Vec::new()).map(Some)
}

/// A geometry's text with new ids, and its own among them.
fn renamed(splice: &mut Splice<'_, '_, '_>, instance: &Instance<'_>, text: &str) -> Option<(String, String)> {
    let document = roxmltree::Document::parse(text).ok()?;
    let ids = document.descendants().filter_map(|node| node.attribute_node("id"));
    let fresh: HashMap<&str, String> = ids.map(|id| (id.value(), splice.fresh(id.value()))).collect();
    let mut edits: Vec<Edit> = Vec::new();
    for attribute in document.descendants().flat_map(|node| node.attributes()) {
        let (mark, name) = match (attribute.name(), attribute.value().strip_prefix('#')) {
            ("id", _) => ("", attribute.value()),
            (_, Some(name)) => ("#", name),
            _ => continue,
        };
        edits.extend(fresh.get(name).map(|new| (attribute.range_value(), format!("{mark}{}", escape(new)))));
    }
    edits.sort_by_key(|(range, _)| range.start);
    let own = fresh.get(instance.geometry.attribute("id")?)?.clone();
    Some((own, spliced(text, 0..text.len(), &edits)))
}

/// The edits to an instance's geometry, sorted; `None` where an array has no room.
fn edits<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    instance: &Instance<'a>,
    changes: &BTreeMap<usize, Pieces<'_>>,
) -> Result<Option<Vec<Edit>>, FileError> {
    let file = splice.file;
    let all = primitives(file, instance.geometry, &mut Vec::new())?;
    let mut vertices: Option<(XmlNode<'a>, GeometryVertices)> = None;
    let mut edits = Vec::new();
    for (&index, pieces) in changes {
        let primitive = &all[index];
        let Some(layout) = layout(file, primitive.element)? else { return Ok(None) };
        edits.extend(kept(splice, primitive, &layout, pieces)?);
        if pieces.of_polygon.values().all(|new| new.pieces.is_empty()) {
            continue;
        }
        if vertices.as_ref().is_some_and(|(known, _)| *known != layout.vertices) {
            return Ok(None);
        }
        if vertices.is_none() {
            let known = GeometryVertices::of(&rows(file, layout.source, 3)?, instance.visit.world);
            vertices = Some((layout.vertices, known));
        }
        let Some((_, vertices)) = &mut vertices else { return Ok(None) };
        edits.extend(cut_pieces(splice, primitive, &layout, vertices, pieces));
    }
    if let Some((element, vertices)) = vertices.filter(|(_, vertices)| vertices.are_more()) {
        let Some(longer) = vertices.longer(file, element)? else { return Ok(None) };
        edits.extend(longer);
    }
    edits.sort_by_key(|(range, _)| range.start);
    Ok(Some(edits))
}
