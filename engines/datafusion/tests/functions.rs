//! Known values of the functions of rows, and PostGIS's rules for NULL and empty geometries.
mod common;

use arrow_array::cast::AsArray;
use common::{answer, binaries, literal, point_wkb, polygon_wkb, session, square, value, wkb};
use datafusion_common::{Result, ScalarValue};

const BOTH: [&str; 4] = ["st_intersection", "st_union", "st_difference", "st_symdifference"];

async fn area(sql: &str) -> Result<f64> {
    match value(&session(1), &format!("SELECT st_area({sql})")).await? {
        ScalarValue::Float64(Some(area)) => Ok(area),
        other => panic!("{other}"),
    }
}

async fn flag(sql: &str) -> Result<Option<bool>> {
    match value(&session(1), &format!("SELECT {sql}")).await? {
        ScalarValue::Boolean(flag) => Ok(flag),
        other => panic!("{other}"),
    }
}

#[tokio::test]
async fn overlays_have_the_areas_of_squares() -> Result<()> {
    let (a, b) = (literal(&polygon_wkb(&[square(0.0, 4.0)])), literal(&wkb(&[vec![square(1.0, 6.0)]])));
    for (function, expected) in BOTH.into_iter().zip([9.0, 32.0, 7.0, 23.0]) {
        assert_eq!(area(&format!("{function}({a}, {b})")).await?, expected, "{function}");
    }
    Ok(())
}

#[tokio::test]
async fn a_result_is_the_multipolygon_that_an_independent_writer_writes() -> Result<()> {
    let frame = wkb(&[vec![square(0.0, 9.0), square(2.0, 7.0).into_iter().rev().collect()]]);
    let hole = vec![[2.0, 2.0], [2.0, 7.0], [7.0, 7.0], [7.0, 2.0]];
    let expected = wkb(&[vec![square(0.0, 9.0), hole]]);
    let made = value(&session(1), &format!("SELECT st_makevalid({})", literal(&frame))).await?;
    assert_eq!(made, ScalarValue::Binary(Some(expected)));
    Ok(())
}

#[tokio::test]
async fn null_in_is_null_out_and_nothing_else_is() -> Result<()> {
    let (context, a) = (session(1), literal(&polygon_wkb(&[square(0.0, 4.0)])));
    for function in BOTH.into_iter().chain(["st_contains", "st_intersects"]) {
        for arguments in [format!("NULL, {a}"), format!("{a}, NULL"), "NULL, NULL".to_string()] {
            let found = value(&context, &format!("SELECT {function}({arguments})")).await?;
            assert!(found.is_null(), "{function}({arguments})");
        }
        assert!(!value(&context, &format!("SELECT {function}({a}, {a})")).await?.is_null());
    }
    for function in ["st_area", "st_makevalid", "st_isvalid", "st_isvalidreason"] {
        assert!(value(&context, &format!("SELECT {function}(NULL)")).await?.is_null());
        assert!(!value(&context, &format!("SELECT {function}({a})")).await?.is_null());
    }
    Ok(())
}

#[tokio::test]
async fn empty_geometries_follow_postgis() -> Result<()> {
    let a = literal(&polygon_wkb(&[square(0.0, 4.0)]));
    for empty in [polygon_wkb(&[]), wkb(&[])].map(|bytes| literal(&bytes)) {
        for (function, expected) in BOTH.into_iter().zip([0.0, 16.0, 16.0, 16.0]) {
            assert_eq!(area(&format!("{function}({a}, {empty})")).await?, expected, "{function}");
        }
        assert_eq!(area(&format!("st_difference({empty}, {a})")).await?, 0.0);
        for (x, y) in [(&a, &empty), (&empty, &a), (&empty, &empty)] {
            assert_eq!(flag(&format!("st_contains({x}, {y})")).await?, Some(false));
            assert_eq!(flag(&format!("st_intersects({x}, {y})")).await?, Some(false));
        }
        assert_eq!(flag(&format!("st_isvalid({empty})")).await?, Some(true));
    }
    let nothing = literal(&point_wkb(f64::NAN, f64::NAN));
    assert_eq!(flag(&format!("st_intersects({a}, {nothing})")).await?, Some(false));
    assert_eq!(flag(&format!("st_contains({nothing}, {nothing})")).await?, Some(false));
    Ok(())
}

