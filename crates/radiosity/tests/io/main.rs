//! Files: what is read from them, what is written into them, and what bad ones lead to.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod glb;
mod gltf;
mod hostile;
mod lights;
mod photometry;
mod picture;
mod read;
mod samples;
mod scenes;
mod vs3;
mod write;
