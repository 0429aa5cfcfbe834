//! The file with its polygons repaired: the old text, in which polygons that were cut give way to their pieces.
//!
//! ```text
//! <source> positions … new ones behind      pieces keep the vertices that they had
//! <source> places of the pieces' pictures
//! <vertices>
//! <polylist> what was not cut
//! <polylist> or <polygons> the pieces       of the same material
//! ```
//!
//! A geometry that several nodes instance gets a copy for each that changed.
use super::dimmed::dimmed_colours;
use super::file::{File, XmlNode, children};
use super::primitive::{Layout, Primitive, layout, polylist, primitives, rows, triangles};
use super::splice::{Edit, Splice, copied_doors, spliced};
use super::vertices::GeometryVertices;
use super::walk::{Instance, walk};
use crate::escape::escape;
use crate::io::error::FileError;
use crate::io::surface::changes::{Changes, CutPiece, Pieces};
use crate::io::surface::facets;
use crate::io::words::{decimal, list};
use glam::{DVec2, DVec3};
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
        edits.extend(without(splice.text, file, primitive, &layout, pieces)?);
        if pieces.all().next().is_none() {
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
        edits.extend(with(splice, primitive, &layout, vertices, pieces));
    }
    let Some((element, vertices)) = vertices else { return Ok(Some(edits)) };
    if vertices.are_more() {
        let Some(longer) = vertices.longer(file, element)? else { return Ok(None) };
        edits.extend(longer);
    }
    edits.sort_by_key(|(range, _)| range.start);
    Ok(Some(edits))
}

/// The primitive without the polygons that changed.
fn without<'a>(
    text: &str,
    file: &File<'a>,
    primitive: &Primitive<'a>,
    layout: &Layout<'a>,
    pieces: &Pieces<'_>,
) -> Result<Vec<Edit>, FileError> {
    let element = primitive.element;
    let facets = facets(&primitive.polygons, primitive.is_cut, pieces.is_textured);
    let changed = facets.iter().filter(|facet| pieces.of_polygon.contains_key(&facet.number));
    let removed: BTreeSet<usize> = changed.flat_map(|facet| facet.members.iter().copied()).collect();
    if element.tag_name().name() == "polygons" {
        let polygons = element.children().filter(|node| matches!(node.tag_name().name(), "p" | "ph"));
        let gone = polygons.enumerate().filter(|(index, _)| removed.contains(index));
        let count = primitive.polygons.len() - removed.len();
        let counted =
            element.attribute_node("count").map(|attribute| (attribute.range_value(), count.to_string()));
        return Ok(gone.map(|(_, node)| (node.range(), String::new())).chain(counted).collect());
    }
    let all = corners(file, element, layout.stride)?;
    let kept: Vec<&Vec<Vec<usize>>> = all
        .iter()
        .enumerate()
        .filter(|(index, _)| !removed.contains(index))
        .map(|(_, polygon)| polygon)
        .collect();
    let new = if kept.is_empty() { String::new() } else { kept_element(text, element, &kept) };
    Ok(vec![(element.range(), new)])
}

/// The indices of the corners of every polygon, as many numbers for each as the element has inputs.
fn corners<'a>(
    file: &File<'a>,
    element: XmlNode<'a>,
    stride: usize,
) -> Result<Vec<Vec<Vec<usize>>>, FileError> {
    let tag = element.tag_name().name();
    let mut all = Vec::new();
    for p in children(element, "p") {
        let ring: Vec<Vec<usize>> = file.wholes(p)?.chunks(stride).map(<[usize]>::to_vec).collect();
        all.extend(if tag == "polylist" {
            polylist(file, element, &ring)?
        } else {
            triangles(file, p, tag, &ring)?
        });
    }
    Ok(all)
}

/// An element like the old one with some of its polygons.
fn kept_element(text: &str, element: XmlNode<'_>, kept: &[&Vec<Vec<usize>>]) -> String {
    let inputs: String = children_text(text, element, "input");
    let corners = list(kept.iter().copied().flatten().flatten());
    match element.tag_name().name() {
        "polylist" => {
            let counts = list(kept.iter().map(|polygon| polygon.len()));
            wrapped(
                "polylist",
                element,
                kept.len(),
                &format!("{inputs}<vcount>{counts}</vcount>\n<p>{corners}</p>\n"),
            )
        }
        _ => wrapped("triangles", element, kept.len(), &format!("{inputs}<p>{corners}</p>\n")),
    }
}

fn children_text(text: &str, element: XmlNode<'_>, name: &'static str) -> String {
    children(element, name).map(|node| format!("{}\n", &text[node.range()])).collect()
}

