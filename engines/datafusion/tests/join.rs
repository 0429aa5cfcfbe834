//! The join by boxes gives the rows of the nested loop that it stands for.
#![cfg(feature = "join")]
mod common;

use arrow_array::{RecordBatch, StringArray, cast::AsArray};
use common::{Random, Ring, add_table, answer, own, point_wkb, polygon_wkb, rectangle, square, wkb};
use datafusion::execution::SessionStateBuilder;
use datafusion::execution::runtime_env::RuntimeEnvBuilder;
use datafusion::prelude::{SessionConfig, SessionContext};
use datafusion_common::{DataFusionError, Result};
use polycsg_datafusion::{BoxJoin, Error, Functions};
use std::future::Future;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Waker};

type Rows = Vec<(&'static str, Option<Vec<u8>>)>;

const KEYS: [&str; 4] = ["a", "b", "c", "d"];

fn joined(config: SessionConfig, bytes: usize) -> SessionContext {
    let runtime = RuntimeEnvBuilder::new().with_memory_limit(bytes, 1.0).build_arc().expect("a runtime");
    let state = SessionStateBuilder::new().with_config(config).with_runtime_env(runtime);
    let state = state.with_default_features().with_physical_optimizer_rule(Arc::new(BoxJoin));
    let mut context = SessionContext::new_with_state(state.build());
    Functions::default().register(&mut context).expect("the session takes them");
    context
}

/// Squares on a coarse grid, so that many touch, lie in one another or are equal; bow ties, holes, NULL and empty ones.
fn areas(random: &mut Random, count: usize) -> Rows {
    let mut ring = || -> Ring {
        let [x, y] = [0, 0].map(|_| random.below(12) as f64);
        rectangle([x, y], [1.0 + random.below(4) as f64, 1.0 + random.below(4) as f64])
    };
    let mut shape = |kind: usize| match kind {
        0 => None,
        1 => Some(wkb(&[])),
        2 => Some(polygon_wkb(&[])),
        3 => {
            let mut bow_tie = ring();
            bow_tie.swap(1, 2);
            Some(polygon_wkb(&[bow_tie]))
        }
        4 => Some(polygon_wkb(&[square(1.0, 9.0), square(2.0, 8.0)])),
        5 => Some(wkb(&[vec![ring()], vec![ring()]])), // they may overlap
        6 => Some(polygon_wkb(&[vec![[3.0, 3.0], [7.0, 5.0], [3.0, 3.0]]])), // a spike
        7 => Some(polygon_wkb(&[vec![[0.1, 0.2], [7.7, 1.3], [3.3, 9.1]]])),
        _ => Some(polygon_wkb(&[ring()])),
    };
    (0..count).map(|i| (KEYS[i % 4], shape(i % 16))).collect()
}

fn points(random: &mut Random, count: usize) -> Rows {
    let mut number = || random.below(25) as f64 / 2.0;
    let mut point = || Some(point_wkb(number(), number()));
    let mut rows: Rows = (0..count).map(|i| (KEYS[i % 4], point())).collect();
    rows.extend([("a", None), ("b", Some(point_wkb(f64::NAN, f64::NAN)))]);
    rows
}

fn dealt(rows: &Rows, partitions: usize) -> Vec<Rows> {
    let part = |i: usize| rows.iter().skip(i).step_by(partitions).cloned().collect();
    (0..partitions).map(part).collect()
}

fn sorted(batch: &RecordBatch) -> Vec<String> {
    let cell = |row: usize, column: usize| {
        datafusion_common::ScalarValue::try_from_array(batch.column(column), row).expect("a value")
    };
    let row = |row: usize| (0..batch.num_columns()).map(|i| format!("{:?} ", cell(row, i))).collect();
    let mut rows: Vec<String> = (0..batch.num_rows()).map(row).collect();
    rows.sort();
    rows
}

async fn plan(context: &SessionContext, sql: &str) -> Result<String> {
    let batch = answer(context, &format!("EXPLAIN {sql}")).await?;
    let text: &StringArray = batch.column(1).as_string();
    Ok(text.iter().flatten().collect())
}

/// Asks with the rule and without it, for all sizes of batches and counts of partitions.
async fn agree(tables: &[(&str, &Rows)], queries: &[&str]) -> Result<()> {
    let nested = common::session(1);
    tables.iter().for_each(|(name, rows)| add_table(&nested, name, &dealt(rows, 1)));
    let mut expected = vec![];
    for sql in queries {
        assert!(plan(&nested, sql).await?.contains("NestedLoopJoinExec"), "{sql}");
        let found = answer(&nested, sql).await?;
        assert!(found.num_rows() > 5, "{sql}: {}", found.num_rows());
        expected.push((found.schema(), sorted(&found)));
    }
    for (partitions, batch_size) in [(1, 8192), (1, 1), (3, 2), (3, 8192)] {
        let config = SessionConfig::new().with_target_partitions(partitions).with_batch_size(batch_size);
        let context = joined(config, 1 << 30);
        tables.iter().for_each(|(name, rows)| add_table(&context, name, &dealt(rows, partitions)));
        for (sql, (schema, rows)) in queries.iter().zip(&expected) {
            let plan = plan(&context, sql).await?;
            assert!(plan.contains("BoxJoinExec") && !plan.contains("NestedLoop"), "{sql}: {plan}");
            let found = answer(&context, sql).await?;
            assert_eq!((&found.schema(), &sorted(&found)), (schema, rows), "{sql} {partitions} {batch_size}");
        }
    }
    Ok(())
}

#[tokio::test]
async fn areas_are_joined_as_by_the_nested_loop() -> Result<()> {
    let mut random = Random(3);
    let (a, b) = (areas(&mut random, 120), areas(&mut random, 80));
    agree(
        &[("a", &a), ("b", &b)],
        &[
            "SELECT * FROM a JOIN b ON st_intersects(a.geom, b.geom)",
            "SELECT b.key, a.key FROM a JOIN b ON st_intersects(b.geom, a.geom)",
            "SELECT count(*) FROM a JOIN b ON st_intersects(a.geom, b.geom) GROUP BY a.key, b.key",
            "SELECT a.geom, b.key FROM a JOIN b ON st_contains(a.geom, b.geom)",
            "SELECT a.key, b.geom FROM a JOIN b ON st_contains(b.geom, a.geom)",
            "SELECT a.key, b.key FROM a, b WHERE st_intersects(a.geom, b.geom) AND a.key < b.key",
            "SELECT a.key, b.key FROM a, b WHERE a.key <> b.key AND st_contains(a.geom, b.geom)
                AND st_intersects(b.geom, a.geom)",
            "SELECT a.key FROM a JOIN b ON st_intersects(st_makevalid(a.geom), b.geom)",
            "SELECT st_intersection(a.geom, b.geom) AS geom FROM a JOIN b ON st_intersects(a.geom, b.geom)",
            "SELECT st_intersection(b.geom, a.geom) AS geom, b.key FROM a JOIN b ON st_intersects(a.geom, b.geom)",
            "SELECT a.key, st_area(st_intersection(a.geom, b.geom)) AS area, st_difference(b.geom, a.geom) AS rest,
                st_union(a.geom, b.geom) AS both, b.key AS other, b.geom
                FROM a JOIN b ON st_intersects(a.geom, b.geom) AND (a.key = 'a' OR b.key = 'b')",
            "SELECT st_intersection(a.geom, b.geom) AS geom, st_symdifference(a.geom, b.geom) AS either
                FROM a JOIN b ON st_contains(b.geom, a.geom)",
            "SELECT a.key, max(st_area(st_intersection(a.geom, b.geom))) AS area
                FROM a JOIN b ON st_intersects(a.geom, b.geom) GROUP BY a.key, b.key",
        ],
    )
    .await
}

#[tokio::test]
async fn points_are_joined_as_by_the_nested_loop() -> Result<()> {
    let mut random = Random(4);
    let (areas, points) = (areas(&mut random, 60), points(&mut random, 200));
    agree(
        &[("areas", &areas), ("points", &points)],
        &[
            "SELECT a.key, p.geom FROM areas a JOIN points p ON st_contains(a.geom, p.geom)",
            "SELECT a.key, p.geom FROM points p JOIN areas a ON st_contains(a.geom, p.geom)",
            "SELECT a.key, p.geom FROM areas a JOIN points p ON st_intersects(p.geom, a.geom)",
            "SELECT p.key, q.geom FROM points p JOIN points q ON st_intersects(p.geom, q.geom)",
            "SELECT p.key, q.geom FROM points p JOIN points q ON st_contains(p.geom, q.geom)",
        ],
    )
    .await
}

/// Areas that are known by hand: a square, one that shares a corner, one that shares half an edge, one inside, one apart.
#[tokio::test]
async fn touching_is_meeting() -> Result<()> {
    let context = joined(SessionConfig::new(), 1 << 30);
    let one = |ring: Ring| Some(polygon_wkb(&[ring]));
    add_table(&context, "a", &[vec![("square", one(square(0.0, 2.0)))]]);
    let others = vec![
        ("corner", one(square(2.0, 3.0))),
        ("edge", one(rectangle([2.0, 1.0], [1.0, 3.0]))),
        ("inside", one(square(0.5, 1.0))),
        ("apart", one(rectangle([2.5, 0.0], [1.0, 1.0]))),
        ("box only", one(vec![[2.5, 0.0], [2.5, 2.5], [0.0, 2.5], [2.25, 2.25]])),
    ];
    add_table(&context, "b", &[others]);
    for (call, expected) in [
        ("st_intersects(a.geom, b.geom)", vec!["corner", "edge", "inside"]),
        ("st_contains(a.geom, b.geom)", vec!["inside"]),
    ] {
        let sql = format!("SELECT b.key FROM a JOIN b ON {call} ORDER BY b.key");
        let found = answer(&context, &sql).await?;
        let found: &StringArray = found.column(0).as_string();
        assert_eq!(found.iter().flatten().collect::<Vec<_>>(), expected, "{call}");
    }
    Ok(())
}

#[tokio::test]
async fn other_joins_stay_nested_loops() -> Result<()> {
    let context = joined(SessionConfig::new(), 1 << 30);
    let rows = areas(&mut Random(1), 20);
    ["a", "b"].iter().for_each(|name| add_table(&context, name, std::slice::from_ref(&rows)));
    for sql in [
        "SELECT a.key FROM a LEFT JOIN b ON st_intersects(a.geom, b.geom)",
        "SELECT a.key FROM a FULL JOIN b ON st_intersects(a.geom, b.geom)",
        "SELECT a.key FROM a JOIN b ON st_intersects(a.geom, b.geom) OR a.key < b.key",
        "SELECT a.key FROM a JOIN b ON NOT st_intersects(a.geom, b.geom)",
        "SELECT a.key FROM a JOIN b ON st_area(st_union(a.geom, b.geom)) > 3",
        "SELECT a.key FROM a JOIN b ON st_intersects(st_union(a.geom, b.geom), b.geom)",
        "SELECT a.key FROM a JOIN b ON st_intersects(a.geom, a.geom) AND a.key < b.key",
    ] {
        assert!(!plan(&context, sql).await?.contains("BoxJoinExec"), "{sql}");
        answer(&context, sql).await?;
    }
    Ok(())
}

#[tokio::test]
async fn a_side_that_does_not_fit_is_refused() -> Result<()> {
    let mut random = Random(9);
    let rows: Rows = (0..2000).map(|_| ("a", Some(polygon_wkb(&[random.octagon(99.0, 1.0)])))).collect();
    let sql = "SELECT count(*) FROM a JOIN b ON st_intersects(a.geom, b.geom)";
    for (bytes, fits) in [(16 << 20, true), (400 << 10, false)] {
        let context = joined(SessionConfig::new().with_target_partitions(1), bytes);
        ["a", "b"].iter().for_each(|name| add_table(&context, name, std::slice::from_ref(&rows)));
        match answer(&context, sql).await {
            Ok(_) => assert!(fits),
            Err(error) => {
                let root = error.find_root();
                assert!(!fits && matches!(root, DataFusionError::ResourcesExhausted(_)), "{error}");
                assert!(error.to_string().contains("BoxJoinExec"), "{error}");
            }
        }
    }
    Ok(())
}

#[tokio::test]
async fn broken_geometries_name_their_row() {
    let good = || ("k", Some(polygon_wkb(&[square(0.0, 1.0)])));
    let infinite = polygon_wkb(&[square(0.0, 9.0), vec![[1.0, 1.0], [f64::NAN, 1.0], [1.0, 2.0]]]);
    for bad in [vec![1, 3, 0], infinite] {
        for names in [["good", "bad"], ["bad", "good"]] {
            let context = joined(SessionConfig::new().with_target_partitions(1), 1 << 30);
            add_table(&context, names[0], &[vec![good()]]);
            add_table(&context, names[1], &[vec![good(), ("k", None), good(), ("k", Some(bad.clone()))]]);
            let sql = "SELECT count(*) FROM good JOIN bad ON st_intersects(good.geom, bad.geom)";
            let error = answer(&context, sql).await.expect_err("broken");
            let at_row = matches!(own(&error), Some(Error::Row { row: 3, .. }));
            assert!(at_row, "{error}");
        }
    }
}

/// A join of two million pairs that all meet gives way after each step, so that a query that is dropped ends soon.
#[tokio::test]
async fn a_join_gives_way_between_its_steps() {
    let mut random = Random(2);
    let rows: Rows = (0..1500).map(|_| ("a", Some(polygon_wkb(&[random.octagon(1.0, 1.0)])))).collect();
    let context = joined(SessionConfig::new().with_target_partitions(1), 1 << 30);
    ["a", "b"].iter().for_each(|name| add_table(&context, name, std::slice::from_ref(&rows)));
    let sql = "SELECT count(st_intersection(a.geom, b.geom)) FROM a JOIN b ON st_intersects(a.geom, b.geom)";
    let mut query = pin!(answer(&context, sql));
    for step in 0..10 {
        let asked = query.as_mut().poll(&mut Context::from_waker(Waker::noop()));
        assert!(asked.is_pending(), "it was over at step {step} of more than 200");
    }
}
