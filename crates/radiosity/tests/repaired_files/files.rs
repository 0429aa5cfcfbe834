//! Nodes as files: COLLADA in doubles, of polygons, and glTF in single precision, of triangles.
use super::shapes::Node;
use base64::{Engine, engine::general_purpose::STANDARD};
use radiosity::glam::DVec3;
use serde_json::{Value, json};

fn words(numbers: impl IntoIterator<Item = f64>) -> String {
    numbers.into_iter().map(|number| format!("{number:?} ")).collect()
}

/// The normal of the plane of an outline, at each of its corners.
fn normals(mesh: &[Vec<DVec3>]) -> Vec<DVec3> {
    let normal = |outline: &Vec<DVec3>| {
        let spokes: Vec<DVec3> = outline.iter().map(|point| *point - outline[0]).collect();
        spokes.windows(2).map(|pair| pair[0].cross(pair[1])).sum::<DVec3>().normalize_or_zero()
    };
    mesh.iter().flat_map(|outline| vec![normal(outline); outline.len()]).collect()
}

fn source(id: &str, rows: &[DVec3]) -> String {
    let (count, numbers) = (rows.len(), words(rows.iter().flat_map(DVec3::to_array)));
    format!(
        r##"<source id="{id}"><float_array id="{id}a" count="{}">{numbers}</float_array>
<technique_common><accessor source="#{id}a" count="{count}" stride="3"/></technique_common></source>"##,
        3 * count
    )
}

/// With double-sided materials, one for each node, or without. Every second mesh has its normals at the polygons' corners, the others at
/// their vertices.
pub(crate) fn collada(nodes: &[Node], two_sided: bool) -> Vec<u8> {
    let (mut materials, mut geometries, mut placed) = (String::new(), String::new(), String::new());
    let flag = u8::from(two_sided);
    for (k, Node { pose, mesh }) in nodes.iter().enumerate() {
        let points: Vec<DVec3> = mesh.iter().flatten().copied().collect();
        let (count, counts) =
            (points.len(), mesh.iter().map(|outline| format!("{} ", outline.len())).collect::<String>());
        let corners: String = (0..count)
            .map(|corner| if k % 2 == 0 { format!("{corner} ") } else { format!("{corner} {corner} ") })
            .collect();
        let normals = source(&format!("n{k}"), &normals(mesh));
        let at = if k % 2 == 0 { "" } else { r#" offset="1""# };
        let input = format!(r##"<input semantic="NORMAL" source="#n{k}"{at}/>"##);
        let [of_vertices, of_corners] = if k % 2 == 0 { [input.as_str(), ""] } else { ["", &input] };
        let positions = source(&format!("p{k}"), &points);
        geometries += &format!(
            r##"<geometry id="g{k}"><mesh>{positions}{normals}
<vertices id="v{k}"><input semantic="POSITION" source="#p{k}"/>{of_vertices}</vertices>
<polylist material="s" count="{}"><input semantic="VERTEX" source="#v{k}" offset="0"/>{of_corners}<vcount>{counts}</vcount><p>{corners}</p></polylist></mesh></geometry>"##,
            mesh.len()
        );
        materials += &format!(
            r##"<effect id="e{k}"><profile_COMMON><technique sid="t"><lambert><diffuse><color>0.5 0.5 0.5 1</color></diffuse></lambert></technique>
<extra><technique profile="GOOGLEEARTH"><double_sided>{flag}</double_sided></technique></extra></profile_COMMON></effect>"##
        );
        let matrix = words(pose.transpose().to_cols_array());
        placed += &format!(
            r##"<node name="n{k}"><matrix>{matrix}</matrix><instance_geometry url="#g{k}"><bind_material><technique_common>
<instance_material symbol="s" target="#m{k}"/></technique_common></bind_material></instance_geometry></node>"##
        );
    }
    let material =
        |k| format!(r##"<material id="m{k}" name="m{k}"><instance_effect url="#e{k}"/></material>"##);
    let bound: String = (0..nodes.len()).map(material).collect();
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_effects>{materials}</library_effects>
<library_materials>{bound}</library_materials><library_geometries>{geometries}</library_geometries>
<library_visual_scenes><visual_scene id="s">{placed}</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"##
    ).into_bytes()
}

/// The same in single precision, of triangles.
pub(crate) fn gltf(nodes: &[Node], two_sided: bool) -> Vec<u8> {
    let (mut bytes, mut accessors, mut views) = (Vec::new(), Vec::new(), Vec::new());
    for Node { mesh, .. } in nodes {
        for rows in [mesh.iter().flatten().copied().collect(), normals(mesh)] {
            let start = bytes.len();
            let numbers = rows.iter().flat_map(|row| row.as_vec3().to_array());
            numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
            accessors.push(
                json!({"bufferView": views.len(), "componentType": 5126, "count": rows.len(), "type": "VEC3"}),
            );
            views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len() - start}));
        }
        let start = bytes.len();
        let corners = fans(mesh);
        corners.iter().for_each(|corner| bytes.extend(corner.to_le_bytes()));
        accessors.push(
            json!({"bufferView": views.len(), "componentType": 5125, "count": corners.len(), "type": "SCALAR"}),
        );
        views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len() - start}));
    }
    let each = |value: &dyn Fn(usize) -> Value| (0..nodes.len()).map(value).collect::<Vec<_>>();
    let primitive = |k: usize| json!({"attributes": {"POSITION": 3 * k, "NORMAL": 3 * k + 1}, "indices": 3 * k + 2, "material": k});
    // What reflects all light is dimmed.
    let grey = |k: usize| if k == 2 { [1.0; 4] } else { [0.5, 0.5, 0.5, 1.0] };
    let document = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": each(&|k| k.into())}],
        "nodes": each(&|k| json!({"name": format!("n{k}"), "mesh": k, "matrix": nodes[k].pose.to_cols_array()})),
        "meshes": each(&|k| json!({"primitives": [primitive(k)]})),
        "materials": each(&|k| json!({"name": format!("m{k}"), "doubleSided": two_sided, "pbrMetallicRoughness": {"baseColorFactor": grey(k)}})),
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes))}],
    });
    document.to_string().into_bytes()
}

/// The corners of triangles that outlines are cut into, which are convex.
fn fans(mesh: &[Vec<DVec3>]) -> Vec<u32> {
    let (mut corners, mut first) = (Vec::new(), 0);
    for outline in mesh {
        let count = u32::try_from(outline.len()).unwrap();
        corners.extend((2..count).flat_map(|corner| [first, first + corner - 1, first + corner]));
        first += count;
    }
    corners
}
