//! A scheduler and two executors as processes on this machine. Run by hand, with the layers of the npm packages us-atlas and
//! world-atlas: `ATLASES=node_modules cargo test -- --ignored --nocapture`.
mod common;

use common::{Process, files, free_port, layer};
use datafusion::arrow::array::{ArrayRef, BinaryArray, RecordBatch, StringArray};
use datafusion::arrow::util::pretty::pretty_format_batches;
use datafusion::dataframe::DataFrameWriteOptions;
use datafusion::error::{DataFusionError, Result};
use datafusion::prelude::{ParquetReadOptions, SessionConfig, SessionContext};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

const PARTITIONS: usize = 8;

const DISSOLVE: &str =
    "SELECT substr(id, 1, 2) AS state, copy, count(*) AS counties, st_union_agg(geom) AS geom
    FROM counties GROUP BY substr(id, 1, 2), copy ORDER BY state, copy";

/// The same countries by coarse and by fine borders, which cross one another everywhere.
const OVERLAY: &str = "SELECT c.id AS coarse, f.id AS fine, st_intersection(c.geom, f.geom) AS geom
    FROM coarse c JOIN fine f ON st_intersects(c.geom, f.geom) ORDER BY coarse, fine";

/// Two executors and who schedules them.
struct Cluster {
    executors: Vec<Process>,
    _scheduler: Process,
    folder: PathBuf,
    url: String,
}

impl Cluster {
    fn start(folder: &Path) -> Cluster {
        Cluster::start_with(folder, folder)
    }

    /// The executors' shuffles go to a folder of their own.
    fn start_with(folder: &Path, shuffles: &Path) -> Cluster {
        let port = free_port();
        let log = |name: &str| folder.join(format!("{name}.log"));
        let scheduler = [format!("--port={port}"), "--executor-timeout=10".into()];
        let scheduler =
            Process::start(env!("CARGO_BIN_EXE_polycsg-scheduler"), &scheduler, &log("scheduler"));
        let executor = |name: &str| {
            let mut own = free_port();
            while own == u16::MAX || std::net::TcpListener::bind(("127.0.0.1", own + 1)).is_err() {
                own = free_port();
            }
            let work = shuffles.join(name);
            std::fs::create_dir(&work).expect("a new folder");
            let arguments = [
                format!("--port={own}"),
                format!("--scheduler-port={port}"),
                format!("--work-dir={}", work.display()),
                "--tasks=1".into(),
            ];
            Process::start(env!("CARGO_BIN_EXE_polycsg-executor"), &arguments, &log(name))
        };
        let executors = ["executor-0", "executor-1"].map(executor).into();
        Cluster {
            executors,
            _scheduler: scheduler,
            folder: folder.into(),
            url: format!("df://127.0.0.1:{port}"),
        }
    }

    fn log(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.join(format!("{name}.log"))).expect("a log")
    }

    /// A client with the tables, as soon as both executors are there.
    async fn client(&self, tables: &Path) -> Result<SessionContext> {
        let registered = || self.log("scheduler").matches("Received register executor request").count();
        let start = Instant::now();
        while registered() < 2 {
            assert!(
                start.elapsed() < Duration::from_secs(60),
                "no executors after a minute: {}",
                self.log("executor-0")
            );
            tokio::time::sleep(Duration::from_millis(200)).await;
        }
        let context = polycsg_ballista::connect(&self.url, PARTITIONS).await?;
        read_tables(&context, tables).await?;
        Ok(context)
    }
}

fn config() -> SessionConfig {
    SessionConfig::new().with_target_partitions(PARTITIONS)
}

async fn read_tables(context: &SessionContext, tables: &Path) -> Result<()> {
    for table in ["counties", "coarse", "fine"] {
        let path = tables.join(table).to_string_lossy().into_owned();
        context.register_parquet(table, path, ParquetReadOptions::default()).await?;
    }
    Ok(())
}

/// Writes the layers as files for all to read: counties many times over, each copy of them a table's part.
async fn write_tables(tables: &Path, copies: usize) -> Result<()> {
    let atlases = PathBuf::from(
        std::env::var("ATLASES").expect("ATLASES names a folder with us-atlas and world-atlas"),
    );
    let write = async |name: &str, rows: Vec<(String, usize, Vec<u8>)>| -> Result<()> {
        let context = SessionContext::new_with_config(config());
        let ids: StringArray = rows.iter().map(|row| Some(&row.0)).collect();
        let copies: StringArray = rows.iter().map(|row| Some(row.1.to_string())).collect();
        let geometries = BinaryArray::from_iter_values(rows.iter().map(|row| &row.2));
        let columns: [(&str, ArrayRef); 3] =
            [("id", Arc::new(ids)), ("copy", Arc::new(copies)), ("geom", Arc::new(geometries))];
        let frame = context.read_batch(RecordBatch::try_from_iter(columns)?)?;
        let frame = frame.repartition(datafusion::logical_expr::Partitioning::RoundRobinBatch(1))?;
        let path = tables.join(name);
        frame.write_parquet(&path.to_string_lossy(), DataFrameWriteOptions::new(), None).await?;
        Ok(())
    };
    let counties = layer(&atlases.join("us-atlas/counties-10m.json"), "counties");
    assert!(counties.len() > 3000);
    for copy in 0..copies {
        let rows = counties.iter().map(|county| (county.id.clone(), copy, county.wkb.clone())).collect();
        write(&format!("counties/part-{copy}.parquet"), rows).await?;
    }
    for (name, file) in [("coarse", "countries-110m.json"), ("fine", "countries-50m.json")] {
        let countries = layer(&atlases.join("world-atlas").join(file), "countries");
        let rows = countries.into_iter().enumerate();
        // Some countries have no id.
        let rows = rows.map(|(i, country)| (format!("{} {i}", country.id), 0, country.wkb)).collect();
        write(&format!("{name}/all.parquet"), rows).await?;
    }
    Ok(())
}

