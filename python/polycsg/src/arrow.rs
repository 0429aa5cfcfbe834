//! GeoArrow: polygons and multipolygons as nested lists, or as well-known binary.
use crate::built::Built;
use crate::error::{no_polygon, unreadable};
use crate::held::{HeldFeatures, HeldOffsets};
use crate::input::Features;
use crate::ragged::Ragged;
use crate::wkb::parsed;
use arrow_array::cast::AsArray;
use arrow_array::ffi::{FFI_ArrowArray, FFI_ArrowSchema};
use arrow_array::types::Float64Type;
use arrow_array::{
    Array, ArrayRef, FixedSizeListArray, Float64Array, GenericListArray, OffsetSizeTrait, StructArray,
};
use arrow_buffer::{NullBuffer, OffsetBuffer, ScalarBuffer};
use arrow_schema::{DataType, Field, FieldRef};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use pyo3_arrow::input::AnyArray;
use std::sync::Arc;

const NAME: &str = "ARROW:extension:name";
const METADATA: &str = "ARROW:extension:metadata";

/// Features of an object with Arrow's interface. Those in one piece, with their coordinates interleaved, are not copied.
#[pyfunction]
pub(crate) fn of_arrow(py: Python<'_>, object: AnyArray) -> PyResult<HeldFeatures> {
    let (chunks, field) = object.into_chunked_array().map_err(PyErr::from)?.into_inner();
    py.detach(|| held(&chunks, field))
}

fn held(chunks: &[ArrayRef], field: FieldRef) -> PyResult<HeldFeatures> {
    let array = match chunks {
        [one] => one.clone(),
        [] => arrow_array::new_empty_array(field.data_type()),
        many => {
            let many: Vec<&dyn Array> = many.iter().map(AsRef::as_ref).collect();
            arrow_select::concat::concat(&many).map_err(unreadable)?
        }
    };
    let (array, field) = geometry(array, field)?;
    let metadata = field.metadata().get(METADATA).cloned();
    match field.metadata().get(NAME).map(String::as_str) {
        None | Some("geoarrow.polygon" | "geoarrow.multipolygon" | "geoarrow.wkb" | "ogc.wkb") => {}
        Some(other) => return Err(unreadable(no_polygon(other))),
    }
    match array.data_type() {
        DataType::Binary => parsed(array.as_binary::<i32>().iter(), metadata),
        DataType::LargeBinary => parsed(array.as_binary::<i64>().iter(), metadata),
        DataType::BinaryView => parsed(array.as_binary_view().iter(), metadata),
        _ => nested(&array, metadata),
    }
}

/// The geometry of a table, or what is one already.
fn geometry(array: ArrayRef, field: FieldRef) -> PyResult<(ArrayRef, FieldRef)> {
    let Some(table) = array.as_struct_opt().filter(|_| !field.metadata().contains_key(NAME)) else {
        return Ok((array, field));
    };
    let is_geometry =
        |field: &&FieldRef| field.metadata().get(NAME).is_some_and(|name| name.starts_with("geoarrow."));
    let fields = table.fields().clone();
    let found = fields.iter().position(|field| is_geometry(&field));
    let column = found.ok_or_else(|| unreadable("the table has no column of GeoArrow's"))?;
    Ok((table.column(column).clone(), fields[column].clone()))
}

fn nested(array: &ArrayRef, metadata: Option<String>) -> PyResult<HeldFeatures> {
    let present = array.nulls().cloned();
    let (outer, inner) = listed(array)?;
    let (middle, inner) = listed(&inner)?;
    let whole = |array: &ArrayRef| match array.null_count() {
        0 => Ok(()),
        _ => Err(unreadable("a part of a geometry is null")),
    };
    whole(&inner)?;
    if let DataType::List(_) | DataType::LargeList(_) = inner.data_type() {
        let (innermost, vertices) = listed(&inner)?;
        let coordinates = coordinates(&vertices)?;
        return Ok(HeldFeatures {
            coordinates,
            rings: innermost,
            polygons: middle,
            features: Some(outer),
            present,
            metadata,
        });
    }
    let coordinates = coordinates(&inner)?;
    Ok(HeldFeatures { coordinates, rings: middle, polygons: outer, features: None, present, metadata })
}

/// A list's offsets and what they are of.
fn listed(array: &ArrayRef) -> PyResult<(HeldOffsets, ArrayRef)> {
    match array.data_type() {
        DataType::List(_) => Ok(parts(array.as_list::<i32>())),
        DataType::LargeList(_) => Ok(parts(array.as_list::<i64>())),
        other => Err(unreadable(format!("polygons are nested lists of vertices, not {other}"))),
    }
}

