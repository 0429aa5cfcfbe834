//! A run of the solver: all that its steps share.
use super::balance::largest;
use super::factors::Factors;
use super::hemicube::Hemicubes;
use super::rooms::Rooms;
use super::{
    Ledger, Method, Options, Progress, Solution, State, direct, ledger, light::Light, relax, shoot,
    shooters::Shooters,
};
use crate::{Error, Scene, interpolate, mesh::Subdivision};
use std::{ops::ControlFlow, time::Instant};

/// Whoever follows a run.
pub(super) type Watch<'r> = &'r mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// From this reflectance of a closed room on, solving for all pieces at once is quicker than shooting.
const STIFF: f64 = 0.9;
/// So many columns are found for the closure in any case.
const FEW: usize = 64;

/// What is solved, and how far it has come.
pub(super) struct Run<'r> {
    pub(super) options: &'r Options,
    start: Instant,
    pub(super) factors: Factors<'r>,
    pub(super) light: Light,
    pub(super) shooters: Shooters<'r>,
    /// Followed only where they matter.
    pub(super) rooms: Option<Rooms>,
    /// Matrix-vector products so far.
    pub(super) products: usize,
    /// The largest relative change of a factor that closure scaling made.
    pub(super) scaling: Option<f64>,
    /// As of the last step.
    pub(super) bound: Vec<f64>,
    pub(super) ledger: Ledger,
    /// The defect that ended the run.
    fault: Option<Error>,
    /// Σ|AΔB| over the emitted power, per band.
    pub(super) unshot: Vec<f64>,
    gaps: Vec<f64>,
    /// See [`interpolate::welds`].
    welds: Vec<usize>,
    watch: Watch<'r>,
}

