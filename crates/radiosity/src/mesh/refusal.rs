//! Why a polygon could not be cut.
use crate::error::Error;

/// Why a polygon could not be cut.
#[derive(Debug)]
pub(crate) struct MeshRefusal(pub(crate) String);

impl MeshRefusal {
    /// The error that names the patch.
    pub(crate) fn of(self, patch: &str) -> Error {
        Error::Mesh { patch: patch.to_owned(), reason: self.0 }
    }
}
