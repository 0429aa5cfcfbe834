//! Sorts contacts along their edges, and finds those that lie in one place.
//!
//! The bounds of the parameters tell the order of most. Of contacts whose bounds overlap, a few are compared exactly. Many, as where
//! hundreds of edges pass through nearly one point, are sorted by parameters with more bits first, which takes time for each of
//! them and not for each comparison:
//!
//! ```text
//!   parameters        |--|    |---|
//!                               |-----|   |-|        one alone, three that overlap
//!                                   |--------|
//!   with more bits            |    || |              one alone, two to be compared exactly, one alone
//! ```

use super::contact::{Contact, PartnerKind};
use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::edges::Edges;
use crate::predicates::{FineParameter, crossing_order, lexicographic, point_crossing_order};
use std::cmp::Ordering;

/// More contacts are counted as work here, and fewer by who has them sorted.
const LONG: usize = 256;

/// So many contacts are quicker compared exactly than by more bits.
const FEW: usize = 2;

/// Sorts contacts by edge and along it, and marks those that lie in the place of the one before.
///
/// # Errors
/// Those of the meter's limits. What is sorted is not counted, unless it is much.
pub(super) fn sort_along(edges: &Edges, contacts: &mut [Contact], meter: &Meter<'_>) -> Result<(), Refusal> {
    if contacts.len() > LONG {
        meter.spend(contacts.len())?;
    }
    let low = |contact: &Contact| contact.at().low();
    let by_place = |a: &Contact, b: &Contact| a.edge.cmp(&b.edge).then_with(|| low(a).total_cmp(&low(b)));
    sort(contacts, by_place, meter)?;
    let bounds = |contact: &Contact| [contact.at().low(), contact.at().high()].map(|at| (contact.edge, at));
    overlapping(contacts, bounds, |run| match run.len() {
        1 => Ok(()),
        2..=FEW => sort_exactly(edges, run, meter),
        _ => sort_finely(edges, run, meter),
    })
}

/// Calls `visit` for each maximal run of intervals that overlap, until one fails; they are sorted by their lower bounds.
fn overlapping<T, B: PartialOrd>(
    mut sorted: &mut [T],
    bounds: impl Fn(&T) -> [B; 2],
    mut visit: impl FnMut(&mut [T]) -> Result<(), Refusal>,
) -> Result<(), Refusal> {
    while let Some(first) = sorted.first() {
        let ([_, mut reach], mut count) = (bounds(first), 1);
        for [low, high] in sorted[1..].iter().map(&bounds) {
            if low > reach {
                break;
            }
            reach = if high > reach { high } else { reach };
            count += 1;
        }
        let (run, rest) = sorted.split_at_mut(count);
        visit(run)?;
        sorted = rest;
    }
    Ok(())
}

fn sort_exactly(edges: &Edges, run: &mut [Contact], meter: &Meter<'_>) -> Result<(), Refusal> {
    sort(run, |a, b| order(edges, a, b), meter)?;
    for i in 1..run.len() {
        if order(edges, &run[i - 1], &run[i]) == Ordering::Equal {
            run[i].set_with_previous();
        }
    }
    Ok(())
}

#[cold]
fn sort_finely(edges: &Edges, run: &mut [Contact], meter: &Meter<'_>) -> Result<(), Refusal> {
    meter.spend(run.len())?;
    let mut fine = Vec::new();
    let parameters = run.iter().enumerate().map(|(i, contact)| (parameter(edges, contact), i));
    meter.extend(&mut fine, parameters)?;
    sort(&mut fine, |(a, _), (b, _)| a.low.cmp(&b.low), meter)?;
    let before = run.to_vec();
    let mut rest = run;
    overlapping(
        &mut fine,
        |(at, _)| [at.low, at.high],
        |places| {
            let (together, others) = std::mem::take(&mut rest).split_at_mut(places.len());
            together.iter_mut().zip(places).for_each(|(contact, place)| *contact = before[place.1]);
            rest = others;
            sort_exactly(edges, together, meter)
        },
    )
}

fn parameter(edges: &Edges, contact: &Contact) -> FineParameter {
    let e = edges.segment(contact.edge);
    match contact.partner.kind() {
        PartnerKind::FromLeft(f) | PartnerKind::FromRight(f) => {
            FineParameter::of_crossing(e, edges.segment(f))
        }
        PartnerKind::Vertex(v) => FineParameter::of_point(e, edges.point(v)),
        PartnerKind::Start | PartnerKind::First | PartnerKind::End => FineParameter::START,
    }
}

/// The exact order of two contacts along their edge.
#[cold]
fn order(edges: &Edges, a: &Contact, b: &Contact) -> Ordering {
    let e = edges.segment(a.edge);
    match (a.partner.kind(), b.partner.kind()) {
        (PartnerKind::Vertex(v), PartnerKind::Vertex(w)) => {
            let order = lexicographic(edges.point(v), edges.point(w));
            if lexicographic(e[0], e[1]) == Ordering::Less { order } else { order.reverse() }
        }
        (PartnerKind::Vertex(v), PartnerKind::FromLeft(g) | PartnerKind::FromRight(g)) => {
            point_crossing_order(e, edges.point(v), edges.segment(g))
        }
        (PartnerKind::FromLeft(g) | PartnerKind::FromRight(g), PartnerKind::Vertex(v)) => {
            point_crossing_order(e, edges.point(v), edges.segment(g)).reverse()
        }
        (
            PartnerKind::FromLeft(f) | PartnerKind::FromRight(f),
            PartnerKind::FromLeft(g) | PartnerKind::FromRight(g),
        ) => crossing_order(e, edges.segment(f), edges.segment(g)),
        _ => b.partner.is_end().cmp(&a.partner.is_end()),
    }
}
