//! Every edge cut at its contacts with all others.
use crate::exact::Exact;
use num_bigint::BigInt;
use num_rational::BigRational;
use std::cmp::Ordering;

/// An input edge of two distinct points, in grid steps.
pub(super) struct Edge<T> {
    pub(super) operand: usize,
    pub(super) number: usize,
    pub(super) start: [T; 2],
    pub(super) end: [T; 2],
    /// End minus start.
    pub(super) span: [T; 2],
}

impl<T: Exact> Edge<T> {
    pub(super) fn new(operand: usize, number: usize, start: [T; 2], end: [T; 2]) -> Edge<T> {
        let span = minus(&end, &start);
        Edge { operand, number, start, end, span }
    }
}

/// The point (x/w, y/w), with w > 0.
#[derive(Clone, Debug)]
pub(super) struct Homogeneous<T> {
    pub(super) x: T,
    pub(super) y: T,
    pub(super) w: T,
}

impl<T: Exact> Homogeneous<T> {
    /// The point of an edge at parameter `at`.
    fn on(edge: &Edge<T>, at: &Parameter<T>) -> Homogeneous<T> {
        let along = |axis: usize| {
            edge.start[axis].clone() * at.denominator.clone() + at.numerator.clone() * edge.span[axis].clone()
        };
        Homogeneous { x: along(0), y: along(1), w: at.denominator.clone() }
    }

    /// True when this is the given grid point.
    pub(super) fn is(&self, point: &[T; 2]) -> bool {
        self.x == point[0].clone() * self.w.clone() && self.y == point[1].clone() * self.w.clone()
    }

    fn order(&self, other: &Homogeneous<T>) -> Ordering {
        let across = |a: &T, b: &T| (a.clone() * other.w.clone()).cmp(&(b.clone() * self.w.clone()));
        across(&self.x, &other.x).then_with(|| across(&self.y, &other.y))
    }
}

/// Where on an edge: numerator / denominator in [0, 1], the denominator positive.
#[derive(Clone)]
struct Parameter<T> {
    numerator: T,
    denominator: T,
}

impl<T: Exact> Parameter<T> {
    fn new(numerator: T, denominator: T) -> Parameter<T> {
        if denominator.is_negative() {
            Parameter { numerator: -numerator, denominator: -denominator }
        } else {
            Parameter { numerator, denominator }
        }
    }

    fn is_on_edge(&self) -> bool {
        !self.numerator.is_negative() && self.numerator <= self.denominator
    }

    fn order(&self, other: &Parameter<T>) -> Ordering {
        let (here, there) = (self.numerator.clone(), other.numerator.clone());
        (here * other.denominator.clone()).cmp(&(there * self.denominator.clone()))
    }

    fn middle(&self, other: &Parameter<T>) -> Parameter<T> {
        let (a, b) = (self.numerator.clone(), other.numerator.clone());
        let (c, d) = (self.denominator.clone(), other.denominator.clone());
        Parameter { numerator: a * d.clone() + b * c.clone(), denominator: T::from(2) * c * d }
    }

    fn ratio(&self) -> BigRational {
        BigRational::new(self.numerator.clone().into(), self.denominator.clone().into())
    }
}

/// A piece of an edge between neighbouring contacts.
pub(super) struct Piece<T> {
    pub(super) edge: usize,
    pub(super) ends: [usize; 2],
    pub(super) middle: Homogeneous<T>,
    pub(super) twice_area: BigRational,
}

/// Distinct contacts in lexicographic order, and the pieces between them in the edges' order.
pub(super) fn cut<T: Exact>(edges: &[Edge<T>]) -> (Vec<Homogeneous<T>>, Vec<Piece<T>>) {
    let (mut points, mut pieces) = (Vec::new(), Vec::new());
    for (index, edge) in edges.iter().enumerate() {
        let contacts = contacts_along(index, edges);
        let moment: BigInt = cross(&edge.start, &edge.span).into();
        for pair in contacts.windows(2) {
            let ends = [points.len(), points.len() + 1];
            points.extend(pair.iter().map(|at| Homogeneous::on(edge, at)));
            let twice_area = (pair[1].ratio() - pair[0].ratio()) * moment.clone();
            pieces.push(Piece {
                edge: index,
                ends,
                middle: Homogeneous::on(edge, &pair[0].middle(&pair[1])),
                twice_area,
            });
        }
    }
    (unify(points, &mut pieces), pieces)
}

