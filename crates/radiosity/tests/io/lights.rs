//! Lights of COLLADA and glTF files.
use crate::samples::{file, node, refusal, scene};
use radiosity::glam::DVec3;
use radiosity::io::collada::Collada;
use radiosity::io::gltf::Gltf;
use radiosity::{Cone, Distribution, Lamp, Rim, Scene, Sun, Units};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// A file with a light, at (1, 2, 3), turned to shine along +x.
fn lit(light: &str, extra: &str) -> String {
    let library = format!(
        r#"<library_lights><light id="l"><technique_common>{light}</technique_common>{extra}</light></library_lights>"#
    );
    let lamp = r##"<node id="n" name="lamp"><matrix>0 0 -5 1  0 5 0 2  5 0 0 3  0 0 0 1</matrix><instance_light url="#l"/></node>"##;
    file(&library, &format!("{}{lamp}", node("square", "", "square")))
}

fn blender(fields: &str) -> String {
    format!(r#"<extra><technique profile="blender">{fields}</technique></extra>"#)
}

fn cone(lamp: &Lamp) -> Cone {
    let Distribution::Cone(cone) = lamp.distribution else { panic!("{lamp:?}") };
    cone
}

#[test]
fn points_and_suns_are_where_their_nodes_put_them() {
    let read = scene(&lit("<point><color>1 2 4</color></point>", ""));
    let lamp = &read.lamps[0];
    assert_eq!((lamp.name.as_str(), lamp.position), ("lamp", DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(lamp.intensity, [1.0, 2.0, 4.0]);
    assert!(matches!(lamp.distribution, Distribution::Even));
    assert_eq!(read.warnings.len(), 1, "no unit: {:?}", read.warnings);
    let read = scene(&lit("<directional><color>1 2 4</color></directional>", ""));
    assert_eq!(
        (read.suns[0].direction, read.suns[0].irradiance.as_slice()),
        (DVec3::X, &[1.0, 2.0, 4.0][..])
    );
}

#[test]
fn an_attenuation_by_the_square_alone_is_in_the_files_unit() {
    let light = "<point><color>8 8 8</color><constant_attenuation>0</constant_attenuation><quadratic_attenuation>2</quadratic_attenuation></point>";
    let found = scene(&lit(light, "")).lamps[0].intensity[0];
    assert!((found / (4.0 * 0.0254 * 0.0254) - 1.0).abs() < 1e-12);
}

#[test]
fn a_spot_has_a_cone_and_a_power() {
    let light = "<spot><color>1 1 1</color><falloff_angle>60</falloff_angle><falloff_exponent>2</falloff_exponent></spot>";
    let Cone { exponent, inner, outer, .. } = cone(&scene(&lit(light, "")).lamps[0]);
    assert_eq!((exponent, inner), (2.0, outer));
    assert!((outer - 0.75f64.sqrt()).abs() < 1e-12);
}

#[test]
fn blender_counts_in_watts() {
    let point = scene(&lit("<point><color>100 50 0</color></point>", &blender("<type>0</type>")));
    assert!(point.warnings.is_empty(), "{:?}", point.warnings);
    assert!((point.lamps[0].power()[0] - 100.0).abs() < 1e-12);
    assert!((point.lamps[0].intensity[1] - 50.0 / (4.0 * PI)).abs() < 1e-12);
    let sun = scene(&lit("<directional><color>3 3 3</color></directional>", &blender("<type>1</type>")));
    assert_eq!(sun.suns[0].irradiance, [3.0; 3]);
    let spot = "<spot><color>4 4 4</color><falloff_angle>90</falloff_angle></spot>";
    let spot = scene(&lit(spot, &blender("<type>2</type><spotblend>0.5</spotblend>")));
    let Cone { inner, outer, rim, .. } = cone(&spot.lamps[0]);
    assert!((outer - 0.5f64.sqrt()).abs() < 1e-12 && (inner - (1.0 + outer) / 2.0).abs() < 1e-12);
    assert_eq!(rim, Rim::Smooth);
}

#[test]
fn an_area_light_of_blender_is_a_surface_that_shines_ahead() {
    let sizes =
        "<type>4</type><area_shape>1</area_shape><area_size>0.2</area_size><area_sizey>0.1</area_sizey>";
    let read = scene(&lit("<point><color>100 100 100</color></point>", &blender(sizes)));
    assert!(read.lamps.is_empty() && read.warnings.is_empty());
    let lamp = &read.patches[1];
    assert_eq!((lamp.name.as_str(), lamp.polygon.normal()), ("lamp", DVec3::X));
    // The node is five times as large, in inches.
    let area = 25.0 * 0.02;
    assert!((lamp.polygon.area() - area).abs() < 1e-12);
    assert!((lamp.emission[0] * 4.0 * area * 0.0254 * 0.0254 - 100.0).abs() < 1e-9);
    let disk = "<type>4</type><area_shape>4</area_shape><area_size>0.2</area_size>";
    let disk = scene(&lit("<point><color>1 1 1</color></point>", &blender(disk)));
    assert!((disk.patches[1].polygon.area() - 25.0 * PI * 0.01).abs() < 1e-9);
    // The result is written into the same file, which has no geometry of the lamp.
    let text = lit("<point><color>100 100 100</color></point>", &blender(sizes));
    let source = Collada::from_text("test.dae", text);
    let mesh = crate::samples::fans(&read);
    let colours = vec![[1.0; 3]; mesh.vertices.len()];
    assert!(source.with_light(&read, &mesh, &colours).unwrap().contains("area_sizey"));
}

#[test]
fn lights_without_light_say_nothing_and_ambient_ones_are_left_out() {
    assert!(scene(&lit("<ambient><color>0 0 0</color></ambient>", "")).warnings.is_empty());
    let ambient = scene(&lit("<ambient><color>1 0 0</color></ambient>", ""));
    assert!(!ambient.has_light() && ambient.warnings[0].what.contains("a light of kind ambient is left out"));
    assert!(refusal(&lit("<point><color>1 -2 3</color></point>", "")).contains("the colour -2 is negative"));
    assert!(
        refusal(&lit("<point><color>1 2</color></point>", "")).contains("2 values stand where 3 are needed")
    );
    let flat = lit("<point><color>1 2 3</color></point>", "").replace("0 0 -5 1", "0 0 0 1");
    assert!(scene(&flat).lamps.is_empty());
}

#[test]
fn lights_are_the_same_when_they_are_written_and_read() {
    let turned = scene(&lit("<point><color>1 2 4</color></point>", "")).lamps[0].frame;
    let cone = Cone { exponent: 1.5, inner: 0.9, outer: 0.1, rim: Rim::Smooth };
    let lamp = |name: &str, distribution| Lamp {
        name: name.into(),
        position: DVec3::new(0.1, 0.2, 0.3),
        frame: turned,
        distribution,
        intensity: vec![0.1, 0.2, 0.3],
    };
    let sun =
        Sun { name: "sun".into(), direction: DVec3::new(0.0, 0.6, -0.8), irradiance: vec![7.0, 8.0, 9.0] };
    let written = Scene {
        lamps: vec![lamp("even", Distribution::Even), lamp("cone", Distribution::Cone(cone))],
        suns: vec![sun.clone()],
        ..scene(&file("", &node("square", "", "square")))
    };
    let read = Collada::of(&written).scene().unwrap();
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    for (a, b) in written.lamps.iter().zip(&read.lamps) {
        assert_eq!((&a.name, a.position, &a.intensity), (&b.name, b.position, &b.intensity));
        assert!(a.frame.abs_diff_eq(b.frame, 1e-15));
        assert_eq!(format!("{:?}", a.distribution), format!("{:?}", b.distribution));
    }
    assert!(read.suns[0].direction.abs_diff_eq(sun.direction, 1e-15));
    assert_eq!(read.suns[0].irradiance, sun.irradiance);
}

/// (0, 0, 0), (1, 0, 0) and (0, 1, 0) in single precision.
const TRIANGLE: &str =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

/// The scene of a document of lights alone, all at (0, 0, 5).
fn gltf(generator: &str, lights: &Value) -> Scene {
    source(generator, lights).scene().unwrap()
}

fn source(generator: &str, lights: &Value) -> Gltf {
    let count = lights.as_array().unwrap().len();
    let node = |light: usize| json!({"name": format!("light {light}"), "translation": [0, 0, 5], "extensions": {"KHR_lights_punctual": {"light": light}}});
    let document = json!({
        "asset": {"version": "2.0", "generator": generator},
        "scenes": [{"nodes": (0..count).collect::<Vec<_>>()}],
        "nodes": (0..count).map(node).collect::<Vec<_>>(),
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": lights}},
    });
    Gltf::from_bytes("test.gltf", document.to_string())
}

#[test]
fn punctual_lights_of_gltf_are_photometric() {
    let lights = json!([
        {"type": "point", "color": [1, 0.5, 0], "intensity": 8},
        {"type": "directional", "intensity": 100},
        {"type": "spot", "intensity": 4, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
    ]);
    let read = gltf("by hand", &lights);
    assert_eq!(read.units, Units::Luminous);
    assert_eq!((read.lamps[0].intensity.as_slice(), read.lamps[0].position.z), (&[8.0, 4.0, 0.0][..], 5.0));
    assert_eq!((read.suns[0].irradiance[0], read.suns[0].direction), (100.0, DVec3::NEG_Z));
    let Cone { inner, outer, rim, .. } = cone(&read.lamps[1]);
    assert!((inner - 0.25f64.cos()).abs() < 1e-7 && (outer - 0.5f64.cos()).abs() < 1e-7);
    assert_eq!((rim, read.lamps[1].frame.z_axis), (Rim::Squared, DVec3::NEG_Z));
    assert!((read.luminous(&[1.0; 3]) - 1.0).abs() < 1e-12);
}

/// 100 W as Blender writes them by default; the file does not say that it is so.
#[test]
fn lights_of_blender_are_candela_and_a_note_says_what_else_they_may_be() {
    let candela = 683.0 * 100.0 / (4.0 * PI);
    let read = gltf("Khronos glTF Blender I/O v4.2.57", &json!([{"type": "point", "intensity": candela}]));
    assert_eq!(read.units, Units::Luminous);
    assert!((read.luminous(&read.lamps[0].intensity) - candela).abs() < 1e-2);
    assert_eq!(read.warnings.len(), 1, "{:?}", read.warnings);
    let note = read.warnings[0].to_string();
    assert!(note.contains("683 lm") && note.contains("Unitless"), "{note}");
    assert!(gltf("by hand", &json!([{"type": "point", "intensity": 1}])).warnings.is_empty());
}

/// A triangle that emits, beside lights or without any.
#[test]
fn what_surfaces_emit_beside_lights_of_blender_is_in_their_units() {
    let of = |generator: &str, has_lights: bool| {
        let lights = json!({"lights": if has_lights { json!([{"type": "point"}]) } else { json!([]) }});
        let node = if has_lights { json!({"KHR_lights_punctual": {"light": 0}}) } else { json!({}) };
        let document = json!({
            "asset": {"version": "2.0", "generator": generator},
            "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0}, {"extensions": node}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [{"emissiveFactor": [1, 0.5, 0]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": TRIANGLE}],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": lights},
        });
        Gltf::from_bytes("test.gltf", document.to_string()).scene().unwrap().patches[0].emission.clone()
    };
    assert_eq!(of("Khronos glTF Blender I/O v4.2.57", true), [683.0, 341.5, 0.0]);
    assert_eq!(of("Khronos glTF Blender I/O v4.2.57", false), [1.0, 0.5, 0.0]);
    assert_eq!(of("by hand", true), [1.0, 0.5, 0.0]);
}

/// The message about a light that is refused.
fn refused(light: Value) -> String {
    source("by hand", &json!([{"type": "point"}, light])).scene().unwrap_err().to_string()
}

#[test]
fn lights_that_no_lamp_has_are_refused_with_their_place() {
    let dark = refused(json!({"type": "point", "intensity": -3}));
    assert!(dark.contains("light 1: the intensity -3 is negative"), "{dark}");
    let red = refused(json!({"type": "point", "color": [1, -0.5, 1]}));
    assert!(red.contains("light 1: the colour -0.5 is negative"), "{red}");
    let wide = refused(json!({"type": "spot", "spot": {"innerConeAngle": 0, "outerConeAngle": 4}}));
    assert!(wide.contains("light 1: the angle 229.1"), "{wide}");
    let kind = refused(json!({"type": "area"}));
    assert!(kind.contains("extensions.KHR_lights_punctual.lights[1].type: Invalid value \"area\""), "{kind}");
}

#[test]
fn an_inner_cone_that_is_wider_than_the_outer_one_is_noted() {
    let spot = json!([{"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.25}}]);
    let read = gltf("by hand", &spot);
    let Cone { inner, outer, .. } = cone(&read.lamps[0]);
    assert!((outer - 0.25f64.cos()).abs() < 1e-7 && inner > outer && inner < outer + 2e-3);
    let note = &read.warnings[0];
    assert!(note.places == ["light 0"] && note.what.contains("inner cone is wider"), "{note}");
}

#[test]
fn an_attenuation_is_the_intensity_at_a_metre_and_falls_by_the_square() {
    let light = |attenuation: &str| {
        let point = format!("<point><color>8 8 8</color>{attenuation}</point>");
        let read = scene(&lit(&point, ""));
        (read.lamps[0].intensity[0], read.warnings.iter().any(|note| note.what.contains("at a metre")))
    };
    assert_eq!(light(""), (8.0, false));
    let metre = 1.0 / 0.0254;
    for [constant, linear, square] in [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.5, 0.25, 0.125], [2.0, 0.0, 0.0]]
    {
        let (found, is_told) = light(&format!(
            "<constant_attenuation>{constant}</constant_attenuation><linear_attenuation>{linear}</linear_attenuation>\
             <quadratic_attenuation>{square}</quadratic_attenuation>"
        ));
        let right = 8.0 / (constant + linear * metre + square * metre * metre);
        assert!((found / right - 1.0).abs() < 1e-12 && is_told, "{constant} {linear} {square}: {found}");
    }
    let square =
        "<constant_attenuation>0</constant_attenuation><quadratic_attenuation>2</quadratic_attenuation>";
    assert!(!light(square).1);
    let negative = "<point><color>1 1 1</color><linear_attenuation>-1</linear_attenuation></point>";
    assert!(refusal(&lit(negative, "")).contains("<linear_attenuation>: the number -1 is negative"));
}

#[test]
fn a_spot_of_an_impossible_angle_is_refused() {
    for angle in ["-1", "180.5", "400"] {
        let spot = format!("<spot><color>1 1 1</color><falloff_angle>{angle}</falloff_angle></spot>");
        let refused = refusal(&lit(&spot, ""));
        assert!(refused.contains(&format!("<falloff_angle>: the angle {angle} is not between")), "{refused}");
    }
    let spot = "<spot><color>1 1 1</color><falloff_exponent>-2</falloff_exponent></spot>";
    assert!(refusal(&lit(spot, "")).contains("<falloff_exponent>: the number -2 is negative"));
}

/// One scene of Blender, written by it in both formats: lamps of 60 and 80 W, a sun of 2 W/m²; 683 lm for each W in glTF.
#[test]
fn blender_gives_the_same_lamps_in_both_formats() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/exported");
    let open = |name: &str| radiosity::io::Source::open(folder.join(name)).unwrap().scene().unwrap();
    let [dae, glb] = ["blender-lights.dae", "blender-lights.glb"].map(open);
    assert_eq!(
        [&dae, &glb].map(|scene| (scene.lamps.len(), scene.suns.len(), scene.units)),
        [(2, 1, Units::Radiant), (2, 1, Units::Luminous)]
    );
    for (name, power) in [("point", 60.0), ("spot", 80.0)] {
        let [a, b] = [&dae, &glb].map(|scene| scene.lamps.iter().find(|lamp| lamp.name == name).unwrap());
        assert!((a.intensity[0] - power / (4.0 * PI)).abs() < 1e-9, "{name}: {:?}", a.intensity);
        assert!((b.intensity[0] / a.intensity[0] - 683.0).abs() < 1.0, "{name}: {:?}", b.intensity);
        // One file has z up, the other y.
        let turned = DVec3::new(a.position.x, a.position.z, -a.position.y);
        assert!(turned.distance(b.position) < 1e-5, "{name}: {turned} {}", b.position);
    }
    let outer =
        [&dae, &glb].map(|scene| cone(scene.lamps.iter().find(|lamp| lamp.name == "spot").unwrap()).outer);
    assert!((outer[0] - 0.5f64.cos()).abs() < 1e-6 && (outer[1] - outer[0]).abs() < 1e-6, "{outer:?}");
    assert!((dae.suns[0].irradiance[0] - 2.0).abs() < 1e-3);
    assert!((glb.suns[0].irradiance[0] - 2.0 * 683.0).abs() < 1.0, "{:?}", glb.suns[0]);
    let area = dae.patches.iter().find(|patch| patch.name == "area").unwrap();
    assert!((area.polygon.area() * area.emission[0] - 10.0).abs() < 1e-6, "{:?}", area.emission);
}
