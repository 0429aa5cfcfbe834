//! One row: all engines on one input, in turns.

use crate::child::{Child, Failure};
use crate::worker::Reply;
use crate::workloads::Workload;
use peers::engines::{Engine, Outcome, PEERS, engine};
use peers::job::{Job, Operand, signed_area};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// How much time a run takes.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// What one call may take at most; of polycsg, and of the peer that the aim is about, six times that.
    call: Duration,
    /// What the rounds of a row may take together.
    row: Duration,
    /// How many rounds at most.
    rounds: usize,
    /// The fewest edges for which memory is measured.
    memory_edges: usize,
}

/// Within ten minutes.
pub(crate) const QUICK: Effort =
    Effort { call: Duration::from_secs(2), row: Duration::from_secs(4), rounds: 5, memory_edges: 100_000 };

/// As long as it takes.
pub(crate) const FULL: Effort =
    Effort { call: Duration::from_secs(10), row: Duration::from_secs(30), rounds: 9, memory_edges: 10_000 };

/// Peers so many times slower than the fastest are timed in the first round only.
const HOPELESS: f64 = 4.0;

/// Loading an input is not timed, and bounded generously.
const LOADING: Duration = Duration::from_secs(120);

/// What one engine did.
#[derive(Clone, Debug)]
pub(crate) struct Figures {
    /// The engine's name.
    pub(crate) engine: &'static str,
    /// Least CPU seconds per Boolean, or why there are none.
    pub(crate) seconds: Result<f64, Failure>,
    /// What came out.
    pub(crate) outcome: Option<Outcome>,
    /// Bytes that the process grew by in its first call.
    pub(crate) bytes: Option<u64>,
}

/// A measured row.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// What was run.
    pub(crate) workload: Workload,
    /// The operation's name.
    pub(crate) op: &'static str,
    /// How many Booleans a call does.
    pub(crate) booleans: usize,
    /// Edges of one, on average.
    pub(crate) edges: usize,
    /// Crossings of them, where they could be counted in time.
    pub(crate) crossings: Option<f64>,
    /// The share of many subjects that the border of their common clip cuts.
    pub(crate) cut: Option<f64>,
    /// polycsg, by the routes that the ratio is asked of, then by those shown beside them.
    pub(crate) ours: Vec<Figures>,
    /// All others.
    pub(crate) peers: Vec<Figures>,
}

impl Row {
    /// polycsg, then the peers.
    pub(crate) fn all(&self) -> impl Iterator<Item = &Figures> {
        self.ours.iter().chain(&self.peers)
    }

    /// Edges plus crossings.
    pub(crate) fn size(&self) -> Option<f64> {
        self.crossings.map(|crossings| self.edges as f64 + crossings)
    }
}

/// The engines, and which of them have become too slow on which kind of input.
pub(crate) struct Bench {
    effort: Effort,
    slow: BTreeSet<(&'static str, &'static str)>,
}

/// An engine in a row: its child, until that fails.
struct Contestant {
    figures: Figures,
    child: Option<Child>,
    limit: Duration,
}

/// The share of subjects of which some but not all is left.
fn cut(job: &Job, outcome: &Outcome) -> Option<f64> {
    let area = |operand: &Operand| operand.iter().flatten().map(|ring| signed_area(ring)).sum::<f64>();
    let is_cut = |(left, whole): (&f64, f64)| *left > 1e-9 * whole && *left < (1.0 - 1e-9) * whole;
    let cut = outcome.areas.iter().zip(job.subjects.iter().map(area)).filter(|&pair| is_cut(pair)).count();
    job.has_common_clip().then(|| cut as f64 / job.subjects.len() as f64)
}

impl Bench {
    pub(crate) fn new(effort: Effort) -> Bench {
        Bench { effort, slow: BTreeSet::new() }
    }

    /// Runs a row.
    pub(crate) fn row(&mut self, workload: &Workload) -> Result<Row, String> {
        let family = peers::shapes::family(workload.plan.family).ok_or("a workload without inputs")?;
        let job = (family.make)(workload.size)?;
        let routes = workload.plan.routes.iter().chain(workload.plan.shown).filter_map(|route| engine(route));
        let ours: Vec<Engine> = routes.filter(|route| (route.fits)(&job)).collect();
        let count = ours.len();
        let all = ours.into_iter().chain(PEERS.iter().copied());
        let mut all = all.map(|engine| self.enter(engine, &job, workload)).collect::<Result<Vec<_>, _>>()?;
        self.rounds(&mut all, count);
        let mut ours: Vec<Figures> = all.into_iter().map(|contestant| contestant.figures).collect();
        let slow = ours.iter().filter(|figures| figures.seconds == Err(Failure::Slow));
        self.slow.extend(slow.map(|figures| (figures.engine, workload.plan.family)));
        let peers = ours.split_off(count);
        let mut row = Row {
            workload: *workload,
            op: job.op.name(),
            booleans: job.subjects.len(),
            edges: job.edges(),
            crossings: self.crossings(&job, workload)?,
            cut: ours.iter().find_map(|figures| cut(&job, figures.outcome.as_ref()?)),
            ours,
            peers,
        };
        if row.edges >= self.effort.memory_edges {
            self.measure_memory(&mut row)?;
        }
        Ok(row)
    }

