//! What fuzz targets need to see and users do not. Exists in builds by cargo-fuzz only.

use crate::contacts::budget::WorkBudget;
use crate::pipeline::scratch::Scratch;
use crate::predicates::laws;

/// Asks every predicate about one configuration of points, made of a stream of words.
///
/// # Errors
/// The predicate that is wrong, and the points.
pub fn check_predicates(word: impl FnMut() -> u64) -> Result<(), String> {
    laws::check(word)
}

/// Finds what meets by slabs, without looking at boxes first.
pub fn by_slabs() -> Scratch {
    Scratch { budget: WorkBudget::NONE, ..Scratch::default() }
}
