//! Edges that pass close to dA, halved where they come nearest.
//!
//! The plane through dA and the ends of an edge turns by the errors of the directions to these ends times the tangent of half
//! the angle between them: without bound where that angle nears a half turn.
//!
//! ```text
//!   a -------------------- n -------------------- b    Halved at n, no angle is above a quarter turn: what the edge
//!                          . dA                        sweeps is no more than the errors of its ends.
//! ```
use super::horizon::{Loops, Vertex};
use crate::numeric::offset::Offset;

/// Loops with a vertex more on every edge that subtends more than a quarter turn.
pub(crate) fn halved(loops: Loops) -> Loops {
    let is_wide = |[a, b]: [&Vertex; 2]| a.offset.round().dot(b.offset.round()) < 0.0;
    let halve = |vertices: Vec<Vertex>| -> Vec<Vertex> {
        let next = vertices.iter().cycle().skip(1);
        let pairs = vertices.iter().zip(next).map(|(a, b)| [a, b]);
        if !pairs.clone().any(is_wide) {
            return vertices;
        }
        pairs.flat_map(|pair| [Some(*pair[0]), is_wide(pair).then(|| nearest(pair))]).flatten().collect()
    };
    loops.into_iter().map(halve).collect()
}

/// The point of an edge that is nearest to dA: the same for both directions of the edge, so that shared edges stay shared.
fn nearest([a, b]: [&Vertex; 2]) -> Vertex {
    let order = |v: &Vertex| v.offset.0.map(|x| x.hi);
    let [a, b] = if order(a) < order(b) { [a, b] } else { [b, a] };
    let along: Offset = a.offset.to(b.offset);
    a.toward(b, -(a.offset.dot(along) / along.dot(along)))
}
