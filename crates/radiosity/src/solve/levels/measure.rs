//! Measuring what two tiles exchange.
use super::look::{look, rises};
use super::nearby::correction;
use super::parabola::Parabola;
use super::screen::hides;
use super::shaft::Shaft;
use super::tile::{INNER, OUTER};
use super::tiling::{Tile, Tiling};
use super::transfer::Transfer;
use formfactor::unoccluded;

/// How many curvatures a mean over five points may be off by.
const CUBATURE: f64 = 0.3;

/// What share of that is left when the mean is exact, and only how it climbs is not.
const SLOPES: f64 = 0.2;

/// What reaches less far into a shaft, beside the smaller of its ends, hides nothing that counts.
const SLIGHT: f64 = 1e-9;

/// What one end sees of the other.
struct View {
    exchange: [f64; 9],
    bend: [f64; 2],
    seen: [f64; 5],
}

/// Those of the surfaces that can stand between two tiles.
pub(super) fn between(tiling: &Tiling<'_>, [one, other]: [&Tile; 2], among: &[u32]) -> Vec<u32> {
    let scale = tiling.scale(one.patch).min(tiling.scale(other.patch));
    let shaft = Shaft::between([one, other], SLIGHT * scale);
    let polygons = tiling.enclosure.polygons();
    let stands = |id: &&u32| {
        let id = **id as usize;
        id != one.surface && id != other.surface && !shaft.misses(&polygons[id], &tiling.extents[id])
    };
    among.iter().filter(stands).copied().collect()
}

/// Whether two tiles may see each other as far as their planes say.
pub(super) fn faces([one, other]: [&Tile; 2]) -> bool {
    let before =
        |tile: &Tile, of: &Tile| tile.outline.corners.iter().any(|(_, place)| rises(*place, &of.points[0]));
    one.surface != other.surface && before(one, other) && before(other, one)
}

/// Measures what two tiles exchange past the surfaces `among`.
pub(super) fn measure(tiling: &Tiling<'_>, [one, other]: [&Tile; 2], among: &[u32]) -> Transfer {
    let among: Vec<usize> = among.iter().map(|id| *id as usize).collect();
    let near = SLIGHT * tiling.scale(one.patch).min(tiling.scale(other.patch));
    if among.iter().any(|id| hides(&tiling.enclosure.polygons()[*id], [one, other], near)) {
        return Transfer::NONE;
    }
    let [first, second] = [[one, other], [other, one]].map(|ends| View::of(tiling, ends, &among));
    let [at_first, at_second] = [&first, &second].map(|view| view.bend[0].abs() + view.bend[1].abs());
    let is_dark = [&first, &second].map(|view| view.seen.iter().all(|factor| *factor == 0.0));
    // What hardly sees anything is even, and says little: the curvatures are those of what is seen.
    let is_more_even = at_second * first.exchange[0] < at_first * second.exchange[0];
    let from_second = !is_dark[1] && (is_dark[0] || is_more_even);
    let (mut exchange, bend) =
        if from_second { (transposed(second.exchange), at_second) } else { (first.exchange, at_first) };
    let gap = (first.exchange[0] - second.exchange[0]).abs();
    let mut error = gap.min(CUBATURE * bend);
    let ends = if from_second { [other, one] } else { [one, other] };
    if let Some(times) = correction(tiling, ends, (exchange[0], among.is_empty()), bend) {
        exchange = exchange.map(|g| g * times);
        error *= if among.is_empty() { SLOPES } else { 1.0 };
    }
    let may_be_seen = is_dark == [true; 2] && !among.is_empty();
    Transfer {
        exchange: if exchange[0] > 0.0 { exchange } else { [0.0; 9] },
        bend: [first.bend, second.bend],
        gap,
        error,
        from_second,
        open: if may_be_seen { one.area * unoccluded(&one.points[0], &other.polygon).value } else { 0.0 },
        seen: [first.seen, second.seen],
    }
}

