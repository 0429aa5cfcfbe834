//! Small COLLADA files and meshes to test with.
use radiosity::glam::DVec3;
use radiosity::io::collada::Collada;
use radiosity::{Element, Mesh, PatchRecord, Record, Scene};

/// A file of libraries and of the nodes of its one visual scene. Materials `grey` and `lamp` and the geometry `square`
/// (the unit square, z = 0, facing +z, symbol `m`) are there.
pub(crate) fn file(libraries: &str, nodes: &str) -> String {
    let square = geometry("square", "0 0 0 1 0 0 1 1 0 0 1 0", &polylist("square", "4", "0 1 2 3"));
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis></asset>
<library_effects>
<effect id="grey-fx"><profile_COMMON><technique sid="t"><lambert><diffuse><color>0.25 0.5 0.75 1</color></diffuse></lambert></technique></profile_COMMON></effect>
<effect id="lamp-fx"><profile_COMMON><technique sid="t"><phong><emission><color>1 2 3 1</color></emission><diffuse><color>0.1 0.1 0.1 1</color></diffuse></phong></technique></profile_COMMON></effect>
</library_effects>
<library_materials><material id="grey"><instance_effect url="#grey-fx"/></material><material id="lamp"><instance_effect url="#lamp-fx"/></material></library_materials>
<library_geometries>{square}</library_geometries>
{libraries}
<library_visual_scenes><visual_scene id="vs">
{nodes}
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene>
</COLLADA>
"##
    )
}

/// A geometry of positions and a primitive.
pub(crate) fn geometry(id: &str, positions: &str, primitive: &str) -> String {
    let count = positions.split_whitespace().count();
    format!(
        r##"<geometry id="{id}"><mesh><source id="{id}-p"><float_array id="{id}-a" count="{count}">{positions}</float_array>
<technique_common><accessor source="#{id}-a" count="{}" stride="3"/></technique_common></source>
<vertices id="{id}-v"><input semantic="POSITION" source="#{id}-p"/></vertices>{primitive}</mesh></geometry>"##,
        count / 3
    )
}

/// A polygon list of the geometry `id`, symbol `m`.
pub(crate) fn polylist(id: &str, counts: &str, indices: &str) -> String {
    primitive("polylist", id, &format!("<vcount>{counts}</vcount><p>{indices}</p>"))
}

/// Any primitive of the geometry `id`, symbol `m`.
pub(crate) fn primitive(tag: &str, id: &str, body: &str) -> String {
    format!(
        r##"<{tag} material="m" count="1"><input semantic="VERTEX" source="#{id}-v" offset="0"/>{body}</{tag}>"##
    )
}

/// A node that instances a geometry in grey.
pub(crate) fn node(name: &str, transforms: &str, geometry: &str) -> String {
    format!(r##"<node id="{name}" name="{name}">{transforms}{}</node>"##, instance(geometry, "grey"))
}

/// An instance of a geometry, its symbol `m` bound to a material.
pub(crate) fn instance(geometry: &str, material: &str) -> String {
    format!(
        r##"<instance_geometry url="#{geometry}"><bind_material><technique_common><instance_material symbol="m" target="#{material}"/></technique_common></bind_material></instance_geometry>"##
    )
}

/// The scene of a text that must be good.
pub(crate) fn scene(text: &str) -> Scene {
    Collada::from_text("test.dae", text).scene().unwrap()
}

/// The message about a text that must be bad.
pub(crate) fn refusal(text: &str) -> String {
    Collada::from_text("test.dae", text).scene().unwrap_err().to_string()
}

/// Every patch's outline as a fan of triangles: right for convex patches without holes.
pub(crate) fn fans(scene: &Scene) -> Mesh {
    let mut mesh = Mesh::default();
    for (patch, surface) in scene.patches.iter().enumerate() {
        let outline = surface.polygon.loops().next().unwrap();
        let first = mesh.vertices.len();
        mesh.vertices.extend_from_slice(outline);
        let fan =
            (1..outline.len() - 1).map(|i| Element { patch, corners: [first, first + i, first + i + 1] });
        mesh.elements.extend(fan);
    }
    mesh
}

/// A solution of a scene as it would be written: its fans, with the same red, green and blue at every vertex.
pub(crate) fn record(scene: &Scene, light: [f64; 3]) -> Record {
    let mesh = fans(scene);
    let values = light.repeat(mesh.vertices.len());
    Record {
        scene: "test.dae".into(),
        asset: scene.asset,
        cameras: scene.cameras.clone(),
        bands: 3,
        wavelengths: Vec::new(),
        lumens: vec![1.0; 3],
        bound: vec![0.0; 3],
        patches: scene
            .patches
            .iter()
            .map(|patch| PatchRecord {
                name: patch.name.clone(),
                area: patch.polygon.area(),
                reflectance: patch.reflectance.clone(),
                emission: patch.emission.clone(),
                irradiance: vec![0.0; 3],
                estimate: Vec::new(),
                in_view: None,
                radiosity: light.to_vec(),
                picture: None,
                tint: [1.0; 3],
            })
            .collect(),
        vertex_radiosity: values.clone(),
        vertex_irradiance: values,
        places: Vec::new(),
        elements: mesh.elements.iter().map(|e| [e.patch, e.corners[0], e.corners[1], e.corners[2]]).collect(),
        radiosity: light.repeat(mesh.elements.len()),
        irradiance: light.repeat(mesh.elements.len()),
        vertices: mesh.vertices,
        recording: None,
        pictures: Vec::new(),
    }
}

/// The names of the patches.
pub(crate) fn names(scene: &Scene) -> Vec<&str> {
    scene.patches.iter().map(|patch| patch.name.as_str()).collect()
}

/// The points of a patch's outline.
pub(crate) fn outline(scene: &Scene, patch: usize) -> Vec<DVec3> {
    scene.patches[patch].polygon.loops().next().unwrap().to_vec()
}
