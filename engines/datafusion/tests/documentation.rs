//! The examples on the functions' pages run, and each page says what regularised results mean.
mod common;

use common::{add_table, answer, polygon_wkb, rectangle, session};
use datafusion::prelude::SessionContext;
use datafusion_common::Result;
use polycsg_datafusion::Functions;

async fn tables(context: &SessionContext) -> Result<()> {
    let lot = |i: i32| Some(polygon_wkb(&[rectangle([f64::from(i), 0.0], [1.0, 2.0])]));
    let owners = ["ann", "ben", "ann", "eve"];
    add_table(context, "lots", &[owners.iter().zip(1..).map(|(owner, i)| (*owner, lot(i))).collect()]);
    let zone = Some(polygon_wkb(&[rectangle([1.5, 1.0], [2.0, 5.0])]));
    add_table(context, "areas", &[vec![("flood", zone)]]);
    let parcels = "CREATE VIEW parcels AS SELECT row_number() OVER () AS id, key AS owner, geom FROM lots";
    context.sql(parcels).await?;
    context.sql("CREATE VIEW zones AS SELECT key AS kind, geom FROM areas").await?;
    Ok(())
}

#[tokio::test]
async fn the_examples_run() -> Result<()> {
    let context = session(2);
    tables(&context).await?;
    let scalars = Functions::default().scalars();
    let aggregates = Functions::default().aggregates();
    let pages = scalars.iter().map(|f| (f.name(), f.documentation()));
    for (name, page) in pages.chain(aggregates.iter().map(|f| (f.name(), f.documentation()))) {
        let page = page.expect("a page");
        let example = page.sql_example.as_ref().expect("an example");
        let sql = example.trim().trim_start_matches("```sql").trim_end_matches("```");
        assert!(sql.contains(name), "{name}");
        answer(&context, sql).await.map_err(|error| error.context(name.to_string()))?;
        let text = page.description.to_lowercase();
        assert!(["null", "regularised"].iter().all(|word| text.contains(word)), "{name}");
    }
    Ok(())
}
