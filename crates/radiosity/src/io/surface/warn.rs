//! What was wrong with a surface's polygons and was mended, told once.

/// Polygons by their index in the primitive.
#[derive(Debug, Default)]
pub(super) struct Flaws {
    /// Those that are not planar, and by how much.
    pub(super) bent: Vec<(usize, f64)>,
    /// Those that have no area.
    pub(super) empty: Vec<usize>,
}

impl Flaws {
    /// One sentence for each kind of flaw.
    pub(super) fn sentences(&self) -> impl Iterator<Item = String> {
        let worst = self.bent.iter().copied().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let bent = worst.map(|(polygon, distance)| {
            let count = self.bent.len();
            format!("{count} not planar (polygon {polygon} by {distance:.1e}); split into triangles")
        });
        let empty = self.empty.first().map(|polygon| {
            let count = self.empty.len();
            format!("{count} without area (the first is polygon {polygon}); left out")
        });
        bent.into_iter().chain(empty)
    }
}
