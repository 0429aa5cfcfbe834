//! The buffers of all stages, one struct for each folder.

use crate::arrangement::{Arrangement, labels::Labels};
use crate::assemble::{link::Cycles, nest::Nesting, positive::PositiveEdges};
use crate::boundary::{outline::Outline, repair::Repair, select::Selection};
use crate::contacts::{Contacts, budget::WorkBudget, close_pairs::ClosePairs};
use crate::edges::{Edges, coincident::CoincidentEdges, collect::RingKey};
use crate::expression::{bounds::ResultBounds, winding::WindingNumbers};
use crate::spatial::{chains::MonotoneChains, slabs::SlabDecomposition, strips::Strips};

/// The buffers of an evaluation, to be reused from call to call. They never borrow the operands.
///
/// Buffers grow with the operands and with how often their edges meet;
/// [`Csg::try_evaluate_with`](crate::Csg::try_evaluate_with) limits that.
///
/// ```
/// use polycsg::{Csg, FillRule, Region, Scratch};
/// let a = Region::from_rings([[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]], FillRule::NonZero)?;
/// let b = Region::from_rings([[[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]], FillRule::NonZero)?;
/// let mut scratch = Scratch::default();
/// let common = Csg::from(&a) & Csg::from(&b);
/// assert_eq!(common.evaluate_with(&mut scratch).area(), 1.0);
/// assert_eq!(common.boundary(&mut scratch).area(), 1.0); // without rings
/// # Ok::<(), polycsg::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Scratch {
    pub(crate) expression: ExpressionBuffers,
    pub(crate) edges: EdgeBuffers,
    pub(crate) spatial: SpatialBuffers,
    pub(crate) contacts: ContactBuffers,
    pub(crate) arrangement: ArrangementBuffers,
    pub(crate) boundary: BoundaryBuffers,
    pub(crate) assembly: AssemblyBuffers,
    /// What comparing boxes may cost; tests set it.
    pub(crate) budget: WorkBudget,
}

#[derive(Debug, Default)]
pub(crate) struct ExpressionBuffers {
    pub(crate) winding: WindingNumbers,
    pub(crate) bounds: ResultBounds,
}

#[derive(Debug, Default)]
pub(crate) struct EdgeBuffers {
    pub(crate) edges: Edges,
    pub(crate) keys: Vec<RingKey>,
    pub(crate) coincident: CoincidentEdges,
}

/// Filled for the edges, and once more for the rings of the result.
#[derive(Debug, Default)]
pub(crate) struct SpatialBuffers {
    pub(crate) chains: MonotoneChains,
    pub(crate) strips: Strips,
    pub(crate) slabs: SlabDecomposition,
}

#[derive(Debug, Default)]
pub(crate) struct ContactBuffers {
    pub(crate) contacts: Contacts,
    pub(crate) close_pairs: ClosePairs,
}

#[derive(Debug, Default)]
pub(crate) struct ArrangementBuffers {
    pub(crate) arrangement: Arrangement,
    pub(crate) labels: Labels,
}

#[derive(Debug, Default)]
pub(crate) struct BoundaryBuffers {
    pub(crate) selection: Selection,
    pub(crate) repair: Repair,
    pub(crate) outline: Outline,
}

#[derive(Debug, Default)]
pub(crate) struct AssemblyBuffers {
    pub(crate) cycles: Cycles,
    pub(crate) nesting: Nesting,
    pub(crate) positive: PositiveEdges,
}

impl Scratch {
    /// How many vertices were added to the last region because rounding made edges meet that do not: 0 for nearly every
    /// input.
    ///
    /// Each is a point of an edge with both coordinates rounded to the nearest double, which moves the edge there by at most
    /// half a unit in the last place. All other vertices are the input's, or crossings rounded once. Where two edges become one by
    /// this, what lay between them is gone, and with it the tip of a needle.
    ///
    /// ```
    /// use polycsg::{Csg, FillRule, Scratch};
    /// let mut scratch = Scratch::default();
    /// // Needles within a few units in the last place of one another: hardly a double is near where they cross.
    /// let height = |i: u32| 0.7 + f64::from(i * i % 23) * 1e-15;
    /// let needles = (0..20).map(|i| [[0.0, height(i)], [1.0, height(i + 7)], [1.0, height(i + 9)]]);
    /// Csg::from_rings(needles, FillRule::EvenOdd)?.evaluate_with(&mut scratch).validate().expect("valid as always");
    /// assert!(scratch.repaired_vertices() > 0);
    /// Csg::from_rings([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]], FillRule::EvenOdd)?.evaluate_with(&mut scratch);
    /// assert_eq!(scratch.repaired_vertices(), 0);
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn repaired_vertices(&self) -> usize {
        self.boundary.repair.vertices
    }
}
