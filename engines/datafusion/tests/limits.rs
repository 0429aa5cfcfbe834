//! The engine's limit on memory holds, and so does the one on contacts.
mod common;

use common::{Random, add_table, answer, polygon_wkb, session_of};
use datafusion::execution::runtime_env::RuntimeEnvBuilder;
use datafusion::prelude::{SessionConfig, SessionContext};
use datafusion_common::{DataFusionError, Result};
use polycsg_datafusion::{Error, Functions};

/// What the dissolve of 40 000 octagons is known to need at most; with less it spills first.
const ENOUGH: usize = 160 << 20;

fn limited(bytes: usize, partitions: usize) -> SessionContext {
    let runtime = RuntimeEnvBuilder::new().with_memory_limit(bytes, 1.0).build_arc().expect("a runtime");
    let config = SessionConfig::new().with_target_partitions(partitions);
    let mut context = SessionContext::new_with_config_rt(config, runtime);
    Functions::default().register(&mut context).expect("the session takes them");
    context
}

fn octagons(count: usize, side: f64) -> Vec<(&'static str, Option<Vec<u8>>)> {
    const KEYS: [&str; 8] = ["a", "b", "c", "d", "e", "f", "g", "h"];
    let mut random = Random(5);
    (0..count).map(|i| (KEYS[i % 8], Some(polygon_wkb(&[random.octagon(side, 1.0)])))).collect()
}

/// A dissolve that spills gives the bytes of one that does not; one that cannot be done is refused.
#[tokio::test]
async fn the_engines_limit_holds() -> Result<()> {
    let rows = octagons(40_000, 400.0);
    let sql = "SELECT key, st_union_agg(geom) FROM t GROUP BY key ORDER BY key";
    let ask = async |bytes: usize| {
        let context = limited(bytes, 2);
        add_table(&context, "t", &[rows[..20_000].to_vec(), rows[20_000..].to_vec()]);
        answer(&context, sql).await
    };
    assert_eq!(ask(1 << 30).await?, ask(ENOUGH).await?);
    let refused = ask(4 << 20).await.expect_err("4 MiB are too little");
    assert!(matches!(refused.find_root(), DataFusionError::ResourcesExhausted(_)), "{refused}");
    Ok(())
}

/// A group whose edges meet too often is named by its size and its place.
#[tokio::test]
async fn a_group_that_is_too_large_is_named() -> Result<()> {
    let bars = |upright: bool| {
        (0..200).map(move |i| {
            let x = f64::from(i);
            let (at, size) = if upright { ([x, -1.0], [0.5, 202.0]) } else { ([-1.0, x], [202.0, 0.5]) };
            ("bars", Some(polygon_wkb(&[common::rectangle(at, size)])))
        })
    };
    let context = session_of(SessionConfig::new(), Functions::default().contacts(10_000));
    add_table(&context, "t", &[bars(true).chain(bars(false)).collect()]);
    let error = answer(&context, "SELECT st_union_agg(geom) FROM t GROUP BY key")
        .await
        .expect_err("160 000 crossings");
    let Some(Error::Group { features, low, high, why }) = common::own(&error) else { panic!("{error}") };
    assert_eq!((*features, low.to_array(), high.to_array()), (400, [-1.0, -1.0], [201.0, 201.0]));
    assert!(why.contains("10000 times"), "{why}");
    Ok(())
}

/// Under a limit of bytes a group of small parts goes through, however large it is, and a large part is refused by its group.
#[tokio::test]
async fn a_group_is_evaluated_in_parts_or_named() -> Result<()> {
    const BYTES: usize = 1 << 20;
    let limited = |rows: Vec<_>, bytes| {
        let context = session_of(SessionConfig::new(), Functions::default().bytes(bytes));
        add_table(&context, "t", &[rows]);
        context
    };
    let sql = "SELECT st_union_agg(geom) FROM t GROUP BY key ORDER BY key";
    let apart = octagons(20_000, 100_000.0);
    let whole = answer(&limited(apart.clone(), usize::MAX), sql).await?;
    assert_eq!(answer(&limited(apart, BYTES), sql).await?, whole);
    let error = answer(&limited(octagons(20_000, 50.0), BYTES), sql).await.expect_err("it is one part");
    let Some(Error::Group { features: 2500, why, .. }) = common::own(&error) else { panic!("{error}") };
    assert!(why.contains("1048576 are allowed"), "{why}");
    Ok(())
}

/// Whether a geometry is valid is not asked within fewer contacts than its edges may have, and not refused within more.
#[tokio::test]
async fn validity_is_within_the_limit() -> Result<()> {
    let bars = |at: fn(f64) -> ([f64; 2], [f64; 2])| {
        (0..20).map(move |i| at(f64::from(i))).map(|(low, size)| vec![common::rectangle(low, size)])
    };
    let upright = bars(|x| ([x, -1.0], [0.5, 22.0]));
    let level = bars(|y| ([-1.0, y], [22.0, 0.5]));
    let weave = common::wkb(&upright.chain(level).collect::<Vec<_>>()); // 1 600 crossings
    for (contacts, is_told) in [(1000, false), (4000, true), (1 << 25, true)] {
        let context = session_of(SessionConfig::new(), Functions::default().contacts(contacts));
        add_table(&context, "t", &[vec![("weave", Some(weave.clone()))]]);
        let found = answer(&context, "SELECT st_isvalid(geom) FROM t").await;
        let Err(error) = found else {
            assert!(is_told, "{contacts}");
            continue;
        };
        assert!(!is_told && matches!(common::own(&error), Some(Error::Row { row: 0, .. })), "{error}");
    }
    Ok(())
}
