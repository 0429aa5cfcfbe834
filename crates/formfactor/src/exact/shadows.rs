//! The shadows of all occluders that can block.
use super::cull::{Verdict, cull};
use super::project::{Shadow, project};
use super::view::View;
use crate::shapes::polygon::PlanarPolygon;
use crate::stats::Stats;

/// What the occluders hide together.
#[derive(Debug)]
pub(crate) enum Shadows {
    /// All of the target.
    Total,
    /// The shadows, and a bound on the form factor of what they get wrong.
    Some(Vec<Shadow>, f64),
}

/// The shadows of the occluders that can block.
pub(crate) fn shadows<'a>(
    view: &View,
    occluders: impl IntoIterator<Item = &'a PlanarPolygon>,
    stats: &mut Stats,
) -> Shadows {
    let (mut found, mut error) = (Vec::new(), 0.0);
    for occluder in occluders {
        stats.looked_at += 1;
        match cull(view, occluder) {
            Verdict::HidesNothing { open } => {
                stats.culled += 1;
                error += open;
            }
            Verdict::CanBlock { sides, open } => {
                let shadow = project(view, occluder, &sides);
                stats.clipped += u64::from(shadow.is_clipped);
                error += shadow.error + open;
                found.push(shadow);
            }
            Verdict::HidesAll => return Shadows::Total,
        }
    }
    found.retain(|shadow: &Shadow| !shadow.loops.is_empty());
    Shadows::Some(found, error)
}
