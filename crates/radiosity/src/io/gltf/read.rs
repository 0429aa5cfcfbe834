//! The default scene, walked: meshes become patches, cameras cameras.
use super::material::{Materials, ReadMaterial, as_written};
use super::{accessor::Buffers, document::GltfFile, lights, lights::ReadLight};
use crate::io::error::{Fault, FileError};
use crate::io::surface::facets;
use crate::io::surface::finish::Surface;
use crate::io::surface::lamps::LampPose;
use crate::io::surface::place::Surfaces;
use crate::io::surface::polygon::{Corner, Polygon};
use crate::scene::{
    Scene, camera::Camera, finding::Finding, lamp::Lamp, patch::Origin, sky::Sun, units::Units,
};
use glam::{DAffine2, DMat4, DQuat, DVec2, DVec3, Vec3};
use gltf::accessor::Dimensions;
use gltf::mesh::{Mode, Semantic};
use std::{collections::BTreeMap, path::Path};

/// Nodes nested deeper than this are refused: a node that contains itself never ends.
const MAX_NESTING: usize = 64;
/// Nodes entered while walking.
const MAX_NODES: usize = 1_000_000;

/// A primitive as it was read.
pub(super) struct ReadPrimitive {
    /// The index of its node in the document.
    pub(super) node: usize,
    pub(super) origin: Origin,
    pub(super) world: DMat4,
    /// From the file's places in a picture to those that it shows.
    pub(super) laid: DAffine2,
    /// The indices of each triangle's vertices.
    pub(super) triangles: Vec<[usize; 3]>,
    /// The shading normal of each vertex, zero where there is none.
    pub(super) normals: Vec<Vec3>,
    /// The polygons, by their first triangles, that were split or left out.
    pub(super) flawed: Vec<usize>,
    /// The triangles that each polygon was joined from, by its first.
    pub(super) members: BTreeMap<usize, Vec<usize>>,
}

/// The scene, and the primitives that it was made of.
pub(super) fn read(
    file: &str,
    gltf: &GltfFile,
    folder: Option<&Path>,
    mut warnings: Vec<Finding>,
) -> Result<(Scene, Vec<ReadPrimitive>), FileError> {
    let buffers = Buffers::load(file, gltf, folder)?;
    let mut reader = Reader {
        file,
        materials: Materials::new(&buffers, folder, lights::of_emission(gltf, file, &mut warnings)),
        surfaces: Surfaces::in_single_precision(),
        cameras: Vec::new(),
        lamps: Vec::new(),
        suns: Vec::new(),
        units: lights::units(gltf),
        warnings,
        instances: 0,
        primitives: Vec::new(),
    };
    reader.walk(&gltf.document)?;
    let Reader { surfaces, cameras, lamps, suns, units, warnings, primitives, .. } = reader;
    let patches = surfaces.named();
    Ok((Scene { patches, lamps, suns, units, cameras, bands: 3, warnings, ..Scene::default() }, primitives))
}

struct Reader<'f> {
    file: &'f str,
    materials: Materials<'f>,
    surfaces: Surfaces,
    cameras: Vec<Camera>,
    lamps: Vec<Lamp>,
    suns: Vec<Sun>,
    units: Units,
    warnings: Vec<Finding>,
    instances: usize,
    primitives: Vec<ReadPrimitive>,
}

