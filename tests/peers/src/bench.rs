//! One row: all engines on one input, in turns.

use crate::child::{Child, Failure};
use crate::worker::Reply;
use crate::workloads::Workload;
use peers::engines::{self, Engine, Outcome, PEERS, POLYCSG, engine};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// How much time a run takes.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// What one call may take at most.
    call: Duration,
    /// What the rounds of a row may take together.
    row: Duration,
    /// How many rounds at most.
    rounds: usize,
    /// The fewest edges for which memory is measured.
    memory_edges: usize,
}

/// Within three minutes.
pub(crate) const QUICK: Effort =
    Effort { call: Duration::from_secs(2), row: Duration::from_secs(4), rounds: 5, memory_edges: 100_000 };

/// As long as it takes.
pub(crate) const FULL: Effort =
    Effort { call: Duration::from_secs(10), row: Duration::from_secs(60), rounds: 9, memory_edges: 10_000 };

/// Loading an input is not timed, and bounded generously.
const LOADING: Duration = Duration::from_secs(120);

/// What one engine did.
#[derive(Clone, Debug)]
pub(crate) struct Figures {
    /// The engine's name.
    pub(crate) engine: &'static str,
    /// Least CPU seconds per call, or why there are none.
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
    pub(crate) op: String,
    /// Edges of the input.
    pub(crate) edges: usize,
    /// Crossings of its edges, where they could be counted in time.
    pub(crate) crossings: Option<usize>,
    /// polycsg from raw rings first, then from regions, then the peers.
    pub(crate) figures: Vec<Figures>,
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
}

impl Bench {
    pub(crate) fn new(effort: Effort) -> Bench {
        Bench { effort, slow: BTreeSet::new() }
    }

    /// Runs a row.
    pub(crate) fn row(&mut self, workload: &Workload) -> Result<Row, String> {
        let family = peers::shapes::family(workload.family).ok_or("a workload without inputs")?;
        let job = (family.make)(workload.size)?;
        let op =
            if workload.boundary { format!("{}-boundary", job.op.name()) } else { job.op.name().to_owned() };
        let edges = job.edges();
        drop(job);
        let ours = if workload.boundary {
            [engines::POLYCSG_BOUNDARY, engines::POLYCSG_REGIONS_BOUNDARY]
        } else {
            [POLYCSG, engines::POLYCSG_REGIONS]
        };
        let engines = ours.into_iter().chain(PEERS.iter().copied());
        let mut contestants =
            engines.map(|engine| self.enter(engine, workload)).collect::<Result<Vec<_>, _>>()?;
        self.rounds(&mut contestants);
        let figures: Vec<Figures> = contestants.into_iter().map(|contestant| contestant.figures).collect();
        let slow = figures.iter().filter(|figures| figures.seconds == Err(Failure::Slow));
        self.slow.extend(slow.map(|figures| (figures.engine, workload.family)));
        let crossings = match self.ask_once(POLYCSG, workload, "crossings", false)? {
            Ok(Reply::Crossings(crossings)) => Some(crossings),
            _ => None,
        };
        let mut row = Row { workload: *workload, op, edges, crossings, figures };
        if edges >= self.effort.memory_edges {
            self.measure_memory(&mut row)?;
        }
        Ok(row)
    }

    /// Starts an engine and lets it make its first call, unless a smaller input was too much for it.
    fn enter(&self, engine: Engine, workload: &Workload) -> Result<Contestant, String> {
        let failed =
            |failure| Figures { engine: engine.name, seconds: Err(failure), outcome: None, bytes: None };
        if self.slow.contains(&(engine.name, workload.family)) {
            return Ok(Contestant { figures: failed(Failure::Slow), child: None });
        }
        let mut child = Child::start(engine.name, workload.family, workload.size, false)?;
        let answer = child.wait(LOADING).and_then(|_| child.ask("outcome", self.effort.call * 3 / 2));
        Ok(match answer {
            Ok(Reply::Outcome(outcome)) => {
                let seconds = Ok(f64::INFINITY);
                let figures = Figures { engine: engine.name, seconds, outcome: Some(outcome), bytes: None };
                Contestant { figures, child: Some(child) }
            }
            Ok(_) => {
                Contestant { figures: failed(Failure::Error("answered out of turn".to_owned())), child: None }
            }
            Err(failure) => Contestant { figures: failed(failure), child: None },
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
        let mut child = Child::start(engine.name, workload.family, workload.size, trimmed)?;
        Ok(child.wait(LOADING).and_then(|_| child.ask(question, self.effort.call * 2)))
    }

    /// A B C A B C …, until the time is over; at least once, so that all have a figure.
    fn rounds(&self, contestants: &mut [Contestant]) {
        let start = Instant::now();
        for round in 0..self.effort.rounds {
            for contestant in contestants.iter_mut() {
                contestant.sample(self.effort.call);
            }
            let each = start.elapsed() / u32::try_from(round + 1).unwrap_or(u32::MAX);
            if start.elapsed() + each > self.effort.row {
                break;
            }
        }
    }

    /// One more call of each engine that can, in a process that gives memory back at once.
    fn measure_memory(&self, row: &mut Row) -> Result<(), String> {
        for figures in row.figures.iter_mut().filter(|figures| figures.seconds.is_ok()) {
            let Some(engine) = engine(figures.engine) else { continue };
            if let Ok(Reply::Bytes(bytes)) = self.ask_once(engine, &row.workload, "memory", true)? {
                figures.bytes = Some(bytes);
            }
        }
        Ok(())
    }
}

impl Contestant {
    fn sample(&mut self, limit: Duration) {
        let Some(child) = &mut self.child else { return };
        match child.ask("time", limit) {
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
