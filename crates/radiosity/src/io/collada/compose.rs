//! A model as COLLADA 1.4 text: one node, geometry and polygon list per face.
use super::images::hex;
use super::light_text::WrittenLights;
use super::model::{Face, Material, Model};
use super::spectra::PROFILE;
use crate::escape::escape;
use crate::io::words::{TOOL, decimal, list};
use crate::scene::{asset::Asset, camera::Camera, texture::Texture};
use glam::DVec3;
use std::collections::HashMap;

/// The whole file, always the same bytes for the same model.
pub(crate) fn text(model: &Model) -> String {
    text_with(model, &WrittenLights { lamps: &[], suns: &[], wavelengths: &[] })
}

/// The whole file, with lights that are no surfaces.
pub(super) fn text_with(model: &Model, lights: &WrittenLights<'_>) -> String {
    let images: String = model.materials.iter().filter_map(image).collect();
    let effects: String =
        model.materials.iter().map(|material| effect(material, &model.wavelengths)).collect();
    let materials: String = model.materials.iter().map(material).collect();
    let faces = || model.faces.iter().enumerate();
    let geometries: String =
        faces().map(|(index, face)| geometry(index, face, &model.materials[face.material])).collect();
    let nodes: String =
        faces().map(|(index, face)| node(index, face, &model.materials[face.material])).collect();
    let lenses: String = model.cameras.iter().enumerate().map(lens).collect();
    let views: String = model.cameras.iter().enumerate().map(view).collect();
    let library = |name: &str, body: &str| match body {
        "" => String::new(),
        body => format!("  <library_{name}>\n{body}  </library_{name}>\n"),
    };
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
{asset}{cameras}{lights}{images}{effects}{materials}{geometries}  <library_visual_scenes>
    <visual_scene id="scene">
{views}{lamps}{nodes}    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
  </scene>
{wavelengths}</COLLADA>
"##,
        asset = asset(&model.title, &model.asset),
        cameras = library("cameras", &lenses),
        lights = library("lights", &lights.library()),
        lamps = lights.nodes(),
        images = library("images", &images),
        effects = library("effects", &effects),
        materials = library("materials", &materials),
        geometries = library("geometries", &geometries),
        wavelengths = wavelengths(&model.wavelengths),
    )
}

fn asset(title: &str, asset: &Asset) -> String {
    let axes = [(asset.up.x, "X_UP"), (asset.up.z, "Z_UP")];
    let up = axes.iter().find(|(along, _)| *along > 0.0).map_or("Y_UP", |(_, name)| name);
    let known = [(1.0, "meter"), (0.01, "centimeter"), (0.001, "millimeter"), (0.0254, "inch")];
    let unit = known.iter().find(|(metres, _)| *metres == asset.unit).map_or("unit", |(_, name)| name);
    format!(
        r#"  <asset>
    <contributor>
      <authoring_tool>{tool}</authoring_tool>
      <comments>{title}</comments>
    </contributor>
    <created>2026-01-01T00:00:00Z</created>
    <modified>2026-01-01T00:00:00Z</modified>
    <unit name="{unit}" meter="{metres}"/>
    <up_axis>{up}</up_axis>
  </asset>
"#,
        tool = TOOL,
        title = escape(title),
        metres = decimal(&asset.unit),
    )
}

/// The angle is written with nine decimals: what the last bits of an arctangent are is the platform's affair.
fn lens((index, camera): (usize, &Camera)) -> String {
    format!(
        r#"    <camera id="lens-{index}">
      <optics>
        <technique_common>
          <perspective>
            <yfov>{}</yfov>
            <aspect_ratio>{}</aspect_ratio>
            <znear>0.01</znear>
            <zfar>10000</zfar>
          </perspective>
        </technique_common>
      </optics>
    </camera>
"#,
        angle(camera.vertical_fov),
        decimal(&camera.aspect)
    )
}

/// Radians in degrees, to eleven digits: 45 stays 45, the smallest angle is not 0, the largest not 180.
fn angle(radians: f64) -> String {
    let rounded = format!("{:.10e}", radians.to_degrees().min(179.999_999_99));
    decimal(&rounded.parse().expect("a number"))
}

