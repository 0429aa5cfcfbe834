use super::*;
use crate::scenes;
use crate::solve::{options::Options, solve};
use std::ops::ControlFlow;

fn record(scene: &str, elements: usize) -> Record {
    let scene = scenes::scene(scene).unwrap();
    let options = Options::mesh(elements);
    Record::new("scene", &scene, &solve(&scene, &options, |_| ControlFlow::Continue(())).unwrap())
}

/// The same solution, what is reflected times `factor`.
fn scaled(record: &Record, factor: f64) -> Record {
    let mut other = record.clone();
    let light = reflected(record);
    other.radiosity.iter_mut().zip(light).for_each(|(b, reflected)| *b += (factor - 1.0) * reflected);
    other
}

#[test]
fn a_solution_is_no_different_from_itself() {
    let one = record("colour-bleeding", 100);
    let comparison = compare(&one, &one).unwrap();
    assert_eq!(comparison.largest(), 0.0);
    assert!(comparison.worst.is_none() && comparison.same_mesh && comparison.bands.len() == 3);
}

#[test]
fn light_that_is_a_tenth_brighter_is_a_tenth_off_in_every_norm() {
    let one = record("colour-bleeding", 100);
    for band in compare(&scaled(&one, 1.1), &one).unwrap().bands {
        for norm in [band.l1, band.l2, band.max] {
            assert!((norm - 0.1).abs() < 1e-12, "{norm}");
        }
    }
}

#[test]
fn light_of_any_scale_is_compared_in_shares() {
    let one = record("colour-bleeding", 100);
    let at_scale = |record: &Record, scale: f64| {
        let mut other = record.clone();
        other.radiosity.iter_mut().for_each(|b| *b *= scale);
        other.patches.iter_mut().flat_map(|patch| &mut patch.emission).for_each(|light| *light *= scale);
        other
    };
    for scale in [1e-300, 1e-160, 1e160, 1e305] {
        let bands = compare(&at_scale(&scaled(&one, 1.1), scale), &at_scale(&one, scale)).unwrap().bands;
        for norm in bands.iter().flat_map(|band| [band.l1, band.l2, band.max]) {
            assert!((norm - 0.1).abs() < 1e-9, "{scale}: {norm}");
        }
    }
    let off = compare(&at_scale(&one, -1e305), &at_scale(&one, 1e305)).unwrap();
    assert!((off.largest() - 2.0).abs() < 1e-9, "{off:?}");
    let dark = compare(&one, &at_scale(&one, 0.0)).unwrap();
    assert_eq!(dark.largest(), f64::INFINITY);
}

#[test]
fn the_worst_element_is_the_one_that_was_changed() {
    let one = record("colour-bleeding", 100);
    let mut other = one.clone();
    other.radiosity[3 * 17 + 1] += 5.0;
    let worst = compare(&other, &one).unwrap().worst.unwrap();
    assert_eq!((worst.element, worst.band), (17, 1));
    assert_eq!(worst.patch, one.patches[one.elements[17][0]].name);
    assert!((worst.a - worst.b - 5.0).abs() < 1e-12);
}

#[test]
fn meshes_that_differ_cover_each_other_wholly() {
    let (coarse, fine) = (record("beams", 150), record("beams", 400));
    let patches: Vec<usize> = (0..coarse.patches.len()).collect();
    let mut areas = vec![0.0; patches.len()];
    for piece in overlap::overlaps(&coarse, &fine, &patches) {
        areas[coarse.elements[piece.elements[0]][0]] += piece.area;
    }
    for (patch, area) in coarse.patches.iter().zip(areas) {
        assert!((area / patch.area - 1.0).abs() < 1e-9, "{}: {area} of {}", patch.name, patch.area);
    }
}

#[test]
fn a_finer_mesh_is_near_and_the_order_of_patches_does_not_matter() {
    let (coarse, fine) = (record("colour-bleeding", 100), record("colour-bleeding", 300));
    let near = compare(&coarse, &fine).unwrap();
    assert!(!near.same_mesh && near.bands[0].l2 < 0.2 && near.bands[0].l2 > 1e-4, "{near:?}");
    let mut turned = fine.clone();
    turned.patches.reverse();
    let last = fine.patches.len() - 1;
    turned.elements.iter_mut().for_each(|element| element[0] = last - element[0]);
    assert_eq!(compare(&coarse, &turned).unwrap().bands, near.bands);
}

#[test]
fn solutions_of_other_scenes_are_refused_by_name() {
    let (one, mut other) = (record("furnace", 24), record("furnace", 24));
    other.patches[2].name = "elsewhere".to_owned();
    assert!(matches!(compare(&one, &other), Err(Unlike::Patch { .. })));
    let mut elsewhere = one.clone();
    for axis in 0..3 {
        elsewhere.vertices.clone_from(&one.vertices);
        elsewhere.vertices.iter_mut().for_each(|vertex| vertex[axis] += 0.25);
        assert!(matches!(compare(&one, &elsewhere), Err(Unlike::Shape { .. })));
    }
    elsewhere.elements.retain(|[patch, ..]| *patch == 0);
    elsewhere.radiosity.truncate(3 * elsewhere.elements.len());
    assert!(matches!(compare(&elsewhere, &one), Err(Unlike::Shape { .. })));
    other.bands = 1;
    assert_eq!(compare(&one, &other), Err(Unlike::Bands { a: 3, b: 1 }));
}
