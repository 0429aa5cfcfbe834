//! The child's side: one engine with one input, timed on demand.
//!
//! A process of its own for each engine bounds what a hang or a crash can spoil, and tells peak memory.

use peers::engines::{Outcome, Task, engine};
use peers::job::{Job, pairs};
use peers::shapes::family;
use polycsg::{Csg, FillRule, Scratch};
use serde::{Deserialize, Serialize};
use std::io::{BufRead, Write};
use std::time::Instant;

/// What the child says, one object a line.
#[derive(Serialize, Deserialize)]
pub(crate) enum Reply {
    /// The input is loaded.
    Ready,
    /// What came out of a call.
    Outcome(Outcome),
    /// CPU seconds per Boolean.
    Seconds(f64),
    /// Bytes that the process grew by during a call.
    Bytes(u64),
    /// How often edges of a Boolean's input cross, on average.
    Crossings(f64),
    /// The engine refused.
    Failed(String),
}

/// A sample lasts at least that long; a clock's own cost does not show.
const SAMPLE_SECONDS: f64 = 0.02;

/// Answers each line on stdin: "outcome", "time", "memory" or "crossings".
pub(crate) fn serve(names: &[String]) -> Result<(), String> {
    let [engine_name, family_name, size] = names else {
        return Err("--worker takes three values".to_owned());
    };
    let engine = engine(engine_name).ok_or_else(|| format!("no engine {engine_name}"))?;
    let family = family(family_name).ok_or_else(|| format!("no workload {family_name}"))?;
    let job = (family.make)(size.parse().map_err(|_| format!("no size {size}"))?)?;
    let mut task = match (engine.load)(&job) {
        Ok(task) => task,
        Err(message) => return say(&Reply::Failed(message)),
    };
    say(&Reply::Ready)?;
    for line in std::io::stdin().lock().lines() {
        let reply = match line.map_err(|error| error.to_string())?.as_str() {
            "outcome" => task.outcome().map(Reply::Outcome),
            "time" => sample(task.as_mut()),
            "memory" => growth(task.as_mut()),
            "crossings" => Ok(Reply::Crossings(crossings(&job))),
            question => Err(format!("no question {question}")),
        };
        say(&reply.unwrap_or_else(Reply::Failed))?;
    }
    Ok(())
}

fn say(reply: &Reply) -> Result<(), String> {
    let line = serde_json::to_string(reply).map_err(|error| error.to_string())?;
    writeln!(std::io::stdout(), "{line}").map_err(|error| error.to_string())
}

fn sample(task: &mut dyn Task) -> Result<Reply, String> {
    let start = Instant::now();
    let mut best = task.seconds(1)?;
    let mut calls = 1;
    while start.elapsed().as_secs_f64() < SAMPLE_SECONDS {
        calls *= 2;
        best = task.seconds(calls)?.min(best);
    }
    Ok(Reply::Seconds(best))
}

/// By how much the peak exceeds what stood before.
fn growth(task: &mut dyn Task) -> Result<Reply, String> {
    std::fs::write("/proc/self/clear_refs", "5")
        .map_err(|error| format!("the peak cannot be reset: {error}"))?;
    let before = status("VmRSS:");
    task.seconds(1)?;
    let grown = before.zip(status("VmHWM:")).map(|(before, peak)| peak.saturating_sub(before));
    grown.map(Reply::Bytes).ok_or_else(|| "the kernel does not tell sizes".to_owned())
}

/// Under the even-odd rule all edges bound the set, each cut once by each crossing.
fn crossings(job: &Job) -> f64 {
    let mut scratch = Scratch::default();
    let all = pairs(&job.subjects, &job.clips).map(|(subject, clip)| {
        let rings = subject.iter().chain(clip).flatten();
        let edges: usize = rings.clone().map(Vec::len).sum();
        let csg = Csg::from_rings(rings, FillRule::EvenOdd);
        csg.map_or(0, |csg| csg.boundary(&mut scratch).edges().count().saturating_sub(edges) / 2)
    });
    all.sum::<usize>() as f64 / job.subjects.len() as f64
}

/// A size in bytes from the kernel's account of this process.
fn status(field: &str) -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(field))?;
    line.split_whitespace().next()?.parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
}
