//! Form factors between areas with bounds: scenes that touch, cross and degenerate, against estimates, which are cubature of
//! clipped views.
use formfactor::{AreaFormFactor, BoundedFormFactor, DVec3, Enclosure, Limits, PlanarPolygon, glam};

/// A generator of numbers, the same everywhere [splitmix64].
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }

    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.share(), self.share(), self.share())
    }

    /// A point of a lattice of so many steps.
    fn node(&mut self, steps: u64) -> DVec3 {
        DVec3::from_array([0; 3].map(|_| self.below(steps) as f64)) / (steps - 1) as f64
    }
}

/// Polygons that need not keep apart, as they are, tiny, huge, and in map coordinates.
fn scene(seed: u64) -> Vec<PlanarPolygon> {
    let mut numbers = Numbers(seed);
    let family = seed % 6;
    let count = 2 + numbers.below(5);
    let mut polygons = Vec::new();
    while (polygons.len() as u64) < count {
        match family {
            0 => polygons.extend(PlanarPolygon::new([[0; 3].map(|_| numbers.point())])),
            1 => polygons.extend(PlanarPolygon::new([[0; 3].map(|_| numbers.node(4))])),
            2 => polygons.extend(rectangle(&mut numbers)),
            3 => polygons.extend(bracket(&mut numbers)),
            4 => polygons.extend(cuboid(&mut numbers)),
            _ => polygons.extend(parallelogram(&mut numbers)),
        }
    }
    let (scale, shift) = [(1.0, 0.0), (2.0_f64.powi(-60), 0.0), (2.0_f64.powi(150), 0.0), (1e3, 5e5)]
        [usize::try_from(seed / 6 % 4).unwrap_or(0)];
    let moved = |polygon: &PlanarPolygon| {
        let loops: Vec<Vec<DVec3>> =
            polygon.loops().map(|l| l.iter().map(|p| *p * scale + shift).collect()).collect();
        PlanarPolygon::new(loops).ok()
    };
    polygons.iter().filter_map(moved).collect()
}

/// In a plane of the lattice, along its axes.
fn rectangle(numbers: &mut Numbers) -> Option<PlanarPolygon> {
    let (low, high) = (numbers.node(5), numbers.node(5));
    let axis = usize::try_from(numbers.below(3)).unwrap_or(0);
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let corner = |at_u: f64, at_v: f64| {
        let mut point = low;
        (point[u], point[v]) = (at_u, at_v);
        point
    };
    let corners =
        [corner(low[u], low[v]), corner(high[u], low[v]), corner(high[u], high[v]), corner(low[u], high[v])];
    PlanarPolygon::new([corners]).ok()
}

/// An L that may lie anywhere, its vertices not exactly coplanar.
fn bracket(numbers: &mut Numbers) -> Option<PlanarPolygon> {
    let (at, along) = (numbers.point(), numbers.point() - 0.5);
    let across = along.cross(numbers.point() - 0.5);
    let shape = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.4], [0.3, 0.4], [0.3, 1.0], [0.0, 1.0]];
    PlanarPolygon::new([shape.map(|[u, v]| at + along * u + across * (2.0 * v))]).ok()
}

fn parallelogram(numbers: &mut Numbers) -> Option<PlanarPolygon> {
    let (at, along, across) = (numbers.point(), numbers.point() - 0.5, numbers.point() - 0.5);
    PlanarPolygon::new([[at, at + along, at + along + across, at + across]]).ok()
}

/// A closed box, turned outward.
fn cuboid(numbers: &mut Numbers) -> Vec<PlanarPolygon> {
    let (one, other) = (numbers.node(6), numbers.node(6));
    let (low, high) = (one.min(other), one.max(other));
    let corner =
        |i: usize| DVec3::from_array([0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low } else { high }[axis]));
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let faces: Result<Vec<_>, _> = faces.iter().map(|face| PlanarPolygon::new([face.map(corner)])).collect();
    faces.unwrap_or_default()
}

fn bounded(enclosure: &Enclosure, pair: [usize; 2], tolerance: f64) -> BoundedFormFactor {
    let limits = Limits { per_pair: 1_000, ..Limits::default() };
    let found = enclosure.bounded_area_form_factor(pair[0], pair[1], tolerance, &limits);
    found.expect("a tolerance above 0").expect("no stop")
}

