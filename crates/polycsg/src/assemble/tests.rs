//! What is linked is closed, whatever the outline.
use super::link::Cycles;
use crate::base::meter::Meter;
use crate::boundary::outline::Outline;
use crate::predicates::Segment;
use glam::DVec2;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Edges that end anywhere: no panic, rings of these edges alone, and a word that some were left out.
    #[test]
    fn open_paths_are_left_out(ends in prop::collection::vec([(0..4_u8, 0..4_u8), (0..4_u8, 0..4_u8)], 0..14)) {
        let point = |(x, y): (u8, u8)| DVec2::new(f64::from(x), f64::from(y));
        let segments: Vec<Segment> = ends.into_iter().map(|ends| ends.map(point)).filter(|[a, b]| a != b).collect();
        let (mut outline, mut cycles, meter) = (Outline::default(), Cycles::default(), Meter::default());
        outline.build(segments.iter().copied(), false, &meter).expect("no limit was given");
        cycles.link(&outline, &meter).expect("no limit was given");
        let rings = cycles.rings().iter().map(|ring| ring.len()).sum::<usize>();
        let is_left = |p: DVec2| segments.iter().filter(|s| s[0] == p).count();
        let is_reached = |p: DVec2| segments.iter().filter(|s| s[1] == p).count();
        let is_balanced = segments.iter().flatten().all(|&p| is_left(p) == is_reached(p));
        prop_assert!(is_balanced || !cycles.alternate);
        prop_assert_eq!(rings == segments.len(), is_balanced);
        for edge in cycles.rings().iter().flat_map(|ring| (0..ring.len()).map(move |i| [ring[i], ring[(i + 1) % ring.len()]])) {
            prop_assert!(segments.contains(&edge));
        }
    }
}
