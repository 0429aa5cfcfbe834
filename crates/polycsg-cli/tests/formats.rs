//! Every format keeps every bit of every coordinate, and every attribute.
mod program;

use arrow_array::builder::{Float64Builder, ListBuilder, StructBuilder};
use arrow_array::types::Int8Type;
use arrow_array::{
    Array, ArrayRef, BinaryArray, Date32Array, Decimal128Array, DictionaryArray, Float32Array, ListArray,
    RecordBatch, StringArray, TimestampMicrosecondArray,
};
use arrow_schema::{DataType, Field};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::KeyValue;
use polycsg::{Scratch, flaw};
use program::{
    Folder, Random, Ring, areas, code, document, lines, numbered, parcels, piped, polycsg, printed, sorted,
    stderr, stdout,
};
use serde_json::{Value, json};
use std::fs::File;
use std::sync::Arc;

/// Triangles of any doubles that are valid.
fn triangles(count: usize) -> Vec<(Value, Vec<Ring>)> {
    let mut random = Random::new(20);
    let mut number = || {
        let number = f64::from_bits(random.bits());
        if number.is_finite() && number.abs() < 1e150 { number } else { -0.0 }
    };
    let mut corner = || [number(), number()];
    let rings = (0..count).map(|_| (0..3).map(|_| corner()).collect::<Ring>());
    let valid = rings.filter(|ring| flaw([[ring]], &mut Scratch::default()).is_none());
    valid.enumerate().map(|(i, ring)| (json!({ "i": i }), vec![ring])).collect()
}

/// Through every format and back: the same lines.
fn assert_kept(file: &str, folder: &Folder, formats: &[&str]) {
    let before = lines(&printed(&["repair", file]));
    for format in formats {
        let there = folder.path(&format!("there.{format}"));
        printed(&["repair", file, "-o", &there]);
        assert!(
            sorted(lines(&printed(&["repair", &there, "--to", "geojson"]))) == sorted(before.clone()),
            "{format}"
        );
        // And once more by the same format.
        let again = folder.path(&format!("again.{format}"));
        printed(&["repair", &there, "-o", &again]);
        assert!(
            sorted(lines(&printed(&["repair", &again, "--to", "geojson"]))) == sorted(before.clone()),
            "{format}"
        );
    }
}

#[test]
fn every_coordinate_keeps_its_bits() {
    let folder = Folder::new();
    let file = folder.put("any.geojson", document(&triangles(300)));
    let text = std::fs::read_to_string(&file).expect("a file");
    let geometries = |text: &str| {
        let features = serde_json::from_str::<Value>(text).expect("JSON")["features"].take();
        features.as_array().expect("features").iter().map(|f| f["geometry"].to_string()).collect::<Vec<_>>()
    };
    assert!(geometries(&text).len() > 200);
    assert!(geometries(&printed(&["repair", &file])) == geometries(&text), "a bit is lost");
    assert_kept(&file, &folder, &["fgb", "parquet"]);
    let bare: Vec<_> = triangles(300).into_iter().map(|(_, rings)| (json!({}), rings)).collect();
    assert_kept(&folder.put("bare.geojson", document(&bare)), &folder, &["wkt", "wkb"]);
}

#[test]
fn every_attribute_is_kept() {
    let folder = Folder::new();
    let rows = [
        json!({ "text": "é\"\\\n,", "yes": true, "int": i64::MIN, "large": u64::MAX, "number": 0.1, "list": [1, "a", null] }),
        json!({ "text": "", "yes": false, "int": i64::MAX, "large": 0, "number": 1e-310, "list": { "a": [] } }),
        json!({ "text": null, "yes": null, "int": null, "large": null, "number": -0.0, "list": "text" }),
    ];
    let square: Ring = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let features: Vec<_> = rows.iter().map(|row| (row.clone(), vec![square.clone()])).collect();
    let file = folder.put("a.geojson", document(&features));
    let document: Value = serde_json::from_str(&printed(&["repair", &file])).expect("JSON");
    let found: Vec<Value> =
        document["features"].as_array().expect("features").iter().map(|f| f["properties"].clone()).collect();
    assert_eq!(found, rows);
    assert_kept(&file, &folder, &["fgb", "parquet"]);
}

