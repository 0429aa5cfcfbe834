//! Triangulations of nasty regions: they cover the region once, add no vertex, and are constrained Delaunay.
use glam::DVec2;
use polycsg::{Csg, FillRule};
use tests::against::{csg, leaf};
use tests::generators::{KINDS, lattice, nasty};
use tests::oracle::Operation;
use tests::triangles::{check_cover, check_delaunay};

#[test]
fn triangles_cover_every_nasty_region_once() {
    for kind in 0..KINDS.len() {
        for seed in 0..30 {
            let pair = nasty(kind, seed);
            for operation in Operation::ALL {
                let region = csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate();
                check_cover(&region).unwrap_or_else(|e| panic!("{} {operation:?}: {e}", pair.name));
            }
        }
    }
}

#[test]
fn triangles_are_constrained_delaunay() {
    let is_ordinary = |name: &str| !["exponents", "subnormals"].iter().any(|part| name.contains(part));
    let kinds = (0..KINDS.len()).filter(|&kind| is_ordinary(KINDS[kind].0));
    let pairs = kinds.flat_map(|kind| (0..4).map(move |seed| nasty(kind, seed)));
    for pair in (0..150).map(lattice).chain(pairs) {
        let region = csg(Operation::Union, leaf(&pair.a), leaf(&pair.b)).evaluate();
        check_delaunay(&region).unwrap_or_else(|e| panic!("{}: {e}", pair.name));
    }
}

/// A disk of many corners minus a crowd of small squares, some of which touch: large, with holes of every kind.
#[test]
fn a_large_perforated_disk() {
    let circle = |count: u32, radius: f64| -> Vec<DVec2> {
        let corner =
            |i: u32| radius * DVec2::from_angle(f64::from(i) / f64::from(count) * std::f64::consts::TAU);
        (0..count).map(corner).collect()
    };
    let square = |i: u32, j: u32| {
        let low = DVec2::new(f64::from(i), f64::from(j)) * 0.5 - DVec2::splat(10.0);
        [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| low + p * 0.5).to_vec()
    };
    let squares =
        (0..40).flat_map(|i| (0..40).filter(move |j| (i + j) % 2 == 0 || j % 3 == 0).map(move |j| (i, j)));
    let squares = Csg::from_rings(squares.map(|(i, j)| square(i, j)), FillRule::NonZero).expect("finite");
    let disk = Csg::from_rings([circle(3000, 9.7)], FillRule::NonZero).expect("finite");
    let region = (disk - squares).evaluate();
    check_cover(&region).unwrap_or_else(|e| panic!("{e}"));
}
