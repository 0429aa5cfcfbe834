//! Clusters of patches: near each other for their size, and looking one way, so that who sees one of them sees most of the others.
use super::ball::Ball;

/// A cluster is no wider than so many of its patches on average.
const WIDE: f64 = 4.0;

/// Each of some patches is in one cluster.
#[derive(Debug, Default)]
pub(super) struct PatchClusters {
    clusters: Vec<Vec<usize>>,
    /// Nothing for what is no patch of these.
    of_patch: Vec<Option<usize>>,
}

impl PatchClusters {
    /// Of the patches that have a ball around them. O(n log² n).
    pub(super) fn of(balls: &[Option<Ball>]) -> PatchClusters {
        let mut found = PatchClusters { of_patch: vec![None; balls.len()], ..PatchClusters::default() };
        for way in 0..6 {
            let looks = |patch: &usize| balls[*patch].as_ref().is_some_and(|ball| facing(ball) == way);
            let mut patches: Vec<usize> = (0..balls.len()).filter(looks).collect();
            found.part(balls, &mut patches);
        }
        found
    }

    /// The cluster of a patch.
    pub(super) fn of_patch(&self, patch: usize) -> Option<usize> {
        self.of_patch[patch]
    }

    /// The patches of a cluster.
    pub(super) fn patches(&self, cluster: usize) -> &[usize] {
        &self.clusters[cluster]
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.clusters.len()
    }

    /// One cluster, or those of both halves along the longest side of what holds all.
    fn part(&mut self, balls: &[Option<Ball>], patches: &mut [usize]) {
        let of = |patch: &usize| balls[*patch].as_ref();
        let Some(extent) = patches.iter().filter_map(of).map(Ball::extent).reduce(|all, one| all.with(&one))
        else {
            return;
        };
        let width: f64 = patches.iter().filter_map(of).map(Ball::radius).sum::<f64>() / patches.len() as f64;
        if extent.low.distance(extent.high) <= 2.0 * WIDE * width {
            patches.iter().for_each(|patch| self.of_patch[*patch] = Some(self.clusters.len()));
            self.clusters.push(patches.to_vec());
            return;
        }
        let axis = extent.longest();
        let place = |patch: &usize| of(patch).map_or(0.0, |ball| ball.middle()[axis]);
        patches.sort_unstable_by(|a, b| place(a).total_cmp(&place(b)).then(a.cmp(b)));
        let (low, high) = patches.split_at_mut(patches.len() / 2);
        self.part(balls, low);
        self.part(balls, high);
    }
}

/// The side of a cube that a ball's polygon looks at.
fn facing(ball: &Ball) -> usize {
    let normal = ball.normal();
    let axis = normal.abs().max_position();
    2 * axis + usize::from(normal[axis] < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use formfactor::PlanarPolygon;
    use glam::{DQuat, DVec3};
    use proptest::prelude::*;

    /// A square of some size somewhere, turned somehow.
    fn square() -> impl Strategy<Value = PlanarPolygon> {
        let place = prop::array::uniform3(-1.0..1.0).prop_map(DVec3::from);
        (place.clone(), place, -6.0..0.0).prop_map(|(at, turn, size)| {
            let turn = DQuat::from_scaled_axis(3.0 * turn);
            let corner = |x, y| at + turn * DVec3::new(x, y, 0.0) * f64::exp2(size);
            PlanarPolygon::new([[corner(0., 0.), corner(1., 0.), corner(1., 1.), corner(0., 1.)]]).unwrap()
        })
    }

    proptest! {
        #[test]
        fn every_patch_is_in_one_cluster_of_its_kind(squares in prop::collection::vec((square(), any::<bool>()), 1..60)) {
            let balls: Vec<_> = squares.iter().map(|(square, is_one)| is_one.then(|| Ball::around(square))).collect();
            let clusters = PatchClusters::of(&balls);
            let mut seen = vec![0; balls.len()];
            for cluster in 0..clusters.len() {
                let patches = clusters.patches(cluster);
                let of = |patch: &usize| balls[*patch].as_ref().unwrap();
                for patch in patches {
                    seen[*patch] += 1;
                    prop_assert_eq!(clusters.of_patch(*patch), Some(cluster));
                    prop_assert_eq!(facing(of(patch)), facing(of(&patches[0])));
                }
                let width = patches.iter().map(|patch| of(patch).radius()).sum::<f64>() / patches.len() as f64;
                let far = |a: &usize| patches.iter().map(|b| of(a).middle().distance(of(b).middle())).fold(0.0, f64::max);
                prop_assert!(patches.iter().map(far).fold(0.0, f64::max) <= 2.0 * WIDE * width);
            }
            for (seen, ball) in seen.into_iter().zip(&balls) {
                prop_assert_eq!(seen, usize::from(ball.is_some()));
            }
        }
    }

    #[test]
    fn facets_of_a_ball_are_in_far_fewer_clusters() {
        let place = |i: usize, j: usize| {
            let (up, around) =
                (std::f64::consts::PI * i as f64 / 24.0, std::f64::consts::TAU * j as f64 / 48.0);
            DVec3::new(up.sin() * around.cos(), up.sin() * around.sin(), up.cos())
        };
        let facets =
            (1..23).flat_map(|i| (0..48).map(move |j| [place(i, j), place(i + 1, j), place(i, j + 1)]));
        let balls: Vec<_> =
            facets.map(|facet| Some(Ball::around(&PlanarPolygon::new([facet]).unwrap()))).collect();
        let clusters = PatchClusters::of(&balls);
        assert!(balls.len() > 8 * clusters.len() && clusters.len() > 12, "{}", clusters.len());
    }
}
