//! Whole matrices from area to area: by cubature, by rows from points on each surface, and View3D's figures beside them.
use super::rooms::ClosedRoom;
use crate::clock::{Job, interleaved};
use crate::plan::Plan;
use crate::rows::{Chapter, Deviation, Measured, Spread, Time};
use formfactor::approx::{Exact, Hemicube, Method, MonteCarlo, Sampling};
use formfactor::{DVec3, DifferentialArea, Enclosure, Limits, PlanarPolygon};
use std::hint::black_box;

/// Factors by row and column.
type Dense = Vec<Vec<f64>>;

/// A way to a matrix at one setting.
struct Way {
    series: &'static str,
    setting: String,
    amount: f64,
    find: Box<dyn Fn(&Enclosure) -> Dense>,
}

/// The name of the series from area to area.
pub(crate) const AREAS: &str = "area to area";
/// How the names of series from points begin.
pub(crate) const POINTS: &str = "points";
/// The tolerance of the reference.
const FINE: f64 = 1e-7;

/// Every room with its ways.
pub(crate) fn measure(plan: &Plan, mut say: impl FnMut(&str)) -> Vec<Measured> {
    let mut rows = Vec::new();
    for (room, view3d) in &ROOMS[..if plan.quick { 1 } else { ROOMS.len() }] {
        say(&room.name());
        rows.extend(of_room(*room, view3d, plan));
    }
    rows
}

fn of_room(room: ClosedRoom, view3d: &[View3d], plan: &Plan) -> Vec<Measured> {
    let (ways, enclosure) = (ways(), room.enclosure());
    let reference = by_areas(&enclosure, FINE);
    let unit: Job<'_, Dense> = Box::new(|| vec![vec![plain_quad()]]);
    let job = |way| -> Job<'_, Dense> { Box::new(|| (way as &Way).find.as_ref()(&enclosure)) };
    let jobs: Vec<Job<'_, Dense>> = std::iter::once(unit).chain(ways.iter().map(job)).collect();
    let mut found = interleaved(&jobs, plan.rounds()).into_iter();
    let unit = found.next().map_or(0.0, |(_, time)| time.cpu.low);
    let own = ways.iter().zip(found).map(|(way, (matrix, time))| Measured {
        series: way.series.to_owned(),
        setting: way.setting.clone(),
        amount: way.amount,
        error: entries(&matrix, &reference),
        defect: Some(defect(&matrix)),
        time,
        ..blank(room)
    });
    let pairs = reference.len() * (reference.len() - 1) / 2;
    let peers = view3d.iter().map(|figures| figures.row(room, unit * pairs as f64));
    own.chain(peers).collect()
}

fn blank(room: ClosedRoom) -> Measured {
    Measured {
        chapter: Chapter::Matrices,
        subject: room.name(),
        series: String::new(),
        setting: String::new(),
        amount: 0.0,
        error: Deviation::default(),
        certified: false,
        bound: None,
        defect: None,
        points: None,
        in_part: None,
        valid: None,
        time: Time::default(),
    }
}

/// All ways, from cheap to dear.
fn ways() -> Vec<Way> {
    let mut ways: Vec<Way> = (2..=6).map(|digits| areas(0.1_f64.powi(digits))).collect();
    for n in [1, 2, 4] {
        ways.push(points("points, exact", String::new(), n, Exact));
        let cells = 32 * n;
        ways.push(points("points, hemicube", format!(", {cells} × {cells} cells"), n, Hemicube::new(cells)));
        let rays = 64 * n * n;
        let method = MonteCarlo { rays, sampling: Sampling::Stratified, seed: 1 };
        ways.push(points("points, rays", format!(", {rays} rays"), n, method));
    }
    ways
}

fn areas(tolerance: f64) -> Way {
    Way {
        series: AREAS,
        setting: format!("rows to {tolerance:.0e}"),
        amount: tolerance,
        find: Box::new(move |enclosure| by_areas(enclosure, tolerance)),
    }
}

fn by_areas(enclosure: &Enclosure, tolerance: f64) -> Dense {
    let rows = enclosure.area_matrix(tolerance, &Limits::default());
    let rows = rows.expect("the tolerance is positive").expect("nothing stops it");
    let mut dense = vec![vec![0.0; rows.len()]; rows.len()];
    for (from, row) in rows.iter().enumerate() {
        row.iter().for_each(|(to, factor)| dense[from][*to] = factor.value);
    }
    dense
}

/// The mean of a method's rows over the middles of n × n parts of each rectangle.
fn points(series: &'static str, setting: String, n: u32, method: impl Method + 'static) -> Way {
    let find = move |enclosure: &Enclosure| -> Dense {
        let targets: Vec<usize> = (0..enclosure.polygons().len()).collect();
        let row = |(id, polygon)| {
            let rows: Dense = (0..n * n)
                .map(|part| method.row(enclosure, &point(polygon, id, [part % n, part / n], n), &targets))
                .collect();
            targets
                .iter()
                .map(|to| rows.iter().map(|row| row[*to]).sum::<f64>() / rows.len() as f64)
                .collect()
        };
        enclosure.polygons().iter().enumerate().map(|(id, polygon)| row((id, polygon))).collect()
    };
    let setting = format!("{n} × {n} points{setting}");
    Way { series, setting, amount: f64::from(n), find: Box::new(find) }
}

