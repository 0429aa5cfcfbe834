//! Which inputs are run, in which sizes and by which routes, and what ratio each row asks for.

/// A kind of input.
#[derive(Debug)]
pub(crate) struct Plan {
    /// Its name.
    pub(crate) family: &'static str,
    /// The ways to give polycsg its operands that the ratio is asked of.
    pub(crate) routes: &'static [&'static str],
    /// The ways that are shown beside them.
    pub(crate) shown: &'static [&'static str],
    /// The peer that the aim is about; the fastest if none.
    pub(crate) rival: Option<&'static str>,
    /// Sizes, and the ratio that is aimed at.
    sizes: &'static [(usize, f64)],
    /// How many of the sizes a quick run does.
    quick: usize,
}

/// A kind of input in one size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Workload {
    /// The kind.
    pub(crate) plan: &'static Plan,
    /// The size.
    pub(crate) size: usize,
    /// The ratio that is aimed at.
    pub(crate) limit: f64,
}

impl Workload {
    /// Kind and size.
    pub(crate) fn name(&self) -> String {
        match self.plan.family {
            "square-triangle" => self.plan.family.to_owned(),
            "land" | "countries" | "counties" => format!("{}-{}m", self.plan.family, self.size),
            family => format!("{family}-{}", self.size),
        }
    }
}

/// From raw rings, and beside it from regions.
const fn plan(family: &'static str, sizes: &'static [(usize, f64)], quick: usize) -> Plan {
    Plan { family, routes: &["rings"], shown: &["regions"], rival: None, sizes, quick }
}

/// Small pairs.
const SMALL: &[(usize, f64)] =
    &[(8, 0.5), (16, 0.5), (32, 0.5), (64, 0.5), (128, 0.5), (256, 0.5), (512, 0.5), (1_024, 0.5)];

/// Vertices of a clip.
const CLIPS: &[(usize, f64)] = &[(100, 0.5), (1_000, 0.5), (10_000, 0.5), (100_000, 0.5)];

const STREET: &[(usize, f64)] = &[(1_000, 1.0), (3_000, 1.0), (10_000, 1.0)];

const GENERATED: &[Plan] = &[
    plan("square-triangle", &[(0, 0.5)], 1),
    Plan {
        shown: &["regions", "rings-boundary"],
        ..plan("square-rectangles", &[(10, 0.5), (100, 0.5), (1_000, 0.4), (10_000, 0.3)], 3)
    },
    plan("smooth-intersection", SMALL, SMALL.len()),
    plan("smooth-union", SMALL, SMALL.len()),
    plan("ragged-intersection", SMALL, SMALL.len()),
    plan("tiles", SMALL, SMALL.len()),
    plan("neighbours", SMALL, SMALL.len()),
    plan("checkers-shifted", &[(100, 0.7), (300, 0.7)], 1),
    plan("checkers-complement", &[(100, 0.5), (300, 0.5)], 1),
    plan("grid", &[(100, 0.5), (300, 0.5)], 1),
    plan("stars", &[(1_000, 0.5), (10_000, 0.35), (100_000, 0.3)], 2),
    plan("annuli", &[(100, 0.5), (1_000, 0.4), (10_000, 0.3)], 2),
    plan("combs", &[(4_000, 0.8), (16_000, 0.8), (100_000, 0.8), (400_000, 0.8)], 2),
    plan("holes", &[(1_000, 0.5), (10_000, 0.4), (100_000, 0.4)], 2),
    plan("blobs", &[(10_000, 0.4), (100_000, 0.4), (500_000, 0.4)], 2),
    plan("octagons", &[(1_000, 0.3), (10_000, 0.3), (100_000, 0.3)], 2),
    Plan {
        routes: &["operands", "regions", "geo-types", "rings"],
        shown: &[],
        rival: Some("geo"),
        ..plan("parcels", &[(10_000, 0.5), (90_000, 0.5)], 1)
    },
    Plan { routes: &["clips"], shown: &[], rival: Some("geos"), ..plan("clips-smooth", CLIPS, 3) },
    Plan { routes: &["clips"], shown: &[], rival: Some("geos"), ..plan("clips-spiky", CLIPS, 2) },
    Plan { routes: &["rings", "regions"], shown: &[], rival: Some("geos"), ..plan("skyline", STREET, 2) },
    Plan {
        routes: &["rings", "regions"],
        shown: &[],
        rival: Some("geos"),
        ..plan("baseline-random", STREET, 1)
    },
];

const MAPS: &[Plan] = &[
    plan("land", &[(50, 0.4), (10, 0.4)], 1),
    plan("countries", &[(50, 0.4), (10, 0.6)], 1),
    plan("counties", &[(10, 0.4)], 1),
];

/// The rows, smaller inputs of a kind before larger ones.
pub(crate) fn workloads(quick: bool, maps: bool) -> Vec<Workload> {
    let plans = GENERATED.iter().chain(if maps { MAPS } else { &[] });
    let rows = |plan: &'static Plan| {
        let sizes = if quick { &plan.sizes[..plan.quick] } else { plan.sizes };
        sizes.iter().map(move |&(size, limit)| Workload { plan, size, limit })
    };
    plans.flat_map(rows).collect()
}