impl View {
    /// What the points of one tile see of another.
    fn of(tiling: &Tiling<'_>, [from, to]: [&Tile; 2], among: &[usize]) -> View {
        let seen = from.points.each_ref().map(|point| look(tiling, point, to, among));
        let mut exchange = [0.0; 9];
        for to in 0..3 {
            let [middle, ahead, back, left, right] = seen.map(|row| row[to]);
            exchange[to] = from.area * (INNER * middle + OUTER * (ahead + back + left + right));
            exchange[3 + to] = from.area * OUTER * (ahead - back);
            exchange[6 + to] = from.area * OUTER * (left - right);
        }
        let factors = seen.map(|row| row[0]);
        let mean = exchange[0] / from.area;
        let bend = [0, 1].map(|axis| {
            let [ahead, back] = [1, 2].map(|k| factors[2 * axis + k]);
            let parabola = Parabola::through([back, factors[0], ahead]);
            let turn = || tiling.point(from.patch, from.outline.on_axis(axis, parabola.turn())).ok();
            let with = |point| parabola.bend_with(look(tiling, &point, to, among)[0]);
            let point = if parabola.may_turn(mean) { turn() } else { None };
            from.area * point.map_or(parabola.bend, with)
        });
        View { exchange, bend, seen: factors }
    }
}

fn transposed(g: [f64; 9]) -> [f64; 9] {
    [g[0], g[3], g[6], g[1], g[4], g[7], g[2], g[5], g[8]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use formfactor::{Limits, PlanarPolygon};
    use glam::DVec3;

    fn patch(corners: [[f64; 3]; 4]) -> Patch {
        Patch::new("", PlanarPolygon::new([corners.map(DVec3::from)]).unwrap(), vec![0.5], vec![0.0])
    }

    /// A square of so large a half, looking down or up.
    fn plate([x, half]: [f64; 2], z: f64, is_down: bool) -> Patch {
        let (low, high) = if is_down { (half, -half) } else { (-half, half) };
        patch([[x - half, low, z], [x + half, low, z], [x + half, high, z], [x - half, high, z]])
    }

    /// Half of a ground, from below a small lamp to far away: three points of it say that what it sees is linear.
    #[test]
    fn light_that_turns_between_peak_and_tail_bends() {
        let half = patch([[0.0, -1.0, 0.0], [4.0, -1.0, 0.0], [4.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let patches = vec![half, plate([0.6, 0.1], 2.5, true)];
        let scene = Scene { patches, bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        for (ends, ground) in [([0, 1], 0), ([1, 0], 1)] {
            let found = measure(&tiling, ends.map(|tile| &tiling.tiles[tile]), &[]);
            let [middle, one, other, ..] = found.seen[ground];
            assert!(((one + other) / 2.0 - middle).abs() < 0.01 * middle, "{:?}", found.seen);
            assert!(found.bend[ground][0].abs() > 0.2 * found.exchange[0], "{:?}", found.bend);
        }
    }

    /// Most of a ground is behind a low wall on it, one point of it sees the wall from afar, and the wall sees the strip before it.
    #[test]
    fn what_points_of_a_ground_hardly_see_is_measured_from_the_wall() {
        let ground = patch([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 4.0, 0.0], [0.0, 4.0, 0.0]]);
        let wall = patch([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [2.0, 1.0, 0.6], [1.0, 1.0, 0.6]]);
        let scene = Scene { patches: vec![ground, wall], bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        let exact = tiling.enclosure.area_form_factor(1, 0, 1e-6, &Limits::default()).unwrap().unwrap();
        let exact = tiling.tiles[1].area * exact.value;
        for ends in [[0, 1], [1, 0]] {
            let found = measure(&tiling, ends.map(|tile| &tiling.tiles[tile]), &[]).exchange[0];
            assert!((found / exact - 1.0).abs() < 0.1, "{found} {exact}");
        }
    }
}
