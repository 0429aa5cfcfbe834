//! The vertices of a geometry, and those that pieces of its polygons add.
use super::file::{File, XmlNode, child, children, descend};
use super::splice::Edit;
use crate::io::error::FileError;
use crate::io::surface::changes::CutPiece;
use crate::io::surface::polygon::bits;
use crate::io::words::{decimal, list};
use glam::{DMat4, DVec2, DVec3};
use std::collections::HashMap;

/// A vertex of a piece that the file does not have.
struct NewVertex {
    point: DVec3,
    normal: DVec3,
    place: DVec2,
}

/// The vertices of a geometry by where they stand in the world, and the new ones.
pub(super) struct GeometryVertices {
    world: DMat4,
    known: HashMap<[u64; 3], usize>,
    /// How many the file has.
    count: usize,
    new: Vec<NewVertex>,
}

impl GeometryVertices {
    pub(super) fn of(positions: &[DVec3], world: DMat4) -> GeometryVertices {
        let places =
            positions.iter().enumerate().map(|(index, point)| (bits(world.transform_point3(*point)), index));
        let mut known = HashMap::new();
        places.for_each(|(place, index)| {
            known.entry(place).or_insert(index);
        });
        GeometryVertices { world, known, count: positions.len(), new: Vec::new() }
    }

    /// The index of a piece's vertex.
    pub(super) fn index(&mut self, point: DVec3, piece: &CutPiece<'_>) -> usize {
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

    /// Whether there are vertices that the file does not have.
    pub(super) fn are_more(&self) -> bool {
        !self.new.is_empty()
    }

    /// Whether the node turns outlines round.
    pub(super) fn is_mirrored(&self) -> bool {
        self.world.determinant() < 0.0
    }

    /// The new vertices behind those of every array that the file's vertices have; `None` where an array has no room.
    pub(super) fn longer<'a>(
        &self,
        file: &File<'a>,
        of_vertices: XmlNode<'a>,
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
            let rows: Vec<Vec<f64>> = self.new.iter().map(row).collect();
            let Some(longer) = longer_array(file, source, &rows, self.count)? else { return Ok(None) };
            edits.extend(longer);
        }
        Ok(Some(edits))
    }
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
