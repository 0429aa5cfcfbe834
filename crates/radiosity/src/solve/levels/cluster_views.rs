//! What clusters see of each other, from points of one to all tiles of the other.
use super::cluster::Cluster;
use super::clusters::Clusters;
use super::shadow::Shadow;
use super::tiling::{Tile, Tiling};
use formfactor::{Blockers, DifferentialArea, PlanarPolygon};
use glam::DVec3;
use std::collections::VecDeque;
use std::f64::consts::PI;

/// Tiles that are seen at less than this cosine are seen as if they were at that.
const GRAZING: f64 = 0.05;
/// What is seen of a tile may be off by such a share of what a cluster fills of the view, which its tiles share.
pub(super) const ROUGH: f64 = 1e-3;
/// So many tiles of a cluster tell how much its tiles hide of each other.
const LOOKED_AT: usize = 8;
/// So many of the polygons that hide a tile have shadows of their own.
const TRIED: usize = 3;
/// So many shadows are tried on the next tiles.
const REMEMBERED: usize = 8;
/// Points look from this share of the radius above all of their cluster.
const ABOVE: f64 = 1e-6;
/// What reaches above a plane by less than this share of the distance does not.
const NEAR: f64 = 1e-9;

/// What one cluster is seen of from another.
#[derive(Debug)]
pub(super) struct ClusterView {
    /// For each tile the mean form factor from points of the other cluster.
    pub(super) factors: Vec<f64>,
    /// The same, as from its centre to where it looks.
    pub(super) seen: Vec<f64>,
    /// Of a single tile: the integrals over it of the kernel times its linear functions.
    pub(super) slopes: [f64; 2],
    /// What all are seen of without what stands between the clusters, where something does.
    pub(super) open: Option<f64>,
    points: Vec<Looked>,
    /// How much of what is seen by one point is not seen by another, as a share.
    apart: f64,
}

/// What a point sees of a cluster: of all of it, and of those of its tiles that are looked at past the cluster alone as well, with what that is.
#[derive(Clone, Copy, Debug)]
struct Looked {
    all: f64,
    seen: f64,
    open: f64,
}

/// A point that looks at a cluster, and where the centre of its own is.
#[derive(Clone, Copy, Debug)]
struct Viewpoint {
    from: DifferentialArea,
    centre: DVec3,
    /// What a form factor to a tile may be off by.
    within: f64,
}

/// What hid tiles before.
#[derive(Debug, Default)]
struct Hiding {
    /// All of the latest.
    latest: Blockers,
    /// Those of polygons that hid the last few.
    shadows: VecDeque<Shadow>,
}

impl Hiding {
    fn add(&mut self, tiling: &Tiling<'_>, from: &DifferentialArea, found: Blockers) {
        let polygons = tiling.enclosure.polygons();
        let hiding: Vec<&PlanarPolygon> = found.ids().iter().map(|id| &polygons[*id]).collect();
        for first in 0..hiding.len().min(TRIED) {
            if let Some(shadow) = Shadow::of(&hiding[first..], from) {
                self.shadows.truncate(REMEMBERED - 1);
                self.shadows.push_front(shadow);
            }
        }
        self.latest = found;
    }
}

/// What each of two clusters is seen of from the other; nothing where one does not face the other.
///
/// The first point of each is at its largest tile, the second at the largest of which the first of the other has seen nothing.
pub(super) fn views(
    tiling: &Tiling<'_>,
    clusters: &Clusters,
    ends: [usize; 2],
    is_past_others: bool,
) -> Option<[ClusterView; 2]> {
    let none = |end: usize| ClusterView::none(clusters.tiles(end).len(), is_past_others);
    let mut views = ends.map(none);
    let ways = [[ends[0], ends[1]], [ends[1], ends[0]]];
    for turn in [0, 1] {
        let points = [0, 1].map(|k| viewpoint(tiling, clusters, ways[k], turn, &views[k].seen));
        for k in [0, 1] {
            if let Some(point) = points[k] {
                views[1 - k].look(tiling, clusters, ends[1 - k], &point);
            } else if turn == 0 {
                return None;
            }
        }
    }
    views.iter_mut().for_each(ClusterView::settle);
    Some(views)
}

/// Whether a polygon that is no part of two clusters may stand between them.
pub(super) fn stands_between(tiling: &Tiling<'_>, clusters: &Clusters, ends: [usize; 2]) -> bool {
    let [one, other] = ends.map(|end| clusters.all[end].extent);
    let hull = one.with(&other);
    let near = NEAR * (hull.high - hull.low).length();
    let corners = [one.corners(), other.corners()].concat();
    let stands = |surface: u32| {
        let polygon = &tiling.enclosure.polygons()[surface as usize];
        let Some(&on) = polygon.loops().flatten().next() else { return false };
        let heights = || corners.iter().map(|corner| polygon.normal().dot(*corner - on));
        heights().any(|height| height > near)
            && heights().any(|height| height < -near)
            && !clusters.has_surface(ends, surface as usize)
    };
    tiling.boxes.any(|extent| !extent.is_near(&hull, 0.0), stands)
}