/// The middle of one of n × n parts of a rectangle.
fn point(polygon: &PlanarPolygon, id: usize, part: [u32; 2], n: u32) -> DifferentialArea {
    let corners = polygon.loops().next().unwrap_or_default();
    let [along, up] = part.map(|i| (f64::from(i) + 0.5) / f64::from(n));
    let position = corners[0] + (corners[1] - corners[0]) * along + (corners[3] - corners[0]) * up;
    DifferentialArea::new(position, polygon.normal()).expect("a point with a normal").owned_by(id)
}

/// How far entries are from those of the reference.
fn entries(matrix: &Dense, reference: &Dense) -> Deviation {
    let pairs = matrix.iter().flatten().zip(reference.iter().flatten());
    Deviation::of(&pairs.map(|(found, exact)| (found - exact).abs()).collect::<Vec<_>>())
}

/// The largest |sum - 1| of a row.
fn defect(matrix: &Dense) -> f64 {
    matrix.iter().map(|row| (row.iter().sum::<f64>() - 1.0).abs()).fold(0.0, f64::max)
}

/// Lambert's sum of one quad as one would first write it: the unit of View3D's times.
fn plain_quad() -> f64 {
    let corners = black_box([[0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    let (toward, normal) =
        (corners.map(|corner| DVec3::from(corner) - black_box(DVec3::ZERO)), black_box(DVec3::Z));
    let term = |i: usize| {
        let (a, b) = (toward[i], toward[(i + 1) % 4]);
        let cross = b.cross(a);
        cross.length().atan2(a.dot(b)) * normal.dot(cross) / cross.length()
    };
    (0..4).map(term).sum::<f64>() / std::f64::consts::TAU
}

/// What View3D 4.0 (its C code built with -O2) took and erred by on a room, without closure: measured once, on one core.
struct View3d {
    eps: &'static str,
    /// CPU of a pair in plain quads.
    units: f64,
    /// The largest and the mean error of an entry.
    errors: [f64; 2],
    defect: f64,
}

impl View3d {
    fn row(&self, room: ClosedRoom, unit: f64) -> Measured {
        let seconds = self.units * unit;
        let cpu = Spread { median: seconds, low: seconds, high: seconds };
        Measured {
            series: "View3D".to_owned(),
            setting: format!("eps {}", self.eps),
            amount: self.eps.parse().unwrap_or(0.0),
            error: Deviation { max: self.errors[0], mean: self.errors[1], beyond: 0.0 },
            defect: Some(self.defect),
            time: Time { cpu, wall: cpu, rounds: 1 },
            ..blank(room)
        }
    }
}

/// The rooms with View3D's figures.
const ROOMS: [(ClosedRoom, &[View3d]); 3] = [
    (
        ClosedRoom { tiles: 4, boxes: 2 },
        &[
            View3d { eps: "1e-2", units: 44.0, errors: [0.000844, 1.52e-05], defect: 0.00233 },
            View3d { eps: "1e-3", units: 44.0, errors: [0.000844, 6.38e-06], defect: 0.00235 },
            View3d { eps: "1e-4", units: 49.0, errors: [0.000169, 2.09e-06], defect: 0.000291 },
            View3d { eps: "1e-5", units: 78.0, errors: [5.33e-05, 6.1e-07], defect: 8.9e-05 },
            View3d { eps: "1e-6", units: 203.0, errors: [1.45e-05, 2.9e-07], defect: 2.5e-05 },
        ],
    ),
    (
        ClosedRoom { tiles: 6, boxes: 8 },
        &[
            View3d { eps: "1e-2", units: 70.1, errors: [0.00255, 6.05e-06], defect: 0.00462 },
            View3d { eps: "1e-3", units: 74.0, errors: [0.000494, 3.46e-06], defect: 0.00102 },
            View3d { eps: "1e-4", units: 77.9, errors: [0.000236, 1.93e-06], defect: 0.000397 },
            View3d { eps: "1e-5", units: 144.0, errors: [0.000104, 7.04e-07], defect: 0.000161 },
            View3d { eps: "1e-6", units: 385.4, errors: [4.53e-05, 2.98e-07], defect: 6.8e-05 },
        ],
    ),
    (
        ClosedRoom { tiles: 12, boxes: 20 },
        &[
            View3d { eps: "1e-2", units: 81.6, errors: [0.0013, 1.46e-06], defect: 0.00202 },
            View3d { eps: "1e-3", units: 80.5, errors: [0.000782, 1.05e-06], defect: 0.00108 },
            View3d { eps: "1e-4", units: 86.1, errors: [0.000782, 6.55e-07], defect: 0.000845 },
            View3d { eps: "1e-5", units: 154.2, errors: [5.83e-05, 3.15e-07], defect: 0.000105 },
            View3d { eps: "1e-6", units: 376.9, errors: [4.9e-05, 2.07e-07], defect: 8.9e-05 },
        ],
    ),
];
