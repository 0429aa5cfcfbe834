//! A failing case made small: as long as it fails, rings and vertices are dropped and coordinates rounded.
use crate::generators::Pair;
use glam::DVec2;

/// The bits of a mantissa that a rounded coordinate keeps, fewest first.
const BITS: [u32; 7] = [0, 1, 2, 4, 8, 16, 32];

/// A pair that still fails, and does so no more when any one ring or vertex is dropped or any one coordinate rounded. `pair`
/// itself must fail.
///
/// Greedy: O(n²) questions for n vertices in the worst case.
pub fn shrink(mut pair: Pair, fails: impl Fn(&Pair) -> bool) -> Pair {
    loop {
        let smaller = [without_ring, without_vertex, with_rounded].into_iter().find_map(|change| {
            let changed = (0..).map_while(|place| change(&pair, place));
            changed.flatten().find(|changed| fails(changed))
        });
        match smaller {
            Some(smaller) => pair = smaller,
            None => return pair,
        }
    }
}

/// A change at a place: none behind the last place, and nothing in it where it would change nothing.
type Change = Option<Option<Pair>>;

fn without_ring(pair: &Pair, place: usize) -> Change {
    let mut changed = pair.clone();
    let own = changed.a.rings.len();
    let (rings, place) =
        if place < own { (&mut changed.a.rings, place) } else { (&mut changed.b.rings, place - own) };
    if place >= rings.len() {
        return None;
    }
    rings.remove(place);
    Some(Some(changed))
}

fn without_vertex(pair: &Pair, place: usize) -> Change {
    let mut changed = pair.clone();
    let mut before = 0;
    let rings = changed.a.rings.iter_mut().chain(&mut changed.b.rings);
    let ring = rings.into_iter().find(|ring| {
        let is_here = place < before + ring.len();
        before += if is_here { 0 } else { ring.len() };
        is_here
    })?;
    ring.remove(place - before);
    Some(Some(changed))
}

/// Rounds one coordinate wherever it stands, so that what it has in common with others stays common.
fn with_rounded(pair: &Pair, place: usize) -> Change {
    let points = || pair.a.rings.iter().chain(&pair.b.rings).flatten();
    let mut values: Vec<f64> = points().flat_map(|p| p.to_array()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let (old, bits) = (*values.get(place / BITS.len())?, BITS[place % BITS.len()]);
    let new = rounded(old, bits);
    if digits(new) >= digits(old) {
        return Some(None);
    }
    let mut changed = pair.clone();
    for point in changed.a.rings.iter_mut().chain(&mut changed.b.rings).flatten() {
        *point = DVec2::from(point.to_array().map(|value| if value == old { new } else { value }));
    }
    Some(Some(changed))
}

/// The number with so many bits behind the leading one; with none, the nearest whole number.
fn rounded(value: f64, bits: u32) -> f64 {
    const MANTISSA: u32 = 52;
    if bits == 0 {
        return value.round();
    }
    f64::from_bits(value.to_bits() >> (MANTISSA - bits) << (MANTISSA - bits))
}

/// How long a number is when it is written.
fn digits(value: f64) -> usize {
    format!("{value:?}").len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::{Operand, Operation, Rule};
    use crate::random::Random;

    fn points(pair: &Pair) -> usize {
        pair.a.rings.iter().chain(&pair.b.rings).map(Vec::len).sum()
    }

    /// What fails when two operands have an area in common is two triangles in the end; of what any ring does, one vertex.
    #[test]
    fn what_is_left_is_what_fails() {
        let mut random = Random::new(1);
        let mut ring = || (0..9).map(|_| DVec2::new(random.unit(), random.unit())).collect::<Vec<_>>();
        let mut operand = || Operand { rings: vec![ring(), ring(), ring()], rule: Rule::EvenOdd };
        let pair = Pair { name: "noise".into(), a: operand(), b: operand() };
        let overlap = |pair: &Pair| {
            let arrangement = crate::oracle::Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
            arrangement.operation(Operation::Intersection).area() > num_rational::BigRational::default()
        };
        let small = shrink(pair.clone(), overlap);
        assert!(overlap(&small));
        assert_eq!(points(&small), 6, "{small:?}");
        let longest = small.a.rings.iter().flatten().flat_map(|p| p.to_array()).map(digits).max();
        assert!(longest < Some(8), "{small:?}");
        assert_eq!(points(&shrink(pair, |pair| points(pair) > 0)), 1);
    }
}
