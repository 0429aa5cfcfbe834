//! What the targets of readers have in common: memory is watched, and a scene is compared with itself written and read.

use peak_alloc::PeakAlloc;
use radiosity::expose::Exposure;
use radiosity::glam::DVec3;
use radiosity::inspect::coplanar_overlaps;
use radiosity::io::Source;
use radiosity::io::collada::Collada;
use radiosity::io::gltf::{Gltf, glb};
use radiosity::{Patch, PatchRecord, Photometry, Record, Repaired, Scene, needed_sides, repair};

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
    let lights = |scene: &Scene| (scene.lamps.len(), scene.suns.len());
    assert_eq!(lights(scene), lights(&again), "{}", written.text());
    // The angles and axes of cameras and lights are rounded when they are written.
    if scene.cameras.is_empty() && lights(scene) == (0, 0) {
        assert_eq!(Collada::of(&again).text(), written.text());
    }
}

/// Looks in all directions.
///
/// # Panics
/// When an intensity is negative, or the flux not finite.
pub fn is_sound_photometry(table: &Photometry) {
    for (x, y, z) in (0..343).map(|k| (k % 7 - 3, k / 7 % 7 - 3, k / 49 - 3)).filter(|way| *way != (0, 0, 0))
    {
        let candela = table.candela(DVec3::new(f64::from(x), f64::from(y), f64::from(z)));
        assert!(candela >= 0.0, "{candela} cd along {x} {y} {z}");
    }
    assert!(table.lumens().is_finite(), "{}", table.lumens());
}

/// Repairs a scene that a file has, writes the file repaired, and reads that.
///
/// # Panics
/// When two repaired patches overlap, or the repaired file is refused.
pub fn survives_repair(file: &Source, scene: &Scene) {
    let before = needed_sides(scene);
    let Repaired { scene: after, .. } = repair(&before);
    let overlaps = coplanar_overlaps(&after);
    assert!(overlaps.is_empty(), "{overlaps:?}");
    let written = match file {
        Source::Collada(file) => file.repaired(&before, &after).map(String::into_bytes),
        Source::Gltf(file) => file.repaired(&before, &after),
        _ => return,
    };
    let written = written.expect("a file that was read");
    Source::from_bytes("repaired", written).and_then(|file| file.scene()).expect("a file that can be read");
}

/// What a file must keep of a patch, every number to the last bit: −0 is written as 0.
fn facts(patch: &Patch) -> (Vec<Vec<[u64; 3]>>, Vec<u64>) {
    let bits = |number: f64| (number + 0.0).to_bits();
    let loops = patch.polygon.loops().map(|points| points.iter().map(|p| p.to_array().map(bits)).collect());
    let colours = patch.reflectance.iter().chain(&patch.emission);
    (loops.collect(), colours.map(|&number| bits(number)).collect())
}

/// Writes a scene's outlines as fans of triangles, lit alike, as GLB, and reads that. Such a file holds the places relative
/// to a place, both in single precision: the one in binary, the other in decimal digits.
///
/// # Panics
/// When the file is refused, or its surfaces, seen from all sides, do not have the fans' vertices and areas.
pub fn survives_lighting(scene: &Scene) {
    let record = lit(scene);
    let bytes = glb(&record, Exposure::new(1.0).expect("positive")).expect("a small file");
    let again = Gltf::from_bytes("lit.glb", bytes).scene().unwrap_or_else(|e| panic!("{e}\n{record:?}"));
    assert_eq!(scene.cameras.len(), again.cameras.len(), "{record:?}");
    let limit = f64::from(f32::MAX);
    if record.vertices.iter().any(|p| p.abs().max_element() > limit) {
        return;
    }
    let single = |p: DVec3| p.as_vec3().as_dvec3();
    let digits = |p: DVec3| p.map(|c| (c as f32).to_string().parse().expect("a number"));
    let (low, high) = record
        .vertices
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    let middle = digits(low.midpoint(high));
    let places: Vec<DVec3> = record.vertices.iter().map(|p| single(*p - middle) + middle).collect();
    let read = || again.patches.iter().flat_map(|patch| patch.polygon.loops());
    assert!(read().flatten().all(|p| places.contains(p)), "another place: {record:?}\n{again:?}");
    let fans = record.elements.iter().map(|&[_, a, b, c]| area(&[places[a], places[b], places[c]]));
    let (fans, read): (DVec3, DVec3) = (fans.sum(), read().map(area).sum());
    let size = places.iter().fold(0.0_f64, |size, p| size.max(p.abs().max_element()));
    let rounding = 1e-9 * record.elements.len() as f64 * size * size;
    assert!((fans - read).abs().max_element() <= rounding, "{fans} {read} {record:?}\n{again:?}");
}

/// The area of a loop, along its normal.
fn area(points: &[DVec3]) -> DVec3 {
    let around = points.iter().zip(points.iter().cycle().skip(1));
    around.map(|(p, q)| (*p - points[0]).cross(*q - points[0]) / 2.0).sum()
}

/// A solution of a scene as it would be written: its outlines as fans, 1 W/m² everywhere.
fn lit(scene: &Scene) -> Record {
    let (mut vertices, mut elements) = (Vec::new(), Vec::new());
    for (patch, outline) in scene.patches.iter().filter_map(|p| p.polygon.loops().next()).enumerate() {
        let first = vertices.len();
        vertices.extend_from_slice(outline);
        elements.extend((1..outline.len() - 1).map(|i| [patch, first, first + i, first + i + 1]));
    }
    let ones = |rows: usize| vec![1.0; rows * scene.bands];
    let patch = |patch: &Patch| PatchRecord {
        name: patch.name.clone(),
        area: patch.polygon.area(),
        reflectance: patch.reflectance.clone(),
        emission: patch.emission.clone(),
        irradiance: ones(1),
        radiosity: ones(1),
        estimate: Vec::new(),
        in_view: None,
        picture: None,
        tint: [1.0; 3],
    };
    Record {
        scene: "lit".into(),
        asset: scene.asset,
        cameras: scene.cameras.clone(),
        bands: scene.bands,
        wavelengths: Vec::new(),
        lumens: Vec::new(),
        bound: ones(1),
        patches: scene.patches.iter().map(patch).collect(),
        vertex_radiosity: ones(vertices.len()),
        vertex_irradiance: ones(vertices.len()),
        places: Vec::new(),
        radiosity: ones(elements.len()),
        irradiance: ones(elements.len()),
        pictures: Vec::new(),
        recording: None,
        vertices,
        elements,
    }
}
