//! The default scene, walked: meshes become patches, cameras cameras.
use super::{accessor::Buffers, document::GltfFile, lights, lights::ReadLight, material::Materials};
use crate::io::error::{Fault, FileError};
use crate::io::surface::lamps::Stand;
use crate::io::surface::place::{MAX_PATCHES, Refusal, Surfaces};
use crate::io::surface::polygon::{Corner, Polygon};
use crate::io::{surface::facets, surface::finish::Surface};
use crate::scene::{Scene, camera::Camera, finding::Finding, lamp::Lamp, patch::Origin, sky::Sun, units::Units};
use glam::{DMat4, DQuat, DVec2, DVec3};
use gltf::accessor::Dimensions;
use gltf::mesh::{Mode, Semantic};
use std::path::Path;

/// Nodes nested deeper than this are refused: a node that contains itself never ends.
const MAX_NESTING: usize = 64;
/// Nodes entered while walking.
const MAX_NODES: usize = 1_000_000;

pub(super) fn scene(file: &str, gltf: &GltfFile, folder: Option<&Path>) -> Result<Scene, FileError> {
    let buffers = Buffers::load(file, gltf, folder)?;
    let mut reader = Reader {
        file,
        materials: Materials::new(&buffers, folder),
        surfaces: Surfaces::default(),
        cameras: Vec::new(),
        lamps: Vec::new(),
        suns: Vec::new(),
        units: lights::units(&gltf.document),
        warnings: Vec::new(),
        instances: 0,
    };
    reader.walk(&gltf.document)?;
    let Reader { surfaces, cameras, lamps, suns, units, warnings, .. } = reader;
    let patches = surfaces.named();
    Ok(Scene { patches, lamps, suns, units, cameras, bands: 3, warnings, ..Scene::default() })
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
}

