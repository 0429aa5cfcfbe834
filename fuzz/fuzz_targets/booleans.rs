//! Lattice rings, some of them scaled by a fraction or moved by single ulps: every operation against the exact oracle,
//! found by boxes as by slabs, and the same beside far rings that lead every stage another way.
#![no_main]
use arbitrary::Arbitrary;
use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use polycsg::{Csg, FillRule, Scratch};
use tests::against::{check, check_boundary, csg, leaf, shapes};
use tests::company::{Company, without_company};
use tests::generators::Pair;
use tests::oracle::{Arrangement, Operand, Operation, Rule};

#[derive(Arbitrary, Debug)]
struct Input {
    size: u8,
    step: Step,
    rules: [u8; 2],
    company: u8,
    operands: [Vec<Vec<Corner>>; 2],
}

#[derive(Arbitrary, Debug, Clone, Copy)]
enum Step {
    One,
    Tenth,
    Tiny,
    Far,
}

#[derive(Arbitrary, Debug, Clone, Copy)]
struct Corner {
    x: u8,
    y: u8,
    /// Moves by an ulp: two bits for each coordinate, one move in four values.
    ulps: u8,
}

const MOST_CORNERS: usize = 30;

fuzz_target!(|input: Input| {
    let [a, b] = [0, 1].map(|i| operand(&input, i));
    let pair = Pair { name: String::new(), a, b };
    let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    let mut scratch = Scratch::default();
    for operation in Operation::ALL {
        if let Err(e) = check(&pair, operation, &arrangement) {
            panic!("{operation:?}: {e}\n{:?}\n{:?}", pair.a, pair.b);
        }
        let expression = csg(operation, leaf(&pair.a), leaf(&pair.b));
        let by_slabs = expression.evaluate_with(&mut polycsg::fuzzing::by_slabs());
        assert_eq!(by_slabs, expression.evaluate(), "{operation:?} by slabs\n{:?}\n{:?}", pair.a, pair.b);
        let is_asked = operation == Operation::ALL[usize::from(input.company % 4)];
        if let (true, Some(&company)) = (is_asked, Company::ALL.get(usize::from(input.company / 4 % 16))) {
            assert_alike(&expression, company, &pair);
        }
        if matches!(input.step, Step::One) {
            let boundary = expression.boundary(&mut scratch);
            if let Err(e) = check_boundary(boundary.edges(), &arrangement.operation(operation)) {
                panic!("boundary of {operation:?}: {e}\n{:?}\n{:?}", pair.a, pair.b);
            }
        }
    }
});

/// A region is the same beside far rings.
fn assert_alike(expression: &Csg<'_>, company: Company, pair: &Pair) {
    let points = pair.a.rings.iter().chain(&pair.b.rings).flatten();
    let size = points.map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let rings = company.rings(size).expect("there is room");
    let others = Csg::from_rings(&rings, FillRule::NonZero).expect("finite");
    let together = without_company(&(expression.clone() | others).evaluate(), size);
    assert_eq!(together, shapes(&expression.evaluate()), "beside {company:?}\n{:?}\n{:?}", pair.a, pair.b);
}

fn operand(input: &Input, index: usize) -> Operand {
    let mut left = MOST_CORNERS;
    let rings = input.operands[index].iter().map(|ring| {
        let ring = &ring[..ring.len().min(left)];
        left -= ring.len();
        ring.iter().map(|c| point(*c, input)).collect()
    });
    Operand { rings: rings.collect(), rule: Rule::ALL[usize::from(input.rules[index] % 3)] }
}

fn point(corner: Corner, input: &Input) -> DVec2 {
    let size = input.size % 8 + 2;
    let on_lattice = DVec2::new(f64::from(corner.x % size), f64::from(corner.y % size));
    match input.step {
        Step::One => on_lattice,
        Step::Tenth => moved(on_lattice * 0.1, corner.ulps),
        Step::Tiny => DVec2::new(on_lattice.x, moved(DVec2::splat(0.7), corner.ulps).y),
        Step::Far => on_lattice + 1e15,
    }
}

fn moved(p: DVec2, ulps: u8) -> DVec2 {
    let step = |value: f64, bits: u8| match bits & 3 {
        1 => value.next_up(),
        2 => value.next_down(),
        _ => value,
    };
    DVec2::new(step(p.x, ulps), step(p.y, ulps >> 2))
}
