//! Answer keys: configurations of the catalogues, of a standard, of other programs, with closed forms, and the page that shows them.
//!
//! `CERTIFIED=write cargo test -p formfactor --release --test certified` writes `docs/certified.md` anew.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod areas;
mod contours;
mod key;
mod obstructed;
mod page;
#[path = "../../../../tests/src/obstructed/plates.rs"]
#[allow(unreachable_pub, reason = "a module of another package")]
mod plates;
mod points;
#[path = "../../../../tests/src/obstructed/prisms.rs"]
#[allow(unreachable_pub, reason = "a module of another package")]
mod prisms;
#[path = "../../../../tests/src/obstructed/profile.rs"]
#[allow(unreachable_pub, reason = "a module of another package")]
mod profile;

use formfactor::{DifferentialArea, Enclosure, Limits, PlanarPolygon};
use key::{Key, Setup};
use page::Found;
use std::path::Path;

fn parts() -> [(&'static str, Vec<Key>); 3] {
    [
        ("From a point", points::keys()),
        ("From area to area, nothing between", areas::keys()),
        ("From area to area past something", obstructed::keys()),
    ]
}

fn find(setup: &Setup) -> Found {
    let polygon = |loops: &contours::Loops| PlanarPolygon::new(loops).unwrap();
    match setup {
        Setup::Point { position, normal, polygons } => {
            let from = DifferentialArea::new(*position, *normal).unwrap();
            let others: Vec<PlanarPolygon> = polygons[1..].iter().map(polygon).collect();
            let found = formfactor::form_factor(&from, &polygon(&polygons[0]), &others);
            Found { value: found.value, error: found.error_bound }
        }
        Setup::Area { polygons, tolerance } => {
            let enclosure = Enclosure::new(polygons.iter().map(polygon).collect());
            let found = enclosure.area_form_factor(0, 1, *tolerance, &Limits::default()).unwrap().unwrap();
            Found { value: found.value, error: found.error_estimate }
        }
    }
}

#[test]
fn every_key_fits() {
    let mut misses = Vec::new();
    for key in parts().iter().flat_map(|(_, keys)| keys) {
        let found = find(&key.setup);
        let allowed = match key.setup {
            Setup::Point { .. } => found.error,
            Setup::Area { tolerance, .. } => tolerance,
        };
        let off = (found.value - key.exact).abs();
        if !(off <= allowed + key.slack && found.error <= allowed) {
            misses.push(format!("{}: {} ± {:e}, exactly {}", key.name, found.value, found.error, key.exact));
        }
    }
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

/// One in the last digit that was printed.
fn last_digit(text: &str) -> f64 {
    let decimals = text.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    10.0_f64.powi(-i32::try_from(decimals).unwrap())
}

#[test]
fn what_is_said_elsewhere_is_as_right_as_the_page_says() {
    for key in parts().iter().flat_map(|(_, keys)| keys) {
        let Some(published) = &key.published else { continue };
        let (printed, exact): (f64, f64) = (published.text.parse().unwrap(), key.exact * key.unit.0);
        let is_right = (printed - exact).abs() <= last_digit(published.text) + key.slack * key.unit.0;
        assert_eq!(is_right, published.is_right, "{}: printed {printed}, exactly {exact}", key.name);
    }
}

#[test]
fn the_page_says_what_is_found() {
    let parts = parts();
    let found: Vec<(&str, Vec<(&Key, Found)>)> = parts
        .iter()
        .map(|(title, keys)| (*title, keys.iter().map(|k| (k, find(&k.setup))).collect()))
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/certified.md");
    if std::env::var_os("CERTIFIED").is_some() {
        std::fs::write(&path, page::write(&found)).unwrap();
    }
    let text = std::fs::read_to_string(&path).unwrap();
    let rows = page::read(&text);
    let keys: Vec<&(&Key, Found)> = found.iter().flat_map(|(_, keys)| keys).collect();
    let names = |key: &&(&Key, Found)| key.0.name.clone();
    assert_eq!(
        rows.iter().map(|r| r.name.to_owned()).collect::<Vec<_>>(),
        keys.iter().map(names).collect::<Vec<_>>()
    );
    assert!(rows.len() >= 75, "only {} rows", rows.len());
    for (row, (key, found)) in rows.iter().zip(keys) {
        let (value, error) = (found.value * key.unit.0, found.error * key.unit.0);
        assert_eq!(row.rest, page::rest(key), "{}", key.name);
        // The digits of the page are cut off at its error.
        assert!(
            (row.value - value).abs() <= 2.0 * row.error,
            "{}: {value}, on the page {}",
            key.name,
            row.value
        );
        let exact = key.exact * key.unit.0;
        assert!(
            (row.value - exact).abs() <= 2.0 * row.error + key.slack * key.unit.0,
            "{}: exactly {exact}",
            key.name
        );
        // Of another machine or a later version, but no other size.
        assert!(
            error <= 2.0 * row.error.max(1e-15) && row.error <= 1e-13 + 100.0 * error,
            "{}: ± {error:e}",
            key.name
        );
    }
}