/// An element with the attributes of the old one but for the count.
fn wrapped(tag: &str, element: XmlNode<'_>, count: usize, inside: &str) -> String {
    let kept = element.attributes().filter(|attribute| attribute.name() != "count");
    let attributes: String =
        kept.map(|attribute| format!(" {}=\"{}\"", attribute.name(), escape(attribute.value()))).collect();
    format!("<{tag}{attributes} count=\"{count}\">\n{inside}</{tag}>")
}

/// The pieces, behind the primitive, and the places of their pictures before the vertices.
fn with(
    splice: &mut Splice<'_, '_, '_>,
    primitive: &Primitive<'_>,
    layout: &Layout<'_>,
    vertices: &mut GeometryVertices,
    pieces: &Pieces<'_>,
) -> Vec<Edit> {
    let mut places = pieces.is_textured.then(Vec::new);
    let shape = |piece: &CutPiece<'_>| {
        piece.loops.iter().map(|points| ring(points, piece, vertices, &mut places)).collect::<Vec<_>>()
    };
    let shapes: Vec<Vec<Vec<usize>>> = pieces.all().map(shape).collect();
    let of_vertices = layout.vertices.attribute("id").unwrap_or_default();
    let mut inputs = input("VERTEX", of_vertices, "offset=\"0\"");
    let mut edits = Vec::new();
    if let Some(places) = &places {
        let id = splice.fresh(&format!("{of_vertices}-places"));
        inputs +=
            &input("TEXCOORD", &id, &format!("offset=\"1\" set=\"{}\"", escape(set_of(primitive.element))));
        let start = layout.vertices.range().start;
        edits.push((start..start, places_source(&id, places)));
    }
    let stride = if places.is_some() { 2 } else { 1 };
    let end = primitive.element.range().end;
    edits.push((end..end, format!("\n{}", element_of(primitive.element, &inputs, &shapes, stride))));
    edits
}

/// The indices of a piece's corners, each followed by that of its place in the picture where there is one.
fn ring(
    points: &[DVec3],
    piece: &CutPiece<'_>,
    vertices: &mut GeometryVertices,
    places: &mut Option<Vec<[f64; 2]>>,
) -> Vec<usize> {
    let mut corners = Vec::new();
    for &point in points {
        let mut corner = vec![vertices.index(point, piece)];
        if let Some(places) = places {
            let place = piece.texture.map_or(DVec2::ZERO, |texture| texture.place(point));
            corner.push(places.len());
            // COLLADA counts a picture's rows from below.
            places.push([place.x, 1.0 - place.y]);
        }
        corners.push(corner);
    }
    if vertices.is_mirrored() {
        corners.reverse();
    }
    corners.concat()
}

fn input(semantic: &str, source: &str, rest: &str) -> String {
    format!("<input semantic=\"{semantic}\" source=\"#{}\" {rest}/>\n", escape(source))
}

/// The set of a picture's places that an element uses.
fn set_of<'a>(element: XmlNode<'a>) -> &'a str {
    let places = children(element, "input").find(|input| input.attribute("semantic") == Some("TEXCOORD"));
    places.and_then(|input| input.attribute("set")).unwrap_or("0")
}

/// `<polygons>` where there are holes, else a `<polylist>`.
fn element_of(old: XmlNode<'_>, inputs: &str, shapes: &[Vec<Vec<usize>>], stride: usize) -> String {
    if shapes.iter().all(|rings| rings.len() == 1) {
        let counts = list(shapes.iter().map(|rings| rings[0].len() / stride));
        let corners = list(shapes.iter().flatten().flatten());
        let inside = format!("{inputs}<vcount>{counts}</vcount>\n<p>{corners}</p>\n");
        return wrapped("polylist", old, shapes.len(), &inside);
    }
    let polygon = |rings: &Vec<Vec<usize>>| match rings.as_slice() {
        [ring] => format!("<p>{}</p>\n", list(ring.iter())),
        [ring, holes @ ..] => {
            let holes: String = holes.iter().map(|hole| format!("<h>{}</h>", list(hole.iter()))).collect();
            format!("<ph><p>{}</p>{holes}</ph>\n", list(ring.iter()))
        }
        [] => String::new(),
    };
    let polygons: String = shapes.iter().map(polygon).collect();
    wrapped("polygons", old, shapes.len(), &format!("{inputs}{polygons}"))
}

fn places_source(id: &str, places: &[[f64; 2]]) -> String {
    let (id, count) = (escape(id), places.len());
    let numbers = list(places.iter().flatten().map(decimal));
    format!(
        "<source id=\"{id}\"><float_array id=\"{id}-array\" count=\"{}\">{numbers}</float_array><technique_common>\
         <accessor source=\"#{id}-array\" count=\"{count}\" stride=\"2\"><param name=\"S\" type=\"float\"/>\
         <param name=\"T\" type=\"float\"/></accessor></technique_common></source>\n",
        2 * count
    )
}
