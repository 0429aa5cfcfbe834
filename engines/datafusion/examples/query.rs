//! Runs a query over Arrow files, for `engines/benchmarks.py`: query SQL RESULT ROUNDS NAME=FILE...
//!
//! Prints the least CPU time of the rounds, in seconds; writes the result as an Arrow file.
use arrow_array::RecordBatch;
use arrow_ipc::{reader::FileReader, writer::FileWriter};
use cpu_time::ProcessTime;
use datafusion::datasource::MemTable;
use datafusion::execution::SessionStateBuilder;
use datafusion::prelude::{SessionConfig, SessionContext};
use polycsg_datafusion::{BoxJoin, Functions};
use std::error::Error;
use std::fs::File;
use std::sync::Arc;

fn add_table(context: &SessionContext, argument: &str) -> Result<(), Box<dyn Error>> {
    let (name, file) = argument.split_once('=').ok_or("give NAME=FILE")?;
    let reader = FileReader::try_new(File::open(file)?, None)?;
    let (schema, batches) = (reader.schema(), reader.collect::<Result<Vec<RecordBatch>, _>>()?);
    context.register_table(name, Arc::new(MemTable::try_new(schema, vec![batches])?))?;
    Ok(())
}

#[tokio::main(flavor = "current_thread")]
async fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [sql, result, rounds, tables @ ..] = &arguments[..] else {
        return Err("give SQL RESULT ROUNDS NAME=FILE...".into());
    };
    let state = SessionStateBuilder::new().with_config(SessionConfig::new().with_target_partitions(1));
    let state = state.with_default_features().with_physical_optimizer_rule(Arc::new(BoxJoin));
    let mut context = SessionContext::new_with_state(state.build());
    Functions::default().register(&mut context)?;
    tables.iter().try_for_each(|table| add_table(&context, table))?;
    let (mut least, mut found) = (f64::INFINITY, vec![]);
    for _ in 0..rounds.parse()? {
        let start = ProcessTime::now();
        found = context.sql(sql).await?.collect().await?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    let schema = found.first().map(RecordBatch::schema).ok_or("no batch came back")?;
    let mut writer = FileWriter::try_new(File::create(result)?, &schema)?;
    found.iter().try_for_each(|batch| writer.write(batch))?;
    writer.finish()?;
    eprintln!("{least}");
    Ok(())
}
