//! Links between clusters: light between tiles that are far from each other for the size of their clusters.
//!
//! ```text
//!  i .---.                              .---. j     what i and j exchange is
//!   /  x  \ -------------------------- /  y  \      (what y sees of i) × (what x sees of j) × π d²
//!   '-----'             d              '-----'
//! ```
//!
//! What is seen is within a small tolerance, past all that stands in between and within both clusters: n + m form factors tell what n × m pairs
//! exchange. How light climbs over an end that is one tile is known, as all of it is looked at from the other end.
//! Where both clusters are small for their distance, the error is of second order: the product of their radii over its square.
use super::cluster_views::{ClusterView, ROUGH, stands_between, views};
use super::clusters::Clusters;
use super::flow::Linear;
use super::seen::Seen;
use super::tile::SQUARE;
use super::tiling::Tiling;
use std::f64::consts::PI;

/// How many times the product of the radii over the squared distance an exchange may be off by.
const BILINEAR: f64 = 3.0;
/// What share of what could be exchanged may be wrong where something stands in between, however all points agree.
const BETWEEN: f64 = 0.03;
/// How far from linear what a tile sees of a cluster may be, as a share: so many times the square of its radius over its distance.
const CURVED: f64 = 1.0;
/// How much of what some points see and others do not may be wrong.
const PARTLY: f64 = 0.5;

/// Two clusters that exchange light.
#[derive(Clone, Debug)]
pub(super) struct ClusterLink {
    pub(super) ends: [usize; 2],
    seen: Seen,
    /// How wrong that may be, as a share of it.
    error: f64,
    /// Where something stands between the clusters, or the plane of one passes through the other, what may be wrong of all that they exchange
    /// besides, for a radiosity of 1.
    hidden: f64,
    /// For each end that is one tile, how far what it sees may be from linear, as a share.
    bends: [f64; 2],
}

/// The links between clusters, and their clusters.
#[derive(Debug)]
pub(super) struct ClusterLinks {
    pub(super) clusters: Clusters,
    pub(super) all: Vec<ClusterLink>,
}

impl ClusterLink {
    /// Measures what two clusters exchange; nothing where no light can pass.
    pub(super) fn measure(tiling: &Tiling<'_>, clusters: &Clusters, ends: [usize; 2]) -> Option<ClusterLink> {
        let is_past_others = stands_between(tiling, clusters, ends);
        let [of_first, of_second] = views(tiling, clusters, ends, is_past_others)?;
        let [first, second] = ends.map(|end| &clusters.all[end]);
        let open_scale = PI * first.centre.distance_squared(second.centre);
        let visible = (of_first.visible() * of_second.visible()).sqrt();
        let doubt = [&of_first, &of_second].map(ClusterView::doubt).into_iter().fold(0.0, f64::max);
        let partly = doubt.max((of_first.visible() - of_second.visible()).abs());
        let bend = |end: usize, other: usize| match clusters.tiles(end).len() {
            1 => CURVED * clusters.fill(other, end),
            _ => 0.0,
        };
        let open = of_first.open.zip(of_second.open).map(|(one, other)| one * other);
        let open_error = BETWEEN + PARTLY * partly.max((visible * (1.0 - visible)).max(0.0).sqrt());
        let scale = if visible > 0.0 { open_scale / visible } else { 0.0 };
        let seen = Seen::of(tiling, clusters, ends, [&of_first, &of_second], scale);
        let [most, crossing] = clusters.bounds(tiling, ends);
        let are_seen = [&of_first, &of_second].map(ClusterView::is_seen);
        let is_open = open.map_or(are_seen == [true; 2], |open| open > 0.0);
        // What points of one see of the other, and those of the other do not of the one, may be anything.
        let unknown = if !is_open && are_seen.contains(&true) { most } else { crossing };
        (is_open || unknown > 0.0).then(|| ClusterLink {
            ends,
            bends: [bend(ends[0], ends[1]), bend(ends[1], ends[0])],
            error: BILINEAR * clusters.nearness(ends) + PARTLY * doubt + ROUGH,
            hidden: open.map_or(0.0, |open| open_error * open_scale * open) + unknown,
            seen,
        })
    }

