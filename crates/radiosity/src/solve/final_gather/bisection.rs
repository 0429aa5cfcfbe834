//! Elements cut in halves across their longest edges, and the elements beside these with them.
//!
//! ```text
//!      c              c
//!     / \            /|\
//!    /   \    ->    / | \
//!   a-----b        a--m--b
//!    \   /          \ | /
//!     \ /            \|/
//!      d              d
//! ```
//! Where an element beside has a longer edge, it is cut across that first: then no vertex hangs on an edge that had none before, and no
//! angle becomes smaller than half of the smallest (Rivara 1984, "Algorithms for refining triangular grids", section 3; Rosenberg and
//! Stenger 1975). Edges of different patches at one place are one edge.
use crate::mesh::element::{Element, Mesh};
use glam::DVec3;
use std::collections::BTreeMap;

/// A mesh that is cut, edge by edge.
#[derive(Debug)]
pub(super) struct Bisection {
    pub(super) mesh: Mesh,
    /// For each element the one of the mesh before all cuts that it is a part of.
    pub(super) whole: Vec<usize>,
    /// For each vertex the number of its place.
    places: Vec<usize>,
    place_count: usize,
    /// The elements along the edge between two places.
    along: BTreeMap<[usize; 2], Vec<usize>>,
}

/// A vertex in the middle of what was an edge between two others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Middle {
    pub(super) vertex: usize,
    pub(super) ends: [usize; 2],
}

/// What cuts did.
#[derive(Debug, Default)]
pub(super) struct Cuts {
    /// The new vertices, in the order of their numbers.
    pub(super) middles: Vec<Middle>,
    /// For each new element, in the order of their numbers, the one that it was a half of.
    pub(super) halved: Vec<Halved>,
}

/// An element that was cut in halves: it is one of them now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Halved {
    pub(super) element: usize,
    /// The index in [`Cuts::middles`] of the vertex that both halves have.
    pub(super) middle: usize,
}

impl Bisection {
    /// A mesh that is yet to be cut.
    pub(super) fn of(mesh: &Mesh) -> Bisection {
        let mut numbers = BTreeMap::new();
        let mut number = |place: &DVec3| {
            let next = numbers.len();
            *numbers.entry(place.to_array().map(|coordinate| (coordinate + 0.0).to_bits())).or_insert(next)
        };
        let places = mesh.vertices.iter().map(&mut number).collect();
        let mut bisection = Bisection {
            mesh: mesh.clone(),
            whole: (0..mesh.elements.len()).collect(),
            places,
            place_count: numbers.len(),
            along: BTreeMap::new(),
        };
        // What has no area has edges beside themselves: it is not cut with others.
        for element in (0..mesh.elements.len()).filter(|element| mesh.area(*element) > 0.0) {
            for edge in bisection.edges(element) {
                bisection.along.entry(edge).or_default().push(element);
            }
        }
        bisection
    }

    /// Cuts an element that has an area across its longest edge.
    pub(super) fn halve(&mut self, element: usize, cuts: &mut Cuts) {
        let mut way = vec![self.longest(element)];
        while let Some(&edge) = way.last() {
            let longest = self.along[&edge].iter().map(|&beside| self.longest(beside));
            match longest.into_iter().find(|longest| *longest != edge) {
                Some(longer) => way.push(longer),
                None => {
                    self.cut(edge, cuts);
                    way.pop();
                }
            }
        }
    }

    /// The edge between two vertices, by their places.
    fn edge(&self, from: usize, to: usize) -> [usize; 2] {
        let (from, to) = (self.places[from], self.places[to]);
        [from.min(to), from.max(to)]
    }

    fn edges(&self, element: usize) -> [[usize; 2]; 3] {
        let [a, b, c] = self.mesh.elements[element].corners;
        [self.edge(a, b), self.edge(b, c), self.edge(c, a)]
    }

