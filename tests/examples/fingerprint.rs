//! Prints a fingerprint of the bits of all results of each family of inputs: two builds that print the same compute the
//! same. For changes that are to change no result.
//!
//! `cargo run --release -p tests --example fingerprint [-- INPUTS]`; 200 inputs of each nasty kind by default.
use formfactor::{
    DifferentialArea, Enclosure, FormFactor, Limits, PlanarPolygon, by_hierarchy, unoccluded,
    unoccluded_complement,
};
use polycsg::{Csg, DVec2, Region, Scratch, classify};
use tests::against::{csg, leaf};
use tests::corpus;
use tests::enclosures::surroundings;
use tests::generators::{KINDS, Pair, crowd, lattice, nasty};
use tests::oracle::Operation;
use tests::random::Random;
use tests::trees::Tree;

/// FNV-1a over words.
struct Fingerprint(u64);

impl Fingerprint {
    fn new() -> Fingerprint {
        Fingerprint(0xcbf2_9ce4_8422_2325)
    }

    fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23);
    }

    fn add_point(&mut self, point: DVec2) {
        self.add(point.x.to_bits());
        self.add(point.y.to_bits());
    }

    fn add_region(&mut self, region: &Region) {
        for polygon in region.polygons() {
            for ring in std::iter::once(polygon.outer()).chain(polygon.holes()) {
                self.add(ring.len() as u64);
                ring.iter().for_each(|&p| self.add_point(p));
            }
        }
        self.add(region.area().to_bits());
    }

    /// Its edges stand in no particular order, and of edges that coincide any is named.
    fn add_boundary(&mut self, expression: &Csg<'_>, scratch: &mut Scratch) {
        let mut sum = 0_u64;
        for edge in expression.boundary(scratch).edges() {
            let mut f = Fingerprint::new();
            f.add_point(edge.start);
            f.add_point(edge.end);
            sum = sum.wrapping_add(f.0);
        }
        self.add(sum);
    }

    /// All four operations on two operands, by either exit, and how a diagonal of the plane lies in the union.
    fn add_pair(&mut self, pair: &Pair, scratch: &mut Scratch) {
        for operation in Operation::ALL {
            let expression = csg(operation, leaf(&pair.a), leaf(&pair.b));
            let region = expression.evaluate_with(scratch);
            self.add_region(&region);
            self.add(scratch.repaired_vertices() as u64);
            self.add_boundary(&expression, scratch);
            let ends = [DVec2::new(-1.5, -2.0), DVec2::new(3.0, 4.25)];
            for interval in classify(ends, &region).expect("finite ends") {
                self.add_point(interval.start);
                self.add_point(interval.end);
                self.add(interval.membership as u64);
            }
        }
    }
}

fn crowds() -> u64 {
    let mut fingerprint = Fingerprint::new();
    let mut scratch = Scratch::default();
    for (seed, count) in [(1, 300), (2, 2000), (3, 8000)] {
        let rings = crowd(seed, count);
        let regions: Vec<Region> = rings
            .iter()
            .map(|r| Region::from_rings([r], polycsg::FillRule::NonZero).expect("finite coordinates"))
            .collect();
        for expression in [
            Csg::from_rings(&rings, polycsg::FillRule::EvenOdd).expect("finite coordinates"),
            Csg::union(&regions),
            Csg::symmetric_difference(&regions),
            Csg::union(&regions[..count / 2]) - Csg::union(&regions[count / 2..]),
        ] {
            fingerprint.add_region(&expression.evaluate_with(&mut scratch));
            fingerprint.add_boundary(&expression, &mut scratch);
        }
    }
    fingerprint.0
}

fn pairs(pairs: impl Iterator<Item = Pair>) -> u64 {
    let (mut fingerprint, mut scratch) = (Fingerprint::new(), Scratch::default());
    pairs.for_each(|pair| fingerprint.add_pair(&pair, &mut scratch));
    fingerprint.0
}

/// Random expressions of operands on lattices.
fn expressions(count: u64) -> u64 {
    let (mut fingerprint, mut scratch) = (Fingerprint::new(), Scratch::default());
    for seed in 0..count {
        let mut random = Random::new(seed);
        let operands: Vec<_> = (0..3)
            .flat_map(|i| {
                let pair = lattice(seed * 3 + i);
                [pair.a, pair.b]
            })
            .collect();
        let regions: Vec<Region> = operands.iter().map(tests::against::region).collect();
        let tree = Tree::grow(&mut |n| random.below(n), operands.len(), 3);
        fingerprint.add_region(&tree.csg(&operands, &regions).evaluate_with(&mut scratch));
    }
    fingerprint.0
}

/// The values and the bounds of point factors.
fn point_factors(count: u64) -> [u64; 2] {
    let (mut values, mut bounds) = (Fingerprint::new(), Fingerprint::new());
    let mut add = |factor: FormFactor| {
        values.add(factor.value.to_bits());
        bounds.add(factor.error_bound.to_bits());
    };
    for case in (0..count).map(surroundings) {
        let polygon = |loops: &tests::sweep::Loops| PlanarPolygon::new(loops).expect("a planar polygon");
        let polygons: Vec<PlanarPolygon> = case.polygons.iter().map(polygon).collect();
        let from = DifferentialArea::new(case.position, case.normal).expect("a direction");
        Enclosure::new(polygons.clone()).row(&from).into_iter().for_each(&mut add);
        for (id, to) in polygons.iter().enumerate() {
            let others = [&polygons[..id], &polygons[id + 1..]].concat();
            add(formfactor::form_factor(&from, to, &others));
            add(by_hierarchy(&from, to, &others));
            add(unoccluded(&from, to));
            add(unoccluded_complement(&from, to));
        }
    }
    [values.0, bounds.0]
}

/// The values and the error estimates of area factors.
fn area_factors(count: u64) -> [u64; 2] {
    let (mut values, mut errors) = (Fingerprint::new(), Fingerprint::new());
    for case in (0..count).map(surroundings) {
        let polygon = |loops: &tests::sweep::Loops| PlanarPolygon::new(loops).expect("a planar polygon");
        let enclosure = Enclosure::new(case.polygons.iter().take(5).map(polygon).collect());
        for from in 0..enclosure.polygons().len() {
            for to in 0..enclosure.polygons().len() {
                if let Ok(Some(factor)) = enclosure.area_form_factor(from, to, 1e-2, &Limits::default()) {
                    values.add(factor.value.to_bits());
                    errors.add(factor.error_estimate.to_bits());
                }
            }
        }
    }
    [values.0, errors.0]
}

#[expect(clippy::print_stdout, reason = "the fingerprints are this program's output")]
fn main() -> Result<(), String> {
    let inputs: u64 = match std::env::args().nth(1) {
        None => 200,
        Some(text) => text.parse().map_err(|e| format!("{text} is no number of inputs: {e}"))?,
    };
    println!("{:016x} corpus", pairs(corpus::read()?.into_iter().map(|case| case.pair)));
    println!("{:016x} lattices", pairs((0..20 * inputs).map(lattice)));
    for (kind, about) in KINDS.iter().enumerate() {
        println!("{:016x} {}", pairs((0..inputs).map(|seed| nasty(kind, seed))), about.0);
    }
    println!("{:016x} expressions", expressions(20 * inputs));
    println!("{:016x} crowds", crowds());
    let [values, bounds] = point_factors(10 * inputs);
    println!("{values:016x} point factors\n{bounds:016x} their bounds");
    let [values, errors] = area_factors(inputs.div_ceil(8));
    println!("{values:016x} area factors\n{errors:016x} their errors");
    Ok(())
}
