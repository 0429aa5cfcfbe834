//! The pieces of polygons that were cut: elements behind their primitive.
use super::file::{XmlNode, children};
use super::outlines::{ElementFrame, IndexedPolygon};
use super::primitive::{Layout, Primitive};
use super::splice::{Edit, Splice};
use super::vertices::GeometryVertices;
use crate::escape::escape;
use crate::io::surface::changes::{CutPiece, Pieces, Side};
use crate::io::words::{decimal, list};
use glam::{DVec2, DVec3};

/// The pieces, behind the primitive, and the places of their pictures before the vertices.
pub(super) fn cut_pieces<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    primitive: &Primitive<'a>,
    layout: &Layout<'a>,
    vertices: &mut GeometryVertices,
    pieces: &Pieces<'_>,
) -> Vec<Edit> {
    let sides = [Side::OfMaterial, Side::Front, Side::Back];
    let mut places = pieces.is_textured.then(Vec::new);
    let mut shape = |piece: &CutPiece<'_>| -> IndexedPolygon {
        piece.loops.iter().map(|points| ring(points, piece, vertices, &mut places)).collect()
    };
    let shapes = sides.map(|side| pieces.of_side(side).map(&mut shape).collect::<Vec<_>>());
    let of_vertices = layout.vertices.attribute("id").unwrap_or_default();
    let mut inputs = input("VERTEX", of_vertices, "offset=\"0\"");
    let mut edits = Vec::new();
    if let Some(places) = &places {
        let id = splice.fresh(&format!("{of_vertices}-places"));
        inputs +=
            &input("TEXCOORD", &id, &format!("offset=\"1\" set=\"{}\"", escape(set_of(primitive.element))));
        let start = layout.vertices.range().start;
        edits.push((start..start, source_text(&id, &["S", "T"], places)));
    }
    let end = primitive.element.range().end;
    for (side, shapes) in sides.into_iter().zip(shapes).filter(|(_, shapes)| !shapes.is_empty()) {
        let frame = ElementFrame::of(splice.text, primitive.element);
        let mut frame = if side == Side::OfMaterial { frame } else { frame.one_sided() };
        frame.inputs.clone_from(&inputs);
        edits.push((end..end, format!("\n{}", frame.polygons(&shapes))));
    }
    edits
}

/// The indices of a piece's corners, each followed by that of its place in the picture where there is one.
fn ring(
    points: &[DVec3],
    piece: &CutPiece<'_>,
    vertices: &mut GeometryVertices,
    places: &mut Option<Vec<Vec<f64>>>,
) -> Vec<Vec<usize>> {
    let mut corners = Vec::new();
    for &point in points {
        let mut corner = vec![vertices.index(point, piece)];
        if let Some(places) = places {
            let place = piece.texture.map_or(DVec2::ZERO, |texture| texture.place(point));
            corner.push(places.len());
            // COLLADA counts a picture's rows from below.
            places.push(vec![place.x, 1.0 - place.y]);
        }
        corners.push(corner);
    }
    if vertices.is_mirrored() {
        corners.reverse();
    }
    corners
}

fn input(semantic: &str, source: &str, rest: &str) -> String {
    format!("<input semantic=\"{semantic}\" source=\"#{}\" {rest}/>\n", escape(source))
}

/// The set of a picture's places that an element uses.
fn set_of<'a>(element: XmlNode<'a>) -> &'a str {
    let places = children(element, "input").find(|input| input.attribute("semantic") == Some("TEXCOORD"));
    places.and_then(|input| input.attribute("set")).unwrap_or("0")
}

/// A source of rows of numbers.
pub(super) fn source_text(id: &str, names: &[&str], rows: &[Vec<f64>]) -> String {
    let (id, count, stride) = (escape(id), rows.len(), names.len());
    let numbers = list(rows.iter().flatten().map(decimal));
    let params: String =
        names.iter().map(|name| format!("<param name=\"{name}\" type=\"float\"/>")).collect();
    format!(
        "<source id=\"{id}\"><float_array id=\"{id}-array\" count=\"{}\">{numbers}</float_array><technique_common>\
         <accessor source=\"#{id}-array\" count=\"{count}\" stride=\"{stride}\">{params}</accessor></technique_common></source>\n",
        stride * count
    )
}
