//! What will trouble a solution, and how to repair it.
use serde::Serialize;
use std::{collections::BTreeMap, fmt};

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
    /// Where in the file, as often as it was met there; empty for what concerns patches.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<String>,
}

impl Finding {
    /// Something that a reader found odd, which concerns no patch by name.
    pub(crate) fn of_file(what: impl Into<String>, repair: &str) -> Finding {
        let (what, repair) = (what.into(), repair.into());
        Finding { kind: Kind::File, patches: Vec::new(), what, repair, places: Vec::new() }
    }

    /// Notes what a reader met at a place. The same at several places is one finding, so `what` names a feature and no place:
    /// a file has few of these, however long it is.
    pub(crate) fn note(findings: &mut Vec<Finding>, place: impl Into<String>, what: &str, repair: &str) {
        let known = findings.iter().position(|known| known.kind == Kind::File && known.what == what);
        let index = known.unwrap_or_else(|| {
            findings.push(Finding::of_file(what, repair));
            findings.len() - 1
        });
        findings[index].places.push(place.into());
    }

    /// What it is, and how often.
    fn counted(&self) -> String {
        match self.places.len() {
            0 | 1 => self.what.clone(),
            count => format!("{} ({count} times)", self.what),
        }
    }
}

impl fmt::Display for Finding {
    /// `place: what; repair`, without the names.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.places.as_slice() {
            [] => write!(f, "{}; {}", self.what, self.repair),
            [place] => write!(f, "{place}: {}; {}", self.what, self.repair),
            [first, ..] => write!(f, "{}, first at {first}; {}", self.counted(), self.repair),
        }
    }
}

/// Everything that was found, in one line: each finding about the file with its count, and how many there are of each other kind. `None`
/// where nothing was found; a single finding has its repair with it.
///
/// ```
/// use radiosity::{io::Source, inspect::in_one_line};
/// let room = Source::from_bytes("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nl 2 3\np 1\n")?.scene()?;
/// let line = in_one_line(&room.warnings).expect("lines are no surfaces");
/// assert!(line.contains("lines and points have no area; they are left out (3 times)"), "{line}");
/// # Ok::<(), radiosity::io::FileError>(())
/// ```
#[must_use]
pub fn in_one_line(findings: &[Finding]) -> Option<String> {
    if let [only] = findings {
        return Some(only.to_string());
    }
    let mut parts: Vec<String> = Vec::new();
    let mut others: BTreeMap<Kind, usize> = BTreeMap::new();
    for finding in findings {
        match finding.kind {
            Kind::File => parts.push(finding.counted()),
            kind => *others.entry(kind).or_default() += 1,
        }
    }
    let counts = others.into_iter().map(|(kind, count)| {
        let [one, many] = kind.nouns();
        format!("{count} {}", if count == 1 { one } else { many })
    });
    parts.extend(counts);
    (!parts.is_empty()).then(|| parts.join("; "))
}

/// Kinds of findings, those first that trouble a solution most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Kind {
    /// A reflectance of 1 or more, or below 0.
    Reflectance,
    /// No patch emits.
    Dark,
    /// Something in the file that is not read, or is read as something else.
    File,
    /// Two neighbours that face opposite ways.
    Flipped,
    /// Two patches of the same outline that face the same way.
    Duplicate,
    /// An emitter that lies in a larger patch.
    EmitterInFace,
    /// Two patches that face the same way and cover each other in part, in one plane.
    Overlap,
    /// A patch that reaches into a solid.
    Buried,
    /// A polygon that is not planar and was split into triangles.
    NonPlanar,
    /// A polygon that crosses itself and has no front, which was split into its lobes.
    Crossed,
    /// A patch so thin that its coordinates' rounding is a share of its width.
    Sliver,
    /// A polygon without area, which was left out.
    NoArea,
    /// Vertices that lie beside those of a neighbour, by what single precision rounds away.
    Crack,
    /// A vertex that ends in the middle of another patch's edge.
    TJunction,
}

impl Kind {
    /// Whether it changes the light, so that a solution is not that of the scene which the file's author had in mind.
    #[must_use]
    pub fn matters(self) -> bool {
        !matches!(self, Kind::Buried | Kind::NoArea | Kind::Crack | Kind::TJunction)
    }

    /// What reading or [`repair()`](crate::repair()) does about it, in a word or two; `None` where it stays as it is.
    #[must_use]
    pub fn remedy(self) -> Option<&'static str> {
        match self {
            Kind::Reflectance => Some("limited"),
            Kind::Duplicate => Some("removed"),
            Kind::EmitterInFace => Some("cut out"),
            Kind::Overlap | Kind::Buried => Some("cut"),
            Kind::NonPlanar | Kind::Crossed => Some("split"),
            Kind::Sliver | Kind::NoArea => Some("left out"),
            Kind::Crack => Some("closed"),
            Kind::TJunction => Some("joined"),
            Kind::Dark | Kind::File | Kind::Flipped => None,
        }
    }

    /// What it does to a solution, in a clause.
    #[must_use]
    pub fn effect(self) -> &'static str {
        match self {
            Kind::Reflectance => "they would give more light than they get",
            Kind::Dark => "all light is 0",
            Kind::File => "what was not read is not in the scene",
            Kind::Flipped => "they take and give light on the wrong side",
            Kind::Duplicate | Kind::Overlap => "light from what both cover counts twice",
            Kind::EmitterInFace => "light from the covered part of the face counts beside the emitter's",
            Kind::Buried => "what lies within is dark",
            Kind::NonPlanar => "their triangles are a guess at the surface",
            Kind::Crossed => "which of their sides is lit is a guess",
            Kind::Sliver => "their own light is uncertain",
            Kind::NoArea => "nothing was lost",
            Kind::Crack => "what leaks is less than rounding of the file",
            Kind::TJunction => "form factors do not mind; interpolated light may show a seam",
        }
    }

    /// Its name in a sentence, of one and of many.
    #[must_use]
    pub fn nouns(self) -> [&'static str; 2] {
        match self {
            Kind::Reflectance => ["impossible reflectance", "impossible reflectances"],
            Kind::Dark => ["dark scene", "dark scenes"],
            Kind::File => ["note on the file", "notes on the file"],
            Kind::Flipped => ["flipped face", "flipped faces"],
            Kind::Duplicate => ["duplicate", "duplicates"],
            Kind::EmitterInFace => ["emitter in a face", "emitters in faces"],
            Kind::Overlap => ["overlap", "overlaps"],
            Kind::Buried => ["surface partly within a solid", "surfaces partly within solids"],
            Kind::NonPlanar => ["surface that is not planar", "surfaces that are not planar"],
            Kind::Crossed => ["surface that crosses itself", "surfaces that cross themselves"],
            Kind::Sliver => ["sliver", "slivers"],
            Kind::NoArea => ["surface with empty polygons", "surfaces with empty polygons"],
            Kind::Crack => ["crack", "cracks"],
            Kind::TJunction => ["T-junction", "T-junctions"],
        }
    }
}
