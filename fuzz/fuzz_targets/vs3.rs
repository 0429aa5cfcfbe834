//! Any text as a View3D file: a scene or a typed error that names the line; a scene that can be written and read.
#![no_main]
use fuzz::{survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::vs3::Vs3;

fuzz_target!(|text: &str| {
    let file = Vs3::from_text("fuzz.vs3", text);
    match within_memory(text.len(), || file.scene()) {
        Err(e) => assert!(e.to_string().contains("fuzz.vs3:"), "which line? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
                assert!((0.0..=1.0).contains(&patch.reflectance[0]));
            }
            survives_writing(&scene);
        }
    }
});
