//! Any text as an OBJ file: a scene or a typed error that names the file; a scene that can be written and read.
#![no_main]
use fuzz::{survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::obj::Obj;

fuzz_target!(|bytes: &[u8]| {
    match within_memory(bytes.len(), || Obj::from_bytes("fuzz.obj", bytes).and_then(|file| file.scene())) {
        Err(e) => assert!(e.to_string().starts_with("fuzz.obj:"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
            }
            survives_writing(&scene);
        }
    }
});
