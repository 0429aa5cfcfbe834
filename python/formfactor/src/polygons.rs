//! Polygons from arrays: vertices (n, 3), where the loops begin in them, and the polygons in the loops.
use crate::error::refused;
use formfactor::PlanarPolygon;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// Vertices, and offsets of loops and of polygons.
pub(crate) type Arrays<'py> =
    (PyReadonlyArray2<'py, f64>, PyReadonlyArray1<'py, i64>, PyReadonlyArray1<'py, i64>);

/// The polygons of arrays; `name` says in errors what they are.
pub(crate) fn polygons(py: Python<'_>, name: &str, arrays: &Arrays<'_>) -> PyResult<Vec<PlanarPolygon>> {
    let (vertices, loops, polygons) = arrays;
    let (vertices, []) = vertices.as_slice()?.as_chunks::<3>() else {
        return Err(refused("", "vertices have three columns"));
    };
    let (loops, polygons) = (loops.as_slice()?, polygons.as_slice()?);
    py.detach(|| {
        check("loops", loops, vertices.len())?;
        check("polygons", polygons, loops.len() - 1)?;
        let loop_at = |i: usize| &vertices[place(loops[i])..place(loops[i + 1])];
        let polygon = |(i, ends): (usize, &[i64])| {
            let loops = (place(ends[0])..place(ends[1])).map(|i| open(loop_at(i)));
            PlanarPolygon::new(loops).map_err(|error| refused(format!("{name} {i}: "), error))
        };
        polygons.windows(2).enumerate().map(polygon).collect()
    })
}

/// A loop without the vertex that closes it.
fn open(points: &[[f64; 3]]) -> &[[f64; 3]] {
    match points {
        [open @ .., end] if open.len() > 2 && open.first() == Some(end) => open,
        points => points,
    }
}

fn check(name: &str, offsets: &[i64], count: usize) -> PyResult<()> {
    let most = i64::try_from(count)?;
    let is_good = offsets.first() == Some(&0)
        && offsets.last().is_some_and(|last| *last <= most)
        && offsets.is_sorted();
    if is_good {
        Ok(())
    } else {
        Err(refused("", format!("offsets of {name} go from 0 up to {count} at most")))
    }
}

fn place(offset: i64) -> usize {
    usize::try_from(offset).unwrap_or_default()
}
