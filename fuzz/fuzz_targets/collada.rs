//! Any text as a COLLADA file: a scene or a typed error, and a scene whose numbers can be used.
#![no_main]
use libfuzzer_sys::fuzz_target;
use radiosity::io::collada::Collada;

fuzz_target!(|text: &str| {
    let file = Collada::from_text("fuzz.dae", text);
    match file.scene() {
        Err(e) => assert!(e.to_string().contains("fuzz.dae"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
                // More than 1 comes through: `inspect` names it, and `solve` refuses it by name.
                assert!(
                    patch.reflectance.iter().all(|r| r.is_finite() && *r >= 0.0),
                    "{} reflects nonsense",
                    patch.name
                );
                assert!(
                    patch.emission.iter().all(|e| e.is_finite() && *e >= 0.0),
                    "{} emits nonsense",
                    patch.name
                );
            }
        }
    }
});
