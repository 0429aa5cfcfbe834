//! The file with light on its surfaces: the old text, spliced.
//!
//! Each lit `<instance_geometry>` needs a mesh of its own. The first instance of a geometry takes the place of its
//! `<mesh>`; each further one gets a new `<geometry>` behind it. Where an `<instance_node>` makes one
//! `<instance_geometry>` stand for several surfaces, it is replaced by a copy of the node that it names.
use super::file::{File, XmlNode};
use super::lit_mesh::{Group, Ids, LitMesh};
use super::primitive::surfaces;
use super::splice::{Path, Splice, copied_doors};
use super::walk::{Instance, walk};
use crate::escape::escape;
use crate::io::error::FileError;
use crate::mesh::element::Mesh;
use crate::scene::{Scene, texture::Texture};
use glam::DVec2;
use std::collections::{BTreeMap, HashMap, HashSet};

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

pub(super) fn with_light<'a>(text: &str, file: &File<'a>, light: &LitScene) -> Result<String, FileError> {
    let instances = walk(file)?.instances;
    let elements = elements_of(&instances, light);
    let lit = instances.iter().enumerate().filter(|(index, _)| !elements[*index].is_empty());
    let lit: Vec<(usize, &Instance)> = lit.collect();
    let copied = copied_doors(lit.iter().map(|(_, instance)| *instance));
    let mut splice = Splice::new(text, file);
    splice.sign();
    let mut replaced = HashSet::new();
    for (index, instance) in lit {
        let path = splice.open(&instance.visit.via, &copied);
        let mesh = lit_mesh(instance, &elements[index], light);
        if replaced.insert(instance.geometry) {
            replace_mesh(&mut splice, instance, &mesh)?;
        } else {
            add_geometry(&mut splice, instance, &mesh, path)?;
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

/// The mesh takes the place of the geometry's own.
fn replace_mesh<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    instance: &Instance<'a>,
    mesh: &LitMesh,
) -> Result<(), FileError> {
    let old = splice.file.child(instance.geometry, "mesh")?;
    let ids = ids(splice, splice.file.attribute(instance.geometry, "id")?);
    splice.edit(Vec::new(), old.range(), mesh.text(&ids));
    Ok(())
}

/// A new geometry behind the old one, and the instance pointed at it.
fn add_geometry<'a>(
    splice: &mut Splice<'_, '_, 'a>,
    instance: &Instance<'a>,
    mesh: &LitMesh,
    path: Path<'a>,
) -> Result<(), FileError> {
    let id = splice.fresh(splice.file.attribute(instance.geometry, "id")?);
    let ids = ids(splice, &id);
    let end = instance.geometry.range().end;
    let text = format!("\n<geometry id=\"{}\">\n{}\n</geometry>", escape(&id), mesh.text(&ids));
    splice.edit(Vec::new(), end..end, text);
    splice.point_at(instance, &id, path)
}

fn ids(splice: &mut Splice<'_, '_, '_>, geometry: &str) -> Ids {
    let mut part = |name| splice.fresh(&format!("{geometry}-{name}"));
    Ids {
        positions: part("lit-positions"),
        colours: part("lit-colours"),
        places: part("lit-places"),
        vertices: part("lit-vertices"),
    }
}
