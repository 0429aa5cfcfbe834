//! Scenes in, light out.