/// The point from which a cluster looks at another: before its largest tile that faces the other, in a second turn of those that are not seen
/// themselves.
fn viewpoint(
    tiling: &Tiling<'_>,
    clusters: &Clusters,
    [from, to]: [usize; 2],
    turn: usize,
    seen: &[f64],
) -> Option<Viewpoint> {
    let (cluster, tiles) = (&clusters.all[from], clusters.tiles(from));
    let way = (clusters.all[to].centre - cluster.centre).normalize_or_zero();
    let within = ROUGH * clusters.fill(from, to) / clusters.tiles(to).len() as f64;
    let tile = |k: &usize| &tiling.tiles[tiles[*k]];
    if tiles.len() == 1 {
        // The ends of the long axis, and the plane of the tile itself.
        return Some(Viewpoint { from: tile(&0).points[1 + turn], centre: cluster.centre, within });
    }
    let rises = |k: usize| tile(&k).area * tile(&k).normal.dot(way);
    let largest = |is_open: &dyn Fn(usize) -> bool| {
        let all = (0..tiles.len()).filter(|k| rises(*k) > 0.0 && is_open(*k));
        all.reduce(|a, b| if rises(b) > rises(a) { b } else { a })
    };
    let chosen = if turn == 0 { largest(&|_| true) } else { largest(&|k| seen[k] == 0.0) }?;
    let position = tile(&chosen).points[0].position();
    let places = || tiles.iter().flat_map(|tile| tiling.tiles[*tile].outline.places());
    let top = places().map(|place| way.dot(place - position)).fold(0.0, f64::max);
    let at = position + way * (top + ABOVE * cluster.radius);
    Some(Viewpoint { from: DifferentialArea::new(at, way).ok()?, centre: cluster.centre, within })
}

impl Viewpoint {
    /// The form factor to a disk of the area of a tile, as from the centre to where it looks.
    fn disk(&self, tile: &Tile) -> f64 {
        let way = tile.points[0].position() - self.from.position();
        let square = way.length_squared();
        let cosine = (-tile.normal.dot(way) / square.sqrt()).max(0.0);
        let is_before = self.from.normal().dot(way) > 0.0;
        let spread = self.weight(tile) * self.from.normal().dot(way) / square.sqrt();
        if is_before { spread * tile.area * cosine / (PI * square + tile.area) } else { 0.0 }
    }

    /// The form factors to all tiles of a cluster, in their order: parts of it that one polygon hides are not looked at tile by tile.
    fn factors(&self, tiling: &Tiling<'_>, clusters: &Clusters, cluster: usize) -> Vec<f64> {
        let mut found = Vec::with_capacity(clusters.tiles(cluster).len());
        let (mut hiding, mut open) = (Hiding::default(), vec![cluster]);
        while let Some(index) = open.pop() {
            let part = &clusters.all[index];
            let tiles = clusters.tiles(index);
            if !self.may_see(part) || hiding.shadows.iter().any(|shadow| shadow.holds(&part.extent)) {
                found.resize(found.len() + tiles.len(), 0.0);
            } else if let (Some([one, other]), true) = (part.halves, tiles.len() > 1) {
                open.extend([other, one]);
            } else {
                found.extend(tiles.iter().map(|tile| self.factor(tiling, &tiling.tiles[*tile], &mut hiding)));
            }
        }
        found
    }

    /// Whether a part of a cluster may be above the horizon, and face the point.
    fn may_see(&self, part: &Cluster) -> bool {
        let way = part.centre - self.from.position();
        self.from.normal().dot(way) > -part.radius && part.may_face(way)
    }

    /// The form factor to a tile. What hid all of the one before may hide all of this.
    fn factor(&self, tiling: &Tiling<'_>, tile: &Tile, hiding: &mut Hiding) -> f64 {
        let (from, surface, polygon, within) = (&self.from, tile.surface, &tile.polygon, self.within);
        let is_known = !hiding.latest.ids().is_empty();
        let behind = |blockers: &Blockers| {
            tiling.enclosure.form_factor_behind(from, surface, polygon, blockers, within).0.value
        };
        if is_known && behind(&hiding.latest) == 0.0 {
            return 0.0;
        }
        let (factor, found) = tiling.enclosure.form_factor_and_blockers(from, surface, polygon, within);
        if factor.value == 0.0 {
            hiding.add(tiling, from, found);
        }
        factor.value
    }

    /// What the form factor to a tile is to be multiplied by to be that from the centre to where it looks.
    fn weight(&self, tile: &Tile) -> f64 {
        let place = tile.points[0].position();
        let way = place - self.from.position();
        let cosine = self.from.normal().dot(way) / way.length();
        way.length_squared() / place.distance_squared(self.centre) / cosine.max(GRAZING)
    }
}

impl ClusterView {
    fn none(count: usize, is_past_others: bool) -> ClusterView {
        ClusterView {
            open: is_past_others.then_some(0.0),
            factors: vec![0.0; count],
            seen: vec![0.0; count],
            slopes: [0.0; 2],
            points: Vec::new(),
            apart: 0.0,
        }
    }