    /// The longest edge of an element; of equally long ones that with the highest places, whichever element asks.
    fn longest(&self, element: usize) -> [usize; 2] {
        let [a, b, c] = self.mesh.triangle(element);
        let lengths = [a - b, b - c, c - a].map(DVec3::length_squared);
        let longer = |one: (f64, [usize; 2]), other: (f64, [usize; 2])| {
            if one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)).is_lt() { other } else { one }
        };
        let [first, second, third] = self.edges(element);
        longer(longer((lengths[0], first), (lengths[1], second)), (lengths[2], third)).1
    }

    /// Cuts all elements along an edge.
    fn cut(&mut self, edge: [usize; 2], cuts: &mut Cuts) {
        let place = self.place_count;
        self.place_count += 1;
        let first = cuts.middles.len();
        for element in self.along.remove(&edge).unwrap_or_default() {
            let [a, b, c] = self.corners_from(element, edge);
            let ends = [a.min(b), a.max(b)];
            let known = cuts.middles[first..].iter().position(|middle| middle.ends == ends);
            let index = first + known.unwrap_or(cuts.middles.len() - first);
            if known.is_none() {
                let vertex = self.add(ends, place);
                cuts.middles.push(Middle { vertex, ends });
            }
            cuts.halved.push(Halved { element, middle: index });
            self.part(element, [a, b, c], cuts.middles[index].vertex);
        }
    }

    /// Adds the vertex between two others.
    fn add(&mut self, [a, b]: [usize; 2], place: usize) -> usize {
        self.mesh.vertices.push(self.mesh.vertices[a].midpoint(self.mesh.vertices[b]));
        self.places.push(place);
        self.places.len() - 1
    }

    /// Cuts one element with corners a, b and c from c to a vertex between a and b.
    fn part(&mut self, element: usize, [a, b, c]: [usize; 3], middle: usize) {
        let (patch, other) = (self.mesh.elements[element].patch, self.mesh.elements.len());
        self.mesh.elements[element].corners = [a, middle, c];
        self.mesh.elements.push(Element { patch, corners: [middle, b, c] });
        self.whole.push(self.whole[element]);
        let [near, far, between, behind] =
            [(a, middle), (middle, b), (middle, c), (b, c)].map(|(from, to)| self.edge(from, to));
        self.along.entry(near).or_default().push(element);
        self.along.entry(far).or_default().push(other);
        self.along.entry(between).or_default().extend([element, other]);
        if let Some(beside) =
            self.along.get_mut(&behind).and_then(|all| all.iter_mut().find(|at| **at == element))
        {
            *beside = other;
        }
    }

    /// The corners of an element, those on an edge first.
    fn corners_from(&self, element: usize, edge: [usize; 2]) -> [usize; 3] {
        let [a, b, c] = self.mesh.elements[element].corners;
        [[a, b, c], [b, c, a], [c, a, b]]
            .into_iter()
            .find(|[from, to, _]| self.edge(*from, *to) == edge)
            .expect("elements along an edge have it")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// A floor and a wall that meets it along an edge, each of 7 × 7 stretched cells in two triangles.
    fn corner() -> Mesh {
        let mut mesh = Mesh::default();
        for patch in 0..2 {
            let first = mesh.vertices.len();
            for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
                let [along, off] = [f64::from(i) * 0.3, f64::from(j * j)];
                mesh.vertices.push(if patch == 0 { [along, off, 0.0] } else { [along, 0.0, off] }.into());
            }
            for at in (0..56).filter(|at| at % 8 < 7).map(|at| first + at) {
                let halves = [[at, at + 8, at + 9], [at, at + 9, at + 1]];
                mesh.elements.extend(halves.map(|corners| Element { patch, corners }));
            }
        }
        mesh
    }

    /// The corner, and every third element of it cut, twice.
    fn cut() -> [Mesh; 2] {
        let mesh = corner();
        let (mut bisection, mut cuts) = (Bisection::of(&mesh), Cuts::default());
        for _ in 0..2 {
            let count = bisection.mesh.elements.len();
            (0..count).step_by(3).for_each(|element| bisection.halve(element, &mut cuts));
        }
        assert_eq!(mesh.vertices.len() + cuts.middles.len(), bisection.mesh.vertices.len());
        assert_eq!(mesh.elements.len() + cuts.halved.len(), bisection.mesh.elements.len());
        [mesh, bisection.mesh]
    }

    /// The smallest angle.
    fn narrowest(mesh: &Mesh) -> f64 {
        let angles = (0..mesh.elements.len()).flat_map(|element| {
            let [a, b, c] = mesh.triangle(element);
            [[a, b, c], [b, c, a], [c, a, b]].map(|[at, one, other]| (one - at).angle_between(other - at))
        });
        angles.fold(f64::INFINITY, f64::min)
    }

    /// The sides that one element of a patch has alone, and their length.
    fn rim(mesh: &Mesh) -> f64 {
        let sides = mesh
            .elements
            .iter()
            .flat_map(|Element { corners: [a, b, c], .. }| [[*a, *b], [*b, *c], [*c, *a]]);
        let sides: BTreeSet<[usize; 2]> = sides.collect();
        let rim = sides.iter().filter(|[from, to]| !sides.contains(&[*to, *from]));
        rim.map(|[from, to]| mesh.vertices[*from].distance(mesh.vertices[*to])).sum()
    }

    #[test]
    fn no_angle_is_halved_twice() {
        let [before, after] = cut();
        assert!(narrowest(&after) > 0.49 * narrowest(&before));
    }

    /// A vertex that hung on a side would make a rim inside of a patch.
    #[test]
    fn nothing_hangs_and_areas_stay() {
        let [before, after] = cut();
        assert!((rim(&after) / rim(&before) - 1.0).abs() < 1e-12);
        let [whole, parts] = [before, after]
            .map(|mesh| (0..mesh.elements.len()).map(|element| mesh.area(element)).sum::<f64>());
        assert!((whole / parts - 1.0).abs() < 1e-12);
    }
}
