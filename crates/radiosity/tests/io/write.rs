//! The file with light in it: what changes, what stays.
use crate::samples::{fans, file, geometry, instance, names, node, polylist, scene};
use radiosity::glam::DVec3;
use radiosity::io::collada::Collada;
use radiosity::{Camera, Mesh, Scene, scenes};

/// The text lit by fans of triangles, coloured by where their vertices are.
fn lit(text: &str) -> (Scene, String) {
    let before = scene(text);
    let mesh = fans(&before);
    let lit = Collada::from_text("test.dae", text).with_light(&before, &mesh, &colours(&mesh)).unwrap();
    (before, lit)
}

fn colours(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.vertices.iter().map(|point| point.to_array()).collect()
}

/// The area and area-weighted centroid of all patches with the same node name.
fn moments(scene: &Scene) -> Vec<(String, f64, DVec3)> {
    let mut all: Vec<(String, f64, DVec3)> = Vec::new();
    let mesh = fans(scene);
    for (index, element) in mesh.elements.iter().enumerate() {
        let name = scene.patches[element.patch].name.split('.').next().unwrap().to_owned();
        let (area, moment) = (mesh.area(index), mesh.area(index) * mesh.centroid(index));
        match all.iter_mut().find(|(known, ..)| *known == name) {
            Some((_, sum, centre)) => (*sum, *centre) = (*sum + area, *centre + moment),
            None => all.push((name, area, moment)),
        }
    }
    all
}

fn assert_same_surfaces(before: &Scene, after: &Scene) {
    let (before, after) = (moments(before), moments(after));
    assert_eq!(before.len(), after.len());
    for ((name, area, moment), (after_name, after_area, after_moment)) in before.into_iter().zip(after) {
        assert_eq!(name, after_name);
        assert!((area - after_area).abs() < 1e-12 * area, "{name}");
        assert!((moment - after_moment).length() < 1e-12 * (area + moment.length()), "{name}");
    }
}

#[test]
fn everything_outside_the_meshes_stays_byte_for_byte() {
    let odd = "<!-- déjà vu -->\r\n\t<extra  type='x' ><technique profile=\"p\"><a b = \"&lt;&#65;\"/></technique></extra>";
    let text = file(odd, &node("n", "<translate>1 2 3</translate>", "square"));
    let (_, lit) = lit(&text);
    let parts = |text: &str| {
        let (head, rest) = text.split_once("<mesh>").unwrap();
        let (_, tail) = rest.split_once("</mesh>").unwrap();
        (head.to_owned(), tail.to_owned())
    };
    let tool = format!(
        "<contributor><authoring_tool>radiosity {}</authoring_tool></contributor>",
        env!("CARGO_PKG_VERSION")
    );
    assert!(lit.contains(&tool));
    assert_eq!(parts(&text), parts(&lit.replace(&tool, "")));
}

#[test]
fn the_tool_that_made_the_file_is_named_in_place_of_an_older_one() {
    let asset =
        "<asset><contributor><author>A</author><authoring_tool>B &amp; C</authoring_tool></contributor>";
    let (_, lit) = lit(&file("", &node("n", "", "square")).replace("<asset>", asset));
    assert_eq!(lit.matches("<authoring_tool>").count(), 1);
    assert!(lit.contains("<author>A</author><authoring_tool>radiosity "));
}

#[test]
fn a_textured_surface_keeps_its_picture_and_where_it_lies() {
    let text = scenes::write_scene("chessboard").unwrap();
    let (before, lit) = lit(&text);
    let after = scene(&lit);
    only_light_is_left_out(&after);
    let [old, new] = [&before, &after].map(|scene| scene.patches[0].texture.clone().unwrap());
    assert_eq!(old.image.bytes, new.image.bytes);
    for point in [[0.3, -1.7, 0.0], [1.9, 1.2, 0.0], [-2.0, 2.0, 0.0]].map(DVec3::from) {
        assert!(old.place(point).distance(new.place(point)) < 1e-12);
    }
}

/// COLLADA has no word for it.
#[test]
fn a_picture_stays_as_dark_as_its_material_makes_it() {
    let mut before = scene(&scenes::write_scene("chessboard").unwrap());
    let factor = [0.3, 0.5, 0.25];
    before.patches[0].texture.as_mut().unwrap().factor = factor;
    let after = Collada::of(&before).scene().unwrap();
    assert_eq!(after.patches[0].texture.as_ref().unwrap().factor, factor);
}

