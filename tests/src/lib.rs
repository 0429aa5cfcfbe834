//! Corpora, generators and independent oracles shared by the test suites.
//!
//! Nothing here uses `polycsg`'s code: [`oracle`] is the plain algorithm over exact integers and rationals,
//! [`validity`] checks a result's topology exactly, [`generators`] make the inputs, [`corpus`] reads the named
//! cases of `tests/corpus`, [`company`] sends them down every path. [`against`] sets a result of `polycsg` beside the oracle's, [`shrink`] makes a failing case small, [`survey`] counts how a kind of
//! input fares, [`trees`] makes expressions, [`near`] views that ask for digits, [`retelling`] tells expressions in other words,
//! [`triangles`] checks triangulations. [`sweep`] is the oracle for form factors, [`precise`] the same with 90 digits for few
//! polygons, and [`obstructed`] that for factors from area to area: they use nothing of `formfactor`. [`light`] traces paths in rooms and uses nothing of
//! `radiosity`.
pub mod against;
pub mod closed;
pub mod company;
pub mod corpus;
pub mod enclosures;
pub mod exact;
pub mod generators;
pub mod light;
pub mod near;
pub mod obstructed;
pub mod oracle;
pub mod precise;
pub mod random;
pub mod retelling;
pub mod shrink;
pub mod survey;
pub mod sweep;
pub mod trees;
pub mod triangles;
pub mod validity;

use glam::DVec2;

/// A closed chain of points, the first not repeated.
pub type Ring = Vec<DVec2>;
