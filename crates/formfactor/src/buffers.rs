//! The buffers of one form factor.
use crate::quick::QuickBuffers;
use crate::stats::Stats;
use polycsg::Scratch;

/// What one form factor needs, and what it counts.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    pub(crate) scratch: Scratch,
    pub(crate) quick: QuickBuffers,
    pub(crate) stats: Stats,
}
