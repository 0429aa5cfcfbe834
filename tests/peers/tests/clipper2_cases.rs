//! Clipper2's own collection: 195 cases, each with the area that Clipper2 is held to.
//!
//! Its ring counts are those of results rounded to integers, and of rings that touch themselves: what is compared
//! instead is the structure that i_overlay finds on its 64 bit grid, and the area that Clipper2 finds on a finer grid.

#![allow(clippy::unwrap_used, reason = "a test stops at whatever is missing")]

mod common;

use clipper2::{Clipper, FillRule, One, Paths, Point};
use common::{Op, Ring, Rule, assert_same, evaluate, fine_overlay, rounding_tolerance, sources, summary};

struct Case {
    number: usize,
    op: Op,
    rule: Rule,
    area: f64,
    subject: Vec<Ring>,
    clip: Vec<Ring>,
}

fn cases() -> Vec<Case> {
    let path = sources("clipper2c-sys").join("clipper2c/vendor/Clipper2/Tests/Polygons.txt");
    let text = std::fs::read_to_string(path).unwrap();
    text.split("CAPTION:").skip(1).enumerate().map(|(i, text)| case(i + 1, text)).collect()
}

fn case(number: usize, text: &str) -> Case {
    let mut case =
        Case { number, op: Op::Union, rule: Rule::EvenOdd, area: 0.0, subject: vec![], clip: vec![] };
    let mut is_clip = false;
    for line in text.lines().skip(1).map(str::trim) {
        match line.split_once(':') {
            Some(("CLIPTYPE", name)) => case.op = op(name.trim()),
            Some(("FILLRULE", name)) => case.rule = rule(name.trim()),
            Some(("SOL_AREA", area)) => case.area = area.trim().parse().unwrap(),
            Some(_) => {}
            None if line.starts_with("SUBJECTS") => is_clip = false,
            None if line.starts_with("CLIPS") => is_clip = true,
            None if line.is_empty() => {}
            None if is_clip => case.clip.push(ring(line)),
            None => case.subject.push(ring(line)),
        }
    }
    case
}

fn op(name: &str) -> Op {
    match name {
        "UNION" => Op::Union,
        "INTERSECTION" => Op::Intersection,
        "DIFFERENCE" => Op::Difference,
        "XOR" => Op::SymmetricDifference,
        name => panic!("no operation {name}"),
    }
}

fn rule(name: &str) -> Rule {
    match name {
        "EVENODD" => Rule::EvenOdd,
        "NONZERO" => Rule::NonZero,
        "POSITIVE" => Rule::Positive,
        "NEGATIVE" => Rule::Negative,
        name => panic!("no rule {name}"),
    }
}

fn ring(line: &str) -> Ring {
    let numbers = line.split([',', ' ']).filter(|number| !number.is_empty());
    let numbers: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
    numbers.chunks_exact(2).map(|p| [p[0], p[1]]).collect()
}

/// Cells to a unit: crossings are rounded to a millionth.
const FINE: f64 = (1 << 20) as f64;

/// The area that Clipper2 finds on a grid finer by [`FINE`].
fn fine_clipper2(case: &Case) -> f64 {
    let point = |p: &[f64; 2]| Point::<One>::new(p[0] * FINE, p[1] * FINE);
    let path = |ring: &Ring| ring.iter().map(point).collect::<Vec<_>>().into();
    let paths = |rings: &[Ring]| Paths::<One>::new(rings.iter().map(path).collect());
    let clipper = Clipper::<_, One>::new().add_subject(paths(&case.subject)).add_clip(paths(&case.clip));
    let rule = match case.rule {
        Rule::EvenOdd => FillRule::EvenOdd,
        Rule::NonZero => FillRule::NonZero,
        Rule::Positive => FillRule::Positive,
        Rule::Negative => FillRule::Negative,
    };
    let result = match case.op {
        Op::Union => clipper.union(rule),
        Op::Intersection => clipper.intersect(rule),
        Op::Difference | Op::InverseDifference => clipper.difference(rule),
        Op::SymmetricDifference => clipper.xor(rule),
    };
    result.unwrap().signed_area() / (FINE * FINE)
}

#[test]
fn areas_are_clipper2s_within_its_rounding() {
    let cases = cases();
    assert_eq!(cases.len(), 195);
    for case in &cases {
        let region = evaluate(case.op, &case.subject, &case.clip, case.rule);
        region.validate().unwrap();
        // Cases without an expected area say 0 or less.
        if case.area > 0.0 {
            // Expected areas are truncated to integers.
            let tolerance = rounding_tolerance(&region, 1.0) + 1.0;
            let difference = (region.area() - case.area).abs();
            assert!(difference <= tolerance, "case {}: {} for {}", case.number, region.area(), case.area);
        }
    }
}

#[test]
fn areas_are_clipper2s_on_a_finer_grid() {
    for case in cases() {
        let region = evaluate(case.op, &case.subject, &case.clip, case.rule);
        let difference = (region.area() - fine_clipper2(&case)).abs();
        let tolerance = rounding_tolerance(&region, 1.0 / FINE) + 1e-12 * region.area();
        assert!(difference <= tolerance, "case {}: off by {difference:e} of {}", case.number, region.area());
    }
}

#[test]
fn structure_is_that_of_a_fine_grid() {
    for case in cases() {
        let ours = summary(&evaluate(case.op, &case.subject, &case.clip, case.rule));
        let theirs = fine_overlay(case.op, &case.subject, &case.clip, case.rule);
        assert_same(&ours, &theirs, &format!("case {}", case.number));
    }
}
