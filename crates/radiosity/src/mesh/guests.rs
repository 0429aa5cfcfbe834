//! Corners of the tiles of all patches, to be found on the edges of each: where a neighbour has a vertex, so has the patch. Pictures
//! then have no cracks, and light is interpolated alike on both sides.
use glam::DVec3;

/// What is nearer to an edge than this share of its length is on it.
const NEAR: f64 = 1e-9;

/// Places, sorted along each axis.
#[derive(Debug)]
pub(crate) struct Guests {
    sorted: [Vec<DVec3>; 3],
}

impl Guests {
    /// Takes O(n log n).
    pub(crate) fn new(places: impl Iterator<Item = DVec3>) -> Guests {
        let mut places: Vec<DVec3> = places.collect();
        let key = |place: &DVec3| place.to_array().map(f64::to_bits);
        places.sort_by_key(key);
        places.dedup_by_key(|place| key(place));
        let along = |axis: usize| {
            let mut sorted = places.clone();
            sorted.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
            sorted
        };
        Guests { sorted: [0, 1, 2].map(along) }
    }

    /// The places on an edge, its ends among them. The axis is taken along which fewest places have to be looked at.
    pub(crate) fn on(&self, [start, end]: [DVec3; 2]) -> impl Iterator<Item = DVec3> {
        let (way, length) = ((end - start).normalize_or_zero(), start.distance(end));
        let near = NEAR * length;
        let (low, high) = (start.min(end) - near, start.max(end) + near);
        let within = |axis: usize| {
            let sorted = &self.sorted[axis];
            let from = sorted.partition_point(|place| place[axis] < low[axis]);
            &sorted[from..sorted.partition_point(|place| place[axis] <= high[axis])]
        };
        let fewest = [0, 1, 2].map(within).into_iter().min_by_key(|some| some.len()).unwrap_or_default();
        fewest.iter().copied().filter(move |place| {
            let reach = way.dot(*place - start);
            reach >= -near && reach <= length + near && (*place - start - reach * way).length() <= near
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_on_an_edge_is_found_whatever_its_direction() {
        let [start, end] = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 2.0, -3.0)];
        let on = (0..=8).map(|step| start.lerp(end, f64::from(step) / 8.0));
        let off = (0..=8).map(|step| start.lerp(end, f64::from(step) / 8.0) + DVec3::Y * 1e-6);
        let beyond = [start - (end - start) * 0.1, start + (end - start) * 1.1];
        let guests = Guests::new(on.clone().chain(off).chain(beyond));
        for edge in [[start, end], [end, start]] {
            assert_eq!(guests.on(edge).count(), 9);
        }
        assert_eq!(guests.on([start, start + DVec3::Y]).count(), 2);
    }
}
