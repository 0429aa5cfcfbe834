//! Path tracing: lamps and directions are both sampled, weighed by the balance heuristic [Veach and Guibas 1995], so that no sample is
//! much larger than the mean, next to a lamp either.
use super::{Bands, Surface, boxes::Boxes, surface::Plane};
use crate::random::Random;
use glam::DVec3;
use std::f64::consts::PI;

/// A mean of samples and its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// One standard error of it.
    pub error: f64,
}

/// The mean irradiance of a surface's front, W/m², by so many paths.
///
/// # Panics
/// When there is no surface of that index.
pub fn mean_irradiance(surfaces: &[Surface], of: usize, paths: u32, seed: u64) -> [Estimate; 3] {
    let tracer = Tracer::new(surfaces);
    let mut random = Random::new(seed);
    let (mut sums, mut squares) = ([0.0; 3], [0.0; 3]);
    for _ in 0..paths {
        let start = tracer.planes[of].any_point(&mut random);
        let sample = tracer.irradiance(start, of, &mut random);
        for band in 0..3 {
            sums[band] += sample[band];
            squares[band] += sample[band] * sample[band];
        }
    }
    let count = f64::from(paths);
    [0, 1, 2].map(|band| {
        let mean = sums[band] / count;
        let variance = (squares[band] / count - mean * mean).max(0.0);
        Estimate { mean, error: (variance / (count - 1.0)).sqrt() }
    })
}

struct Tracer<'s> {
    surfaces: &'s [Surface],
    planes: Vec<Plane>,
    boxes: Boxes,
    /// The lamps, each with the sum of the powers up to it, all together 1.
    lamps: Vec<(usize, f64)>,
    /// Per surface, how probable it is as a lamp, over its area.
    density: Vec<f64>,
    /// What starts on a surface meets nothing nearer.
    least: f64,
}

impl<'s> Tracer<'s> {
    fn new(surfaces: &'s [Surface]) -> Self {
        let planes: Vec<Plane> = surfaces.iter().map(Plane::of).collect();
        let power = |i: usize| planes[i].area * surfaces[i].radiance.iter().sum::<f64>();
        let all: f64 = (0..surfaces.len()).map(power).sum();
        let mut sum = 0.0;
        let mut lamps = Vec::new();
        for lamp in (0..surfaces.len()).filter(|i| power(*i) > 0.0) {
            sum += power(lamp) / all;
            lamps.push((lamp, sum));
        }
        let density = (0..surfaces.len()).map(|i| power(i) / all / planes[i].area).collect();
        let size =
            surfaces.iter().flat_map(|s| s.loops.iter().flatten()).map(|p| p.length()).fold(0.0, f64::max);
        Self { boxes: Boxes::around(surfaces), surfaces, planes, lamps, density, least: 1e-9 * size }
    }

    /// The first surface on a ray of unit direction, and how far it is.
    fn hit(&self, from: DVec3, direction: DVec3, own: usize) -> Option<(usize, f64)> {
        let others = self.boxes.along(from, direction).filter(|other| *other != own);
        let met =
            others.filter_map(|other| Some((other, self.planes[other].meets(from, direction, self.least)?)));
        met.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
    }

    /// A sample of the irradiance of a point.
    fn irradiance(&self, start: DVec3, start_on: usize, random: &mut Random) -> Bands {
        let (mut at, mut on, mut share, mut sum) = (start, start_on, [1.0; 3], [0.0; 3]);
        for bounce in 0.. {
            let direct = self.lamplight(at, on, random);
            (0..3).for_each(|band| sum[band] += share[band] * direct[band]);
            let direction = self.planes[on].any_direction(random);
            let Some((next, far)) = self.hit(at, direction, on) else { break };
            let facing = -direction.dot(self.planes[next].normal);
            if facing <= 0.0 {
                break;
            }
            let by_cosine = direction.dot(self.planes[on].normal) / PI;
            let weight = by_cosine / (by_cosine + self.density[next] * far * far / facing);
            let Surface { radiance, reflectance, .. } = &self.surfaces[next];
            for band in 0..3 {
                sum[band] += share[band] * weight * PI * radiance[band];
                share[band] *= reflectance[band];
            }
            let keep = share.iter().copied().fold(0.0, f64::max).min(1.0);
            if bounce >= 2 {
                if random.unit() >= keep {
                    break;
                }
                share = share.map(|share| share / keep);
            }
            (at, on) = (at + direction * far, next);
        }
        sum
    }

    /// A sample of what comes straight from the lamps, weighed against directions by the cosine.
    fn lamplight(&self, at: DVec3, on: usize, random: &mut Random) -> Bands {
        let pick = random.unit();
        let chosen = self.lamps.iter().find(|(_, sum)| pick < *sum).or(self.lamps.last());
        let Some(&(lamp, _)) = chosen.filter(|(lamp, _)| *lamp != on) else { return [0.0; 3] };
        let way = self.planes[lamp].any_point(random) - at;
        let (far, direction) = (way.length(), way.normalize_or_zero());
        let [leaving, arriving] =
            [-direction.dot(self.planes[lamp].normal), direction.dot(self.planes[on].normal)];
        if leaving <= 0.0 || arriving <= 0.0 {
            return [0.0; 3];
        }
        let is_seen = self.hit(at, direction, on).is_some_and(|(first, _)| first == lamp);
        let by_lamp = self.density[lamp] * far * far / leaving;
        let weight = if is_seen { arriving / (by_lamp + arriving / PI) } else { 0.0 };
        self.surfaces[lamp].radiance.map(|radiance| radiance * weight)
    }
}
