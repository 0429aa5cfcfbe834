//! Conversions from and to geo-types.
#![cfg(feature = "geo-types")]

use geo_types::{MultiPolygon, Polygon, polygon};
use polycsg::{Csg, Error, FillRule, Region, Scratch};

fn frame_with_island() -> Region {
    let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
    Region::from_rings([square(0.0, 9.0), square(2.0, 7.0), square(3.0, 5.0)], FillRule::EvenOdd)
        .expect("finite")
}

#[test]
fn a_region_survives_the_round_trip() {
    let region = frame_with_island();
    let polygons = MultiPolygon::from(&region);
    assert_eq!(polygons.0.len(), 2);
    assert_eq!(polygons.0[0].interiors().len(), 1);
    assert_eq!(
        polygons.0[0].exterior().0.first(),
        polygons.0[0].exterior().0.last(),
        "closed, as geo-types is"
    );
    assert_eq!(Region::try_from(&polygons), Ok(region));
}

#[test]
fn every_bit_survives_the_round_trip() {
    let third = 1.0 / 3.0;
    let crooked = [[0.1, 5e-324], [third * 1e300, -2e-310], [1.7e308, third], [-third, 1.7e308]];
    let region = Region::from_rings([crooked], FillRule::NonZero).expect("finite");
    let polygons = MultiPolygon::from(&region);
    let mut points: Vec<(f64, f64)> = polygons.0[0].exterior().coords().map(|p| p.x_y()).collect();
    points.pop();
    let mut given = crooked.map(|[x, y]| (x, y));
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    given.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(points, given);
    assert_eq!(Region::try_from(&polygons), Ok(region));
}

#[test]
fn a_hole_cuts_whatever_its_direction_and_polygons_may_overlap() {
    let holed = polygon!(
        exterior: [(x: 0.0, y: 0.0), (x: 0.0, y: 4.0), (x: 4.0, y: 4.0), (x: 4.0, y: 0.0)],
        interiors: [[(x: 1.0, y: 1.0), (x: 1.0, y: 3.0), (x: 3.0, y: 3.0), (x: 3.0, y: 1.0)]],
    );
    assert_eq!(Region::try_from(&holed).expect("finite").area(), 12.0);
    let lid: Polygon<f64> = polygon![(x: 1.0, y: 1.0), (x: 3.0, y: 1.0), (x: 3.0, y: 5.0), (x: 1.0, y: 5.0)];
    assert_eq!(Region::try_from(&MultiPolygon(vec![holed, lid])).expect("finite").area(), 18.0);
}

#[test]
fn polygons_are_operands_as_they_are() {
    // A bow-tie stays one until the expression is evaluated, and each polygon is an operand.
    let bow: Polygon<f64> = polygon![(x: 0.0, y: 0.0), (x: 4.0, y: 4.0), (x: 4.0, y: 0.0), (x: 0.0, y: 4.0)];
    let lid: Polygon<f64> = polygon![(x: 0.0, y: 3.0), (x: 4.0, y: 3.0), (x: 4.0, y: 5.0), (x: 0.0, y: 5.0)];
    let both = MultiPolygon(vec![bow.clone(), lid.clone()]);
    let csg = Csg::try_from(&both).expect("finite");
    assert_eq!(
        csg.evaluate(),
        Csg::union([&bow, &lid].map(|p| Csg::try_from(p).expect("finite"))).evaluate()
    );
    assert_eq!(csg.evaluate(), Region::try_from(&both).expect("finite"));
    assert_eq!(
        (Csg::try_from(&bow).expect("finite") - Csg::try_from(&lid).expect("finite")).evaluate().area(),
        7.0
    );
    let mut scratch = Scratch::default();
    let sources: Vec<_> = csg.boundary(&mut scratch).edges().map(|edge| (edge.operand, edge.edge)).collect();
    assert!(sources.contains(&(0, 3)) && sources.contains(&(1, 3)), "{sources:?}");
    assert!(sources.iter().all(|&(_, edge)| edge < 4), "{sources:?}");
}

#[test]
fn a_bad_coordinate_is_named() {
    let bad: Polygon<f64> = polygon![(x: 0.0, y: 0.0), (x: f64::NAN, y: 0.0), (x: 1.0, y: 1.0)];
    assert_eq!(Region::try_from(&bad), Err(Error::NonFinite { ring: 0, vertex: 1 }));
    let good: Polygon<f64> = polygon![(x: 0.0, y: 0.0), (x: 1.0, y: 0.0), (x: 1.0, y: 1.0)];
    assert_eq!(Csg::try_from(&bad).map(|_| ()), Err(Error::NonFinite { ring: 0, vertex: 1 }));
    let error = Region::try_from(&MultiPolygon(vec![good, bad]));
    assert_eq!(error, Err(Error::NonFinite { ring: 1, vertex: 1 }));
}
