//! Ids are 32 bits wide: more than 2^32 of anything would not fit in memory.

use std::ops::Range;

/// An index as an id.
#[inline]
pub(crate) fn index(i: usize) -> u32 {
    u32::try_from(i).expect("fewer than 2^32 vertices, edges and operands")
}

/// A range of indices as a range of ids.
pub(crate) fn span(indices: Range<usize>) -> Range<u32> {
    index(indices.start)..index(indices.end)
}
