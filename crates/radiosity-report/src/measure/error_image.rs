//! Pictures: a scene by the light of its emitters, and the error of a method on every element.
use super::test_scene::TestScene;
use crate::methods::Step;
use crate::rows::ErrorImage;
use base64::Engine;
use glam::DVec3;
use radiosity::expose::{Exposure, rgb};
use radiosity::{Camera, Element, Mesh, picture};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Pixels across.
const WIDTH: u32 = 380;
/// Beyond so many points times polygons errors are not drawn: it would take minutes.
const MOST: usize = 4_000_000;
/// The decades of the scale of errors: from the first colour to the last one.
const DECADES: [f64; 2] = [-6.0, -1.0];
/// Dark to light, told apart by any eye (after viridis, Smith and van der Walt 2015), sRGB.
const COLOURS: [[u8; 3]; 6] =
    [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81], [253, 231, 37]];

/// The scene, and the errors of the steps that sample.
pub(crate) fn images(test_scene: &TestScene<'_>, steps: &[Step]) -> Vec<ErrorImage> {
    let camera = test_scene.scene.cameras.first().cloned();
    let camera =
        camera.unwrap_or_else(|| picture::framing(test_scene.scene.extent(), test_scene.scene.asset.up));
    let lit = lit(test_scene);
    let image = |caption: String, png: Vec<u8>| {
        let text = base64::engine::general_purpose::STANDARD.encode(png);
        ErrorImage {
            scene: test_scene.name.to_owned(),
            caption,
            address: format!("data:image/png;base64,{text}"),
        }
    };
    let drawable = test_scene.points.len() * test_scene.scene.patches.len() <= MOST;
    let sampling = steps.iter().filter(|_| drawable);
    let errors = sampling.map(|step| {
        let worst = format!("error of {}, {}", step.series, step.setting);
        image(worst, error_picture(test_scene, step, &camera))
    });
    std::iter::once(image(
        format!("light from the emitters, {} elements", test_scene.points.len()),
        lit_picture(test_scene, &lit, &camera),
    ))
    .chain(errors)
    .collect()
}

/// Radiosity of every element by direct light alone, as red, green and blue.
fn lit(test_scene: &TestScene<'_>) -> Vec<[f64; 3]> {
    let patches = &test_scene.scene.patches;
    let emitters = test_scene.emitters.len().max(1) as f64;
    let bands = test_scene.scene.bands;
    // The emitters' mean radiance, as the factors to all of them are known together.
    let shine = |band: usize| {
        test_scene.emitters.iter().map(|&emitter| patches[emitter].emission[band]).sum::<f64>() / emitters
    };
    let element = |(index, [factor, _]): (usize, &[f64; 2])| {
        let patch = &patches[test_scene.mesh.elements[index].patch];
        let rho = patch.reflectance_over(test_scene.mesh.triangle(index));
        (0..bands).map(|b| PI * (patch.emission[b] + rho[b] * factor * shine(b))).collect::<Vec<_>>()
    };
    let light: Vec<f64> = test_scene.light.iter().enumerate().flat_map(element).collect();
    rgb(&light, bands, &test_scene.scene.wavelengths)
}

fn lit_picture(test_scene: &TestScene<'_>, light: &[[f64; 3]], camera: &Camera) -> Vec<u8> {
    let emits = |element: usize| test_scene.scene.patches[test_scene.mesh.elements[element].patch].emits();
    let lit =
        light.iter().enumerate().map(|(index, light)| (*light, test_scene.mesh.area(index), emits(index)));
    picture::draw(&loose(&test_scene.mesh), &three(light), camera, Exposure::of(lit), WIDTH)
}

/// The error of every element as a colour.
fn error_picture(test_scene: &TestScene<'_>, step: &Step, camera: &Camera) -> Vec<u8> {
    let exposure = Exposure::new(1.0).expect("1 is a brightness");
    let off = |(from, [exact, _]): (&formfactor::DifferentialArea, &[f64; 2])| {
        let row = step.method.row(&test_scene.enclosure, from, &test_scene.emitters);
        (row.iter().sum::<f64>() - exact).abs()
    };
    let errors: Vec<f64> = test_scene.points.par_iter().zip(&test_scene.light).map(off).collect();
    // The light that the exposure turns to the colour: its largest part decides how bright it is.
    let light = |error: f64| {
        let colour = linear(error).map(|share| share.min(0.9999));
        let largest = colour.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        colour.map(|share| -(-largest).ln_1p() * share / largest)
    };
    let light: Vec<[f64; 3]> = errors.into_iter().map(light).collect();
    picture::draw(&loose(&test_scene.mesh), &three(&light), camera, exposure, WIDTH)
}

/// The colour of an error, as linear intensities.
fn linear(error: f64) -> [f64; 3] {
    let steps = (COLOURS.len() - 1) as f64;
    let log = if error > 0.0 { error.log10() } else { f64::MIN };
    let at = steps * ((log - DECADES[0]) / (DECADES[1] - DECADES[0])).clamp(0.0, 1.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and the last colour"
    )]
    let step = (at as usize).min(COLOURS.len() - 2);
    let share = at - step as f64;
    std::array::from_fn(|band| {
        let [a, b] = [step, step + 1].map(|colour| f64::from(COLOURS[colour][band]) / 255.0);
        (a + share * (b - a)).powf(2.2)
    })
}

/// The same triangles, none of which shares a vertex with another.
fn loose(mesh: &Mesh) -> Mesh {
    let vertices: Vec<DVec3> = (0..mesh.elements.len()).flat_map(|element| mesh.triangle(element)).collect();
    let own = |(index, element): (usize, &Element)| {
        let corners = [3 * index, 3 * index + 1, 3 * index + 2];
        Element { patch: element.patch, corners }
    };
    Mesh { vertices, elements: mesh.elements.iter().enumerate().map(own).collect() }
}

/// Each colour for the three corners of its element.
fn three(light: &[[f64; 3]]) -> Vec<[f64; 3]> {
    light.iter().flat_map(|light| [*light; 3]).collect()
}

/// The scale of the pictures of errors, as SVG.
pub(crate) fn scale() -> String {
    let [low, high] = DECADES;
    let stops: String = COLOURS
        .iter()
        .enumerate()
        .map(|(k, [r, g, b])| {
            let share = 100 * k / (COLOURS.len() - 1);
            format!("<stop offset=\"{share}%\" stop-color=\"rgb({r} {g} {b})\"/>")
        })
        .collect();
    format!(
        "<svg class=\"scale\" viewBox=\"0 0 420 34\" role=\"img\" aria-label=\"colours of errors\"><defs><linearGradient id=\"errors\">{stops}\
         </linearGradient></defs><rect x=\"60\" y=\"2\" width=\"300\" height=\"12\" fill=\"url(#errors)\"/>\
         <text x=\"60\" y=\"29\" text-anchor=\"middle\">≤ 10<tspan dy=\"-4\" font-size=\"9\">{low}</tspan></text>\
         <text x=\"360\" y=\"29\" text-anchor=\"middle\">≥ 10<tspan dy=\"-4\" font-size=\"9\">{high}</tspan></text>\
         <text x=\"210\" y=\"29\" text-anchor=\"middle\">error of the form factor</text></svg>\n"
    )
}
