//! What is seen in the half-plane at one azimuth.
use super::Sighted;
use glam::{DVec2, DVec3};

/// An interval of s = sin^2(theta).
type Interval = [f64; 2];

/// The measure in s of what is seen of the target at this azimuth.
pub(super) fn seen(azimuth: f64, target: &Sighted, occluders: &[Sighted]) -> f64 {
    let (sine, cosine) = azimuth.sin_cos();
    let across = DVec3::new(-sine, cosine, 0.0);
    // Away from the normal, and along it.
    let within = |p: DVec3| DVec2::new(p.x * cosine + p.y * sine, p.z);
    let whole = intervals(target, across, within);
    if whole.is_empty() {
        return 0.0;
    }
    let mut hidden: Vec<Interval> = Vec::new();
    for occluder in occluders {
        let nearer = nearer(within(occluder.nearness - target.nearness));
        let cut = |[low, high]: Interval| [low.max(nearer[0]), high.min(nearer[1])];
        hidden.extend(
            intervals(occluder, across, within).into_iter().map(cut).filter(|[low, high]| low < high),
        );
    }
    hidden.sort_by(|a, b| a[0].total_cmp(&b[0]));
    whole.into_iter().map(|interval| left(interval, &hidden)).sum()
}

/// Where a polygon meets the half-plane above the horizon.
fn intervals(polygon: &Sighted, across: DVec3, within: impl Fn(DVec3) -> DVec2) -> Vec<Interval> {
    let mut crossings: Vec<DVec2> = Vec::new();
    for (a, b) in polygon.edges() {
        let (from, to) = (across.dot(a), across.dot(b));
        if (from > 0.0) != (to > 0.0) {
            crossings.push(within(a + (b - a) * (from / (from - to))));
        }
    }
    let normal = within(polygon.nearness);
    let along = |p: &DVec2| normal.perp_dot(*p);
    crossings.sort_by(|a, b| along(a).total_cmp(&along(b)));
    crossings.chunks_exact(2).filter_map(|pair| visible(pair[0], pair[1])).collect()
}

/// The interval of a segment's part in the half-plane and above the horizon.
fn visible(a: DVec2, b: DVec2) -> Option<Interval> {
    let (a, b) = clip(a, b, |p| p.x)?;
    let (a, b) = clip(a, b, |p| p.y)?;
    let [a, b] = [a, b].map(|p| p.x * p.x / p.length_squared());
    Some([a.min(b), a.max(b)])
}

fn clip(a: DVec2, b: DVec2, height: impl Fn(DVec2) -> f64) -> Option<(DVec2, DVec2)> {
    let (from, to) = (height(a), height(b));
    let met = || a + (b - a) * (from / (from - to));
    match (from > 0.0, to > 0.0) {
        (true, true) => Some((a, b)),
        (true, false) => Some((a, met())),
        (false, true) => Some((met(), b)),
        (false, false) => None,
    }
}

/// Where a . (sin theta, cos theta) > 0.
fn nearer(a: DVec2) -> Interval {
    let turn = a.y * a.y / a.length_squared();
    match (a.x > 0.0, a.y > 0.0) {
        (true, true) => [0.0, 1.0],
        (true, false) => [turn, 1.0],
        (false, true) => [0.0, turn],
        (false, false) => [1.0, 0.0],
    }
}

/// What sorted intervals leave of one.
fn left([low, high]: Interval, hidden: &[Interval]) -> f64 {
    let (mut seen, mut at) = (0.0, low);
    for [start, end] in hidden {
        seen += (start.min(high) - at).max(0.0);
        at = at.max(*end);
    }
    seen + (high - at).max(0.0)
}
