//! The state of a group as bytes: feature after feature, each the count of its rings, the counts of their points, and the points.
//!
//! Numbers are little-endian, of 32 bits for counts and 64 for coordinates. A feature of no rings is an empty one; a state of no
//! features is that of a group in which all is NULL. To merge states is to put one behind the other.
//!
//! The highest bit of a feature's first number marks one ring of an outline: the boundary of features on top of one another, without the
//! edges that cancelled. What all such rings of a state wind around is the union of these features. The other bits count the
//! features that ended in it, at the first of its rings; 0 stands at the others. The ring runs as it must.
//!
//! A ring starts at its lowest point from the left and runs towards the lower one of its neighbours, and rings are sorted: features
//! that differ in where a ring starts, in its direction or in the order of rings have the same bytes.
use crate::error::Error;
use polycsg::DVec2;
use std::cmp::Ordering;

const COUNT: usize = 4;
const POINT: usize = 16;
const OUTLINE: u32 = 1 << 31;

/// Adds a feature of finite points.
pub(crate) fn append<'r>(state: &mut Vec<u8>, rings: impl Iterator<Item = &'r [DVec2]>) {
    let mut rings: Vec<Vec<DVec2>> = rings.filter(|ring| !ring.is_empty()).map(canonical).collect();
    rings.sort_by(|a, b| by_points(a, b));
    state.extend(count(rings.len()));
    rings.iter().for_each(|ring| state.extend(count(ring.len())));
    append_points(state, rings.iter().flatten());
}

/// Adds the rings of an outline of so many features.
pub(crate) fn append_outlines(state: &mut Vec<u8>, members: u32, rings: &[Vec<DVec2>]) {
    let members = std::iter::once(members.min(OUTLINE - 1)).chain(std::iter::repeat(0));
    for (ring, members) in rings.iter().zip(members) {
        state.extend((OUTLINE | members).to_le_bytes());
        state.extend(count(ring.len()));
        append_points(state, ring.iter());
    }
}

fn append_points<'p>(state: &mut Vec<u8>, points: impl Iterator<Item = &'p DVec2>) {
    for point in points {
        state.extend(point.x.to_le_bytes());
        state.extend(point.y.to_le_bytes());
    }
}

/// How many features ended in a ring of an outline; none, if it is a feature.
pub(crate) fn members(feature: &[u8]) -> Result<Option<u32>, Error> {
    let (words, _) = feature.as_chunks::<COUNT>();
    let first = u32::from_le_bytes(*words.first().ok_or(SHORT)?);
    Ok((first & OUTLINE != 0).then_some(first & !OUTLINE))
}

/// Which of two points is further left, or lower if none is.
pub(crate) fn by_point(a: &DVec2, b: &DVec2) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

fn by_points(a: &[DVec2], b: &[DVec2]) -> Ordering {
    let different = a.iter().zip(b).map(|(a, b)| by_point(a, b)).find(|order| order.is_ne());
    different.unwrap_or(a.len().cmp(&b.len()))
}

fn canonical(ring: &[DVec2]) -> Vec<DVec2> {
    let mut ring: Vec<DVec2> = ring.iter().map(|point| point + DVec2::ZERO).collect(); // no -0.0
    let first = (0..ring.len()).min_by(|&i, &j| by_point(&ring[i], &ring[j])).unwrap_or_default();
    ring.rotate_left(first);
    if let [_, second, .., last] = ring[..]
        && by_point(&second, &last).is_gt()
    {
        ring[1..].reverse();
    }
    ring
}

/// More than 2^32 - 1 points take 64 GiB, which no value of a column can have.
fn count(count: usize) -> [u8; COUNT] {
    u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes()
}

/// The features of a state, each as its bytes.
pub(crate) fn split(mut state: &[u8]) -> Result<Vec<&[u8]>, Error> {
    let mut features = Vec::new();
    while !state.is_empty() {
        let (feature, rest) = state.split_at_checked(length(state)?).ok_or(SHORT)?;
        features.push(feature);
        state = rest;
    }
    Ok(features)
}

/// The features of a state, each once, and the rings of its outlines, from left to right by the first points of their first rings, which are their lowest from the left.
pub(crate) fn sorted(state: &[u8]) -> Result<Vec<&[u8]>, Error> {
    let mut features: Vec<(u64, &[u8])> = split(state)?
        .into_iter()
        .map(|feature| Ok((rank(feature)?, feature)))
        .collect::<Result<_, Error>>()?;
    features.sort_unstable();
    features.dedup_by(|a, b| a == b && !is_outline(a.1));
    Ok(features.into_iter().map(|(_, feature)| feature).collect())
}

/// Whether it is a ring of an outline.
pub(crate) fn is_outline(feature: &[u8]) -> bool {
    members(feature).is_ok_and(|members| members.is_some())
}

/// Where the first x of a feature stands among all numbers.
fn rank(feature: &[u8]) -> Result<u64, Error> {
    let (points, _) = feature[COUNT * (counts(feature)?.len() + 1)..].as_chunks::<POINT>();
    let bits = points.first().map_or(0, |first| point(first).x.to_bits());
    Ok(if bits >> 63 == 0 { bits | 1 << 63 } else { !bits })
}

const SHORT: Error = Error::State("it ends within a geometry");

/// How many bytes the first feature takes.
fn length(state: &[u8]) -> Result<usize, Error> {
    let rings = counts(state)?;
    let points = rings.iter().try_fold(0_usize, |sum, ring| sum.checked_add(number(ring))).ok_or(SHORT)?;
    points.checked_mul(POINT).and_then(|bytes| bytes.checked_add(COUNT * (rings.len() + 1))).ok_or(SHORT)
}

/// How many points each ring of the first feature has.
fn counts(state: &[u8]) -> Result<&[[u8; COUNT]], Error> {
    let (words, _) = state.as_chunks::<COUNT>();
    let (first, rest) = words.split_first().ok_or(SHORT)?;
    let rings = if is_outline(state) { 1 } else { number(first) };
    rest.get(..rings).ok_or(SHORT)
}

fn number(word: &[u8; COUNT]) -> usize {
    u32::from_le_bytes(*word) as usize
}

/// The rings of a feature that [`split`] found.
pub(crate) fn rings(feature: &[u8]) -> Result<Vec<Vec<DVec2>>, Error> {
    let counts = counts(feature)?;
    let (points, _) = feature[COUNT * (counts.len() + 1)..].as_chunks::<POINT>();
    let mut points = points.iter().map(point);
    Ok(counts.iter().map(|count| points.by_ref().take(number(count)).collect()).collect())
}

fn point(bytes: &[u8; POINT]) -> DVec2 {
    let [x, y] = [0, 8].map(|at| {
        let mut coordinate = [0; 8];
        coordinate.copy_from_slice(&bytes[at..at + 8]);
        f64::from_le_bytes(coordinate)
    });
    DVec2::new(x, y)
}

/// The box around a feature's points, which must be finite: its low corner is not below its high one, if there are none.
pub(crate) fn bounds(feature: &[u8]) -> Result<[DVec2; 2], Error> {
    let nowhere = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (points, _) = feature[COUNT * (counts(feature)?.len() + 1)..].as_chunks::<POINT>();
    let (mut low, mut high) = nowhere;
    for point in points.iter().map(point) {
        if !point.is_finite() {
            return Err(Error::State("a coordinate is not finite"));
        }
        (low, high) = (low.min(point), high.max(point));
    }
    Ok([low, high])
}
