//! A model as COLLADA 1.4 text: one node, geometry and polygon list per face.
use super::{Face, Material, Model, View};
use crate::io::collada::{decimal, list};
use glam::DVec3;

pub(super) fn text(model: &Model) -> String {
    let effects: String = model.materials.iter().map(effect).collect();
    let materials: String = model.materials.iter().map(material).collect();
    let geometries: String = model.faces.iter().map(geometry).collect();
    let nodes: String = model.faces.iter().map(node).collect();
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor>
      <authoring_tool>radiosity scene</authoring_tool>
      <comments>{title}</comments>
    </contributor>
    <created>2026-01-01T00:00:00Z</created>
    <modified>2026-01-01T00:00:00Z</modified>
    <unit name="{unit}" meter="{metres}"/>
    <up_axis>{up}</up_axis>
  </asset>
  <library_cameras>
{camera}  </library_cameras>
  <library_effects>
{effects}  </library_effects>
  <library_materials>
{materials}  </library_materials>
  <library_geometries>
{geometries}  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
{view}{nodes}    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
  </scene>
</COLLADA>
"##,
        title = model.title,
        unit = model.unit.0,
        metres = decimal(&model.unit.1),
        up = model.up_axis,
        camera = lens(&model.view),
        view = view(&model.view),
    )
}

/// The angle is written with nine decimals: what the last bits of an arctangent are is the platform's affair.
fn lens(view: &View) -> String {
    format!(
        r#"    <camera id="camera-lens">
      <optics>
        <technique_common>
          <perspective>
            <yfov>{:.9}</yfov>
            <aspect_ratio>{}</aspect_ratio>
            <znear>1</znear>
            <zfar>10000</zfar>
          </perspective>
        </technique_common>
      </optics>
    </camera>
"#,
        view.degrees,
        decimal(&view.aspect)
    )
}

/// A matrix, row by row, since not every program reads `<lookat>`: a camera looks along its −z with y up.
fn view(view: &View) -> String {
    let back = (view.eye - view.interest).normalize();
    let right = view.up.cross(back).normalize();
    let axes = [right, back.cross(right), back, view.eye];
    let row = |axis: usize| list(axes.map(|column| decimal(&column[axis])).iter());
    format!(
        r##"      <node id="camera" name="camera">
        <matrix>{}  {}  {}  0 0 0 1</matrix>
        <instance_camera url="#camera-lens"/>
      </node>
"##,
        row(0),
        row(1),
        row(2)
    )
}

fn effect(material: &Material) -> String {
    format!(
        r#"    <effect id="{name}-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert>
            <emission><color>{emission} 1</color></emission>
            <diffuse><color>{reflectance} 1</color></diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
    </effect>
"#,
        name = material.name,
        emission = list(material.emission.iter().map(decimal)),
        reflectance = list(material.reflectance.iter().map(decimal)),
    )
}

fn material(material: &Material) -> String {
    format!(
        r##"    <material id="{name}" name="{name}"><instance_effect url="#{name}-effect"/></material>
"##,
        name = material.name
    )
}

fn node(face: &Face) -> String {
    format!(
        r##"      <node id="{name}" name="{name}">
        <instance_geometry url="#{name}-mesh">
          <bind_material>
            <technique_common>
              <instance_material symbol="{material}" target="#{material}"/>
            </technique_common>
          </bind_material>
        </instance_geometry>
      </node>
"##,
        name = face.name,
        material = face.material
    )
}

fn geometry(face: &Face) -> String {
    let points = points(face);
    format!(
        r##"    <geometry id="{name}-mesh" name="{name}">
      <mesh>
        <source id="{name}-positions">
          <float_array id="{name}-array" count="{count}">
{rows}          </float_array>
          <technique_common>
            <accessor source="#{name}-array" count="{corners}" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="{name}-vertices">
          <input semantic="POSITION" source="#{name}-positions"/>
        </vertices>
{primitive}      </mesh>
    </geometry>
"##,
        name = face.name,
        count = 3 * points.len(),
        corners = points.len(),
        rows = points.iter().map(row).collect::<String>(),
        primitive = primitive(face, &points),
    )
}

fn row(point: &DVec3) -> String {
    format!("            {}\n", list(point.to_array().iter().map(decimal)))
}

/// The face's different points, in the order of their first use.
fn points(face: &Face) -> Vec<DVec3> {
    let mut points = Vec::new();
    for point in face.polygons.iter().flatten().flatten() {
        if !points.contains(point) {
            points.push(*point);
        }
    }
    points
}

/// A polygon list, or polygons where one has holes.
fn primitive(face: &Face, points: &[DVec3]) -> String {
    let indices = |ring: &Vec<DVec3>| list(ring.iter().filter_map(|p| points.iter().position(|q| q == p)));
    let holes = face.polygons.iter().any(|polygon| polygon.len() > 1);
    let tag = if holes { "polygons" } else { "polylist" };
    let body: String = if holes {
        face.polygons.iter().map(|polygon| with_holes(polygon, indices)).collect()
    } else {
        let outlines = || face.polygons.iter().map(|polygon| &polygon[0]);
        let counts = list(outlines().map(Vec::len));
        let lists = outlines().map(indices).collect::<Vec<_>>().join("  ");
        format!("          <vcount>{counts}</vcount>\n          <p>{lists}</p>\n")
    };
    format!(
        r##"        <{tag} material="{material}" count="{count}">
          <input semantic="VERTEX" source="#{name}-vertices" offset="0"/>
{body}        </{tag}>
"##,
        material = face.material,
        count = face.polygons.len(),
        name = face.name
    )
}

fn with_holes(polygon: &[Vec<DVec3>], indices: impl Fn(&Vec<DVec3>) -> String) -> String {
    let outline = indices(&polygon[0]);
    let holes: String = polygon[1..].iter().map(|hole| format!("<h>{}</h>", indices(hole))).collect();
    format!("          <ph><p>{outline}</p>{holes}</ph>\n")
}
