//! What the walk knows: the labels of sub-edges, and which component lies in which face.

/// What is known of a sub-edge, in bits: whether the expression holds on its left and on its right, whether these two are
/// known, and whether any component is nested beside it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Label(pub(super) u8);

impl Label {
    pub(super) const LEFT: u8 = 1;
    pub(super) const RIGHT: u8 = 2;
    pub(super) const KNOWN: u8 = 4;
    pub(super) const HAS_NESTED: u8 = 8;

    #[inline]
    pub(super) fn is(self, bit: u8) -> bool {
        self.0 & bit != 0
    }
}

/// A component, by its leftmost vertex, in the face left or right of a sub-edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NestedComponent {
    pub(super) sub_edge: u32,
    pub(super) left: bool,
    pub(super) vertex: u32,
}
