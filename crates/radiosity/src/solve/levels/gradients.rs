//! The light of all leaves at once, by conjugate gradients: b = e + ρ T b.
//!
//! Multiplied with A / ρ the system is symmetric, and positive where ρ < 1. Leaves that reflect nothing are no unknowns: they send what they
//! emit.
use super::equilibrium::{Equilibrium, largest};
use super::flow::Linear;
use super::tile::SQUARE;

/// One band of the system.
#[derive(Debug)]
pub(super) struct Gradients<'g> {
    equilibrium: &'g Equilibrium<'g>,
    emitted: &'g [Linear],
    reflectance: &'g [f64],
}

impl<'g> Gradients<'g> {
    pub(super) fn new(
        equilibrium: &'g Equilibrium<'g>,
        emitted: &'g [Linear],
        reflectance: &'g [f64],
    ) -> Gradients<'g> {
        Gradients { equilibrium, emitted, reflectance }
    }

    /// Betters b until the residual is nowhere larger than `enough`, or no step helps; tells how many products that took.
    pub(super) fn better(&self, sent: &mut [Linear], enough: f64, most: usize) -> usize {
        for (leaf, _) in self.reflectance.iter().enumerate().filter(|(_, rho)| **rho == 0.0) {
            sent[leaf] = self.emitted[leaf];
        }
        let mut rest = self.residual(sent);
        let mut way = rest.clone();
        let mut square = self.dot(&rest, &rest);
        let mut products = 1;
        while products < most && largest(&rest) > enough {
            let applied = self.equilibrium.apply(self.reflectance, &way);
            products += 1;
            let slope = self.dot(&way, &applied);
            if !(slope > 0.0 && slope.is_finite()) {
                break;
            }
            self.add(sent, square / slope, &way);
            self.add(&mut rest, -square / slope, &applied);
            let before = std::mem::replace(&mut square, self.dot(&rest, &rest));
            let turn = square / before;
            way.iter_mut()
                .zip(&rest)
                .for_each(|(way, rest)| (0..3).for_each(|k| way[k] = rest[k] + turn * way[k]));
        }
        products
    }

    /// e − (I − ρT) b.
    fn residual(&self, sent: &[Linear]) -> Vec<Linear> {
        let applied = self.equilibrium.apply(self.reflectance, sent);
        self.emitted.iter().zip(applied).map(|(e, applied)| [0, 1, 2].map(|k| e[k] - applied[k])).collect()
    }

    fn dot(&self, u: &[Linear], v: &[Linear]) -> f64 {
        let of = |leaf: usize| {
            let (u, v) = (u[leaf], v[leaf]);
            let weight = self.equilibrium.area(leaf) / self.reflectance[leaf];
            weight * (u[0] * v[0] + SQUARE * (u[1] * v[1] + u[2] * v[2]))
        };
        (0..u.len()).filter(|leaf| self.reflectance[*leaf] > 0.0).map(of).sum()
    }

    /// Adds a step to the unknowns.
    fn add(&self, to: &mut [Linear], step: f64, way: &[Linear]) {
        for leaf in (0..to.len()).filter(|leaf| self.reflectance[*leaf] > 0.0) {
            (0..3).for_each(|k| to[leaf][k] += step * way[leaf][k]);
        }
    }
}
