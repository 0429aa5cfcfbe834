//! Times of exact form factors in units of one unoccluded quad by a plain atan2 loop, measured in the same run, beside
//! View3D's inner kernel in the same unit: `cargo run --release -p formfactor --example speed`.
//!
//! Each round times every scene once, the unit among them; a scene's ratio is the smallest time of all rounds by the
//! unit's. View3D's ratios were measured once, of its C code built with -O2, by its own project-and-subtract kernel.
use formfactor::{DVec3, DifferentialArea, Enclosure, Error, FormFactor, PlanarPolygon, unoccluded};
use serde::Deserialize;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::io::{self, Write};
use std::time::Instant;

const ROUNDS: usize = 40;
/// Seconds that one measurement of one scene takes, about.
const SPAN: f64 = 2e-3;

/// A target before its occluders, as an enclosure whose polygon 0 is the target; View3D's ratio where there is one.
struct Scene {
    name: &'static str,
    from: DifferentialArea,
    enclosure: Enclosure,
    view3d: Option<f64>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scenes = scenes()?;
    let counts: Vec<u32> = scenes.iter().map(|s| repetitions(|| s.value())).collect();
    let unit_count = repetitions(unit);
    let (mut unit_best, mut best) = (f64::INFINITY, vec![f64::INFINITY; scenes.len()]);
    for _ in 0..ROUNDS {
        unit_best = unit_best.min(time(unit_count, unit));
        for ((scene, count), best) in scenes.iter().zip(&counts).zip(&mut best) {
            *best = best.min(time(*count, || scene.value()));
        }
    }
    write_table(&scenes, unit_best, &best)?;
    Ok(())
}

fn write_table(scenes: &[Scene], unit: f64, times: &[f64]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "unit: one quad by a plain atan2 loop, {:.0} ns\n", unit * 1e9)?;
    writeln!(
        out,
        "| scene | time | units | View3D | form factor | bound |\n| --- | --- | --- | --- | --- | --- |"
    )?;
    for (scene, time) in scenes.iter().zip(times) {
        let factor = scene.enclosure.form_factor(&scene.from, 0);
        let view3d = scene.view3d.map_or_else(|| "–".to_owned(), |ratio| ratio.to_string());
        let (micros, units) = (time * 1e6, time / unit);
        let FormFactor { value, error_bound } = factor;
        writeln!(
            out,
            "| {} | {micros:.2} µs | {units:.1} | {view3d} | {value:.15} | {error_bound:.0e} |",
            scene.name
        )?;
    }
    Ok(())
}

impl Scene {
    fn value(&self) -> f64 {
        let (from, enclosure) = (black_box(&self.from), black_box(&self.enclosure));
        match enclosure.polygons() {
            [target] => unoccluded(from, target).value,
            _ => enclosure.form_factor(from, 0).value,
        }
    }
}

/// Seconds per call.
fn time(count: u32, mut call: impl FnMut() -> f64) -> f64 {
    let start = Instant::now();
    for _ in 0..count {
        black_box(call());
    }
    start.elapsed().as_secs_f64() / f64::from(count)
}

fn repetitions(mut call: impl FnMut() -> f64) -> u32 {
    let enough = |count: &u32| time(*count, &mut call) * f64::from(*count) > SPAN || *count > 1 << 24;
    (0..25).map(|i| 1 << i).find(enough).unwrap_or(1)
}

