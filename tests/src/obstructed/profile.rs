//! How much of a strip sees along one direction: a function of one variable, piecewise linear.
//!
//! Along one axis a ray from `s` to `s + u` is at `s + share u` after that share of its way. It passes between two bounds
//! there when `low - share u <= s <= high - share u`. For a given u the s that pass all bounds are an interval, whose length
//! is a concave function of u made of straight pieces: w(u). All that is needed of it are the places where its slope changes,
//! since an integral of w g is a sum of second antiderivatives of g at these.

/// A ray passes when it is between `low` and `high` after this share of its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate {
    pub(super) share: f64,
    pub(super) low: f64,
    pub(super) high: f64,
}

/// A place u and by how much the slope of w changes there.
pub(super) type Bend = (f64, f64);

/// The bends of w(u), the length of the s that pass all gates; none where nothing passes.
pub(super) fn bends(gates: &[Gate], into: &mut Vec<Bend>) {
    into.clear();
    let crossings = crossings(gates);
    let mut before = 0.0;
    for (i, &u) in crossings.iter().enumerate() {
        let next = crossings.get(i + 1).map_or(0.0, |next| slope(gates, f64::midpoint(u, *next)));
        if next != before {
            into.push((u, next - before));
        }
        before = next;
    }
}

/// Where two bounds cross, in order: w bends nowhere else.
fn crossings(gates: &[Gate]) -> Vec<f64> {
    let bounds = || gates.iter().flat_map(|g| [(g.share, g.low), (g.share, g.high)]);
    let bounds: Vec<(f64, f64)> = bounds().filter(|b| b.1.is_finite()).collect();
    let mut found = Vec::with_capacity(bounds.len() * bounds.len() / 2);
    for (i, (share, bound)) in bounds.iter().enumerate() {
        let others = bounds[..i].iter().filter(|(other, _)| other != share);
        found.extend(others.map(|(other, limit)| (bound - limit) / (share - other)));
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// The slope of w at u, which is no bend.
fn slope(gates: &[Gate], u: f64) -> f64 {
    let (mut low, mut high) = ((f64::NEG_INFINITY, 0.0), (f64::INFINITY, 0.0));
    for gate in gates {
        let (from, to) = (gate.low - gate.share * u, gate.high - gate.share * u);
        low = if from > low.0 { (from, gate.share) } else { low };
        high = if to < high.0 { (to, gate.share) } else { high };
    }
    if high.0 > low.0 { low.1 - high.1 } else { 0.0 }
}