    /// Adds what a point sees.
    fn look(&mut self, tiling: &Tiling<'_>, clusters: &Clusters, cluster: usize, view: &Viewpoint) {
        let tiles = clusters.tiles(cluster);
        let mut found = view.factors(tiling, clusters, cluster);
        let [mut common, mut all] = [0.0; 2];
        for (k, factor) in found.iter_mut().enumerate().filter(|(_, factor)| **factor > 0.0) {
            let tile = &tiling.tiles[tiles[k]];
            self.factors[k] += *factor;
            *factor *= view.weight(tile);
            let seen = *factor;
            if tiles.len() == 1 {
                let slopes = slopes(tiling, tile, view);
                self.slopes.iter_mut().zip(slopes).for_each(|(sum, slope)| *sum += seen * slope);
            }
            common += seen.min(self.seen[k]);
            self.seen[k] += seen;
            all += seen;
        }
        let before: f64 = self.points.iter().map(|point| point.all).sum();
        let least = before.min(all);
        self.apart = if least > 0.0 { 1.0 - common / least } else { 0.0 };
        let [seen, open] = match &mut self.open {
            None => [all, all],
            Some(open) => look_past_own(tiling, tiles, view, &found, open),
        };
        self.points.push(Looked { all, seen, open });
    }

    /// Takes the mean over the points before which something is.
    fn settle(&mut self) {
        let count = self.points.iter().filter(|point| point.all.max(point.open) > 0.0).count().max(1);
        let share = 1.0 / f64::from(u32::try_from(count).unwrap_or(1));
        let seen = self.factors.iter_mut().chain(&mut self.seen);
        seen.chain(&mut self.slopes).chain(&mut self.open).for_each(|factor| *factor *= share);
    }

    /// Whether anything is seen.
    pub(super) fn is_seen(&self) -> bool {
        self.seen.iter().any(|seen| *seen > 0.0)
    }

    /// What share of what could be seen is.
    pub(super) fn visible(&self) -> f64 {
        if self.open.is_none() {
            return 1.0;
        }
        let seen: f64 = self.points.iter().map(|point| point.seen).sum();
        let open: f64 = self.points.iter().map(|point| point.open).sum();
        if open > 0.0 { (seen / open).min(1.0) } else { 0.0 }
    }

    /// How much points see different things, as a share.
    pub(super) fn doubt(&self) -> f64 {
        let points = || self.points.iter().filter(|point| point.open > 0.0);
        let shares = || points().map(|point| point.seen / point.open);
        let spread = shares().fold(0.0, f64::max) - shares().fold(f64::INFINITY, f64::min);
        self.apart.max(spread)
    }
}

/// Adds what all tiles could be seen of were nothing before the cluster but itself: as a disk, but for what hides of one another those of the
/// tiles that look largest. Gives what is seen of these, and what could be.
fn look_past_own(
    tiling: &Tiling<'_>,
    tiles: &[usize],
    view: &Viewpoint,
    seen: &[f64],
    open: &mut f64,
) -> [f64; 2] {
    let disks: Vec<f64> = tiles.iter().map(|tile| view.disk(&tiling.tiles[*tile])).collect();
    let mut largest: Vec<usize> = (0..tiles.len()).filter(|k| disks[*k] > 0.0).collect();
    largest.sort_by(|a, b| disks[*b].total_cmp(&disks[*a]).then(a.cmp(b)));
    largest.truncate(LOOKED_AT);
    let [mut looked_at, mut found] = [0.0; 2];
    // Where nothing is seen, what could be is no matter but for the error.
    if seen.iter().any(|seen| *seen > 0.0) {
        let own = surfaces(tiling, tiles);
        for &k in &largest {
            let tile = &tiling.tiles[tiles[k]];
            let (factor, _) =
                tiling.enclosure.form_factor_and_centroid(&view.from, tile.surface, &tile.polygon, &own);
            looked_at += seen[k];
            found += view.weight(tile) * factor.value;
        }
    } else {
        found = largest.iter().map(|k| disks[*k]).sum();
    }
    let all: f64 = largest.iter().map(|k| disks[*k]).sum();
    let share = if all > 0.0 { found / all } else { 1.0 };
    *open += share * disks.iter().sum::<f64>();
    [looked_at, found]
}

/// The linear functions of a tile at the centroid of what a point sees of it.
fn slopes(tiling: &Tiling<'_>, tile: &Tile, Viewpoint { from, within, .. }: &Viewpoint) -> [f64; 2] {
    let (enclosure, to) = (&tiling.enclosure, &tile.polygon);
    let (_, blockers) = enclosure.form_factor_and_blockers(from, tile.surface, to, *within);
    let (_, centroid) = enclosure.form_factor_and_centroid(from, tile.surface, to, blockers.ids());
    tile.outline.linear(tiling.flatten(tile.patch, centroid)).map(|value| value.clamp(-2.0, 2.0))
}

/// The polygons that some tiles are parts of.
fn surfaces(tiling: &Tiling<'_>, tiles: &[usize]) -> Vec<usize> {
    let mut own: Vec<usize> = tiles.iter().map(|tile| tiling.tiles[*tile].surface).collect();
    own.sort_unstable();
    own.dedup();
    own
}
