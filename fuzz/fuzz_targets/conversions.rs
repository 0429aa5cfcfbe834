//! Regions through geo-types and serde: bit for bit there and back; and of arbitrary polygons, only regions come in.
#![no_main]
use arbitrary::Arbitrary;
use geo_types::MultiPolygon;
use libfuzzer_sys::fuzz_target;
use polycsg::{FillRule, Region};

#[derive(Arbitrary, Debug)]
struct Input {
    /// On a lattice, so that polygons that form a region are likely.
    is_small: bool,
    polygons: Vec<Vec<Vec<[f64; 2]>>>,
    small: Vec<Vec<Vec<[u8; 2]>>>,
}

fuzz_target!(|input: Input| {
    let on_lattice = |[x, y]: [u8; 2]| [f64::from(x % 6), f64::from(y % 6)];
    let small =
        || input.small.iter().map(|p| p.iter().map(|r| r.iter().map(|&c| on_lattice(c)).collect()).collect());
    let polygons: Vec<Vec<Vec<[f64; 2]>>> =
        if input.is_small { small().collect() } else { input.polygons.clone() };
    let json = serde_json::to_string(&polygons).expect("numbers");
    if let Ok(region) = serde_json::from_str::<Region>(&json) {
        assert_eq!(region.validate(), Ok(()), "{json}");
    }
    let Ok(region) = Region::from_rings(polygons.iter().flatten(), FillRule::EvenOdd) else { return };
    let written = serde_json::to_string(&region).expect("a region");
    let read = serde_json::from_str::<Region>(&written).expect("what was written");
    assert_eq!(read, region, "{json}");
    assert_eq!(Region::try_from(&MultiPolygon::from(&region)), Ok(region), "{json}");
});
