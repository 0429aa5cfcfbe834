//! Limits refuse or change nothing, and leave the scratch as good as new.

use polycsg::{Csg, Error, FillRule, Limits, PreparedRegion, Region, Scratch};
use std::sync::atomic::{AtomicU32, Ordering};

type Ring = Vec<[f64; 2]>;

/// Numbers in 0..1, scattered.
fn scattered(seed: u32) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    }
}

fn quad(low: [f64; 2], high: [f64; 2]) -> Ring {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// Input for every way through the pipeline: boxes, slabs, many on a line, edges that coincide, and rounding to be repaired.
fn inputs() -> Vec<(&'static str, Csg<'static>)> {
    let csg = |rings: Vec<Ring>, rule| Csg::from_rings(rings, rule).expect("finite");
    let mut next = scattered(7);
    let crowd = (0..400).map(|_| {
        let [x, y] = [next(), next()];
        vec![[x, y], [x + 0.2 * next(), y + 0.1 * next()], [x + 0.1 * next(), y + 0.2 * next()]]
    });
    let crowd = csg(crowd.collect(), FillRule::EvenOdd);
    let bars = |slant: f64| {
        let bar = |i: u32| {
            let x = 2.0 * f64::from(i);
            vec![[x, -1.0], [x + 1.0, -1.0], [x + 1.0 + slant, 121.0], [x + slant, 121.0]]
        };
        (0..60).map(bar).collect::<Vec<Ring>>()
    };
    let levels =
        (0..60).map(|i| quad([-1.0, 2.0 * f64::from(i)], [130.0, 2.0 * f64::from(i) + 1.0])).collect();
    let comb = csg(bars(7.3), FillRule::NonZero) & csg(levels, FillRule::NonZero);
    let mut next = scattered(8);
    let line = (0..300).map(|_| {
        let x = 100.0 * next();
        quad([x, 0.0], [x + 20.0 * next() + 1.0, next() + 0.1])
    });
    let line = csg(line.collect(), FillRule::NonZero);
    let cells = |odd: u32| {
        let cell = move |i: u32| {
            let [x, y] = [f64::from(i % 20), f64::from(i / 20)];
            quad([x, y], [x + 1.0, y + 1.0])
        };
        (0..400).filter(move |i| (i / 20 + i % 20) % 2 == odd).map(cell).collect::<Vec<Ring>>()
    };
    let board = csg(cells(0), FillRule::NonZero) | csg(cells(1), FillRule::NonZero);
    let height = |i: u32| 0.7 + f64::from(i * i % 23) * 1e-15;
    let needles = (0..200).map(|i| vec![[0.0, height(i)], [1.0, height(i + 7)], [1.0, height(i + 9)]]);
    let needles = csg(needles.collect(), FillRule::EvenOdd);
    vec![("crowd", crowd), ("comb", comb), ("line", line), ("board", board), ("needles", needles)]
}

#[test]
fn any_amount_of_work_refuses_or_changes_nothing() {
    let mut scratch = Scratch::default();
    for (name, csg) in inputs() {
        let whole = csg.evaluate();
        let (mut refused, mut last) = (0, None);
        for i in 0..40 {
            let limit = 1_u64 << (i / 2) << (i / 2);
            let limits = Limits::default().work(limit);
            match csg.try_evaluate_with(&mut scratch, limits) {
                Ok(region) => {
                    assert_eq!(region, whole, "{name}");
                    last = last.or(Some(limit));
                }
                Err(error) => {
                    assert_eq!((error, last), (Error::TooMuchWork { limit }, None), "{name}");
                    refused += 1;
                }
            }
            // The next call finds a scratch as good as new.
            let square = Csg::from_rings([quad([0.0, 0.0], [1.0, 1.0])], FillRule::NonZero).expect("finite");
            assert_eq!(square.evaluate_with(&mut scratch).area(), 1.0);
        }
        assert!(refused > 5 && last.is_some(), "{name}: {refused} {last:?}");
    }
}

/// Whenever the caller says so: at the first time, the second, …
#[test]
fn a_call_can_be_stopped_whenever_it_asks() {
    for (name, csg) in inputs() {
        let mut scratch = Scratch::default();
        let whole = csg.evaluate();
        let mut stopped = 0;
        loop {
            let asked = AtomicU32::new(0);
            let stop = || asked.fetch_add(1, Ordering::Relaxed) == stopped;
            match csg.try_evaluate_with(&mut scratch, Limits::default().stop(&stop)) {
                Err(error) => assert_eq!(error, Error::Stopped, "{name}"),
                Ok(region) => break assert_eq!(region, whole, "{name}"),
            }
            stopped += 1;
            assert_eq!(asked.into_inner(), stopped, "{name}: asked again");
            assert_eq!(csg.evaluate_with(&mut scratch), whole, "{name}");
        }
        assert!(stopped > 0 || name == "board" || name == "needles", "{name}: never asked");
    }
}

#[test]
fn a_number_limits_contacts() {
    let crossing = [quad([0.0, 0.0], [2.0, 2.0]), quad([1.0, 1.0], [3.0, 3.0])];
    let csg = Csg::from_rings(crossing, FillRule::NonZero).expect("finite");
    let mut scratch = Scratch::default();
    assert_eq!(csg.try_evaluate_with(&mut scratch, 3), Err(Error::TooManyContacts { limit: 3 }));
    assert_eq!(csg.try_evaluate_with(&mut scratch, 4).map(|region| region.area()), Ok(7.0));
    let limits = Limits::default().contacts(4).work(1);
    assert_eq!(csg.try_evaluate_with(&mut scratch, limits), Err(Error::TooMuchWork { limit: 1 }));
}

#[test]
fn boundaries_are_limited_alike() {
    for (name, csg) in inputs() {
        let mut scratch = Scratch::default();
        let edges = csg.boundary(&mut scratch).edges().count();
        let mut refused = 0;
        let allowed = (0..40).map(|i| 1_u64 << (i / 2) << (i / 2)).find(|&limit| {
            match csg.try_boundary(&mut scratch, Limits::default().work(limit)) {
                Ok(boundary) => assert_eq!(boundary.edges().count(), edges, "{name}"),
                Err(error) => {
                    assert_eq!(error, Error::TooMuchWork { limit }, "{name}");
                    refused += 1;
                    return false;
                }
            }
            true
        });
        assert!(refused > 5 && allowed.is_some(), "{name}: {refused}");
        let stop = || true;
        let stopped = csg.try_boundary(&mut scratch, Limits::default().stop(&stop)).map(|_| ());
        assert!(stopped == Err(Error::Stopped) || name == "board" || name == "needles", "{name}");
    }
}

/// The work of all clips counts together, the contacts of each by itself.
#[test]
fn clips_are_limited_together() {
    let square =
        |x: f64| Region::from_rings([quad([x, x], [x + 2.0, x + 2.0])], FillRule::NonZero).expect("finite");
    let clip = PreparedRegion::from(square(0.0));
    let many: Vec<Region> = (0..5000).map(|i| square(f64::from(i % 30) * 0.1 - 1.5)).collect();
    let whole = clip.clip_all(&many);
    assert_eq!(clip.try_clip_all(&many, 16), Ok(whole.clone()));
    assert_eq!(clip.try_clip_all(&many, 3), Err(Error::TooManyContacts { limit: 3 }));
    let limits = Limits::default().work(1000);
    let first = clip.try_clip_all(&many[..1], limits);
    assert_eq!(first.as_deref(), Ok(&whole[..1]));
    assert_eq!(clip.try_clip_all(&many, limits), Err(Error::TooMuchWork { limit: 1000 }));
    let stop = || true;
    assert_eq!(clip.try_clip_all(&many, Limits::default().stop(&stop)), Err(Error::Stopped));
}
