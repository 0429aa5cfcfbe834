//! Whether geometries are valid as they are, in the sense of the simple features' standard, decided exactly.
//!
//! The rings' boundary under the even-odd rule tells: in a valid geometry each edge is part of it, cut at most where a vertex of another
//! ring touches it, and the rings of the region are those that were given.
use crate::input::Features;
use crate::ragged::Ragged;
use crate::run::{each, run};
use exactfloat::orient2d;
use polycsg::{Csg, FillRule, Region, Scratch};
use pyo3::prelude::*;
use std::collections::{HashMap, HashSet};

/// Why each feature is not valid; None where it is.
#[pyfunction]
pub(crate) fn flaws(py: Python<'_>, features: Features<'_>) -> PyResult<Vec<Option<String>>> {
    let features = features.read()?;
    run(py, features.vertices(), |stop| {
        each(features.len(), stop, |scratch, i| Ok(Rings::of(features, i).flaw(scratch)))
    })
}

/// The rings of one feature.
struct Rings<'a> {
    rings: Vec<&'a [[f64; 2]]>,
    /// The polygon of each.
    polygon: Vec<usize>,
}

/// A piece of a ring's edge.
#[derive(Clone, Copy)]
struct Piece {
    start: [f64; 2],
    end: [f64; 2],
}

impl<'a> Rings<'a> {
    fn of(features: Ragged<'a>, feature: usize) -> Self {
        let mut found = Rings { rings: vec![], polygon: vec![] };
        for (number, polygon) in features.polygons(feature).enumerate() {
            for ring in polygon {
                found.rings.push(features.ring(ring));
                found.polygon.push(number);
            }
        }
        found
    }

    fn flaw(&self, scratch: &mut Scratch) -> Option<String> {
        let short = self.rings.iter().position(|ring| ring.len() < 3 && !self.is_empty_polygon(ring));
        if let Some(ring) = short {
            return Some(format!("ring {ring}: it has fewer than 3 vertices"));
        }
        let expression = match Csg::from_rings(&self.rings, FillRule::EvenOdd) {
            Ok(expression) => expression,
            Err(error) => return Some(error.to_string()),
        };
        let pieces = match self.pieces(&expression, scratch) {
            Ok(pieces) => pieces,
            Err([ring, vertex]) => {
                return Some(format!(
                    "ring {ring}, vertex {vertex}: the edge from there crosses or covers another edge"
                ));
            }
        };
        if let Some((ring, [x, y])) = touching_itself(&pieces) {
            return Some(format!("ring {ring}: it touches itself in ({x}, {y})"));
        }
        let point = pieces.iter().position(|pieces| pieces.is_empty());
        if let Some(ring) = point.filter(|ring| !self.is_empty_polygon(self.rings[*ring])) {
            return Some(format!("ring {ring}: all of its vertices are equal"));
        }
        self.misplaced(&pieces, &expression.evaluate_with(scratch))
    }

    /// An empty polygon may have a ring without vertices.
    fn is_empty_polygon(&self, ring: &[[f64; 2]]) -> bool {
        ring.is_empty() && self.rings.len() == 1
    }

    /// The pieces of each ring, in order; or ring and vertex where an edge begins that is not all there.
    fn pieces(&self, expression: &Csg<'_>, scratch: &mut Scratch) -> Result<Vec<Vec<Piece>>, [usize; 2]> {
        let mut of_edge = vec![vec![]; self.rings.iter().map(|ring| ring.len()).sum()];
        for edge in expression.boundary(scratch).edges() {
            of_edge[edge.edge].push([edge.start, edge.end].map(|p| p.to_array()));
        }
        let vertices: HashSet<[u64; 2]> =
            self.rings.iter().copied().flatten().map(|p| key(plain(*p))).collect();
        let touches = |start, end, p| vertices.contains(&key(p)) && orient2d(start, end, p) == 0.0;
        let (mut of_edge, mut all) = (of_edge.into_iter(), vec![]);
        for (number, ring) in self.rings.iter().enumerate() {
            let mut found = vec![];
            let ends = ring.iter().cycle().skip(1);
            for (vertex, ((start, end), pieces)) in ring.iter().zip(ends).zip(of_edge.by_ref()).enumerate() {
                found.extend(
                    chained([start, end].map(|p| plain(*p)), pieces, touches).ok_or([number, vertex])?,
                );
            }
            all.push(found);
        }
        Ok(all)
    }

    /// What is wrong with the places of rings that only touch one another.
    fn misplaced(&self, pieces: &[Vec<Piece>], region: &Region) -> Option<String> {
        let mut owner = HashMap::new();
        for (ring, pieces) in pieces.iter().enumerate() {
            for Piece { start, end } in pieces {
                owner.insert([key(*start), key(*end)], ring);
                owner.insert([key(*end), key(*start)], ring);
            }
        }
        let is_shell = |ring: usize| ring == 0 || self.polygon[ring - 1] != self.polygon[ring];
        for polygon in region.polygons() {
            let mut shell = None;
            for found in std::iter::once(polygon.outer()).chain(polygon.holes()) {
                let ends = found.iter().cycle().skip(1);
                let owners =
                    found.iter().zip(ends).map(|(a, b)| owner[&[key(a.to_array()), key(b.to_array())]]);
                let rings: Vec<usize> = owners.collect();
                let ring = rings[0];
                if let Some(other) = rings.iter().find(|other| **other != ring) {
                    return Some(format!("rings {ring} and {other}: they cut the interior in parts"));
                }
                match shell {
                    None if is_shell(ring) => shell = Some(ring),
                    None => return Some(format!("ring {ring}: a hole lies outside of its polygon")),
                    Some(_) if is_shell(ring) => {
                        return Some(format!("ring {ring}: a polygon lies inside another"));
                    }
                    Some(shell) if self.polygon[shell] != self.polygon[ring] => {
                        return Some(format!("ring {ring}: a hole lies outside of its polygon"));
                    }
                    Some(_) => {}
                }
            }
        }
        None
    }
}

fn key([x, y]: [f64; 2]) -> [u64; 2] {
    [x.to_bits(), y.to_bits()]
}

/// -0.0 reads as 0.0.
fn plain(p: [f64; 2]) -> [f64; 2] {
    p.map(|x| x + 0.0)
}

/// The pieces of an edge, in its direction; none unless they make up all of it, and are cut where a vertex touches it.
fn chained(
    [start, end]: [[f64; 2]; 2],
    mut pieces: Vec<[[f64; 2]; 2]>,
    touches: impl Fn([f64; 2], [f64; 2], [f64; 2]) -> bool,
) -> Option<Vec<Piece>> {
    if start == end {
        return Some(vec![]);
    }
    let (mut at, mut found) = (start, vec![]);
    while at != end {
        let next = pieces.iter().position(|ends| ends.contains(&at))?;
        let [a, b] = pieces.swap_remove(next);
        let to = if a == at { b } else { a };
        if to != end && !touches(start, end, to) {
            return None;
        }
        found.push(Piece { start: at, end: to });
        at = to;
    }
    Some(found)
}

/// A ring that visits a point twice, and the point.
fn touching_itself(pieces: &[Vec<Piece>]) -> Option<(usize, [f64; 2])> {
    pieces.iter().enumerate().find_map(|(ring, pieces)| {
        let mut starts: Vec<[f64; 2]> = pieces.iter().map(|piece| piece.start).collect();
        starts.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        starts.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| (ring, pair[0]))
    })
}