/// Lambert's sum as one would first write it: no horizon, no bound, no occluder.
fn unit() -> f64 {
    let corners = black_box([[0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    let (position, normal) = (black_box(DVec3::ZERO), black_box(DVec3::Z));
    let toward = corners.map(|corner| DVec3::from(corner) - position);
    let mut sum = 0.0;
    for (i, a) in toward.iter().enumerate() {
        let b = toward[(i + 1) % 4];
        let cross = b.cross(*a);
        let sine = cross.length();
        sum += sine.atan2(a.dot(b)) * normal.dot(cross) / sine;
    }
    sum / TAU
}

fn scenes() -> Result<Vec<Scene>, Box<dyn std::error::Error>> {
    Ok(vec![
        of_case("01", "unoccluded", 2.3)?,
        of_case("05", "one quad", 11.0)?,
        under_lamp("8 bars, 4 across 4", bars()?, Some(55.0))?,
        of_case("09", "25 squares", 133.0)?,
        of_case("11", "20 triangles", 290.0)?,
        under_lamp("100 triangles", triangles(100, 0.2)?, Some(1700.0))?,
        under_lamp("64 blinds, half open", blinds()?, Some(3000.0))?,
        under_lamp("10 occluders", ten()?, None)?,
        under_lamp("10 occluders and 9990 elsewhere", [ten()?, elsewhere(9990)?].concat(), None)?,
    ])
}

/// A 2 x 2 lamp two above dA, and occluders.
fn under_lamp(
    name: &'static str,
    occluders: Vec<PlanarPolygon>,
    view3d: Option<f64>,
) -> Result<Scene, Error> {
    let lamp =
        PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
    let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
    Ok(Scene { name, from, enclosure: Enclosure::new([vec![lamp], occluders].concat()), view3d })
}

/// A reference case by the start of its name.
fn of_case(start: &str, name: &'static str, view3d: f64) -> Result<Scene, Box<dyn std::error::Error>> {
    let data: Cases = serde_json::from_str(include_str!("../tests/data/form_factor_point.json"))?;
    let found = data.cases.into_iter().find(|case| case.name.starts_with(start));
    let case = found.ok_or("no such case")?;
    let polygons = std::iter::once(&case.target).chain(&case.occluders).map(PlanarPolygon::new);
    Ok(Scene {
        name,
        from: DifferentialArea::new(case.point.into(), case.normal.into())?,
        enclosure: Enclosure::new(polygons.collect::<Result<_, _>>()?),
        view3d: Some(view3d),
    })
}

fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> Result<PlanarPolygon, Error> {
    PlanarPolygon::new([[[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]])
}

/// Four bars along x under four along y, longer than the lamp.
fn bars() -> Result<Vec<PlanarPolygon>, Error> {
    let middles = [-0.45, -0.15, 0.15, 0.45];
    let (long, wide) = ([-1.5, 1.5], |middle: f64| [middle - 0.04, middle + 0.04]);
    let lower = middles.iter().map(|y| rectangle(long, wide(*y), 0.9));
    lower.chain(middles.iter().map(|x| rectangle(wide(*x), long, 1.1))).collect()
}

/// Slats along y, each as wide as the gap to the next, all across the lamp as dA sees it.
fn blinds() -> Result<Vec<PlanarPolygon>, Error> {
    let slat = |i: u32| f64::from(2 * i) / 128.0 - 0.5 + 1e-3;
    (0..64).map(|i| rectangle([slat(i), slat(i) + 1.0 / 128.0], [-0.75, 0.75], 1.0)).collect()
}

/// Triangles of a size between dA and the lamp, where the lamp's pyramid is.
fn triangles(count: usize, size: f64) -> Result<Vec<PlanarPolygon>, Error> {
    let mut random = Random(7);
    let mut triangle = || {
        let height = random.between(0.5, 1.5);
        let middle = DVec3::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1.0) * height;
        PlanarPolygon::new([[(); 3].map(|()| middle + random.vector(size / 2.0))])
    };
    (0..count).map(|_| triangle()).collect()
}

fn ten() -> Result<Vec<PlanarPolygon>, Error> {
    triangles(10, 0.5)
}

/// Triangles all around the lamp's pyramid, most of them as high as it, and none in it.
fn elsewhere(count: usize) -> Result<Vec<PlanarPolygon>, Error> {
    let mut random = Random(11);
    let mut triangle = || loop {
        let middle = random.vector(8.0);
        if middle.x.abs().max(middle.y.abs()) > middle.z.abs() / 2.0 + 1.0 {
            return PlanarPolygon::new([[(); 3].map(|()| middle + random.vector(0.2))]);
        }
    };
    (0..count).map(|_| triangle()).collect()
}

/// Numbers that look random (Steele, Lea and Flood's splitmix64).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self, half: f64) -> DVec3 {
        DVec3::from([(); 3].map(|()| self.between(-half, half)))
    }
}

/// The file of reference cases: what is used of it.
#[derive(Deserialize)]
struct Cases {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    point: [f64; 3],
    normal: [f64; 3],
    target: Vec<Vec<[f64; 3]>>,
    occluders: Vec<Vec<Vec<[f64; 3]>>>,
}