/// A matrix, row by row, since not every program reads `<lookat>`: a camera looks along its −z with y up.
fn view((index, camera): (usize, &Camera)) -> String {
    let back = -camera.direction.normalize();
    let right = camera.up.cross(back).normalize();
    let axes = [right, back.cross(right), back, camera.position];
    let row = |axis: usize| list(axes.map(|column| decimal(&column[axis])).iter());
    format!(
        r##"      <node id="camera-{index}" name="{name}">
        <matrix>{}  {}  {}  0 0 0 1</matrix>
        <instance_camera url="#lens-{index}"/>
      </node>
"##,
        row(0),
        row(1),
        row(2),
        name = escape(&camera.name),
    )
}

/// A texture's picture, its bytes in the file itself, in hexadecimal digits, as COLLADA 1.4 has it.
fn image(material: &Material) -> Option<String> {
    let Texture { image, .. } = material.texture.as_ref()?;
    let digits = hex(&image.bytes);
    let (id, name, kind) =
        (&material.name, escape(&image.name), image.mime.trim_start_matches("image/").to_uppercase());
    Some(format!(
        "    <image id=\"{id}-image\" name=\"{name}\" format=\"{kind}\"><data>{digits}</data></image>\n"
    ))
}

fn effect(material: &Material, wavelengths: &[f64]) -> String {
    let name = &material.name;
    let [reflectance, emission] = material.colours(wavelengths);
    let (parameters, diffuse) = match &material.texture {
        None => (String::new(), color(reflectance)),
        Some(texture) => (sampler(name), shown(name, texture)),
    };
    format!(
        r#"    <effect id="{name}-effect">
      <profile_COMMON>
{parameters}        <technique sid="common">
          <lambert>
            <emission>{emission}</emission>
            <diffuse>{diffuse}</diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
{spectra}    </effect>
"#,
        emission = color(emission),
        spectra = spectra(material, wavelengths),
    )
}