    /// What one call of an engine may take.
    fn limit(&self, engine: &Engine, workload: &Workload) -> Duration {
        let is_peer = PEERS.iter().any(|peer| peer.name == engine.name);
        self.effort.call * if is_peer && workload.plan.rival != Some(engine.name) { 1 } else { 6 }
    }

    /// Starts an engine and lets it make its first call, unless a smaller input was too much for it.
    fn enter(&self, engine: Engine, job: &Job, workload: &Workload) -> Result<Contestant, String> {
        let failed = |failure| Contestant {
            figures: Figures { engine: engine.name, seconds: Err(failure), outcome: None, bytes: None },
            child: None,
            limit: Duration::ZERO,
        };
        if !(engine.fits)(job) {
            return Ok(failed(Failure::Unfit));
        }
        if self.slow.contains(&(engine.name, workload.plan.family)) {
            return Ok(failed(Failure::Slow));
        }
        let limit = self.limit(&engine, workload);
        let mut child = Child::start(engine.name, workload.plan.family, workload.size, false)?;
        let answer = child.wait(LOADING).and_then(|_| child.ask("outcome", limit * 3 / 2));
        Ok(match answer {
            Ok(Reply::Outcome(outcome)) => {
                let seconds = Ok(f64::INFINITY);
                let figures = Figures { engine: engine.name, seconds, outcome: Some(outcome), bytes: None };
                Contestant { figures, child: Some(child), limit }
            }
            Ok(_) => failed(Failure::Error("answered out of turn".to_owned())),
            Err(failure) => failed(failure),
        })
    }

    /// Those of a common clip with many subjects are not counted: most subjects have none.
    fn crossings(&self, job: &Job, workload: &Workload) -> Result<Option<f64>, String> {
        let Some(engine) = engine("rings").filter(|_| !job.has_common_clip()) else { return Ok(None) };
        Ok(match self.ask_once(engine, workload, "crossings", false)? {
            Ok(Reply::Crossings(crossings)) => Some(crossings),
            _ => None,
        })
    }

    /// A question to a child that is started for it alone.
    fn ask_once(
        &self,
        engine: Engine,
        workload: &Workload,
        question: &str,
        trimmed: bool,
    ) -> Result<Result<Reply, Failure>, String> {
        let mut child = Child::start(engine.name, workload.plan.family, workload.size, trimmed)?;
        Ok(child.wait(LOADING).and_then(|_| child.ask(question, self.limit(&engine, workload))))
    }

    /// A B C A B C …, until the time is over; at least once, so that all have a figure. polycsg comes first, `ours` times.
    fn rounds(&self, contestants: &mut [Contestant], ours: usize) {
        let start = Instant::now();
        for round in 0..self.effort.rounds {
            contestants.iter_mut().for_each(Contestant::sample);
            let peers = &mut contestants[ours..];
            let fastest = peers.iter().filter_map(|peer| peer.figures.seconds.clone().ok()).reduce(f64::min);
            let bound = fastest.unwrap_or(f64::INFINITY) * HOPELESS;
            for peer in
                peers.iter_mut().filter(|peer| peer.figures.seconds.as_ref().is_ok_and(|&s| s > bound))
            {
                peer.child = None;
            }
            let each = start.elapsed() / u32::try_from(round + 1).unwrap_or(u32::MAX);
            if start.elapsed() + each > self.effort.row {
                break;
            }
        }
    }

    /// One more call of each engine that can, in a process that gives memory back at once.
    fn measure_memory(&self, row: &mut Row) -> Result<(), String> {
        for figures in row.ours.iter_mut().chain(&mut row.peers).filter(|figures| figures.seconds.is_ok()) {
            let Some(engine) = engine(figures.engine) else { continue };
            if let Ok(Reply::Bytes(bytes)) = self.ask_once(engine, &row.workload, "memory", true)? {
                figures.bytes = Some(bytes);
            }
        }
        Ok(())
    }
}

impl Contestant {
    fn sample(&mut self) {
        let Some(child) = &mut self.child else { return };
        match child.ask("time", self.limit) {
            Ok(Reply::Seconds(seconds)) => {
                self.figures.seconds = self.figures.seconds.clone().map(|least| least.min(seconds));
            }
            Ok(_) => {}
            Err(failure) => {
                // A figure of an earlier round stands: this one may have been disturbed.
                if self.figures.seconds.as_ref().is_ok_and(|seconds| seconds.is_infinite()) {
                    self.figures.seconds = Err(failure);
                }
                self.child = None;
            }
        }
    }
}
