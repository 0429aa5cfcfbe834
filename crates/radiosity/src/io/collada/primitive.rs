//! A geometry's polygons: positions through sources and accessors, loops through the primitives' indices.
use super::file::{File, XmlNode, child, children, descend};
use crate::io::error::{Fault, FileError};
use crate::io::surface::polygon::{Corner, Polygon};
use crate::scene::finding::Finding;
use glam::{DVec2, DVec3};
use std::{collections::HashMap, collections::hash_map::Entry};

/// A `<polylist>`, `<triangles>`, …: polygons of one material.
pub(super) struct Primitive<'a> {
    pub(super) element: XmlNode<'a>,
    /// The symbol that the instance binds to a material.
    pub(super) material: Option<&'a str>,
    /// In the geometry's coordinates.
    pub(super) polygons: Vec<Polygon>,
    /// Whether all are triangles because the element has nothing else.
    pub(super) is_cut: bool,
}

/// The primitives of a geometry that have area, and warnings about what has none.
pub(super) fn primitives<'a>(
    file: &File<'a>,
    geometry: XmlNode<'a>,
    warnings: &mut Vec<Finding>,
) -> Result<Vec<Primitive<'a>>, FileError> {
    let Some(mesh) = child(geometry, "mesh") else {
        let what = "only <mesh> geometry is read; another kind is left out";
        Finding::note(warnings, file.place(geometry), what, "turn it into a mesh");
        return Ok(Vec::new());
    };
    let mut sources = HashMap::new();
    let mut all = Vec::new();
    for element in surfaces(geometry) {
        let polygons = polygons(file, element, &mut sources, warnings)?;
        let is_cut = !matches!(element.tag_name().name(), "polylist" | "polygons");
        all.push(Primitive { element, material: element.attribute("material"), polygons, is_cut });
    }
    for line in mesh.children().filter(|node| matches!(node.tag_name().name(), "lines" | "linestrips")) {
        let what = "lines have no area; they are left out";
        Finding::note(warnings, file.place(line), what, "remove them, or make them surfaces");
    }
    Ok(all)
}

/// The primitive elements of a geometry that have area, in the order of the file.
pub(super) fn surfaces<'a>(geometry: XmlNode<'a>) -> impl Iterator<Item = XmlNode<'a>> {
    let elements = child(geometry, "mesh").into_iter().flat_map(|mesh| mesh.children());
    elements.filter(|node| {
        matches!(node.tag_name().name(), "polylist" | "polygons" | "triangles" | "tristrips" | "trifans")
    })
}

fn polygons<'a>(
    file: &File<'a>,
    element: XmlNode<'a>,
    sources: &mut HashMap<XmlNode<'a>, Vec<DVec3>>,
    warnings: &mut Vec<Finding>,
) -> Result<Vec<Polygon>, FileError> {
    let Some(layout) = layout(file, element)? else { return Ok(Vec::new()) };
    let positions = match sources.entry(layout.source) {
        Entry::Occupied(known) => known.into_mut(),
        Entry::Vacant(new) => new.insert(rows(file, layout.source, 3)?),
    };
    // Light does not depend on these: broken ones are as good as none.
    let mut beside = |source: Option<(XmlNode<'a>, usize)>, width| {
        let (source, offset) = source?;
        let read = rows(file, source, width).map_err(|error| {
            let what = "normals or places in a picture that cannot be read are left out";
            Finding::note(warnings, error.to_string(), what, "export the file again");
        });
        read.ok().map(|rows| (rows, offset))
    };
    let (places, normals) = (beside(layout.places, 2), beside(layout.normals, 3));
    let points = Vertices { file, layout: &layout, positions, places, normals };
    let outlines = |rings: Vec<Vec<Corner>>| rings.into_iter().map(|ring| vec![ring]);
    let mut all = Vec::new();
    match element.tag_name().name() {
        "polylist" => {
            let ring = child(element, "p").map_or(Ok(Vec::new()), |p| points.ring(p))?;
            all.extend(outlines(polylist(file, element, &ring)?));
        }
        "polygons" => all = with_holes(file, element, &points)?,
        tag => {
            for p in children(element, "p") {
                let ring = points.ring(p)?;
                all.extend(outlines(triangles(file, p, tag, &ring)?));
            }
        }
    }
    Ok(all)
}

