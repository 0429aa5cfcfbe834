//! The index of a prepared region takes no more memory than its page says.

use peak_alloc::PeakAlloc;
use polycsg::{DVec2, FillRule, PreparedRegion, Region};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

#[test]
fn an_index_takes_what_it_says() {
    let corner = |i: u32, n: u32| DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / f64::from(n));
    for (rings, n) in [(1, 3), (1, 8), (1, 9), (1, 1000), (1, 100_000), (50, 4), (50, 60), (3000, 12)] {
        let ring = |k: u32| (0..n).map(move |i| corner(i, n) + 3.0 * f64::from(k)).collect::<Vec<_>>();
        let region = Region::from_rings((0..rings).map(ring), FillRule::NonZero).expect("finite");
        let before = ALLOCATOR.current_usage();
        let prepared = PreparedRegion::from(region);
        let index = ALLOCATOR.current_usage() - before;
        let most = (20 * n as usize + 160) * rings as usize;
        assert!(index <= most && 4 * index >= most, "{rings} rings of {n} edges: {index} bytes of {most}");
        assert!(!prepared.region().is_empty());
    }
}
