//! Regions written as an array.
use super::encoding::multipolygons;
use crate::error::Error;
use arrow_array::builder::{BinaryBuilder, BinaryViewBuilder, LargeBinaryBuilder};
use arrow_array::{Array, ArrayRef};
use arrow_schema::{DataType, Field};
use datafusion_common::{DataFusionError, Result, internal_err};
use geo_types::MultiPolygon;
use geoarrow_array::IntoArrow;
use geoarrow_array::builder::MultiPolygonBuilder;
use geoarrow_schema::GeoArrowType;
use std::sync::Arc;
use wkb::writer::{WriteOptions, write_multi_polygon};

/// Offsets of 32 bits end here.
const MOST_BYTES: usize = i32::MAX as usize;

/// An array of multipolygons in the making, in the type of a column.
pub(crate) enum Written {
    Binary(BinaryBuilder),
    Large(LargeBinaryBuilder),
    View(BinaryViewBuilder),
    Native(Box<MultiPolygonBuilder>),
}

impl Written {
    /// For a column as a function's result field says.
    pub(crate) fn new(field: &Field) -> Result<Written> {
        Ok(match field.data_type() {
            DataType::Binary => Written::Binary(BinaryBuilder::new()),
            DataType::LargeBinary => Written::Large(LargeBinaryBuilder::new()),
            DataType::BinaryView => Written::View(BinaryViewBuilder::new()),
            other => match GeoArrowType::from_arrow_field(field) {
                Ok(native) => Written::Native(Box::new(MultiPolygonBuilder::new(multipolygons(&native)))),
                Err(error) => return internal_err!("a result was planned as {other}: {error}"),
            },
        })
    }

    /// One more row; NULL, if none.
    pub(crate) fn push(&mut self, found: Option<&MultiPolygon>) -> Result<()> {
        if let Written::Native(native) = self {
            return native.push_multi_polygon(found).map_err(refused);
        }
        let bytes = found.map(to_wkb).transpose()?;
        match self {
            Written::Binary(binary) => {
                let held = binary.values_slice().len();
                if held + bytes.as_ref().map_or(0, Vec::len) > MOST_BYTES {
                    return Err(Error::TooLarge.into());
                }
                binary.append_option(bytes);
            }
            Written::Large(binary) => binary.append_option(bytes),
            Written::View(binary) => binary.append_option(bytes),
            Written::Native(_) => {}
        }
        Ok(())
    }

    pub(crate) fn finish(self) -> ArrayRef {
        match self {
            Written::Binary(mut binary) => Arc::new(binary.finish()),
            Written::Large(mut binary) => Arc::new(binary.finish()),
            Written::View(mut binary) => Arc::new(binary.finish()),
            Written::Native(native) => Arc::new(native.finish().into_arrow()) as Arc<dyn Array>,
        }
    }
}

fn to_wkb(polygons: &MultiPolygon) -> Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(wkb::writer::multi_polygon_wkb_size(polygons));
    write_multi_polygon(&mut bytes, polygons, &WriteOptions::default()).map_err(refused)?;
    Ok(bytes)
}

fn refused(error: impl std::error::Error + Send + Sync + 'static) -> DataFusionError {
    DataFusionError::External(Box::new(error))
}
