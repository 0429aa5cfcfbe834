//! Which inputs are run, in which sizes, and what ratio each row asks for.

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Workload {
    /// The kind of input.
    pub(crate) family: &'static str,
    /// Its size.
    pub(crate) size: usize,
    /// Whether polycsg stops at the boundary.
    pub(crate) boundary: bool,
    /// The ratio to the fastest rival that is aimed at.
    pub(crate) limit: Option<f64>,
    /// The peers that the ratio is taken to; all when empty.
    pub(crate) rivals: &'static [&'static str],
}

impl Workload {
    /// Kind and size.
    pub(crate) fn name(&self) -> String {
        match self.family {
            "square-triangle" => self.family.to_owned(),
            "land" | "countries" | "counties" => format!("{}-{}m", self.family, self.size),
            family => format!("{family}-{}", self.size),
        }
    }
}

/// i_overlay and what is built on it.
const GRID_SWEEPS: &[&str] = &["i_overlay-i32", "i_overlay-i64", "geo"];

/// A kind of input with its sizes: always, and in a full run alone.
struct Plan {
    family: &'static str,
    limit: f64,
    rivals: &'static [&'static str],
    quick: &'static [usize],
    full: &'static [usize],
}

const GENERATED: &[Plan] = &[
    Plan { family: "square-triangle", limit: 0.5, rivals: &[], quick: &[0], full: &[] },
    Plan { family: "square-rectangles", limit: 0.5, rivals: &[], quick: &[10, 100, 1_000], full: &[10_000] },
    Plan { family: "octagons", limit: 0.4, rivals: &[], quick: &[1_000, 10_000], full: &[100_000, 125_000] },
    Plan { family: "stars", limit: 0.5, rivals: &[], quick: &[1_000, 10_000], full: &[100_000, 500_000] },
    Plan { family: "blobs", limit: 0.7, rivals: GRID_SWEEPS, quick: &[10_000, 100_000], full: &[500_000] },
    Plan { family: "grid", limit: 1.0, rivals: &[], quick: &[100], full: &[300, 500] },
    Plan { family: "checkers-shifted", limit: 1.0, rivals: &[], quick: &[100], full: &[300] },
    Plan { family: "checkers-complement", limit: 1.0, rivals: &[], quick: &[100], full: &[300, 500] },
    Plan { family: "annuli", limit: 0.5, rivals: &[], quick: &[100, 1_000], full: &[10_000] },
    Plan { family: "holes", limit: 0.5, rivals: &[], quick: &[1_000, 10_000], full: &[100_000] },
    Plan {
        family: "combs",
        limit: f64::NAN,
        rivals: &[],
        quick: &[4_000, 16_000],
        full: &[100_000, 400_000],
    },
];

const MAPS: &[Plan] = &[
    Plan { family: "land", limit: 0.7, rivals: GRID_SWEEPS, quick: &[50], full: &[10] },
    Plan { family: "countries", limit: 0.7, rivals: GRID_SWEEPS, quick: &[50], full: &[10] },
    Plan { family: "counties", limit: 0.7, rivals: GRID_SWEEPS, quick: &[10], full: &[] },
];

/// The rows, smaller inputs of a kind before larger ones.
pub(crate) fn workloads(quick: bool, maps: bool) -> Vec<Workload> {
    let plans = GENERATED.iter().chain(if maps { MAPS } else { &[] });
    plans.flat_map(|plan| rows(plan, quick)).collect()
}

fn rows(plan: &Plan, quick: bool) -> Vec<Workload> {
    let sizes = plan.quick.iter().chain(if quick { &[] } else { plan.full });
    let row = |size, boundary, limit| Workload {
        family: plan.family,
        size,
        boundary,
        limit: Some(limit).filter(|limit: &f64| limit.is_finite()),
        rivals: plan.rivals,
    };
    let both = |&size: &usize| {
        let boundary = (plan.family == "square-rectangles").then(|| row(size, true, 0.3));
        boundary.into_iter().chain([row(size, false, plan.limit)])
    };
    sizes.flat_map(both).collect()
}
