//! GeoArrow's columns: read as WKB is, written as multipolygons with the column's system of coordinates.
mod common;

use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, Field, Schema};
use common::{answer, binaries, session, square};
use datafusion::arrow::compute::cast;
use datafusion::datasource::MemTable;
use datafusion::prelude::SessionContext;
use datafusion_common::Result;
use geo_types::{LineString, MultiPolygon, Point, Polygon};
use geoarrow_array::GeoArrowArray;
use geoarrow_array::builder::{MultiPolygonBuilder, PointBuilder, PolygonBuilder, WkbBuilder};
use geoarrow_schema::{
    CoordType, Crs, Dimension, Edges, Metadata, MultiPolygonType, PointType, PolygonType, WkbType,
};
use std::sync::Arc;

fn polygon(low: f64, high: f64) -> Polygon {
    Polygon::new(LineString::from(square(low, high)), vec![])
}

fn metadata(system: &str) -> Arc<Metadata> {
    Arc::new(Metadata::new(Crs::from_authority_code(system.to_string()), None))
}

fn add(context: &SessionContext, table: &str, array: &dyn GeoArrowArray) -> Result<()> {
    add_as(context, table, array, |kind| kind.clone()).map(drop)
}

/// Adds a table of a column in another type of the same meaning; returns it.
fn add_as(
    context: &SessionContext,
    table: &str,
    array: &dyn GeoArrowArray,
    kind: impl Fn(&DataType) -> DataType,
) -> Result<RecordBatch> {
    let field = array.data_type().to_field("geom", true);
    let field = Arc::new(Field::clone(&field).with_data_type(kind(field.data_type())));
    let column = cast(&array.to_array_ref(), field.data_type())?;
    let batch = RecordBatch::try_new(Arc::new(Schema::new(vec![field])), vec![column])?;
    add_batches(context, table, vec![batch.clone()])?;
    Ok(batch)
}

fn add_batches(context: &SessionContext, table: &str, batches: Vec<RecordBatch>) -> Result<()> {
    context.register_table(table, Arc::new(MemTable::try_new(batches[0].schema(), vec![batches])?))?;
    Ok(())
}

/// Offsets of 64 bits.
fn large(kind: &DataType) -> DataType {
    match kind {
        DataType::List(of) => {
            DataType::LargeList(Arc::new(Field::clone(of).with_data_type(large(of.data_type()))))
        }
        DataType::Binary => DataType::LargeBinary,
        other => other.clone(),
    }
}

/// A column of four rows as it is, with large offsets, and in chunks that are cut out of a longer one.
fn add_forms(context: &SessionContext, table: &str, array: &dyn GeoArrowArray) -> Result<()> {
    add(context, table, array)?;
    let whole = add_as(context, &format!("large_{table}"), array, large)?;
    let twice = arrow_select::concat::concat_batches(&whole.schema(), [&whole, &whole])?;
    let cuts = [(4, 1), (5, 2), (2, 0), (3, 1)];
    add_batches(context, &format!("cut_{table}"), cuts.map(|(at, rows)| twice.slice(at, rows)).into())
}

/// Three polygons and a NULL, in each of GeoArrow's forms and as WKB.
fn session_of_all(system: &str) -> Result<SessionContext> {
    let context = session(2);
    let rows = [Some(polygon(0.0, 2.0)), None, Some(polygon(1.0, 3.0)), Some(polygon(5.0, 6.0))];
    for (name, coordinates) in [("separated", CoordType::Separated), ("interleaved", CoordType::Interleaved)]
    {
        let kind = PolygonType::new(Dimension::XY, metadata(system)).with_coord_type(coordinates);
        let mut polygons = PolygonBuilder::new(kind);
        rows.iter().try_for_each(|row| polygons.push_polygon(row.as_ref())).expect("small");
        add_forms(&context, &format!("polygons_{name}"), &polygons.finish())?;
        let kind = MultiPolygonType::new(Dimension::XY, metadata(system)).with_coord_type(coordinates);
        let mut parts = MultiPolygonBuilder::new(kind);
        let multi = |row: &Option<Polygon>| row.clone().map(|polygon| MultiPolygon::new(vec![polygon]));
        rows.iter().try_for_each(|row| parts.push_multi_polygon(multi(row).as_ref())).expect("small");
        add_forms(&context, &format!("multipolygons_{name}"), &parts.finish())?;
    }
    let mut wkb = WkbBuilder::<i32>::new(WkbType::new(metadata(system)));
    rows.iter().try_for_each(|row| wkb.push_geometry(row.as_ref())).expect("small");
    let wkb = wkb.finish();
    add_forms(&context, "wkb", &wkb)?;
    add_as(&context, "views_wkb", &wkb, |_| DataType::BinaryView)?;
    Ok(context)
}

fn tables() -> Vec<String> {
    let lists =
        ["separated", "interleaved"].map(|it| [format!("polygons_{it}"), format!("multipolygons_{it}")]);
    let tables = lists.into_iter().flatten().chain(["wkb".into()]);
    let forms = tables.flat_map(|table| ["", "large_", "cut_"].map(|form| format!("{form}{table}")));
    forms.chain(["views_wkb".into()]).collect()
}

