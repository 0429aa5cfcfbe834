//! The stages in a row.
//!
//! [`region`] is the whole way from an expression to its region. [`boundary`] and [`memberships`] leave it earlier.

#[cfg(test)]
mod asks;
pub(crate) mod scratch;
#[cfg(test)]
mod tests;

use crate::arrangement::{labels::LabelledArrangement, labels::map::Map};
use crate::assemble::nest::{Unnested, nest};
use crate::base::meter::{Meter, Refusal};
use crate::boundary::{Boundary, repair::Index, repair::fragments::Rounded};
use crate::contacts::{Request, candidates::Candidates};
use crate::edges::Edges;
use crate::expression::csg::{Csg, Token};
use crate::expression::winding::WindingNumbers;
use crate::region::Region;
use scratch::{ArrangementBuffers, ContactBuffers, EdgeBuffers, ExpressionBuffers, Scratch, SpatialBuffers};

/// The expression as a region.
///
/// Rounding may carry a tiny ring over an edge that it never touches. The nesting shows it; the rings, which meet in their vertices
/// only, are then read by their winding numbers. That creates no vertex, so it rounds nothing.
///
/// # Errors
/// Those of the limits that the meter has.
pub(crate) fn region(csg: &Csg<'_>, scratch: &mut Scratch, meter: &Meter<'_>) -> Result<Region, Refusal> {
    let Scratch { expression, edges, spatial, contacts, arrangement, boundary, assembly, budget } = scratch;
    boundary.repair.start();
    let winding = collect(csg, expression, edges, meter)?;
    if let Some(region) = untouched(csg, winding, &edges.edges) {
        return Ok(region);
    }
    let request = Request { meter, rings: true, budget: *budget };
    let arranged = arrange(csg, edges, winding, spatial, contacts, arrangement, request)?;
    let selection = boundary.selection.select(arranged, meter)?;
    let rounded = Rounded { edges: arranged.edges, contacts: arranged.contacts, selection };
    let index = Index { strips: &mut spatial.strips, slabs: &mut spatial.slabs, budget: *budget, meter };
    let outline = &mut boundary.outline;
    boundary.repair.outline(rounded, arranged.close_pairs, index, outline)?;
    let SpatialBuffers { chains, strips, slabs } = spatial;
    loop {
        let cycles = assembly.cycles.link(outline, meter)?;
        match nest(outline, cycles, chains, strips, slabs, &mut assembly.nesting, meter) {
            Ok(region) => return Ok(region),
            Err(Unnested::Refused(error)) => return Err(error),
            Err(Unnested::Misnested) => {
                assembly.positive.reduce(outline, cycles.rings(), (chains, strips, slabs), meter)?;
            }
        }
    }
}

/// The pieces of edges whose two sides differ, rounded: not checked, and without rings.
///
/// # Errors
/// Those of the limits that the meter has.
pub(crate) fn boundary<'s>(
    csg: &Csg<'_>,
    scratch: &'s mut Scratch,
    meter: &Meter<'_>,
) -> Result<Boundary<'s>, Refusal> {
    let Scratch { expression, edges, spatial, contacts, arrangement, boundary, budget, .. } = scratch;
    let winding = collect(csg, expression, edges, meter)?;
    let request = Request { meter, rings: false, budget: *budget };
    let arranged = arrange(csg, edges, winding, spatial, contacts, arrangement, request)?;
    let selection = boundary.selection.select(arranged, meter)?;
    Ok(Boundary::new(selection, arranged.edges, arranged.contacts))
}

/// All edges with the membership of each of their sub-edges.
pub(crate) fn memberships<'s>(
    csg: &Csg<'_>,
    scratch: &'s mut Scratch,
) -> Result<LabelledArrangement<'s>, Refusal> {
    let Scratch { expression, edges, spatial, contacts, arrangement, budget, .. } = scratch;
    let meter = Meter::default();
    let winding = collect(csg, expression, edges, &meter)?;
    let request = Request { meter: &meter, rings: false, budget: *budget };
    arrange(csg, edges, winding, spatial, contacts, arrangement, request)
}

/// Stage 1: the state of a walk, outside of everything, and the edges that matter.
fn collect<'s>(
    csg: &Csg<'_>,
    ExpressionBuffers { winding, bounds }: &'s mut ExpressionBuffers,
    EdgeBuffers { edges, keys, .. }: &mut EdgeBuffers,
    meter: &Meter<'_>,
) -> Result<&'s mut WindingNumbers, Refusal> {
    winding.compile(csg, meter)?;
    bounds.find(csg);
    edges.collect(csg, winding, bounds, keys, meter)?;
    Ok(winding)
}

/// The end of stage 1, which edges stand for all, and stages 2 to 5: where edges meet, how this cuts them into sub-edges, and the membership of each.
///
/// All stages behind the contacts take memory in proportion to these.
fn arrange<'s>(
    csg: &Csg<'_>,
    EdgeBuffers { edges, coincident, .. }: &'s mut EdgeBuffers,
    winding: &mut WindingNumbers,
    SpatialBuffers { chains, strips, slabs }: &mut SpatialBuffers,
    ContactBuffers { contacts, close_pairs }: &'s mut ContactBuffers,
    ArrangementBuffers { arrangement, labels }: &'s mut ArrangementBuffers,
    request: Request<'_>,
) -> Result<LabelledArrangement<'s>, Refusal> {
    let meter = request.meter;
    coincident.unite(edges, csg, winding, strips, request.rings, meter)?;
    let candidates = Candidates::index(edges, coincident, chains, strips, request)?;
    contacts.find(candidates, slabs, close_pairs, request)?;
    let (edges, chains, strips) = (&*edges, &*chains, &*strips);
    arrangement.split(edges, contacts, meter)?;
    labels.classify(Map { edges, chains, strips, contacts, arrangement }, slabs, winding, meter)?;
    Ok(LabelledArrangement { edges, contacts, close_pairs, arrangement, labels })
}

/// The set, where by the boxes one region alone matters: all of it, or nothing.
fn untouched(csg: &Csg<'_>, winding: &WindingNumbers, edges: &Edges) -> Option<Region> {
    let operand = edges.only_operand()? as usize;
    let leaf = csg.postfix().filter(|token| token.rings().is_some()).nth(operand)?;
    let Token::Region(region) = leaf else { return None };
    let counter = winding.counter(operand)?;
    Some(if winding.would_hold(counter, 1) { (*region).clone() } else { Region::default() })
}
