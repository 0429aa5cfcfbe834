//! Findings by kind: how many, and whether they matter.
use crate::scene::finding::{Finding, Kind};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// The findings of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct KindSummary {
    /// The kind.
    pub kind: Kind,
    /// How many there are.
    pub count: usize,
    /// Whether they change the light.
    pub matters: bool,
    /// What they do to a solution.
    pub effect: &'static str,
    /// What reading does about them, as [`Kind::remedy`] says.
    pub remedy: Option<&'static str>,
}

impl KindSummary {
    /// How many of which kind: `93 T-junctions`.
    #[must_use]
    pub fn counted(&self) -> String {
        let [one, many] = self.kind.nouns();
        let noun = if self.count == 1 { one } else { many };
        format!("{} {noun}", self.count)
    }
}

impl fmt::Display for KindSummary {
    /// `93 T-junctions: form factors do not mind`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.counted(), self.effect)
    }
}

/// One entry a kind, those first that trouble a solution most.
#[must_use]
pub fn summary(findings: &[Finding]) -> Vec<KindSummary> {
    let mut counts: BTreeMap<Kind, usize> = BTreeMap::new();
    for finding in findings {
        *counts.entry(finding.kind).or_default() += 1;
    }
    let entry = |(kind, count): (Kind, usize)| KindSummary {
        kind,
        count,
        matters: kind.matters(),
        effect: kind.effect(),
        remedy: kind.remedy(),
    };
    counts.into_iter().map(entry).collect()
}
