//! Laws of the report.
#[path = "../../../radiosity/tests/browser/mod.rs"]
mod browser;
mod labels;

use crate::analysis::{lines, subjects};
use crate::machine::Machine;
use crate::measure::{cases, matrices, published, query::exact, solutions, test_scene::TestScene};
use crate::methods::{self, Step};
use crate::page::table::Table;
use crate::plan::{Plan, Rounds};
use crate::results::Report;
use crate::rows::{Chapter, Measured, Published, Row, Time};
use formfactor::{DVec3, DifferentialArea};
use radiosity::scenes;

fn plan(names: &[&str]) -> Plan {
    let scene = |name: &&str| ((*name).to_owned(), scenes::scene(name).unwrap());
    Plan { scenes: names.iter().map(scene).collect(), quick: true, general: false }
}

/// The cheapest setting of every method.
fn cheapest() -> Vec<Step> {
    let mut steps = methods::steps(&plan(&[]));
    let mut known: Vec<&str> = Vec::new();
    steps.retain(|step| !known.contains(&step.series) && (known.push(step.series), true).1);
    steps
}

/// Every method at its cheapest, from a few points of each scene.
fn glance(names: &[&str]) -> Report {
    let steps = cheapest();
    let mut rows = Vec::new();
    for (name, scene) in &plan(names).scenes {
        let test_scene = TestScene::new(name, scene, 120).unwrap();
        rows.extend(test_scene.queries(4).measure(&steps, Rounds::ONCE).into_iter().map(Row::Measured));
    }
    Report { rows, machine: Machine::here(), quick: true, images: Vec::new(), noise: Vec::new() }
}

/// The tables of a text in Markdown, each with the heading above it.
fn tables(text: &str) -> Vec<(String, Table)> {
    let cells = |line: &str| -> Vec<String> {
        line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    let (mut heading, mut tables, mut inside) = (String::new(), Vec::new(), false);
    for line in text.lines() {
        if line.starts_with('#') {
            heading = line.trim_start_matches('#').trim().to_owned();
        }
        if line.starts_with("| ---") {
            continue;
        }
        match (line.starts_with('|'), inside) {
            (true, false) => tables.push((heading.clone(), Table { header: cells(line), rows: Vec::new() })),
            (true, true) => tables.last_mut().unwrap().1.rows.push(cells(line)),
            _ => {}
        }
        inside = line.starts_with('|');
    }
    tables
}

/// What stays when figures change: the header and the first cell of each row.
fn shape(table: &Table) -> (Vec<String>, Vec<String>) {
    (table.header.clone(), table.rows.iter().map(|row| row[0].clone()).collect())
}

/// Of the command in benchmarks.md.
const BARRETO: [&str; 6] =
    ["emission", "obstruction", "beams", "small-occluders", "perforated", "perforated-cut"];

/// The rows of Barreto's tables, without figures.
fn published() -> impl Iterator<Item = Row> {
    let row = |table, scene, printed| Published {
        table,
        scene,
        method: String::new(),
        published: printed,
        elements: 0,
        vertices: 0,
        seconds: 0.0,
        bytes: None,
        errors: [0.0; 2],
    };
    let tables = published::BARRETO.into_iter();
    tables.flat_map(move |(table, scene, _, printed)| {
        printed.map(|printed| Row::Published(row(table, scene, printed)))
    })
}

#[test]
fn benchmarks_has_the_tables_that_its_command_writes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../radiosity/docs/benchmarks.md");
    let shown = std::fs::read_to_string(path).expect("the benchmarks stand beside the library");
    let command = format!("radiosity report {} -o report", BARRETO.join(" "));
    assert!(shown.contains(&command), "benchmarks.md names no command: {command}");
    assert!(
        shown.contains("radiosity report cornell-box separating-wall -o report"),
        "benchmarks.md names no command"
    );
    let shown = tables(&shown);
    let mut report = glance(&BARRETO);
    report.rows.extend(published());
    for scene in ["cornell-box", "separating-wall"] {
        let solved = solutions::series(&plan(&[])).into_iter().map(|series| solutions::blank(scene, series));
        report.rows.extend(solved.map(Row::Measured));
    }
    let made = tables(&report.tables());
    for (heading, table) in made.iter().filter(|(_, table)| !table.rows.is_empty()) {
        let found = shown.iter().find(|(shown, _)| shown == heading);
        let (_, found) = found.unwrap_or_else(|| panic!("benchmarks.md has no table {heading}"));
        assert_eq!(
            shape(found),
            shape(table),
            "{heading}: make the tables of benchmarks.md anew by its command"
        );
    }
}

#[test]
fn half_of_the_points_see_the_emitters_in_part_or_all_that_do() {
    for (name, scene) in &plan(&["chessboard", "small-occluders", "furnace"]).scenes {
        let test_scene = TestScene::new(name, scene, 400).unwrap();
        let in_part = |count: usize| {
            let set = test_scene.queries(count);
            let seeing = set.queries.iter().filter(|query| set.sees_a_part(query)).count();
            (seeing, set.queries.len())
        };
        let ((seeing, asked), (all, _)) = (in_part(60), in_part(100_000));
        assert!(seeing >= all.min(asked / 2), "{name}: {seeing} of {asked}, {all} in all");
        assert_eq!(all == 0, name == "furnace", "an empty room hides nothing");
    }
}

#[test]
fn on_scenes_with_occlusion_the_exact_bound_is_below_1e_12_and_no_sampling_is_as_exact() {
    let report = glance(&["obstruction", "beams", "perforated"]);
    for (name, rows) in subjects(report.measured(Chapter::Scenes)) {
        for line in lines(&rows) {
            let best = line.best()[0];
            assert_eq!(line.name == methods::EXACT, best < 1e-12, "{name}, {}: {best}", line.name);
        }
    }
}

