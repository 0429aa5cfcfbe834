//! Why a polygon could not be cut.
use crate::error::Error;

/// Why a polygon could not be cut.
#[derive(Debug)]
pub(super) struct MeshRefusal(pub(super) String);

impl MeshRefusal {
    /// The error that names the patch.
    pub(super) fn of(self, patch: &str) -> Error {
        Error::Mesh { patch: patch.to_owned(), reason: self.0 }
    }
}
