//! Pictures beside exact gathers over their own solutions.
#![allow(dead_code, reason = "each of those who include it uses a part")]
pub(crate) mod area;
pub(crate) mod pixels;
pub(crate) mod sources;
