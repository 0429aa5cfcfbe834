//! A boundary in a scratch that is warm allocates nothing, whatever the size of the input.

use peak_alloc::PeakAlloc;
use polycsg::{Csg, DVec2, FillRule, Scratch};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// A square less `count` triangles that stand over its lower side.
fn saw(count: u32) -> Csg<'static> {
    let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let tooth = |i: u32| {
        let (x, width) = (f64::from(i) / f64::from(count), 0.7 / f64::from(count));
        [DVec2::new(x, -0.1), DVec2::new(x + width, -0.1), DVec2::new(x + width / 3.0, 0.5)]
    };
    Csg::from_rings([square], FillRule::NonZero).expect("finite")
        - Csg::from_rings((0..count).map(tooth), FillRule::NonZero).expect("finite")
}

#[test]
fn a_warm_scratch_allocates_nothing() {
    let mut scratch = Scratch::default();
    for count in [1, 3, 9, 60, 2000] {
        let csg = saw(count);
        let area = csg.boundary(&mut scratch).area();
        // The test's own threads may allocate meanwhile; what the boundary needs, it needs each time.
        let allocates = (0..9).all(|_| {
            let before = ALLOCATOR.current_usage();
            ALLOCATOR.reset_peak_usage();
            assert_eq!(csg.boundary(&mut scratch).area(), area);
            ALLOCATOR.peak_usage() > before
        });
        assert!(!allocates, "{count} triangles");
        assert!(area < 0.99);
    }
}
