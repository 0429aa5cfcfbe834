//! IES and EULUMDAT files.
use radiosity::glam::DVec3;
use radiosity::io::photometry::{open, parse_ies, parse_ldt};
use radiosity::{Distribution, Lamp, Photometry};
use std::f64::consts::PI;
use std::path::Path;

/// A file among the seeds of the fuzz targets.
fn sample(name: &str) -> Photometry {
    let kind = name.rsplit_once('.').unwrap().1;
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    open(seeds.join(kind).join(name)).unwrap()
}

/// The intensity at γ and C in degrees.
fn at(table: &Photometry, height: f64, azimuth: f64) -> f64 {
    let ((sine, cosine), (y, x)) = (height.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    table.candela(7.0 * DVec3::new(sine * x, sine * y, cosine))
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} {wanted}");
}

#[test]
fn an_even_table_shines_alike_everywhere() {
    let text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 2 3 1 1 2 0 0 0 0.5 1 1\n0 90 180\n0\n100 100 100\n";
    let table = parse_ies("even.ies", text.as_bytes()).unwrap();
    near(at(&table, 12.0, 34.0), 100.0);
    near(table.lumens(), 400.0 * PI);
    let lamp = Lamp {
        distribution: Distribution::Measured(table.into()),
        ..Lamp::even("lamp", DVec3::ZERO, vec![2.0])
    };
    near(lamp.share(DVec3::new(1.0, -5.0, 0.3)), 100.0);
    near(lamp.power()[0], 800.0 * PI);
}

#[test]
fn a_table_is_linear_in_between_and_its_flux_is_the_integral() {
    let table = sample("downlight.ies");
    near(at(&table, 0.0, 0.0), 1000.0);
    near(at(&table, 11.25, 200.0), (1000.0 + 923.88) / 2.0);
    assert_eq!(at(&table, 100.0, 0.0), 0.0);
    // A cosine of 1000 cd has 1000 pi lm; chords of it have a little less.
    assert!((table.lumens() / (1000.0 * PI) - 1.0).abs() < 0.02, "{}", table.lumens());
    let steps = 100_000;
    let sum: f64 = (0..steps)
        .map(|k| {
            let height = 180.0 * (f64::from(k) + 0.5) / f64::from(steps);
            at(&table, height, 0.0) * height.to_radians().sin() * PI / f64::from(steps)
        })
        .sum();
    assert!((table.lumens() / (2.0 * PI * sum) - 1.0).abs() < 1e-6);
}

#[test]
fn planes_that_are_left_out_are_mirrored() {
    let quarter = sample("quarter.ies");
    for azimuth in [30.0, 150.0, 210.0, 330.0] {
        near(at(&quarter, 90.0, azimuth), 1.5 * 0.9 * (50.0 + (40.0 - 50.0) * 30.0 / 45.0));
    }
    let half = sample("half.ies");
    near(at(&half, 90.0, 45.0), 4.5);
    near(at(&half, 90.0, 315.0), 4.5);
    near(at(&half, 90.0, 180.0), 3.0);
    let across = sample("across.ies");
    near(at(&across, 90.0, 90.0), 6.5);
    near(at(&across, 90.0, 270.0), 4.5);
    near(at(&across, 90.0, 0.0), 5.5);
    near(at(&across, 90.0, 180.0), 5.5);
}

#[test]
fn eulumdat_counts_candela_for_a_thousand_lumens() {
    let around = sample("around.ldt");
    near(at(&around, 0.0, 10.0), 600.0);
    near(at(&around, 22.5, 350.0), 500.0);
    let none = sample("none.ldt");
    near(at(&none, 90.0, 90.0), 2.0);
    near(at(&none, 90.0, 315.0), 2.5);
    let half = sample("half.ldt");
    near(at(&half, 90.0, 90.0), 40.0);
    near(at(&half, 90.0, 270.0), 40.0);
    near(at(&half, 135.0, 180.0), 15.0);
    let across = sample("across.ldt");
    near(at(&across, 90.0, 90.0), 20.0);
    near(at(&across, 90.0, 270.0), 40.0);
    near(at(&across, 90.0, 0.0), 30.0);
    let quarter = sample("quarter.ldt");
    for azimuth in [90.0, 270.0] {
        near(at(&quarter, 90.0, azimuth), 60.0);
    }
    near(at(&quarter, 90.0, 180.0), 20.0);
}

#[test]
fn bad_photometry_is_refused_with_its_line() {
    let refused = |text: &str| parse_ies("bad.ies", text.as_bytes()).unwrap_err().to_string();
    let head = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n";
    assert!(refused("").contains("TILT"));
    assert!(refused("IESNA:LM-63-2002\nTILT=lamp.tlt\n").contains("bad.ies:2: \"lamp.tlt\""));
    assert!(refused(head).contains("0 values stand where 2 are needed"));
    assert!(refused(&format!("{head}0 90\n0\n1 x\n")).contains("bad.ies:6: \"x\" is not a finite number"));
    assert!(
        refused(&format!("{head}90 0\n0\n1 2\n"))
            .contains("bad.ies:4: \"0\" stands where an ascending angle")
    );
    assert!(refused(&format!("{head}0 90\n0\n1 -2\n")).contains("bad.ies:6: the intensity -2 is negative"));
    assert!(refused(&format!("{head}0 90\n45\n1 2\n")).contains("bad.ies:5"));
    assert!(refused(&head.replace(" 2 1 1 2", " 2 1 2 2")).contains("type 1 (C)"));
    assert!(refused(&head.replace(" 2 1 1 2", " 1e9 1e9 1 2")).contains("bad.ies:3"));
    let refused = |text: &str| parse_ldt("bad.ldt", text.as_bytes()).unwrap_err().to_string();
    assert!(refused("a\n1\n").contains("bad.ldt:2: 2 values stand where 4 are needed"));
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds/ldt/half.ldt");
    let good = std::fs::read_to_string(seeds).unwrap();
    let line = |number: usize, text: &str| {
        let lines = good.lines().enumerate().map(|(at, line)| if at + 1 == number { text } else { line });
        refused(&lines.collect::<Vec<_>>().join("\n"))
    };
    assert!(line(3, "7").contains("bad.ldt:3") && line(4, "3").contains("bad.ldt:3"));
    assert!(line(6, "4").contains("values stand where"));
    assert!(line(29, "bright").contains("bad.ldt:29"));
    assert!(open("lamp.txt").unwrap_err().to_string().contains("unknown kind of photometry"));
}
