//! Exact check that polygons with holes are a valid region: no floating-point decision, no code of `polycsg`.
mod segments;

pub use segments::{first_contact, is_bounding};

use crate::Ring;
use crate::exact::{Exact, Grid, edges};
use glam::DVec2;
use segments::{SMALL_BITS, contact_on, turn};
use std::collections::HashMap;

/// A polygon as a result states it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Counter-clockwise.
    pub outer: Ring,
    /// Clockwise, inside `outer`.
    pub holes: Vec<Ring>,
    /// Number of polygons around it.
    pub depth: usize,
}

/// Checks every law of a valid region; the error names the first that is broken.
///
/// Rings have three or more distinct points and no two edges meet but in a shared vertex; outer rings turn left, holes
/// turn right; a hole lies inside its outer ring and outside its siblings; a polygon inside another lies in one of its
/// holes, comes after it, and counts its depth; each polygon's interior is connected.
pub fn check(shapes: &[Shape]) -> Result<(), String> {
    let grid = Grid::of(rings(shapes).flatten());
    if grid.bits <= SMALL_BITS {
        check_on(shapes, |p| [grid.small_steps(p.x), grid.small_steps(p.y)])
    } else {
        check_on(shapes, |p| [grid.steps(p.x), grid.steps(p.y)])
    }
}

fn rings(shapes: &[Shape]) -> impl Iterator<Item = &Ring> {
    shapes.iter().flat_map(|s| std::iter::once(&s.outer).chain(&s.holes))
}

/// A ring in grid steps.
type Loop<T> = Vec<[T; 2]>;

struct Nest<T> {
    outer: Loop<T>,
    holes: Vec<Loop<T>>,
}

fn check_on<T: Exact>(shapes: &[Shape], steps: impl Fn(&DVec2) -> [T; 2]) -> Result<(), String> {
    for (index, ring) in rings(shapes).enumerate() {
        check_points(ring).map_err(|e| format!("ring {index}: {e}"))?;
    }
    let segments: Vec<[DVec2; 2]> = rings(shapes).flat_map(|r| edges(r)).map(|(a, b)| [a, b]).collect();
    if let Some((i, j)) = contact_on(&segments, &steps) {
        return Err(format!("edges meet: {:?} and {:?}", segments[i], segments[j]));
    }
    let on_grid = |ring: &Ring| ring.iter().map(&steps).collect::<Loop<T>>();
    let nests: Vec<Nest<T>> = shapes
        .iter()
        .map(|s| Nest { outer: on_grid(&s.outer), holes: s.holes.iter().map(on_grid).collect() })
        .collect();
    for (index, (nest, shape)) in nests.iter().zip(shapes).enumerate() {
        check_holes(nest).map_err(|e| format!("polygon {index}: {e}"))?;
        check_connected(shape).map_err(|e| format!("polygon {index}: {e}"))?;
    }
    check_depths(&nests, shapes)
}

fn check_points(ring: &Ring) -> Result<(), String> {
    if ring.len() < 3 {
        return Err(format!("only {} points", ring.len()));
    }
    let mut sorted: Vec<(f64, f64)> = ring.iter().map(|p| (p.x, p.y)).collect();
    sorted.sort_by(|a, b| a.partial_cmp(b).expect("coordinates are finite"));
    match sorted.windows(2).find(|w| w[0] == w[1]) {
        Some(pair) => Err(format!("visits {:?} twice", pair[0])),
        None => Ok(()),
    }
}

fn check_holes<T: Exact>(nest: &Nest<T>) -> Result<(), String> {
    if !twice_area(&nest.outer).is_positive() {
        return Err("its outer ring is not counter-clockwise".into());
    }
    for (index, hole) in nest.holes.iter().enumerate() {
        if !twice_area(hole).is_negative() {
            return Err(format!("hole {index} is not clockwise"));
        }
        if !lies_inside(hole, &nest.outer)? {
            return Err(format!("hole {index} lies outside"));
        }
        for (other_index, other) in nest.holes.iter().enumerate() {
            if other_index != index && lies_inside(hole, other)? {
                return Err(format!("hole {index} lies in hole {other_index}"));
            }
        }
    }
    Ok(())
}

