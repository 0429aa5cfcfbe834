//! What can be wrong with input, and how much of it there can be.
use std::fmt;

/// Why rings or an evaluation were refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate is NaN or infinite.
    NonFinite {
        /// Index of the ring, in the order given.
        ring: usize,
        /// Index of the vertex within that ring.
        vertex: usize,
    },
    /// The operands' edges meet more often than [`Csg::try_evaluate_with`](crate::Csg::try_evaluate_with) may count.
    TooManyContacts {
        /// The limit that the call gave.
        limit: usize,
    },
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
        }
    }
}

impl std::error::Error for Error {}
