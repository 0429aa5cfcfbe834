//! Who shoots: pieces of patches, and what each has sent so far.
use super::light::Light;
use crate::mesh::{subdivide::Subdivision, tree::Node};
use std::ops::Range;

/// A piece, and what it has sent per band.
#[derive(Clone, Debug)]
struct Shooter {
    node: usize,
    area: f64,
    /// Radiosity shot so far.
    shot: Vec<f64>,
    /// Power still to be shot, of either sign: Σ A (B − shot) over the piece's elements.
    unshot: Vec<f64>,
}

/// The pieces that shoot; together they cover every patch that may send light once.
#[derive(Debug)]
pub(super) struct Shooters<'s> {
    nodes: &'s [Node],
    front: Vec<Shooter>,
    /// Power shot so far, per band.
    pub(super) sent: Vec<f64>,
    /// How many shots were made.
    pub(super) shots: usize,
}

impl<'s> Shooters<'s> {
    /// Each of the patches is one shooter and has shot nothing.
    pub(super) fn new(
        patches: impl Iterator<Item = usize>,
        subdivision: &'s Subdivision,
        light: &Light,
    ) -> Shooters<'s> {
        let none = vec![0.0; light.bands];
        let nodes = &subdivision.nodes;
        let front = patches.map(|node| Shooter::new(node, nodes, &none, light)).collect();
        Shooters { nodes, front, sent: none, shots: 0 }
    }

    /// Measures what every piece has yet to shoot; gives its share of the emitted power per band.
    pub(super) fn measure(&mut self, light: &Light) -> Vec<f64> {
        for shooter in &mut self.front {
            shooter.measure(&self.nodes[shooter.node], light);
        }
        let share = |(band, &emitted): (usize, &f64)| {
            let unshot: f64 = self.front.iter().map(|shooter| shooter.unshot[band].abs()).sum();
            if unshot == 0.0 { 0.0 } else { unshot / emitted }
        };
        light.emitted.iter().enumerate().map(share).collect()
    }

    /// The piece with the most power to shoot, in shares of what is emitted in each band.
    pub(super) fn strongest(&self, emitted: &[f64]) -> usize {
        self.first(|shooter| shares(&shooter.unshot, emitted))
    }

    /// The piece with the most radiosity to shoot, in shares of how bright each band is.
    pub(super) fn brightest(&self, brightness: &[f64]) -> usize {
        self.first(|shooter| shares(&shooter.unshot, brightness) / shooter.area)
    }

    /// The piece of which most can be said; of equal ones the first.
    fn first(&self, measure: impl Fn(&Shooter) -> f64) -> usize {
        let larger = |a, b| if measure(&self.front[b]) > measure(&self.front[a]) { b } else { a };
        (0..self.front.len()).reduce(larger).unwrap_or(0)
    }

    /// The power that leaves all pieces, over all bands: of which `spread` is a share.
    fn flux(&self) -> f64 {
        let flux = |shooter: &Shooter| {
            let powers = shooter.shot.iter().zip(&shooter.unshot);
            powers.map(|(shot, unshot)| (shot * shooter.area + unshot).abs()).sum::<f64>()
        };
        self.front.iter().map(flux).sum()
    }

    /// Splits a piece whose power deviates from a uniform piece's by more than `spread` of all power, or at all when
    /// something stands on it: light must not pass to the other side. Tells whether it did. The halves inherit what
    /// the piece has shot.
    pub(super) fn split(&mut self, index: usize, light: &Light, spread: f64) -> bool {
        let limit = spread * self.flux();
        self.split_beyond(index, light, limit)
    }

    /// Splits every piece that [`Shooters::split`] would, and the halves likewise; tells whether there was one.
    pub(super) fn split_all(&mut self, light: &Light, spread: f64) -> bool {
        let limit = spread * self.flux();
        let before = self.front.len();
        (0..before).for_each(|index| self.split_down(index, light, limit));
        self.front.len() > before
    }

    /// Splits a piece as far as the mesh goes.
    pub(super) fn split_wholly(&mut self, index: usize, light: &Light) {
        self.split_down(index, light, f64::NEG_INFINITY);
    }

    /// Splits a piece and its halves while their power deviates by more than `limit`.
    fn split_down(&mut self, index: usize, light: &Light, limit: f64) {
        let mut open = vec![index];
        while let Some(index) = open.pop() {
            if self.split_beyond(index, light, limit) {
                open.extend([self.front.len() - 1, index]);
            }
        }
    }

    /// Splits a piece whose power deviates by more than `limit`.
    fn split_beyond(&mut self, index: usize, light: &Light, limit: f64) -> bool {
        let shooter = &self.front[index];
        let node = &self.nodes[shooter.node];
        let Some(halves) = node.halves else { return false };
        let limit = if node.parted { limit.min(0.0) } else { limit };
        if shooter.deviation(node, light) <= limit {
            return false;
        }
        let [first, second] = halves.map(|half| Shooter::new(half, self.nodes, &shooter.shot, light));
        self.front[index] = first;
        self.front.push(second);
        true
    }

    /// Lets a piece shoot all it has; gives the radiosity per band.
    pub(super) fn shoot(&mut self, index: usize) -> Vec<f64> {
        let shooter = &mut self.front[index];
        let radiosity: Vec<f64> = shooter.unshot.iter().map(|power| power / shooter.area).collect();
        for (band, sent) in self.sent.iter_mut().enumerate() {
            shooter.shot[band] += radiosity[band];
            *sent += radiosity[band] * shooter.area;
        }
        self.shots += 1;
        radiosity
    }

    /// Says what every piece has shot: pieces × bands.
    pub(super) fn set(&mut self, shot: &[f64]) {
        let bands = self.sent.len();
        self.sent.fill(0.0);
        for (shooter, shot) in self.front.iter_mut().zip(shot.chunks_exact(bands)) {
            shooter.shot.copy_from_slice(shot);
            self.sent.iter_mut().zip(shot).for_each(|(sent, shot)| *sent += shot * shooter.area);
        }
    }

    /// How many pieces there are.
    pub(super) fn len(&self) -> usize {
        self.front.len()
    }

    /// The node of a piece.
    pub(super) fn node(&self, index: usize) -> usize {
        self.front[index].node
    }

    /// What a piece has shot, per band.
    pub(super) fn shot(&self, index: usize) -> &[f64] {
        &self.front[index].shot
    }

    /// The power that a piece has not shot, all bands together, as measured last.
    pub(super) fn power(&self, index: usize) -> f64 {
        self.front[index].unshot.iter().map(|power| power.abs()).sum()
    }

    /// The nodes of all pieces.
    pub(super) fn front(&self) -> impl Iterator<Item = usize> {
        self.front.iter().map(|shooter| shooter.node)
    }

    /// The elements of a piece.
    pub(super) fn elements(&self, index: usize) -> &'s Range<usize> {
        &self.nodes[self.node(index)].elements
    }

    /// Radiosity still to be shot, of every element: elements × bands.
    pub(super) fn unshot_radiosity(&self, light: &Light) -> Vec<f64> {
        let mut unshot = vec![0.0; light.radiosity.len()];
        for shooter in &self.front {
            for element in self.nodes[shooter.node].elements.clone() {
                for (band, shot) in shooter.shot.iter().enumerate() {
                    let at = element * light.bands + band;
                    unshot[at] = light.radiosity[at] - shot;
                }
            }
        }
        unshot
    }

    /// Power still to be shot, per band, as measured last.
    pub(super) fn unshot(&self) -> Vec<f64> {
        let band = |band| self.front.iter().map(|shooter| shooter.unshot[band]).sum();
        (0..self.sent.len()).map(band).collect()
    }

    /// The largest radiosity still to be shot, per band, as measured last.
    pub(super) fn peak(&self) -> Vec<f64> {
        let radiosity =
            |band: usize| self.front.iter().map(move |shooter| shooter.unshot[band] / shooter.area);
        (0..self.sent.len()).map(|band| radiosity(band).map(f64::abs).fold(0.0, f64::max)).collect()
    }

    /// The largest radiosity that was shot by pieces of those patches, per band.
    pub(super) fn brightest_shot(&self, patches: impl Fn(usize) -> bool) -> Vec<f64> {
        let of = || self.front.iter().filter(|shooter| patches(self.nodes[shooter.node].patch));
        let band = |band: usize| of().map(|shooter| shooter.shot[band].abs()).fold(0.0, f64::max);
        (0..self.sent.len()).map(band).collect()
    }
}

