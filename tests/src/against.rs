//! A result of `polycsg` beside the oracle's, bit for bit where nothing had to be repaired.
use crate::exact::{edges, twice_signed_area};
use crate::generators::Pair;
use crate::oracle::{Arrangement, Class, Operand, Operation, Outline, Place, Rule, locate, sort};
use crate::validity::{self, Shape, is_bounding};
use glam::DVec2;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Signed;
use polycsg::{BoundaryEdge, Csg, FillRule, Location, Membership, Region};

/// The library's name of a rule.
pub fn fill_rule(rule: Rule) -> FillRule {
    match rule {
        Rule::EvenOdd => FillRule::EvenOdd,
        Rule::NonZero => FillRule::NonZero,
        Rule::Positive => FillRule::Positive,
    }
}

/// The oracle's name of a membership.
pub fn class(membership: Membership) -> Class {
    match membership {
        Membership::In => Class::In,
        Membership::Out => Class::Out,
        Membership::OnPlus => Class::OnPlus,
        Membership::OnMinus => Class::OnMinus,
    }
}

/// An operand as a leaf; its coordinates must be finite.
pub fn leaf(operand: &Operand) -> Csg<'static> {
    Csg::from_rings(&operand.rings, fill_rule(operand.rule)).expect("generated coordinates are finite")
}

/// An operand as a region; its coordinates must be finite.
pub fn region(operand: &Operand) -> Region {
    Region::from_rings(&operand.rings, fill_rule(operand.rule)).expect("generated coordinates are finite")
}

/// A region as an operand: its rings, read by the strictest rule.
pub fn operand(region: &Region) -> Operand {
    Operand { rings: region.rings().map(<[DVec2]>::to_vec).collect(), rule: Rule::Positive }
}

/// The expression of one operation on two leaves.
pub fn csg<'a>(operation: Operation, a: Csg<'a>, b: Csg<'a>) -> Csg<'a> {
    match operation {
        Operation::Union => a | b,
        Operation::Intersection => a & b,
        Operation::Difference => a - b,
        Operation::SymmetricDifference => a ^ b,
    }
}

/// The operation on two regions.
pub fn operate(operation: Operation, a: &Region, b: &Region) -> Region {
    match operation {
        Operation::Union => a.union(b),
        Operation::Intersection => a.intersection(b),
        Operation::Difference => a.difference(b),
        Operation::SymmetricDifference => a.symmetric_difference(b),
    }
}

/// A region's polygons for the validity check.
pub fn shapes(region: &Region) -> Vec<Shape> {
    let shape = |p: polycsg::Polygon<'_>| Shape {
        outer: p.outer().to_vec(),
        holes: p.holes().map(<[DVec2]>::to_vec).collect(),
        depth: p.depth(),
    };
    region.polygons().map(shape).collect()
}

/// Twice a region's exact area.
pub fn twice_area(region: &Region) -> BigRational {
    twice_signed_area(region.rings())
}

/// A region's edges in lexicographic order.
pub fn sorted_edges(region: &Region) -> Vec<[DVec2; 2]> {
    let mut segments: Vec<[DVec2; 2]> = region.rings().flat_map(edges).map(|(a, b)| [a, b]).collect();
    sort(&mut segments);
    segments
}

/// What an operation on a pair showed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The rounded boundary met itself nowhere, and the region is it, bit for bit.
    Exact,
    /// Rounding made the boundary meet itself: the region is valid and its area within the rounding's reach.
    Repaired,
}

/// Evaluates one operation on a pair and checks everything that the oracle knows about it.
pub fn check(pair: &Pair, operation: Operation, arrangement: &Arrangement) -> Result<Verdict, String> {
    let outline = arrangement.operation(operation);
    let result = csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate();
    let verdict = check_region(&result, &outline)?;
    if verdict == Verdict::Repaired {
        let operands = [pair.a.clone(), pair.b.clone()];
        check_set(&result, &operands, |classes| operation.of(classes[0], classes[1]))?;
        check_vertices(&result, &outline)?;
    }
    Ok(verdict)
}

