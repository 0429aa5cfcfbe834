//! What sends light in the end: patches, their pieces and their elements, each as bright as its elements are on average.
use crate::error::Error;
use crate::solve::factors::{Factors, PieceShape};
use crate::solve::light::Light;
use formfactor::{DifferentialArea, PlanarPolygon};
use glam::DVec3;
use std::f64::consts::PI;
use std::ops::Range;

/// Parts are looked at one by one where that may change more than this share.
const UNEVEN: f64 = 0.005;

/// A patch, a piece of one, or an element.
#[derive(Debug)]
pub(super) struct Sender {
    shape: PieceShape,
    /// What it sends on average, per band.
    radiosity: Vec<f64>,
    /// How far the radiosity of its elements is from that at most, per band.
    spread: Vec<f64>,
    /// What it consists of; nothing for an element.
    parts: Vec<Sender>,
    ball: Ball,
    /// Whether it is a light: then every point looks at it.
    pub(super) emits: bool,
}

/// A ball around a sender.
#[derive(Debug)]
struct Ball {
    middle: DVec3,
    radius: f64,
    normal: DVec3,
    area: f64,
}

impl Sender {
    /// A patch or a piece of one, by its node. Halves that are too thin to be outlined count as what they are parts of.
    pub(super) fn of_node(factors: &Factors<'_>, light: &Light, node: usize) -> Result<Sender, Error> {
        let piece = &factors.subdivision.nodes[node];
        let parts = match piece.halves {
            Some(halves) => {
                let halves = halves.iter().map(|half| Sender::of_node(factors, light, *half));
                halves.collect::<Result<_, _>>().unwrap_or_default()
            }
            None => Sender::of_elements(factors, light, piece.elements.clone()),
        };
        Ok(Sender::new(factors, factors.piece(node)?, light, piece.elements.clone(), parts))
    }

    /// Elements one by one; none for a single one. Those without area send nothing.
    fn of_elements(factors: &Factors<'_>, light: &Light, elements: Range<usize>) -> Vec<Sender> {
        if elements.len() < 2 {
            return Vec::new();
        }
        let sender = |element: usize| {
            Some(Sender::new(factors, factors.triangle(element)?, light, element..element + 1, Vec::new()))
        };
        elements.filter_map(sender).collect()
    }

    fn new(
        factors: &Factors<'_>,
        shape: PieceShape,
        light: &Light,
        elements: Range<usize>,
        parts: Vec<Sender>,
    ) -> Sender {
        let radiosity = light.mean_radiosity(elements.clone());
        let mut spread = vec![0.0f64; light.bands];
        for element in elements {
            for (band, spread) in spread.iter_mut().enumerate() {
                let off = light.radiosity[element * light.bands + band] - radiosity[band];
                *spread = spread.max(off.abs());
            }
        }
        let (ball, emits) = (Ball::around(&shape.polygon), factors.emits(&shape));
        Sender { shape, radiosity, spread, parts, ball, emits }
    }

    /// A bound on what a point receives, as the largest share of `of` in a band.
    pub(super) fn most(&self, point: &DifferentialArea, of: &[f64]) -> f64 {
        let brightest = self.radiosity.iter().zip(&self.spread).zip(of);
        let share = brightest.map(|((mean, spread), of)| (mean + spread) / of).fold(0.0, f64::max);
        self.ball.most_seen(point) * share
    }

    /// Adds what a point receives, part by part where these differ by more than a share of how bright the point is.
    pub(super) fn shine(
        &self,
        factors: &Factors<'_>,
        point: &DifferentialArea,
        of: &[f64],
        light: &mut [f64],
    ) {
        let factor = factors.factor(point, &self.shape);
        if factor == 0.0 {
            return;
        }
        let uneven = self.spread.iter().zip(of).map(|(spread, of)| factor * spread / of).fold(0.0, f64::max);
        if uneven > UNEVEN && !self.parts.is_empty() {
            self.parts.iter().for_each(|part| part.shine(factors, point, of, light));
            return;
        }
        light.iter_mut().zip(&self.radiosity).for_each(|(light, sent)| *light += factor * sent);
    }
}

impl Ball {
    fn around(polygon: &PlanarPolygon) -> Ball {
        let points = || polygon.loops().flatten().copied();
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let middle = low.midpoint(high);
        let radius = points().map(|point| point.distance(middle)).fold(0.0, f64::max);
        Ball { middle, radius, normal: polygon.normal(), area: polygon.area() }
    }

    /// A bound on the form factor: A cos θ cos θ' / (π d²) for the largest cosines and the least distance, and at most r² / d².
    fn most_seen(&self, point: &DifferentialArea) -> f64 {
        let way = self.middle - point.position();
        let distance = way.length();
        let near = (distance - self.radius).max(0.0);
        let least = |height: f64| (height / near).clamp(0.0, 1.0);
        let rises = way.dot(point.normal()) + self.radius;
        let stands = self.radius - way.dot(self.normal);
        if rises <= 0.0 || stands <= 0.0 {
            return 0.0;
        }
        if near == 0.0 {
            return 1.0;
        }
        let far = self.area * least(rises) * least(stands) / (PI * near * near);
        far.min((self.radius / distance).powi(2)).min(1.0)
    }
}
