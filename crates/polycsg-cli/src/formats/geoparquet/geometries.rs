//! A column of geometries as polygons.
use crate::formats::wkb;
use crate::layer::areas::{Areas, Reading, polygon_of};
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, ListArray, StructArray};
use arrow_schema::DataType;
use geo_types::{Coord, LineString, Polygon};

/// How a column's geometries are encoded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoding {
    Wkb,
    /// Lists of rings, which are lists of vertices.
    Polygon,
    /// Lists of these.
    MultiPolygon,
}

impl Encoding {
    /// By its name in the metadata and the type of the column.
    pub(super) fn of(name: &str, data_type: &DataType) -> Result<Encoding, String> {
        let is_binary = matches!(data_type, DataType::Binary | DataType::LargeBinary | DataType::BinaryView);
        match name {
            "WKB" if is_binary => Ok(Encoding::Wkb),
            "polygon" if depth(data_type) == Some(2) => Ok(Encoding::Polygon),
            "multipolygon" if depth(data_type) == Some(3) => Ok(Encoding::MultiPolygon),
            "WKB" | "polygon" | "multipolygon" => {
                Err(format!("the geometries are not stored as {name} says: {data_type}"))
            }
            _ => Err(format!(
                "geometries in the encoding {name:?} have no area; give WKB, polygon or multipolygon"
            )),
        }
    }
}

/// How many lists are around the structures of x and y; none if the type is another one.
fn depth(data_type: &DataType) -> Option<usize> {
    match data_type {
        DataType::List(item) => Some(1 + depth(item.data_type())?),
        DataType::Struct(fields) => {
            let is_double =
                |name| fields.iter().any(|f| f.name() == name && *f.data_type() == DataType::Float64);
            (is_double("x") && is_double("y")).then_some(0)
        }
        _ => None,
    }
}

/// The geometry of each row; an error names its row.
pub(super) fn read(array: &ArrayRef, encoding: Encoding) -> Vec<Result<Reading, String>> {
    let one = |row| if array.is_null(row) { Ok(Reading::default()) } else { of_row(array, encoding, row) };
    (0..array.len()).map(one).collect()
}

fn of_row(array: &ArrayRef, encoding: Encoding, row: usize) -> Result<Reading, String> {
    match (encoding, array.data_type()) {
        (Encoding::Wkb, DataType::Binary) => wkb::read(array.as_binary::<i32>().value(row)),
        (Encoding::Wkb, DataType::LargeBinary) => wkb::read(array.as_binary::<i64>().value(row)),
        (Encoding::Wkb, _) => wkb::read(array.as_binary_view().value(row)),
        (Encoding::Polygon, _) => {
            let (polygon, is_flattened) = polygon(array.as_list(), row)?;
            Ok(Reading { areas: Some(Areas::polygon(polygon)), is_flattened })
        }
        (Encoding::MultiPolygon, _) => {
            let parts = array.as_list::<i32>().value(row);
            let parts: Result<Vec<_>, String> =
                (0..parts.len()).map(|part| polygon(parts.as_list(), part)).collect();
            let (polygons, flattened): (Vec<_>, Vec<bool>) = parts?.into_iter().unzip();
            let is_flattened = flattened.contains(&true);
            Ok(Reading { areas: Some(Areas::multi_polygon(polygons)), is_flattened })
        }
    }
}

/// A polygon, and whether its vertices have more than x and y.
fn polygon(polygons: &ListArray, row: usize) -> Result<(Polygon<f64>, bool), String> {
    let rings = polygons.value(row);
    let rings = rings.as_list::<i32>();
    let mut is_flattened = false;
    let lines: Result<Vec<_>, String> = (0..rings.len())
        .map(|ring| {
            let vertices = rings.value(ring);
            let vertices = vertices.as_struct();
            is_flattened |= vertices.num_columns() > 2;
            line(vertices)
        })
        .collect();
    Ok((polygon_of(lines?.into_iter()), is_flattened))
}

fn line(vertices: &StructArray) -> Result<LineString<f64>, String> {
    let column = |name| vertices.column_by_name(name).map(|column| column.as_primitive::<Float64Type>());
    let (Some(x), Some(y)) = (column("x"), column("y")) else { return Err("a vertex has no x and y".into()) };
    if vertices.null_count() + x.null_count() + y.null_count() > 0 {
        return Err("a vertex is null".into());
    }
    Ok(x.values().iter().zip(y.values()).map(|(&x, &y)| Coord { x, y }).collect())
}
