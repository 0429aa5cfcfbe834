//! How much work comparing boxes may take before it is given up.

/// How long bounding boxes are compared before the slab decomposition takes over: up to so many pairs of edges for each
/// edge and for each node found, and up to so many blocks of boxes for each edge.
///
/// Where edges do cross, boxes are quicker: among many long edges in all directions about 4 pairs make a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorkBudget {
    pairs: usize,
    pairs_per_edge: usize,
    pairs_per_node: usize,
    blocks_per_edge: usize,
}

#[cfg(any(test, fuzzing))]
impl WorkBudget {
    /// No boxes at all: slabs at once.
    pub(crate) const NONE: WorkBudget =
        WorkBudget { pairs: 0, pairs_per_edge: 0, pairs_per_node: 0, blocks_per_edge: 0 };
}

impl Default for WorkBudget {
    fn default() -> WorkBudget {
        WorkBudget { pairs: 1000, pairs_per_edge: 48, pairs_per_node: 8, blocks_per_edge: 32 }
    }
}

impl WorkBudget {
    /// How many blocks of boxes may be looked at.
    pub(crate) fn blocks(self, edges: usize) -> usize {
        self.pairs + self.blocks_per_edge * edges
    }

    /// Twice as much, for those who were told that it would last.
    pub(crate) fn doubled(self) -> WorkBudget {
        let twice = |n: usize| n.saturating_mul(2);
        WorkBudget {
            pairs: twice(self.pairs),
            pairs_per_edge: twice(self.pairs_per_edge),
            pairs_per_node: twice(self.pairs_per_node),
            blocks_per_edge: twice(self.blocks_per_edge),
        }
    }

    /// Whether to go on when so many pairs of edges and nodes were found.
    #[inline]
    pub(crate) fn lasts(self, edges: usize, pairs: usize, nodes: usize) -> bool {
        pairs < self.pairs + self.pairs_per_edge * edges + self.pairs_per_node * nodes
    }
}
