//! Errors of solving.
use thiserror::Error;

/// Why a scene was not solved.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// There is nothing to solve.
    #[error("the scene has no patches; give it at least one polygon")]
    NoPatches,
    /// A patch's reflectance is not in [0, 1].
    #[error(
        "patch {patch}: reflectance {value} in band {band} is not in [0, 1]; a surface cannot reflect more than it receives"
    )]
    Reflectance {
        /// The patch's name.
        patch: String,
        /// The band.
        band: usize,
        /// What was given.
        value: f64,
    },
    /// A closed and lit room has a patch that reflects all light, so that light may never be absorbed.
    #[error(
        "the room of patch {room} ({patches} patches) is closed and lit, and patch {patch} in it reflects all light: \
         give it a reflectance below 1"
    )]
    Endless {
        /// The room's first patch.
        room: String,
        /// How many patches form the room.
        patches: usize,
        /// The patch that reflects all light.
        patch: String,
    },
    /// The time was up before the first step: nothing was found.
    #[error("the time was up before any light was found; allow more seconds, or solve a part of the scene")]
    Time,
    /// The pieces are too many for a matrix.
    #[error("{pieces} pieces are too many for a matrix; solve by shooting, or with fewer elements")]
    Size {
        /// How many pieces exchange light.
        pieces: usize,
    },
    /// The state belongs to another scene or mesh.
    #[error("the state belongs to another scene, or to another number of elements; start a new run")]
    Foreign,
    /// A patch's emission is negative or not finite.
    #[error(
        "patch {patch}: emission {value} in band {band} is negative or not finite; give a radiance of 0 or more"
    )]
    Emission {
        /// The patch's name.
        patch: String,
        /// The band.
        band: usize,
        /// What was given.
        value: f64,
    },
    /// A patch emits so much that a radiosity or a power may exceed the range of f64.
    #[error(
        "patch {patch}: emission {value} in band {band} exceeds the range of numbers; give all emissions in a larger unit"
    )]
    Bright {
        /// The patch's name.
        patch: String,
        /// The band.
        band: usize,
        /// What was given.
        value: f64,
    },
    /// A light cannot shine.
    #[error("light {light}: {reason}; correct or remove it")]
    Light {
        /// The light's name.
        light: String,
        /// What is wrong with it.
        reason: String,
    },
    /// There is no light to find for a camera.
    #[error("camera {camera}: {reason}; give another camera")]
    Camera {
        /// The camera's name.
        camera: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A patch has another number of bands than the scene.
    #[error(
        "patch {patch}: {found} bands where the scene has {expected}; give every patch the scene's bands"
    )]
    Bands {
        /// The patch's name.
        patch: String,
        /// How many bands the patch has.
        found: usize,
        /// How many the scene has.
        expected: usize,
    },
    /// Two patches that face the same way overlap in one plane.
    #[error(
        "patches {first} and {second} overlap in one plane, {share:.3} of the smaller one; let `inspect --repair` cut one, \
         or remove it"
    )]
    Overlap {
        /// The one's name.
        first: String,
        /// The other's.
        second: String,
        /// Which part of the smaller patch lies on the larger one.
        share: f64,
    },
    /// A patch could not be cut into triangles.
    #[error("patch {patch}: no triangles: {reason}; simplify or remove the polygon")]
    Mesh {
        /// The patch's name.
        patch: String,
        /// What stood in the way.
        reason: String,
    },
    /// The form factors do not accept a piece of a patch.
    #[error("patch {patch}: {source}")]
    Shape {
        /// The patch's name.
        patch: String,
        /// What the form factors say.
        source: formfactor::Error,
    },
    /// The computation of a form factor failed, which is a defect of this library.
    #[error(
        "patch {patch}: a form factor to it was not found: {reason}; this is a defect, please report it with the scene"
    )]
    Defect {
        /// The patch's name.
        patch: String,
        /// What the panic said.
        reason: String,
    },
}
