//! The only place that decides a sign.
//!
//! Every predicate answers with an enum: a floating-point filter with a proven error bound first; where that cannot
//! tell, more bits, and in the end exact integers, of fixed size if the coordinates' exponents allow. All are right for every finite `f64`, subnormal and huge ones included.
//!
//! | predicate | question | degree |
//! | --- | --- | --- |
//! | [`side`] | on which side of a directed line does a point lie | 2 |
//! | [`turn`] | does one direction turn left or right of another | 2 |
//! | [`Compass`] | along which axis or into which quadrant does a direction point | 1 |
//! | [`crossing_order`] | which of two crossings comes first along an edge | 4 |
//! | [`height_order`] | which of two edges is lower at an abscissa | 3 |
//! | [`crossing_x_order`] | does a crossing lie left of an abscissa | 3 |
//! | [`crossings_x_order`] | which of two crossings lies further left | 6 |
//! | [`Margins`] | do two edges cross, or not meet, whatever rounding does | 2 |
//! | [`Window`], [`Band`] | does a box lie on one side of an edge, or of some points | 2 |
//! | [`crossing_point`] | the crossing of two edges, correctly rounded | 3 |

mod area;
mod band;
mod clear;
#[cfg(any(test, fuzzing))]
mod configurations;
mod distance;
mod fixed;
#[cfg(any(test, fuzzing))]
pub(crate) mod laws;
mod order;
mod orient;
mod parameter;
mod round;
mod segment;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod whole_range;

pub(crate) use area::exact_area;
pub(crate) use band::{Band, Window};
pub(crate) use clear::{Clear, Margins};
pub(crate) use exactfloat::Ratio;
pub(crate) use order::{
    crossing_order, crossing_x_order, crossings_x_order, height_order, is_inside, lexicographic,
    point_crossing_order, rightward,
};
pub(crate) use orient::{Area, Compass, doubled_area, side, side_of, turn};
pub(crate) use parameter::{FineParameter, Parameter};
pub(crate) use round::{crossing_point, crossing_ratio};
pub(crate) use segment::{Segment, Side};
