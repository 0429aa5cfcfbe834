//! What faces of scenes truly receive: mean irradiance, with a standard error.
use radiosity::{Scene, Solution};

/// A face, its mean irradiance in red, green and blue, and one standard error of each.
type KnownFace = (&'static str, [f64; 3], [f64; 3]);

/// The Cornell box, by path tracing that samples the emitter at each vertex, 3 million paths a face in red, 1.5 million in green
/// and blue.
const CORNELL_BOX: [KnownFace; 15] = [
    ("floor", [0.48287, 0.32786, 0.09268], [0.00026, 0.00026, 0.00008]),
    ("back", [0.73276, 0.49069, 0.13809], [0.00029, 0.00028, 0.00008]),
    ("right", [0.78971, 0.53321, 0.15855], [0.00028, 0.00026, 0.00008]),
    ("left", [0.70241, 0.45387, 0.13563], [0.00032, 0.00030, 0.00009]),
    ("short-top", [1.37391, 0.98230, 0.30093], [0.00025, 0.00023, 0.00007]),
    ("short-1", [0.46506, 0.23902, 0.07111], [0.00019, 0.00017, 0.00005]),
    ("short-2", [0.05936, 0.02634, 0.00741], [0.00010, 0.00007, 0.00002]),
    ("short-3", [0.07767, 0.14030, 0.01184], [0.00007, 0.00011, 0.00002]),
    ("short-4", [0.42589, 0.36797, 0.08115], [0.00019, 0.00016, 0.00005]),
    ("tall-top", [3.15256, 2.12575, 0.69089], [0.00065, 0.00065, 0.00021]),
    ("tall-1", [0.36537, 0.03617, 0.00929], [0.00020, 0.00006, 0.00002]),
    ("tall-2", [0.42927, 0.21125, 0.05765], [0.00021, 0.00019, 0.00005]),
    ("tall-3", [0.40027, 0.36476, 0.07567], [0.00020, 0.00017, 0.00006]),
    ("tall-4", [0.34399, 0.21801, 0.06113], [0.00021, 0.00019, 0.00006]),
    ("ceiling", [0.43989, 0.26831, 0.06567], [0.00035, 0.00033, 0.00010]),
];

/// Two rooms with a thin wall between them, one of them dark: as `cargo run --release -p tests --example light_truth --
/// separating-wall 16000000` prints them.
const SEPARATING_WALL: [KnownFace; 8] = [
    ("floor", [0.976554, 0.976554, 0.976554], [0.000351, 0.000351, 0.000351]),
    ("ceiling", [0.564404, 0.564404, 0.564404], [0.000287, 0.000287, 0.000287]),
    ("south", [0.777846, 0.777846, 0.777846], [0.000323, 0.000323, 0.000323]),
    ("north", [0.778314, 0.778314, 0.778314], [0.000324, 0.000324, 0.000324]),
    ("west", [1.555884, 1.555884, 1.555884], [0.000365, 0.000365, 0.000365]),
    ("east", [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
    ("wall-west", [1.555922, 1.555922, 1.555922], [0.000366, 0.000366, 0.000366]),
    ("wall-east", [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
];

/// The scenes whose faces are known.
const SCENES: [(&str, &[KnownFace]); 2] =
    [("cornell-box", &CORNELL_BOX), ("separating-wall", &SEPARATING_WALL)];

/// A deviation counts in units of what a face receives, or of this share of what faces receive on average, if that is more.
const LEAST: f64 = 0.01;

/// Faces and what they receive.
#[derive(Debug)]
pub(crate) struct Truth {
    faces: Vec<Face>,
    /// For each band, the mean over all faces.
    means: [f64; 3],
}

/// The patches of one face.
#[derive(Debug)]
struct Face {
    patches: Vec<usize>,
    irradiance: [f64; 3],
    errors: [f64; 3],
}

impl Truth {
    /// Of a built-in scene, if it is known; a face is the patch of its name, or all of its pieces `name.k`.
    pub(crate) fn of(name: &str, scene: &Scene) -> Option<Truth> {
        let (_, known) = SCENES.iter().find(|(known, _)| *known == name)?;
        let pieces = |face: &str| -> Vec<usize> {
            let is_of = |name: &str| name == face || name.starts_with(&format!("{face}."));
            (0..scene.patches.len()).filter(|&patch| is_of(&scene.patches[patch].name)).collect()
        };
        let face =
            |&(name, irradiance, errors): &KnownFace| Face { patches: pieces(name), irradiance, errors };
        let faces: Vec<Face> = known.iter().map(face).collect();
        let mean = |band: usize| {
            let areas = || faces.iter().map(|face| area(scene, &face.patches));
            let received = faces.iter().zip(areas()).map(|(face, area)| face.irradiance[band] * area);
            received.sum::<f64>() / areas().sum::<f64>()
        };
        Some(Truth { means: [0, 1, 2].map(mean), faces })
    }

    /// The patches of each face.
    pub(crate) fn faces(&self) -> impl Iterator<Item = &[usize]> {
        self.faces.iter().map(|face| face.patches.as_slice())
    }

    /// How far what the faces receive is from the truth, for each face and band.
    pub(crate) fn deviations(&self, found: &[[f64; 3]]) -> Vec<f64> {
        let off = |(face, found): (&Face, &[f64; 3])| {
            [0, 1, 2].map(|band| (found[band] - face.irradiance[band]).abs() / self.unit(face, band))
        };
        self.faces.iter().zip(found).flat_map(off).collect()
    }

    /// One standard error of the truth itself, for each face and band, in the same units.
    pub(crate) fn noise(&self) -> Vec<f64> {
        let noise = |face: &Face| [0, 1, 2].map(|band| face.errors[band] / self.unit(face, band));
        self.faces.iter().flat_map(noise).collect()
    }

    fn unit(&self, face: &Face, band: usize) -> f64 {
        face.irradiance[band].max(LEAST * self.means[band])
    }

    /// What each face receives by a solution.
    pub(crate) fn received(&self, scene: &Scene, solution: &Solution) -> Vec<[f64; 3]> {
        let means = solution.patch_means(&solution.irradiance, scene.patches.len());
        self.of_faces(scene, |patch, band| means[patch][band])
    }

    /// What each face receives, by what each patch receives in each band.
    pub(crate) fn of_faces(&self, scene: &Scene, mean_of: impl Fn(usize, usize) -> f64) -> Vec<[f64; 3]> {
        let mean = |patches: &[usize]| {
            let received = |band: usize| {
                patches.iter().map(|&patch| mean_of(patch, band) * area(scene, &[patch])).sum::<f64>()
            };
            [0, 1, 2].map(|band| received(band) / area(scene, patches))
        };
        self.faces().map(mean).collect()
    }
}

/// The area of some patches together.
pub(crate) fn area(scene: &Scene, patches: &[usize]) -> f64 {
    patches.iter().map(|&patch| scene.patches[patch].polygon.area()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity::scenes;

    #[test]
    fn every_face_is_known_once_and_well() {
        for (name, known) in SCENES {
            let scene = scenes::scene(name).unwrap();
            let truth = Truth::of(name, &scene).unwrap();
            let mut patches: Vec<usize> = truth.faces().flatten().copied().collect();
            patches.sort_unstable();
            let dark: Vec<usize> = (0..scene.patches.len()).filter(|&p| !scene.patches[p].emits()).collect();
            assert_eq!(patches, dark, "{name}: all but the emitter");
            assert!(truth.noise().into_iter().all(|noise| noise < 3e-3), "{name}");
            let exact: Vec<[f64; 3]> = known.iter().map(|(_, irradiance, _)| *irradiance).collect();
            assert!(truth.deviations(&exact).iter().all(|off| *off == 0.0));
            let brighter: Vec<[f64; 3]> = exact.iter().map(|bands| bands.map(|h| 1.02 * h)).collect();
            assert!(truth.deviations(&brighter).iter().all(|off| *off <= 0.02 + 1e-12));
        }
        assert!(Truth::of("furnace", &scenes::scene("furnace").unwrap()).is_none());
    }
}
