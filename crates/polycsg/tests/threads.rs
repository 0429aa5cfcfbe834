//! Jobs on any number of threads, and one job on many, yield the same bits.

use polycsg::{Csg, DVec2, FillRule, PreparedRegion, Region};

/// A star of long spikes, so that neighbours cross many times.
fn star(center: DVec2, spikes: u32) -> Region {
    let corner = |i: u32| {
        let radius = if i % 2 == 0 { 1.0 } else { 0.2 };
        center + DVec2::from_angle(f64::from(i) / f64::from(spikes) * std::f64::consts::PI) * radius
    };
    let ring: Vec<DVec2> = (0..2 * spikes).map(corner).collect();
    Region::from_rings([ring], FillRule::NonZero).expect("finite")
}

/// Enough edges for one job on many threads: stars over one another, on a lattice so that many meet in common points.
#[test]
fn inside_one_job() {
    let at = |i: u32| DVec2::new(f64::from(i % 60) * 0.75, f64::from(i / 60) * 0.75);
    let stars: Vec<Region> = (0..3600).map(|i| star(at(i), 7)).collect();
    let (some, others) = stars.split_at(1800);
    let job = Csg::union(some) ^ Csg::union(others) ^ Csg::union(&stars[..40]);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let edges: Vec<_> = job.boundary(&mut polycsg::Scratch::default()).edges().collect();
            (job.evaluate(), edges)
        })
    };
    let serial = on(1);
    assert!(serial.0.area() > 100.0);
    for threads in [2, 3, 8] {
        assert!(on(threads) == serial, "{threads} threads");
    }
}

/// Asserts that a job has one result on any number of threads.
fn is_one_on_any(job: &Csg<'_>) {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| job.evaluate())
    };
    let serial = on(1);
    assert!(serial.area() > 0.0);
    for threads in [2, 3, 8] {
        assert!(on(threads) == serial, "{threads} threads");
    }
}

/// Boxes do not prune long spikes: slabs find what meets, and what lies below each of the many rings of the result.
#[test]
fn inside_slabs() {
    let stars = [0.0, 1e-5].map(|x| star(DVec2::new(x, 0.0), 13_000));
    is_one_on_any(&Csg::symmetric_difference(&stars));
}

/// Rings that nothing meets: chains, boxes and rays alone. In every other square lies another one.
#[test]
fn among_rings_that_nothing_meets() {
    let square =
        |(low, high): (DVec2, DVec2)| [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let at = |i: u32| DVec2::new(f64::from(i % 80), f64::from(i / 80));
    let outer = (0..9000).map(|i| square((at(i), at(i) + 0.8)));
    let inner = (0..4500).map(|i| square((at(2 * i) + 0.2, at(2 * i) + 0.5)));
    is_one_on_any(&Csg::from_rings(outer.chain(inner), FillRule::EvenOdd).expect("finite"));
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
    let clip = PreparedRegion::from(star(DVec2::new(6.0, 0.0), 40));
    let clipped: Vec<Region> = stars.iter().map(|star| star.intersection(clip.region())).collect();
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert_eq!(pool.install(|| Csg::evaluate_all(&jobs)), serial, "{threads} threads");
        assert_eq!(pool.install(|| clip.clip_all(&stars)), clipped, "{threads} threads");
    }
    assert!(Csg::evaluate_all(&[]).is_empty());
}
