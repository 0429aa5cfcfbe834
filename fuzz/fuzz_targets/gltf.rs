//! Any bytes as a glTF file: a scene or a typed error, and a scene whose numbers can be used.
#![no_main]
use libfuzzer_sys::fuzz_target;
use radiosity::io::gltf::Gltf;

fuzz_target!(|bytes: &[u8]| {
    match Gltf::from_bytes("fuzz.glb", bytes).scene() {
        Err(e) => assert!(e.to_string().contains("fuzz.glb"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
                assert!(patch.reflectance.iter().chain(&patch.emission).all(|value| value.is_finite()));
            }
        }
    }
});
