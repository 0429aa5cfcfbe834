//! What meets an edge, and where on it.

use crate::predicates::Parameter;

/// What meets an edge in a contact: a kind in the top bits, and the id of an edge or vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Partner(u32);

/// The kinds of [`Partner`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartnerKind {
    /// An edge that crosses from the left to the right.
    FromLeft(u32),
    /// An edge that crosses from the right to the left.
    FromRight(u32),
    /// A vertex inside the edge.
    Vertex(u32),
    /// The edge's own start.
    Start,
    /// The start of an open ring.
    First,
    /// The end of an open ring: no edge starts there.
    End,
}

impl Partner {
    const ID: u32 = (1 << 30) - 1;
    const FROM_RIGHT: u32 = 1 << 30;
    const VERTEX: u32 = 2 << 30;
    pub(super) const START: Partner = Partner(3 << 30);
    pub(super) const FIRST: Partner = Partner(3 << 30 | 1);
    pub(super) const END: Partner = Partner(3 << 30 | 2);

    pub(super) fn crossing(edge: u32, from_left: bool) -> Partner {
        Partner(edge | if from_left { 0 } else { Partner::FROM_RIGHT })
    }

    pub(crate) fn vertex(vertex: u32) -> Partner {
        Partner(vertex | Partner::VERTEX)
    }

    #[inline]
    pub(crate) fn kind(self) -> PartnerKind {
        let id = self.0 & Partner::ID;
        match (self.0 >> 30, id) {
            (0, _) => PartnerKind::FromLeft(id),
            (1, _) => PartnerKind::FromRight(id),
            (2, _) => PartnerKind::Vertex(id),
            (_, 0) => PartnerKind::Start,
            (_, 1) => PartnerKind::First,
            _ => PartnerKind::End,
        }
    }

    /// Whether an edge's own start, or the end of its open ring, meets it, and nothing else does.
    #[inline]
    pub(crate) fn is_end(self) -> bool {
        self.0 >= Partner::START.0
    }
}

/// A node on an edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    // A parameter taken apart, as the whole has padding. The error is negative where the contact lies in the place of the one before.
    value: f64,
    error: f32,
    pub(crate) edge: u32,
    pub(crate) node: u32,
    pub(crate) partner: Partner,
}

impl Contact {
    #[inline]
    pub(super) fn new(at: Parameter, edge: u32, node: u32, partner: Partner) -> Contact {
        let Parameter { value, error } = at;
        Contact { value, error, edge, node, partner }
    }

    /// Where along the edge it is.
    #[inline]
    pub(crate) fn at(&self) -> Parameter {
        Parameter { value: self.value, error: self.error.abs() }
    }

    /// Whether it lies in the place of the contact before it, as far as this is known.
    #[inline]
    pub(super) fn is_with_previous(&self) -> bool {
        self.error.is_sign_negative()
    }

    pub(super) fn set_with_previous(&mut self) {
        self.error = -self.error.abs();
    }
}
