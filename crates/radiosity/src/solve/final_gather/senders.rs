//! What sends light in the end: patches, their pieces and their elements, each as bright as its elements are on average.
use crate::error::Error;
use crate::solve::factors::{Factors, PieceShape};
use crate::solve::{ball::Ball, light::Light};
use formfactor::{Blockers, DifferentialArea};
use std::ops::Range;

/// A point that is looked from, and how bright it is, per band.
#[derive(Clone, Copy, Debug)]
pub(super) struct LitPoint<'v> {
    pub(super) point: &'v DifferentialArea,
    pub(super) of: &'v [f64],
    /// Parts of what is looked at are looked at one by one where that may change more than this share of the brightness.
    pub(super) uneven: f64,
}

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
        let (ball, emits) = (Ball::around(&shape.polygon), factors.emits(shape.patch));
        Sender { shape, radiosity, spread, parts, ball, emits }
    }

    /// A bound on what a point receives, as the largest share of `of` in a band.
    pub(super) fn most(&self, point: &DifferentialArea, of: &[f64]) -> f64 {
        let brightest = self.radiosity.iter().zip(&self.spread).zip(of);
        let share = brightest.map(|((mean, spread), of)| (mean + spread) / of).fold(0.0, f64::max);
        self.ball.most_seen(point) * share
    }

    /// Whether it may be nearer to a point than that.
    pub(super) fn is_within(&self, distance: f64, point: &DifferentialArea) -> bool {
        self.ball.least_distance(point) < distance
    }

    /// Adds what a point receives, part by part where these differ by more than a share of how bright the point is.
    pub(super) fn shine(&self, factors: &Factors<'_>, from: &LitPoint<'_>, light: &mut [f64]) {
        let seen = factors.factor_and_blockers(from.point, &self.shape);
        self.add(factors, from, &seen, light);
    }

    /// Adds what a point receives of a part of what was looked at past some blockers.
    ///
    /// It is looked at as a whole only if it is even enough with nothing in between: else its parts are looked at in any case.
    fn shine_behind(
        &self,
        factors: &Factors<'_>,
        from: &LitPoint<'_>,
        blockers: &Blockers,
        light: &mut [f64],
    ) {
        let unhidden = || factors.factor_behind(from.point, &self.shape, &Blockers::default()).0;
        if !self.parts.is_empty() && self.is_uneven(unhidden(), from) {
            if let Some(blockers) = factors.blockers_of_part(from.point, &self.shape, blockers) {
                self.parts.iter().for_each(|part| part.shine_behind(factors, from, &blockers, light));
            }
        } else {
            let seen = factors.factor_behind(from.point, &self.shape, blockers);
            self.add(factors, from, &seen, light);
        }
    }

    fn add(
        &self,
        factors: &Factors<'_>,
        from: &LitPoint<'_>,
        (factor, blockers): &(f64, Blockers),
        light: &mut [f64],
    ) {
        if *factor == 0.0 {
        } else if !self.parts.is_empty() && self.is_uneven(*factor, from) {
            self.parts.iter().for_each(|part| part.shine_behind(factors, from, blockers, light));
        } else {
            light.iter_mut().zip(&self.radiosity).for_each(|(light, sent)| *light += factor * sent);
        }
    }

    /// Whether parts of it bring unlike shares.
    fn is_uneven(&self, factor: f64, from: &LitPoint<'_>) -> bool {
        self.spread.iter().zip(from.of).any(|(spread, of)| factor * spread / of > from.uneven)
    }
}
