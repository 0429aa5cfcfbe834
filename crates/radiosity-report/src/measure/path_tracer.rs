//! Path tracing, to hold radiosity against: nothing of form factors is used.
//!
//! The irradiance of a point is what comes straight from an emitter, sampled by its area, and what the surface in a direction, sampled
//! by the cosine, reflects of its own irradiance, and so on; long paths end by Russian roulette.
use glam::{DVec2, DVec3};
use radiosity::{Patch, Scene};
use std::f64::consts::TAU;

/// A path goes on with certainty for so many reflections.
const CERTAIN: u32 = 3;
/// Nothing closer than this share of a scene's size is met: a ray does not meet what it starts on.
const CLOSE: f64 = 1e-9;

/// A scene as rays meet it.
#[derive(Debug)]
pub(crate) struct PathTracer {
    sheets: Vec<Sheet>,
    /// The emitters, each with its share of all emitters' area.
    emitters: Vec<(usize, f64)>,
    close: f64,
}

/// A patch in a frame of its own.
#[derive(Debug)]
struct Sheet {
    normal: DVec3,
    origin: DVec3,
    axes: [DVec3; 2],
    edges: Vec<[DVec2; 2]>,
    low: DVec2,
    high: DVec2,
    area: f64,
    reflectance: [f64; 3],
    emission: [f64; 3],
}

impl PathTracer {
    /// Of a scene in red, green and blue.
    pub(crate) fn new(scene: &Scene) -> PathTracer {
        let sheets: Vec<Sheet> = scene.patches.iter().map(Sheet::of).collect();
        let lit =
            || scene.patches.iter().enumerate().filter(|(_, patch)| patch.emits()).map(|(index, _)| index);
        let all: f64 = lit().map(|index| sheets[index].area).sum();
        let emitters = lit().map(|index| (index, sheets[index].area / all)).collect();
        let [low, high] = scene.extent();
        PathTracer { sheets, emitters, close: CLOSE * (high - low).max_element() }
    }

    /// The mean irradiance of some patches together, by so many paths.
    pub(crate) fn irradiance(&self, patches: &[usize], paths: u32, seed: u64) -> [f64; 3] {
        let mut random = Random(seed);
        let areas: f64 = patches.iter().map(|&patch| self.sheets[patch].area).sum();
        let mut sum = [0.0; 3];
        for _ in 0..paths {
            let mut left = random.unit() * areas;
            let mut on = patches[0];
            for &patch in patches {
                on = patch;
                left -= self.sheets[patch].area;
                if left < 0.0 {
                    break;
                }
            }
            let start = self.sheets[on].any_point(&mut random);
            let sample = self.path(start, on, &mut random);
            (0..3).for_each(|band| sum[band] += sample[band]);
        }
        sum.map(|total| total / f64::from(paths))
    }

    /// One sample of the irradiance of a point.
    fn path(&self, mut at: DVec3, mut on: usize, random: &mut Random) -> [f64; 3] {
        let (mut sum, mut weight) = ([0.0; 3], [1.0; 3]);
        for reflections in 0.. {
            let direct = self.direct(at, on, random);
            (0..3).for_each(|band| sum[band] += weight[band] * direct[band]);
            let direction = self.sheets[on].any_direction(random);
            let Some((next, far)) = self.first(at, direction) else { break };
            let sheet = &self.sheets[next];
            if direction.dot(sheet.normal) >= 0.0 {
                break;
            }
            (0..3).for_each(|band| weight[band] *= sheet.reflectance[band]);
            let goes_on = weight.into_iter().fold(0.0, f64::max).min(1.0);
            if reflections >= CERTAIN {
                if random.unit() >= goes_on {
                    break;
                }
                weight = weight.map(|share| share / goes_on);
            }
            (at, on) = (at + direction * far, next);
        }
        sum
    }

    /// What comes straight from a point of an emitter.
    fn direct(&self, at: DVec3, on: usize, random: &mut Random) -> [f64; 3] {
        let mut left = random.unit();
        let picked = self.emitters.iter().find(|(_, share)| {
            left -= share;
            left < 0.0
        });
        let Some(&(emitter, share)) = picked.or(self.emitters.last()) else { return [0.0; 3] };
        let sheet = &self.sheets[emitter];
        let arm = sheet.any_point(random) - at;
        let [here, there] = [arm.dot(self.sheets[on].normal), -arm.dot(sheet.normal)];
        if here <= 0.0 || there <= 0.0 || self.is_hidden(at, arm, emitter) {
            return [0.0; 3];
        }
        let density = share / sheet.area;
        sheet.emission.map(|radiance| radiance * here * there / arm.length_squared().powi(2) / density)
    }

    /// Whether something but the emitter is met on the way to it.
    fn is_hidden(&self, at: DVec3, arm: DVec3, emitter: usize) -> bool {
        let least = self.close / arm.length();
        let blocks = |sheet: &Sheet| sheet.meets(at, arm, least).is_some_and(|far| far < 1.0 - least);
        self.sheets.iter().enumerate().any(|(index, sheet)| index != emitter && blocks(sheet))
    }

