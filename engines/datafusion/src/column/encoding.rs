//! How the geometries of a column are encoded, by the column's type and metadata.
use arrow_schema::{DataType, Field, FieldRef};
use datafusion_common::{Result, plan_err};
use geoarrow_schema::{GeoArrowType, MultiPolygonType};
use std::sync::Arc;

const NAME: &str = "ARROW:extension:name";
const METADATA: &str = "ARROW:extension:metadata";

/// An encoding of geometries.
#[derive(Clone, Debug)]
pub(crate) enum Encoding {
    /// Well-known binary, in one of Arrow's three types of binaries; all values NULL, if the type is that.
    Wkb(DataType),
    /// GeoArrow's nested lists.
    Native(GeoArrowType),
}

impl Encoding {
    /// That of a column, for a function of some name.
    pub(crate) fn of(function: &str, field: &Field) -> Result<Encoding> {
        let name = field.metadata().get(NAME).map(String::as_str);
        match (field.data_type(), name) {
            (binary, None) if is_binary(binary) => Ok(Encoding::Wkb(binary.clone())),
            (binary, Some("geoarrow.wkb" | "ogc.wkb")) if is_binary(binary) => {
                planar(function, field).map(|_| Encoding::Wkb(binary.clone()))
            }
            (_, Some("geoarrow.polygon" | "geoarrow.multipolygon" | "geoarrow.point")) => {
                planar(function, field).map(Encoding::Native)
            }
            (found, None) => plan_err!(
                "{function} takes geometries as WKB (Binary, LargeBinary, BinaryView) or as GeoArrow's polygons, \
                 multipolygons or points, not {found}"
            ),
            (found, Some(name)) => plan_err!(
                "{function} takes geometries as WKB or as GeoArrow's polygons, multipolygons or points, not {name} ({found})"
            ),
        }
    }

    /// A column of results in this encoding, with the metadata of the one that it came from.
    pub(crate) fn result_field(&self, function: &str, of: &Field) -> FieldRef {
        Arc::new(match self {
            Encoding::Wkb(DataType::Null) => Field::new(function, DataType::Binary, true),
            Encoding::Wkb(binary) => {
                Field::new(function, binary.clone(), true).with_metadata(of.metadata().clone())
            }
            Encoding::Native(native) => multipolygons(native).to_field(function, true),
        })
    }
}

/// The type of results: a polygon can become several.
pub(crate) fn multipolygons(native: &GeoArrowType) -> MultiPolygonType {
    let kind = MultiPolygonType::new(geoarrow_schema::Dimension::XY, native.metadata().clone());
    kind.with_coord_type(native.coord_type().unwrap_or_default())
}

/// Whether values of a type can be geometries, as far as the type alone tells.
pub(crate) fn may_be_geometry(kind: &DataType) -> bool {
    is_binary(kind) || kind.is_nested()
}

fn is_binary(kind: &DataType) -> bool {
    matches!(kind, DataType::Binary | DataType::LargeBinary | DataType::BinaryView | DataType::Null)
}

/// What a column's metadata says of it.
fn planar(function: &str, field: &Field) -> Result<GeoArrowType> {
    match GeoArrowType::from_arrow_field(field) {
        Ok(kind) if kind.metadata().edges().is_some() => plan_err!(
            "{function}: the column's edges are curved, and these functions are of the plane; project the geometries first"
        ),
        Ok(kind) => Ok(kind),
        Err(error) => plan_err!("{function}: the column is not what its metadata says: {error}"),
    }
}

/// The encoding of the first of several columns, which must agree on the system of their coordinates.
pub(crate) fn common(function: &str, fields: &[FieldRef]) -> Result<Encoding> {
    let known = |field: &&FieldRef| *field.data_type() != DataType::Null;
    let system = |field: &FieldRef| field.metadata().get(METADATA).cloned();
    let mut systems = fields.iter().filter(known).filter_map(system);
    if let (Some(first), Some(second)) = (systems.next(), systems.next())
        && first != second
    {
        return plan_err!(
            "{function}: the two columns' coordinate systems differ: {first} and {second}; transform one"
        );
    }
    let first = fields.iter().find(known).or(fields.first());
    first.map_or(Ok(Encoding::Wkb(DataType::Null)), |field| Encoding::of(function, field))
}

/// The column that gives a result its metadata.
pub(crate) fn leading(fields: &[FieldRef]) -> FieldRef {
    let known = fields.iter().find(|field| *field.data_type() != DataType::Null);
    known.or(fields.first()).cloned().unwrap_or_else(|| Arc::new(Field::new("", DataType::Null, true)))
}
