//! The stages in a row.

#[cfg(test)]
mod tests;

use crate::csg::Csg;
use crate::labels::Map;
use crate::repair::{self, Rounded};
use crate::{Boundary, Error, Region, Scratch, nest};

/// Edges, chains, contacts, arrangement, memberships. All stages behind the contacts take memory in proportion to them.
///
/// # Errors
/// [`Error::TooManyContacts`] by the limit in `scratch`, here and below.
pub(crate) fn arrange(csg: &Csg<'_>, scratch: &mut Scratch) -> Result<(), Error> {
    let Scratch {
        truth,
        edges,
        cancel,
        chains,
        copies,
        strips,
        slabs,
        patience,
        suspects,
        contacts,
        arrangement,
        labels,
        ..
    } = scratch;
    truth.compile(csg);
    edges.collect(csg, truth);
    cancel.cancel(edges);
    chains.build(edges.points(), edges.spans());
    let copies = copies.find(edges, chains);
    if !copies.is_empty() {
        edges.unite(copies);
        chains.build(edges.points(), edges.spans());
    }
    strips.build(chains.boxes());
    contacts.find(edges, chains, strips, slabs, suspects, *patience)?;
    arrangement.split(edges, contacts);
    labels.classify(Map { edges, chains, strips, contacts, arrangement }, slabs, truth);
    Ok(())
}

/// … and the pieces whose sides differ, rounded.
pub(crate) fn boundary<'s>(csg: &Csg<'_>, scratch: &'s mut Scratch) -> Result<Boundary<'s>, Error> {
    arrange(csg, scratch)?;
    let Scratch { edges, contacts, arrangement, labels, selection, .. } = scratch;
    selection.select(edges, contacts, arrangement, labels);
    Ok(Boundary::new(selection, edges, contacts))
}

/// … repaired where rounding broke something, linked to rings and nested.
///
/// Rounding may carry a tiny ring over an edge that it never touches. The nesting shows it; the rings, which do not
/// meet any more, are then read once more by their winding numbers. That run creates no vertex, so it rounds nothing.
pub(crate) fn region(csg: &Csg<'_>, scratch: &mut Scratch) -> Result<Region, Error> {
    boundary(csg, scratch)?;
    let Scratch {
        edges,
        contacts,
        chains,
        strips,
        slabs,
        suspects,
        selection,
        mending,
        outline,
        cycles,
        nesting,
        ..
    } = scratch;

    let rounded = Rounded { edges, contacts, selection };
    if repair::is_sound(rounded, suspects, slabs, mending) {
        outline.take(edges, contacts, selection);
    } else {
        repair::mend(rounded, slabs, mending, outline);
    }
    cycles.link(outline);
    match nest::nest(outline, cycles, chains, strips, slabs, nesting) {
        Ok(region) => Ok(region),
        Err(nest::Misnested) => {
            let rings = cycles.rings().clone();
            region(&Csg::positive(rings), scratch)
        }
    }
}
