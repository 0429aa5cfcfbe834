//! Buffers
/// stub
#[derive(Debug, Default)]
pub struct Scratch {}
