//! Binary STL: 80 bytes of anything, the number of triangles, then for each twelve numbers in single precision (the normal, three
//! vertices) and two bytes that some programs fill with a colour.
use super::solid::Solid;
use crate::io::error::{Fault, FileError};
use crate::io::surface::polygon::{Corner, Polygon};
use crate::scene::finding::Finding;

const HEADER: usize = 84;
const ROW: usize = 50;

/// The bytes of the triangles, where there are as many as the file says; behind them, a few bytes of padding may follow.
pub(super) fn rows(bytes: &[u8]) -> Option<&[u8]> {
    let count: [u8; 4] = bytes.get(80..HEADER)?.try_into().ok()?;
    let length = usize::try_from(u32::from_le_bytes(count)).ok()?.checked_mul(ROW)?;
    let rest = bytes[HEADER..].get(length..)?;
    (rest.len() < ROW).then(|| &bytes[HEADER..HEADER + length])
}

/// The file's one solid.
pub(super) fn solid(file: &str, rows: &[u8], warnings: &mut Vec<Finding>) -> Result<Solid, FileError> {
    let mut triangles = Vec::with_capacity(rows.len() / ROW);
    for (index, row) in rows.chunks_exact(ROW).enumerate() {
        let triangle = triangle(row).map_err(|fault| {
            let (file, part) = (file.to_owned(), format!("triangle {index}"));
            FileError::Part { file, part, fault }
        })?;
        triangles.push(triangle);
    }
    if rows.chunks_exact(ROW).any(|row| row[48..] != [0, 0]) {
        let what = "colours of facets are left out";
        Finding::note(warnings, file, what, "use another format where colours matter");
    }
    Ok(Solid { name: String::new(), place: file.to_owned(), triangles })
}

fn triangle(row: &[u8]) -> Result<Polygon, Fault> {
    let number = |at: usize| f32::from_le_bytes([row[at], row[at + 1], row[at + 2], row[at + 3]]);
    let corner = |vertex: usize| {
        let point = [0, 4, 8].map(|axis| number(12 * vertex + axis));
        match point.into_iter().find(|number| !number.is_finite()) {
            Some(number) => Err(Fault::Number(number.to_string())),
            None => Ok(Corner { point: point.map(f64::from).into(), ..Corner::default() }),
        }
    };
    Ok(vec![[1, 2, 3].into_iter().map(corner).collect::<Result<_, _>>()?])
}