/// Where the position's index stands among the indices of a vertex, and what it points into; the same for the picture's
/// coordinates and the normals, where there are any.
pub(super) struct Layout<'a> {
    pub(super) stride: usize,
    offset: usize,
    /// The element that tells what a vertex has.
    pub(super) vertices: XmlNode<'a>,
    pub(super) source: XmlNode<'a>,
    places: Option<(XmlNode<'a>, usize)>,
    pub(super) normals: Option<(XmlNode<'a>, usize)>,
}

/// `None` for a primitive without any input: it has no polygons either.
pub(super) fn layout<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<Option<Layout<'a>>, FileError> {
    let (mut stride, mut vertex, mut places, mut normals) = (0, None, None, None);
    for input in children(element, "input") {
        let offset = file.whole_attribute(input, "offset", 0)?;
        let next = offset.checked_add(1).ok_or_else(|| file.fault(input, Fault::Huge("the offset")))?;
        stride = stride.max(next);
        let source = || file.target(input, "source", "source").ok().map(|source| (source, offset));
        match input.attribute("semantic") {
            Some("VERTEX") => vertex = Some((input, offset)),
            Some("TEXCOORD") => places = places.or_else(source),
            Some("NORMAL") => normals = normals.or_else(source),
            _ => {}
        }
    }
    let Some((input, offset)) = vertex else {
        let is_empty = |p: XmlNode<'_>| {
            p.descendants().all(|node| node.text().is_none_or(|text| text.trim().is_empty()))
        };
        let empty = child(element, "ph").is_none() && children(element, "p").all(is_empty);
        return if empty {
            Ok(None)
        } else {
            Err(file.fault(element, Fault::Child("input semantic=\"VERTEX\"")))
        };
    };
    let vertices = file.target(input, "source", "vertices")?;
    let position = children(vertices, "input").find(|input| input.attribute("semantic") == Some("POSITION"));
    let position =
        position.ok_or_else(|| file.fault(vertices, Fault::Child("input semantic=\"POSITION\"")))?;
    let source = file.target(position, "source", "source")?;
    let of_vertex = |semantic| {
        let input = children(vertices, "input").find(|input| input.attribute("semantic") == Some(semantic));
        input.and_then(|input| file.target(input, "source", "source").ok()).map(|source| (source, offset))
    };
    let (places, normals) =
        (places.or_else(|| of_vertex("TEXCOORD")), normals.or_else(|| of_vertex("NORMAL")));
    Ok(Some(Layout { stride, offset, vertices, source, places, normals }))
}

/// The rows of a source, of two or three numbers each, through its accessor where it has one; the third of two is 0.
pub(super) fn rows<'a>(file: &File<'a>, source: XmlNode<'a>, width: usize) -> Result<Vec<DVec3>, FileError> {
    let array = file.child(source, "float_array")?;
    let Some(accessor) = descend(source, &["technique_common", "accessor"]) else {
        return points(file, array, [width, width], 0, None);
    };
    let array = match accessor.attribute("source") {
        Some(_) => file.target(accessor, "source", "float_array")?,
        None => array,
    };
    let stride = file.whole_attribute(accessor, "stride", width)?;
    let offset = file.whole_attribute(accessor, "offset", 0)?;
    let count =
        accessor.attribute("count").map(|_| file.whole_attribute(accessor, "count", 0)).transpose()?;
    if stride < width {
        return Err(file.fault(accessor, Fault::Count { found: stride, wanted: width }));
    }
    points(file, array, [width, stride], offset, count)
}

/// As many points as `count` says, or as the array holds.
fn points<'a>(
    file: &File<'a>,
    array: XmlNode<'a>,
    [width, stride]: [usize; 2],
    offset: usize,
    count: Option<usize>,
) -> Result<Vec<DVec3>, FileError> {
    let numbers = file.numbers(array)?;
    let short = |wanted| file.fault(array, Fault::Count { found: numbers.len(), wanted });
    let values = numbers.get(offset..).ok_or_else(|| short(offset))?;
    let whole = values.chunks(stride).filter(|chunk| chunk.len() >= width);
    let all = whole.map(|row| DVec3::new(row[0], row[1], if width == 2 { 0.0 } else { row[2] }));
    let points: Vec<DVec3> = all.take(count.unwrap_or(usize::MAX)).collect();
    match count {
        Some(count) if points.len() < count => {
            Err(short(count.saturating_mul(stride).saturating_add(offset)))
        }
        _ => Ok(points),
    }
}

