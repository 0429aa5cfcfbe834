//! What stays of a primitive: the polygons that did not change, and those of which one side is left.
use super::file::{XmlNode, children};
use super::outlines::{ElementFrame, IndexedPolygon, indexed};
use super::pieces::source_text;
use super::primitive::{Layout, Primitive, rows};
use super::splice::{Edit, Splice};
use crate::escape::escape;
use crate::io::error::FileError;
use crate::io::surface::changes::{Pieces, Side};
use crate::io::surface::facets;
use std::collections::{BTreeMap, BTreeSet};

/// The primitive without the polygons that changed, and behind it those of one side.
pub(super) fn kept<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    primitive: &Primitive<'a>,
    layout: &Layout<'a>,
    pieces: &Pieces<'_>,
) -> Result<Vec<Edit>, FileError> {
    let element = primitive.element;
    let all = indexed(splice.file, element, layout.stride)?;
    let members = Members::of(primitive, pieces);
    let gone = members.of_all(pieces.of_polygon.keys().copied());
    let mut edits = rest(splice.text, primitive, &all, &gone);
    let end = element.range().end;
    for side in [Side::Front, Side::Back] {
        let picked = members.of_all(pieces.whole(side));
        if picked.is_empty() {
            continue;
        }
        let mut frame = ElementFrame::of(splice.text, element).one_sided();
        let mut polygons: Vec<IndexedPolygon> = picked.iter().map(|index| all[*index].clone()).collect();
        if side == Side::Back {
            polygons.iter_mut().flatten().for_each(|ring| ring.reverse());
            edits.extend(turn_normals(splice, &mut frame, element, layout));
        }
        edits.push((end..end, format!("\n{}", text(primitive, &frame, &polygons))));
    }
    Ok(edits)
}

/// The polygons of the file that each polygon was joined from, by its first.
struct Members(BTreeMap<usize, Vec<usize>>);

impl Members {
    fn of(primitive: &Primitive<'_>, pieces: &Pieces<'_>) -> Members {
        let facets = facets(&primitive.polygons, primitive.is_cut, pieces.is_textured);
        Members(facets.into_iter().map(|facet| (facet.number, facet.members)).collect())
    }

    /// Those of some polygons.
    fn of_all(&self, polygons: impl Iterator<Item = usize>) -> BTreeSet<usize> {
        polygons.filter_map(|polygon| self.0.get(&polygon)).flatten().copied().collect()
    }
}

/// The edits that take polygons out of a primitive.
fn rest(
    text_of_file: &str,
    primitive: &Primitive<'_>,
    all: &[IndexedPolygon],
    gone: &BTreeSet<usize>,
) -> Vec<Edit> {
    let element = primitive.element;
    if element.tag_name().name() == "polygons" {
        let polygons = element.children().filter(|node| matches!(node.tag_name().name(), "p" | "ph"));
        let gone_nodes = polygons.enumerate().filter(|(index, _)| gone.contains(index));
        let count = (all.len() - gone.len()).to_string();
        let counted = element.attribute_node("count").map(|attribute| (attribute.range_value(), count));
        return gone_nodes.map(|(_, node)| (node.range(), String::new())).chain(counted).collect();
    }
    let kept = all.iter().enumerate().filter(|(index, _)| !gone.contains(index));
    let kept: Vec<IndexedPolygon> = kept.map(|(_, polygon)| polygon.clone()).collect();
    let frame = ElementFrame::of(text_of_file, element);
    let new = if kept.is_empty() { String::new() } else { text(primitive, &frame, &kept) };
    vec![(element.range(), new)]
}

/// Triangles stay triangles, so that they are joined again.
fn text(primitive: &Primitive<'_>, frame: &ElementFrame<'_>, polygons: &[IndexedPolygon]) -> String {
    if primitive.is_cut { frame.triangles(polygons) } else { frame.polygons(polygons) }
}

/// Lets an element have the opposite normals, where it has normals; the edit adds them before the vertices.
fn turn_normals<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    frame: &mut ElementFrame<'a>,
    element: XmlNode<'a>,
    layout: &Layout<'a>,
) -> Option<Edit> {
    let (source, offset) = layout.normals?;
    // Light does not depend on them: broken ones stay.
    let normals = rows(splice.file, source, 3).ok()?;
    let turned: Vec<Vec<f64>> = normals.iter().map(|normal| (-*normal).to_array().to_vec()).collect();
    let id = splice.fresh(&format!("{}-turned", source.attribute("id").unwrap_or_default()));
    // Normals that belong to vertices stand at the index of these.
    let input = format!("<input semantic=\"NORMAL\" source=\"#{}\" offset=\"{offset}\"/>\n", escape(&id));
    let is_normal = |node: &XmlNode<'_>| node.attribute("semantic") == Some("NORMAL");
    let own = children(element, "input").find(is_normal);
    frame.inputs = match own {
        Some(own) => frame.inputs.replacen(&format!("{}\n", &splice.text[own.range()]), &input, 1),
        None => format!("{}{input}", frame.inputs),
    };
    let start = layout.vertices.range().start;
    Some((start..start, source_text(&id, &["X", "Y", "Z"], &turned)))
}
