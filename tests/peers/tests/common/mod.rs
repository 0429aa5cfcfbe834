//! Where the peers keep their test cases, and how results are compared.

use i_overlay::core::fill_rule::FillRule as OverlayFill;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};
use polycsg::{Csg, FillRule, Region};
use std::path::PathBuf;
use std::process::Command;

/// A ring of integer points.
pub(crate) type Ring = Vec<[f64; 2]>;

/// What is done with subject and clip.
#[allow(dead_code, reason = "each collection uses some")]
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op {
    Union,
    Intersection,
    Difference,
    InverseDifference,
    SymmetricDifference,
}

/// What rings mean.
#[allow(dead_code, reason = "each collection uses some")]
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rule {
    EvenOdd,
    NonZero,
    Positive,
    Negative,
}

/// What a result looks like.
#[derive(Clone, Debug)]
pub(crate) struct Summary {
    area: f64,
    /// The number of holes of each polygon, in order of size.
    holes: Vec<usize>,
    /// Whether some polygon has holes of more area than its outer ring: then holes hang on a wrong one.
    is_misnested: bool,
}

impl Summary {
    fn of(polygons: &[Vec<Ring>]) -> Summary {
        let mut holes: Vec<usize> = polygons.iter().map(|rings| rings.len() - 1).collect();
        holes.sort_unstable();
        let area = |rings: &Vec<Ring>| rings.iter().map(|ring| signed_area(ring)).sum::<f64>();
        let is_misnested = polygons.iter().any(|rings| area(rings) < 0.0);
        Summary { area: polygons.iter().map(area).sum(), holes, is_misnested }
    }
}

/// Both have the same area, polygons and holes; and the same holes in each polygon, unless the peer's nesting cannot be.
///
/// i_overlay 9.1 hangs three holes of area 138 to 580 on a polygon of area 3.5 in Clipper2's cases 165 and 166.
pub(crate) fn assert_same(ours: &Summary, theirs: &Summary, case: &str) {
    assert!(!ours.is_misnested, "{case}");
    assert!((ours.area - theirs.area).abs() <= 1e-9 * ours.area, "{case}: {} for {}", ours.area, theirs.area);
    assert_eq!(ours.holes.len(), theirs.holes.len(), "{case}: polygons");
    assert_eq!(ours.holes.iter().sum::<usize>(), theirs.holes.iter().sum::<usize>(), "{case}: holes");
    assert!(
        theirs.is_misnested || ours.holes == theirs.holes,
        "{case}: {:?} for {:?}",
        ours.holes,
        theirs.holes
    );
}

/// The sources of a package that this workspace depends on, where cargo keeps them.
pub(crate) fn sources(package: &str) -> PathBuf {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--format-version", "1", "--all-features", "--manifest-path"]);
    let output = cargo.arg(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")).output().unwrap();
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let versions = metadata["packages"].as_array().unwrap().iter().filter(|found| found["name"] == package);
    let newest = versions.max_by_key(|found| major(found["version"].as_str().unwrap())).unwrap();
    PathBuf::from(newest["manifest_path"].as_str().unwrap()).parent().unwrap().to_owned()
}

fn major(version: &str) -> u32 {
    version.split('.').next().unwrap().parse().unwrap()
}

/// polycsg's result.
pub(crate) fn evaluate(op: Op, subject: &[Ring], clip: &[Ring], rule: Rule) -> Region {
    let read = |rings: &[Ring]| match rule {
        Rule::EvenOdd => Csg::from_rings(rings, FillRule::EvenOdd).unwrap(),
        Rule::NonZero => Csg::from_rings(rings, FillRule::NonZero).unwrap(),
        Rule::Positive => Csg::from_rings(rings, FillRule::Positive).unwrap(),
        Rule::Negative => Csg::from_rings(turned(rings), FillRule::Positive).unwrap(),
    };
    let (a, b) = (read(subject), read(clip));
    let csg = match op {
        Op::Union => a | b,
        Op::Intersection => a & b,
        Op::Difference => a - b,
        Op::InverseDifference => b - a,
        Op::SymmetricDifference => a ^ b,
    };
    csg.evaluate()
}

fn turned(rings: &[Ring]) -> Vec<Ring> {
    rings.iter().map(|ring| ring.iter().rev().copied().collect()).collect()
}

/// Area and structure of a region.
pub(crate) fn summary(region: &Region) -> Summary {
    let ring = |points: &[polycsg::DVec2]| points.iter().map(|p| [p.x, p.y]).collect::<Ring>();
    let rings = |p: polycsg::Polygon<'_>| std::iter::once(p.outer()).chain(p.holes()).map(ring).collect();
    Summary::of(&region.polygons().map(rings).collect::<Vec<_>>())
}

/// The same from i_overlay on its finest grid, asked for rings that touch in points only.
pub(crate) fn fine_overlay(op: Op, subject: &[Ring], clip: &[Ring], rule: Rule) -> Summary {
    let op = match op {
        Op::Union => OverlayRule::Union,
        Op::Intersection => OverlayRule::Intersect,
        Op::Difference => OverlayRule::Difference,
        Op::InverseDifference => OverlayRule::InverseDifference,
        Op::SymmetricDifference => OverlayRule::Xor,
    };
    let fill = match rule {
        Rule::EvenOdd => OverlayFill::EvenOdd,
        Rule::NonZero => OverlayFill::NonZero,
        Rule::Positive => OverlayFill::Positive,
        Rule::Negative => OverlayFill::Negative,
    };
    let (options, solver) = (OverlayOptions::ogc(), Default::default());
    let mut overlay: FloatOverlay<[f64; 2], i64> =
        FloatOverlay::from_subj_and_clip_custom(subject, clip, options, solver);
    Summary::of(&overlay.overlay(op, fill))
}

/// Of a ring given without its first point repeated.
pub(crate) fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum()
}

/// How far areas may be apart when the peer rounds crossings to a grid: no point of its boundary moves further than half the
/// diagonal of a cell, so the areas differ by less than what a disk of that radius sweeps along the boundary.
pub(crate) fn rounding_tolerance(region: &Region, cell: f64) -> f64 {
    let radius = cell * 0.5_f64.sqrt();
    let length = |ring: &[polycsg::DVec2]| -> f64 {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a.distance(*b)).sum()
    };
    let perimeter: f64 = region.rings().map(length).sum();
    let caps = region.rings().count() as f64 * std::f64::consts::PI * radius * radius;
    radius * perimeter + caps
}