/// Sorted distinct parameters of all contacts on an edge, its ends included.
fn contacts_along<T: Exact>(index: usize, edges: &[Edge<T>]) -> Vec<Parameter<T>> {
    let edge = &edges[index];
    let mut found = vec![Parameter::new(T::zero(), T::one()), Parameter::new(T::one(), T::one())];
    for (other_index, other) in edges.iter().enumerate() {
        if other_index != index {
            contacts(edge, other, &mut found);
        }
    }
    found.sort_by(Parameter::order);
    found.dedup_by(|a, b| a.order(b) == Ordering::Equal);
    found
}

/// Parameters on `edge` of its contacts with `other`: none, one, or the ends of an overlap.
fn contacts<T: Exact>(edge: &Edge<T>, other: &Edge<T>, found: &mut Vec<Parameter<T>>) {
    let offset = minus(&other.start, &edge.start);
    let denominator = cross(&edge.span, &other.span);
    if !denominator.is_zero() {
        let here = Parameter::new(cross(&offset, &other.span), denominator.clone());
        let there = Parameter::new(cross(&offset, &edge.span), denominator);
        if here.is_on_edge() && there.is_on_edge() {
            found.push(here);
        }
    } else if cross(&offset, &edge.span).is_zero() {
        let square = dot(&edge.span, &edge.span);
        for end in [&other.start, &other.end] {
            let at = Parameter::new(dot(&minus(end, &edge.start), &edge.span), square.clone());
            if at.is_on_edge() {
                found.push(at);
            }
        }
    }
}

/// Sorts the points, keeps one of each, and renames the pieces' ends.
fn unify<T: Exact>(points: Vec<Homogeneous<T>>, pieces: &mut [Piece<T>]) -> Vec<Homogeneous<T>> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| points[a].order(&points[b]));
    let mut names = vec![0; points.len()];
    let mut distinct: Vec<Homogeneous<T>> = Vec::new();
    for index in order {
        if distinct.last().is_none_or(|last| last.order(&points[index]) != Ordering::Equal) {
            distinct.push(points[index].clone());
        }
        names[index] = distinct.len() - 1;
    }
    for piece in pieces {
        piece.ends = piece.ends.map(|end| names[end]);
    }
    distinct
}

/// For each edge, a number for its direction and one for the opposite: equal exactly for equal directions.
pub(super) fn direction_classes<T: Exact>(edges: &[Edge<T>]) -> Vec<[usize; 2]> {
    let mut known: Vec<&Edge<T>> = Vec::new();
    let mut classes = Vec::with_capacity(edges.len());
    for edge in edges {
        let parallel = known.iter().position(|k| cross(&k.span, &edge.span).is_zero());
        let index = parallel.unwrap_or(known.len());
        if parallel.is_none() {
            known.push(edge);
        }
        let along = [2 * index, 2 * index + 1];
        let is_same = dot(&known[index].span, &edge.span).is_positive();
        classes.push(if is_same { along } else { [along[1], along[0]] });
    }
    classes
}

pub(super) fn cross<T: Exact>(a: &[T; 2], b: &[T; 2]) -> T {
    a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone()
}

pub(super) fn dot<T: Exact>(a: &[T; 2], b: &[T; 2]) -> T {
    a[0].clone() * b[0].clone() + a[1].clone() * b[1].clone()
}

fn minus<T: Exact>(a: &[T; 2], b: &[T; 2]) -> [T; 2] {
    [a[0].clone() - b[0].clone(), a[1].clone() - b[1].clone()]
}
