//! STL as text: `solid name`, then facets of three vertices, `endsolid`; several solids may follow one another.
use super::solid::Solid;
use crate::io::error::{Fault, Wrong};
use crate::io::surface::polygon::{Corner, Polygon};
use glam::DVec3;

/// The solids of a text. Normals are passed over, and so are letters' cases.
pub(super) fn solids(text: &str) -> Result<Vec<Solid>, Wrong> {
    let (mut solids, mut corners, mut last): (Vec<Solid>, Vec<Corner>, usize) = (Vec::new(), Vec::new(), 1);
    for (line, text) in (1..).zip(text.lines()) {
        let words: Vec<&str> = text.split_whitespace().collect();
        let Some((keyword, rest)) = words.split_first() else { continue };
        last = line;
        match keyword.to_ascii_lowercase().as_str() {
            "solid" => {
                let (name, place) = (rest.join(" "), format!("line {line}"));
                solids.push(Solid { name, place, triangles: Vec::new() });
            }
            "vertex" => corners.push(Corner { point: point(line, rest)?, ..Corner::default() }),
            "endfacet" => {
                let triangle = triangle(line, std::mem::take(&mut corners))?;
                let solid = solids
                    .last_mut()
                    .ok_or((line, Fault::Word { found: "endfacet".into(), wanted: "solid" }))?;
                solid.triangles.push(triangle);
            }
            "facet" | "outer" | "endloop" | "endsolid" => {}
            _ => {
                let found = keyword.chars().take(40).collect();
                return Err((
                    line,
                    Fault::Word { found, wanted: "solid, facet, outer, vertex or the end of one" },
                ));
            }
        }
    }
    if corners.is_empty() { Ok(solids) } else { Err((last, Fault::Short { found: text.len() })) }
}

fn triangle(line: usize, corners: Vec<Corner>) -> Result<Polygon, Wrong> {
    match corners.len() {
        3 => Ok(vec![corners]),
        found => Err((line, Fault::Count { found, wanted: 3 })),
    }
}

fn point(line: usize, words: &[&str]) -> Result<DVec3, Wrong> {
    let &[x, y, z] = words else { return Err((line, Fault::Count { found: words.len(), wanted: 3 })) };
    let mut point = DVec3::ZERO;
    for (axis, word) in [x, y, z].into_iter().enumerate() {
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        point[axis] = number.ok_or_else(|| (line, Fault::Number(word.chars().take(40).collect())))?;
    }
    Ok(point)
}
