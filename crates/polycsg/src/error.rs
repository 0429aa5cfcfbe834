//! What can be wrong with input.
use std::fmt;

/// Why rings were refused.
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
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NonFinite { ring, vertex } => write!(
                f,
                "ring {ring}, vertex {vertex}: a coordinate is NaN or infinite; give finite numbers"
            ),
        }
    }
}

impl std::error::Error for Error {}
