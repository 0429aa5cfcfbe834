//! Files: what is read from them, what is written into them, and what bad ones lead to.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod exported;
mod formats;
mod glb;
mod gltf;
mod hostile;
mod lights;
mod obj;
mod photometry;
mod picture;
mod ply;
mod read;
mod samples;
mod scenes;
mod stl;
mod vs3;
mod write;