/// Rings that touch in points must form a forest, or they fence off a part of the interior.
fn check_connected(shape: &Shape) -> Result<(), String> {
    let mut visitors: HashMap<[u64; 2], Vec<usize>> = HashMap::new();
    for (ring_index, ring) in rings(std::slice::from_ref(shape)).enumerate() {
        for p in ring {
            visitors.entry([(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]).or_default().push(ring_index);
        }
    }
    let mut parent: Vec<usize> = (0..=shape.holes.len()).collect();
    let mut shared: Vec<&Vec<usize>> = visitors.values().filter(|v| v.len() > 1).collect();
    shared.sort();
    for rings in shared {
        let root = parent.len();
        parent.push(root);
        for &ring in rings {
            let top = root_of(&parent, ring);
            if top == root_of(&parent, root) {
                return Err("touching rings cut its interior in two".into());
            }
            parent[top] = root_of(&parent, root);
        }
    }
    Ok(())
}

fn root_of(parent: &[usize], mut index: usize) -> usize {
    while parent[index] != index {
        index = parent[index];
    }
    index
}

fn check_depths<T: Exact>(nests: &[Nest<T>], shapes: &[Shape]) -> Result<(), String> {
    for (index, inner) in nests.iter().enumerate() {
        let mut depth = 0;
        for (other_index, other) in nests.iter().enumerate() {
            if other_index == index || !lies_inside(&inner.outer, &other.outer)? {
                continue;
            }
            depth += 1;
            if other_index > index {
                return Err(format!("polygon {index} lies inside polygon {other_index}, which comes later"));
            }
            let mut is_in_a_hole = false;
            for hole in &other.holes {
                is_in_a_hole |= lies_inside(&inner.outer, hole)?;
            }
            if !is_in_a_hole {
                return Err(format!("polygon {index} overlaps polygon {other_index}"));
            }
        }
        if depth != shapes[index].depth {
            return Err(format!("polygon {index} has depth {depth}, not {}", shapes[index].depth));
        }
    }
    Ok(())
}

/// True when every edge of `inner` lies inside `outer`, false when none does; rings must not meet but in vertices.
fn lies_inside<T: Exact>(inner: &Loop<T>, outer: &Loop<T>) -> Result<bool, String> {
    let sides = (0..inner.len()).map(|i| {
        let (p, q) = (&inner[i], &inner[(i + 1) % inner.len()]);
        is_inside(&[p[0].clone() + q[0].clone(), p[1].clone() + q[1].clone()], outer)
    });
    let mut count = 0;
    for is_inside in sides {
        count += usize::from(is_inside);
    }
    match count {
        0 => Ok(false),
        all if all == inner.len() => Ok(true),
        _ => Err("two rings cross in a shared vertex".into()),
    }
}

/// Crossing parity for a point given in half steps, not on the ring.
fn is_inside<T: Exact>(doubled: &[T; 2], ring: &Loop<T>) -> bool {
    let mut is_odd = false;
    for i in 0..ring.len() {
        let twice = |p: &[T; 2]| [T::from(2) * p[0].clone(), T::from(2) * p[1].clone()];
        let (a, b) = (twice(&ring[i]), twice(&ring[(i + 1) % ring.len()]));
        let (is_a_below, is_b_below) = (a[1] <= doubled[1], b[1] <= doubled[1]);
        if is_a_below != is_b_below {
            let turn = turn(&a, &b, doubled);
            is_odd ^= if is_a_below { turn.is_positive() } else { turn.is_negative() };
        }
    }
    is_odd
}

fn twice_area<T: Exact>(ring: &Loop<T>) -> T {
    (1..ring.len().saturating_sub(1)).fold(T::zero(), |sum, i| sum + turn(&ring[0], &ring[i], &ring[i + 1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[[f64; 2]]) -> Ring {
        points.iter().copied().map(DVec2::from).collect()
    }

    fn square(x: f64, y: f64, side: f64) -> Ring {
        ring(&[[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
    }

    fn reversed(mut ring: Ring) -> Ring {
        ring.reverse();
        ring
    }

    fn shape(outer: Ring, holes: Vec<Ring>) -> Shape {
        Shape { outer, holes, depth: 0 }
    }

    #[test]
    fn accepts_holes_islands_and_shared_vertices() {
        let annulus = shape(square(0.0, 0.0, 9.0), vec![reversed(square(1.0, 1.0, 7.0))]);
        let island = Shape { depth: 1, ..shape(square(2.0, 2.0, 2.0), vec![]) };
        assert_eq!(check(&[annulus, island]), Ok(()));
        let corners = [shape(square(0.0, 0.0, 1.0), vec![]), shape(square(1.0, 1.0, 1.0), vec![])];
        assert_eq!(check(&corners), Ok(()));
        assert_eq!(check(&[]), Ok(()));
    }

    #[test]
    fn refuses_every_kind_of_defect() {
        let defects = [
            ("two points", vec![shape(ring(&[[0.0, 0.0], [1.0, 0.0]]), vec![])]),
            ("bow-tie", vec![shape(ring(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.0]]), vec![])]),
            ("spike", vec![shape(ring(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 2.0]]), vec![])]),
            (
                "vertex on edge",
                vec![shape(ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]), vec![])],
            ),
            ("clockwise", vec![shape(reversed(square(0.0, 0.0, 1.0)), vec![])]),
            ("hole turns left", vec![shape(square(0.0, 0.0, 9.0), vec![square(1.0, 1.0, 1.0)])]),
            ("hole outside", vec![shape(square(0.0, 0.0, 1.0), vec![reversed(square(3.0, 3.0, 1.0))])]),
            ("equal polygons", vec![shape(square(0.0, 0.0, 1.0), vec![]); 2]),
            ("shared edge", vec![shape(square(0.0, 0.0, 1.0), vec![]), shape(square(1.0, 0.0, 1.0), vec![])]),
            (
                "overlap",
                vec![
                    shape(square(0.0, 0.0, 9.0), vec![]),
                    Shape { depth: 1, ..shape(square(1.0, 1.0, 1.0), vec![]) },
                ],
            ),
            ("wrong depth", vec![Shape { depth: 1, ..shape(square(0.0, 0.0, 9.0), vec![]) }]),
            (
                "hole in hole",
                vec![shape(
                    square(0.0, 0.0, 9.0),
                    vec![reversed(square(1.0, 1.0, 7.0)), reversed(square(2.0, 2.0, 2.0))],
                )],
            ),
            (
                "cut in two",
                vec![shape(
                    square(0.0, 0.0, 4.0),
                    vec![reversed(ring(&[[0.0, 0.0], [4.0, 4.0], [1.0, 2.0]]))],
                )],
            ),
        ];
        for (name, shapes) in defects {
            assert!(check(&shapes).is_err(), "{name} was accepted");
        }
    }

    #[test]
    fn segments_bound_what_lies_left_of_them() {
        let segments =
            |rings: &[Ring]| rings.iter().flat_map(|r| edges(r)).map(|(a, b)| [a, b]).collect::<Vec<_>>();
        let (outer, inner) = (square(0.0, 0.0, 9.0), square(1.0, 1.0, 7.0));
        let hole = reversed(inner.clone());
        let diamond = ring(&[[2.0, 0.0], [4.0, 2.0], [2.0, 4.0], [0.0, 2.0]]);
        assert!(is_bounding(&segments(&[outer.clone(), hole.clone()])));
        assert!(is_bounding(&segments(&[diamond.clone(), square(4.0, 2.0, 1.0)])));
        assert!(!is_bounding(&segments(&[outer.clone(), inner])), "the inner square is wound twice");
        assert!(!is_bounding(&segments(&[hole])), "nothing is to the left of a hole alone");
        assert!(!is_bounding(&segments(&[reversed(diamond)])));
        assert!(!is_bounding(&segments(&[outer.clone(), square(8.0, 8.0, 4.0)])), "they cross");
    }

    #[test]
    fn decides_what_doubles_cannot() {
        // The apex lies 2^-60 above the base; in doubles the three differences are all multiples of each other.
        let apex = f64::from_bits(1.0_f64.to_bits() - 1);
        let thin = ring(&[[0.0, 0.0], [1.0, 1.0], [apex, 1.0 - f64::EPSILON / 2.0]]);
        assert!(check(&[shape(thin, vec![])]).is_err(), "three collinear points have no inside");
        let sliver = ring(&[[0.0, 0.0], [1.0, 1.0 - f64::EPSILON], [1.0, 1.0]]);
        assert_eq!(check(&[shape(sliver, vec![])]), Ok(()));
    }
}