/// Turns index lists into points.
struct Vertices<'f, 'a> {
    file: &'f File<'a>,
    layout: &'f Layout<'a>,
    positions: &'f [DVec3],
    places: Option<(Vec<DVec3>, usize)>,
    normals: Option<(Vec<DVec3>, usize)>,
}

impl<'a> Vertices<'_, 'a> {
    /// The points of a `<p>` or `<h>`.
    fn ring(&self, p: XmlNode<'a>) -> Result<Vec<Corner>, FileError> {
        let indices = self.file.wholes(p)?;
        let stride = self.layout.stride;
        if indices.len() % stride != 0 {
            let wanted = indices.len().next_multiple_of(stride);
            return Err(self.file.fault(p, Fault::Count { found: indices.len(), wanted }));
        }
        indices.chunks(stride).map(|vertex| self.corner(p, vertex)).collect()
    }

    fn corner(&self, p: XmlNode<'a>, vertex: &[usize]) -> Result<Corner, FileError> {
        let row = |rows: &[DVec3], index: usize| {
            let found = rows.get(index).copied();
            found.ok_or_else(|| self.file.fault(p, Fault::Index { index, len: rows.len() }))
        };
        let optional = |rows: &Option<(Vec<DVec3>, usize)>| match rows {
            Some((rows, offset)) => row(rows, vertex[*offset]).map(Some),
            None => Ok(None),
        };
        // COLLADA counts a picture's rows from below.
        let place = optional(&self.places)?.map_or(DVec2::ZERO, |place| DVec2::new(place.x, 1.0 - place.y));
        let normal = optional(&self.normals)?.unwrap_or_default();
        Ok(Corner { point: row(self.positions, vertex[self.layout.offset])?, place, normal })
    }
}

/// The polygons of a `<polylist>`.
pub(super) fn polylist<'a, T: Clone>(
    file: &File<'a>,
    element: XmlNode<'a>,
    ring: &[T],
) -> Result<Vec<Vec<T>>, FileError> {
    let Some(p) = child(element, "p") else { return Ok(Vec::new()) };
    let counts = file.wholes(file.child(element, "vcount")?)?;
    let wanted = counts.iter().fold(0_usize, |sum, count| sum.saturating_add(*count));
    if wanted != ring.len() {
        return Err(file.fault(p, Fault::Count { found: ring.len(), wanted }));
    }
    let mut rest = ring;
    let mut next = |count: usize| {
        let (polygon, after) = rest.split_at(count);
        rest = after;
        polygon.to_vec()
    };
    Ok(counts.into_iter().map(&mut next).collect())
}

fn with_holes<'a>(
    file: &File<'a>,
    element: XmlNode<'a>,
    points: &Vertices<'_, 'a>,
) -> Result<Vec<Polygon>, FileError> {
    let mut all = Vec::new();
    for polygon in element.children() {
        match polygon.tag_name().name() {
            "p" => all.push(vec![points.ring(polygon)?]),
            "ph" => {
                let outline = points.ring(file.child(polygon, "p")?)?;
                let holes = children(polygon, "h").map(|hole| points.ring(hole));
                all.push(std::iter::once(Ok(outline)).chain(holes).collect::<Result<_, _>>()?);
            }
            _ => {}
        }
    }
    Ok(all)
}

/// The triangles of a list, a strip (every second one turned) or a fan.
pub(super) fn triangles<'a, T: Clone>(
    file: &File<'a>,
    p: XmlNode<'a>,
    tag: &str,
    ring: &[T],
) -> Result<Vec<Vec<T>>, FileError> {
    if tag == "triangles" {
        if ring.len() % 3 != 0 {
            let wanted = ring.len().next_multiple_of(3);
            return Err(file.fault(p, Fault::Count { found: ring.len(), wanted }));
        }
        return Ok(ring.chunks(3).map(<[T]>::to_vec).collect());
    }
    let strip = tag == "tristrips";
    let corners = |i: usize| match (strip, i % 2) {
        (true, 0) => [i, i + 1, i + 2],
        (true, _) => [i + 1, i, i + 2],
        (false, _) => [0, i + 1, i + 2],
    };
    Ok((0..ring.len().saturating_sub(2)).map(|i| corners(i).map(|k| ring[k].clone()).to_vec()).collect())
}
