//! What overlays, clips and dissolves must be, whatever the layers.
mod program;

use polycsg::{FillRule, Region};
use program::{
    Folder, Random, Ring, areas, code, document, lines, numbered, octagons, parcels, polycsg, printed, sorted,
};
use serde_json::Value;

/// Two layers of parcels and one of octagons over one another.
fn layers(folder: &Folder) -> [String; 3] {
    let [a, b] = [numbered("a", parcels(12, 0.0, 1.0, 1)), numbered("b", parcels(9, 0.7, 1.3, 2))];
    let octagons = numbered("o", octagons(60, 12.0, 1.1, 3));
    [
        folder.put("a.geojson", document(&a)),
        folder.put("b.geojson", document(&b)),
        folder.put("o.geojson", document(&octagons)),
    ]
}

fn overlay(a: &str, b: &str, op: &str) -> String {
    printed(&["overlay", a, b, "--op", op])
}

fn sum(values: &[f64]) -> f64 {
    values.iter().sum()
}

#[test]
fn parts_add_up_and_are_valid() {
    let folder = Folder::new();
    let [a, b, o] = layers(&folder);
    for (first, second) in [(&a, &b), (&b, &a), (&o, &a)] {
        let common = folder.put("common.geojson", overlay(first, second, "intersection"));
        let rest = folder.put("rest.geojson", overlay(first, second, "difference"));
        let [whole, parts] = [sum(&areas(first)), sum(&areas(&common)) + sum(&areas(&rest))];
        assert!((whole - parts).abs() < 1e-12 * whole, "{whole} is not {parts}");
        for file in [&common, &rest] {
            assert_eq!(code(&polycsg(&["validate", file])), 0);
        }
        assert!(areas(&common).len() > 50 && !areas(&rest).is_empty());
    }
}

#[test]
fn the_union_is_the_intersection_and_both_differences() {
    let folder = Folder::new();
    let [a, _, o] = layers(&folder);
    let [union, common, apart] =
        ["union", "intersection", "symmetric-difference"].map(|op| lines(&overlay(&o, &a, op)));
    assert_eq!(union, [&common[..], &apart[..]].concat());
    let [one, other] = [lines(&overlay(&o, &a, "difference")), lines(&overlay(&a, &o, "difference"))];
    let geometry = |line: &String| line[line.find("\"geometry\"").expect("a geometry")..].to_owned();
    assert_eq!(
        apart.iter().map(geometry).collect::<Vec<_>>(),
        one.iter().chain(&other).map(geometry).collect::<Vec<_>>()
    );
}

/// Every pair by itself, without an index, by the library.
#[test]
fn the_intersection_is_that_of_all_pairs() {
    let [a, b] = [octagons(40, 6.0, 0.9, 5), parcels(6, 0.2, 0.9, 6)];
    let folder = Folder::new();
    let [file_a, file_b] = [("a", &a), ("b", &b)]
        .map(|(name, rings)| folder.put(name, document(&numbered(name, rings.clone()))));
    let region = |ring: &Ring| Region::from_rings([ring], FillRule::NonZero).expect("finite");
    let mut expected = Vec::new();
    for (i, one) in a.iter().enumerate() {
        for (j, other) in b.iter().enumerate() {
            let common = region(one).intersection(&region(other));
            expected.extend((!common.is_empty()).then(|| (i, j, common.area())));
        }
    }
    let text = printed(&["overlay", &file_a, &file_b, "--op", "intersection", "--from", "geojson"]);
    let document: Value = serde_json::from_str(&text).expect("JSON");
    let features = document["features"].as_array().expect("features");
    let result = folder.put("c.geojson", &text);
    let number = |feature: &Value, name: &str| {
        usize::try_from(feature["properties"][name].as_u64().expect("a number")).expect("small")
    };
    let found: Vec<_> =
        features.iter().zip(areas(&result)).map(|(f, area)| (number(f, "a"), number(f, "b"), area)).collect();
    assert_eq!(found, expected);
}

#[test]
fn a_clip_is_the_intersection_with_the_mask() {
    let folder = Folder::new();
    let [a, ..] = layers(&folder);
    let star: Ring = vec![[6.0, 11.9], [2.0, 0.3], [11.8, 7.5], [0.2, 7.5], [10.0, 0.3]];
    let mask = folder.put("mask.geojson", document(&[(Value::Null, vec![star])]));
    assert_eq!(printed(&["clip", &a, "--by", &mask]), overlay(&a, &mask, "intersection"));
}

#[test]
fn a_mask_of_many_features_is_their_union() {
    let folder = Folder::new();
    let [a, _, o] = layers(&folder);
    let whole = folder.put("whole.geojson", printed(&["dissolve", &o]));
    assert_eq!(printed(&["clip", &a, "--by", &o]), printed(&["clip", &a, "--by", &whole]));
}

#[test]
fn a_dissolve_does_not_depend_on_the_order_of_features() {
    let (folder, mut random) = (Folder::new(), Random::new(7));
    let mut features = numbered("o", octagons(80, 8.0, 0.9, 8));
    features.extend(numbered("p", parcels(8, 0.0, 1.0, 9)));
    let first = folder.put("0.geojson", document(&features));
    let dissolved = |file: &str| {
        ["geojson", "wkb"]
            .map(|to| {
                [vec!["dissolve", file, "--by", "kind", "--to", to], vec!["dissolve", file, "--to", to]]
            })
            .map(|both| both.map(|arguments| printed(&arguments)))
    };
    let expected = dissolved(&first);
    assert_eq!(lines(&expected[0][0]).len(), 5);
    let twice = printed(&["dissolve", &first, "--by", "kind", "--by", "kind", "--to", "geojson"]);
    assert_eq!(twice, expected[0][0], "a column that is named twice stands once");
    for _ in 0..4 {
        random.shuffle(&mut features);
        assert_eq!(dissolved(&folder.put("n.geojson", document(&features))), expected);
    }
}