/// Checks that a repaired region's vertices are the outline's, bit for bit, or cuts at the abscissa of one of them: an
/// input vertex is kept as it is or vanishes with what rounding closed, and is moved never.
fn check_vertices(region: &Region, outline: &Outline<'_>) -> Result<(), String> {
    let mut ids: Vec<usize> = outline.pieces.iter().flat_map(|p| p.ends).collect();
    ids.sort_unstable();
    ids.dedup();
    let known: Vec<DVec2> = ids.into_iter().map(|v| outline.vertex(v).point).collect();
    let is_cut = |p: DVec2| known.iter().any(|v| v.x == p.x);
    match region.rings().flatten().find(|&&p| !known.contains(&p) && !is_cut(p)) {
        Some(new) => Err(format!("{new} is no vertex of the exact set and no cut above or below one")),
        None => Ok(()),
    }
}

/// Checks a region against the exact outline that it stands for.
pub fn check_region(region: &Region, outline: &Outline<'_>) -> Result<Verdict, String> {
    validity::check(&shapes(region)).map_err(|e| format!("invalid: {e}"))?;
    let merged = outline.merged();
    if is_bounding(&merged) {
        let found = sorted_edges(region);
        return if found == merged { Ok(Verdict::Exact) } else { Err(difference(&found, &merged)) };
    }
    check_area(region, outline)?;
    Ok(Verdict::Repaired)
}

fn check_area(region: &Region, outline: &Outline<'_>) -> Result<(), String> {
    let error = (twice_area(region) - &outline.twice_area).abs() / BigInt::from(2);
    let reach = outline.area_of_one_ulp();
    if error > reach { Err(format!("area off by {error}, rounding reaches {reach}")) } else { Ok(()) }
}

/// The exact area between a region and the set that `combine` makes of the operands, and how much of it rounding each
/// vertex explains. What is lost, added or misplaced counts, however small the sum of all is.
pub fn area_between(
    region: &Region,
    operands: &[Operand],
    combine: impl Fn(&[Class]) -> Class,
) -> [BigRational; 2] {
    let all: Vec<Operand> = operands.iter().cloned().chain([operand(region)]).collect();
    let arrangement = Arrangement::of(&all);
    let given = |classes: &[Class]| combine(&classes[..operands.len()]);
    let between = arrangement.outline(|classes| given(classes).symmetric_difference(classes[operands.len()]));
    [between.area(), arrangement.outline(given).area_of_one_ulp()]
}

/// Checks that a region is the set that `combine` makes of the operands, but for what rounding its vertices can move.
pub fn check_set(
    region: &Region,
    operands: &[Operand],
    combine: impl Fn(&[Class]) -> Class,
) -> Result<(), String> {
    let [between, reach] = area_between(region, operands, combine);
    if between > reach {
        Err(format!("{between} lies between it and the exact set, rounding reaches {reach}"))
    } else {
        Ok(())
    }
}

fn difference(found: &[[DVec2; 2]], expected: &[[DVec2; 2]]) -> String {
    let only = |a: &[[DVec2; 2]], b: &[[DVec2; 2]]| {
        a.iter()
            .filter(|s| !b.contains(s))
            .map(|s| format!("{} -> {}", s[0], s[1]))
            .collect::<Vec<_>>()
            .join(", ")
    };
    format!(
        "edges differ; only in the result: {}; only in the oracle's: {}",
        only(found, expected),
        only(expected, found)
    )
}

