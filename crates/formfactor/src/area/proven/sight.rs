//! What of a target all points of a cell see past occluders, by inclusion and exclusion.
use super::chart::Chart;
use super::curtain::Divide;
use super::factor::factor;
use super::sector::{Cast, Common, Sector};
use crate::numeric::taylor::Taylor;
use glam::DVec3;

/// A form factor from the points of a cell, and what it may be off by in the mean besides: where a shape is another one on
/// some of the cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum {
    pub(super) model: Taylor,
    pub(super) stray: f64,
}

/// A cell, and how exactly things stand where they stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'c> {
    pub(super) chart: &'c Chart,
    pub(super) normal: DVec3,
    pub(super) deviation: f64,
}

impl Sight<'_> {
    /// The form factor of a sector; nothing where series do not converge.
    pub(super) fn factor(&self, sector: &Sector) -> Option<Taylor> {
        factor(sector, self.chart, self.normal, self.deviation)
    }

    /// The form factor of what of a sector no occluder hides:
    ///
    /// rest(P; S1 .. Sm) = f(P) - sum over j of rest(P in Sj; S1 .. S(j-1)),
    ///
    /// as the j-th shadow hides what none before it does. Where a shape is wrong on a share b of the cell, that changes the
    /// mean by b times the largest values of both at most.
    ///
    /// # Errors
    /// What parts the cell, where it sees one shape from some points and another one from others.
    pub(super) fn rest(&self, sector: &Sector, shadows: &[&Cast]) -> Result<Sum, Divide> {
        let mut common = Vec::with_capacity(shadows.len());
        for (j, shadow) in shadows.iter().enumerate() {
            match sector.within(shadow, self.chart, self.deviation)? {
                Common::All(0.0) => return Ok(Sum { model: Taylor::ZERO, stray: 0.0 }),
                Common::All(share) => common.push((j, None, share)),
                Common::Part(part, share) => common.push((j, Some(part), share)),
                Common::Nothing(0.0) => (),
                Common::Nothing(share) => common.push((j, Some(Sector { corners: Vec::new() }), share)),
            }
        }
        let whole = self.factor(sector).ok_or(Divide::Curve)?;
        let most = whole.reach().min(1.0);
        if let Some((_, _, share)) = common.iter().find(|(_, part, _)| part.is_none()) {
            return Ok(Sum { model: Taylor::ZERO, stray: share * most });
        }
        let mut sum = Sum { model: whole, stray: 0.0 };
        for (j, part, share) in common {
            let Some(part) = part else { continue };
            let hidden = self.rest(&part, &shadows[..j])?;
            sum.model = sum.model - hidden.model;
            sum.stray += hidden.stray + share * (most + hidden.model.reach());
        }
        Ok(sum)
    }
}
