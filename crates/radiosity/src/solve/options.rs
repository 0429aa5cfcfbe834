//! How the solver is asked.
use super::norm::Norm;

/// How the light is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// [`Method::Cg`] where a closed room reflects at least 0.9 of its light, else [`Method::Shoot`].
    #[default]
    Auto,
    /// Progressive refinement: the piece with most light to shoot shoots it, again and again. Soon there is something to see;
    /// needs about 1 / (1 − ρ) rounds.
    Shoot,
    /// The full matrix, every piece as small as the mesh's cells, by Gaussian elimination: cubic in the pieces.
    Matrix,
    /// Conjugate gradients on symmetric exchange areas, scaled to close: power adds up, and some tens of
    /// matrix-vector products do at any reflectance below 1.
    Cg,
    /// GMRES on the factors as they are, one-sided.
    Gmres,
}

/// How fine, how far, how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How the light is found.
    pub method: Method,
    /// About how many elements to cut the scene into.
    pub elements: usize,
    /// How often to solve, look where the light is not resolved, and cut the scene anew, finer there.
    pub passes: usize,
    /// What tells where the light is not resolved.
    pub norm: Norm,
    /// Of so many of the strongest emitters the edges of shadows become edges of elements.
    pub shadows: usize,
    /// Take form factors from hemicubes of so many cells across, instead of exact ones: to see what that costs and brings.
    pub hemicube: Option<u32>,
    /// In the end, find the light straight from the emitters exactly at every vertex.
    pub gather: bool,
    /// Stop when the bound on the error of every radiosity is at most this share of the reflected light's brightness,
    /// ΣAR² / ΣAR with R = B − E, in every band, and what is unshot at most this share of the emitted power.
    pub tolerance: f64,
    /// Split a shooter while its power deviates from that of a uniform piece by more than this share of the power that
    /// all send.
    pub spread: f64,
    /// Stop after so many shots.
    pub max_shots: usize,
    /// Stop after so many seconds.
    pub max_seconds: Option<f64>,
}

impl Default for Options {
    /// About 6000 elements; what is left unshot or unresolved is far below what a mesh of that size resolves.
    fn default() -> Options {
        Options {
            method: Method::Auto,
            elements: 6000,
            passes: 0,
            norm: Norm::L2,
            shadows: 0,
            hemicube: None,
            gather: false,
            tolerance: 1e-3,
            spread: 2e-4,
            max_shots: 1_000_000,
            max_seconds: None,
        }
    }
}
