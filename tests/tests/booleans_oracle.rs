//! `polycsg` against the oracle on random lattice rings with self-intersections: equal memberships, equal boundaries,
//! equal areas, equal regions.
use glam::DVec2;
use polycsg::Scratch;
use tests::against::{self, Verdict, check_boundary, check_classify, csg, leaf};
use tests::exact::ratio;
use tests::generators::{Pair, lattice};
use tests::oracle::{Arrangement, Class, Operand, Operation, Outline};
use tests::random::Random;

/// A Boolean of any number of classes.
type Combine = fn(&[Class]) -> Class;

const INPUTS: u64 = 10_000;

/// Runs a check over seeds on two threads and reports the first failures together.
fn for_seeds(seeds: std::ops::Range<u64>, check: impl Fn(u64) -> Result<(), String> + Sync) {
    let middle = u64::midpoint(seeds.start, seeds.end);
    let half =
        |range: std::ops::Range<u64>| range.filter_map(|seed| check(seed).err()).take(5).collect::<Vec<_>>();
    let failures = std::thread::scope(|scope| {
        let first = scope.spawn(|| half(seeds.start..middle));
        let mut failures = half(middle..seeds.end);
        failures.extend(first.join().expect("the check itself does not panic"));
        failures
    });
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn regions_and_boundaries_are_the_oracles_bit_for_bit() {
    for_seeds(0..INPUTS, |seed| {
        let pair = lattice(seed);
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        let mut scratch = Scratch::default();
        for operation in Operation::ALL {
            let outline = arrangement.operation(operation);
            let checked = check_region(&pair, operation, &arrangement)
                .and_then(|()| check_pieces(&pair, operation, &outline, &mut scratch));
            checked.map_err(|e| format!("{} {operation:?}: {e}\n{:?}\n{:?}", pair.name, pair.a, pair.b))?;
        }
        Ok(())
    });
}

fn check_region(pair: &Pair, operation: Operation, arrangement: &Arrangement) -> Result<(), String> {
    match against::check(pair, operation, arrangement)? {
        Verdict::Exact => Ok(()),
        Verdict::Repaired => Err("a lattice needs no repair".into()),
    }
}

fn check_pieces(
    pair: &Pair,
    operation: Operation,
    outline: &Outline<'_>,
    scratch: &mut Scratch,
) -> Result<(), String> {
    let expression = csg(operation, leaf(&pair.a), leaf(&pair.b));
    let boundary = expression.boundary(scratch);
    check_boundary(boundary.edges(), outline)?;
    check_area_of(boundary.area(), outline)
}

/// A boundary's area is summed in doubles from vertices rounded once.
fn check_area_of(area: f64, outline: &Outline<'_>) -> Result<(), String> {
    let error = ratio(area) - outline.area();
    let reach = outline.area_of_one_ulp() * ratio(2.0);
    if error <= reach && -error.clone() <= reach {
        Ok(())
    } else {
        Err(format!("area {area} is off by {error}"))
    }
}

#[test]
fn nary_expressions_are_one_arrangement() {
    for_seeds(0..2_000, |seed| {
        let pairs = [lattice(2 * seed), lattice(2 * seed + 1)];
        let operands: Vec<Operand> = pairs.iter().flat_map(|p| [p.a.clone(), p.b.clone()]).collect();
        let arrangement = Arrangement::of(&operands);
        let leaves = || operands.iter().map(leaf);
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| leaf(&operands[i]));
        let cases: [(&str, polycsg::Csg<'_>, Combine); 4] = [
            ("union of four", polycsg::Csg::union(leaves()), |c| {
                c.iter().fold(Class::Out, |s, &x| s.union(x))
            }),
            ("intersection of four", polycsg::Csg::intersection(leaves()), |c| {
                c.iter().fold(Class::In, |s, &x| s.intersection(x))
            }),
            ("odd number of four", polycsg::Csg::symmetric_difference(leaves()), |c| {
                c.iter().fold(Class::Out, |s, &x| s.symmetric_difference(x))
            }),
            ("(a - b) ^ (c & d)", (a - b) ^ (c & d), |c| {
                c[0].difference(c[1]).symmetric_difference(c[2].intersection(c[3]))
            }),
        ];
        for (name, expression, combine) in cases {
            let outline = arrangement.outline(combine);
            let found = against::check_region(&expression.evaluate(), &outline);
            found.map_err(|e| format!("{name} of lattices {} and {}: {e}", 2 * seed, 2 * seed + 1))?;
        }
        Ok(())
    });
}

#[test]
fn segments_are_classified_as_the_oracle_does() {
    for_seeds(0..INPUTS, |seed| {
        let pair = lattice(seed);
        let region = against::region(&pair.a);
        let mut random = Random::new(seed);
        for _ in 0..2 {
            let mut point = || DVec2::new(f64::from(random.between(-1, 8)), f64::from(random.between(-1, 8)));
            let segment = [point(), point()];
            if segment[0] != segment[1] {
                check_classify(segment, &region).map_err(|e| format!("{} {segment:?}: {e}", pair.name))?;
            }
        }
        Ok(())
    });
}