/// The sum of |value| / whole over the bands of which there is any, so that a faint band counts as a strong one.
fn shares(values: &[f64], wholes: &[f64]) -> f64 {
    let bands = values.iter().zip(wholes).filter(|(_, whole)| **whole > 0.0);
    bands.map(|(value, whole)| value.abs() / whole).sum()
}

impl Shooter {
    /// A piece that has shot `shot`.
    fn new(node: usize, nodes: &[Node], shot: &[f64], light: &Light) -> Shooter {
        let area = light.areas[nodes[node].elements.clone()].iter().sum();
        let mut shooter = Shooter { node, area, shot: shot.to_vec(), unshot: Vec::new() };
        shooter.measure(&nodes[node], light);
        shooter
    }

    /// Brings `unshot` up to date.
    fn measure(&mut self, node: &Node, light: &Light) {
        self.unshot.clear();
        self.unshot.resize(self.shot.len(), 0.0);
        for element in node.elements.clone() {
            for (band, unshot) in self.unshot.iter_mut().enumerate() {
                *unshot +=
                    light.areas[element] * (light.radiosity[element * light.bands + band] - self.shot[band]);
            }
        }
    }

    /// By how much power the piece differs from one of its mean radiosity: Σ A |B − mean|, over all bands.
    fn deviation(&self, node: &Node, light: &Light) -> f64 {
        let mean: Vec<_> =
            self.shot.iter().zip(&self.unshot).map(|(shot, power)| shot + power / self.area).collect();
        let deviation = |element: usize| {
            let radiosity = light.radiosity[element * light.bands..].iter();
            light.areas[element] * radiosity.zip(&mean).map(|(b, mean)| (b - mean).abs()).sum::<f64>()
        };
        node.elements.clone().map(deviation).sum()
    }
}
