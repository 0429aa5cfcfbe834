//! Any bytes as the materials of an OBJ file: a scene that can be written and read, or a typed error that names the files and the line.
#![no_main]
use base64::{Engine, engine::general_purpose::STANDARD};
use fuzz::{survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::obj::Obj;

/// A face with places in a picture, and one without.
const FACES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n\
                     usemtl m\nf 1/1 2/2 3/3\nusemtl white\nf 1 3 4\n";

fuzz_target!(|bytes: &[u8]| {
    let text = format!("mtllib data:;base64,{}\n{FACES}", STANDARD.encode(bytes));
    match within_memory(text.len(), || Obj::from_bytes("fuzz.obj", text).and_then(|file| file.scene())) {
        Err(e) => assert!(e.to_string().starts_with("fuzz.obj:1: embedded:"), "which file? {e}"),
        Ok(scene) => {
            assert_eq!(scene.patches.len(), 2);
            survives_writing(&scene);
        }
    }
});