#[tokio::test]
async fn areas_that_only_touch_meet_and_have_an_empty_intersection() -> Result<()> {
    let a = literal(&polygon_wkb(&[square(0.0, 1.0)]));
    let corner = literal(&polygon_wkb(&[square(1.0, 2.0)]));
    let side = literal(&polygon_wkb(&[common::rectangle([1.0, 0.0], [1.0, 1.0])]));
    let apart = literal(&polygon_wkb(&[common::rectangle([1.0_f64.next_up(), 0.0], [1.0, 1.0])]));
    for other in [corner, side] {
        assert_eq!(flag(&format!("st_intersects({a}, {other})")).await?, Some(true));
        let common = value(&session(1), &format!("SELECT st_intersection({a}, {other})")).await?;
        assert_eq!(common, ScalarValue::Binary(Some(wkb(&[]))));
    }
    assert_eq!(flag(&format!("st_intersects({a}, {apart})")).await?, Some(false));
    Ok(())
}

#[tokio::test]
async fn points_and_areas_are_closed_sets() -> Result<()> {
    let frame = literal(&polygon_wkb(&[square(0.0, 4.0), square(1.0, 3.0)]));
    for ([x, y], expected) in
        [([0.5, 0.5], true), ([0.0, 2.0], true), ([1.0, 1.0], true), ([2.0, 2.0], false), ([5.0, 2.0], false)]
    {
        let point = literal(&point_wkb(x, y));
        assert_eq!(flag(&format!("st_contains({frame}, {point})")).await?, Some(expected), "{x} {y}");
        assert_eq!(flag(&format!("st_intersects({frame}, {point})")).await?, Some(expected), "{x} {y}");
        assert_eq!(flag(&format!("st_intersects({point}, {frame})")).await?, Some(expected), "{x} {y}");
        assert_eq!(flag(&format!("st_contains({point}, {frame})")).await?, Some(false));
        assert_eq!(flag(&format!("st_contains({point}, {point})")).await?, Some(true));
    }
    let inside = literal(&polygon_wkb(&[common::rectangle([0.0, 0.0], [1.0, 4.0])]));
    assert_eq!(flag(&format!("st_contains({frame}, {inside})")).await?, Some(true));
    assert_eq!(flag(&format!("st_contains({frame}, {frame})")).await?, Some(true));
    assert_eq!(flag(&format!("st_contains({inside}, {frame})")).await?, Some(false));
    Ok(())
}

#[tokio::test]
async fn reasons_name_ring_and_vertex() -> Result<()> {
    let bow_tie = vec![[10.0, 0.0], [12.0, 2.0], [12.0, 0.0], [10.0, 2.0]];
    let nan = vec![[0.0, 0.0], [1.0, 0.0], [f64::NAN, 1.0]];
    for (geometry, expected) in [
        (wkb(&[vec![square(0.0, 1.0)], vec![square(1.0, 2.0)]]), "Valid Geometry"),
        (wkb(&[vec![square(0.0, 1.0)], vec![bow_tie]]), "ring 1, vertex 0: the edge"),
        (wkb(&[vec![square(0.0, 9.0)], vec![square(1.0, 2.0)]]), "ring 1: a polygon lies inside another"),
        (polygon_wkb(&[square(0.0, 9.0), square(10.0, 12.0)]), "ring 1: a hole lies outside"),
        (polygon_wkb(&[square(0.0, 9.0), nan]), "ring 1, vertex 2: a coordinate is NaN"),
        (point_wkb(1.0, 1.0), "Valid Geometry"),
    ] {
        let (context, geometry) = (session(1), literal(&geometry));
        let reason = value(&context, &format!("SELECT st_isvalidreason({geometry})")).await?.to_string();
        assert!(reason.starts_with(expected), "{reason}");
        let is_valid = flag(&format!("st_isvalid({geometry})")).await?;
        assert_eq!(is_valid, Some(expected == "Valid Geometry"), "{reason}");
    }
    Ok(())
}

