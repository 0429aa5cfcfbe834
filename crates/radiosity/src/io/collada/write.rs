//! The file with light on its surfaces: the old text, spliced.
//!
//! Each lit `<instance_geometry>` needs a mesh of its own. The first instance of a geometry takes the place of its
//! `<mesh>`; each further one gets a new `<geometry>` behind it. Where an `<instance_node>` makes one
//! `<instance_geometry>` stand for several surfaces, it is replaced by a copy of the node that it names.
use super::file::{File, XmlNode, child};
use super::lit_mesh::{Group, Ids, LitMesh};
use super::primitive::surfaces;
use super::walk::{Instance, walk};
use super::xml::TOOL;
use crate::escape::escape;
use crate::io::error::{Fault, FileError};
use crate::mesh::element::Mesh;
use crate::scene::{Scene, texture::Texture};
use glam::DVec2;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;

/// What is drawn onto the file.
pub(super) struct LitScene<'s> {
    pub(super) scene: &'s Scene,
    pub(super) mesh: &'s Mesh,
    pub(super) colours: &'s [[f64; 3]],
}

impl LitScene<'_> {
    /// The picture on the patch of an element.
    fn texture(&self, element: usize) -> Option<&Texture> {
        self.scene.patches[self.mesh.elements[element].patch].texture.as_ref()
    }
}

/// The doors (`<instance_node>`s) that were opened into copies to come to a place; none for the file's own text.
type Path<'a> = Vec<XmlNode<'a>>;

/// New text for a range of the old.
type Edit = (Range<usize>, String);

pub(super) fn with_light<'a>(text: &str, file: &File<'a>, light: &LitScene) -> Result<String, FileError> {
    let instances = walk(file)?.instances;
    let elements = elements_of(&instances, light);
    let lit: Vec<usize> = (0..instances.len()).filter(|index| !elements[*index].is_empty()).collect();
    let copied = copied_doors(&instances, &lit);
    let mut splice = Splice {
        text,
        file,
        edits: HashMap::new(),
        doors: HashMap::new(),
        used: HashSet::new(),
        numbers: HashMap::new(),
    };
    splice.sign();
    let mut replaced = HashSet::new();
    for index in lit {
        let instance = &instances[index];
        let path = splice.open(&instance.visit.via, &copied);
        let mesh = lit_mesh(instance, &elements[index], light);
        if replaced.insert(instance.geometry) {
            splice.replace_mesh(instance, &mesh)?;
        } else {
            splice.add_geometry(instance, &mesh, path)?;
        }
    }
    splice.render(0..text.len(), &Vec::new())
}

/// The mesh's elements of each instance, by primitive.
fn elements_of(instances: &[Instance], light: &LitScene) -> Vec<BTreeMap<usize, Vec<usize>>> {
    let mut all = vec![BTreeMap::<usize, Vec<usize>>::new(); instances.len()];
    for (index, element) in light.mesh.elements.iter().enumerate() {
        let origin = light.scene.patches[element.patch].origin;
        // A lamp that is no geometry stays as it is.
        let instance = all.get_mut(origin.instance);
        instance.into_iter().for_each(|all| all.entry(origin.primitive).or_default().push(index));
    }
    all
}

/// The `<instance_node>`s on the way to an `<instance_geometry>` that is met more than once. Such a door's outer doors are
/// copied too, since they lead to the same element.
fn copied_doors<'a>(instances: &[Instance<'a>], lit: &[usize]) -> HashSet<XmlNode<'a>> {
    let mut met: HashMap<XmlNode, usize> = HashMap::new();
    for index in lit {
        *met.entry(instances[*index].element).or_default() += 1;
    }
    let several = lit.iter().map(|index| &instances[*index]).filter(|instance| met[&instance.element] > 1);
    several.flat_map(|instance| instance.visit.via.iter().copied()).collect()
}

/// The instance's triangles in its node's coordinates.
fn lit_mesh(instance: &Instance, elements: &BTreeMap<usize, Vec<usize>>, light: &LitScene) -> LitMesh {
    let world = instance.visit.world;
    let (inverse, mirrored) = (world.inverse(), world.determinant() < 0.0);
    let surfaces: Vec<XmlNode> = surfaces(instance.geometry).collect();
    let (mut mesh, mut places) = (LitMesh::default(), HashMap::new());
    let textured = elements.values().flatten().any(|element| light.texture(*element).is_some());
    for (primitive, elements) in elements {
        let mut place = |vertex: usize, texture: Option<&Texture>| {
            *places.entry(vertex).or_insert_with(|| {
                let point = light.mesh.vertices[vertex];
                if textured {
                    mesh.places.push(texture.map_or(DVec2::ZERO, |texture| texture.place(point)));
                }
                mesh.positions.push(inverse.transform_point3(point));
                mesh.colours.push(light.colours[vertex]);
                mesh.positions.len() - 1
            })
        };
        let triangle = |element: &usize| {
            let corners = light.mesh.elements[*element].corners;
            let [a, b, c] = corners.map(|corner| place(corner, light.texture(*element)));
            if mirrored { [a, c, b] } else { [a, b, c] }
        };
        let triangles = elements.iter().map(triangle).collect();
        mesh.groups
            .push(Group { material: surfaces[*primitive].attribute("material").map(Into::into), triangles });
    }
    mesh
}

