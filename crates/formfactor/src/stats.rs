//! Counts of the work behind form factors.
use std::iter::Sum;
use std::ops::{Add, AddAssign};

/// Counts of the work behind one form factor or, added up, behind many.
///
/// [`Enclosure::form_factor_with_stats`](crate::Enclosure::form_factor_with_stats) returns them; `+` and `sum()` add them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stats {
    /// Targets that nothing hides, including those that turn their back or lie below the horizon.
    pub none: u64,
    /// Targets that are hidden completely.
    pub total: u64,
    /// Targets that are hidden in part, or by several occluders together.
    pub partial: u64,
    /// Occluders that were looked at: those that the tree found, or all where there is no tree.
    pub looked_at: u64,
    /// Those of them that cannot block: outside of the target's pyramid, behind the target, below the horizon, edge-on.
    pub culled: u64,
    /// Occluders that were cut because they pass through the target's plane.
    pub clipped: u64,
    /// Targets that are hidden in part and were decided in plain doubles: no polygon Boolean was evaluated.
    pub traced: u64,
    /// Edges that went into polygon Booleans.
    pub csg_edges: u64,
}

impl Stats {
    /// The same work, of the parts of one target.
    pub(crate) fn as_one(self) -> Self {
        let none = u64::from(self.total == 0 && self.partial == 0);
        let total = u64::from(self.total > 0 && self.none == 0 && self.partial == 0);
        let partial = 1 - none - total;
        Self { none, total, partial, traced: partial, ..self }
    }
}

impl AddAssign for Stats {
    fn add_assign(&mut self, other: Self) {
        self.none += other.none;
        self.total += other.total;
        self.partial += other.partial;
        self.looked_at += other.looked_at;
        self.culled += other.culled;
        self.clipped += other.clipped;
        self.traced += other.traced;
        self.csg_edges += other.csg_edges;
    }
}

impl Add for Stats {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Sum for Stats {
    fn sum<I: Iterator<Item = Self>>(stats: I) -> Self {
        stats.fold(Self::default(), Add::add)
    }
}