/// A constant, a repeated row and a row of its own take three ways through the code.
#[tokio::test]
async fn a_constant_side_gives_what_a_column_does() -> Result<()> {
    let (context, mut random) = (session(1), common::Random(7));
    let octagons: Vec<Vec<u8>> = (0..60).map(|_| polygon_wkb(&[random.octagon(4.0, 1.0)])).collect();
    let rows = |repeat: usize| octagons.iter().cloned().flat_map(move |o| std::iter::repeat_n(o, repeat));
    common::add_table(&context, "once", &[rows(1).map(|o| ("k", Some(o))).collect()]);
    common::add_table(&context, "thrice", &[rows(3).map(|o| ("k", Some(o))).collect()]);
    let clip = literal(&polygon_wkb(&[square(1.0, 3.0)]));
    for function in BOTH.into_iter().chain(["st_contains", "st_intersects"]) {
        let ask = async |sql: &str| answer(&context, sql).await.map(|found| found.column(0).clone());
        let constant = ask(&format!("SELECT {function}(geom, {clip}) FROM once")).await?;
        let column =
            ask(&format!("SELECT {function}(geom, c) FROM (SELECT geom, {clip} AS c FROM once)")).await?;
        let repeated = ask(&format!("SELECT {function}(geom, {clip}) FROM thrice")).await?;
        assert_eq!(&constant, &column, "{function}");
        for row in 0..60 {
            assert_eq!(
                constant.slice(row, 1).as_ref(),
                repeated.slice(3 * row + 1, 1).as_ref(),
                "{function}"
            );
        }
    }
    Ok(())
}

#[tokio::test]
async fn all_binaries_and_big_endian_are_read_alike() -> Result<()> {
    let context = session(1);
    let big: Vec<u8> = {
        let ring = [square(0.0, 2.0), vec![[0.0, 0.0]]].concat();
        let numbers = ring.iter().flatten().flat_map(|x| x.to_be_bytes());
        [0, 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 5].into_iter().chain(numbers).collect()
    };
    let mut ewkb = polygon_wkb(&[square(0.0, 2.0)]);
    ewkb[4] |= 0x20;
    ewkb.splice(5..5, 4326_u32.to_le_bytes());
    common::add_table(&context, "t", &[vec![("big", Some(big)), ("ewkb", Some(ewkb)), ("null", None)]]);
    let expected = Some(wkb(&[vec![square(0.0, 2.0)]]));
    for kind in ["Binary", "LargeBinary", "BinaryView"] {
        let sql = format!("SELECT arrow_cast(st_makevalid(arrow_cast(geom, '{kind}')), 'Binary') FROM t");
        assert_eq!(binaries(&answer(&context, &sql).await?, 0), [expected.clone(), expected.clone(), None]);
        let sql = format!("SELECT arrow_typeof(st_makevalid(arrow_cast(geom, '{kind}'))) FROM t LIMIT 1");
        assert_eq!(answer(&context, &sql).await?.column(0).as_string::<i32>().value(0), kind);
    }
    Ok(())
}

/// z and m are not read.
#[tokio::test]
async fn more_dimensions_are_left_out() -> Result<()> {
    for (code, dimension) in [(1003_u32, 3), (2003, 3), (3003, 4), (0x8000_0003, 3)] {
        let mut bytes: Vec<u8> =
            [1].into_iter().chain(code.to_le_bytes()).chain([1, 0, 0, 0, 5, 0, 0, 0]).collect();
        for [x, y] in square(0.0, 2.0).into_iter().chain([[0.0, 0.0]]) {
            let numbers = [x, y, 7.0, f64::NAN].into_iter().take(dimension);
            bytes.extend(numbers.flat_map(f64::to_le_bytes));
        }
        assert_eq!(area(&literal(&bytes)).await?, 4.0, "{code}");
    }
    Ok(())
}
