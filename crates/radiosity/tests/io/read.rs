//! What the reader makes of good files.
use crate::samples::{file, geometry, instance, names, node, outline, polylist, primitive, scene};
use radiosity::glam::DVec3;
use radiosity::inspect::Kind;
use radiosity::io::collada::Collada;
use radiosity::scenes;

const CUBE: &str = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
const CUBE_FACES: &str = "0 3 2 1  4 5 6 7  0 1 5 4  1 2 6 5  2 3 7 6  3 0 4 7";

fn cube() -> String {
    geometry("cube", CUBE, &polylist("cube", "4 4 4 4 4 4", CUBE_FACES))
}

fn with_geometry(geometry: &str, nodes: &str) -> String {
    file(&format!("<library_geometries>{geometry}</library_geometries>"), nodes)
}

/// The unit square under some transforms.
fn square_under(transforms: &str) -> Vec<DVec3> {
    let scene = scene(&file("", &node("n", transforms, "square")));
    outline(&scene, 0)
}

fn points(coordinates: [[f64; 3]; 4]) -> Vec<DVec3> {
    coordinates.map(DVec3::from).to_vec()
}

#[test]
fn each_transform_element_does_what_the_standard_says() {
    let shifted = points([[5.0, 6.0, 7.0], [6.0, 6.0, 7.0], [6.0, 7.0, 7.0], [5.0, 7.0, 7.0]]);
    assert_eq!(square_under("<translate>5 6 7</translate>"), shifted);
    assert_eq!(square_under("<matrix>1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1</matrix>"), shifted);
    let scaled = points([[0.0; 3], [2.0, 0.0, 0.0], [2.0, 3.0, 0.0], [0.0, 3.0, 0.0]]);
    assert_eq!(square_under("<scale>2 3 4</scale>"), scaled);
    let turned = points([[0.0; 3], [0.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    assert_eq!(square_under("<rotate>0 0 2 90</rotate>"), turned);
    assert_eq!(square_under("<rotate>0 0 1 -630</rotate>"), turned);
    // Looks from (0, 0, 5) along +x with z up: its own −z is +x, its own y is +z, its own x is −y.
    let seen = points([[0.0, 0.0, 5.0], [0.0, -1.0, 5.0], [0.0, -1.0, 6.0], [0.0, 0.0, 6.0]]);
    assert_eq!(square_under("<lookat>0 0 5  7 0 5  0 0 1</lookat>"), seen);
}

#[test]
fn transforms_multiply_in_their_order_and_down_the_nodes() {
    let moved_then_scaled = square_under("<scale>2 2 2</scale><translate>1 0 0</translate>");
    assert_eq!(moved_then_scaled[0], DVec3::new(2.0, 0.0, 0.0));
    let scaled_then_moved = square_under("<translate>1 0 0</translate><scale>2 2 2</scale>");
    assert_eq!(scaled_then_moved[0], DVec3::new(1.0, 0.0, 0.0));
    let nested =
        format!("<node><scale>2 2 2</scale>{}</node>", node("n", "<translate>1 0 0</translate>", "square"));
    assert_eq!(outline(&scene(&file("", &nested)), 0), moved_then_scaled);
}

#[test]
fn an_eighth_of_a_turn_keeps_a_square_one_patch() {
    let scene =
        scene(&file("", &node("n", "<rotate>1 2 3 45</rotate><translate>3 4 5</translate>", "square")));
    assert_eq!(names(&scene), ["n"]);
    assert!((scene.patches[0].polygon.area() - 1.0).abs() < 1e-14);
}

#[test]
fn instanced_nodes_and_geometries_make_patches_each() {
    let library = format!("<library_nodes>{}</library_nodes>", node("lib", "<scale>2 2 2</scale>", "square"));
    let doors = r##"<node name="a"><instance_node url="#lib"/></node><node name="b"><translate>9 0 0</translate><instance_node url="#lib"/></node>"##;
    let scene = scene(&file(&library, &format!("{doors}{}", node("c", "", "square"))));
    assert_eq!(names(&scene), ["lib.1", "lib.2", "c"]);
    assert_eq!(outline(&scene, 1)[2], DVec3::new(11.0, 2.0, 0.0));
}

#[test]
fn a_hole_is_cut_out_whichever_way_it_turns() {
    for hole in ["4 5 6 7", "7 6 5 4"] {
        let positions = "0 0 0 4 0 0 4 4 0 0 4 0 1 1 0 2 1 0 2 2 0 1 2 0";
        let body = format!("<ph><p>0 1 2 3</p><h>{hole}</h></ph><p>4 5 6 7</p>");
        let text =
            with_geometry(&geometry("g", positions, &primitive("polygons", "g", &body)), &node("n", "", "g"));
        let scene = scene(&text);
        assert_eq!(names(&scene), ["n.1", "n.2"]);
        assert_eq!(scene.patches[0].polygon.area(), 15.0);
        assert_eq!(scene.patches[1].polygon.area(), 1.0);
        let hole = scene.patches[0].polygon.loops().nth(1).unwrap();
        assert_eq!((hole[1] - hole[0]).cross(hole[2] - hole[1]), -DVec3::Z, "against the outline");
    }
}

#[test]
fn strips_fans_and_lists_that_form_a_square_are_that_square() {
    let positions = "0 0 0 1 0 0 1 1 0 0 1 0";
    for (tag, indices) in [("triangles", "0 1 2 0 2 3"), ("trifans", "0 1 2 3"), ("tristrips", "0 1 3 2")] {
        let body = format!("<p>{indices}</p>");
        let text = with_geometry(&geometry("g", positions, &primitive(tag, "g", &body)), &node("n", "", "g"));
        let scene = scene(&text);
        assert_eq!(names(&scene), ["n"], "{tag}");
        assert_eq!(outline(&scene, 0), [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y], "{tag}");
        assert_eq!(scene.patches[0].polygon.normal(), DVec3::Z, "{tag}");
    }
}

#[test]
fn strips_and_fans_turn_as_stated_where_they_bend() {
    let positions = "0 0 0 1 0 0 1 1 0 0 1 1";
    for (tag, indices) in [("triangles", "0 1 2 0 2 3"), ("trifans", "0 1 2 3"), ("tristrips", "0 1 3 2")] {
        let body = format!("<p>{indices}</p>");
        let text = with_geometry(&geometry("g", positions, &primitive(tag, "g", &body)), &node("n", "", "g"));
        let scene = scene(&text);
        assert_eq!(names(&scene), ["n.1", "n.2"], "{tag}");
        assert!(scene.patches.iter().all(|patch| patch.polygon.normal().z > 0.0), "{tag}");
    }
}

#[test]
fn an_index_is_found_among_the_inputs_by_its_offset() {
    let inputs = r##"<polylist material="m" count="1"><input semantic="NORMAL" source="#nowhere" offset="0"/><input semantic="VERTEX" source="#g-v" offset="2"/><input semantic="TEXCOORD" source="#nowhere" offset="3" set="0"/><vcount>3</vcount><p>9 9 0 9  9 9 1 9  9 9 2 9</p></polylist>"##;
    let text = with_geometry(&geometry("g", "0 0 0 1 0 0 0 1 0", inputs), &node("n", "", "g"));
    assert_eq!(outline(&scene(&text), 0), [DVec3::ZERO, DVec3::X, DVec3::Y]);
}

#[test]
fn an_accessor_may_skip_numbers() {
    let source = r##"<geometry id="g"><mesh><source id="p"><float_array id="a" count="14">7 7 0 0 0 8 1 0 0 8 0 1 0 8</float_array><technique_common><accessor source="#a" count="3" offset="2" stride="4"/></technique_common></source><vertices id="g-v"><input semantic="POSITION" source="#p"/></vertices>"##;
    let text = format!("{source}{}</mesh></geometry>", polylist("g", "3", "0 1 2"));
    assert_eq!(
        outline(&scene(&with_geometry(&text, &node("n", "", "g"))), 0),
        [DVec3::ZERO, DVec3::X, DVec3::Y]
    );
}

#[test]
fn diffuse_is_reflectance_and_emission_is_radiance() {
    let lamp = format!("<node name=\"lamp\">{}</node>", instance("square", "lamp"));
    let scene = scene(&file("", &format!("{}{lamp}", node("n", "", "square"))));
    assert_eq!(scene.patches[0].reflectance, [0.25, 0.5, 0.75]);
    assert_eq!(scene.patches[0].emission, [0.0; 3]);
    assert_eq!(scene.patches[1].reflectance, [0.1; 3]);
    assert_eq!(scene.patches[1].emission, [1.0, 2.0, 3.0]);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn materials_that_say_nothing_get_a_default_and_a_warning() {
    let bare = r##"<node name="bare"><instance_geometry url="#square"/></node>"##;
    let unbound = scene(&file("", bare));
    assert_eq!(unbound.patches[0].reflectance, [0.5; 3]);
    assert!(unbound.warnings[0].to_string().starts_with("test.dae:"), "{:?}", unbound.warnings);

    let textured = file("", &node("n", "", "square"))
        .replace("<color>0.25 0.5 0.75 1</color>", r#"<texture texture="image" texcoord="uv"/>"#);
    let textured = scene(&textured);
    assert_eq!(textured.patches[0].reflectance, [0.5; 3]);
    assert!(textured.warnings[0].what.contains("texture"), "{:?}", textured.warnings);
}

#[test]
fn a_texture_gives_each_field_its_reflectance() {
    let scene = scenes::scene("chessboard").unwrap();
    let floor = &scene.patches[0];
    assert!(floor.reflectance.iter().all(|mean| (mean - 0.425).abs() < 1e-3), "{:?}", floor.reflectance);
    // The field at the lower left corner is dark, its neighbours are not.
    let field = |x: f64, y: f64| {
        let corner = |dx, dy| DVec3::new(-2.0 + (x + dx) / 2.0, -2.0 + (y + dy) / 2.0, 0.0);
        floor.reflectance_over([corner(0.01, 0.01), corner(0.99, 0.01), corner(0.99, 0.99)])[0]
    };
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (7.0, 7.0), (3.0, 6.0)] {
        let expected = if (x + y) % 2.0 == 0.0 { 0.05 } else { 0.8 };
        assert!((field(x, y) - expected).abs() < 1e-4, "({x}, {y}): {}", field(x, y));
    }
}

#[test]
fn a_picture_beside_the_file_is_found_in_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let image = scenes::scene("chessboard").unwrap().patches[0].texture.clone().unwrap().image;
    std::fs::write(folder.path().join("a b.png"), &image.bytes).unwrap();
    let written = scenes::write_scene("chessboard").unwrap();
    let (head, rest) = written.split_once("<data>").unwrap();
    let (_, tail) = rest.split_once("</data>").unwrap();
    let path = folder.path().join("scene.dae");
    std::fs::write(&path, format!("{head}<init_from>a%20b.png</init_from>{tail}")).unwrap();
    let scene = Collada::open(&path).unwrap().scene().unwrap();
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!(scene.patches[0].texture.as_ref().unwrap().image.texels, image.texels);
}

#[test]
fn facets_that_share_a_normal_at_a_vertex_are_one_curved_surface() {
    // A ridge of two faces with one normal along it, and a third face with its own.
    let normals = r##"<source id="nn"><float_array id="nna" count="6">0 0 1 0 1 0</float_array><technique_common><accessor source="#nna" count="2" stride="3"/></technique_common></source>"##;
    let list = r##"<polylist material="m" count="3"><input semantic="VERTEX" source="#g-v" offset="0"/><input semantic="NORMAL" source="#nn" offset="1"/><vcount>3 3 3</vcount><p>0 0 1 0 2 0  1 0 0 0 3 0  0 1 2 1 4 1</p></polylist>"##;
    let mesh = geometry("g", "0 0 0 0 1 0 -1 0 -1 1 0 -1 0 0 -2", list)
        .replace("<vertices", &format!("{normals}<vertices"));
    let scene = scene(&with_geometry(&mesh, &node("n", "", "g")));
    let groups: Vec<_> = scene.patches.iter().map(|patch| patch.smoothing).collect();
    assert!(groups[0].is_some() && groups[0] == groups[1] && groups[2].is_none(), "{groups:?}");
}

#[test]
fn a_colour_may_be_a_parameter_and_a_symbol_may_be_a_material() {
    let text = file("", r##"<node name="n"><instance_geometry url="#square"/></node>"##)
        .replace("<color>0.25 0.5 0.75 1</color>", r#"<param ref="c"/>"#)
        .replace(
            "<technique sid=\"t\"><lambert>",
            r#"<newparam sid="c"><float3>0.3 0.2 0.1</float3></newparam><technique sid="t"><lambert>"#,
        )
        .replace("material=\"m\"", "material=\"grey\"");
    assert_eq!(scene(&text).patches[0].reflectance, [0.3, 0.2, 0.1]);
}

#[test]
fn patches_are_named_after_their_nodes() {
    let nameless = format!("<node id=\"ident\">{}</node>", instance("square", "grey"));
    let twice = format!("{}{}", node("same", "", "square"), node("same", "", "square"));
    let nodes = format!("{}{}{nameless}{twice}", node("box", "", "cube"), node("one", "", "square"));
    let scene = scene(&with_geometry(&cube(), &nodes));
    let expected = ["box.1", "box.2", "box.3", "box.4", "box.5", "box.6", "one", "ident", "same.1", "same.2"];
    assert_eq!(names(&scene), expected);
}

#[test]
fn names_stay_unique_whatever_the_nodes_are_called() {
    let nodes =
        format!("{}{}{}", node("a", "", "square"), node("a", "", "square"), node("a.1", "", "square"));
    assert_eq!(names(&scene(&file("", &nodes))), ["a.1", "a.2", "a.1'"]);
}

#[test]
fn a_mirrored_solid_keeps_its_outside_outside() {
    for scale in ["1 1 1", "-1 1 1", "1 -2 1", "-1 -1 -1"] {
        let scene = scene(&with_geometry(&cube(), &node("n", &format!("<scale>{scale}</scale>"), "cube")));
        let all: Vec<Vec<DVec3>> = (0..6).map(|patch| outline(&scene, patch)).collect();
        let centre = all.iter().flatten().sum::<DVec3>() / 24.0;
        for (patch, corners) in scene.patches.iter().zip(&all) {
            assert!(patch.polygon.normal().dot(corners[0] - centre) > 0.0, "{scale}: {}", patch.name);
        }
    }
}

#[test]
fn a_polygon_that_is_not_planar_becomes_triangles_with_a_warning() {
    let bent = geometry("g", "0 0 0 2 0 0 2 2 0.5 0 2 0", &polylist("g", "4 3", "0 1 2 3 0 1 3"));
    let scene = scene(&with_geometry(&bent, &node("n", "", "g")));
    assert_eq!(names(&scene), ["n.1.1", "n.1.2", "n.2"]);
    let warning = &scene.warnings[0];
    assert_eq!(
        (warning.kind, warning.patches.as_slice()),
        (Kind::NonPlanar, ["n.1.1", "n.1.2"].map(String::from).as_slice())
    );
    assert!(warning.what.contains("not planar") && warning.what.starts_with("test.dae:"), "{warning}");
    assert!(scene.patches.iter().all(|patch| patch.polygon.normal().z > 0.9));
}

#[test]
fn the_pieces_of_a_bent_polygon_with_a_hole_cover_it() {
    let positions = "0 0 0 4 0 0 4 4 1 0 4 0 1 1 0 2 1 0 2 2 0 1 2 0";
    let body = "<ph><p>0 1 2 3</p><h>4 5 6 7</h></ph>";
    let bent = geometry("g", positions, &primitive("polygons", "g", body));
    let scene = scene(&with_geometry(&bent, &node("n", "", "g")));
    let shadow: f64 = scene.patches.iter().map(|patch| patch.polygon.area() * patch.polygon.normal().z).sum();
    assert!((shadow - 15.0).abs() < 1e-12, "{shadow}");
}

/// Both lobes of a bow tie are there, also where rounding of its places leaves it no plane and a front that points anywhere.
#[test]
fn a_bow_tie_without_a_front_becomes_its_two_lobes() {
    for turn in ["", "<rotate>1 2 3 40</rotate>", "<scale>1 -1 1</scale>"] {
        let bow = geometry("g", "0 0 0 2 2 0 2 0 0 0 2 0", &polylist("g", "4", "0 1 2 3"));
        let scene = scene(&with_geometry(&bow, &node("n", turn, "g")));
        assert_eq!(names(&scene), ["n.1.1", "n.1.2"], "{turn}");
        for patch in &scene.patches {
            assert!((patch.polygon.area() - 1.0).abs() < 1e-9, "{turn}: {}", patch.polygon.area());
            assert!(patch.polygon.normal().dot(scene.patches[0].polygon.normal()) > 0.99, "{turn}");
        }
        let warning = &scene.warnings[0];
        assert_eq!((warning.kind, warning.patches.len()), (Kind::Crossed, 2), "{warning}");
        assert!(warning.kind.matters() && warning.what.contains("crosses itself"), "{warning}");
    }
}

#[test]
fn what_has_no_area_is_left_out_with_a_warning() {
    for positions in ["0 0 0 1 0 0 2 0 0", "0 0 0 0 0 0 0 0 0"] {
        let flat = geometry("g", positions, &polylist("g", "3", "0 1 2"));
        let scene =
            scene(&with_geometry(&flat, &format!("{}{}", node("n", "", "g"), node("m", "", "square"))));
        assert_eq!(names(&scene), ["m"]);
        let warning = &scene.warnings[0];
        assert_eq!((warning.kind, warning.patches.as_slice()), (Kind::NoArea, ["n.1".to_owned()].as_slice()));
        assert!(warning.what.contains("without area"), "{warning}");
    }
    let flattened = scene(&file("", &node("n", "<scale>1 1 0</scale>", "square")));
    assert!(flattened.patches.is_empty());
    assert!(flattened.warnings[0].what.contains("flattens"), "{:?}", flattened.warnings);
}

#[test]
fn a_ring_of_two_points_is_left_out_with_a_warning() {
    let two = geometry("g", "0 0 0 1 0 0 1 1 0", &polylist("g", "2 3", "0 1 0 1 2"));
    let scene = scene(&with_geometry(&two, &node("n", "", "g")));
    assert_eq!(names(&scene), ["n.2"]);
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
}

#[test]
fn of_several_visual_scenes_one_is_taken_with_a_warning() {
    let second = "<visual_scene id=\"vs2\"></visual_scene></library_visual_scenes>";
    let text = file("", &node("n", "", "square")).replace("</library_visual_scenes>", second);
    let uninstanced = text.replace("<scene><instance_visual_scene url=\"#vs\"/></scene>", "");
    for text in [text, uninstanced] {
        let scene = scene(&text);
        assert_eq!(names(&scene), ["n"]);
        assert!(scene.warnings[0].what.contains("2 visual scenes"), "{:?}", scene.warnings);
    }
}

#[test]
fn collada_1_5_reads_the_same() {
    let old = file("", &node("n", "", "square"));
    let new =
        old.replace("2005/11/COLLADASchema\" version=\"1.4.1", "2008/03/COLLADASchema\" version=\"1.5.0");
    assert_eq!(outline(&scene(&old), 0), outline(&scene(&new), 0));
}

#[test]
fn a_byte_order_mark_does_no_harm() {
    assert_eq!(scene(&format!("\u{feff}{}", file("", &node("n", "", "square")))).patches.len(), 1);
}

#[test]
fn cameras_look_along_their_minus_z() {
    let camera = |lens: &str| {
        let library = format!(
            "<library_cameras><camera id=\"c\"><optics><technique_common><perspective>{lens}</perspective></technique_common></optics></camera></library_cameras>"
        );
        let node = r##"<node name="eye"><translate>1 2 3</translate><rotate>0 1 0 90</rotate><instance_camera url="#c"/></node>"##;
        scene(&file(&library, node)).cameras.remove(0)
    };
    let eye = camera("<yfov>90</yfov><aspect_ratio>2</aspect_ratio>");
    assert_eq!((eye.position, eye.direction, eye.up), (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_X, DVec3::Y));
    assert_eq!(eye.name, "eye");
    assert!((eye.vertical_fov.to_degrees() - 90.0).abs() < 1e-12 && eye.aspect == 2.0);
    // tan(fov/2): 1 across, 1/2 down.
    let wide = camera("<xfov>90</xfov><aspect_ratio>2</aspect_ratio>");
    assert!(((wide.vertical_fov / 2.0).tan() - 0.5).abs() < 1e-12 && wide.aspect == 2.0);
    let both = camera("<xfov>90</xfov><yfov>53.13010235415598</yfov>");
    assert!((both.aspect - 2.0).abs() < 1e-12);
}

#[test]
fn cameras_that_see_nothing_are_left_out_by_line() {
    let refused = |lens: &str| {
        let library = format!(
            "<library_cameras><camera id=\"c\"><optics><technique_common><perspective>{lens}</perspective></technique_common></optics></camera></library_cameras>"
        );
        let scene = scene(&file(&library, r##"<node><instance_camera url="#c"/></node>"##));
        assert!(scene.cameras.is_empty() && scene.warnings.len() == 1, "{lens}");
        scene.warnings[0].to_string()
    };
    for angle in ["0", "-1", "180", "5e-324"] {
        let message = refused(&format!("<yfov>{angle}</yfov>"));
        assert!(message.starts_with("test.dae:") && message.contains("the angle"), "{message}");
    }
    for lens in [
        "<yfov>45</yfov><aspect_ratio>0</aspect_ratio>",
        "<yfov>45</yfov><aspect_ratio>1e-310</aspect_ratio>",
        "<xfov>170</xfov><aspect_ratio>1e-300</aspect_ratio>",
        "<xfov>179</xfov><yfov>1e-310</yfov>",
    ] {
        let message = refused(lens);
        assert!(message.starts_with("test.dae:") && message.contains("ratio"), "{message}");
    }
}

#[test]
fn the_asset_tells_unit_and_up() {
    let text = file("", "");
    let asset = scene(&text).asset;
    assert_eq!((asset.up, asset.unit), (DVec3::Z, 0.0254));
    let plain = text.replace("<up_axis>Z_UP</up_axis>", "").replace("meter=\"0.0254\"", "");
    let asset = scene(&plain).asset;
    assert_eq!((asset.up, asset.unit), (DVec3::Y, 1.0));
}
