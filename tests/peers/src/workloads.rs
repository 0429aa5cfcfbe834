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
    /// What it is listed with.
    pub(crate) group: &'static Group,
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

const fn clips(family: &'static str, quick: usize) -> Plan {
    Plan { routes: &["clips"], shown: &[], rival: Some("geos"), ..plan(family, CLIPS, quick) }
}

const fn street(family: &'static str, quick: usize) -> Plan {
    let sizes = &[(1_000, 1.0), (3_000, 1.0), (10_000, 1.0)];
    Plan { routes: &["rings", "regions"], shown: &[], rival: Some("geos"), ..plan(family, sizes, quick) }
}

/// Kinds of input that share a table.
#[derive(Debug)]
pub(crate) struct Group {
    /// The table's heading.
    pub(crate) title: &'static str,
    /// The kinds.
    pub(crate) plans: &'static [Plan],
}

const GENERATED: &[Group] = &[
    Group { title: "A square minus a triangle", plans: &[plan("square-triangle", &[(0, 0.5)], 1)] },
    Group {
        title: "A square minus rectangles",
        plans: &[Plan {
            shown: &["regions", "rings-boundary"],
            ..plan("square-rectangles", &[(10, 0.5), (100, 0.5), (1_000, 0.4), (10_000, 0.3)], 3)
        }],
    },
    Group {
        title: "Pairs of outlines",
        plans: &[
            plan("smooth-intersection", SMALL, SMALL.len()),
            plan("smooth-union", SMALL, SMALL.len()),
            plan("ragged-intersection", SMALL, SMALL.len()),
            plan("tiles", SMALL, SMALL.len()),
        ],
    },
    Group { title: "Neighbours with a common border", plans: &[plan("neighbours", SMALL, SMALL.len())] },
    Group {
        title: "Checkerboards",
        plans: &[
            plan("checkers-shifted", &[(100, 0.7), (300, 0.7)], 1),
            plan("checkers-complement", &[(100, 0.5), (300, 0.5)], 1),
        ],
    },
    Group { title: "Grids", plans: &[plan("grid", &[(100, 0.5), (300, 0.5)], 1)] },
    Group {
        title: "Stars and annuli",
        plans: &[
            plan("stars", &[(1_000, 0.5), (10_000, 0.35), (100_000, 0.3)], 2),
            plan("annuli", &[(100, 0.5), (1_000, 0.4), (10_000, 0.3)], 2),
        ],
    },
    Group {
        title: "Combs",
        plans: &[plan("combs", &[(4_000, 0.8), (16_000, 0.8), (100_000, 0.8), (400_000, 0.8)], 2)],
    },
    Group { title: "Holes", plans: &[plan("holes", &[(1_000, 0.5), (10_000, 0.4), (100_000, 0.4)], 2)] },
    Group { title: "Blobs", plans: &[plan("blobs", &[(10_000, 0.4), (100_000, 0.4), (500_000, 0.4)], 2)] },
    Group {
        title: "Octagons",
        plans: &[plan("octagons", &[(1_000, 0.3), (10_000, 0.3), (100_000, 0.3)], 2)],
    },
    Group {
        title: "Parcels dissolved",
        plans: &[Plan {
            routes: &["operands", "regions", "geo-types", "rings"],
            shown: &[],
            rival: Some("geo"),
            ..plan("parcels", &[(10_000, 0.5), (90_000, 0.5)], 1)
        }],
    },
    Group {
        title: "Small polygons clipped one by one",
        plans: &[clips("clips-smooth", 3), clips("clips-spiky", 2)],
    },
    Group { title: "Buildings on one line", plans: &[street("skyline", 2), street("baseline-random", 1)] },
];

const MAPS: &[Group] = &[Group {
    title: "Maps",
    plans: &[
        plan("land", &[(50, 0.4), (10, 0.4)], 1),
        plan("countries", &[(50, 0.4), (10, 0.6)], 1),
        plan("counties", &[(10, 0.4)], 1),
    ],
}];

/// The rows, smaller inputs of a kind before larger ones.
pub(crate) fn workloads(quick: bool, maps: bool) -> Vec<Workload> {
    let groups = GENERATED.iter().chain(if maps { MAPS } else { &[] });
    let plans = groups.flat_map(|group| group.plans.iter().map(move |plan| (group, plan)));
    let rows = |(group, plan): (&'static Group, &'static Plan)| {
        let sizes = if quick { &plan.sizes[..plan.quick] } else { plan.sizes };
        sizes.iter().map(move |&(size, limit)| Workload { group, plan, size, limit })
    };
    plans.flat_map(rows).collect()
}