impl<'r> Run<'r> {
    /// A run that has done nothing.
    pub(super) fn new(
        scene: &'r Scene,
        options: &'r Options,
        start: Instant,
        subdivision: &'r Subdivision,
        state: &'r mut State,
        watch: Watch<'r>,
    ) -> Result<Run<'r>, Error> {
        let light = Light::new(scene, &subdivision.mesh);
        let factors = Factors::new(scene, subdivision, state)?;
        Ok(Run {
            options,
            start,
            factors,
            shooters: Shooters::new(0..scene.patches.len(), subdivision, &light),
            gaps: ledger::gaps(&light, None),
            welds: interpolate::welds(scene, &subdivision.mesh),
            bound: live(&light, f64::INFINITY),
            unshot: live(&light, 1.0),
            ledger: Ledger::dark(&light),
            fault: None,
            light,
            rooms: None,
            products: 0,
            scaling: None,
            watch,
        })
    }

    /// Refuses a state of another scene or mesh.
    pub(super) fn recognise(&self) -> Result<(), Error> {
        let foreign = !self.factors.state.is_empty() && !self.factors.are_known();
        if foreign { Err(Error::Foreign) } else { Ok(()) }
    }

    /// Goes on until the tolerance is reached (true), or the watcher, a limit or a defect ends it (false).
    pub(super) fn advance(&mut self, scene: &Scene) -> Result<bool, Error> {
        let converged = self.solve(scene);
        Ok(self.survive(converged)?.unwrap_or(false))
    }

    fn solve(&mut self, scene: &Scene) -> Result<bool, Error> {
        let choice = if self.sample(scene)? { self.choose(scene)? } else { None };
        match choice {
            None => Ok(false),
            Some(Method::Auto | Method::Shoot) => shoot::shoot(self),
            Some(method) => relax::relax(self, method),
        }
    }

    /// Notes a defect, so that what was found before it is not lost.
    fn survive<T>(&mut self, found: Result<T, Error>) -> Result<Option<T>, Error> {
        match found {
            Err(defect @ Error::Defect { .. }) => {
                self.fault = Some(defect);
                Ok(None)
            }
            other => other.map(Some),
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
        let auto = asked == Method::Auto;
        if largest < 1.0 && (asked == Method::Shoot || (auto && largest < STIFF)) {
            return Ok(Some(Method::Shoot));
        }
        let Some(rooms) = Rooms::follow(scene, self)? else { return Ok(None) };
        rooms.check(scene)?;
        self.gaps = ledger::gaps(&self.light, Some(&rooms.sums));
        let stiff = rooms.closed_reflectance() >= STIFF;
        if asked != Method::Shoot {
            let lit = rooms.lit().into_iter();
            self.shooters = Shooters::new(lit, self.factors.subdivision, &self.light);
        }
        self.rooms = Some(rooms);
        Ok(Some(match (auto, stiff) {
            (true, true) => Method::Cg,
            (true, false) => Method::Shoot,
            (false, _) => asked,
        }))
    }

    /// Weighs what the pieces have yet to shoot; tells whether light and bound are within the tolerance.
    pub(super) fn weigh(&mut self) -> bool {
        self.unshot = self.shooters.weigh(&self.light);
        self.bound = ledger::bound(&self.light, &self.shooters, &self.gaps);
        self.ledger = Ledger::new(&self.light, &self.shooters);
        let brightness = self.light.brightness();
        largest(&self.unshot) <= self.options.tolerance
            && (0..self.light.bands).all(|band| self.within(self.bound[band], brightness[band]))
    }

    /// Which piece is to shoot next.
    pub(super) fn next(&self) -> usize {
        if largest(&self.unshot) > self.options.tolerance {
            self.shooters.strongest(&self.light.emitted)
        } else {
            self.shooters.brightest(&self.light.brightness())
        }
    }

    /// Whether a bound is within the tolerance. Where there is none, what is unshot has to do.
    pub(super) fn within(&self, bound: f64, brightness: f64) -> bool {
        bound == 0.0 || bound == f64::INFINITY || bound <= self.options.tolerance * brightness
    }

    /// Shows the watcher where the run stands; a break when it, or the time, says to stop.
    pub(super) fn report(&mut self) -> ControlFlow<()> {
        let seconds = self.start.elapsed().as_secs_f64();
        (self.watch)(&Progress {
            shots: self.shooters.shots,
            products: self.products,
            unshot: largest(&self.unshot),
            bound: &self.bound,
            ledger: &self.ledger,
            seconds,
            light: &self.light,
            scaling: self.scaling,
            factors: &self.factors,
            welds: &self.welds,
        })?;
        let late = self.options.max_seconds.is_some_and(|limit| seconds > limit);
        if late { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Whether the last step of every band was within the tolerance.
    pub(super) fn is_solved(&self) -> bool {
        let brightness = self.light.brightness();
        let within = |band: usize| self.within(self.bound[band], brightness[band]);
        largest(&self.unshot) <= self.options.tolerance && self.light.live().all(within)
    }

    /// The solution; direct light is gathered for the last mesh only.
    pub(super) fn finish(mut self, scene: &Scene, converged: bool, last: bool) -> Result<Solution, Error> {
        let (mut closure, mut direct) = (None, None);
        if converged {
            let found = self.closure(scene.patches.len());
            closure = self.survive(found)?.flatten();
        }
        if converged && last && self.options.gather {
            let gathered = direct::gather(scene, &mut self);
            direct = self.survive(gathered)?;
        }
        Ok(Solution {
            bands: self.light.bands,
            ledger: Ledger::new(&self.light, &self.shooters),
            mesh: self.factors.subdivision.mesh.clone(),
            radiosity: self.light.radiosity,
            irradiance: self.light.irradiance,
            reflectance: self.light.reflectance,
            direct,
            welds: self.welds,
            bound: self.bound,
            closure,
            scaling: self.scaling,
            shots: self.shooters.shots,
            products: self.products,
            converged: converged && self.fault.is_none(),
            fault: self.fault,
            seconds: self.start.elapsed().as_secs_f64(),
        })
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

/// A value for the bands in which something emits, and 0 for the others.
fn live(light: &Light, value: f64) -> Vec<f64> {
    light.emitted.iter().map(|&emitted| if emitted > 0.0 { value } else { 0.0 }).collect()
}
