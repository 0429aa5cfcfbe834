//! A run from its first step to its solution.
use super::{
    direct::gather, follow::follow, hemicube::Hemicubes, ledger::gaps, options::Method, relax::relax,
};
use super::{run::Run, shoot::shoot, shooters::Shooters, solution::Solution};
use crate::error::Error;
use crate::scene::Scene;

/// From this reflectance of a closed room on, solving for all pieces at once is quicker than shooting.
const STIFF: f64 = 0.9;
/// So many columns are found for the closure in any case.
const FEW: usize = 64;

impl Run<'_> {
    /// Goes on until the tolerance is reached (true), or the watcher, a limit or a defect ends it (false).
    pub(super) fn advance(&mut self, scene: &Scene) -> Result<bool, Error> {
        let converged = self.solve(scene);
        Ok(self.survive(converged)?.unwrap_or(false))
    }

    fn solve(&mut self, scene: &Scene) -> Result<bool, Error> {
        let choice = if self.sample(scene)? && self.shine()? { self.choose(scene)? } else { None };
        match choice {
            None => Ok(false),
            Some(Method::Shoot) => shoot(self),
            Some(method) => relax(self, method),
        }
    }

    /// Draws hemicubes where they are asked for; false when the watcher wants to stop.
    fn sample(&mut self, scene: &Scene) -> Result<bool, Error> {
        let Some(resolution) = self.options.hemicube else { return Ok(true) };
        let subdivision = self.factors.subdivision;
        let drawn = Hemicubes::draw(scene, subdivision, resolution, || self.report().is_break())?;
        let Some(hemicubes) = drawn else { return Ok(false) };
        self.factors.approximate(hemicubes, resolution);
        Ok(true)
    }

    /// Chooses how to solve; follows the light through the rooms where that decides, and refuses what has no solution.
    /// Nothing when the watcher wants to stop.
    fn choose(&mut self, scene: &Scene) -> Result<Option<Method>, Error> {
        let asked = self.options.method;
        let largest = (0..self.light.areas.len()).map(|element| self.light.largest_reflectance(element));
        let largest = largest.fold(0.0, f64::max);
        let is_free = asked == Method::Mesh;
        if largest < 1.0 && (asked == Method::Shoot || (is_free && largest < STIFF)) {
            return Ok(Some(Method::Shoot));
        }
        let Some(rooms) = follow(scene, self)? else { return Ok(None) };
        rooms.check(scene)?;
        self.gaps = gaps(&self.light, Some(&rooms.sums));
        let stiff = rooms.closed_reflectance() >= STIFF;
        if asked != Method::Shoot {
            let lit = rooms.lit().into_iter();
            self.shooters = Shooters::new(lit, self.factors.subdivision, &self.light);
        }
        self.rooms = Some(rooms);
        Ok(Some(match (is_free, stiff) {
            (true, true) => Method::Cg,
            (true, false) => Method::Shoot,
            (false, _) => asked,
        }))
    }

    /// The solution; direct light is gathered for the last mesh only.
    pub(super) fn finish(mut self, scene: &Scene, converged: bool, last: bool) -> Result<Solution, Error> {
        let (mut closure, mut gathered) = (None, None);
        if converged {
            let found = self.closure(scene.patches.len());
            closure = self.survive(found)?.flatten();
        }
        if converged && last {
            let with_emitters = self.options.gather;
            let direct = gather(scene, &mut self, with_emitters);
            gathered = self.survive(direct)?.flatten();
        }
        Ok(self.into_solution(converged, closure, gathered))
    }

    /// The largest |ΣF − 1| over the elements, for pieces that cover the patches once. Not found where that takes more
    /// columns than the solution did.
    fn closure(&mut self, patches: usize) -> Result<Option<f64>, Error> {
        let mut whole = vec![true; patches];
        let mut pieces: Vec<usize> = self.shooters.front().collect();
        pieces.iter().for_each(|&node| whole[self.factors.subdivision.nodes[node].patch] = false);
        pieces.extend((0..patches).filter(|&patch| whole[patch]));
        let missing = pieces.iter().filter(|&&node| !self.factors.is_known(node)).count();
        if missing > (pieces.len() - missing).max(FEW) {
            return Ok(None);
        }
        let sums = self.factors.sums(pieces)?;
        Ok(Some(sums.iter().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max)))
    }
}
