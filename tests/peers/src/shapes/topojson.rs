//! Reads polygons from TopoJSON: arcs of quantised steps, shared by neighbours.

use crate::job::{Polygon, Ring};
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct Topology {
    transform: Transform,
    arcs: Vec<Vec<[f64; 2]>>,
    objects: BTreeMap<String, Value>,
}

#[derive(Deserialize)]
struct Transform {
    scale: [f64; 2],
    translate: [f64; 2],
}

#[derive(Deserialize)]
#[serde(tag = "type", content = "arcs")]
enum Shape {
    Polygon(Vec<Vec<i64>>),
    MultiPolygon(Vec<Vec<Vec<i64>>>),
}

/// The polygons of one object of a topology, each an outer ring and its holes, turned either way.
pub(super) fn polygons(text: &str, object: &str) -> Result<Vec<Polygon>, String> {
    let topology: Topology = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let arcs: Vec<Ring> = topology.arcs.iter().map(|arc| absolute(arc, &topology.transform)).collect();
    let geometries = topology.objects.get(object).and_then(|object| object["geometries"].as_array());
    let mut polygons = Vec::new();
    for geometry in geometries.ok_or_else(|| format!("no object {object}"))? {
        let shape = Shape::deserialize(geometry).map_err(|error| error.to_string())?;
        let parts = match shape {
            Shape::Polygon(part) => vec![part],
            Shape::MultiPolygon(parts) => parts,
        };
        polygons.extend(parts.iter().map(|part| polygon(part, &arcs)));
    }
    Ok(polygons)
}

/// Steps on the integer lattice, summed and mapped to coordinates.
fn absolute(steps: &[[f64; 2]], transform: &Transform) -> Ring {
    let Transform { scale, translate } = transform;
    let mut at = [0.0, 0.0];
    let point = |step: &[f64; 2]| {
        at = [at[0] + step[0], at[1] + step[1]];
        [at[0] * scale[0] + translate[0], at[1] * scale[1] + translate[1]]
    };
    steps.iter().map(point).collect()
}

fn polygon(rings: &[Vec<i64>], arcs: &[Ring]) -> Polygon {
    rings.iter().map(|indices| ring(indices, arcs)).filter(|ring| ring.len() > 2).collect()
}

/// Arcs in a row, each without its last point, with which the next begins; !i is arc i backwards.
fn ring(indices: &[i64], arcs: &[Ring]) -> Ring {
    let mut ring = Ring::new();
    for &index in indices {
        let backwards = index < 0;
        let position = usize::try_from(if backwards { !index } else { index }).unwrap_or(usize::MAX);
        let Some(arc) = arcs.get(position) else { continue };
        let points = arc.len().saturating_sub(1);
        if backwards {
            ring.extend(arc.iter().rev().take(points));
        } else {
            ring.extend(arc.iter().take(points));
        }
    }
    ring.dedup();
    ring
}
