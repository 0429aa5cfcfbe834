//! A lit GLB with other colours: a new `COLOR_0` from `_RADIOSITY`.
use super::buffer::{container, single};
use super::container::chunks;
use crate::expose::Exposure;
use crate::io::error::{Fault, FileError};
use crate::io::save::bytes_of;
use serde_json::{Value, json};
use std::path::Path;

/// The bytes of a GLB file that [`glb`](super::glb) wrote, with colours of another exposure. Without an exposure it is the one
/// that the file was written with, or that of all lit vertices: see [`Exposure::of`].
///
/// # Errors
/// [`FileError::Read`] and [`FileError::Gltf`]; [`FileError::Part`] where no primitive has `_RADIOSITY` and `COLOR_0` of three floats.
pub fn exposed(path: impl AsRef<Path>, exposure: Option<Exposure>) -> Result<Vec<u8>, FileError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let bytes = bytes_of(path)?;
    let refused = |source: gltf::Error| FileError::Gltf { file: name.clone(), source: Box::new(source) };
    let (text, binary) = chunks(&name, &bytes)?;
    let mut document: Value =
        serde_json::from_slice(text).map_err(|error| refused(gltf::Error::Deserialize(error)))?;
    let mut binary = binary.map(<[u8]>::to_vec).unwrap_or_default();
    let lit = lit(&document, &binary).ok_or_else(|| FileError::Part {
        file: name.clone(),
        part: "meshes".into(),
        fault: Fault::Missing("no primitive has _RADIOSITY and COLOR_0 of three floats each".into()),
    })?;
    let all = lit.iter().flat_map(|(light, _)| light.iter().map(|colour| (*colour, 1.0, false)));
    let kept = || Exposure::new(document["asset"]["extras"]["exposure"].as_f64()?);
    let exposure = exposure.or_else(kept).unwrap_or_else(|| Exposure::of(all));
    document["asset"]["extras"]["exposure"] = exposure.k().into();
    for (light, colours) in &lit {
        let rows: Vec<[f32; 3]> = light.iter().map(|row| exposure.intensity(*row).map(single)).collect();
        let bound = |pick: fn(f32, f32) -> f32| {
            let rows = rows.iter().copied();
            rows.reduce(|a, b| std::array::from_fn(|band| pick(a[band], b[band]))).unwrap_or_default()
        };
        let accessor = &mut document["accessors"][colours.accessor];
        (accessor["min"], accessor["max"]) = (json!(bound(f32::min)), json!(bound(f32::max)));
        let bytes = rows.iter().flatten().flat_map(|number| number.to_le_bytes());
        binary[colours.start..].iter_mut().zip(bytes).for_each(|(old, new)| *old = new);
    }
    container(&document, binary)
}

/// Where an accessor of three floats lies, without gaps, in the binary chunk.
struct Floats {
    accessor: usize,
    start: usize,
    end: usize,
}

/// The radiosity of every lit primitive, and where its colours lie; none where there is no such primitive.
fn lit(document: &Value, binary: &[u8]) -> Option<Vec<(Vec<[f64; 3]>, Floats)>> {
    let primitives =
        document["meshes"].as_array()?.iter().filter_map(|mesh| mesh["primitives"].as_array()).flatten();
    let pair = |primitive: &Value| {
        let attribute = |name: &str| floats(document, binary, primitive["attributes"][name].as_u64()?);
        // What is shown of a picture is what falls on it.
        let light = attribute("_IRRADIANCE").or_else(|| attribute("_RADIOSITY"))?;
        let colours = attribute("COLOR_0")?;
        let number = |four: &[u8]| four.try_into().map_or(0.0, |four| f64::from(f32::from_le_bytes(four)));
        let row = |row: &[u8]| std::array::from_fn(|band| number(&row[4 * band..4 * band + 4]));
        let rows: Vec<[f64; 3]> = binary[light.start..light.end].chunks_exact(12).map(row).collect();
        (colours.end - colours.start == light.end - light.start).then_some((rows, colours))
    };
    let all: Vec<_> = primitives.filter_map(pair).collect();
    (!all.is_empty()).then_some(all)
}

fn floats(document: &Value, binary: &[u8], accessor: u64) -> Option<Floats> {
    let accessor = usize::try_from(accessor).ok()?;
    let number = |value: &Value| usize::try_from(value.as_u64().unwrap_or(0)).ok();
    let row = document["accessors"].get(accessor)?;
    let view = document["bufferViews"].get(number(row.get("bufferView")?)?)?;
    let packed = matches!(view["byteStride"].as_u64(), None | Some(12));
    let start = number(&view["byteOffset"])?.checked_add(number(&row["byteOffset"])?)?;
    let end = number(&row["count"])?.checked_mul(12)?.checked_add(start)?;
    let fits = row["componentType"] == 5126 && row["type"] == "VEC3" && view["buffer"] == 0;
    (packed && fits && end <= binary.len()).then_some(Floats { accessor, start, end })
}
