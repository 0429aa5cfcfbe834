//! Why there is no profile.
use thiserror::Error;

/// Why there is no profile.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ProfileError {
    /// The line has no length, or no end.
    #[error("the line has no length, or ends in no place; give two places that are apart")]
    Ends,
    /// There is no patch of that name.
    #[error("no patch is named {name}; inspect --json and solve -o FILE.csv list names")]
    Patch {
        /// What was asked for.
        name: String,
    },
    /// The line does not lie in the patch's plane.
    #[error("the line does not lie on {patch}: it is up to {distance:.3e} off its plane; move its ends")]
    Off {
        /// The patch's name.
        patch: String,
        /// How far it is off the plane, in the scene's unit.
        distance: f64,
    },
    /// The line lies on no patch, or beside the one that was named.
    #[error("the line crosses no element of {on}; move its ends")]
    Beside {
        /// The patch's name, or what stands for all of them.
        on: String,
    },
    /// The line lies on two surfaces, along a common edge or on a front and a back.
    #[error("the line lies on {first} and on {second}; name one of them")]
    Two {
        /// The one patch's name.
        first: String,
        /// The other's.
        second: String,
    },
}
