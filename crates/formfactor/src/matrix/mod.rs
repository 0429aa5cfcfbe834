//! Matrices of form factors between polygons, row by row, and what engineers do with them.
//!
//! [`Enclosure::exchange_row`](crate::Enclosure::exchange_row) finds what one polygon exchanges with those behind it in
//! the order of the ids. Such rows depend on nothing but the enclosure and the tolerance: they may be found in any order, on
//! any number of machines, and be written down, and a [`FactorMatrix`] put together from them has the same bits.
mod closure;
mod gray;
mod group;
mod rows;
mod sparse;
mod threshold;

pub use closure::Closure;
pub use rows::{Exchange, ExchangeRow};
pub use sparse::{Factor, FactorMatrix};