#[test]
fn a_written_file_reads_back_with_the_same_surfaces() {
    let cube = geometry(
        "cube",
        "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1",
        &polylist("cube", "4 4 4 4 4 4", "0 3 2 1  4 5 6 7  0 1 5 4  1 2 6 5  2 3 7 6  3 0 4 7"),
    );
    let library = format!("<library_geometries>{cube}</library_geometries>");
    let transforms = "<translate>3 2 1</translate><rotate>1 2 3 40</rotate><scale>-1 2 3</scale>";
    let text = file(&library, &format!("{}{}", node("c", transforms, "cube"), node("s", "", "square")));
    let (before, lit) = lit(&text);
    let after = scene(&lit);
    only_light_is_left_out(&after);
    assert_same_surfaces(&before, &after);
    for patch in &after.patches {
        assert_eq!(patch.reflectance, before.patches[0].reflectance);
    }
    let normals =
        |scene: &Scene| scene.patches.iter().map(|patch| patch.polygon.normal()).collect::<Vec<_>>();
    for (index, normal) in normals(&after).into_iter().enumerate().take(12) {
        assert!((normal - normals(&before)[index / 2]).length() < 1e-12);
    }
}

#[test]
fn materials_stay_with_their_triangles() {
    let two = polylist("g", "3", "0 1 2")
        + &polylist("g", "3", "0 2 3").replace("material=\"m\"", "material=\"n\"");
    let library = format!(
        "<library_geometries>{}</library_geometries>",
        geometry("g", "0 0 0 1 0 0 1 1 0 0 1 0", &two)
    );
    let bound = instance("g", "grey").replace(
        "</technique_common>",
        "<instance_material symbol=\"n\" target=\"#lamp\"/></technique_common>",
    );
    let (before, lit) = lit(&file(&library, &format!("<node name=\"n\">{bound}</node>")));
    let after = scene(&lit);
    let emission =
        |scene: &Scene| scene.patches.iter().map(|patch| patch.emission.clone()).collect::<Vec<_>>();
    assert_eq!(emission(&before), [vec![0.0; 3], vec![1.0, 2.0, 3.0]]);
    assert_eq!(emission(&before), emission(&after));
}

#[test]
fn a_geometry_of_several_nodes_gets_a_copy_for_each() {
    let nodes: String = (0..4)
        .map(|i| node(&format!("n{i}"), &format!("<translate>{i} 0 0</translate>"), "square"))
        .collect();
    let (before, lit) = lit(&file("", &nodes));
    assert_eq!(lit.matches("<geometry ").count(), 4);
    assert_same_surfaces(&before, &scene(&lit));
    // The colours are the world positions: each copy has its own.
    for x in 0..4 {
        assert!(lit.contains(&format!(">{x} 0 0 {} 0 0 {} 1 0 {x} 1 0<", x + 1, x + 1)), "{x}");
    }
}

#[test]
fn a_node_of_several_instances_is_copied_into_each() {
    let inner = node("leaf", "<scale>1 2 1</scale>", "square");
    let libraries = format!(
        "<library_nodes>{inner}<node id=\"pair\"><instance_node url=\"#leaf\"/><node id=\"far\"><translate>0 0 5</translate><instance_node url=\"#leaf\"/></node></node></library_nodes>"
    );
    let door = |x: usize| {
        format!("<node name=\"d{x}\"><translate>{x} 0 0</translate><instance_node url=\"#pair\"/></node>")
    };
    let nodes = format!("{}{}{}", door(10), door(20), node("single", "", "square"));
    let text = file(&libraries, &nodes);
    let (before, lit) = lit(&text);
    let after = scene(&lit);
    assert_eq!(names(&before), ["leaf.1", "leaf.2", "leaf.3", "leaf.4", "single"]);
    assert_same_surfaces(&before, &after);
    assert_unique_ids(&lit);
    // The library itself stays as it was.
    assert!(lit.contains(&libraries));
}

#[test]
fn a_node_that_is_instanced_once_is_edited_where_it_stands() {
    let libraries = format!("<library_nodes>{}</library_nodes>", node("leaf", "", "square"));
    let door = "<node name=\"d\"><translate>7 0 0</translate><instance_node url=\"#leaf\"/></node>";
    let (before, lit) = lit(&file(&libraries, &format!("{door}{}", node("other", "", "square"))));
    assert!(lit.contains(door));
    assert_same_surfaces(&before, &scene(&lit));
}

