//! i_overlay, on its 32 and 64 bit grids; its buffers are reused from call to call.

use super::task::{Outcome, Task, doubled_area, operands, reading};
use crate::job::{Job, Op, Operand};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::integer::OverlayInt;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};

type Shapes = Vec<Vec<Vec<[f64; 2]>>>;

pub(super) fn load<I: OverlayInt + 'static>(job: &Job) -> Result<Box<dyn Task>, String> {
    let rule = match job.op {
        Op::UnionOfAll => OverlayRule::Subject,
        Op::Union => OverlayRule::Union,
        Op::Intersection => OverlayRule::Intersect,
        Op::Difference => OverlayRule::Difference,
        Op::SymmetricDifference => OverlayRule::Xor,
    };
    let mut overlay: FloatOverlay<[f64; 2], I> =
        FloatOverlay::new_empty(OverlayOptions::default(), Default::default(), job.edges());
    let boolean = move |subject: &Operand, clip: &Operand| {
        overlay.reinit_with_subj_and_clip(subject, clip);
        Ok(overlay.overlay(rule, FillRule::NonZero))
    };
    Ok(reading(operands(job, Operand::clone), boolean, measure))
}

fn measure(shapes: &Shapes) -> Outcome {
    let closed = |ring: &Vec<[f64; 2]>| doubled_area(ring.iter().chain(ring.first()).copied());
    let area: f64 = shapes.iter().flatten().map(closed).sum();
    Outcome::of(area / 2.0, shapes.iter().map(Vec::len).sum())
}
