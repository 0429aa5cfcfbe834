//! Any bytes as a PLY file, or a body of any bytes behind a good header: a scene or a typed error that names the file; a scene that can
//! be written and read.
#![no_main]
use arbitrary::Arbitrary;
use fuzz::{survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::ply::Ply;

#[derive(Arbitrary, Debug)]
enum Input<'a> {
    Bytes(&'a [u8]),
    Body { writing: u8, vertices: u8, faces: u8, types: [u8; 3], is_strip: bool, bytes: &'a [u8] },
}

const TYPES: [&str; 8] = ["char", "uchar", "short", "ushort", "int", "uint", "float", "double"];

fuzz_target!(|input: Input| {
    let bytes = match input {
        Input::Bytes(bytes) => bytes.to_vec(),
        Input::Body { writing, vertices, faces, types, is_strip, bytes } => {
            let writings = ["ascii", "binary_little_endian", "binary_big_endian"];
            let writing = writings[usize::from(writing) % 3];
            let [number, length, index] = types.map(|kind| TYPES[usize::from(kind) % 8]);
            let element = if is_strip { "tristrips" } else { "face" };
            let header = format!(
                "ply\nformat {writing} 1.0\nelement vertex {vertices}\nproperty {number} x\nproperty {number} y\nproperty {number} z\n\
                 property uchar red\nproperty uchar green\nproperty uchar blue\n\
                 element {element} {faces}\nproperty list {length} {index} vertex_indices\nend_header\n"
            );
            [header.as_bytes(), bytes].concat()
        }
    };
    let size = bytes.len();
    match within_memory(size, || Ply::from_bytes("fuzz.ply", bytes).scene()) {
        Err(e) => assert!(e.to_string().starts_with("fuzz.ply:"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
                assert!(patch.reflectance.iter().all(|r| r.is_finite() && *r >= 0.0), "{}: nonsense", patch.name);
            }
            survives_writing(&scene);
        }
    }
});