/// Checks that boundary edges are the outline's pieces, each once, by operand, edge and rounded ends.
///
/// A boundary edge may run straight through any number of crossings; of coincident edges any may stand for all.
pub fn check_boundary(
    found: impl IntoIterator<Item = BoundaryEdge>,
    outline: &Outline<'_>,
) -> Result<(), String> {
    let starts = outline.starts();
    let mut uses = vec![0; outline.pieces.len()];
    for edge in found {
        let path = path(&edge, outline, &starts).ok_or_else(|| format!("no pieces make up {edge:?}"))?;
        path.into_iter().for_each(|index| uses[index] += 1);
    }
    let length_is_lost = |i: usize| {
        let [a, b] = outline.pieces[i].ends.map(|v| outline.vertex(v).point);
        a == b
    };
    match (0..uses.len()).find(|&i| uses[i] > 1 || (uses[i] == 0 && !length_is_lost(i))) {
        Some(i) => Err(format!(
            "piece {} -> {} is covered {} times",
            outline.vertex(outline.pieces[i].ends[0]).point,
            outline.vertex(outline.pieces[i].ends[1]).point,
            uses[i]
        )),
        None => Ok(()),
    }
}

/// The pieces along one input edge from the boundary edge's start to its end.
fn path(edge: &BoundaryEdge, outline: &Outline<'_>, starts: &[Vec<usize>]) -> Option<Vec<usize>> {
    let mut sub_edges = outline.arrangement.sub_edges.iter();
    let directions = sub_edges.find(|s| (s.operand, s.edge) == (edge.operand, edge.edge))?.directions;
    let begins = (0..starts.len()).filter(|&v| outline.vertex(v).point == edge.start);
    begins.flat_map(|v| directions.map(|d| (v, d))).find_map(|(v, d)| walk(v, d, edge.end, outline, starts))
}

fn walk(
    mut vertex: usize,
    direction: usize,
    end: DVec2,
    outline: &Outline<'_>,
    starts: &[Vec<usize>],
) -> Option<Vec<usize>> {
    let mut path = Vec::new();
    while path.is_empty() || outline.vertex(vertex).point != end {
        let next = *starts[vertex].iter().find(|&&i| outline.pieces[i].direction == direction)?;
        path.push(next);
        vertex = outline.pieces[next].ends[1];
    }
    Some(path)
}

/// Checks `polycsg::classify` of a segment against the oracle's classes of its pieces.
pub fn check_classify(segment: [DVec2; 2], region: &Region) -> Result<(), String> {
    let [p, q] = segment;
    // There and back twice: rings of fewer edges are no input. Only the first edge is read.
    let line = Operand { rings: vec![vec![p, q, p, q]], rule: Rule::EvenOdd };
    let arrangement = Arrangement::of(&[line, operand(region)]);
    let pieces = arrangement.sub_edges.iter().filter(|s| (s.operand, s.edge) == (0, 0));
    let expected = joined(pieces.map(|s| (s.ends.map(|v| arrangement.vertices[v].point), s.classes[1])));
    let intervals = polycsg::classify(segment, region).map_err(|e| e.to_string())?;
    let found = joined(intervals.iter().map(|i| ([i.start, i.end], class(i.membership))));
    if found == expected { Ok(()) } else { Err(format!("classify found {found:?}, the oracle {expected:?}")) }
}

/// Checks `Region::locate` against the winding number of the region's rings.
pub fn check_locate(point: DVec2, region: &Region) -> Result<(), String> {
    let expected = match locate(point, &operand(region)) {
        Place::Inside => Location::Inside,
        Place::Outside => Location::Outside,
        Place::OnEdge => Location::Boundary,
    };
    let found = region.locate(point);
    if found == expected {
        Ok(())
    } else {
        Err(format!("{point} was located {found:?}, the oracle says {expected:?}"))
    }
}

/// Neighbouring intervals of one class made one.
fn joined(intervals: impl Iterator<Item = ([DVec2; 2], Class)>) -> Vec<([DVec2; 2], Class)> {
    let mut joined: Vec<([DVec2; 2], Class)> = Vec::new();
    for (ends, class) in intervals {
        match joined.last_mut() {
            Some(last) if last.1 == class => last.0[1] = ends[1],
            _ => joined.push((ends, class)),
        }
    }
    joined
}
