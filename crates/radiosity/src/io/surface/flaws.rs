//! What was wrong with a surface's polygons and was repaired, told once.
use crate::scene::finding::{Finding, Kind};

/// Polygons by the names of their patches.
#[derive(Debug, Default)]
pub(super) struct Flaws {
    /// The pieces of those that are not planar, and how far off a plane the worst of these is.
    bent: (Vec<String>, f64),
    /// The lobes of those that cross themselves and have no front.
    crossed: Vec<String>,
    /// Those that have no area.
    empty: Vec<String>,
}

impl Flaws {
    /// A polygon was not planar by so much, and became some pieces.
    pub(super) fn bend(&mut self, pieces: impl Iterator<Item = String>, distance: f64) {
        self.bent.0.extend(pieces);
        self.bent.1 = self.bent.1.max(distance);
    }

    /// A polygon crossed itself, had no front and became its lobes.
    pub(super) fn cross(&mut self, lobes: impl Iterator<Item = String>) {
        self.crossed.extend(lobes);
    }

    /// A polygon had no area.
    pub(super) fn empty(&mut self, name: &str) {
        self.empty.push(name.to_owned());
    }

    /// A finding for each kind of flaw of the surface at a place in the file.
    pub(super) fn findings(self, place: &str) -> impl Iterator<Item = Finding> {
        let (pieces, distance) = self.bent;
        let bent = (distance > 0.0).then(|| Finding {
            kind: Kind::NonPlanar,
            what: format!(
                "{place}: not planar by up to {distance:.1e}; split into {} triangles",
                pieces.len()
            ),
            patches: pieces,
            repair: "move the vertices into one plane, or triangulate it yourself".into(),
            places: Vec::new(),
        });
        let crossed = (!self.crossed.is_empty()).then(|| Finding {
            kind: Kind::Crossed,
            what: format!(
                "{place}: as much to the left as to the right of an outline that crosses itself; split into {} lobes, which all face \
                 the same way",
                self.crossed.len()
            ),
            patches: self.crossed,
            repair: "give each lobe an outline of its own".into(),
            places: Vec::new(),
        });
        let empty = (!self.empty.is_empty()).then(|| Finding {
            kind: Kind::NoArea,
            what: format!("{place}: {} without area; left out", self.empty.len()),
            patches: self.empty,
            repair: "remove what has no area".into(),
            places: Vec::new(),
        });
        bent.into_iter().chain(crossed).chain(empty)
    }
}
