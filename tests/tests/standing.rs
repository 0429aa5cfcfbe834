//! Form factors between areas in rooms whose obstructions stand on what they hide (blocks beside walls, doors, steps, furniture, blades),
//! against means of exact point factors at random points.
use formfactor::{DifferentialArea, Enclosure, Limits, PlanarPolygon, Tolerance};
use tests::light::{Surface, room};
use tests::random::Random;

/// Kinds and seeds, and the first of every third surface that is looked from.
const ROOMS: [(usize, u64, usize); 11] = [
    (0, 0, 0),
    (0, 1, 1),
    (1, 0, 0),
    (1, 1, 1),
    (2, 0, 0),
    (2, 1, 1),
    (3, 0, 0),
    (4, 0, 0),
    (4, 1, 1),
    (5, 1, 1),
    (6, 0, 0),
];

/// Each of so many cells a side has a point.
const CELLS: usize = 12;

fn enclosure(room: &[Surface]) -> Enclosure {
    let polygons = room.iter().map(|surface| PlanarPolygon::new(&surface.loops).expect("a polygon"));
    Enclosure::new(polygons.collect())
}

/// The means of the point factors from a parallelogram to all polygons, and their standard errors, by one random point in each cell of a
/// grid, twice: the two differ by what each is off by.
fn means(scene: &Enclosure, from: usize, surface: &Surface, random: &mut Random) -> Vec<[f64; 2]> {
    let ring = &surface.loops[0];
    let (across, up) = (ring[1] - ring[0], ring[3] - ring[0]);
    let mut sums = vec![[0.0; 2]; scene.polygons().len()];
    let mut spread = vec![0.0; sums.len()];
    for cell in 0..CELLS * CELLS {
        let [x, y] = [cell % CELLS, cell / CELLS];
        let mut rows = [(); 2].map(|()| {
            let [u, v] = [x, y].map(|i| (i as f64 + random.unit()) / CELLS as f64);
            let point = ring[0] + across * u + up * v;
            let from = DifferentialArea::new(point, across.cross(up)).expect("a point").owned_by(from);
            scene.row(&from).into_iter().map(|factor| factor.value)
        });
        for (sum, spread) in sums.iter_mut().zip(&mut spread) {
            let [one, other] = [0, 1].map(|i| rows[i].next().unwrap_or(0.0));
            sum[0] += (one + other) / 2.0;
            *spread += ((one - other) / 2.0).powi(2);
        }
    }
    let count = (CELLS * CELLS) as f64;
    sums.iter().zip(spread).map(|([sum, _], spread)| [sum / count, spread.sqrt() / count]).collect()
}

#[test]
fn factors_past_what_stands_on_what_it_hides_are_means_of_exact_ones() {
    let tolerance = Tolerance { absolute: 1e-3, relative: 0.0, row: 8e-3 };
    let mut random = Random::new(18);
    for (kind, seed, first) in ROOMS {
        let room = room(kind, seed);
        let scene = enclosure(&room);
        let plain = |id: &usize| room[*id].loops.len() == 1 && room[*id].loops[0].len() == 4;
        for from in (0..room.len()).filter(plain).skip(first).step_by(3) {
            let row = scene.area_row(from, tolerance, &Limits::default());
            let row = row.expect("a tolerance").expect("no stop");
            let points = means(&scene, from, &room[from], &mut random);
            // Small ones are seen from too few points of large ones.
            let is_larger = |to: &usize| scene.polygons()[*to].area() >= scene.polygons()[from].area();
            for (to, [mean, error]) in points.into_iter().enumerate().filter(|(to, _)| is_larger(to)) {
                let found = row.iter().find(|(id, _)| *id == to).map_or(Default::default(), |(_, f)| *f);
                let most = found.error_estimate + 6.0 * error + 2e-4;
                let [name, other] = [&room[from].name, &room[to].name];
                assert!(
                    (found.value - mean).abs() <= most,
                    "{kind} {seed}, {name} - {other}: {found:?}, points {mean} +- {error}"
                );
                assert!(found.evaluations < 300_000, "{kind} {seed}, {name} - {other}: {found:?}");
            }
        }
    }
}
