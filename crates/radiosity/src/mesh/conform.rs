//! Elements cut until no vertex hangs in the middle of a side: neighbours then share the ends of all sides, and pictures have no cracks.
//!
//! ```text
//! +-------+---+        +-------+---+
//! |     / |   |        |     / |   |     the other patch has a vertex in the middle of a side:
//! |   /   +---+   ->   |   / --+---+     the element is cut there, and its values are interpolated
//! | /     |   |        | /-----|   |
//! +-------+---+        +-------+---+
//! ```
use super::element::{Element, Mesh};
use crate::coplanar::SINGLE;
use crate::extent::{BoxTree, Extent};
use glam::DVec3;

/// Rounding parts places by less than this share of what single precision can tell.
const ROUNDING: f64 = 1e-5;

/// A mesh in which no vertex hangs, and where its elements and vertices are from.
#[derive(Debug)]
pub(crate) struct Conforming {
    /// The vertices as they were, then those in the middle of sides.
    pub(crate) mesh: Mesh,
    /// The element that each is a part of.
    owners: Vec<usize>,
    /// The ends of the side that each new vertex is on, and how far along it is.
    between: Vec<([usize; 2], f64)>,
}

impl Conforming {
    /// O(n log n).
    pub(crate) fn of(mesh: &Mesh) -> Conforming {
        let rim = rim(mesh);
        let vertices = welded(mesh, &rim);
        let places = RimPlaces::new(rim.iter().map(|side| vertices[side[0]]));
        let whole = Mesh { vertices, elements: Vec::new() };
        let mut whole = Conforming { mesh: whole, owners: Vec::new(), between: Vec::new() };
        for (owner, element) in mesh.elements.iter().enumerate() {
            let hanging = sides(element.corners).map(|side| match rim.binary_search(&side) {
                Ok(_) => whole.hang(&places, side),
                Err(_) => Vec::new(),
            });
            whole.cut(owner, *element, hanging);
        }
        whole
    }

    /// The values at the vertices, vertices × `width`: in the middle of a side they are interpolated.
    pub(crate) fn at_vertices(&self, mut values: Vec<f64>, width: usize) -> Vec<f64> {
        for (ends, along) in &self.between {
            let [start, end] = ends.map(|end| end * width);
            for k in 0..width {
                values.push(values[start + k] + along * (values[end + k] - values[start + k]));
            }
        }
        values
    }

    /// The values of the elements, elements × `width`: parts have those of the whole.
    pub(crate) fn on_elements<T: Copy>(&self, values: &[T], width: usize) -> Vec<T> {
        self.owners.iter().flat_map(|owner| &values[owner * width..][..width]).copied().collect()
    }

    /// Adds vertices where places are in the middle of a side, in order.
    fn hang(&mut self, places: &RimPlaces, [start, end]: [usize; 2]) -> Vec<usize> {
        let hanging = places.inside([start, end].map(|vertex| self.mesh.vertices[vertex]));
        let first = self.mesh.vertices.len();
        for (along, place) in hanging {
            self.mesh.vertices.push(place);
            self.between.push(([start, end], along));
        }
        (first..self.mesh.vertices.len()).collect()
    }

    /// Adds an element in parts: it is halved in the middle of its longest side on which something hangs, and so on.
    fn cut(&mut self, owner: usize, Element { patch, corners }: Element, mut hanging: [Vec<usize>; 3]) {
        let length = |side: usize| {
            let [start, end] = sides(corners)[side].map(|vertex| self.mesh.vertices[vertex]);
            start.distance(end)
        };
        let open = (0..3).filter(|&side| !hanging[side].is_empty());
        let Some(longest) = open.max_by(|&a, &b| length(a).total_cmp(&length(b))) else {
            self.mesh.elements.push(Element { patch, corners });
            self.owners.push(owner);
            return;
        };
        let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
        hanging.rotate_left(longest);
        let [mut before, bc, ca] = hanging;
        let mut after = before.split_off(before.len() / 2);
        let middle = after.remove(0);
        self.cut(owner, Element { patch, corners: [a, middle, c] }, [before, Vec::new(), ca]);
        self.cut(owner, Element { patch, corners: [middle, b, c] }, [after, bc, Vec::new()]);
    }
}

/// The places of the vertices on the rim, each once, to be found.
struct RimPlaces {
    places: Vec<DVec3>,
    tree: BoxTree,
    /// What is nearer than single precision can tell is in one place.
    near: f64,
}

impl RimPlaces {
    fn new(places: impl Iterator<Item = DVec3>) -> RimPlaces {
        let mut places: Vec<DVec3> = places.collect();
        let key = |place: &DVec3| place.to_array().map(|ordinate| (ordinate + 0.0).to_bits());
        places.sort_by_key(key);
        places.dedup_by_key(|place| key(place));
        let tree = BoxTree::new(places.iter().map(|&place| Extent { low: place, high: place }));
        let near = SINGLE * Extent::holding(&places).diagonal();
        RimPlaces { places, tree, near }
    }

    /// What is in one place but for rounding is where the first of it is.
    fn first(&self, place: DVec3) -> DVec3 {
        let around = Extent { low: place, high: place }.grown(ROUNDING * self.near);
        let here = self.tree.meeting(&around).into_iter().map(|index| self.places[index]);
        here.fold(place, |first, other| if other.to_array() < first.to_array() { other } else { first })
    }

