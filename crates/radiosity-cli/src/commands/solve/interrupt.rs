//! Interrupt and resume: Ctrl-C, snapshots, and the state that a run goes on from.
use super::{
    options::{Solve, state_beside},
    progress::Bar,
    solve_outputs::SolveOutputs,
    steps::Steps,
};
use crate::failure::Failure;
use crate::messages::say;
use radiosity::{Progress, Recorder, Recording, Solution, State, io};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::{io::Read, ops::ControlFlow, process::ExitCode, sync::Arc, time::Instant};

/// What a shell reports of a program that Ctrl-C ended.
const INTERRUPTED: u8 = 130;
/// What every state begins with.
const STATE: &[u8; 16] = b"radiosity state ";

/// The state in a file; an empty one when there is none to go on from.
pub(super) fn resume(path: Option<&Path>) -> Result<State, Failure> {
    let Some(path) = path else { return Ok(State::default()) };
    let bytes = std::fs::read(path)
        .map_err(|error| Failure::internal(format!("{}: cannot be read: {error}", path.display())))?;
    State::from_bytes(&bytes).map_err(|error| Failure::internal(format!("{}: {error}", path.display())))
}

/// Whether a file is a state, of this version or another: what has its name and is something else stays.
fn is_state(path: &Path) -> bool {
    let mut start = [0; STATE.len()];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == *STATE
}

/// Follows a run: shows it, notes its steps, saves it, and stops it on Ctrl-C.
#[derive(Debug)]
pub(super) struct Follower<'o> {
    outputs: &'o SolveOutputs<'o>,
    bar: Bar,
    steps: Steps,
    /// Where steps are asked for.
    recorder: Option<Recorder>,
    /// Where the state goes: beside the first output.
    state: Option<PathBuf>,
    interrupted: Arc<AtomicBool>,
    saved: Instant,
    /// Whether this run wrote the state.
    state_written: bool,
    failure: Option<Failure>,
}

impl<'o> Follower<'o> {
    /// Follows from now on, until `tolerance` is reached; takes over Ctrl-C.
    pub(super) fn new(outputs: &'o SolveOutputs<'o>, tolerance: f64) -> Result<Follower<'o>, Failure> {
        let interrupted = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&interrupted);
        let stop = move || {
            if flag.swap(true, Ordering::SeqCst) {
                std::process::exit(INTERRUPTED.into());
            }
            say!("stopping and writing the result so far; Ctrl-C again ends at once");
        };
        ctrlc::set_handler(stop)
            .map_err(|error| Failure::internal(format!("Ctrl-C cannot be handled: {error}")))?;
        Ok(Follower {
            outputs,
            bar: Bar::new(tolerance),
            steps: Steps::new(outputs.arguments.steps.as_deref()),
            recorder: outputs.arguments.record.then(|| Recorder::new(&outputs.input.scene)),
            state: outputs.arguments.state(),
            interrupted,
            saved: Instant::now(),
            state_written: false,
            failure: None,
        })
    }

    /// One step of the run.
    pub(super) fn follow(&mut self, progress: &Progress<'_>) -> ControlFlow<()> {
        self.bar.show(progress);
        self.steps.note(progress);
        self.recorder.iter_mut().for_each(|recorder| recorder.note(progress));
        let due = self.outputs.arguments.snapshot_every;
        if due.is_some_and(|seconds| self.saved.elapsed().as_secs_f64() >= seconds) {
            let written =
                self.outputs.write(&progress.solution(), None).and_then(|_| self.save(progress.state()));
            self.failure = written.err();
            self.saved = Instant::now();
        }
        let stop = self.failure.is_some() || self.interrupted.load(Ordering::SeqCst);
        if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Ends the following: the state of a run that was stopped is saved. A run without a solution leaves what there is.
    pub(super) fn end(&mut self, state: &State, solution: Option<&Solution>) -> Result<(), Failure> {
        self.bar.clear();
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        if solution.is_some_and(|solution| !solution.converged) {
            self.save(state)?;
        }
        self.steps.save()
    }

    /// After a full run whose result is written, removes what nobody will go on from: the states beside the outputs, and, where there are
    /// any, the one that this run went on from.
    pub(super) fn remove_states(&self, solution: &Solution) -> Result<(), Failure> {
        let Solve { output, resume, .. } = self.outputs.arguments;
        let beside = output.iter().filter_map(|path| state_beside(path));
        let states = beside.chain(resume.clone().filter(|_| self.state.is_some()));
        states.filter(|path| solution.converged && is_state(path)).try_for_each(|path| {
            let refused =
                |error| Failure::internal(format!("{}: cannot be removed: {error}", path.display()));
            std::fs::remove_file(&path).map_err(refused)
        })
    }

    /// The steps of the run, where they were asked for.
    pub(super) fn recording(&mut self, solution: &Solution) -> Option<Recording> {
        Some(self.recorder.take()?.end(solution))
    }

    /// Writes the state, whole or not at all.
    fn save(&mut self, state: &State) -> Result<(), Failure> {
        let Some(path) = &self.state else { return Ok(()) };
        io::save(path, &state.to_bytes())?;
        self.state_written = true;
        Ok(())
    }

    /// The exit code, and a word on why a run ended early.
    pub(super) fn code(&self, solution: &Solution) -> ExitCode {
        if solution.converged {
            return ExitCode::SUCCESS;
        }
        match &self.state {
            Some(path) if self.state_written => say!("continue with --resume {}", path.display()),
            Some(_) => {}
            None => {
                say!(
                    "warning: no state was written, as no output is a file; with -o FILE a stopped run can go on"
                )
            }
        }
        if let Some(fault) = &solution.fault {
            return Failure::internal(fault).report();
        }
        if self.interrupted.load(Ordering::SeqCst) {
            return ExitCode::from(INTERRUPTED);
        }
        let (shots, products) = (solution.shots, solution.products);
        if solution.estimate.is_some() {
            say!(
                "warning: stopped after {products} products, before the patches were within the error asked for; allow more \
                 --time or a larger --error"
            );
        } else {
            say!(
                "warning: stopped after {shots} shots and {products} products, before the tolerance was reached; raise the \
                 limit or the tolerance"
            );
        }
        ExitCode::from(4)
    }
}
