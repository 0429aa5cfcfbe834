//! Single points whose form factors are known to 34 digits, by kind: `cases.json`, 31 occluded and extreme cases.
//!
//! The references come from exact rational arithmetic (slabs on the target's plane) and Lambert's formula with 50 digits;
//! a polar sweep without projection agrees to 3.3e-16.
use super::query::{Query, QuerySet};
use crate::rows::Chapter;
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
use serde::Deserialize;

/// One case, as the file has it.
#[derive(Deserialize)]
struct Case {
    kind: String,
    point: DVec3,
    normal: DVec3,
    target: Vec<Vec<DVec3>>,
    occluders: Vec<Vec<Vec<DVec3>>>,
    form_factor: f64,
}

/// The kinds, each a set of queries.
pub(crate) fn query_sets() -> Vec<QuerySet> {
    let cases: Vec<Case> =
        serde_json::from_str(include_str!("cases.json")).expect("the committed cases can be read");
    let mut kinds: Vec<QuerySet> = Vec::new();
    for case in &cases {
        if kinds.last().is_none_or(|set| set.subject != case.kind) {
            kinds.push(empty(&case.kind));
        }
        let set = kinds.last_mut().expect("one was just put there");
        set.add(case);
    }
    kinds
}

fn empty(kind: &str) -> QuerySet {
    QuerySet {
        chapter: Chapter::Points,
        subject: kind.to_owned(),
        enclosures: Vec::new(),
        queries: Vec::new(),
        relative: false,
        independent: true,
    }
}

impl QuerySet {
    /// Adds a case with an enclosure of its own, whose first polygon is the target.
    fn add(&mut self, case: &Case) {
        let polygon = |loops: &Vec<Vec<DVec3>>| PlanarPolygon::new(loops).expect("the cases are planar");
        let enclosure =
            Enclosure::new(std::iter::once(&case.target).chain(&case.occluders).map(polygon).collect());
        let from = DifferentialArea::new(case.point, case.normal).expect("the cases have normals");
        let bound = enclosure.form_factor(&from, 0).error_bound;
        let exact = case.form_factor;
        self.queries.push(Query { enclosure: self.enclosures.len(), from, targets: vec![0], exact, bound });
        self.enclosures.push(enclosure);
    }
}
