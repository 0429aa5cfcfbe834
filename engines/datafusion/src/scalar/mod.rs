//! The functions of rows.
pub(crate) mod function;
pub(crate) mod measure;
pub(crate) mod overlay;
pub(crate) mod pairs;
pub(crate) mod relate;
pub(crate) mod side;
pub(crate) mod touch;
