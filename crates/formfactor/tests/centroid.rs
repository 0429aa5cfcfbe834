//! The centroid of what is seen, beside form factors of small parts.
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};

/// The square cut in cells, each with what is seen of it.
fn by_cells(
    room: &Enclosure,
    from: &DifferentialArea,
    [low, high]: [DVec3; 2],
    count: usize,
) -> (f64, DVec3) {
    let size = (high - low) / count as f64;
    let (mut sum, mut moment) = (0.0, DVec3::ZERO);
    for cell in 0..count * count {
        let corner = low + size * DVec3::new((cell % count) as f64, (cell / count) as f64, 0.0);
        let points = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let points = points.map(|[x, y]| corner + size * DVec3::new(x, y, 0.0));
        let part = PlanarPolygon::new([points]).expect("a cell");
        let factor = room.form_factor_to_part(from, 0, &part).value;
        sum += factor;
        moment += factor * (corner + size * DVec3::new(0.5, 0.5, 0.0));
    }
    (sum, moment / sum)
}

#[test]
fn the_centroid_is_that_of_many_small_parts() {
    let [low, high] = [DVec3::new(-1.0, -1.5, 2.0), DVec3::new(1.0, 1.0, 2.0)];
    let corner = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let ceiling =
        [[low.x, high.y], [high.x, high.y], [high.x, low.y], [low.x, low.y]].map(|[x, y]| corner(x, y, 2.0));
    let ceiling = PlanarPolygon::new([ceiling]).expect("a ceiling");
    let board = |x: f64, z: f64| {
        PlanarPolygon::new([[corner(x, -0.4, z), corner(x + 0.7, -0.5, z), corner(x + 0.6, 0.3, z + 0.2)]])
            .expect("a board")
    };
    let corner_plate = PlanarPolygon::new([[
        corner(0.5, 0.5, 1.5),
        corner(0.9, 0.5, 1.5),
        corner(0.9, 0.9, 1.5),
        corner(0.7, 0.6, 1.5),
        corner(0.5, 0.9, 1.5),
    ]])
    .expect("a plate");
    let room = Enclosure::new(vec![ceiling.clone(), board(-0.6, 1.0), board(0.1, 1.4), corner_plate]);
    for (place, normal) in [
        (corner(0.1, 0.2, 0.0), DVec3::Z),
        (corner(2.0, 0.5, 1.0), DVec3::new(-1.0, 0.1, 0.3)),
        (corner(0.3, -0.7, 1.97), DVec3::new(0.2, 0.1, 1.0)),
        (corner(-1.0, 0.2, 1.0), DVec3::X),
    ] {
        let from = DifferentialArea::new(place, normal).expect("a point");
        let (sum, expected) = by_cells(&room, &from, [low, high], 60);
        let (factor, centroid) = room.form_factor_and_centroid(&from, 0, &ceiling, &[1, 2, 3]);
        assert!((factor.value - sum).abs() < 1e-9, "{factor:?} {sum}");
        assert!(centroid.distance(expected) < 1e-3, "{centroid} {expected} from {place}");
    }
}

/// Numbers from 0 to 1, always the same (Steele, Lea and Flood 2014).
fn unit(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb) >> 11) as f64 / (1u64 << 53) as f64
}

/// Strips of any width, from near and far, flat and steep: cut in two, the centroids of the halves make up that of the whole.
#[test]
fn the_centroid_of_a_whole_is_the_mean_of_those_of_its_halves() {
    let mut state = 1;
    for turn in 0..4000 {
        let mut random = |low: f64, high: f64| low + (high - low) * unit(&mut state);
        let reach = 10f64.powf(random(-1.0, 1.5));
        let middle = DVec3::new(random(-reach, reach), random(-reach, reach), 1.0);
        let angle = random(0.0, 6.3);
        let (along, across) = (DVec3::new(angle.cos(), angle.sin(), 0.0), 10f64.powf(random(-3.0, 0.0)));
        let aside = DVec3::new(-along.y, along.x, 0.0) * across;
        let at = |x: f64, y: f64| middle + x * along + y * aside;
        let height = 10f64.powf(random(-3.0, 0.0));
        let lean = DVec3::new(random(-1.0, 1.0), random(-1.0, 1.0), random(0.1, 1.0));
        let from = DifferentialArea::new(DVec3::new(0.0, 0.0, 1.0 - height), lean).expect("a point");
        let strip = |low: f64, high: f64| {
            PlanarPolygon::new([[at(low, 1.0), at(high, 1.0), at(high, -1.0), at(low, -1.0)]])
                .expect("a strip")
        };
        let whole = strip(-1.0, 1.0);
        let room = Enclosure::new(vec![whole.clone()]);
        let seen = |part: &PlanarPolygon| {
            let (factor, centroid) = room.form_factor_and_centroid(&from, 0, part, &[]);
            (factor.value, factor.value * centroid)
        };
        let (factor, moment) = seen(&whole);
        let (left, right) = (seen(&strip(-1.0, 0.1)), seen(&strip(0.1, 1.0)));
        let off = (moment - left.1 - right.1).length();
        assert!(off <= 1e-4 * factor + 1e-12, "{turn}: {} off from {height} below {middle}", off / factor);
    }
}
