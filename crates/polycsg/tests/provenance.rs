//! Each boundary edge names the operand and the edge that it lies on.

use polycsg::{Csg, DVec2, FillRule, Region, Scratch};
use proptest::prelude::*;

/// Rings of any size, empty ones too: edge numbers must count through all rings of an operand.
fn rings(most: usize) -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let point = (0..64i32, 0..64i32).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)));
    proptest::collection::vec(proptest::collection::vec(point, 0..7), 1..most)
}

/// Edge i starts in point i of all rings in a row.
fn edge(rings: &[Vec<DVec2>], edge: usize) -> [DVec2; 2] {
    let mut first = 0;
    for ring in rings {
        if edge < first + ring.len() {
            return [ring[edge - first], ring[(edge - first + 1) % ring.len()]];
        }
        first += ring.len();
    }
    panic!("there is no edge {edge}");
}

/// The distance of a point from a line.
fn off([a, b]: [DVec2; 2], p: DVec2) -> f64 {
    ((b - a).perp_dot(p - a) / (b - a).length()).abs()
}

fn check(operands: &[Vec<Vec<DVec2>>]) -> Result<(), TestCaseError> {
    let leaf = |rings: &Vec<Vec<DVec2>>| Csg::from_rings(rings, FillRule::EvenOdd).expect("finite");
    let (first, others) = operands.split_first().expect("an operand");
    let expressions = [
        Csg::union(operands.iter().map(leaf)),
        Csg::symmetric_difference(operands.iter().map(leaf)),
        leaf(first) - Csg::union(others.iter().map(leaf)),
    ];
    let mut scratch = Scratch::default();
    for expression in expressions {
        for piece in expression.boundary(&mut scratch).edges() {
            let source = edge(&operands[piece.operand], piece.edge);
            for p in [piece.start, piece.end] {
                prop_assert!(off(source, p) < 1e-13, "{p} lies off {source:?}");
                let (low, high) = (source[0].min(source[1]), source[0].max(source[1]));
                prop_assert!(p.cmpge(low).all() && p.cmple(high).all(), "{p} lies beyond {source:?}");
            }
            let along = (source[1] - source[0]).dot(piece.end - piece.start);
            prop_assert!(along != 0.0, "{piece:?} runs across {source:?}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn few_operands(operands in proptest::collection::vec(rings(4), 1..5)) {
        check(&operands)?;
    }

    /// More rings than keep their order in memory.
    #[test]
    fn many_rings(operands in proptest::collection::vec(rings(60), 3..5)) {
        check(&operands)?;
    }
}

/// Where no other operand is near, each operand's own edges come back, each once, under its own number.
#[test]
fn operands_apart_keep_all_their_edges() {
    let square = |i: usize| {
        let x = 3.0 * i as f64;
        Region::from_rings([[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]], FillRule::NonZero)
            .expect("finite")
    };
    let squares: Vec<Region> = (0..100).map(square).collect();
    let union = Csg::union(&squares);
    let mut scratch = Scratch::default();
    let mut found: Vec<_> = union.boundary(&mut scratch).edges().collect();
    found.sort_by_key(|edge| (edge.operand, edge.edge));
    let expected = (0..100).flat_map(|operand| (0..4).map(move |edge| (operand, edge)));
    assert!(found.iter().map(|edge| (edge.operand, edge.edge)).eq(expected));
    for edge in found {
        let ring = squares[edge.operand].rings().next().expect("a square");
        assert_eq!([edge.start, edge.end], [ring[edge.edge], ring[(edge.edge + 1) % 4]]);
    }
}
