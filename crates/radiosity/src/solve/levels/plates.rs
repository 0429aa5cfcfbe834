//! Plates: patches that are alike and continue each other in one plane are solved for as one.
//!
//! ```text
//! +---+---+---+---+        +---------------+
//! |   |   |   |   |        |               |    a wall that comes as a thousand tiles is as hard to light as the wall; its light is
//! +---+---+---+---+   ->   |               |    told tile by tile in the end
//! |   |   |   |   |        |               |
//! +---+---+---+---+        +---------------+
//! ```
use crate::mesh::{convex::convex_parts, frame::Frame};
use crate::scene::{Scene, patch::Patch};
use crate::solve::occluders::{Occluders, groups, outline};
use formfactor::PlanarPolygon;
use std::borrow::Cow;

/// No more patches than these are told apart at little cost: each is a plate by itself.
const FEW: usize = 300;
/// The area of a plate is that of its members but for such a share.
const SAME: f64 = 1e-9;

/// Whether a scene has many patches.
pub(super) fn is_large(scene: &Scene) -> bool {
    scene.patches.len() > FEW
}

/// A scene in plates.
#[derive(Debug)]
pub(crate) struct Plates<'s> {
    /// As it was given.
    pub(super) given: &'s Scene,
    /// With one patch for each plate.
    pub(super) scene: Cow<'s, Scene>,
    /// What hides light, and which of it each plate is a part of.
    pub(super) occluders: Occluders,
    /// The patches that each plate is made of, ascending.
    pub(super) members: Vec<Vec<usize>>,
}

impl<'s> Plates<'s> {
    /// O(n log n) for n vertices.
    pub(crate) fn of(given: &'s Scene) -> Plates<'s> {
        let Occluders { polygons, of_patch } = Occluders::join(given);
        let is_large = is_large(given);
        let joins = |[one, other]: [usize; 2]| {
            is_large
                && of_patch[one] == of_patch[other]
                && are_alike(&given.patches[one], &given.patches[other])
        };
        let (mut members, mut patches) = (Vec::new(), Vec::new());
        for group in groups(given, joins) {
            if let Some(polygon) = whole(given, &group) {
                patches.push(Patch { polygon, ..given.patches[group[0]].clone() });
                members.push(group);
            } else {
                patches.extend(group.iter().map(|&patch| given.patches[patch].clone()));
                members.extend(group.into_iter().map(|patch| vec![patch]));
            }
        }
        let is_given = members.len() == given.patches.len();
        let scene =
            if is_given { Cow::Borrowed(given) } else { Cow::Owned(Scene { patches, ..given.clone() }) };
        let of_patch = members.iter().map(|members| of_patch[members[0]]).collect();
        Plates { given, scene, occluders: Occluders { polygons, of_patch }, members }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.members.len()
    }

    /// Whether a plate is made of several patches.
    pub(super) fn is_joined(&self, plate: usize) -> bool {
        self.members[plate].len() > 1
    }

    /// The mean area of the patches of a plate that is made of several.
    pub(super) fn grain(&self, plate: usize) -> Option<f64> {
        let area = self.scene.patches[plate].polygon.area();
        self.is_joined(plate).then(|| area / self.members[plate].len() as f64)
    }

    /// Whether something is true of a patch of each plate.
    pub(super) fn any(&self, of_patch: &[bool]) -> Vec<bool> {
        self.members.iter().map(|members| members.iter().any(|&patch| of_patch[patch])).collect()
    }

    /// The plate of each patch.
    pub(super) fn of_patches(&self) -> Vec<usize> {
        let mut plates = vec![0; self.given.patches.len()];
        for (plate, members) in self.members.iter().enumerate() {
            members.iter().for_each(|&patch| plates[patch] = plate);
        }
        plates
    }
}

/// Whether light goes the same way from two patches.
fn are_alike(one: &Patch, other: &Patch) -> bool {
    one.texture.is_none()
        && other.texture.is_none()
        && one.reflectance == other.reflectance
        && one.emission == other.emission
        && one.only_blocks == other.only_blocks
}

/// What several patches are together, where that is a polygon that can be cut as they can.
fn whole(scene: &Scene, patches: &[usize]) -> Option<PlanarPolygon> {
    let polygon = if patches.len() > 1 { outline(scene, patches)? } else { return None };
    let area: f64 = patches.iter().map(|&patch| scene.patches[patch].polygon.area()).sum();
    let is_same = (polygon.area() / area - 1.0).abs() < SAME;
    (is_same && convex_parts(&polygon, &Frame::new(&polygon)).is_ok()).then_some(polygon)
}
