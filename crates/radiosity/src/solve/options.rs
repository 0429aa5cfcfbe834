//! The options of the solver.
use super::norm::Norm;
use crate::scene::camera::Camera;

/// The method of solution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// [`Method::Hierarchical`] for scenes of at most 1000 patches, where those that are alike and continue each other in one plane count as one,
    /// and [for a camera](Options::for_camera); else, and with [`Options::hemicube`], [`Method::Mesh`].
    #[default]
    Auto,
    /// By levels: light goes between parts of patches as large as [`Options::error`] allows; the mesh follows from that.
    Hierarchical,
    /// On a mesh of [`Options::elements`]: [`Method::Cg`] where a closed room reflects at least 0.9 of its light, else
    /// [`Method::Shoot`].
    Mesh,
    /// Progressive refinement: the piece with the most unshot light shoots it, again and again. Early results are already good
    /// to look at; the number of rounds is about 1 / (1 − ρ) for reflectance ρ.
    Shoot,
    /// Gaussian elimination on the full matrix, with pieces as small as the mesh's cells: cubic time, for checks.
    Matrix,
    /// Conjugate gradients on symmetric exchange areas, which are scaled so that closed rooms lose no power. A few tens of
    /// matrix-vector products are enough at any reflectance below 1.
    Cg,
    /// GMRES on the unscaled form factors.
    Gmres,
}

/// The options of [`solve`](crate::solve()): how fine the mesh is, how exact the light, and when to stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The method of solution.
    pub method: Method,
    /// About how many elements to cut the scene into. [`Method::Hierarchical`] has no use for this, nor for `passes`, `norm`, `shadows`,
    /// `hemicube` and `spread`.
    pub elements: usize,
    /// How often to solve and then refine the mesh where the light is not resolved.
    pub passes: usize,
    /// The norm that tells where the light is not resolved.
    pub norm: Norm,
    /// How many of the strongest emitters cast shadows whose edges become edges of elements.
    pub shadows: usize,
    /// The resolution of hemicubes that replace exact form factors, to compare with; `None` for exact ones.
    pub hemicube: Option<u32>,
    /// Whether to find at the end what vertices receive, exactly past what stands in between, rather than interpolate the light of
    /// elements. Hemicubes do not. On a mesh a [`Record`](crate::Record) then has more vertices where light is not linear.
    pub gather: bool,
    /// Stop when the bound on the error of every radiosity is at most this share of the reflected light's brightness,
    /// ΣAR² / ΣAR with R = B − E, in every band, and what is unshot at most this share of the emitted power.
    pub tolerance: f64,
    /// What the mean irradiance of a patch may be off by, as a share of itself or, where that is more, of 1 % of the scene's mean. In scenes of
    /// more than 300 patches those of less than 1e-4 of the area, together no more than 5 % of it, may be further off. Only
    /// [`Method::Hierarchical`] knows its errors, and it cuts patches by this alone.
    pub error: f64,
    /// A camera for which the light is found, by [`Method::Hierarchical`] alone: what it sees is within [`Options::error`], and light out of
    /// its view as far as that matters to what it sees. [`Solution::in_view`](crate::Solution::in_view) tells which patches these are.
    pub for_camera: Option<Camera>,
    /// What small patches far away may fill of an element's view, all of them together, for their form factors to be taken roughly where
    /// shots are exact otherwise: as those of disks, or 0 where something hides their middles. The bound on the error counts it. Patches
    /// that emit are always exact, and so are scenes that are lit from within and reflect 0.9 of the light somewhere, unless
    /// [`Method::Shoot`] is asked for.
    pub rough: f64,
    /// Split a piece while its power deviates from that of a uniform piece by more than this share of the power that all
    /// pieces send.
    pub spread: f64,
    /// Show the watcher more than the run needs: where all pieces are solved for at once, the light after each reflection
    /// ([`Moment::Bounce`](crate::Moment::Bounce)), and the last round of [`Method::Hierarchical`]. The solution has the same bits.
    pub record: bool,
    /// Stop after so many shots.
    pub max_shots: usize,
    /// Stop after so many seconds; a final gather of what light is found by then takes half of them at most.
    pub max_seconds: Option<f64>,
}

impl Options {
    /// The default for about so many equal elements, by [`Method::Mesh`].
    #[must_use]
    pub fn mesh(elements: usize) -> Options {
        Options { method: Method::Mesh, elements, ..Options::default() }
    }
}

impl Default for Options {
    /// By levels to 1 %, or about 6000 equal elements; the algebraic error is far below the error of a mesh of that size.
    fn default() -> Options {
        Options {
            method: Method::Auto,
            elements: 6000,
            passes: 0,
            norm: Norm::L2,
            shadows: 0,
            hemicube: None,
            gather: true,
            tolerance: 1e-3,
            error: 1e-2,
            for_camera: None,
            rough: 0.0,
            spread: 2e-4,
            record: false,
            max_shots: 1_000_000,
            max_seconds: None,
        }
    }
}
