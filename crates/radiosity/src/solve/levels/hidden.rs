//! What may be wrong between two clusters of what points do not see: a share of what could pass were nothing in between, or about all of that where the plane of one
//! passes through the other; at all that faces the other.
//!
//! ```text
//!      ^
//!  < tile >   a tile faces six ways, each by its area times the cosine; of every cluster the sums are known, so that
//!      v      a link tells at once what is wrong at all of its tiles, most of which are hidden in a town
//! ```
use super::cluster::Cluster;
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::clusters::Clusters;
use super::flow::Linear;
use super::tiling::Tiling;
use super::ways::{Ways, dot, ways};

/// What clusters send in a band, by the ways that they face.
pub(super) struct HiddenLight<'h> {
    clusters: &'h Clusters,
    sent: Vec<Ways>,
}

impl<'h> HiddenLight<'h> {
    pub(super) fn new(tiling: &Tiling<'_>, clusters: &'h Clusters, sent: &[Linear]) -> HiddenLight<'h> {
        let of_tile = |tile: usize| tiling.tiles[tile].area * sent[tile][0].abs();
        HiddenLight { clusters, sent: by_ways(tiling, clusters, of_tile, |a, b| a + b) }
    }

    /// What may be wrong with the irradiance of the tiles of an end, by the ways that they face.
    pub(super) fn errors(&self, link: &ClusterLink, end: usize) -> Ways {
        let [here, there] = [end, 1 - end].map(|end| &self.clusters.all[link.ends[end]]);
        let way = (there.centre - here.centre).normalize_or_zero();
        let areas = dot(&ways(way), &here.faces) * dot(&ways(-way), &there.faces);
        let brings = link.hidden() * dot(&ways(-way), &self.sent[link.ends[1 - end]]);
        ways(way).map(|part| if areas > 0.0 { part * brings / areas } else { 0.0 })
    }

    /// For every cluster the sums of some power of these errors over all of its links, and how many those are.
    pub(super) fn sums(&self, links: &ClusterLinks, power: f64) -> Vec<(Ways, usize)> {
        let mut all = vec![([0.0; 6], 0); self.sent.len()];
        for (link, end) in links.hidden() {
            let (sums, count) = &mut all[link.ends[end]];
            let errors = self.errors(link, end).map(|error| error.powf(power));
            sums.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error);
            *count += 1;
        }
        all
    }
}

/// For every cluster the sum, or the largest, of a value of its tiles by the ways that these face.
pub(super) fn by_ways(
    tiling: &Tiling<'_>,
    clusters: &Clusters,
    value: impl Fn(usize) -> f64,
    join: fn(f64, f64) -> f64,
) -> Vec<Ways> {
    let mut all = vec![[0.0; 6]; clusters.all.len()];
    // Halves come after what they are halves of.
    for (index, Cluster { halves, .. }) in clusters.all.iter().enumerate().rev() {
        all[index] = match (clusters.tiles(index), halves) {
            ([tile], _) => ways(tiling.tiles[*tile].normal).map(|part| part * value(*tile)),
            (_, Some([one, other])) => std::array::from_fn(|way| join(all[*one][way], all[*other][way])),
            _ => [0.0; 6],
        };
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use formfactor::PlanarPolygon;
    use glam::DVec3;

    /// Two steps of two squares each before each other, and a board in between.
    fn steps() -> Scene {
        let [x, y, z] = DVec3::AXES;
        let square = |corner: DVec3, [along, up]: [DVec3; 2]| {
            let corners = [corner, corner + along, corner + along + up, corner + up];
            Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
        };
        let far = DVec3::new(9.0, 1.0, 3.0);
        let patches = vec![
            square(DVec3::ZERO, [y, z]),
            square(DVec3::ZERO, [x, y * 2.0]),
            square(far, [z, y]),
            square(far, [y, x]),
            square(x * 4.0, [y * 2.0, z * 5.0]),
        ];
        Scene { patches, bands: 1, ..Scene::default() }
    }

    /// What is wrong at all tiles of an end is what is wrong across the link, for what faces this end sends; where tiles turn away there is nothing.
    #[test]
    fn tiles_share_what_may_be_wrong_by_how_they_face() {
        let scene = steps();
        let tiling = Tiling::new(&scene).unwrap();
        let clusters = Clusters::of(&tiling);
        let of = |wanted: [usize; 2]| {
            let is_of = |cluster: &usize| {
                let mut tiles = clusters.tiles(*cluster).to_vec();
                tiles.sort_unstable();
                tiles == wanted
            };
            (0..clusters.all.len()).find(is_of)
        };
        let ends = [of([0, 1]).unwrap(), of([2, 3]).unwrap()];
        let link = ClusterLink::measure(&tiling, &clusters, ends).unwrap();
        assert!(link.hidden() > 0.0);
        let sent = [[3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [7.0, 0.0, 0.0], [5.0, 0.0, 0.0], [0.0; 3]];
        let light = HiddenLight::new(&tiling, &clusters, &sent);
        let errors = light.errors(&link, 0);
        let power = |tile: usize| tiling.tiles[tile].area * dot(&errors, &ways(tiling.tiles[tile].normal));
        let sum = power(0) + power(1);
        assert!(sum >= link.hidden() * 5.0 && sum <= link.hidden() * 7.0, "{sum} {}", link.hidden());
        assert_eq!([dot(&errors, &ways(-DVec3::X)), dot(&errors, &ways(-DVec3::Z))], [0.0; 2]);
        // What is largest by each way is a bound for all tiles.
        let worst = by_ways(&tiling, &clusters, |tile| tiling.tiles[tile].area, f64::max);
        assert!(dot(&errors, &worst[ends[0]]) >= power(0).max(power(1)));
    }
}
