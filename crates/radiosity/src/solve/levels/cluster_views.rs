//! What clusters see of each other, from points of one to all tiles of the other.
use super::clusters::Clusters;
use super::tiling::{Tile, Tiling};
use formfactor::DifferentialArea;
use glam::DVec3;

/// Tiles that are seen at less than this cosine are seen as if they were at that.
const GRAZING: f64 = 0.05;
/// Points look from this share of the radius above all of their cluster.
const ABOVE: f64 = 1e-6;
/// What reaches above a plane by less than this share of the distance does not.
const NEAR: f64 = 1e-9;

/// What one cluster is seen of from another.
#[derive(Debug)]
pub(super) struct ClusterView {
    /// For each tile the form factor from points of the other cluster, as from its centre.
    pub(super) seen: Vec<f64>,
    /// The same without what stands between the clusters, where something does.
    pub(super) open: Option<Vec<f64>>,
    /// What each point sees of all: with all that is in between, and without.
    sums: Vec<[f64; 2]>,
    /// How much of what is seen by one point is not seen by another, as a share.
    apart: f64,
}

/// A point that looks at a cluster, and where the centre of its own is.
#[derive(Clone, Copy, Debug)]
struct Viewpoint {
    from: DifferentialArea,
    centre: DVec3,
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
                views[1 - k].look(tiling, clusters.tiles(ends[1 - k]), &point);
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
    let tile = |k: &usize| &tiling.tiles[tiles[*k]];
    if tiles.len() == 1 {
        // The ends of the long axis, and the plane of the tile itself.
        return Some(Viewpoint { from: tile(&0).points[1 + turn], centre: cluster.centre });
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
    Some(Viewpoint { from: DifferentialArea::new(at, way).ok()?, centre: cluster.centre })
}

impl Viewpoint {
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
        let none = vec![0.0; count];
        ClusterView { open: is_past_others.then(|| none.clone()), seen: none, sums: Vec::new(), apart: 0.0 }
    }

    /// Adds what a point sees.
    fn look(&mut self, tiling: &Tiling<'_>, tiles: &[usize], view: &Viewpoint) {
        let own = surfaces(tiling, tiles);
        let mut sums = [0.0; 2];
        let mut common = 0.0;
        for (k, tile) in tiles.iter().map(|tile| &tiling.tiles[*tile]).enumerate() {
            let weight = view.weight(tile);
            let seen =
                weight * tiling.enclosure.form_factor_to_part(&view.from, tile.surface, &tile.polygon).value;
            common += seen.min(self.seen[k]);
            self.seen[k] += seen;
            sums[0] += seen;
            let Some(open) = &mut self.open else { continue };
            let (factor, _) =
                tiling.enclosure.form_factor_and_centroid(&view.from, tile.surface, &tile.polygon, &own);
            open[k] += weight * factor.value;
            sums[1] += weight * factor.value;
        }
        let before: f64 = self.sums.iter().map(|sums| sums[0]).sum();
        let least = before.min(sums[0]);
        self.apart = if least > 0.0 { 1.0 - common / least } else { 0.0 };
        self.sums.push(sums);
    }

    /// Takes the mean over the points that see something.
    fn settle(&mut self) {
        let count = |column: usize| self.sums.iter().filter(|sums| sums[column] > 0.0).count().max(1);
        let [seen, open] = [0, 1].map(|column| 1.0 / f64::from(u32::try_from(count(column)).unwrap_or(1)));
        self.seen.iter_mut().for_each(|factor| *factor *= seen);
        self.open.iter_mut().flatten().for_each(|factor| *factor *= open);
    }

    /// What share of what could be seen is.
    pub(super) fn visible(&self) -> f64 {
        if self.open.is_none() {
            return 1.0;
        }
        let [seen, open] = [0, 1].map(|column| self.sums.iter().map(|sums| sums[column]).sum::<f64>());
        if open > 0.0 { (seen / open).min(1.0) } else { 0.0 }
    }

    /// How much points see different things, as a share.
    pub(super) fn doubt(&self) -> f64 {
        let shares = || self.sums.iter().filter(|sums| sums[1] > 0.0).map(|sums| sums[0] / sums[1]);
        let spread = shares().fold(0.0, f64::max) - shares().fold(f64::INFINITY, f64::min);
        self.apart.max(spread)
    }
}

/// The polygons that some tiles are parts of.
fn surfaces(tiling: &Tiling<'_>, tiles: &[usize]) -> Vec<usize> {
    let mut own: Vec<usize> = tiles.iter().map(|tile| tiling.tiles[*tile].surface).collect();
    own.sort_unstable();
    own.dedup();
    own
}
