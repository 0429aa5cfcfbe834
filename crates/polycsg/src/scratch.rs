//! The buffers of all stages.

use crate::arrangement::Arrangement;
use crate::cancel::Cancel;
use crate::chains::Chains;
use crate::contacts::{Contacts, Patience};
use crate::copies::Copies;
use crate::edges::Edges;
use crate::labels::Labels;
use crate::link::Cycles;
use crate::nest::Nesting;
use crate::outline::Outline;
use crate::repair::Mending;
use crate::select::Selection;
use crate::slabs::Slabs;
use crate::strips::Strips;
use crate::suspects::Suspects;
use crate::truth::Truth;
use crate::window::Window;

/// The buffers of an evaluation, for reuse from call to call; it never borrows the operands.
///
/// They grow with the operands and with how often their edges meet: [`Csg::try_evaluate_with`](crate::Csg::try_evaluate_with)
/// sets a limit to that.
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
    pub(crate) truth: Truth,
    pub(crate) window: Window,
    pub(crate) edges: Edges,
    pub(crate) cancel: Cancel,
    pub(crate) chains: Chains,
    pub(crate) copies: Copies,
    pub(crate) strips: Strips,
    pub(crate) slabs: Slabs,
    pub(crate) patience: Patience,
    pub(crate) suspects: Suspects,
    pub(crate) contacts: Contacts,
    pub(crate) arrangement: Arrangement,
    pub(crate) labels: Labels,
    pub(crate) selection: Selection,
    pub(crate) mending: Mending,
    pub(crate) outline: Outline,
    pub(crate) cycles: Cycles,
    pub(crate) nesting: Nesting,
}

impl Scratch {
    /// How many vertices the last region got because rounding made edges meet that do not: 0 for nearly every input.
    ///
    /// Each is a point of an edge, rounded to the nearest double in both coordinates, so that edge moved by half a unit in
    /// the last place there. Other vertices are never moved: they are the input's, or crossings rounded once.
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
    pub fn repaired_vertices(&self) -> usize {
        self.mending.mended
    }
}