async fn answer(context: &SessionContext, sql: &str) -> Result<String> {
    let batches = context.sql(sql).await?.collect().await?;
    Ok(pretty_format_batches(&batches)?.to_string())
}

/// In one process, with nested loops.
async fn here(tables: &Path, sql: &str) -> Result<String> {
    let context = SessionContext::new_with_state(polycsg_ballista::session_state(config())?);
    read_tables(&context, tables).await?;
    answer(&context, sql).await
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs ATLASES, and a minute"]
async fn two_executors_give_the_bytes_of_one_process() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let tables = folder.path().join("tables");
    write_tables(&tables, 2).await?;
    let cluster = Cluster::start(folder.path());
    let client = cluster.client(&tables).await?;
    for sql in [DISSOLVE, OVERLAY] {
        let start = Instant::now();
        let (there, took) = (answer(&client, sql).await?, start.elapsed());
        assert!(there.lines().count() > 100, "{there}");
        assert_eq!(there, here(&tables, sql).await?);
        println!("{} lines in {took:?}, the same bytes as in one process", there.lines().count());
    }
    let joined_by_boxes = |executor: &&str| cluster.log(executor).contains("BoxJoinExec");
    assert!(["executor-0", "executor-1"].iter().any(joined_by_boxes), "a nested loop ran");
    for executor in 0..2 {
        assert!(
            !files(&folder.path().join(format!("executor-{executor}"))).is_empty(),
            "executor {executor} did nothing"
        );
    }
    Ok(())
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs ATLASES, and two minutes"]
async fn an_executor_that_dies_with_its_shuffle_changes_no_byte() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let tables = folder.path().join("tables");
    write_tables(&tables, 24).await?;
    let expected = here(&tables, DISSOLVE).await?;
    let mut cluster = Cluster::start(folder.path());
    let client = cluster.client(&tables).await?;
    let query = tokio::spawn(async move { answer(&client, DISSOLVE).await });
    let shuffle = folder.path().join("executor-0");
    let start = Instant::now();
    while files(&shuffle).len() < 5 {
        assert!(start.elapsed() < Duration::from_secs(120), "no shuffle was written");
        if query.is_finished() {
            panic!("the query was over before its executor died: {:?}", query.await);
        }
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    assert!(!query.is_finished(), "the query was over before its executor died");
    cluster.executors[0].kill();
    let lost = files(&shuffle).len();
    std::fs::remove_dir_all(&shuffle)?;
    let killed = Instant::now();
    let found = query.await.expect("no panic")?;
    assert_eq!(found, expected);
    let log = cluster.log("scheduler");
    let telling = |line: &&str| {
        let line = line.to_lowercase();
        ["lost", "resubmit", "rerun", "reset", "rollback", "removed", "expired", "dead"]
            .iter()
            .any(|word| line.contains(word))
    };
    let told: Vec<&str> = log.lines().filter(telling).collect();
    assert!(!told.is_empty(), "the log does not show it: {log}");
    println!(
        "{lost} files of shuffles lost; the same bytes {:?} later; the scheduler said:",
        killed.elapsed()
    );
    told.iter().for_each(|line| println!("  {line}"));
    Ok(())
}

/// What a disk of 1 MB cannot take is an error at the client, and no rows.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "needs ATLASES, and FULL_DISK: an empty folder on a file system of 1 MB"]
async fn a_full_disk_is_an_error_at_the_client() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let tables = folder.path().join("tables");
    write_tables(&tables, 4).await?;
    let disk = PathBuf::from(std::env::var("FULL_DISK").expect("FULL_DISK names a folder"));
    let cluster = Cluster::start_with(folder.path(), &disk);
    let client = cluster.client(&tables).await?;
    let start = Instant::now();
    let error = answer(&client, DISSOLVE).await.expect_err("the shuffle takes several MB");
    println!("after {:?}: {error}", start.elapsed());
    // Ballista's errors come to the client as texts.
    assert!(matches!(error.find_root(), DataFusionError::Execution(_)), "{error:?}");
    assert!(error.to_string().contains("No space left on device"), "{error}");
    Ok(())
}
