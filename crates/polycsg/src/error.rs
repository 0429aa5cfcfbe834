//! The errors of this crate.
use std::fmt;

/// Why rings or an evaluation were refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate is NaN or infinite.
    NonFinite {
        /// The index of the ring, in the order given.
        ring: usize,
        /// The index of the vertex within that ring.
        vertex: usize,
    },
    /// The operands' edges meet more often than the call to
    /// [`Csg::try_evaluate_with`](crate::Csg::try_evaluate_with) allows.
    TooManyContacts {
        /// The limit of that call.
        limit: usize,
    },
    /// An evaluation takes more work than its [`Limits`](crate::Limits) allow.
    TooMuchWork {
        /// The limit of that call.
        limit: u64,
    },
    /// The caller's function said so.
    Stopped,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NonFinite { ring, vertex } => write!(
                f,
                "ring {ring}, vertex {vertex}: a coordinate is NaN or infinite; give finite numbers"
            ),
            Error::TooManyContacts { limit } => {
                write!(f, "edges meet more than {limit} times; raise the limit or split the operands")
            }
            Error::TooMuchWork { limit } => {
                write!(
                    f,
                    "the evaluation takes more than {limit} units of work; raise the limit or split the operands"
                )
            }
            Error::Stopped => write!(f, "the caller stopped the evaluation"),
        }
    }
}

impl std::error::Error for Error {}