fn assert_unique_ids(text: &str) {
    let document = roxmltree::Document::parse(text).unwrap();
    let mut ids: Vec<&str> = document.descendants().filter_map(|node| node.attribute("id")).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count);
}

#[test]
fn new_ids_keep_clear_of_old_ones() {
    let text = file(
        "<extra id=\"square-2\"/><extra id=\"square-lit-positions\"/>",
        &format!("{}{}", node("a", "", "square"), node("b", "", "square")),
    );
    let (_, lit) = lit(&text);
    assert_unique_ids(&lit);
}

#[test]
fn writing_what_was_written_changes_nothing_but_ids() {
    let (_, once) = lit(&file("", &node("n", "<rotate>0 0 1 90</rotate>", "square")));
    let (_, twice) = lit(&once);
    assert_same_surfaces(&scene(&once), &scene(&twice));
}

#[test]
fn the_cornell_box_lit_keeps_its_names_and_areas() {
    let text = scenes::write_scene("cornell-box").unwrap();
    let before = scene(&text);
    let options = radiosity::Options { max_shots: 1, ..radiosity::Options::mesh(300) };
    let solution = radiosity::solve(&before, &options, |_| std::ops::ControlFlow::Continue(())).unwrap();
    let radiosity = radiosity::expose::rgb(&solution.vertex_radiosity(), solution.bands, &[]);
    let lit = Collada::from_text("test.dae", text).with_light(&before, &solution.mesh, &radiosity).unwrap();
    let after = scene(&lit);
    only_light_is_left_out(&after);
    let area = |scene: &Scene, node: &str| -> f64 {
        let of_node = |name: &str| name == node || name.starts_with(&format!("{node}."));
        scene.patches.iter().filter(|patch| of_node(&patch.name)).map(|patch| patch.polygon.area()).sum()
    };
    for name in ["floor", "ceiling", "left", "light", "short-top", "tall-4"] {
        let (old, new) = (area(&before, name), area(&after, name));
        assert!((old - new).abs() < 1e-9 * old, "{name}: {old} {new}");
    }
}

#[test]
fn cameras_of_any_angle_come_back() {
    let mut before = scene(&file("", ""));
    for fov in [1e-320, 1e-45, 0.7, 3.1, std::f64::consts::PI * (1.0 - f64::EPSILON)] {
        before.cameras = vec![Camera {
            name: "eye".into(),
            position: DVec3::new(1.0, 2.0, 3.0),
            direction: DVec3::X,
            up: DVec3::Z,
            vertical_fov: fov,
            aspect: 1.5,
        }];
        let camera = Collada::of(&before).scene().unwrap().cameras.remove(0);
        assert!((camera.vertical_fov - fov).abs() <= 1e-9 * fov, "{fov} became {}", camera.vertical_fov);
    }
}

/// Light stands in colours at the vertices, which are no reflectance.
fn only_light_is_left_out(after: &Scene) {
    assert!(
        after.warnings.iter().all(|warning| warning.what.contains("vertex colours")),
        "{:?}",
        after.warnings
    );
}

/// A COLLADA file and its picture in one folder, repaired into another one, as either version names pictures.
#[test]
fn pictures_go_with_a_file_to_another_folder() {
    use radiosity::io::Source;
    let text = scenes::write_scene("chessboard").unwrap();
    let picture = scenes::scene("chessboard").unwrap().patches[0].texture.clone().unwrap().image;
    let (head, rest) = text.split_once("<data>").unwrap();
    let (_, tail) = rest.split_once("</data>").unwrap();
    for (version, name) in [("1.4.1", "a%20b.png"), ("1.5.0", "<ref>a b.png</ref>")] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a b.png"), &picture.bytes).unwrap();
        let path = folder.path().join("a.dae");
        let head = head.replace("1.4.1", version);
        std::fs::write(&path, format!("{head}<init_from>{name}</init_from>{tail}")).unwrap();
        std::fs::create_dir(folder.path().join("other")).unwrap();
        let source = Source::open(&path).unwrap();
        let scene = source.scene().unwrap();
        for (target, is_inside) in [("b.dae", false), ("other/a.dae", true)] {
            let target = folder.path().join(target);
            source.save_repaired([&scene, &scene], &|scene| scene.clone(), &target).unwrap();
            let text = std::fs::read_to_string(&target).unwrap();
            assert_eq!(text.contains(name), !is_inside, "{version}");
            let again = Source::open(&target).unwrap().scene().unwrap();
            assert_eq!(again.patches[0].texture.clone().unwrap().image.bytes, picture.bytes, "{version}");
        }
    }
}