#[test]
fn ids_polygons_and_nothing_are_kept() {
    let folder = Folder::new();
    let file = folder.put(
        "a.geojson",
        r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","id":7,"properties":{"id":"own"},"geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[0,1],[0,0]]]]}},
        {"type":"Feature","id":"x","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[0,1],[0,0]]]}},
        {"type":"Feature","properties":null,"geometry":null}]}"#,
    );
    let text = printed(&["repair", &file]);
    let found = lines(&text);
    assert!(
        found[0].contains(r#""id":7,"properties":{"id":"own"},"geometry":{"type":"MultiPolygon""#),
        "{text}"
    );
    assert!(found[1].contains(r#""id":"x","properties":{"id":null},"geometry":{"type":"Polygon""#), "{text}");
    assert!(found[2].contains(r#""geometry":null"#), "{text}");
    assert_kept(&file, &folder, &["parquet"]);
    let fgb = folder.path("a.fgb");
    printed(&["repair", &file, "-o", &fgb]);
    let columns = printed(&["repair", &fgb, "--to", "geojson"]);
    assert!(columns.contains(r#""properties":{"id":"own","id_":"#), "{columns}");
}

#[test]
fn documents_in_any_order_and_without_a_collection_are_read() {
    let folder = Folder::new();
    let geometry = r#"{"coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]],"type":"Polygon"}"#;
    for text in [
        geometry.to_owned(),
        format!(r#"{{"geometry":{geometry},"properties":null,"type":"Feature"}}"#),
        format!(
            r#"{{"bbox":[0,0,2,2],"features":[{{"geometry":{geometry},"type":"Feature"}}],"type":"FeatureCollection"}}"#
        ),
        format!("\u{feff}{geometry}\r\n"),
    ] {
        assert_eq!(areas(&folder.put("a.json", text)), [4.0]);
    }
    assert_eq!(stdout(piped(&["area", "-", "--from", "geojson"], geometry.as_bytes())), "0\t4\n");
}

#[test]
fn lines_of_other_programs_are_read() {
    let folder = Folder::new();
    let wkt = "polygon ((0 0, 2 0, 2 2, 0 2, 0 0))\r\n\nMULTIPOLYGON Z (((0 0 1,1 0 1,0 1 1,0 0 1)), EMPTY)\nPOLYGON EMPTY";
    assert_eq!(areas(&folder.put("a.wkt", wkt)), [4.0, 0.0, 0.5, 0.0]);
    // As PostGIS writes it, with a coordinate system; the same the most significant byte first.
    let ewkb = "0103000020E6100000010000000400000000000000000000000000000000000000000000000000004000000000\
        000000000000000000000000000000000000004000000000000000000000000000000000";
    let big = "000000000300000001000000040000000000000000000000000000000040000000000000000000000000000000\
        0000000000000000400000000000000000000000000000000000000000000000";
    let text = [ewkb, big].join("\n");
    assert_eq!(areas(&folder.put("a.wkb", text)), [2.0, 2.0]);
}

fn column(name: &str, values: impl Array + 'static) -> (String, ArrayRef) {
    (name.to_owned(), Arc::new(values))
}

/// A file of GeoParquet as other programs write it.
fn write(path: &str, columns: Vec<(String, ArrayRef)>, geo: &Value) {
    let batch = RecordBatch::try_from_iter_with_nullable(columns.into_iter().map(|(n, c)| (n, c, true)))
        .expect("a table");
    let mut writer =
        ArrowWriter::try_new(File::create(path).expect("a file"), batch.schema(), None).expect("a writer");
    writer.write(&batch).expect("written");
    writer.append_key_value_metadata(KeyValue::new("geo".into(), geo.to_string()));
    writer.close().expect("written");
}

fn read(path: &str) -> (RecordBatch, Value) {
    let builder =
        ParquetRecordBatchReaderBuilder::try_new(File::open(path).expect("a file")).expect("Parquet");
    let pairs = builder.metadata().file_metadata().key_value_metadata().expect("metadata").clone();
    let geo =
        pairs.iter().find(|pair| pair.key == "geo").and_then(|pair| pair.value.clone()).expect("the key geo");
    let batches: Result<Vec<_>, _> = builder.build().expect("rows").collect();
    (batches.expect("rows").remove(0), serde_json::from_str(&geo).expect("JSON"))
}

fn wkb(size: f64) -> Vec<u8> {
    let corners = [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size], [0.0, 0.0]];
    let numbers = corners.into_iter().flatten().flat_map(f64::to_le_bytes);
    [&[1][..], &3_u32.to_le_bytes(), &1_u32.to_le_bytes(), &5_u32.to_le_bytes()]
        .concat()
        .into_iter()
        .chain(numbers)
        .collect()
}

#[test]
fn columns_of_parquet_keep_their_types_and_boxes_that_would_be_wrong_go() {
    let folder = Folder::new();
    let path = folder.path("a.parquet");
    let bytes = [wkb(1.0), wkb(2.0)];
    let boxes = Float32Array::from(vec![1.0, 2.0]);
    let columns = vec![
        column("day", Date32Array::from(vec![Some(1), None])),
        column("time", TimestampMicrosecondArray::from(vec![1, 2]).with_timezone("UTC")),
        column(
            "price",
            Decimal128Array::from(vec![1234, -5]).with_precision_and_scale(10, 2).expect("a decimal"),
        ),
        column("kind", ["x", "y"].into_iter().collect::<DictionaryArray<Int8Type>>()),
        column("tags", ListArray::from_iter_primitive::<Int8Type, _, _>([Some(vec![Some(1), None]), None])),
        column("shape", BinaryArray::from_iter_values(&bytes)),
        column("bbox", boxes),
        column("name", StringArray::from(vec!["a", "b"])),
    ];
    let crs = json!({ "id": { "authority": "EPSG", "code": 31983 }, "name": "SIRGAS 2000 / UTM zone 23S", "more": [1] });
    let geometry = json!({ "encoding": "WKB", "geometry_types": [], "crs": crs,
        "covering": { "bbox": { "xmin": ["bbox", "xmin"] } } });
    write(
        &path,
        columns,
        &json!({ "version": "1.1.0", "primary_column": "shape", "columns": { "shape": geometry } }),
    );
    let out = folder.path("b.parquet");
    printed(&["repair", &path, "-o", &out]);
    let ((before, _), (after, geo)) = (read(&path), read(&out));
    for name in ["day", "time", "price", "tags", "name"] {
        assert_eq!(after.column_by_name(name), before.column_by_name(name), "{name}");
    }
    // Parquet has no dictionaries as a type.
    let kinds = column("kind", StringArray::from(vec!["x", "y"])).1;
    assert_eq!(after.column_by_name("kind"), Some(&kinds));
    assert_eq!(after.column_by_name("geometry"), before.column_by_name("shape"));
    assert!(after.column_by_name("bbox").is_none());
    let column = &geo["columns"]["geometry"];
    assert_eq!((&column["crs"], &column["bbox"]), (&crs, &json!([0.0, 0.0, 2.0, 2.0])));
    assert_eq!(column["geometry_types"], json!(["Polygon"]));
    let text = printed(&["repair", &path, "--to", "geojson"]);
    assert!(
        text.contains(r#""day":"1970-01-02","#) && text.contains("urn:ogc:def:crs:EPSG::31983"),
        "{text}"
    );
    let fgb = folder.path("b.fgb");
    printed(&["repair", &path, "-o", &fgb]);
    let text = printed(&["repair", &fgb, "--to", "geojson"]);
    assert!(text.contains(r#""kind":"y","#) && text.contains("urn:ogc:def:crs:EPSG::31983"), "{text}");
}

#[test]
fn lists_of_vertices_as_geoarrow_has_them_are_read() {
    let folder = Folder::new();
    let fields = vec![Field::new("x", DataType::Float64, false), Field::new("y", DataType::Float64, false)];
    let vertices = StructBuilder::from_fields(fields, 0);
    let mut polygons = ListBuilder::new(ListBuilder::new(ListBuilder::new(vertices)));
    for size in [1.0, 3.0] {
        for [x, y] in [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size], [0.0, 0.0]] {
            let vertex = polygons.values().values().values();
            for (i, value) in [x, y].into_iter().enumerate() {
                vertex.field_builder::<Float64Builder>(i).expect("a column").append_value(value);
            }
            vertex.append(true);
        }
        polygons.values().values().append(true);
        polygons.values().append(true);
        polygons.append(true);
    }
    polygons.append(false);
    let path = folder.path("a.parquet");
    let geometry = json!({ "encoding": "multipolygon", "geometry_types": ["MultiPolygon"] });
    let geo = json!({ "version": "1.1.0", "primary_column": "g", "columns": { "g": geometry } });
    write(&path, vec![column("g", polygons.finish())], &geo);
    assert_eq!(areas(&path), [1.0, 9.0, 0.0]);
}

#[test]
fn systems_of_coordinates_must_agree_where_both_are_known() {
    let folder = Folder::new();
    let square = r#"{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}"#;
    let with = |name: &str| {
        let crs = json!({ "type": "name", "properties": { "name": name } });
        format!(
            r#"{{"type":"FeatureCollection","crs":{crs},"features":[{{"type":"Feature","properties":null,"geometry":{square}}}]}}"#
        )
    };
    let utm = folder.put("utm.geojson", with("urn:ogc:def:crs:EPSG::31983"));
    let utm_too = folder.put("too.geojson", with("EPSG:31983"));
    let plain = folder.put("plain.geojson", square);
    let wkt = folder.put("plain.wkt", "POLYGON((0 0,1 0,1 1,0 1,0 0))");
    for (a, b, expected) in [(&utm, &utm_too, 0), (&utm, &wkt, 0), (&utm, &plain, 3), (&plain, &utm, 3)] {
        let overlay = polycsg(&["overlay", a, b, "--op", "union"]);
        let clip = polycsg(&["clip", a, "--by", b]);
        assert_eq!((code(&overlay), code(&clip)), (expected, expected), "{a} {b}: {}", stderr(&overlay));
        assert!(expected == 0 || stderr(&overlay).contains("transform one of them first"));
    }
    let there = folder.path("utm.fgb");
    printed(&["repair", &utm, "-o", &there]);
    assert_eq!(code(&polycsg(&["clip", &there, "--by", &utm])), 0);
}

/// Written by GDAL and GeoPandas: see `tests/data/README.md`.
#[test]
fn files_of_other_programs_are_read() {
    for name in
        ["gdal.fgb", "gdal-noindex.fgb", "geopandas.parquet", "geopandas-geoarrow.parquet", "gdal.geojson"]
    {
        let file = program::data(name);
        let text = printed(&["repair", file.to_str().expect("UTF-8"), "--to", "geojson"]);
        let found = sorted(lines(&text).iter().map(|line| line.replace(".0", "")).collect());
        assert!(found[0].contains(r#""name":"one","count":1,"share":0.25"#), "{name}: {text}");
        assert!(found[1].contains(r#""name":"two","count":2,"share":null"#), "{name}: {text}");
        assert!(
            found[0].contains("[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]]"),
            "{name}: {text}"
        );
        assert!(
            found[1].contains(r#"{"type":"MultiPolygon","coordinates":[[[[10,10],[11,10],[11,11],[10,10]]]"#),
            "{name}: {text}"
        );
    }
}

/// What `--from` says is for the file whose name does not tell its format.
#[test]
fn a_second_file_keeps_the_format_of_its_name() {
    let folder = Folder::new();
    let [a, b] = [0.0, 0.5].map(|at| document(&numbered("n", parcels(2, at, 1.0, 1))));
    let other = folder.path("b.parquet");
    printed(&["repair", &folder.put("b.geojson", b), "-o", &other]);
    let file = folder.put("a.geojson", &a);
    let pipe = ["overlay", "-", &other, "--from", "geojson", "--op", "union"];
    assert_eq!(stdout(piped(&pipe, a.as_bytes())), printed(&["overlay", &file, &other, "--op", "union"]));
    let pipe = ["overlay", &other, "-", "--from", "geojson", "--op", "union"];
    assert_eq!(code(&piped(&pipe, a.as_bytes())), 3, "the first file is what --from says");
}
