//! Any number of bands, and none that nothing emits in.
use crate::build::{room, scene, solved};
use radiosity::{Method, Options, Scene};

/// A room whose patches reflect and emit in each band as told.
fn banded(bands: usize, reflectance: impl Fn(usize, usize) -> f64, emission: impl Fn(usize) -> f64) -> Scene {
    let mut scene = scene(room([0.0; 3], [3.0, 2.0, 1.0], 1, 0.5, 0.0));
    scene.bands = bands;
    for (index, patch) in scene.patches.iter_mut().enumerate() {
        patch.reflectance = (0..bands).map(|band| reflectance(index, band)).collect();
        patch.emission = (0..bands).map(|band| if index == 2 { emission(band) } else { 0.0 }).collect();
    }
    scene
}

#[test]
fn seventy_six_bands_are_seventy_six_scenes_of_one() {
    // Smooth spectra of 76 values, as the Cornell box's are.
    let reflectance = |patch: usize, band: usize| 0.4 + 0.35 * ((patch * 7 + band) as f64 / 12.0).sin();
    let emission = |band: usize| band as f64 / 75.0;
    let scene = banded(76, reflectance, emission);
    for method in [Method::Shoot, Method::Cg, Method::Gmres] {
        let options = Options { method, elements: 60, tolerance: 1e-6, spread: 1e-9, ..Options::default() };
        let all = solved(&scene, &options);
        assert_eq!(all.bound.len(), 76);
        for band in [0, 1, 38, 75] {
            let one = solved(&banded(1, |patch, _| reflectance(patch, band), |_| emission(band)), &options);
            assert_eq!(all.mesh.elements, one.mesh.elements);
            for (element, b) in one.radiosity.iter().enumerate() {
                let found = all.radiosity[element * 76 + band];
                assert!((found - b).abs() <= all.bound[band] + one.bound[0] + 1e-6 * b, "{method:?} {band}");
            }
        }
    }
}

#[test]
fn the_cornell_box_in_76_bands_is_what_each_band_is_alone() {
    let scene = radiosity::scenes::scene("cornell-76").expect("a built-in scene");
    let options = Options { tolerance: 1e-4, spread: 1e-3, ..Options::mesh(100) };
    let all = solved(&scene, &options);
    assert!(all.converged);
    assert_eq!(all.ledger.emitted[0], 0.0, "the lamp gives nothing at 400 nm");
    assert!(all.radiosity.iter().step_by(76).all(|b| *b == 0.0));
    for band in [5, 40, 75] {
        let mut one = Scene { bands: 1, wavelengths: Vec::new(), ..scene.clone() };
        for patch in &mut one.patches {
            patch.reflectance = vec![patch.reflectance[band]];
            patch.emission = vec![patch.emission[band]];
        }
        let one = solved(&one, &options);
        // Where a shooter is split goes by all bands together: what differs is what `spread` leaves.
        let mean = |solution: &radiosity::Solution, bands: usize, band: usize| -> f64 {
            let areas = (0..solution.mesh.elements.len()).map(|element| solution.mesh.area(element));
            areas.zip(solution.irradiance.iter().skip(band).step_by(bands)).map(|(area, h)| area * h).sum()
        };
        let (found, alone) = (mean(&all, 76, band), mean(&one, 1, 0));
        assert!((found / alone - 1.0).abs() < 2e-3, "band {band}: {found} {alone}");
    }
}

#[test]
fn a_band_without_emission_is_dark_and_costs_nothing() {
    let scene = banded(3, |_, _| 0.95, |band| if band == 1 { 1.0 } else { 0.0 });
    let alone = banded(1, |_, _| 0.95, |_| 1.0);
    let options = Options { method: Method::Cg, elements: 100, ..Options::default() };
    let (three, one) = (solved(&scene, &options), solved(&alone, &options));
    assert_eq!(three.products, one.products);
    for (bands, b) in three.radiosity.chunks(3).zip(&one.radiosity) {
        assert_eq!(bands, [0.0, *b, 0.0]);
    }
    assert_eq!([three.bound[0], three.bound[2]], [0.0; 2]);
}

#[test]
fn black_patches_receive_and_send_nothing() {
    let scene = banded(1, |patch, _| if patch == 2 { 0.5 } else { 0.0 }, |_| 1.0);
    for method in [Method::Shoot, Method::Cg, Method::Gmres, Method::Matrix] {
        let solution = solved(&scene, &Options { method, elements: 100, ..Options::default() });
        for (index, element) in solution.mesh.elements.iter().enumerate() {
            let (h, b) = (solution.irradiance[index], solution.radiosity[index]);
            assert!(if element.patch == 2 { h == 0.0 } else { h > 0.0 && b == 0.0 }, "{method:?}");
        }
        assert!(solution.bound[0] < 1e-12);
    }
}

#[test]
fn a_scene_without_light_is_solved_and_dark_by_every_method() {
    for method in
        [Method::Hierarchical, Method::Mesh, Method::Shoot, Method::Cg, Method::Gmres, Method::Matrix]
    {
        let solution =
            solved(&banded(2, |_, _| 0.9, |_| 0.0), &Options { method, elements: 50, ..Options::default() });
        assert!(solution.converged && solution.radiosity.iter().all(|b| *b == 0.0), "{method:?}");
    }
}

#[test]
fn rooms_without_light_stay_dark() {
    let mut scene = banded(1, |_, _| 0.9, |_| 1.0);
    scene.patches.extend(room([10.0; 3], [11.0; 3], 1, 0.99, 0.0));
    for method in
        [Method::Mesh, Method::Shoot, Method::Cg, Method::Gmres, Method::Matrix, Method::Hierarchical]
    {
        let solution = solved(&scene, &Options { method, elements: 100, ..Options::default() });
        let dark =
            solution.mesh.elements.iter().zip(&solution.radiosity).filter(|(element, _)| element.patch > 5);
        assert!(dark.map(|(_, b)| *b).all(|b| b == 0.0), "{method:?}");
        assert!(solution.converged);
    }
}