    /// What each tile of one end receives, as powers, when the tiles send so much.
    fn carry(&self, end: usize, sent: &[Linear], mut to: impl FnMut(usize, Linear)) {
        let brings = self.seen.scale * self.sent(1 - end, sent);
        if brings != 0.0 {
            let [first, second] = self.seen.slopes[end];
            for (tile, seen) in &self.seen.tiles[end] {
                to(*tile, [*seen, first, second].map(|s| s * brings));
            }
        }
    }

    /// What an end sends, as the other sees it.
    fn sent(&self, end: usize, sent: &[Linear]) -> f64 {
        let seen = &self.seen.tiles[end];
        let slope = |(tile, _): &(usize, f64)| {
            let [_, first, second] = sent[*tile];
            self.seen.slopes[end][0] * first + self.seen.slopes[end][1] * second
        };
        let mean: f64 = seen.iter().map(|(tile, seen)| seen * sent[*tile][0]).sum();
        mean + seen.first().map_or(0.0, slope)
    }

    /// What is seen of an end that is one tile.
    fn only(&self, end: usize) -> Option<(usize, f64)> {
        self.seen.tiles[end].first().copied().filter(|_| self.bends[end] > 0.0)
    }

    /// An end that is one tile, and how far what it receives may be from linear, as a power.
    pub(super) fn curvature(&self, end: usize, sent: &[Linear]) -> Option<(usize, f64)> {
        let power = |seen: f64| self.bends[end] * self.seen.scale * seen * self.sent(1 - end, sent).abs();
        self.only(end).map(|(tile, seen)| (tile, power(seen)))
    }

    /// What may be wrong with what each tile of an end receives that sees something of the other; `deviation` is how far what tiles send is from
    /// linear.
    pub(super) fn errors(
        &self,
        end: usize,
        (sent, deviation): (&[Linear], &[f64]),
    ) -> impl Iterator<Item = (usize, f64)> {
        let uneven =
            self.only(1 - end).map_or(0.0, |(tile, seen)| self.bends[1 - end] * seen * deviation[tile]);
        let brings = self.seen.scale * (self.error * self.sent(1 - end, sent).abs() + uneven);
        self.seen.tiles[end].iter().map(move |(tile, seen)| (*tile, brings * seen))
    }

    /// Whether all that it carries is known within such a share.
    pub(super) fn is_within(&self, share: f64) -> bool {
        let [one, other] =
            self.seen.tiles.each_ref().map(|seen| seen.iter().map(|(_, seen)| seen).sum::<f64>());
        let passed = self.seen.scale * one * other;
        self.error * passed + self.hidden <= share * passed
    }

    /// What may be wrong of what could pass were nothing in between: a power, for a radiosity of 1.
    pub(super) fn hidden(&self) -> f64 {
        self.hidden
    }

    /// For each tile that is seen a number: the products of those of two tiles are what these exchange, raised to a power.
    pub(super) fn powers(&self, exponent: f64) -> [Vec<(usize, f64)>; 2] {
        let half = self.seen.scale.sqrt();
        let power = |(tile, seen): &(usize, f64)| (*tile, (half * seen).powf(exponent));
        self.seen.tiles.each_ref().map(|seen| seen.iter().map(power).collect())
    }

    /// The tiles of an end of which the other end sees something, and what: the product of what is seen of two tiles times the scale is what
    /// these exchange.
    pub(super) fn seen(&self, end: usize) -> &[(usize, f64)] {
        &self.seen.tiles[end]
    }

    pub(super) fn scale(&self) -> f64 {
        self.seen.scale
    }

    /// The tiles that exchange light.
    pub(super) fn lit(&self) -> impl Iterator<Item = usize> {
        let lit = self.seen.tiles.iter().flatten().map(|(tile, _)| *tile);
        lit.take(if self.seen.scale > 0.0 { usize::MAX } else { 0 })
    }
}

