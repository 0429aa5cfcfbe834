//! Any bytes as an STL file, or a binary one of any triangles: a scene or a typed error that names the file; a scene that can be written
//! and read.
#![no_main]
use arbitrary::Arbitrary;
use fuzz::{survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::stl::Stl;

#[derive(Arbitrary, Debug)]
enum Input<'a> {
    Bytes(&'a [u8]),
    /// On a small lattice, so that faces in one plane are likely.
    Lattice(Vec<[[i8; 3]; 3]>),
    Triangles(Vec<[[f32; 3]; 3]>),
}

fuzz_target!(|input: Input| {
    let bytes = match input {
        Input::Bytes(bytes) => bytes.to_vec(),
        Input::Lattice(triangles) => {
            binary(triangles.into_iter().map(|triangle| triangle.map(|point| point.map(f32::from))).collect())
        }
        Input::Triangles(triangles) => binary(triangles),
    };
    let size = bytes.len();
    match within_memory(size, || Stl::from_bytes("fuzz.stl", bytes).scene()) {
        Err(e) => assert!(e.to_string().starts_with("fuzz.stl:"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
            }
            survives_writing(&scene);
        }
    }
});

fn binary(triangles: Vec<[[f32; 3]; 3]>) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(u32::try_from(triangles.len()).unwrap_or_default().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}
