//! A run from its first step to its solution.
use super::{
    final_gather::foresee, final_gather::gather, follow::follow, hemicube::Hemicubes, ledger::gaps,
    options::Method, relax::relax,
};
use super::{rough::Rough, run::Run, shoot::Shooting, shoot::shoot, shooters::Shooters, solution::Solution};
use crate::error::Error;
use crate::scene::{Scene, patch::Patch};

/// From this reflectance of a closed room on, solving for all pieces at once is quicker than shooting.
const STIFF: f64 = 0.9;
/// So many columns are found for the closure in any case.
const FEW: usize = 64;

/// Whether all light comes from beyond the scene: then it leaves every room that it reaches, and none is closed.
fn is_lit_from_beyond(scene: &Scene) -> bool {
    scene.lamps.is_empty() && !scene.patches.iter().any(Patch::emits)
}

impl Run<'_> {
    /// Goes on until the tolerance is reached (true), or the watcher, a limit or a defect ends it (false).
    pub(super) fn advance(&mut self, scene: &Scene) -> Result<bool, Error> {
        let converged = self.solve(scene);
        Ok(self.survive(converged)?.unwrap_or(false))
    }

    fn solve(&mut self, scene: &Scene) -> Result<bool, Error> {
        if !(self.sample(scene)? && self.shine()?) {
            return Ok(false);
        }
        if self.shoots_alone(scene) {
            return Ok(self.take_roughly(scene)? && self.shoot_in_time(scene)?);
        }
        if self.may_be_stiff() && self.options.method == Method::Mesh {
            // Whether a room is closed takes the columns of all its patches: as many shots may do.
            match shoot(self, scene.patches.len())? {
                Shooting::Spent => (),
                ended => return Ok(ended == Shooting::Converged),
            }
        }
        match self.choose(scene)? {
            None => Ok(false),
            Some(Method::Shoot) => self.shoot_in_time(scene),
            Some(method) => relax(self, method),
        }
    }

    /// Shoots until the tolerance is reached (true), for as long as the final gather does not need the time.
    fn shoot_in_time(&mut self, scene: &Scene) -> Result<bool, Error> {
        let ended = shoot(self, usize::MAX)?;
        if self.is_halfway() {
            let seconds = foresee(scene, self)?;
            if self.leave_to_gather(seconds) {
                return Ok(shoot(self, usize::MAX)? == Shooting::Converged);
            }
        }
        Ok(ended == Shooting::Converged)
    }

    /// Takes small form factors roughly where that is asked for; false when the watcher wants to stop.
    fn take_roughly(&mut self, scene: &Scene) -> Result<bool, Error> {
        let (share, count) = (self.options.rough, self.factors.receivers.len());
        if share == 0.0 || self.options.hemicube.is_some() {
            return Ok(true);
        }
        let Some(mut rough) = Rough::among(scene, count, share) else { return Ok(true) };
        rough.limits = self.in_batches(count, |run, some| rough.limits(&run.factors.receivers[some]))?;
        let goes_on = rough.limits.len() == count;
        if goes_on {
            self.factors.take_roughly(rough);
        }
        Ok(goes_on)
    }

    /// Whether shooting solves the scene, whichever rooms it has.
    fn shoots_alone(&self, scene: &Scene) -> bool {
        let (asked, largest) = (self.options.method, self.largest_reflectance());
        let is_quick = asked == Method::Mesh && (largest < STIFF || is_lit_from_beyond(scene));
        largest < 1.0 && (asked == Method::Shoot || is_quick)
    }

    /// Whether a room that reflects so much that shooting takes long may be closed, and not reflect all.
    fn may_be_stiff(&self) -> bool {
        let largest = self.largest_reflectance();
        (STIFF..1.0).contains(&largest)
    }

    fn largest_reflectance(&self) -> f64 {
        (0..self.light.areas.len()).map(|element| self.light.largest_reflectance(element)).fold(0.0, f64::max)
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
        let is_free = asked == Method::Mesh;
        let Some(rooms) = follow(scene, self)? else { return Ok(None) };
        rooms.check(scene)?;
        self.gaps = gaps(&self.light, Some(&rooms.sums));
        let method = match (is_free, rooms.closed_reflectance() >= STIFF) {
            (true, true) => Method::Cg,
            (true, false) => Method::Shoot,
            (false, _) => asked,
        };
        if method != Method::Shoot {
            // What was shot so far is found again, with the rest.
            self.light.receive_all(vec![0.0; self.light.irradiance.len()]);
            let lit = rooms.lit().into_iter();
            self.shooters = Shooters::new(lit, self.factors.subdivision, &self.light);
        }
        self.rooms = Some(rooms);
        Ok(Some(method))
    }

    /// The solution; what is shown is gathered for the last mesh only.
    pub(super) fn finish(mut self, scene: &Scene, converged: bool, last: bool) -> Result<Solution, Error> {
        let (mut closure, mut fine) = (None, None);
        if converged && self.factors.rough_share() == 0.0 {
            let found = self.closure(scene.patches.len());
            closure = self.survive(found)?.flatten();
        }
        let is_dark = converged && self.light.live().next().is_none();
        if (last || !converged) && !is_dark && self.turn_to_gather(converged) {
            let found = gather(scene, &mut self);
            fine = self.survive(found)?.flatten();
        }
        Ok(self.into_solution(converged, closure, fine))
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
        let mut sums = vec![0.0; self.light.areas.len()];
        for node in pieces {
            let Some(column) = self.column(node)? else { return Ok(None) };
            column.iter().for_each(|(element, factor)| sums[element] += factor);
        }
        Ok(Some(sums.iter().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max)))
    }
}
