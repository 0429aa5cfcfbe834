//! What of a target all points of a cell see past occluders, by inclusion and exclusion.
use super::curtain::Divide;
use super::factor::Sight;
use super::sector::{Cast, Common, Sector};
use crate::numeric::taylor::Taylor;

/// A form factor from the points of a cell, and what it may be off by in the mean besides: where a shape is another one on
/// some of the cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visible {
    pub(super) model: Taylor,
    pub(super) stray: f64,
}

impl Sight<'_> {
    /// The form factor of what of a sector no occluder hides:
    ///
    /// rest(P; S1 .. Sm) = f(P) - sum over j of rest(P in Sj; S1 .. S(j-1)),
    ///
    /// as the j-th shadow hides what none before it does. Where a shape is wrong on a share b of the cell by more than
    /// triangles, that changes the mean by b times the largest values of both at most.
    ///
    /// # Errors
    /// What parts the cell, where it sees one shape from some points and another one from others.
    pub(super) fn rest(&self, sector: &Sector, shadows: &[&Cast]) -> Result<Visible, Divide> {
        let mut common = Vec::with_capacity(shadows.len());
        let (mut stray, mut is_covered) = (0.0, None);
        for (j, shadow) in shadows.iter().enumerate() {
            let (part, doubt) = sector.within(shadow, self)?;
            stray += doubt.stray;
            match part {
                Common::All if doubt.share == 0.0 => {
                    return Ok(Visible { model: Taylor::ZERO, stray: doubt.stray });
                }
                Common::All => is_covered = Some(doubt),
                Common::Part(part) => common.push((j, part, doubt.share)),
                Common::Nothing if doubt.share == 0.0 => (),
                Common::Nothing => common.push((j, Sector { corners: Vec::new() }, doubt.share)),
            }
        }
        let whole = self.factor(&sector.corners).ok_or(Divide::Curve)?;
        let most = whole.reach().min(1.0);
        if let Some(doubt) = is_covered {
            return Ok(Visible { model: Taylor::ZERO, stray: doubt.stray + doubt.share * most });
        }
        let mut sum = Visible { model: whole, stray };
        for (j, part, share) in common {
            let hidden = self.rest(&part, &shadows[..j])?;
            sum.model = sum.model - hidden.model;
            sum.stray += hidden.stray + share * (most + hidden.model.reach());
        }
        Ok(sum)
    }
}
