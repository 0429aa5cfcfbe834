//! An error says what is wrong, where, and what to do.
use polycsg::{Csg, Error, FillRule, Region, Scratch};

#[test]
fn a_bad_coordinate_is_named_with_its_place() {
    let rings = [vec![[0.0, 0.0]], vec![[0.0, 0.0], [1.0, f64::NAN]]];
    let error = Region::from_rings(&rings, FillRule::EvenOdd).expect_err("not a number");
    assert_eq!(error.to_string(), "ring 1, vertex 1: a coordinate is NaN or infinite; give finite numbers");
}

#[test]
fn a_limit_is_named() {
    assert_eq!(
        Error::TooManyContacts { limit: 7 }.to_string(),
        "edges meet more than 7 times; raise the limit or split the operands"
    );
    assert_eq!(
        Error::TooMuchWork { limit: 7 }.to_string(),
        "the evaluation takes more than 7 units of work; raise the limit or split the operands"
    );
    assert_eq!(Error::Stopped.to_string(), "the caller stopped the evaluation");
}

#[test]
fn what_bounds_nothing_has_no_boundary() {
    let mut scratch = Scratch::default();
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let all = Csg::from_rings([square], FillRule::NonZero).expect("finite");
    assert!(!all.boundary(&mut scratch).is_empty());
    assert!((all.clone() - all).boundary(&mut scratch).is_empty());
}
