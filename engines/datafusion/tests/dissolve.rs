//! The aggregates: the same bytes however rows are split and ordered, and only exact ways to make a state smaller.
mod common;

use common::{Random, Ring, add_table, answer, binaries, polygon_wkb, rectangle, session, square, wkb};
use datafusion_common::Result;
use polycsg::{Csg, FillRule};

type Row = (&'static str, Option<Vec<u8>>);

/// Rows dealt out to partitions in some order.
fn dealt(rows: &[Row], partitions: usize, seed: u64) -> Vec<Vec<Row>> {
    let (mut rows, mut random) = (rows.to_vec(), Random(seed));
    if seed > 0 {
        random.shuffle(&mut rows);
    }
    let mut dealt = vec![vec![]; partitions];
    rows.into_iter().for_each(|row| dealt[random.below(partitions)].push(row));
    dealt
}

async fn dissolved(rows: &[Row], partitions: usize, seed: u64, sql: &str) -> Result<Vec<Option<Vec<u8>>>> {
    let context = session(partitions);
    add_table(&context, "t", &dealt(rows, partitions, seed));
    Ok(binaries(&answer(&context, sql).await?, 0))
}

/// Layers that differ in what the aggregate can do with them.
fn layers() -> Vec<(&'static str, Vec<Row>)> {
    let mut random = Random(3);
    let keys = ["a", "b", "c"];
    let crowd: Vec<Row> =
        (0..600).map(|i| (keys[i % 3], Some(polygon_wkb(&[random.octagon(20.0, 1.0)])))).collect();
    let parcels: Vec<Row> = parcels(24, &mut random)
        .into_iter()
        .map(|ring| (keys[random.below(3)], Some(polygon_wkb(&[ring]))))
        .collect();
    let nested = (0..400).map(|_| {
        let (low, size) = (random.number() * 8.0, random.number() * 2.0);
        (keys[random.below(2)], Some(polygon_wkb(&[rectangle([low, low], [size, size])])))
    });
    let large = [("a", Some(polygon_wkb(&[square(0.5, 9.5)]))), ("b", Some(wkb(&[]))), ("c", None)];
    let nested: Vec<Row> = nested.chain(large).collect();
    let mut repeated = crowd.clone();
    repeated.extend(crowd.iter().cloned());
    let bow_ties: Vec<Row> = (0..90)
        .map(|_| {
            let [a, b, c, d] = [0; 4].map(|_| [random.number() * 5.0, random.number() * 5.0]);
            ("a", Some(polygon_wkb(&[vec![a, b, c, d]])))
        })
        .collect();
    vec![
        ("lattice", (0..900).map(|i| (keys[i % 3], Some(lattice(&mut random)))).collect()),
        ("turned lattice", (0..900).map(|i| (keys[i % 3], Some(turned(&lattice(&mut random))))).collect()),
        ("crowd", crowd),
        ("parcels", parcels),
        ("nested", nested),
        ("repeated", repeated),
        ("bow ties", bow_ties),
    ]
}

/// Squares and frames on few points, some with a corner cut off at a place that rounds: neighbours share edges, others overlap, fill
/// holes, touch or are equal.
fn lattice(random: &mut Random) -> Vec<u8> {
    let kind = random.below(4);
    let mut below = |most: usize| random.below(most) as f64;
    let (low, size) = ([below(12), below(12)], 1.0 + below(4));
    let inset = |by: f64| {
        let [x, y] = low;
        let (a, b) = (by / 2.0, size - by / 2.0);
        vec![[x + a, y + a], [x + b, y + a], [x + b, y + b], [x + a, y + b]]
    };
    match kind {
        0 if size > 1.0 => polygon_wkb(&[inset(0.0), inset(1.0)]),
        1 => {
            let [a, b, c, d] = inset(0.0)[..] else { unreachable!("four corners") };
            polygon_wkb(&[vec![a, b, [c[0], c[1] - size / 3.0], [c[0] - size / 7.0, c[1]], d]])
        }
        2 if size > 1.0 => polygon_wkb(&[inset(1.0)]),
        _ => polygon_wkb(&[inset(0.0)]),
    }
}

/// A polygon turned by an angle that no double holds, and far from the origin: neighbours share edges still, and crossings are rounded.
fn turned(bytes: &[u8]) -> Vec<u8> {
    let (sine, cosine) = 0.7_f64.sin_cos();
    let place = |[x, y]: [f64; 2]| [1e5 + cosine * x - sine * y, 3e5 + sine * x + cosine * y];
    let rings: Vec<Ring> =
        read(bytes).into_iter().map(|ring| ring.into_iter().map(place).collect()).collect();
    polygon_wkb(&rings)
}

/// Cells of a grid whose inner vertices are moved; neighbours share theirs.
fn parcels(side: usize, random: &mut Random) -> Vec<Ring> {
    let mut at = vec![vec![[0.0; 2]; side + 1]; side + 1];
    for (i, column) in at.iter_mut().enumerate() {
        for (j, p) in column.iter_mut().enumerate() {
            *p = [i as f64 + 0.6 * random.number(), j as f64 + 0.6 * random.number()];
        }
    }
    let cell = |i: usize, j: usize| vec![at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]];
    (0..side).flat_map(|i| (0..side).map(move |j| (i, j))).map(|(i, j)| cell(i, j)).collect()
}