impl Reader<'_> {
    /// Depth first, in the order of the file.
    fn walk(&mut self, gltf: &gltf::Document) -> Result<(), FileError> {
        let Some(scene) = gltf.default_scene().or_else(|| gltf.scenes().next()) else { return Ok(()) };
        if gltf.scenes().count() > 1 {
            let what = format!("of several scenes, number {} is taken", scene.index());
            self.note(self.file, &what, "make the one you want the default scene");
        }
        let mut stack: Vec<(gltf::Node<'_>, DMat4, usize)> =
            scene.nodes().map(|node| (node, DMat4::IDENTITY, 0)).collect();
        stack.reverse();
        let mut entered = 0;
        while let Some((node, above, depth)) = stack.pop() {
            entered += 1;
            let refuse = |fault| Err(self.fault(format!("node {}", node.index()), fault));
            if entered > MAX_NODES {
                return refuse(Fault::TooMany { what: "nodes", limit: MAX_NODES });
            }
            if depth > MAX_NESTING {
                return refuse(Fault::Nesting(MAX_NESTING));
            }
            let world = above * local(&node);
            if !world.is_finite() {
                return refuse(Fault::Overflow);
            }
            self.meet(&node, world)?;
            let inner: Vec<_> = node.children().map(|child| (child, world, depth + 1)).collect();
            stack.extend(inner.into_iter().rev());
        }
        Ok(())
    }

    fn meet(&mut self, node: &gltf::Node<'_>, world: DMat4) -> Result<(), FileError> {
        let name = node.name().map(str::trim).filter(|name| !name.is_empty());
        let name = name.map_or_else(|| format!("node-{}", node.index()), Into::into);
        if let Some(camera) = node.camera() {
            self.look(&camera, &name, world);
        }
        if let Some(light) = node.light() {
            self.shine(&light, &name, world)?;
        }
        let Some(mesh) = node.mesh() else { return Ok(()) };
        if node.skin().is_some() || mesh.primitives().any(|primitive| primitive.morph_targets().len() > 0) {
            self.note(&name, "skins and morphs are left out", "bake them into plain geometry");
        }
        let instance = self.instances;
        self.instances += 1;
        for primitive in mesh.primitives() {
            let origin = Origin { instance, primitive: primitive.index(), polygon: 0 };
            self.cover(&name, (node.index(), &mesh), &primitive, world, origin)?;
        }
        Ok(())
    }

    fn shine(
        &mut self,
        light: &gltf::khr_lights_punctual::Light<'_>,
        name: &str,
        world: DMat4,
    ) -> Result<(), FileError> {
        let read = match LampPose::of(world) {
            Some(pose) => lights::read(light, name, pose, &mut self.warnings),
            None => Ok(None),
        };
        match read.map_err(|fault| self.fault(format!("light {}", light.index()), fault))? {
            Some(ReadLight::Lamp(lamp)) => self.lamps.push(lamp),
            Some(ReadLight::Sun(sun)) => self.suns.push(sun),
            None => {
                let repair = "correct its intensity, its colour, or the node's transform";
                self.note(name, "a light without strength or direction is left out", repair);
            }
        }
        Ok(())
    }

    /// The patches of a primitive.
    fn cover(
        &mut self,
        name: &str,
        (node, mesh): (usize, &gltf::Mesh<'_>),
        primitive: &gltf::Primitive<'_>,
        world: DMat4,
        origin: Origin,
    ) -> Result<(), FileError> {
        let part = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
        let place = format!("{}: {part}", self.file);
        let kind = self.materials.kind(&primitive.material(), &mut self.warnings);
        let corners = self.corners(primitive, &kind)?;
        if corners.iter().any(|corner| kind.is_beyond(corner.place)) {
            let what = "a picture repeats where its sampler clamps or mirrors it";
            self.note(&place, what, "keep its coordinates between 0 and 1, or let it repeat");
        }
        let triangles = self.triangles(primitive, corners.len(), &part)?;
        let polygons: Vec<Polygon> =
            triangles.iter().map(|picks| vec![picks.map(|index| corners[index]).to_vec()]).collect();
        if primitive.get(&Semantic::Colors(0)).is_some() {
            self.note(
                &place,
                "vertex colours are left out; the material's colour is taken",
                "give it a texture",
            );
        }
        let facets = facets(&polygons, true, kind.finish.image.is_some());
        let members = facets.iter().map(|facet| (facet.number, facet.members.clone())).collect();
        let surface = Surface {
            name,
            place: &place,
            facets: &facets,
            world,
            finish: kind.finish,
            two_sided: kind.two_sided,
            origin,
        };
        let added = self.surfaces.add(&surface, &mut self.warnings);
        let flawed = added.map_err(|refusal| self.fault(part, refusal.into()))?;
        let (laid, normals) = (kind.laid, corners.iter().map(|corner| corner.normal.as_vec3()).collect());
        let read = ReadPrimitive { node, origin, world, laid, triangles, normals, flawed, members };
        self.primitives.push(read);
        Ok(())
    }

    /// The indices of each triangle's vertices.
    fn triangles(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        len: usize,
        part: &str,
    ) -> Result<Vec<[usize; 3]>, FileError> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            let what = "lines and points have no area; they are left out";
            self.note(&format!("{}: {part}", self.file), what, "remove them, or make them surfaces");
            return Ok(Vec::new());
        }
        let indices = match primitive.indices() {
            Some(accessor) => self.materials.buffers.wholes(&accessor)?,
            None => (0..len).collect(),
        };
        let triangles: Vec<[usize; 3]> =
            picks(mode, indices.len()).map(|picks| picks.map(|at| indices[at])).collect();
        match triangles.iter().flatten().find(|index| **index >= len) {
            Some(&index) => Err(self.fault(part.into(), Fault::Index { index, len })),
            None => Ok(triangles),
        }
    }

    /// Positions with the picture's coordinates and normals, where there are any.
    fn corners(
        &self,
        primitive: &gltf::Primitive<'_>,
        material: &ReadMaterial,
    ) -> Result<Vec<Corner>, FileError> {
        let buffers = self.materials.buffers;
        let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(Vec::new()) };
        let points = buffers.rows::<3>(&positions, Dimensions::Vec3)?;
        // Light does not depend on these: broken ones are as good as none.
        let places = primitive.get(&Semantic::TexCoords(material.places));
        let places = places.and_then(|rows| buffers.rows::<2>(&rows, Dimensions::Vec2).ok());
        let normals = primitive.get(&Semantic::Normals);
        let normals = normals.and_then(|rows| buffers.rows::<3>(&rows, Dimensions::Vec3).ok());
        let corner = |(index, point): (usize, [f64; 3])| {
            let place = places.as_ref().and_then(|rows| rows.get(index));
            let normal = normals.as_ref().and_then(|rows| rows.get(index));
            Corner {
                point: point.into(),
                place: place.map_or(DVec2::ZERO, |row| material.laid.transform_point2((*row).into())),
                normal: normal.map_or(DVec3::ZERO, |row| (*row).into()),
            }
        };
        Ok(points.into_iter().enumerate().map(corner).collect())
    }

    /// A camera looks along its node's −z, with +y up.
    fn look(&mut self, camera: &gltf::Camera<'_>, name: &str, world: DMat4) {
        let gltf::camera::Projection::Perspective(lens) = camera.projection() else {
            let what = "only perspective cameras are read; another kind is left out";
            self.note(name, what, "make it one, or give --camera");
            return;
        };
        let turned = |axis| world.transform_vector3(axis).try_normalize();
        let (fov, aspect) = (as_written(lens.yfov()), lens.aspect_ratio().map_or(4.0 / 3.0, as_written));
        let (Some(direction), Some(up)) = (turned(DVec3::NEG_Z), turned(DVec3::Y)) else {
            self.note(name, "a camera without a view is left out", "correct it, or give --camera");
            return;
        };
        let position = world.w_axis.truncate();
        let camera = Camera { name: name.into(), position, direction, up, vertical_fov: fov, aspect };
        if camera.is_sound() {
            self.cameras.push(camera);
        } else {
            self.note(name, "a camera without a view is left out", "correct it, or give --camera");
        }
    }

    fn note(&mut self, place: &str, what: &str, repair: &str) {
        Finding::note(&mut self.warnings, place, what, repair);
    }

    fn fault(&self, part: String, fault: Fault) -> FileError {
        FileError::Part { file: self.file.into(), part, fault }
    }
}

/// The node's transform; the file's single precision is turned to doubles before anything is multiplied.
fn local(node: &gltf::Node<'_>) -> DMat4 {
    match node.transform() {
        gltf::scene::Transform::Matrix { matrix } => {
            DMat4::from_cols_array_2d(&matrix.map(|column| column.map(as_written)))
        }
        gltf::scene::Transform::Decomposed { translation, rotation, scale } => {
            let turn = DQuat::from_array(rotation.map(as_written));
            let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
            let [scale, translation] = [scale, translation].map(|row| DVec3::from(row.map(as_written)));
            DMat4::from_scale_rotation_translation(scale, turn, translation)
        }
    }
}

/// Which of `count` indices make a triangle each; every second one of a strip is turned.
fn picks(mode: Mode, count: usize) -> Box<dyn Iterator<Item = [usize; 3]>> {
    let last = count.saturating_sub(2);
    match mode {
        Mode::TriangleStrip => {
            Box::new((0..last).map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] }))
        }
        Mode::TriangleFan => Box::new((0..last).map(|i| [0, i + 1, i + 2])),
        _ => Box::new((0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])),
    }
}
