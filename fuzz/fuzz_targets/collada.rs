//! Any text as a COLLADA file, or a file of any numbers: a scene or a typed error; a scene whose numbers can be used, and
//! that is the same when it is written and read.
#![no_main]
use arbitrary::Arbitrary;
use fuzz::{survives_repair, survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::{Source, collada::Collada};

#[derive(Arbitrary, Debug)]
enum Input<'a> {
    Text(&'a str),
    File { transforms: Vec<Transform>, shape: Shape, points: Vec<Number>, colours: [Number; 8], name: String },
}

/// Small whole numbers, so that polygons are likely; any number now and then.
#[derive(Arbitrary, Debug)]
enum Number {
    Whole(i8),
    Tenth(i8),
    Any(f64),
}

#[derive(Arbitrary, Debug)]
enum Transform {
    Translate([Number; 3]),
    Scale([Number; 3]),
    Rotate([Number; 4]),
    Matrix([Number; 12]),
    Lookat([Number; 9]),
}

#[derive(Arbitrary, Debug)]
enum Shape {
    Polylist(Vec<Vec<u8>>),
    Polygons(Vec<Vec<Vec<u8>>>),
    Triangles(Vec<u8>),
    Strips(Vec<Vec<u8>>),
    Fans(Vec<Vec<u8>>),
}

fuzz_target!(|input: Input| {
    let text = match input {
        Input::Text(text) => text.to_owned(),
        Input::File { transforms, shape, points, colours, name } => {
            file(&transforms, &shape, &points, &colours, &name)
        }
    };
    let file = Collada::from_text("fuzz.dae", &text);
    match within_memory(text.len(), || file.scene()) {
        Err(e) => assert!(e.to_string().contains("fuzz.dae"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
                // More than 1 comes through: `inspect` names it, and `repair` limits it.
                let numbers = patch.reflectance.iter().chain(&patch.emission);
                assert!(numbers.clone().all(|r| r.is_finite() && *r >= 0.0), "{}: nonsense", patch.name);
            }
            survives_writing(&scene);
            survives_repair(&Source::Collada(file), &scene);
        }
    }
});

/// One geometry in one node.
fn file(
    transforms: &[Transform],
    shape: &Shape,
    points: &[Number],
    colours: &[Number; 8],
    name: &str,
) -> String {
    let points = &points[..points.len() / 3 * 3];
    let name = name.replace(['"', '&', '<'], "_");
    format!(
        r##"<COLLADA version="1.4.1"><library_effects><effect id="e"><profile_COMMON><technique sid="c"><lambert>
<emission><color>{emission}</color></emission><diffuse><color>{diffuse}</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="{numbers}">{list}</float_array>
<technique_common><accessor source="#a" count="{count}" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
{primitive}</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node name="{name}">{transforms}<instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"##,
        emission = list(&colours[..4]),
        diffuse = list(&colours[4..]),
        numbers = points.len(),
        list = list(points),
        count = points.len() / 3,
        primitive = primitive(shape),
        transforms = transforms.iter().map(transform).collect::<String>(),
    )
}

fn list(numbers: &[Number]) -> String {
    let word = |number: &Number| match number {
        Number::Whole(n) => n.to_string(),
        Number::Tenth(n) => format!("{:e}", f64::from(*n) / 10.0),
        Number::Any(x) => x.to_string(),
    };
    numbers.iter().map(word).collect::<Vec<_>>().join(" ")
}

fn transform(transform: &Transform) -> String {
    let (tag, numbers) = match transform {
        Transform::Translate(numbers) => ("translate", list(numbers)),
        Transform::Scale(numbers) => ("scale", list(numbers)),
        Transform::Rotate(numbers) => ("rotate", list(numbers)),
        Transform::Matrix(numbers) => ("matrix", list(numbers) + " 0 0 0 1"),
        Transform::Lookat(numbers) => ("lookat", list(numbers)),
    };
    format!("<{tag}>{numbers}</{tag}>")
}

fn primitive(shape: &Shape) -> String {
    let words = |indices: &Vec<u8>| indices.iter().map(u8::to_string).collect::<Vec<_>>().join(" ");
    let runs =
        |all: &Vec<Vec<u8>>| all.iter().map(|run| format!("<p>{}</p>", words(run))).collect::<String>();
    let (tag, body) = match shape {
        Shape::Polylist(polygons) => {
            let counts: Vec<String> = polygons.iter().map(|polygon| polygon.len().to_string()).collect();
            ("polylist", format!("<vcount>{}</vcount><p>{}</p>", counts.join(" "), words(&polygons.concat())))
        }
        Shape::Polygons(polygons) => {
            let hole = |ring: &Vec<u8>| format!("<h>{}</h>", words(ring));
            let holed = |rings: &Vec<Vec<u8>>| {
                let outline = rings.first().map(words).unwrap_or_default();
                format!("<ph><p>{outline}</p>{}</ph>", rings.iter().skip(1).map(hole).collect::<String>())
            };
            ("polygons", polygons.iter().map(holed).collect())
        }
        Shape::Triangles(indices) => ("triangles", format!("<p>{}</p>", words(indices))),
        Shape::Strips(all) => ("tristrips", runs(all)),
        Shape::Fans(all) => ("trifans", runs(all)),
    };
    format!(
        r##"<{tag} material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/>{body}</{tag}>"##
    )
}
