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
use super::file::{File, XmlNode, child, children, descend};
use super::primitive::{Layout, Primitive, layout, polylist, primitives, rows, triangles};
use super::splice::{Edit, Splice, copied_doors, spliced};
use super::walk::{Instance, walk};
use crate::escape::escape;
use crate::io::error::FileError;
use crate::io::surface::changes::{Changes, Piece, Pieces};
use crate::io::surface::{facets, polygon::bits};
use crate::io::words::{decimal, list};
use glam::{DMat4, DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The new text; `None` where the file's arrays have no room for more vertices.
pub(super) fn repaired(
    text: &str,
    file: &File<'_>,
    changes: &Changes<'_>,
) -> Result<Option<String>, FileError> {
    let instances = walk(file)?.instances;
    let copied = copied_doors(instances.iter());
    let mut splice = Splice::new(text, file);
    for (index, pieces) in changes {
        let instance = &instances[*index];
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

/// A vertex of a piece that the file does not have.
struct NewVertex {
    point: DVec3,
    normal: DVec3,
    place: DVec2,
}

/// The vertices of a geometry by where they stand in the world, and the new ones.
struct Vertices {
    world: DMat4,
    known: HashMap<[u64; 3], usize>,
    /// How many the file has.
    count: usize,
    new: Vec<NewVertex>,
}

impl Vertices {
    fn of(positions: &[DVec3], world: DMat4) -> Vertices {
        let places =
            positions.iter().enumerate().map(|(index, point)| (bits(world.transform_point3(*point)), index));
        let mut known = HashMap::new();
        places.for_each(|(place, index)| {
            known.entry(place).or_insert(index);
        });
        Vertices { world, known, count: positions.len(), new: Vec::new() }
    }

    /// The index of a piece's vertex.
    fn index(&mut self, point: DVec3, piece: &Piece<'_>) -> usize {
        let next = self.count + self.new.len();
        let index = *self.known.entry(bits(point)).or_insert(next);
        if index == next {
            let inverse = self.world.inverse();
            let place = piece.texture.map_or(DVec2::ZERO, |texture| texture.place(point));
            let normal = self.world.transpose().transform_vector3(piece.normal).normalize_or_zero();
            self.new.push(NewVertex { point: inverse.transform_point3(point), normal, place });
        }
        index
    }
}

/// The edits to an instance's geometry, sorted; `None` where an array has no room.
fn edits<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    instance: &Instance<'a>,
    changes: &BTreeMap<usize, Pieces<'_>>,
) -> Result<Option<Vec<Edit>>, FileError> {
    let file = splice.file;
    let all = primitives(file, instance.geometry, &mut Vec::new())?;
    let mut vertices: Option<(Layout<'a>, Vertices)> = None;
    let mut edits = Vec::new();
    for (&index, pieces) in changes {
        let primitive = &all[index];
        let Some(layout) = layout(file, primitive.element)? else { return Ok(None) };
        if vertices.as_ref().is_some_and(|(known, _)| known.vertices != layout.vertices) {
            return Ok(None);
        }
        if vertices.is_none() {
            let known = Vertices::of(&rows(file, layout.source, 3)?, instance.visit.world);
            vertices = Some((layout, known));
        }
        let Some((layout, vertices)) = &mut vertices else { return Ok(None) };
        edits.extend(without(splice.text, file, primitive, layout, pieces)?);
        edits.extend(with(splice, primitive, layout, vertices, pieces));
    }
    let Some((layout, vertices)) = vertices else { return Ok(Some(edits)) };
    if !vertices.new.is_empty() {
        let Some(longer) = longer(file, layout.vertices, &vertices)? else { return Ok(None) };
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
    let textured = pieces.values().flatten().any(|piece| piece.texture.is_some());
    let facets = facets(&primitive.polygons, primitive.is_cut, textured);
    let changed = facets.iter().filter(|facet| pieces.contains_key(&facet.number));
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
    vertices: &mut Vertices,
    pieces: &Pieces<'_>,
) -> Vec<Edit> {
    let all: Vec<&Piece<'_>> = pieces.values().flatten().collect();
    if all.is_empty() {
        return Vec::new();
    }
    let mirrored = vertices.world.determinant() < 0.0;
    let textured = all.iter().any(|piece| piece.texture.is_some());
    let (mut places, mut shapes) = (Vec::new(), Vec::new());
    for piece in all {
        let mut ring = |points: &Vec<DVec3>| {
            let mut corners = Vec::new();
            for &point in points {
                corners.push(vertices.index(point, piece));
                if textured {
                    let place = piece.texture.map_or(DVec2::ZERO, |texture| texture.place(point));
                    corners.push(places.len());
                    places.push([place.x, 1.0 - place.y]);
                }
            }
            if mirrored {
                corners = corners.rchunks(if textured { 2 } else { 1 }).flatten().copied().collect();
            }
            corners
        };
        shapes.push(piece.loops.iter().map(&mut ring).collect::<Vec<_>>());
    }
    let mut edits = Vec::new();
    let of_vertices = layout.vertices.attribute("id").unwrap_or_default();
    let mut inputs =
        format!("<input semantic=\"VERTEX\" source=\"#{}\" offset=\"0\"/>\n", escape(of_vertices));
    if textured {
        let id = splice.fresh(&format!("{of_vertices}-places"));
        let set = children(primitive.element, "input")
            .find(|input| input.attribute("semantic") == Some("TEXCOORD"));
        let set = set.and_then(|input| input.attribute("set")).unwrap_or("0");
        inputs += &format!(
            "<input semantic=\"TEXCOORD\" source=\"#{}\" offset=\"1\" set=\"{}\"/>\n",
            escape(&id),
            escape(set)
        );
        let start = layout.vertices.range().start;
        edits.push((start..start, places_source(&id, &places)));
    }
    let end = primitive.element.range().end;
    edits.push((
        end..end,
        format!("\n{}", element_of(primitive.element, &inputs, &shapes, if textured { 2 } else { 1 })),
    ));
    edits
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

/// The new vertices behind those of every array that the file's vertices have.
fn longer<'a>(
    file: &File<'a>,
    of_vertices: XmlNode<'a>,
    vertices: &Vertices,
) -> Result<Option<Vec<Edit>>, FileError> {
    let mut edits = Vec::new();
    for input in children(of_vertices, "input") {
        let source = file.target(input, "source", "source")?;
        let row = |vertex: &NewVertex| match input.attribute("semantic") {
            Some("POSITION") => vertex.point.to_array().to_vec(),
            Some("NORMAL") => vertex.normal.to_array().to_vec(),
            Some("TEXCOORD") => vec![vertex.place.x, 1.0 - vertex.place.y],
            _ => Vec::new(),
        };
        let rows: Vec<Vec<f64>> = vertices.new.iter().map(row).collect();
        let Some(longer) = longer_array(file, source, &rows, vertices.count)? else { return Ok(None) };
        edits.extend(longer);
    }
    Ok(Some(edits))
}

/// An array with more rows, each filled up with zeros; `None` where other numbers than the rows stand in it.
fn longer_array<'a>(
    file: &File<'a>,
    source: XmlNode<'a>,
    rows: &[Vec<f64>],
    count: usize,
) -> Result<Option<Vec<Edit>>, FileError> {
    let Some(accessor) = descend(source, &["technique_common", "accessor"]) else { return Ok(None) };
    let Some(array) = child(source, "float_array") else { return Ok(None) };
    let stride = file.whole_attribute(accessor, "stride", 1)?;
    let numbers = file.numbers(array)?.len();
    let [Some(of_array), Some(of_accessor)] = [array, accessor].map(|node| node.attribute_node("count"))
    else {
        return Ok(None);
    };
    let last = array.last_child().filter(roxmltree::Node::is_text);
    let whole =
        accessor.attribute("offset").is_none_or(|offset| offset.trim() == "0") && numbers == stride * count;
    let (Some(last), true) = (last, whole) else { return Ok(None) };
    let filled = rows.iter().flat_map(|row| row.iter().copied().chain(std::iter::repeat(0.0)).take(stride));
    let words = list(filled.collect::<Vec<_>>().iter().map(decimal));
    let end = last.range().end;
    Ok(Some(vec![
        (of_array.range_value(), (numbers + stride * rows.len()).to_string()),
        (end..end, format!(" {words}")),
        (of_accessor.range_value(), (count + rows.len()).to_string()),
    ]))
}
