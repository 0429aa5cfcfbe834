//! What will trouble a solution, and how to repair it.
use serde::Serialize;
use std::fmt;

/// Something in a scene that will trouble a solution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The kind.
    pub kind: Kind,
    /// The patches concerned, by name.
    pub patches: Vec<String>,
    /// A description, in a sentence.
    pub what: String,
    /// How to repair it, in a sentence.
    pub repair: String,
}

impl Finding {
    /// Something that a reader found odd, which concerns no patch by name.
    pub(crate) fn of_file(what: impl Into<String>, repair: &str) -> Finding {
        Finding { kind: Kind::File, patches: Vec::new(), what: what.into(), repair: repair.into() }
    }
}

impl fmt::Display for Finding {
    /// `what; repair`, without the names.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.what, self.repair)
    }
}

/// Kinds of findings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Kind {
    /// Something in the file that is not read, or is read as something else.
    File,
    /// A polygon that is not planar and was split into triangles.
    NonPlanar,
    /// A polygon without area, which was left out.
    NoArea,
    /// No patch emits.
    Dark,
    /// A reflectance of 1 or more, or below 0.
    Reflectance,
    /// Two neighbours that face opposite ways.
    Flipped,
    /// Two patches of the same outline that face the same way.
    Duplicate,
    /// Two patches that face the same way and cover each other in part, in one plane.
    Overlap,
    /// An emitter that lies in a larger patch.
    EmitterInFace,
    /// A vertex that ends in the middle of another patch's edge.
    TJunction,
    /// A patch so thin that its coordinates' rounding is a share of its width.
    Sliver,
}