fn parts<O: OffsetSizeTrait>(list: &GenericListArray<O>) -> (HeldOffsets, ArrayRef) {
    (HeldOffsets::of(list.offsets()), list.values().clone())
}

/// x and y of each vertex, copied unless they lie so already.
fn coordinates(vertices: &ArrayRef) -> PyResult<ScalarBuffer<f64>> {
    match vertices.data_type() {
        DataType::FixedSizeList(item, size) if *item.data_type() == DataType::Float64 && *size >= 2 => {
            let numbers = vertices.as_fixed_size_list().values().as_primitive::<Float64Type>().values();
            let size = usize::try_from(*size)?;
            let pairs = || numbers.chunks_exact(size).flat_map(|vertex| [vertex[0], vertex[1]]);
            Ok(if size == 2 { numbers.clone() } else { pairs().collect::<Vec<f64>>().into() })
        }
        DataType::Struct(_) => separate(vertices.as_struct()),
        other => Err(unreadable(format!("vertices are pairs of doubles, not {other}"))),
    }
}

fn separate(vertices: &StructArray) -> PyResult<ScalarBuffer<f64>> {
    let column = |name| {
        let column =
            vertices.column_by_name(name).and_then(|column| column.as_primitive_opt::<Float64Type>());
        column.ok_or_else(|| unreadable(format!("vertices have no doubles {name}")))
    };
    let (x, y) = (column("x")?, column("y")?);
    Ok(x.values().iter().zip(y.values()).flat_map(|(x, y)| [*x, *y]).collect::<Vec<f64>>().into())
}

/// Features as a GeoArrow array of multipolygons, null where `present` says no: capsules of its schema and of itself.
#[pyfunction]
pub(crate) fn to_arrow<'py>(
    py: Python<'py>,
    features: Features<'py>,
    present: Option<PyReadonlyArray1<'py, bool>>,
    metadata: Option<String>,
) -> PyResult<[Bound<'py, PyCapsule>; 2]> {
    let present = present.map(|present| Ok::<_, PyErr>(NullBuffer::from(present.as_slice()?))).transpose()?;
    let features = features.read()?;
    let array = py.detach(|| multipolygons(features, present))?;
    let name = [(NAME.to_string(), "geoarrow.multipolygon".to_string())];
    let metadata = metadata.map(|metadata| (METADATA.to_string(), metadata));
    let field = Field::new("geometry", array.data_type().clone(), true);
    let field = field.with_metadata(name.into_iter().chain(metadata).collect());
    let schema = FFI_ArrowSchema::try_from(&field).map_err(unreadable)?;
    let array = FFI_ArrowArray::new(&array.to_data());
    Ok([
        PyCapsule::new_with_value(py, schema, c"arrow_schema")?,
        PyCapsule::new_with_value(py, array, c"arrow_array")?,
    ])
}

fn multipolygons(features: Ragged<'_>, present: Option<NullBuffer>) -> PyResult<ArrayRef> {
    let built = Built::copied(features);
    let xy = Field::new("xy", DataType::Float64, false);
    let numbers = Arc::new(Float64Array::from(built.vertices));
    let vertices = FixedSizeListArray::try_new(Arc::new(xy), 2, numbers, None).map_err(unreadable)?;
    let rings = list("vertices", built.rings, Arc::new(vertices), None)?;
    let polygons = list("rings", built.polygons, rings, None)?;
    list("polygons", built.features, polygons, present)
}

/// A list of 32 bits if it can be one.
fn list(name: &str, offsets: Vec<i64>, of: ArrayRef, present: Option<NullBuffer>) -> PyResult<ArrayRef> {
    let field = Arc::new(Field::new(name, of.data_type().clone(), false));
    let narrow: Result<Vec<i32>, _> = offsets.iter().map(|offset| i32::try_from(*offset)).collect();
    let array: Result<ArrayRef, _> = match narrow {
        Ok(narrow) => GenericListArray::try_new(field, OffsetBuffer::new(narrow.into()), of, present)
            .map(|array| Arc::new(array) as ArrayRef),
        Err(_) => GenericListArray::try_new(field, OffsetBuffer::new(offsets.into()), of, present)
            .map(|array| Arc::new(array) as ArrayRef),
    };
    array.map_err(unreadable)
}
