//! A run of the solver: all that its steps share.
use super::ledger::{Ledger, bound, gaps};
use super::solution::{FineLight, Gathered, Solution};
use super::{
    factors::Factors, interpolate::welds, light::DirectLight, light::Light, magnitude::largest,
    options::Options,
};
use super::{
    progress::{LinkedTiles, Moment, Progress},
    rooms::Rooms,
    shooters::Shooters,
    state::State,
};
use crate::error::Error;
use crate::mesh::subdivide::Subdivision;
use crate::scene::Scene;
use std::{ops::ControlFlow, time::Instant};

/// This share of the time that is granted goes to finding the light, where a final gather takes the rest; more where that is foreseen to need less:
const SOLVING: f64 = 0.5;
/// it is left so many times what is foreseen.
const SPARE: f64 = 1.25;

/// Whoever follows a run.
pub(super) type Watch<'r> = &'r mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// What is solved, and how far it has come.
pub(super) struct Run<'r> {
    pub(super) options: &'r Options,
    start: Instant,
    /// When the watcher was asked last.
    pub(super) asked: Instant,
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
    /// After so many seconds the time is up: until the light is found, that is earlier than the time that is granted.
    limit: Option<f64>,
    /// Whether the time was up.
    is_late: bool,
    /// Whether the watcher said to stop.
    is_told: bool,
    /// Σ|AΔB| over the emitted power, per band.
    pub(super) unshot: Vec<f64>,
    /// See [`gaps`].
    pub(super) gaps: Vec<f64>,
    /// See [`welds`].
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
        let factors = Factors::new(scene, subdivision, state)?;
        let light = Light::new(scene, &subdivision.mesh);
        Ok(Run {
            options,
            start,
            asked: Instant::now(),
            factors,
            shooters: Shooters::new(0..scene.patches.len(), subdivision, &light),
            gaps: gaps(&light, None),
            welds: welds(scene, &subdivision.mesh),
            bound: live(&light, f64::INFINITY),
            unshot: live(&light, 1.0),
            ledger: Ledger::dark(&light),
            fault: None,
            limit: options
                .max_seconds
                .map(|limit| if ends_with_gather(options) { SOLVING * limit } else { limit }),
            is_late: false,
            is_told: false,
            light,
            rooms: None,
            products: 0,
            scaling: None,
            watch,
        })
    }

    /// Finds what lights without surfaces bring to the elements; false when the watcher wants to stop.
    pub(super) fn shine(&mut self) -> Result<bool, Error> {
        if !self.factors.are_lit() {
            return Ok(true);
        }
        let count = self.factors.receivers.len();
        if self.report().is_break() {
            return Ok(false);
        }
        let found = self.in_batches(count, |run, some| run.factors.straight(&run.factors.receivers[some]))?;
        let goes_on = found.len() == count;
        let mut direct = DirectLight::default();
        for [lamps, beyond] in found {
            direct.irradiance.extend(lamps.iter().zip(&beyond).map(|(lamps, beyond)| lamps + beyond));
            direct.beyond.extend(beyond);
        }
        self.light.shine(direct, self.factors.lamp_power());
        self.shooters = Shooters::new(self.shooters.front(), self.factors.subdivision, &self.light);
        self.gaps = gaps(&self.light, None);
        (self.bound, self.unshot) = (live(&self.light, f64::INFINITY), live(&self.light, 1.0));
        self.ledger = Ledger::dark(&self.light);
        Ok(goes_on)
    }

    /// Whether more is unshot than the tolerance lets be.
    pub(super) fn is_open(&self) -> bool {
        largest(&self.unshot) > self.options.tolerance
    }

    /// Whether a piece sends light.
    pub(super) fn sends(&self, node: usize) -> bool {
        let (elements, bands) = (&self.factors.subdivision.nodes[node].elements, self.light.bands);
        self.light.radiosity[elements.start * bands..elements.end * bands].iter().any(|sent| *sent > 0.0)
    }

    /// Refuses a state of another scene or mesh.
    pub(super) fn recognise(&self) -> Result<(), Error> {
        let foreign = !self.factors.state.is_empty() && !self.factors.are_known();
        if foreign { Err(Error::Foreign) } else { Ok(()) }
    }

    /// Notes a defect, so that what was found before it is not lost.
    pub(super) fn survive<T>(&mut self, found: Result<T, Error>) -> Result<Option<T>, Error> {
        match found {
            Err(defect @ Error::Defect { .. }) => {
                self.fault = Some(defect);
                Ok(None)
            }
            other => other.map(Some),
        }
    }

    /// Measures what the pieces have yet to shoot; tells whether light and bound are within the tolerance.
    pub(super) fn measure(&mut self) -> bool {
        self.unshot = self.shooters.measure(&self.light);
        let peaks = self.shooters.peak();
        let of_unshot = bound(&self.light, &peaks, &self.gaps);
        self.bound = bound(&self.light, &self.with_rough(peaks), &self.gaps);
        self.ledger = Ledger::new(&self.light, &self.shooters);
        let brightness = self.light.brightness();
        !self.is_open() && (0..self.light.bands).all(|band| self.within(of_unshot[band], brightness[band]))
    }

    /// What may be missing of radiosities, per band: what is unshot, and of what was shot the share that is taken roughly.
    fn with_rough(&self, mut peaks: Vec<f64>) -> Vec<f64> {
        let share = self.factors.rough_share();
        if share > 0.0 {
            let brightest = self.shooters.brightest_shot(|patch| !self.factors.emits(patch));
            peaks.iter_mut().zip(brightest).for_each(|(peak, shot)| *peak += share * shot);
        }
        peaks
    }

    /// Which piece is to shoot next.
    pub(super) fn next(&self) -> usize {
        if self.is_open() {
            self.shooters.strongest(&self.light.emitted)
        } else {
            self.shooters.brightest(&self.light.brightness())
        }
    }

    /// Whether a bound is within the tolerance. Where there is none, what is unshot has to do.
    pub(super) fn within(&self, bound: f64, brightness: f64) -> bool {
        bound == 0.0 || bound == f64::INFINITY || bound <= self.options.tolerance * brightness
    }

    /// Shows the watcher where the run stands while it prepares its next step; a break when it, or the time, says to stop.
    pub(super) fn report(&mut self) -> ControlFlow<()> {
        self.show(Moment::Preparation)
    }

    /// Shows the watcher where the run stands; a break when it, or the time, says to stop.
    pub(super) fn show(&mut self, moment: Moment<'_>) -> ControlFlow<()> {
        let seconds = self.start.elapsed().as_secs_f64();
        self.asked = Instant::now();
        let Run { light, factors, shooters, bound, ledger, products, scaling, welds, .. } = self;
        let so_far = || Solution {
            bands: light.bands,
            radiosity: light.radiosity.clone(),
            irradiance: light.irradiance.clone(),
            reflectance: light.reflectance.clone(),
            gathered: None,
            fine: None,
            welds: welds.clone(),
            ledger: ledger.clone(),
            bound: bound.clone(),
            estimate: None,
            in_view: None,
            transfers: None,
            closure: None,
            scaling: *scaling,
            shots: shooters.shots,
            products: *products,
            converged: false,
            fault: None,
            mesh: factors.subdivision.mesh.clone(),
            seconds,
        };
        let goes_on = (self.watch)(&Progress {
            shots: shooters.shots,
            products: *products,
            unshot: largest(&self.unshot),
            bound,
            ledger,
            seconds,
            moment,
            light: &so_far,
            open: &|| shooters.unshot_radiosity(light),
            tiles: &LinkedTiles::default,
            state: factors.state,
        });
        self.is_told |= goes_on.is_break();
        self.is_late |= self.limit.is_some_and(|limit| seconds > limit);
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Whether the watcher, or the time, said to stop.
    pub(super) fn is_stopped(&self) -> bool {
        self.is_told || self.is_late
    }

    /// Whether the time for finding the light is up, and that for the gather begins.
    pub(super) fn is_halfway(&self) -> bool {
        self.is_late && !self.is_told && ends_with_gather(self.options)
    }

    /// Leaves the gather the time that it is foreseen to take; whether light may be looked for until then.
    pub(super) fn leave_to_gather(&mut self, seconds: f64) -> bool {
        self.limit = self.options.max_seconds.map(|limit| limit - SPARE * seconds);
        self.is_late = self.limit.is_some_and(|limit| self.start.elapsed().as_secs_f64() > limit);
        !self.is_late
    }

    /// Gives the rest of the time to the gather, where there is light to gather: all, or, where the time for finding it is up, what was found.
    pub(super) fn turn_to_gather(&mut self, converged: bool) -> bool {
        let gathers = ends_with_gather(self.options) && (converged || self.is_halfway());
        if gathers {
            (self.limit, self.is_late) = (self.options.max_seconds, false);
        }
        gathers
    }

    /// Whether there is time for a pass that takes twice as long as all so far.
    pub(super) fn has_time(&self) -> bool {
        self.limit.is_none_or(|limit| 3.0 * self.start.elapsed().as_secs_f64() <= limit)
    }

    /// Whether the last step of every band was within the tolerance.
    pub(super) fn is_solved(&self) -> bool {
        let brightness = self.light.brightness();
        let within = |band: usize| self.within(self.bound[band], brightness[band]);
        largest(&self.unshot) <= self.options.tolerance && self.light.live().all(within)
    }

    /// What comes out: with the closure and what was gathered, where these were found.
    pub(super) fn into_solution(
        self,
        converged: bool,
        closure: Option<f64>,
        fine: Option<FineLight>,
    ) -> Solution {
        let is_whole = converged && self.fault.is_none() && !self.is_stopped();
        let vertices = self.factors.subdivision.mesh.vertices.len() * self.light.bands;
        let gathered = fine.as_ref().map(|fine| Gathered {
            elements: self.light.irradiance.clone(),
            vertices: fine.vertices[..vertices].to_vec(),
        });
        Solution {
            bands: self.light.bands,
            ledger: Ledger::new(&self.light, &self.shooters),
            mesh: self.factors.subdivision.mesh.clone(),
            radiosity: self.light.radiosity,
            irradiance: self.light.irradiance,
            reflectance: self.light.reflectance,
            gathered,
            fine,
            welds: self.welds,
            bound: self.bound,
            estimate: None,
            in_view: None,
            transfers: None,
            closure,
            scaling: self.scaling,
            shots: self.shooters.shots,
            products: self.products,
            converged: is_whole,
            fault: self.fault,
            seconds: self.start.elapsed().as_secs_f64(),
        }
    }
}

/// Whether what is shown is gathered in the end.
fn ends_with_gather(options: &Options) -> bool {
    options.gather && options.hemicube.is_none()
}

/// A value for the bands in which something emits, and 0 for the others.
fn live(light: &Light, value: f64) -> Vec<f64> {
    light.emitted.iter().map(|&emitted| if emitted > 0.0 { value } else { 0.0 }).collect()
}