/// A picture, with what its colours are multiplied by.
fn shown(name: &str, Texture { factor, .. }: &Texture) -> String {
    let of = format!(r#"<texture texture="{name}-sampler" texcoord="UV""#);
    if *factor == [1.0; 3] {
        return format!("{of}/>");
    }
    let factor = list(factor.iter().map(decimal));
    format!(
        r#"{of}><extra><technique profile="{PROFILE}"><factor>{factor}</factor></technique></extra></texture>"#
    )
}

/// The values of bands that are not red, green and blue.
fn spectra(material: &Material, wavelengths: &[f64]) -> String {
    if material.reflectance.len() == 3 && wavelengths.is_empty() {
        return String::new();
    }
    let [reflectance, emission] =
        [&material.reflectance, &material.emission].map(|bands| list(bands.iter().map(decimal)));
    format!(
        r#"      <extra>
        <technique profile="{PROFILE}">
          <reflectance>{reflectance}</reflectance>
          <emission>{emission}</emission>
        </technique>
      </extra>
"#
    )
}

fn wavelengths(wavelengths: &[f64]) -> String {
    if wavelengths.is_empty() {
        return String::new();
    }
    let numbers = list(wavelengths.iter().map(decimal));
    format!(
        "  <extra>\n    <technique profile=\"{PROFILE}\">\n      <wavelengths>{numbers}</wavelengths>\n    </technique>\n  \
         </extra>\n"
    )
}

fn color(rgb: [f64; 3]) -> String {
    format!("<color>{} 1</color>", list(rgb.iter().map(decimal)))
}

/// The parameters through which a texture names its image.
fn sampler(name: &str) -> String {
    format!(
        r#"        <newparam sid="{name}-surface"><surface type="2D"><init_from>{name}-image</init_from></surface></newparam>
        <newparam sid="{name}-sampler"><sampler2D><source>{name}-surface</source></sampler2D></newparam>
"#
    )
}

fn material(material: &Material) -> String {
    let name = &material.name;
    format!(
        "    <material id=\"{name}\" name=\"{name}\"><instance_effect url=\"#{name}-effect\"/></material>\n"
    )
}

fn node(index: usize, face: &Face, material: &Material) -> String {
    let bound = match &material.texture {
        None => "/>",
        Some(_) => {
            "><bind_vertex_input semantic=\"UV\" input_semantic=\"TEXCOORD\" input_set=\"0\"/></instance_material>"
        }
    };
    format!(
        r##"      <node id="node-{index}" name="{name}">
        <instance_geometry url="#mesh-{index}">
          <bind_material>
            <technique_common>
              <instance_material symbol="{material}" target="#{material}"{bound}
            </technique_common>
          </bind_material>
        </instance_geometry>
      </node>
"##,
        name = escape(&face.name),
        material = material.name
    )
}

fn geometry(index: usize, face: &Face, material: &Material) -> String {
    let (points, numbers) = points(face);
    let places = face.texture.as_ref().or(material.texture.as_ref()).map(|texture| {
        let place = |point: &DVec3| texture.place(*point);
        // COLLADA counts from the lower left corner.
        points.iter().map(place).map(|place| vec![place.x, 1.0 - place.y]).collect::<Vec<_>>()
    });
    let id = format!("mesh-{index}");
    let rows: Vec<Vec<f64>> = points.iter().map(|point| point.to_array().to_vec()).collect();
    let texcoords = places.map(|places| source(&format!("{id}-places"), &["S", "T"], &places));
    let textured = texcoords.is_some();
    format!(
        r##"    <geometry id="{id}" name="{name}">
      <mesh>
{positions}{texcoords}        <vertices id="{id}-vertices">
          <input semantic="POSITION" source="#{id}-positions"/>
        </vertices>
{primitive}      </mesh>
    </geometry>
"##,
        name = escape(&face.name),
        positions = source(&format!("{id}-positions"), &["X", "Y", "Z"], &rows),
        texcoords = texcoords.unwrap_or_default(),
        primitive = primitive(&id, face, &material.name, &numbers, textured),
    )
}

fn source(id: &str, names: &[&str], rows: &[Vec<f64>]) -> String {
    let parameters =
        names.iter().map(|name| format!("              <param name=\"{name}\" type=\"float\"/>\n"));
    let row = |row: &Vec<f64>| format!("            {}\n", list(row.iter().map(decimal)));
    format!(
        r##"        <source id="{id}">
          <float_array id="{id}-array" count="{count}">
{rows}          </float_array>
          <technique_common>
            <accessor source="#{id}-array" count="{points}" stride="{stride}">
{parameters}            </accessor>
          </technique_common>
        </source>
"##,
        count = rows.len() * names.len(),
        points = rows.len(),
        stride = names.len(),
        rows = rows.iter().map(row).collect::<String>(),
        parameters = parameters.collect::<String>(),
    )
}

/// The face's different points, in the order of their first use, and the number of each.
fn points(face: &Face) -> (Vec<DVec3>, HashMap<[u64; 3], usize>) {
    let (mut points, mut numbers) = (Vec::new(), HashMap::new());
    for point in face.polygons.iter().flatten().flatten() {
        numbers.entry(bits(point)).or_insert_with(|| {
            points.push(*point);
            points.len() - 1
        });
    }
    (points, numbers)
}

/// A point as a key; −0 and 0 are one.
fn bits(point: &DVec3) -> [u64; 3] {
    point.to_array().map(|number| (number + 0.0).to_bits())
}

/// A polygon list, or polygons where one has holes.
fn primitive(
    id: &str,
    face: &Face,
    material: &str,
    numbers: &HashMap<[u64; 3], usize>,
    textured: bool,
) -> String {
    let indices = |ring: &Vec<DVec3>| list(ring.iter().map(|point| numbers[&bits(point)]));
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
    let places = if textured {
        format!("          <input semantic=\"TEXCOORD\" source=\"#{id}-places\" offset=\"0\" set=\"0\"/>\n")
    } else {
        String::new()
    };
    format!(
        r##"        <{tag} material="{material}" count="{count}">
          <input semantic="VERTEX" source="#{id}-vertices" offset="0"/>
{places}{body}        </{tag}>
"##,
        count = face.polygons.len(),
    )
}

fn with_holes(polygon: &[Vec<DVec3>], indices: impl Fn(&Vec<DVec3>) -> String) -> String {
    let outline = indices(&polygon[0]);
    let holes: String = polygon[1..].iter().map(|hole| format!("<h>{}</h>", indices(hole))).collect();
    format!("          <ph><p>{outline}</p>{holes}</ph>\n")
}
