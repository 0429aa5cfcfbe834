//! What the solver promises, on scenes built here.
mod bands;
mod build;
mod extreme;
mod for_camera;
mod gathering;
mod interpolation;
mod levels;
mod lights;
mod recording;
mod resume;
mod rough;
mod sources;
mod stiff;
mod tiled;
