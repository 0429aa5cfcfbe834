//! Damaged files: some make the decoders of the library for Parquet panic, which is the file's fault and no one else's.
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether what this thread does next may panic on what is damaged.
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// What `find` finds, or that the file is damaged where that panics. Nothing that was half done is used again.
pub(super) fn guarded<T>(find: impl FnOnce() -> T) -> Result<T, &'static str> {
    static QUIET: Once = Once::new();
    QUIET.call_once(keep_quiet);
    IS_GUARDED.set(true);
    let found = catch_unwind(AssertUnwindSafe(find));
    IS_GUARDED.set(false);
    found.map_err(|_| "its pages are damaged")
}

/// Prints nothing of panics that are expected.
fn keep_quiet() {
    let hook = take_hook();
    set_hook(Box::new(move |panic| {
        if !IS_GUARDED.get() {
            hook(panic);
        }
    }));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_panics_is_damaged() {
        assert_eq!(guarded(|| 7), Ok(7));
        assert!(guarded(|| assert_eq!(1, 2)).is_err());
    }
}
