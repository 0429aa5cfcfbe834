//! The stages in a row.

#[cfg(test)]
mod tests;

use crate::csg::Csg;
use crate::labels::Map;
use crate::repair::{self, Rounded};
use crate::survey::{Boxes, Survey};
use crate::{Boundary, Error, Region, Scratch, nest};

/// The expression's truth, and the edges that matter.
fn collect(csg: &Csg<'_>, scratch: &mut Scratch) {
    let Scratch { truth, window, edges, .. } = scratch;
    truth.compile(csg);
    window.find(csg, truth);
    edges.collect(csg, truth, window);
}

/// Their chains, contacts, arrangement, memberships, and if wanted which of them rounding may make meet. All stages
/// behind the contacts take memory in proportion to these.
///
/// # Errors
/// [`Error::TooManyContacts`] by the limit in `scratch`, here and below.
fn label(scratch: &mut Scratch, suspect: bool) -> Result<(), Error> {
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
    cancel.cancel(edges);
    chains.build(edges.points(), edges.spans());
    let copies = copies.find(edges, chains);
    if !copies.is_empty() {
        edges.unite(copies);
        chains.build(edges.points(), edges.spans());
    }
    strips.build(chains.boxes());
    let survey = Survey::of(Boxes { edges, chains, strips });
    if survey.asks_for_boxes(*patience) && survey.asks_for_single_edges() {
        chains.cut_to_edges(edges.points(), edges.spans());
        strips.build(chains.boxes());
    }
    suspects.want(suspect);
    contacts.find(Boxes { edges, chains, strips }, slabs, suspects, survey, *patience)?;
    arrangement.split(edges, contacts);
    labels.classify(Map { edges, chains, strips, contacts, arrangement }, slabs, truth);
    Ok(())
}

/// The pieces whose sides differ, rounded.
fn select(scratch: &mut Scratch) {
    let Scratch { edges, contacts, arrangement, labels, selection, .. } = scratch;
    selection.select(edges, contacts, arrangement, labels);
}

/// All edges with their memberships.
pub(crate) fn arrange(csg: &Csg<'_>, scratch: &mut Scratch) -> Result<(), Error> {
    collect(csg, scratch);
    label(scratch, false)
}

/// … and of these the boundary.
pub(crate) fn boundary<'s>(csg: &Csg<'_>, scratch: &'s mut Scratch) -> Result<Boundary<'s>, Error> {
    arrange(csg, scratch)?;
    select(scratch);
    Ok(Boundary::new(&scratch.selection, &scratch.edges, &scratch.contacts))
}

/// … repaired where rounding broke something, linked to rings and nested.
///
/// Rounding may carry a tiny ring over an edge that it never touches. The nesting shows it; the rings, which do not
/// meet any more, are then read once more by their winding numbers. That run creates no vertex, so it rounds nothing.
pub(crate) fn region(csg: &Csg<'_>, scratch: &mut Scratch) -> Result<Region, Error> {
    scratch.mending.mended = 0;
    collect(csg, scratch);
    if let Some(region) = untouched(csg, scratch) {
        return Ok(region);
    }
    label(scratch, true)?;
    select(scratch);
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
        repair::mend(rounded, suspects, slabs, mending, outline);
    }
    cycles.link(outline);
    match nest::nest(outline, cycles, chains, strips, slabs, nesting) {
        Ok(region) => Ok(region),
        Err(nest::Misnested) => {
            let (rings, mended) = (cycles.rings().clone(), mending.mended);
            let region = region(&Csg::positive(rings), scratch);
            scratch.mending.mended += mended;
            region
        }
    }
}

/// The set, where by the boxes one region alone matters: all of it, or nothing.
fn untouched(csg: &Csg<'_>, Scratch { truth, edges, .. }: &Scratch) -> Option<Region> {
    let operand = edges.only_operand()? as usize;
    let region = csg.postfix().iter().filter(|token| token.rings().is_some()).nth(operand)?.region()?;
    let counter = truth.counter(operand)?;
    Some(if truth.would_hold(counter, 1) { region.clone() } else { Region::default() })
}