impl ClusterLinks {
    /// Both ends of all links between which something stands.
    pub(super) fn hidden(&self) -> impl Iterator<Item = (&ClusterLink, usize)> {
        self.all.iter().filter(|link| link.hidden > 0.0).flat_map(|link| [(link, 0), (link, 1)])
    }
}

/// Adds what tiles receive across some links when they send so much: irradiance.
pub(super) fn gather<'l>(
    tiling: &Tiling<'_>,
    links: impl Iterator<Item = &'l ClusterLink>,
    sent: &[Linear],
    received: &mut [Linear],
) {
    for (link, end) in links.flat_map(|link| [(link, 0), (link, 1)]) {
        link.carry(end, sent, |tile, power| {
            let per = 1.0 / tiling.tiles[tile].area;
            let scales = [per, per / SQUARE, per / SQUARE];
            let parts = received[tile].iter_mut().zip(power).zip(scales);
            parts.for_each(|((sum, power), per)| *sum += power * per);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use formfactor::PlanarPolygon;
    use glam::DVec3;

    fn square(corner: DVec3, [along, up]: [DVec3; 2]) -> Patch {
        let corners = [corner, corner + along, corner + along + up, corner + up];
        Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
    }

    /// Two corners of two squares each, before each other at a distance, and something between them.
    fn corners(between: Option<Patch>) -> Scene {
        let [x, y, z] = DVec3::AXES;
        let near = [square(DVec3::ZERO, [y, z]), square(DVec3::ZERO, [z, x])];
        let far = DVec3::new(9.0, 1.0, 0.5);
        let other = [square(far, [z, y]), square(far, [x * -1.0, z])];
        Scene {
            patches: near.into_iter().chain(other).chain(between).collect(),
            bands: 1,
            ..Scene::default()
        }
    }

    /// What two clusters exchange, by the link of both, what that may be off by, and exactly.
    fn exchanges(scene: &Scene, ends: [&[usize]; 2]) -> [f64; 3] {
        let tiling = Tiling::new(scene).unwrap();
        let clusters = Clusters::of(&tiling);
        let pair = ends.map(|tiles| {
            let is_of = |cluster: &usize| {
                let mut found = clusters.tiles(*cluster).to_vec();
                found.sort_unstable();
                found == tiles
            };
            (0..clusters.all.len()).find(is_of).expect("halves where tiles lie furthest apart")
        });
        let link = ClusterLink::measure(&tiling, &clusters, pair);
        let even = vec![[1.0, 0.0, 0.0]; tiling.tiles.len()];
        let [mut power, mut back, mut error] = [0.0f64; 3];
        if let Some(link) = link {
            link.carry(0, &even, |_, received| power += received[0]);
            link.carry(1, &even, |_, received| back += received[0]);
            let seen = link.errors(0, (&even, &vec![0.0; even.len()])).map(|(_, wrong)| wrong).sum::<f64>();
            error = seen + link.hidden();
        }
        assert!((power - back).abs() <= 1e-14 * power, "both ways alike");
        let exact = |one: usize, other: usize| {
            let [one, other] = [one, other].map(|tile| &tiling.tiles[tile]);
            let limits = formfactor::Limits::default();
            let found = tiling.enclosure.area_form_factor(one.surface, other.surface, 1e-9, &limits);
            one.area * found.unwrap().map_or(0.0, |found| found.value)
        };
        let pairs = ends[0].iter().flat_map(|one| ends[1].iter().map(|other| exact(*one, *other)));
        [power, error, pairs.sum()]
    }

    #[test]
    fn clusters_exchange_what_their_tiles_do_within_the_error() {
        let [x, y, z] = DVec3::AXES;
        let half = square(x * 3.0 + y * 0.8 - z, [y * 4.0, z * 4.0]);
        for between in [None, Some(half)] {
            let [found, error, exact] = exchanges(&corners(between), [&[0, 1], &[2, 3]]);
            assert!(exact > 0.0 && (found - exact).abs() <= error, "{found} ± {error}, {exact}");
        }
    }

    /// A lamp and the tiles of a floor beneath it, some of which it sees far from straight ahead.
    #[test]
    fn one_tile_and_many_exchange_what_each_of_these_does() {
        let [x, y, z] = DVec3::AXES;
        let lamp = Patch { emission: vec![1.0], ..square(z * 3.0, [y * 0.1, x * 0.1]) };
        let floor = (0..4).map(|k| square(x * f64::from(k), [x, y]));
        let patches = floor.chain([lamp]).collect();
        let scene = Scene { patches, bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        let clusters = Clusters::of(&tiling);
        let of = |tiles: &[usize]| {
            (0..clusters.all.len()).find(|cluster| clusters.tiles(*cluster) == tiles).unwrap()
        };
        let link = ClusterLink::measure(&tiling, &clusters, [of(&[4]), of(&[0, 1, 2, 3])]).unwrap();
        let mut found = [0.0; 4];
        link.carry(1, &[[1.0, 0.0, 0.0]; 5], |tile, power| found[tile] = power[0]);
        let part = |tile: usize| (tiling.tiles[tile].surface, &tiling.tiles[tile].polygon);
        for (tile, found) in found.into_iter().enumerate() {
            let limits = formfactor::Limits::default();
            let exact = tiling.enclosure.area_form_factor(part(4), part(tile), 1e-9, &limits);
            let exact = tiling.tiles[4].area * exact.unwrap().unwrap().value;
            assert!((found / exact - 1.0).abs() < 0.01, "{tile}: {found} {exact}");
        }
    }

    /// Of a lamp that reaches behind a wall one of two points may see the wall, and all of it.
    #[test]
    fn what_reaches_behind_a_tile_is_within_the_error() {
        let [x, y, z] = DVec3::AXES;
        let off = [1.9, 1.7, 1.5, 1.0, 0.5].map(|behind| {
            let lamp = square(x * -behind + y * -2.0 + z * 9.0, [y * 4.0, x * 4.0]);
            let wall = square(DVec3::ZERO, [y, z]);
            let scene = Scene { patches: vec![wall, lamp], bands: 1, ..Scene::default() };
            let [found, error, exact] = exchanges(&scene, [&[0], &[1]]);
            assert!(exact > 0.0 && (found - exact).abs() <= error, "{found} ± {error}, {exact}");
            (found / exact - 1.0).abs()
        });
        assert!(off.iter().any(|off| *off > 0.3), "{off:?}");
    }

    /// Two walls that turn away from each other, one of which sees a corner of a lamp: points of the lamp are behind it.
    #[test]
    fn what_points_of_a_lamp_do_not_see_of_two_tiles_has_an_error() {
        let [x, y, z] = DVec3::AXES;
        let walls = [square(DVec3::ZERO, [y, z]), square(x * 0.5, [z, x])];
        for behind in [1.9, 1.7, 1.5, 1.0] {
            let lamp = square(x * -behind + y * 2.0 - z * 9.0, [x * 2.0, y * 2.0]);
            let patches = walls.iter().cloned().chain([lamp]).collect();
            let [found, error, exact] =
                exchanges(&Scene { patches, bands: 1, ..Scene::default() }, [&[2], &[0, 1]]);
            assert!(exact > 0.0 && (found - exact).abs() <= error, "{behind}: {found} ± {error}, {exact}");
        }
    }

    #[test]
    fn nothing_passes_a_wall_between_clusters() {
        let [x, y, z] = DVec3::AXES;
        let wall = square(x * 3.0 - y * 12.0 - z * 9.0, [y * 20.0, z * 20.0]);
        let [found, _, exact] = exchanges(&corners(Some(wall)), [&[0], &[2]]);
        assert_eq!([found, exact], [0.0; 2]);
    }
}