#[tokio::test]
async fn all_forms_give_one_answer() -> Result<()> {
    let context = session_of_all("EPSG:25833")?;
    for sql in [
        "SELECT st_area(geom), st_isvalid(geom), st_contains(geom, geom) FROM t",
        "SELECT st_area(st_union_agg(geom)), st_area(st_intersection_agg(geom)) FROM t",
        "SELECT st_area(st_intersection(a.geom, b.geom)) AS x FROM t a, t b ORDER BY x",
    ] {
        let mut answers = vec![];
        for table in tables() {
            answers
                .push(answer(&context, &sql.replace(" t", &format!(" {table}"))).await?.columns().to_vec());
        }
        assert!(answers.windows(2).all(|pair| pair[0] == pair[1]), "{sql}");
    }
    Ok(())
}

#[tokio::test]
async fn the_kind_and_the_system_stay() -> Result<()> {
    let context = session_of_all("EPSG:25833")?;
    for table in tables() {
        for call in ["st_makevalid(geom)", "st_union(geom, geom)", "st_union_agg(geom)"] {
            let found = answer(&context, &format!("SELECT {call} AS g FROM {table}")).await?;
            let (schema, expected) = (
                found.schema(),
                if table.ends_with("wkb") { "geoarrow.wkb" } else { "geoarrow.multipolygon" },
            );
            let metadata = schema.field(0).metadata();
            assert_eq!(
                metadata.get("ARROW:extension:name").map(String::as_str),
                Some(expected),
                "{table} {call}"
            );
            assert!(metadata["ARROW:extension:metadata"].contains("EPSG:25833"), "{table} {call}");
            let again = answer(
                &context,
                &format!("SELECT st_makevalid(g) AS g FROM (SELECT {call} AS g FROM {table})"),
            )
            .await?;
            assert_eq!(again.column(0), found.column(0), "{table} {call}");
        }
    }
    Ok(())
}

#[tokio::test]
async fn systems_that_differ_and_curved_edges_are_refused() -> Result<()> {
    let (context, other) = (session_of_all("EPSG:25833")?, session_of_all("EPSG:4326")?);
    context.register_table("other", other.table_provider("wkb").await?)?;
    let error =
        context.sql("SELECT st_union(a.geom, b.geom) FROM wkb a, other b").await.expect_err("two systems");
    assert!(error.to_string().contains("coordinate systems differ"), "{error}");
    let curved = Arc::new(Metadata::new(Crs::default(), Some(Edges::Spherical)));
    let mut wkb = WkbBuilder::<i32>::new(WkbType::new(curved.clone()));
    wkb.push_geometry(Some(&polygon(0.0, 1.0))).expect("small");
    add(&context, "curved_wkb", &wkb.finish())?;
    let mut polygons = PolygonBuilder::new(PolygonType::new(Dimension::XY, curved));
    polygons.push_polygon(Some(&polygon(0.0, 1.0))).expect("small");
    add(&context, "curved_polygons", &polygons.finish())?;
    for table in ["curved_wkb", "curved_polygons"] {
        for call in ["st_area(geom)", "st_union_agg(geom)"] {
            let error = context.sql(&format!("SELECT {call} FROM {table}")).await.expect_err("curved edges");
            assert!(error.to_string().contains("curved"), "{error}");
        }
    }
    Ok(())
}

/// Rows of lists that are equal share what was read, and a mask that a join repeats is prepared once.
#[tokio::test]
async fn a_mask_of_lists_that_a_join_repeats_gives_what_wkb_does() -> Result<()> {
    let (context, mut random) = (session(1), common::Random(5));
    let octagons: Vec<Polygon> =
        (0..120).map(|_| Polygon::new(LineString::from(random.octagon(4.0, 1.0)), vec![])).collect();
    let mask = [octagons[0].clone(), octagons[0].clone(), polygon(1.0, 3.0)];
    for (name, rows) in [("octagons", &octagons[..]), ("masks", &mask)] {
        let kind = PolygonType::new(Dimension::XY, metadata("EPSG:25833"));
        let (mut lists, mut wkb) =
            (PolygonBuilder::new(kind), WkbBuilder::<i32>::new(WkbType::new(metadata("EPSG:25833"))));
        rows.iter().try_for_each(|row| lists.push_polygon(Some(row))).expect("small");
        rows.iter().try_for_each(|row| wkb.push_geometry(Some(row))).expect("small");
        add(&context, &format!("{name}_lists"), &lists.finish())?;
        add(&context, &format!("{name}_wkb"), &wkb.finish())?;
    }
    let areas = async |kind: &str| {
        let sql = format!(
            "SELECT st_area(st_intersection(m.geom, o.geom)) AS a, st_intersects(o.geom, m.geom) AS b, st_isvalid(m.geom)
            FROM masks_{kind} m, octagons_{kind} o ORDER BY a, b"
        );
        answer(&context, &sql).await.map(|found| found.columns().to_vec())
    };
    assert_eq!(areas("lists").await?, areas("wkb").await?);
    Ok(())
}

#[tokio::test]
async fn points_are_read() -> Result<()> {
    let context = session_of_all("EPSG:25833")?;
    let mut points = PointBuilder::new(PointType::new(Dimension::XY, metadata("EPSG:25833")));
    [Some(Point::new(2.0, 2.0)), None, Some(Point::new(5.5, 5.5))]
        .iter()
        .for_each(|p| points.push_point(p.as_ref()));
    add(&context, "points", &points.finish())?;
    let sql = "SELECT count(*) FROM polygons_interleaved a JOIN points p ON st_contains(a.geom, p.geom)";
    let found = answer(&context, sql).await?;
    assert_eq!(found.column(0).as_ref(), &arrow_array::Int64Array::from(vec![3]) as &dyn Array);
    assert!(binaries(&answer(&context, "SELECT st_makevalid(geom) FROM wkb LIMIT 1").await?, 0)[0].is_some());
    Ok(())
}
