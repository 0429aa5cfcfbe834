//! The one way to a form factor: the quick route in doubles, and the exact one where doubles leave it open.
use crate::buffers::Buffers;
use crate::exact::{self, pyramid::Pyramid};
use crate::form_factor::FormFactor;
use crate::occluders::{Reach, Taker, all};
use crate::quick::{self, QuickBuffers};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::stats::Stats;
use std::ops::ControlFlow;

/// The form factor from a differential area to the front of a polygon, with occluders in between.
///
/// An occluder blocks a ray from dA to a point of the target exactly when it meets the ray strictly between them. An
/// occluder that is coplanar with the target, or whose plane contains dA, blocks nothing.
///
/// The value is exactly 0 for a dA on or behind the target's plane, and where a single convex occluder covers the target.
/// The order of `occluders` changes the value within the bounds at most; which way they face does not matter.
///
/// The time is linear in the number of occluders that are culled, plus that of one polygon Boolean for the rest. For many
/// targets or points among the same polygons, an [`Enclosure`](crate::Enclosure) finds the occluders faster.
///
/// See the [crate's page](crate) for an example.
#[must_use]
pub fn form_factor(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> FormFactor {
    if occluders.is_empty() {
        return unoccluded(from, to);
    }
    past(from, to, all(occluders), None, &mut Buffers::default())
}

/// The form factor from a differential area to the front of a polygon with nothing in between.
///
/// The time is linear in the number of vertices of a convex polygon. Any other takes one polygon Boolean.
///
/// ```
/// use formfactor::{DVec3, DifferentialArea, PlanarPolygon, unoccluded};
/// // A square of side 2 at distance 1, seen along its axis: 4 / (pi sqrt 2) atan(1 / sqrt 2).
/// let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
/// let square = PlanarPolygon::new([[[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, 1.0]]])?;
/// let f = unoccluded(&from, &square);
/// assert!((f.value - 0.554_126_423_979_571_9).abs() < 1e-15);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[must_use]
pub fn unoccluded(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    quick::unoccluded(from, to).unwrap_or_else(|| past(from, to, |_, _| (), None, &mut Buffers::default()))
}

/// The form factor past those of the occluders that `occluders` finds, with their ids, within reach of the target: the only way to one.
/// What was done is counted in the buffers' stats, and the buffers know which occluders may hide some of the target. With `within`, doubles
/// do if they err by no more.
pub(crate) fn past<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    within: Option<f64>,
    Buffers { quick, scratch, stats }: &mut Buffers,
) -> FormFactor {
    *stats = Stats::default();
    let quickly = quick::form_factor(from, to, &occluders, within, quick, stats);
    quickly.unwrap_or_else(|| {
        *stats = Stats::default();
        let QuickBuffers { blockers, others, .. } = quick;
        blockers.clear();
        *others = 0.0;
        let near = |pyramid: &Pyramid| {
            let mut near = Vec::new();
            occluders(&Reach::Exact { pyramid, deviation: to.deviation() }, &mut |id, occluder| {
                blockers.push(id);
                near.push(occluder);
                ControlFlow::Continue(())
            });
            near
        };
        let found = exact::form_factor(from, to, near, scratch, stats);
        // Where little rises above the horizon, roundings may leave open more than all of it.
        match quick::most_seen(from, (to, to.points())) {
            Some(most) if most < found.error_bound => {
                FormFactor { value: found.value.min(most), error_bound: most }
            }
            _ => found,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};
    use proptest::prelude::*;

    /// A rectangle in a turned room: how it is turned, a corner, and two ways.
    fn rectangle(turn: DQuat, corner: DVec3, ways: [DVec3; 2]) -> PlanarPolygon {
        let corners = [DVec3::ZERO, ways[0], ways[0] + ways[1], ways[1]];
        PlanarPolygon::new([corners.map(|way| turn * (corner + way))]).expect("a rectangle")
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Boards stand on the four sides of the target and lie along two of its edges: in a turned room all but for roundings.
        #[test]
        fn what_runs_along_the_target_but_for_roundings_is_no_question(
            axis in prop::array::uniform3(-1.0..1.0), angle in 0.1..6.0, at in prop::array::uniform2(0.2..3.8),
            from in 0.5..1.5, tall in 0.1..2.0, wide in 0.1..2.0, tolerance in prop_oneof![Just(1e-7), Just(1e-9)],
        ) {
            let turn = DQuat::from_scaled_axis(DVec3::from(axis).normalize_or(DVec3::X) * angle);
            let target = rectangle(turn, DVec3::new(0.0, 0.0, 0.0), [DVec3::X * 4.0, DVec3::Y * 4.0]);
            let boards = [
                rectangle(turn, DVec3::new(from, 0.0, -0.5), [DVec3::X, DVec3::Z * (tall + 0.5)]),
                rectangle(turn, DVec3::new(from, 4.0, -0.5), [DVec3::X, DVec3::Z * (tall + 0.5)]),
                rectangle(turn, DVec3::new(0.0, from, -0.5), [DVec3::Y, DVec3::Z * (tall + 0.5)]),
                rectangle(turn, DVec3::new(0.0, 0.0, 1.0), [DVec3::X * wide, DVec3::Y * 4.0]),
            ];
            let spot = DifferentialArea::new(turn * DVec3::new(at[0], at[1], 3.0), turn * DVec3::NEG_Z).expect("a place");
            let mut buffers = Buffers::default();
            let quickly =
                quick::form_factor(&spot, &target, all(&boards), Some(tolerance), &mut buffers.quick, &mut buffers.stats);
            let exact = past(&spot, &target, all(&boards), None, &mut buffers);
            let quickly = quickly.expect("doubles decide it");
            prop_assert!(quickly.error_bound <= tolerance);
            prop_assert!((quickly.value - exact.value).abs() <= quickly.error_bound + exact.error_bound);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(30))]

        /// Boards of all sizes and turns, of which most hide nothing of what others leave.
        #[test]
        fn among_a_crowd_what_is_left_is_what_the_exact_route_sees(
            boards in prop::collection::vec(
                (prop::array::uniform3(-2.0..2.0), prop::array::uniform3(-3.0..3.0), -7.0..0.0), 100..400,
            ),
            tolerance in prop_oneof![Just(1e-4), Just(1e-7), Just(1e-9)],
        ) {
            let target = rectangle(DQuat::IDENTITY, DVec3::new(-3.0, -3.0, 3.0), [DVec3::Y * 6.0, DVec3::X * 6.0]);
            let board = |(at, turn, size): &([f64; 3], [f64; 3], f64)| {
                let turn = DQuat::from_scaled_axis(DVec3::from(*turn));
                let corner = turn.inverse() * (DVec3::from(*at) * DVec3::new(1.0, 1.0, 0.4) + DVec3::Z * 1.5);
                rectangle(turn, corner, [DVec3::X * size.exp2(), DVec3::Y * size.exp2()])
            };
            let boards: Vec<PlanarPolygon> = boards.iter().map(board).collect();
            let spot = DifferentialArea::new(DVec3::ZERO, DVec3::Z).expect("a place");
            let mut buffers = Buffers::default();
            let found = past(&spot, &target, all(&boards), Some(tolerance), &mut buffers);
            let exact = past(&spot, &target, all(&boards), None, &mut buffers);
            prop_assert!(found.error_bound <= tolerance);
            prop_assert!((found.value - exact.value).abs() <= found.error_bound + exact.error_bound);
        }
    }
}
