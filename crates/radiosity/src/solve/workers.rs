//! Form factors, and light, of many points at once, by all threads.
use crate::error::Error;
use rayon::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A factor, or the light, of each of many points: each by itself, so threads change nothing.
///
/// # Errors
/// [`Error::Defect`] when one of them panics: what a run has found until then must not be lost for it.
pub(super) fn from_all<P: Sync, T: Send>(
    points: &[P],
    patch: &str,
    factor: impl Fn(&P) -> T + Sync,
) -> Result<Vec<T>, Error> {
    let shared = (points.len() / rayon::current_num_threads()).clamp(1, 8);
    let all = || points.par_iter().with_min_len(shared).map(&factor).collect();
    attempt(patch, all)
}

/// What is found for a patch.
///
/// # Errors
/// As [`from_all`].
pub(super) fn attempt<T>(patch: &str, find: impl FnOnce() -> T) -> Result<T, Error> {
    // Factors are pure functions of what they borrow: a panic leaves nothing half done.
    catch_unwind(AssertUnwindSafe(find))
        .map_err(|panic| Error::Defect { patch: patch.into(), reason: reason(panic.as_ref()) })
}

/// What a panic said.
fn reason(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "it panicked".into())
}