    /// The places in the middle of a side, in order, each with how far along it is.
    fn inside(&self, [start, end]: [DVec3; 2]) -> Vec<(f64, DVec3)> {
        let (way, margin) = (end - start, self.near / start.distance(end));
        let around = Extent::holding(&[start, end]).grown(self.near);
        let on_side = |index: usize| {
            let place = self.places[index];
            let along = (place - start).dot(way) / way.length_squared();
            let is_inside = along > margin && along < 1.0 - margin;
            (is_inside && place.distance(start + along * way) <= self.near).then_some((along, place))
        };
        let mut inside: Vec<_> = self.tree.meeting(&around).into_iter().filter_map(on_side).collect();
        inside.sort_by(|a, b| a.0.total_cmp(&b.0));
        inside.dedup_by(|next, last| next.0 - last.0 <= margin);
        inside
    }
}

/// The vertices; those of the rim that rounding alone parts are in one place.
fn welded(mesh: &Mesh, rim: &[[usize; 2]]) -> Vec<DVec3> {
    let mut vertices = mesh.vertices.clone();
    let places = RimPlaces::new(rim.iter().map(|side| vertices[side[0]]));
    rim.iter().for_each(|side| vertices[side[0]] = places.first(mesh.vertices[side[0]]));
    vertices
}

/// The sides of a triangle.
fn sides([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The directed sides on which no other element borders by the same vertices, sorted.
fn rim(mesh: &Mesh) -> Vec<[usize; 2]> {
    let mut all: Vec<_> = mesh.elements.iter().flat_map(|element| sides(element.corners)).collect();
    all.sort_unstable();
    all.iter().filter(|[start, end]| all.binary_search(&[*end, *start]).is_err()).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A floor and three walls, each cut in so many cells along its sides.
    fn corner(cells: [usize; 4]) -> Mesh {
        let [o, x, y, z] = [DVec3::new(0.1, 0.2, 0.3), DVec3::X * 3.1, DVec3::Y * 2.7, DVec3::Z * 1.9];
        let mut mesh = Mesh::default();
        for (patch, [place, along, up]) in
            [[o, x, y], [o, z, x], [o, y, z], [o + x, z, y]].into_iter().enumerate()
        {
            let (count, first) = (cells[patch], mesh.vertices.len());
            let share = |k: usize| k as f64 / count as f64;
            for k in 0..(count + 1) * (count + 1) {
                mesh.vertices.push(place + share(k % (count + 1)) * along + share(k / (count + 1)) * up);
            }
            for k in (0..count).flat_map(|row| (0..count).map(move |column| row * (count + 1) + column)) {
                let [a, b, c, d] = [k, k + 1, k + count + 2, k + count + 1].map(|vertex| first + vertex);
                mesh.elements.extend([[a, b, c], [a, c, d]].map(|corners| Element { patch, corners }));
            }
        }
        mesh
    }

    /// How many vertices are in the middle of sides.
    fn hanging(mesh: &Mesh) -> usize {
        let sides = mesh.elements.iter().flat_map(|element| sides(element.corners));
        let inside = |[start, end]: [usize; 2]| {
            let [start, end] = [start, end].map(|vertex| mesh.vertices[vertex]);
            let is_inside = |place: &&DVec3| {
                let detour = start.distance(**place) + place.distance(end) - start.distance(end);
                detour < 1e-9 && start.distance(**place) > 1e-3 && end.distance(**place) > 1e-3
            };
            mesh.vertices.iter().filter(is_inside).count()
        };
        sides.map(inside).sum()
    }

    #[test]
    fn no_vertex_hangs_and_what_is_linear_stays_linear() {
        let mesh = corner([2, 5, 9, 4]);
        assert!(hanging(&mesh) > 20, "only {}", hanging(&mesh));
        let shown = Conforming::of(&mesh);
        assert_eq!(hanging(&shown.mesh), 0);
        let linear = |place: &DVec3| place.dot(DVec3::new(0.3, -0.2, 0.7)) + 5.0;
        let values = shown.at_vertices(mesh.vertices.iter().map(linear).collect(), 1);
        assert_eq!(values.len(), shown.mesh.vertices.len());
        for (value, place) in values.iter().zip(&shown.mesh.vertices) {
            assert!((value - linear(place)).abs() < 1e-9, "{value} at {place}");
        }
    }

    #[test]
    fn parts_cover_their_element_and_have_its_values() {
        let mesh = corner([2, 5, 9, 4]);
        let shown = Conforming::of(&mesh);
        let mut areas = vec![0.0; mesh.elements.len()];
        let numbers: Vec<usize> = (0..areas.len()).collect();
        for (part, element) in shown.on_elements(&numbers, 1).into_iter().enumerate() {
            assert_eq!(shown.mesh.elements[part].patch, mesh.elements[element].patch);
            areas[element] += shown.mesh.area(part);
        }
        for (element, area) in areas.into_iter().enumerate() {
            assert!((area - mesh.area(element)).abs() < 1e-9 * area, "element {element}");
        }
    }

    #[test]
    fn a_mesh_in_which_nothing_hangs_stays_as_it_is() {
        let mesh = corner([4; 4]);
        let shown = Conforming::of(&mesh).mesh;
        assert_eq!((shown.vertices, shown.elements), (mesh.vertices, mesh.elements));
    }

    #[test]
    fn what_rounding_parts_is_one_place() {
        let corners =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]: [f64; 2]| DVec3::new(x, y, 0.3));
        let mut vertices = corners.to_vec();
        vertices.extend([corners[2], corners[1] + DVec3::X * 1e-15, corners[1] + DVec3::X]);
        let elements =
            [[0, 1, 3], [1, 2, 3], [4, 5, 6]].map(|corners| Element { patch: corners[0] / 4, corners });
        let shown = Conforming::of(&Mesh { vertices, elements: elements.to_vec() }).mesh;
        assert_eq!(shown.vertices[5], shown.vertices[1]);
        assert_eq!(shown.elements.len(), 3);
    }
}