#[tokio::test]
async fn the_bytes_do_not_depend_on_partitions_or_order() -> Result<()> {
    for aggregate in ["st_union_agg", "st_intersection_agg"] {
        for sql in [
            format!("SELECT {aggregate}(geom) FROM t GROUP BY key ORDER BY key"),
            format!("SELECT {aggregate}(geom) FROM t"),
        ] {
            for (name, rows) in layers() {
                let expected = dissolved(&rows, 1, 0, &sql).await?;
                for (partitions, seed) in [(2, 1), (7, 2), (7, 3), (1, 4)] {
                    assert_eq!(dissolved(&rows, partitions, seed, &sql).await?, expected, "{name}: {sql}");
                }
            }
        }
    }
    Ok(())
}

/// One call of polycsg on the rows as they are, as sets of polygons.
#[tokio::test]
async fn a_dissolve_is_one_evaluation() -> Result<()> {
    for (name, rows) in layers() {
        for (function, sql) in [
            (Csg::union as fn(Vec<Csg<'static>>) -> Csg<'static>, "SELECT st_union_agg(geom) FROM t"),
            (Csg::intersection, "SELECT st_intersection_agg(geom) FROM t"),
        ] {
            let rings = |bytes: &Vec<u8>| Csg::from_rings(read(bytes), FillRule::EvenOdd).expect("finite");
            let expected =
                function(rows.iter().filter_map(|row| row.1.as_ref().map(rings)).collect()).evaluate();
            let found = dissolved(&rows, 3, 5, sql).await?.remove(0).expect("a geometry");
            let sorted = |mut rings: Vec<Ring>| {
                rings.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
                rings
            };
            let expected = expected.rings().map(|ring| ring.iter().map(|p| p.to_array()).collect()).collect();
            assert_eq!(sorted(read(&found)), sorted(expected), "{name}: {sql}");
        }
    }
    Ok(())
}

/// The rings of a WKB polygon or multipolygon, by a reader of the tests' own.
fn read(bytes: &[u8]) -> Vec<Ring> {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("4 bytes")) as usize;
    let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("8 bytes"));
    let (mut at, mut rings) = (0, vec![]);
    let parts = if word(1) == 6 { word(5) } else { 1 };
    at += if word(1) == 6 { 9 } else { 0 };
    for _ in 0..parts {
        let count = word(at + 5);
        at += 9;
        for _ in 0..count {
            let points = word(at);
            rings
                .push((0..points - 1).map(|i| [number(at + 4 + 16 * i), number(at + 12 + 16 * i)]).collect());
            at += 4 + 16 * points;
        }
    }
    assert_eq!(at, bytes.len());
    rings
}

#[tokio::test]
async fn nothing_is_null_and_empty_is_empty() -> Result<()> {
    let rows: Vec<Row> = vec![
        ("null", None),
        ("null", None),
        ("empty", Some(wkb(&[]))),
        ("one", None),
        ("one", Some(polygon_wkb(&[square(0.0, 1.0)]))),
    ];
    let one = Some(wkb(&[vec![square(0.0, 1.0)]]));
    for aggregate in ["st_union_agg", "st_intersection_agg"] {
        let grouped = format!("SELECT {aggregate}(geom) FROM t GROUP BY key ORDER BY key");
        assert_eq!(dissolved(&rows, 2, 1, &grouped).await?, [Some(wkb(&[])), None, one.clone()]);
        assert_eq!(
            dissolved(&rows, 2, 1, &format!("SELECT {aggregate}(geom) FROM t WHERE false")).await?,
            [None]
        );
    }
    let whole = |aggregate: &str| format!("SELECT {aggregate}(geom) FROM t");
    assert_eq!(dissolved(&rows, 2, 1, &whole("st_union_agg")).await?, [one]);
    assert_eq!(dissolved(&rows, 2, 1, &whole("st_intersection_agg")).await?, [Some(wkb(&[]))]);
    Ok(())
}

#[tokio::test]
async fn filters_distinct_and_windows_are_those_of_sql() -> Result<()> {
    let tiles = |i: i32| polygon_wkb(&[rectangle([f64::from(i), 0.0], [1.0, 1.0])]);
    let rows: Vec<Row> = (0..6).map(|i| (["a", "b"][i as usize % 2], Some(tiles(i / 2)))).collect();
    let areas = async |sql: &str| -> Result<Vec<Option<f64>>> {
        let context = session(2);
        add_table(&context, "t", std::slice::from_ref(&rows));
        let found = answer(&context, sql).await?;
        let column = found.column(0);
        Ok(arrow_array::cast::AsArray::as_primitive::<arrow_array::types::Float64Type>(column)
            .iter()
            .collect())
    };
    let sql = "SELECT st_area(st_union_agg(geom) FILTER (WHERE key = 'a' AND st_area(geom) > 0)) FROM t";
    assert_eq!(areas(sql).await?, [Some(3.0)]);
    assert_eq!(areas("SELECT st_area(st_union_agg(DISTINCT geom)) FROM t").await?, [Some(3.0)]);
    let running = "SELECT st_area(st_union_agg(geom) OVER (PARTITION BY key ORDER BY geom ROWS UNBOUNDED PRECEDING)) AS a
        FROM t ORDER BY key, a";
    assert_eq!(areas(running).await?, [1.0, 2.0, 3.0, 1.0, 2.0, 3.0].map(Some));
    Ok(())
}