/// Spread over the unit cube: the fractions of multiples of powers of the root of x^6 = x + 1 (after Roberts 2018).
fn spread(index: u32) -> [f64; 5] {
    const ROOT: f64 = 1.134_724_138_401_519_5;
    [1, 2, 3, 4, 5].map(|power| (f64::from(index) * ROOT.powi(-power)).fract())
}

#[test]
fn anywhere_in_a_scene_the_exact_bound_is_below_1e_12() {
    for name in scenes::names() {
        let scene = scenes::scene(name).unwrap();
        let test_scene = TestScene::new(name, &scene, 120).unwrap();
        let [low, high] = scene.extent();
        for index in 1..60 {
            let [x, y, z, turn, rise] = spread(index);
            let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
            let up = 2.0 * rise - 1.0;
            let normal = DVec3::new(cos, sin, 0.0) * (1.0 - up * up).sqrt() + DVec3::Z * up;
            let place = low + (high - low) * DVec3::new(x, y, z);
            let from = DifferentialArea::new(place, normal).unwrap();
            let [value, bound] = exact(&test_scene.enclosure, &from, &test_scene.emitters);
            assert!(bound < 1e-12, "{name}, {place} {normal}: {value} to {bound}");
        }
        assert!(test_scene.light.iter().all(|[_, bound]| *bound < 1e-12), "{name}");
    }
}

#[test]
fn the_rows_of_two_runs_differ_in_times_alone() {
    let untimed = |report: &Report| -> Vec<Measured> {
        let row = |row: &Measured| Measured { time: Time::default(), ..row.clone() };
        report.measured(Chapter::Scenes).map(row).collect()
    };
    assert_eq!(untimed(&glance(&["beams"])), untimed(&glance(&["beams"])));
}

#[test]
fn every_row_is_a_line_of_json_and_every_scene_a_section() {
    let report = glance(&["obstruction", "wall"]);
    let lines: Vec<serde_json::Value> =
        report.lines().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 1 + report.rows.len());
    assert!(lines[1..].iter().all(|line| line["error"]["max"].is_number() && line["row"] == "measured"));
    let page = report.page(None);
    for part in
        ["<h3 id=\"obstruction\">", "<h3 id=\"wall\">", "prefers-color-scheme: dark", "<svg class=\"plot\""]
    {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("http://") && !page.contains("https://"), "nothing is fetched");
}

#[test]
fn the_page_begins_with_a_sentence_and_a_plot_and_links_to_every_chapter() {
    let mut report = glance(&["obstruction", "wall"]);
    report.rows.extend(published());
    let page = report.page(None);
    let at = |text: &str| page.find(text).unwrap_or_else(|| panic!("no {text}"));
    let scenes = at("<h2 id=\"scenes\">");
    assert!(at("<h1>") < at("<p class=\"lead\">In 2 scenes the exact method"));
    assert!(at("<p class=\"lead\">") < at("medians of 2 scenes") && at("medians of 2 scenes") < scenes);
    // The worst bound of both scenes, with the sign of a bound, in the overview and in four plots.
    assert_eq!(page.matches("Proven bound: the error is below").count(), 5);
    let links: Vec<&str> =
        page.split("href=\"#").skip(1).map(|rest| &rest[..rest.find('"').unwrap()]).collect();
    let heads: Vec<&str> =
        page.split("<h2 id=\"").skip(1).map(|rest| &rest[..rest.find('"').unwrap()]).collect();
    assert_eq!(heads, ["scenes", "published"]);
    for anchor in heads.iter().chain(&["obstruction", "wall"]) {
        assert!(links.contains(anchor), "{anchor}");
    }
    for link in links {
        assert!(page.contains(&format!("id=\"{link}\"")), "{link} leads nowhere");
    }
}

#[test]
fn a_method_that_samples_everywhere_agrees_with_the_exact_references_of_points() {
    let rays = &methods::middle(&plan(&[]))[5];
    for set in cases::query_sets() {
        let exact = set.measure(&cheapest()[..1], Rounds::ONCE);
        assert!(exact[0].error.max <= exact[0].bound.unwrap() + 1e-16, "{}", set.subject);
        let sampled = set.measure(std::slice::from_ref(rays), Rounds::ONCE);
        assert!(sampled[0].error.max < 0.02, "{}: {:?}", set.subject, sampled[0].error);
    }
}

#[test]
fn the_matrix_of_a_room_gets_better_with_its_tolerance_and_is_better_than_from_points() {
    let rows = matrices::measure(&plan(&[]), |_| ());
    let report = Report {
        rows: rows.into_iter().map(Row::Measured).collect(),
        machine: Machine::here(),
        quick: true,
        images: Vec::new(),
        noise: Vec::new(),
    };
    let rows: Vec<&Measured> = report.measured(Chapter::Matrices).collect();
    for line in lines(&rows) {
        let (first, last) = (line.rows[0], line.rows[line.rows.len() - 1]);
        assert!(last.error.max < first.error.max, "{}", line.name);
        assert_eq!(line.name == matrices::AREAS, last.error.max < 1e-6, "{}: {}", line.name, last.error.max);
    }
    let defect = |row: &Measured| row.defect.unwrap();
    let rooms: Vec<&&Measured> = rows.iter().filter(|row| row.series == matrices::AREAS).collect();
    assert!(rooms.windows(2).all(|pair| defect(pair[1]) < defect(pair[0])) && defect(rooms[4]) < 1e-7);
    let page = report.page(None);
    assert!(page.contains("a room of 108 surfaces, 2 boxes: error of rows") && page.contains("View3D"));
}
