//! Bad input: typed errors that name the row, whatever the bytes are.
mod common;

use arrow_array::{ArrayRef, LargeBinaryArray, StringArray};
use arrow_schema::{DataType, Field, Schema};
use common::{add_table, answer, literal, own, point_wkb, polygon_wkb, session, square, wkb};
use datafusion_common::{DataFusionError, Result};
use datafusion_expr::function::AccumulatorArgs;
use polycsg_datafusion::{Error, Functions};
use proptest::prelude::*;
use std::sync::Arc;

const ALL: [&str; 12] = [
    "st_area(geom)",
    "st_makevalid(geom)",
    "st_isvalid(geom)",
    "st_isvalidreason(geom)",
    "st_intersection(geom, geom)",
    "st_union(geom, geom)",
    "st_difference(geom, geom)",
    "st_symdifference(geom, geom)",
    "st_contains(geom, geom)",
    "st_intersects(geom, geom)",
    "st_union_agg(geom)",
    "st_intersection_agg(geom)",
];

/// The rows 0 to 2 are good, the row 3 is not.
async fn refused(call: &str, bad: Vec<u8>) -> DataFusionError {
    let (context, good) = (session(1), || ("k", Some(polygon_wkb(&[square(0.0, 1.0)]))));
    add_table(&context, "t", &[vec![good(), ("k", None), good(), ("k", Some(bad)), good()]]);
    answer(&context, &format!("SELECT {call} FROM t")).await.expect_err(call)
}

#[tokio::test]
async fn broken_bytes_name_their_row() {
    let whole = wkb(&[vec![square(0.0, 1.0)]]);
    let changed = |at: usize, byte: u8| {
        let mut bytes = whole.clone();
        bytes[at] = byte;
        bytes
    };
    let line = [&[1, 2, 0, 0, 0, 2, 0, 0, 0][..], &[0; 32]].concat();
    let bad = [
        (vec![], "broken"),
        (whole[..50].to_vec(), "broken"),
        ([&whole[..], &[0]].concat(), "1 bytes stand behind its end"),
        (changed(0, 7), "broken"),
        (changed(1, 99), "broken"),
        (changed(5, 200), "broken"),
        (changed(9, 0), "order of bytes"),
        (changed(10, 2), "no Polygon of its dimension"),
        (changed(11, 3), "no Polygon of its dimension"),
        (line, "not a LineString"),
    ];
    for call in ALL {
        for (bytes, told) in &bad {
            let error = refused(call, bytes.clone()).await;
            let Some(Error::Row { row: 3, why }) = own(&error) else { panic!("{call} {told}: {error}") };
            assert!(why.contains(told) || why.contains("broken"), "{call}: {why}");
        }
    }
}

#[tokio::test]
async fn what_is_not_finite_names_its_row_ring_and_vertex() {
    for x in [f64::NAN, f64::INFINITY] {
        let bad = polygon_wkb(&[square(0.0, 9.0), vec![[1.0, 1.0], [2.0, 1.0], [x, 2.0]]]);
        for call in ALL.into_iter().filter(|call| !call.starts_with("st_isvalid")) {
            let error = refused(call, bad.clone()).await;
            let Some(Error::Row { row: 3, why }) = own(&error) else { panic!("{call}: {error}") };
            assert!(why.contains("ring 1, vertex 2"), "{call}: {why}");
        }
    }
    let error = refused("st_contains(geom, geom)", point_wkb(1.0, f64::INFINITY)).await;
    assert!(matches!(own(&error), Some(Error::Row { row: 3, .. })), "{error}");
}

#[tokio::test]
async fn points_are_no_areas() {
    for call in
        ["st_union(geom, geom)", "st_makevalid(geom)", "st_union_agg(geom)", "st_intersection_agg(geom)"]
    {
        let error = refused(call, point_wkb(1.0, 1.0)).await;
        let Some(Error::Row { row: 3, why }) = own(&error) else { panic!("{call}: {error}") };
        assert!(why.contains("not a Point"), "{why}");
    }
}

#[tokio::test]
async fn types_are_refused_when_a_query_is_planned() {
    let (context, square) = (session(1), literal(&polygon_wkb(&[square(0.0, 1.0)])));
    for call in [
        "st_area('POINT (0 0)')".to_string(),
        "st_area(1)".into(),
        "st_area()".into(),
        format!("st_area({square}, {square})"),
        format!("st_union({square})"),
        format!("st_union({square}, 7)"),
        "st_union_agg(1.5)".into(),
        format!("st_union_agg({square}, {square})"),
    ] {
        let error = context.sql(&format!("SELECT {call}")).await.expect_err(&call);
        assert!(error.to_string().contains("st_"), "{call}: {error}");
    }
}

/// A state that another version, or a broken disk, made.
#[test]
fn a_broken_state_is_refused() -> Result<()> {
    let function = Functions::default().aggregates().remove(0);
    let field = Arc::new(Field::new("geom", DataType::Binary, true));
    let schema = Schema::new(vec![field.clone()]);
    let merge = |state: ArrayRef| {
        let mut accumulator = function.accumulator(AccumulatorArgs {
            return_field: field.clone(),
            schema: &schema,
            ignore_nulls: false,
            order_bys: &[],
            is_reversed: false,
            name: "union",
            is_distinct: false,
            exprs: &[],
            expr_fields: std::slice::from_ref(&field),
        })?;
        accumulator.merge_batch(&[state]).and_then(|()| accumulator.evaluate())
    };
    let nan = [&[1, 0, 0, 0, 1, 0, 0, 0][..], &f64::NAN.to_le_bytes(), &1.0_f64.to_le_bytes()].concat();
    for bytes in [&[1][..], &[255; 4], &[255; 40], &[1, 0, 0, 0, 3, 0, 0, 0, 9], &nan] {
        let error = merge(Arc::new(LargeBinaryArray::from_iter_values([bytes]))).expect_err("it is broken");
        assert!(matches!(own(&error), Some(Error::State(_))), "{error}");
    }
    assert!(merge(Arc::new(StringArray::from(vec!["text"]))).is_err());
    Ok(())
}

/// What a call gives on bytes, without an engine around it.
fn call(bytes: &[u8]) -> Vec<bool> {
    let runtime = tokio::runtime::Builder::new_current_thread().build().expect("a runtime");
    runtime.block_on(async {
        let context = session(1);
        add_table(&context, "t", &[vec![("k", Some(bytes.to_vec()))]]);
        let mut found = vec![];
        for call in
            ["st_makevalid(geom)", "st_isvalidreason(geom)", "st_union_agg(geom)", "st_contains(geom, geom)"]
        {
            found.push(answer(&context, &format!("SELECT {call} FROM t")).await.is_ok());
        }
        found
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whole geometries with a few bytes changed, cut or added: an answer or an error, never a panic.
    #[test]
    fn changed_bytes_never_panic(
        changes in prop::collection::vec((0_usize..400, any::<u8>()), 0..6),
        cut in 0_usize..400,
        tail in prop::collection::vec(any::<u8>(), 0..20),
    ) {
        let mut bytes = wkb(&[vec![square(0.0, 9.0), square(1.0, 2.0)], vec![square(20.0, 21.0)]]);
        for (at, byte) in changes {
            if let Some(place) = bytes.get_mut(at) {
                *place = byte;
            }
        }
        bytes.truncate(cut);
        bytes.extend(tail);
        prop_assert_eq!(call(&bytes).len(), 4);
    }
}
