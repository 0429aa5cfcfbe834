//! Any bytes under any name: what they are is found out, and they are read or refused in one line that names the file.
#![no_main]
use arbitrary::Arbitrary;
use fuzz::within_memory;
use libfuzzer_sys::fuzz_target;
use radiosity::io::Source;

#[derive(Arbitrary, Debug)]
struct Input<'a> {
    end: u8,
    bytes: &'a [u8],
}

fuzz_target!(|input: Input| {
    let ends = ["", ".dae", ".gltf", ".glb", ".obj", ".ply", ".stl", ".vs3", ".xyz"];
    let name = format!("fuzz{}", ends[usize::from(input.end) % ends.len()]);
    let read = || Source::from_bytes(name.as_str(), input.bytes).and_then(|source| source.scene());
    if let Err(e) = within_memory(input.bytes.len(), read) {
        assert!(e.to_string().starts_with(&name), "which file? {e}");
    }
});
