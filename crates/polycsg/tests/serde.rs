//! Regions through JSON: bit for bit there and back, and nothing but a region comes in.

use polycsg::{DVec2, FillRule, Location, Membership, Region};
use proptest::prelude::*;

fn square(low: f64, high: f64) -> [[f64; 2]; 4] {
    [[low, low], [high, low], [high, high], [low, high]]
}

fn read(json: &str) -> Result<Region, String> {
    serde_json::from_str(json).map_err(|error| error.to_string())
}

#[test]
fn a_region_is_polygons_of_rings_of_points() {
    let region =
        Region::from_rings([square(0.0, 9.0), square(2.0, 7.0), square(3.0, 5.0)], FillRule::EvenOdd)
            .expect("finite");
    let json = serde_json::to_string(&region).expect("a region");
    assert_eq!(
        json,
        "[[[[0.0,0.0],[9.0,0.0],[9.0,9.0],[0.0,9.0]],[[2.0,2.0],[2.0,7.0],[7.0,7.0],[7.0,2.0]]],\
         [[[3.0,3.0],[5.0,3.0],[5.0,5.0],[3.0,5.0]]]]"
    );
    assert_eq!(read(&json), Ok(region), "with the depths");
    assert_eq!(read("[]"), Ok(Region::default()));
}

#[test]
fn what_is_no_region_is_refused_with_its_reason() {
    let cases = [
        ("[[[[0,0],[2,2],[2,0],[0,2]]]]", "edges 0 and 2 meet"),
        ("[[[[0,0],[1,1],[1,0]]]]", "canonical"),  // clockwise
        ("[[[[1,0],[1,1],[0,0]]]]", "canonical"),  // starts elsewhere
        ("[[[[0,0],[1,0],[1,1],[0,0]]]]", "meet"), // the first point repeated
        ("[[[[0,0],[4,0],[4,4],[0,4]],[[5,5],[5,6],[6,6],[6,5]]]]", "canonical"), // a hole outside
        ("[[[[0,0],[4,0],[4,4],[0,4]]],[[[0,0],[4,0],[4,4],[0,4]]]]", "meet"), // twice
        ("[[[[0,0],[4,0],[4,4],[0,4]]],[[[1,1],[1,2],[2,2],[2,1]]]]", "canonical"), // a hole as a polygon
        ("[[[[5,0],[6,0],[6,1]]],[[[0,0],[1,0],[1,1]]]]", "canonical"), // the right one first
        ("[[[[0,0],[2,0],[1,0],[1,1]]]]", "meet"), // a spike
        ("[[]]", "canonical"),
        ("[[[]]]", "canonical"),
        ("[[[[1,1]]]]", "canonical"),
        ("[[[[0,0],[null,0],[1,1]]]]", "null"),
        ("[[[[0,0],[1,0,0],[1,1]]]]", "trailing"),
        ("{}", "sequence"),
    ];
    for (json, reason) in cases {
        let error = read(json).expect_err(json);
        assert!(error.contains(reason), "{json}: {error}");
    }
}

#[test]
fn infinities_that_a_format_can_hold_are_refused() {
    let ring = [[0.0, 0.0], [f64::INFINITY, 0.0], [1.0, 1.0]].map(|p| p.to_vec()).to_vec();
    let polygons = vec![vec![ring]].into_iter();
    let deserializer = serde::de::value::SeqDeserializer::<_, serde::de::value::Error>::new(polygons);
    let error = <Region as serde::Deserialize>::deserialize(deserializer).expect_err("infinite");
    assert!(error.to_string().contains("ring 0, vertex 1"), "{error}");
}

#[test]
fn words_are_their_names() {
    let words = (FillRule::EvenOdd, Membership::OnPlus, Location::Boundary);
    let json = serde_json::to_string(&words).expect("words");
    assert_eq!(json, r#"["EvenOdd","OnPlus","Boundary"]"#);
    assert_eq!(serde_json::from_str::<(FillRule, Membership, Location)>(&json).expect("words"), words);
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-3..4i32).prop_map(f64::from),
        proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO
    ]
}

fn ring() -> impl Strategy<Value = Vec<DVec2>> {
    proptest::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| DVec2::new(x, y)), 0..7)
}

proptest! {
    #[test]
    fn every_bit_survives(rings in proptest::collection::vec(ring(), 0..4)) {
        let region = Region::from_rings(&rings, FillRule::EvenOdd).expect("finite");
        let json = serde_json::to_string(&region).expect("a region");
        prop_assert_eq!(read(&json), Ok(region));
    }

    #[test]
    fn whatever_is_accepted_is_valid(polygons in proptest::collection::vec(proptest::collection::vec(ring(), 0..3), 0..3)) {
        let arrays: Vec<Vec<Vec<[f64; 2]>>> =
            polygons.iter().map(|p| p.iter().map(|r| r.iter().map(DVec2::to_array).collect()).collect()).collect();
        if let Ok(region) = read(&serde_json::to_string(&arrays).expect("arrays")) {
            prop_assert_eq!(region.validate(), Ok(()));
        }
    }
}