    /// The patch that a ray meets first, and how far away.
    fn first(&self, at: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let met = self.sheets.iter().map(|sheet| sheet.meets(at, direction, self.close)).enumerate();
        met.filter_map(|(index, far)| Some((index, far?))).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Sheet {
    fn of(patch: &Patch) -> Sheet {
        let polygon = &patch.polygon;
        let points: Vec<&[DVec3]> = polygon.loops().collect();
        let (normal, origin) = (polygon.normal(), points[0][0]);
        let x = (points[0][1] - origin).normalize();
        let axes = [x, normal.cross(x)];
        let flat = |p: DVec3| DVec2::new((p - origin).dot(axes[0]), (p - origin).dot(axes[1]));
        let sides = |ring: &&[DVec3]| -> Vec<[DVec2; 2]> {
            (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]].map(flat)).collect()
        };
        let edges: Vec<[DVec2; 2]> = points.iter().flat_map(sides).collect();
        let low = edges.iter().map(|[a, _]| *a).fold(DVec2::INFINITY, DVec2::min);
        let high = edges.iter().map(|[a, _]| *a).fold(DVec2::NEG_INFINITY, DVec2::max);
        let bands = |values: &[f64]| [0, 1, 2].map(|band| values[band.min(values.len() - 1)]);
        let (reflectance, emission) = (bands(&patch.reflectance), bands(&patch.emission));
        Sheet { normal, origin, axes, edges, low, high, area: polygon.area(), reflectance, emission }
    }

    /// How far along a ray it is met, in lengths of its direction; nothing closer than `least` counts.
    fn meets(&self, at: DVec3, direction: DVec3, least: f64) -> Option<f64> {
        let far = (self.origin - at).dot(self.normal) / direction.dot(self.normal);
        if !(far > least && far.is_finite()) {
            return None;
        }
        let arm = at + direction * far - self.origin;
        self.holds(DVec2::new(arm.dot(self.axes[0]), arm.dot(self.axes[1]))).then_some(far)
    }

    /// Whether a point of its plane is inside, by the even-odd rule.
    fn holds(&self, point: DVec2) -> bool {
        let is_crossed = |[a, b]: &&[DVec2; 2]| {
            (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        self.edges.iter().filter(is_crossed).count() % 2 == 1
    }

    /// A point anywhere on it.
    fn any_point(&self, random: &mut Random) -> DVec3 {
        loop {
            let point = self.low + (self.high - self.low) * DVec2::new(random.unit(), random.unit());
            if self.holds(point) {
                return self.origin + self.axes[0] * point.x + self.axes[1] * point.y;
            }
        }
    }

    /// A direction above it, by the cosine.
    fn any_direction(&self, random: &mut Random) -> DVec3 {
        let (square, angle) = (random.unit(), TAU * random.unit());
        let plane = DVec2::from_angle(angle) * square.sqrt();
        self.axes[0] * plane.x + self.axes[1] * plane.y + self.normal * (1.0 - square).sqrt()
    }
}

/// Numbers that look random (splitmix64, Steele, Lea and Flood 2014).
#[derive(Debug)]
struct Random(u64);

impl Random {
    /// From 0 to below 1.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity::scenes;
    use std::f64::consts::PI;

    #[test]
    fn a_furnace_is_as_bright_as_all_its_reflections() {
        // Radiosity 1 everywhere in a closed room: every face receives 1. Emitters touch what they light, so samples vary much.
        let scene = scenes::scene("furnace-0.5").unwrap();
        let tracer = PathTracer::new(&scene);
        for face in 0..scene.patches.len() {
            let found = tracer.irradiance(&[face], 40_000, 1);
            assert!(found.iter().all(|h| (h - 1.0).abs() < 0.05), "{face}: {found:?}");
        }
    }

    #[test]
    fn direct_light_is_the_form_factor() {
        // Black unit squares at 1: F = 0.199825 (Howell, C-11), E = π L F.
        let scene = scenes::scene("cornell-box").unwrap();
        let square = |z: f64, up: bool| {
            let mut ring = [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
            if !up {
                ring.reverse();
            }
            formfactor::PlanarPolygon::new([ring]).unwrap()
        };
        let patch = |name: &str, polygon, radiance: f64| {
            radiosity::Patch::new(name, polygon, vec![0.0; 3], vec![radiance; 3])
        };
        let patches = vec![patch("floor", square(0.0, true), 0.0), patch("lamp", square(1.0, false), 2.0)];
        let scene = Scene { patches, ..scene };
        let found = PathTracer::new(&scene).irradiance(&[0], 100_000, 7);
        assert!((found[0] / (2.0 * PI * 0.199_824_895_7) - 1.0).abs() < 0.01, "{found:?}");
    }
}