/// The edits so far.
struct Splice<'t, 'f, 'a> {
    text: &'t str,
    file: &'f File<'a>,
    /// By the copy that they are made in.
    edits: HashMap<Path<'a>, Vec<Edit>>,
    /// The doors that are replaced by copies, by the copy (or the file's own text) that they stand in.
    doors: HashMap<Path<'a>, Vec<XmlNode<'a>>>,
    /// New ids.
    used: HashSet<String>,
    /// The next number to try behind a stem.
    numbers: HashMap<String, usize>,
}

impl<'a> Splice<'_, '_, 'a> {
    /// Opens the doors that are to be copied; returns the copy in which the instance behind them stands.
    fn open(&mut self, via: &[XmlNode<'a>], copied: &HashSet<XmlNode<'a>>) -> Path<'a> {
        // What stands behind a door that is not copied is met once, and edited in the file's own text.
        if !via.last().is_some_and(|door| copied.contains(door)) {
            return Vec::new();
        }
        for (depth, door) in via.iter().enumerate() {
            let doors = self.doors.entry(via[..depth].to_vec()).or_default();
            if !doors.contains(door) {
                doors.push(*door);
            }
        }
        via.to_vec()
    }

    /// Names this program as the file's tool.
    fn sign(&mut self) {
        let tool = format!("<authoring_tool>{TOOL}</authoring_tool>");
        let Some(asset) = child(self.file.root, "asset") else { return };
        let old = child(asset, "contributor").and_then(|contributor| child(contributor, "authoring_tool"));
        if let Some(old) = old {
            self.edit(Vec::new(), old.range(), tool);
        } else if let Some(first) = asset.first_child() {
            let start = first.range().start;
            self.edit(Vec::new(), start..start, format!("<contributor>{tool}</contributor>"));
        }
    }

    fn edit(&mut self, path: Path<'a>, range: Range<usize>, text: String) {
        self.edits.entry(path).or_default().push((range, text));
    }

    fn replace_mesh(&mut self, instance: &Instance<'a>, mesh: &LitMesh) -> Result<(), FileError> {
        let old = self.file.child(instance.geometry, "mesh")?;
        let ids = self.ids(self.file.attribute(instance.geometry, "id")?);
        self.edit(Vec::new(), old.range(), mesh.text(&ids));
        Ok(())
    }

    /// A new geometry behind the old one, and the instance pointed at it.
    fn add_geometry(
        &mut self,
        instance: &Instance<'a>,
        mesh: &LitMesh,
        path: Path<'a>,
    ) -> Result<(), FileError> {
        let id = self.fresh(self.file.attribute(instance.geometry, "id")?);
        let ids = self.ids(&id);
        let end = instance.geometry.range().end;
        let text = format!("\n<geometry id=\"{}\">\n{}\n</geometry>", escape(&id), mesh.text(&ids));
        self.edit(Vec::new(), end..end, text);
        let url = instance.element.attribute_node("url");
        let url = url.ok_or_else(|| self.file.fault(instance.element, Fault::Attribute("url")))?;
        self.edit(path, url.range_value(), format!("#{}", escape(&id)));
        Ok(())
    }

    fn ids(&mut self, geometry: &str) -> Ids {
        let mut part = |name| self.fresh(&format!("{geometry}-{name}"));
        Ids {
            positions: part("lit-positions"),
            colours: part("lit-colours"),
            places: part("lit-places"),
            vertices: part("lit-vertices"),
        }
    }

    /// An id that neither the file nor an earlier call uses: the stem itself or the first free `stem-2`, `stem-3`, …
    fn fresh(&mut self, stem: &str) -> String {
        let number = self.numbers.entry(stem.into()).or_insert(1);
        loop {
            let id = if *number == 1 { stem.to_owned() } else { format!("{stem}-{number}") };
            *number += 1;
            if !self.file.has_id(&id) && self.used.insert(id.clone()) {
                return id;
            }
        }
    }

    /// The old text of a range with the edits made in the copy `path`. Nesting ends where the walk ended it.
    fn render(&mut self, range: Range<usize>, path: &Path<'a>) -> Result<String, FileError> {
        let mut edits = self.edits.remove(path).unwrap_or_default();
        for door in self.doors.remove(path).unwrap_or_default() {
            let mut inner = path.clone();
            inner.push(door);
            let node = self.file.target(door, "url", "node")?;
            self.rename(node, &inner);
            edits.push((door.range(), self.render(node.range(), &inner)?));
        }
        edits.sort_by_key(|(range, _)| range.start);
        Ok(spliced(self.text, range, &edits))
    }

    /// Ids are unique in a file: those of the copied node get new ones.
    fn rename(&mut self, node: XmlNode<'a>, path: &Path<'a>) {
        for id in node.descendants().filter_map(|inner| inner.attribute_node("id")) {
            let fresh = self.fresh(id.value());
            self.edit(path.clone(), id.range_value(), escape(&fresh));
        }
    }
}

/// The old text of a range with its edits, sorted; one inside an earlier one has nothing left to edit.
fn spliced(text: &str, range: Range<usize>, edits: &[Edit]) -> String {
    let (mut new, mut at) = (String::new(), range.start);
    for (place, replacement) in edits {
        if place.start >= at {
            new.push_str(&text[at..place.start]);
            new.push_str(replacement);
            at = place.end;
        }
    }
    new.push_str(&text[at..range.end]);
    new
}
