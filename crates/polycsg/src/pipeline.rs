//! The stages in a row.

use crate::csg::Csg;
use crate::{Boundary, Region, Scratch, nest, repair};

/// Edges, contacts, arrangement, memberships.
pub(crate) fn arrange(csg: &Csg<'_>, scratch: &mut Scratch) {
    let Scratch { truth, edges, strips, contacts, arrangement, labels, .. } = scratch;
    truth.compile(csg);
    edges.collect(csg, truth);
    strips.build(edges.ids().map(|e| (e, edges.segment(e))));
    let same = strips.unite(|e, f| edges.compare(e, f));
    edges.unite(&same);
    contacts.find(edges, strips, &same);
    arrangement.split(edges, contacts);
    labels.classify(edges, strips, contacts, arrangement, truth);
}

/// … and the pieces whose sides differ, rounded.
pub(crate) fn boundary<'s>(csg: &Csg<'_>, scratch: &'s mut Scratch) -> Boundary<'s> {
    arrange(csg, scratch);
    let Scratch { edges, contacts, arrangement, labels, selection, .. } = scratch;
    selection.select(edges, contacts, arrangement, labels);
    Boundary::new(selection, edges)
}

/// … repaired, linked to rings and nested.
///
/// Rounding may carry a tiny ring over an edge that it never touches. The nesting shows it; the rings, which do not
/// meet any more, are then read once more by their winding numbers. That run creates no vertex, so it rounds nothing.
pub(crate) fn region(csg: &Csg<'_>, scratch: &mut Scratch) -> Region {
    boundary(csg, scratch);
    let Scratch { edges, contacts, strips, selection, mending, outline, cycles, nesting, .. } = scratch;
    repair::mend(edges, contacts, selection, strips, mending, outline);
    cycles.link(outline);
    match nest::nest(outline, cycles, strips, nesting) {
        Ok(region) => region,
        Err(nest::Misnested) => {
            let rings = cycles.to_rings(outline);
            region(&Csg::positive(rings), scratch)
        }
    }
}
