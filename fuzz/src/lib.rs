//! What the targets of readers have in common: memory is watched, and a scene is compared with itself written and read.

use peak_alloc::PeakAlloc;
use radiosity::io::collada::Collada;
use radiosity::{Patch, Scene};

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// The most bytes of memory for each byte of a file, while it is read: a byte of a strip of triangles makes a patch.
const PER_BYTE: usize = 4096;
/// The same for a file of no bytes.
const BASE: usize = 1 << 22;

/// Reads a file of so many bytes.
///
/// # Panics
/// When that takes more memory than a multiple of its size.
pub fn within_memory<T>(bytes: usize, read: impl FnOnce() -> T) -> T {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let read = read();
    let most = BASE + PER_BYTE * bytes;
    let used = MEMORY.peak_usage().saturating_sub(before);
    assert!(used <= most, "{used} bytes of memory for a file of {bytes}");
    read
}

/// Writes a scene as COLLADA, reads that, and writes it again.
///
/// # Panics
/// When a patch is not what it was, or the second text is not the first.
pub fn survives_writing(scene: &Scene) {
    let written = Collada::of(scene);
    let again = written.scene().unwrap_or_else(|e| panic!("{e}\n{}", written.text()));
    assert_eq!(scene.patches.len(), again.patches.len(), "{}", written.text());
    for (patch, read) in scene.patches.iter().zip(&again.patches) {
        assert_eq!(facts(patch), facts(read), "{}", written.text());
    }
    assert_eq!((scene.cameras.len(), scene.asset), (again.cameras.len(), again.asset));
    // XML has no name for some characters; what takes their place may need a number to tell two patches apart.
    let is_writable =
        |patch: &Patch| !patch.name.contains(|c| matches!(c, '\0'..' ' | '\u{fffe}' | '\u{ffff}'));
    if !scene.patches.iter().all(is_writable) {
        return;
    }
    let names = |scene: &Scene| scene.patches.iter().map(|patch| patch.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(scene), names(&again));
    // The angles and axes of cameras are rounded when they are written.
    if scene.cameras.is_empty() {
        assert_eq!(Collada::of(&again).text(), written.text());
    }
}

/// What a file must keep of a patch, every number to the last bit: −0 is written as 0.
fn facts(patch: &Patch) -> (Vec<Vec<[u64; 3]>>, Vec<u64>) {
    let bits = |number: f64| (number + 0.0).to_bits();
    let loops = patch.polygon.loops().map(|points| points.iter().map(|p| p.to_array().map(bits)).collect());
    let colours = patch.reflectance.iter().chain(&patch.emission);
    (loops.collect(), colours.map(|&number| bits(number)).collect())
}