fn estimated(enclosure: &Enclosure, pair: [usize; 2]) -> AreaFormFactor {
    let found = enclosure.area_form_factor(pair[0], pair[1], 1e-5, &Limits::default());
    found.expect("a tolerance above 0").expect("no stop")
}

/// What is wrong with the bounds in a scene: they lie beyond what estimates say.
fn complaints(seed: u64) -> Vec<String> {
    let enclosure = Enclosure::new(scene(seed));
    let count = enclosure.polygons().len();
    let mut found = Vec::new();
    for pair in (0..count).flat_map(|i| (0..count).map(move |j| [i, j])).filter(|[i, j]| i < j) {
        let bounded = bounded(&enclosure, pair, 1e-3);
        let estimated = estimated(&enclosure, pair);
        let beyond = (bounded.value - estimated.value).abs() - bounded.error_bound - estimated.error_estimate;
        if beyond > 0.0 || !(0.0..=1.0).contains(&bounded.error_bound) {
            found.push(format!("scene {seed}, {pair:?}: {bounded:?}, {estimated:?}"));
        }
    }
    found
}

/// `SCENES=20000 FIRST=0` asks more.
#[test]
fn bounds_hold_where_polygons_touch_and_cross() {
    let number =
        |name: &str, other: u64| std::env::var(name).map_or(other, |text| text.parse().expect("a number"));
    let first = number("FIRST", 0);
    let found: Vec<String> = (first..first + number("SCENES", 180)).flat_map(complaints).collect();
    assert!(found.is_empty(), "{}:\n{}", found.len(), found.join("\n"));
}

/// Where three edges meet in the cell's plane an occluder's vertex and the point opposite to it lie on the same two planes.
#[test]
fn a_vertex_in_the_plane_of_the_source_is_not_its_opposite() {
    assert_eq!(complaints(109), Vec::<String>::new());
    assert_eq!(complaints(139), Vec::<String>::new());
}

/// Clipping left a ridge of some 1e-17 of an edge: estimates were off by 1e-2.
#[test]
fn vertices_in_the_plane_of_the_source_leave_no_edges() {
    for seed in [3073, 3241, 3247, 3457] {
        assert_eq!(complaints(seed), Vec::<String>::new());
    }
}

/// Unit squares, one above the other.
fn squares() -> [PlanarPolygon; 2] {
    let floor = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let ceiling = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
    [floor, ceiling].map(|corners| PlanarPolygon::new([corners]).expect("planar"))
}

/// The same, turned so that no edges are exactly parallel.
fn turned_squares() -> [PlanarPolygon; 2] {
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.4, 0.5);
    squares().map(|polygon| {
        let loops: Vec<Vec<DVec3>> = polygon.loops().map(|l| l.iter().map(|p| turn * *p).collect()).collect();
        PlanarPolygon::new(loops).expect("planar up to roundings")
    })
}

/// Of Hottel's squares: the closed form of contours, and cells.
#[test]
fn closed_forms_are_within_bounds() {
    for polygons in [squares(), turned_squares()] {
        let found = bounded(&Enclosure::new(polygons.into()), [0, 1], 1e-5);
        assert!((found.value - 0.199_824_895_698_387_4).abs() <= found.error_bound, "{found:?}");
        assert!(found.error_bound <= 1e-5, "{found:?}");
    }
}

#[test]
fn budgets_end_it_and_stops_return_nothing() {
    let enclosure = Enclosure::new(turned_squares().into());
    let few = Limits { per_pair: 5, ..Limits::default() };
    let found = enclosure.bounded_area_form_factor(0, 1, 1e-9, &few).expect("a tolerance").expect("no stop");
    assert!(found.evaluations <= 5 && found.error_bound > 1e-9, "{found:?}");
    assert!((found.value - 0.199_824_895_698_387_4).abs() <= found.error_bound, "{found:?}");
    let stopped = Limits { stop: &|| true, ..Limits::default() };
    assert_eq!(enclosure.bounded_area_form_factor(0, 1, 1e-9, &stopped), Ok(None));
    assert!(enclosure.bounded_area_form_factor(0, 1, 0.0, &few).is_err());
}