/// A grid's cells are its square again, with every vertex of its border.
#[test]
fn a_dissolved_grid_is_its_outline() {
    let folder = Folder::new();
    let cell = |x: f64, y: f64| vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
    let cells = (0..25).map(|k| cell(f64::from(k % 5), f64::from(k / 5))).collect();
    let file = folder.put("grid.geojson", document(&numbered("n", cells)));
    let whole = folder.put("whole.geojson", printed(&["dissolve", &file]));
    assert_eq!(areas(&whole), [25.0]);
    let vertices = printed(&["repair", &whole, "--to", "wkt"]).matches(',').count();
    assert_eq!(vertices, 20);
}

#[test]
fn repair_is_idempotent_and_keeps_what_is_valid() {
    let (folder, mut random) = (Folder::new(), Random::new(10));
    let mut ring = |count: usize| (0..count).map(|_| [random.share(), random.share()]).collect::<Ring>();
    let wild: Vec<Ring> = (0..60).map(|k| ring(3 + k % 9)).collect();
    let file = folder.put("wild.geojson", document(&numbered("w", wild)));
    assert_eq!(code(&polycsg(&["validate", &file])), 4);
    let once = folder.put("once.geojson", printed(&["repair", &file]));
    assert_eq!(code(&polycsg(&["validate", &once])), 0);
    assert_eq!(printed(&["repair", &once]), std::fs::read_to_string(&once).expect("a file"));
    let parcels = folder.put("parcels.geojson", document(&numbered("p", parcels(5, 0.0, 1.0, 11))));
    let sound = printed(&["repair", &parcels]);
    let text = std::fs::read_to_string(&parcels).expect("a file");
    let values = |text: &str| serde_json::from_str::<Value>(text).expect("JSON")["features"].take();
    assert_eq!(values(&sound), values(&text));
    for (before, after) in areas(&file).iter().zip(areas(&once)) {
        assert!((before - after).abs() < 1e-12, "{before} is not {after}");
    }
}

#[test]
fn threads_change_no_bit() {
    let folder = Folder::new();
    let [a, b, o] = layers(&folder);
    for job in [
        vec!["overlay", &a, &o, "--op", "union"],
        vec!["overlay", &o, &b, "--op", "difference"],
        vec!["dissolve", &o, "--by", "kind"],
        vec!["clip", &a, "--by", &o],
        vec!["repair", &o],
        vec!["area", &o],
        vec!["validate", &o],
    ] {
        let on = |threads: &str| printed(&[&job[..], &["-j", threads]].concat());
        let one = on("1");
        assert!(["2", "7"].iter().all(|threads| on(threads) == one), "{job:?}");
    }
}

#[test]
fn both_sides_columns_are_there_and_equal_names_are_told_apart() {
    let folder = Folder::new();
    let square = |low: f64, high: f64| vec![vec![[low, low], [high, low], [high, high], [low, high]]];
    let of = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    let a =
        folder.put("a.geojson", document(&[(of(r#"{"id":1,"name":"x","name_1":"y"}"#), square(0.0, 2.0))]));
    let b = folder.put("b.geojson", document(&[(of(r#"{"name":"z","more":[1]}"#), square(1.0, 3.0))]));
    let text = overlay(&a, &b, "union");
    let expected = [
        r#"{"id":1,"name_1_1":"x","name_1":"y","more":[1],"name_2":"z"}"#,
        r#"{"id":1,"name_1_1":"x","name_1":"y","more":null,"name_2":null}"#,
        r#"{"id":null,"name_1_1":null,"name_1":null,"more":[1],"name_2":"z"}"#,
    ];
    let found = lines(&text);
    for (line, properties) in found.iter().zip(expected) {
        assert!(line.contains(&format!("\"properties\":{properties}")), "{line}");
    }
    assert_eq!(found.len(), 3);
    assert_eq!(sorted(found.clone()).len(), 3);
}

/// Features without an area are in no overlay; a dissolve keeps their keys.
#[test]
fn nothing_is_made_of_nothing() {
    let folder = Folder::new();
    let empty = r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{"k":1},"geometry":null},
        {"type":"Feature","properties":{"k":2},"geometry":{"type":"MultiPolygon","coordinates":[]}}]}"#;
    let (empty, none) = (folder.put("e.geojson", empty), folder.put("n.geojson", document(&[])));
    let [a, ..] = layers(&folder);
    for op in ["intersection", "union", "difference", "symmetric-difference"] {
        assert_eq!(lines(&overlay(&empty, &none, op)).len(), 0);
        let expected = if op == "intersection" { 0 } else { 144 };
        assert_eq!(lines(&overlay(&a, &empty, op)).len(), expected);
        assert_eq!(lines(&overlay(&a, &none, op)).len(), expected);
    }
    assert_eq!(lines(&printed(&["dissolve", &empty, "--by", "k"])).len(), 2);
    assert_eq!(areas(&empty), [0.0, 0.0]);
    assert_eq!(lines(&printed(&["repair", &empty])).len(), 2);
    assert_eq!(code(&polycsg(&["validate", &empty])), 0);
}