impl Reader<'_> {
    /// Depth first, in the order of the file.
    fn walk(&mut self, gltf: &gltf::Document) -> Result<(), FileError> {
        let Some(scene) = gltf.default_scene().or_else(|| gltf.scenes().next()) else { return Ok(()) };
        if gltf.scenes().count() > 1 {
            let index = scene.index();
            let what = format!("{}: of its scenes number {index} is taken", self.file);
            self.warn(what, "make the one you want the default scene");
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
            self.shine(&light, &name, world);
        }
        let Some(mesh) = node.mesh() else { return Ok(()) };
        if node.skin().is_some() || mesh.primitives().any(|primitive| primitive.morph_targets().len() > 0) {
            self.warn(format!("{name}: skins and morphs are left out"), "bake them into plain geometry");
        }
        let instance = self.instances;
        self.instances += 1;
        for primitive in mesh.primitives() {
            self.cover(&name, &mesh, &primitive, world, instance)?;
        }
        Ok(())
    }

    fn shine(&mut self, light: &gltf::khr_lights_punctual::Light<'_>, name: &str, world: DMat4) {
        let read = Stand::of(world).and_then(|stand| lights::read(light, name, stand, self.units));
        match read {
            Some(ReadLight::Lamp(lamp)) => self.lamps.push(lamp),
            Some(ReadLight::Sun(sun)) => self.suns.push(sun),
            None => self.warn(
                format!("{name}: the light has no strength or no direction; it is left out"),
                "correct its intensity, its colour, or the node's transform",
            ),
        }
    }

    /// The patches of a primitive.
    fn cover(
        &mut self,
        name: &str,
        mesh: &gltf::Mesh<'_>,
        primitive: &gltf::Primitive<'_>,
        world: DMat4,
        instance: usize,
    ) -> Result<(), FileError> {
        let part = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
        let place = format!("{}: {part}", self.file);
        let kind = self.materials.kind(&primitive.material(), &mut self.warnings);
        let triangles = self.triangles(primitive, kind.places, &part)?;
        let facets = facets(&triangles, true, kind.finish.image.is_some());
        let origin = Origin { instance, primitive: primitive.index(), polygon: 0 };
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
        added.map_err(|refusal| {
            let fault = match refusal {
                Refusal::TooMany => Fault::TooMany { what: "polygons", limit: MAX_PATCHES },
                Refusal::Shape { polygon, source } => Fault::Shape { polygon, source },
            };
            self.fault(part, fault)
        })
    }

    fn triangles(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        set: u32,
        part: &str,
    ) -> Result<Vec<Polygon>, FileError> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            let what = format!("{}: {part}: points and lines have no area; they are left out", self.file);
            self.warn(what, "remove them, or make them surfaces");
            return Ok(Vec::new());
        }
        let corners = self.corners(primitive, set)?;
        let indices = match primitive.indices() {
            Some(accessor) => self.materials.buffers.wholes(&accessor)?,
            None => (0..corners.len()).collect(),
        };
        let corner = |index: usize| {
            let found = corners.get(index).copied();
            found.ok_or_else(|| self.fault(part.into(), Fault::Index { index, len: corners.len() }))
        };
        let picks = picks(mode, indices.len());
        let triangle = |pick: [usize; 3]| {
            Ok(vec![pick.iter().map(|&at| corner(indices[at])).collect::<Result<Vec<_>, FileError>>()?])
        };
        picks.map(triangle).collect()
    }

    /// Positions with the picture's coordinates and normals, where there are any.
    fn corners(&self, primitive: &gltf::Primitive<'_>, set: u32) -> Result<Vec<Corner>, FileError> {
        let buffers = self.materials.buffers;
        let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(Vec::new()) };
        let points = buffers.rows::<3>(&positions, Dimensions::Vec3)?;
        let places = primitive.get(&Semantic::TexCoords(set));
        let places = places.map(|rows| buffers.rows::<2>(&rows, Dimensions::Vec2)).transpose()?;
        let normals = primitive.get(&Semantic::Normals);
        let normals = normals.map(|rows| buffers.rows::<3>(&rows, Dimensions::Vec3)).transpose()?;
        let corner = |(index, point): (usize, [f64; 3])| {
            let place = places.as_ref().and_then(|rows| rows.get(index));
            let normal = normals.as_ref().and_then(|rows| rows.get(index));
            Corner {
                point: point.into(),
                place: place.map_or(DVec2::ZERO, |row| (*row).into()),
                normal: normal.map_or(DVec3::ZERO, |row| (*row).into()),
            }
        };
        Ok(points.into_iter().enumerate().map(corner).collect())
    }

    /// A camera looks along its node's −z, with +y up.
    fn look(&mut self, camera: &gltf::Camera<'_>, name: &str, world: DMat4) {
        let gltf::camera::Projection::Perspective(lens) = camera.projection() else {
            let what = format!("{name}: only perspective cameras are read; this one is left out");
            self.warn(what, "make it a perspective camera, or give --camera");
            return;
        };
        let turned = |axis| world.transform_vector3(axis).try_normalize();
        let (fov, aspect) = (f64::from(lens.yfov()), f64::from(lens.aspect_ratio().unwrap_or(4.0 / 3.0)));
        let (Some(direction), Some(up)) = (turned(DVec3::NEG_Z), turned(DVec3::Y)) else {
            self.warn(
                format!("{name}: the camera has no view; it is left out"),
                "correct it, or give --camera",
            );
            return;
        };
        let position = world.w_axis.truncate();
        let camera = Camera { name: name.into(), position, direction, up, vertical_fov: fov, aspect };
        if camera.is_sound() {
            self.cameras.push(camera);
        } else {
            self.warn(
                format!("{name}: the camera has no view; it is left out"),
                "correct it, or give --camera",
            );
        }
    }

    fn warn(&mut self, what: String, repair: &str) {
        self.warnings.push(Finding::of_file(what, repair));
    }

    fn fault(&self, part: String, fault: Fault) -> FileError {
        FileError::Part { file: self.file.into(), part, fault }
    }
}

/// The node's transform; the file's single precision is turned to doubles before anything is multiplied.
fn local(node: &gltf::Node<'_>) -> DMat4 {
    match node.transform() {
        gltf::scene::Transform::Matrix { matrix } => {
            DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)))
        }
        gltf::scene::Transform::Decomposed { translation, rotation, scale } => {
            let turn = DQuat::from_array(rotation.map(f64::from));
            let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
            let [scale, translation] = [scale, translation].map(|row| DVec3::from(row.map(f64::from)));
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
