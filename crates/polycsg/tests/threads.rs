//! Jobs on any number of threads yield the same bits.

use polycsg::{Csg, DVec2, FillRule, Region};

/// A star of long spikes, so that neighbours cross many times.
fn star(center: DVec2, spikes: u32) -> Region {
    let corner = |i: u32| {
        let radius = if i % 2 == 0 { 1.0 } else { 0.2 };
        center + DVec2::from_angle(f64::from(i) / f64::from(spikes) * std::f64::consts::PI) * radius
    };
    let ring: Vec<DVec2> = (0..2 * spikes).map(corner).collect();
    Region::from_rings([ring], FillRule::NonZero).expect("finite")
}

#[test]
fn any_number_of_threads() {
    let stars: Vec<Region> =
        (1..120).map(|i| star(DVec2::new(f64::from(i) * 0.1, f64::from(i % 7) * 0.1), 2 + i % 15)).collect();
    let jobs: Vec<Csg<'_>> = stars
        .windows(3)
        .map(|s| (Csg::from(&s[0]) | Csg::from(&s[1])) - Csg::from(&s[2]))
        .chain([Csg::union(&stars), Csg::symmetric_difference(&stars)])
        .collect();
    let serial: Vec<Region> = jobs.iter().map(Csg::evaluate).collect();
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert_eq!(pool.install(|| Csg::evaluate_all(&jobs)), serial, "{threads} threads");
    }
    assert!(Csg::evaluate_all(&[]).is_empty());
}
