//! x
use tests::obstructed::{Plate, Plates, Prisms, Setting, pair};
#[test]
fn trial() {
    let unit = [0.0, 1.0];
    let sq = |b: Vec<Plate>| Plates {
        source: Plate { x: unit, y: unit, height: 0.0 },
        target: Plate { x: unit, y: unit, height: 1.0 },
        blockers: b,
    };
    for (b, e) in [
        (vec![], 0.199_824_895_698_387_4),
        (vec![Plate { x: [0.0, 0.5], y: [0.0, 0.5], height: 0.5 }], 0.149_868_671_773_790),
        (vec![Plate { x: [0.25, 0.75], y: [0.25, 0.75], height: 0.5 }], 0.099_506_294_598_984_8),
        (vec![Plate { x: [0.3, 0.7], y: [0.2, 0.9], height: 0.35 }], 0.101_200_016_253_138),
    ] {
        let p = sq(b);
        let f = p.form_factor();
        let t = std::time::Instant::now();
        let g = Prisms::from(&p).form_factor();
        println!("{f} {:e} {:e} {:?}", f - e, g - e, t.elapsed());
    }
    for seed in 0..80 {
        let p = pair(seed);
        let t = std::time::Instant::now();
        let f = p.form_factor();
        let t1 = t.elapsed();
        let t = std::time::Instant::now();
        let mut e = 0.0;
        if let Setting::Plates(plates) = &p.setting {
            if plates.blockers.len() <= 4 {
                e = Prisms::from(plates).form_factor() - f;
            }
        }
        println!("{} {} {:e} {:?} by prisms {:e} {:?}", p.name, p.polygons().len(), f, t1, e, t.elapsed());
    }
}
