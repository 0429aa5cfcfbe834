//! Options by one word.
use super::{norm::Norm, options::Options};

/// A choice of [`Options`] by one word. On a mesh all of them end with a final gather; see [`Options::gather`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// A first look: an error of 3 %; on a mesh 1500 equal elements, a bound of 1 % and what comes of form factors that are taken
    /// roughly, 0.3 % of what a surface sees.
    Draft,
    /// For pictures: an error of 1 %; on a mesh 6000 elements, half of them where the light changes most, a bound of 0.1 %.
    #[default]
    Normal,
    /// For figures and close views: an error of 0.3 %; on a mesh 20 000 elements after two refinements, element edges along the
    /// shadow edges of the four strongest emitters, a bound of 0.1 %.
    High,
}

impl Quality {
    /// The options.
    #[must_use]
    pub fn options(self) -> Options {
        let normal = Options { passes: 1, norm: Norm::L2, ..Options::default() };
        match self {
            Quality::Draft => Options {
                elements: 1500,
                passes: 0,
                tolerance: 1e-2,
                error: 3e-2,
                rough: 3e-3,
                spread: 1e-3,
                ..normal
            },
            Quality::Normal => normal,
            Quality::High => {
                Options { elements: 20_000, passes: 2, shadows: 4, error: 3e-3, spread: 5e-5, ..normal }
            }
        }
    }
}
