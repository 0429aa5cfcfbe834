//! How occluders come from what finds them to what looks at them: one by one, until no more are wanted.
use crate::exact::pyramid::Pyramid;
use crate::quick::target::Target;
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use std::ops::ControlFlow;

/// What occluders are given to, with their ids, until it wants no more.
pub(crate) type Taker<'f, 'a> = &'f mut dyn FnMut(usize, &'a PlanarPolygon) -> ControlFlow<()>;

/// Gives all of them.
pub(crate) fn each<'a>(all: impl IntoIterator<Item = (usize, &'a PlanarPolygon)>, taker: Taker<'_, 'a>) {
    let _ = all.into_iter().try_for_each(|(id, occluder)| taker(id, occluder));
}

/// What gives all of them, wherever they are.
pub(crate) fn all<'a>(occluders: &'a [PlanarPolygon]) -> impl Fn(&Reach, Taker<'_, 'a>) {
    |_: &Reach, taker: Taker<'_, 'a>| each(occluders.iter().enumerate(), taker)
}

/// Where an occluder must be to hide anything of a target, as each route knows it.
#[derive(Debug)]
pub(crate) enum Reach<'r> {
    Quick(&'r Target<'r>),
    Exact { pyramid: &'r Pyramid, deviation: f64 },
}

impl Reach<'_> {
    /// Whether a polygon can hide nothing, as far as that is known at little cost.
    pub(crate) fn misses(&self, occluder: &PlanarPolygon) -> bool {
        match self {
            Reach::Quick(target) => target.misses(occluder),
            Reach::Exact { .. } => false,
        }
    }

    /// Whether nothing in a box can hide anything, for certain. Polygons in it may lie off their vertices by `deviation`.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        match self {
            Reach::Quick(target) => target.misses_box(extent, deviation),
            Reach::Exact { pyramid, deviation: of_target } => {
                pyramid.misses_box(extent, deviation + of_target)
            }
        }
    }
}
