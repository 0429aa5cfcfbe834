//! What is to be within the error that is asked for: all but for small patches that are little of the area together.
//!
//! In large scenes the largest errors are those of small patches in corners, under what stands and behind what hangs. The last of thousands would
//! take many passes over all links; estimates tell how wrong they are.
use super::estimate::ErrorShares;
use super::members::{FEW, PlateMembers, SMALL};
use super::plates::is_large;

/// The patches and plates that a run is for: those in view, or all.
#[derive(Debug)]
pub(super) struct Asked {
    /// What is no larger is small: nothing is where there are few patches.
    small: f64,
    /// How large the patches are, 0 where they are out of view.
    of_patches: Vec<f64>,
    of_plates: Vec<f64>,
}

impl Asked {
    /// `in_view` tells of plates.
    pub(super) fn of(members: &PlateMembers<'_>, in_view: Option<&[bool]>) -> Asked {
        let seen = |plate: usize, area: f64| {
            if in_view.is_none_or(|in_view| in_view[plate]) { area } else { 0.0 }
        };
        let given = members.plates.given.patches.iter().zip(&members.of_patches);
        let plates = members.plates.scene.patches.iter().enumerate();
        let of_patches: Vec<f64> = given.map(|(patch, &plate)| seen(plate, patch.polygon.area())).collect();
        let share = if is_large(members.plates.given) { SMALL } else { 0.0 };
        Asked {
            small: share * of_patches.iter().sum::<f64>(),
            of_patches,
            of_plates: plates.map(|(plate, patch)| seen(plate, patch.polygon.area())).collect(),
        }
    }

    /// Whether estimates are within an error on 95 % of the area and on every patch and plate that is not small.
    pub(super) fn are_within(&self, shares: &ErrorShares, error: f64) -> bool {
        let all: f64 = self.of_patches.iter().sum();
        let beyond = |(areas, shares): (&[f64], &[f64])| -> Vec<f64> {
            let both = areas.iter().zip(shares);
            both.filter(|(_, share)| **share > error).map(|(area, _)| *area).collect()
        };
        let patches = beyond((&self.of_patches, &shares.of_patches));
        let plates = beyond((&self.of_plates, &shares.of_plates));
        let are_small = |areas: &[f64]| areas.iter().all(|area| *area <= self.small);
        let are_few = |areas: &[f64]| areas.iter().sum::<f64>() <= FEW * all;
        [patches, plates].iter().all(|beyond| are_small(beyond) && are_few(beyond))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use crate::solve::levels::plates::Plates;
    use formfactor::PlanarPolygon;
    use glam::DVec3;

    /// A large square and so many small ones, each in a plane of its own.
    fn squares(count: u32) -> Scene {
        let square = |k: u32| {
            let (at, size) = (DVec3::Z * f64::from(k), if k == 0 { 100.0 } else { 0.1 });
            let corners = [at, at + size * DVec3::X, at + size * (DVec3::X + DVec3::Y), at + size * DVec3::Y];
            Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
        };
        Scene { patches: (0..count).map(square).collect(), bands: 1, ..Scene::default() }
    }

    /// Of few patches all are asked for, and what is small is so beside what is in view.
    #[test]
    fn the_small_are_those_of_many_in_view() {
        let is_within = |count: u32, view: Option<&[bool]>| {
            let scene = squares(count);
            let plates = Plates::of(&scene);
            let members = PlateMembers::of(&plates).unwrap();
            let off: Vec<f64> = (0..count).map(|k| if k == 1 { 0.5 } else { 0.0 }).collect();
            Asked::of(&members, view)
                .are_within(&ErrorShares { of_plates: off.clone(), of_patches: off }, 0.01)
        };
        assert!(is_within(301, None) && !is_within(300, None));
        let small: Vec<bool> = (0..301).map(|k| k > 0).collect();
        assert!(!is_within(301, Some(&small)), "one of 300 alike is no small one");
    }

    /// A hundred small patches beside two large ones, of all of which some are beyond 1 %.
    fn are_within(beyond: &[usize], small: f64) -> bool {
        let areas: Vec<f64> = [450.0, 450.0].into_iter().chain([1.0; 100]).collect();
        let shares: Vec<f64> = (0..102).map(|k| if beyond.contains(&k) { 0.5 } else { 0.01 }).collect();
        let asked = Asked { small, of_patches: areas.clone(), of_plates: areas };
        asked.are_within(&ErrorShares { of_plates: shares.clone(), of_patches: shares }, 0.01)
    }

    #[test]
    fn few_of_the_small_may_be_beyond_and_none_of_the_large() {
        let first = |count: usize| (2..2 + count).collect::<Vec<usize>>();
        assert!(are_within(&first(0), 1.0) && are_within(&first(50), 1.0));
        assert!(!are_within(&first(51), 1.0) && !are_within(&[0], 1.0));
        assert!(are_within(&[], 0.0) && !are_within(&[2], 0.0));
    }
}
