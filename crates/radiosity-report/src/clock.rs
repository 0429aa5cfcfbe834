//! Process CPU time and wall time of many jobs, interleaved, so that a neighbour's load hits all alike.
use crate::plan::Rounds;
use crate::rows::{Spread, Time};
use cpu_time::ProcessTime;
use std::time::Instant;

/// A sample lasts at least so many seconds: short jobs are repeated.
const SPAN: f64 = 2e-3;

/// What is timed; its result is that of its first run.
pub(crate) type Job<'j, T> = Box<dyn Fn() -> T + 'j>;

/// Runs all jobs once, then all again, for so many rounds: each result with its time.
pub(crate) fn interleaved<T>(jobs: &[Job<'_, T>], rounds: Rounds) -> Vec<(T, Time)> {
    let mut results: Vec<T> = Vec::new();
    let mut samples: Vec<Vec<[f64; 2]>> = vec![Vec::new(); jobs.len()];
    for round in 0..rounds.count.max(1) {
        for (job, samples) in jobs.iter().zip(&mut samples) {
            if samples.first().is_some_and(|[cpu, _]| *cpu >= rounds.long) {
                continue;
            }
            let (result, sample) = sample(job);
            samples.push(sample);
            if round == 0 {
                results.push(result);
            }
        }
    }
    results.into_iter().zip(samples.iter().map(|samples| time(samples))).collect()
}

/// CPU and wall seconds of one run that another process timed.
pub(crate) fn once(seconds: [f64; 2]) -> Time {
    time(&[seconds])
}

/// CPU and wall seconds of one run, the mean of as many as fill the span.
fn sample<T>(job: &Job<'_, T>) -> (T, [f64; 2]) {
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    let result = job();
    let mut count = 1.0;
    while wall.elapsed().as_secs_f64() < SPAN {
        std::hint::black_box(job());
        count += 1.0;
    }
    (result, [cpu.elapsed().as_secs_f64() / count, wall.elapsed().as_secs_f64() / count])
}

fn time(samples: &[[f64; 2]]) -> Time {
    let side = |k: usize| Spread::of(samples.iter().map(|sample| sample[k]).collect());
    Time { cpu: side(0), wall: side(1), rounds: samples.len() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn jobs_take_turns_and_results_are_theirs() {
        let turns = RefCell::new(Vec::new());
        let spin = |name: usize| {
            turns.borrow_mut().push(name);
            std::thread::sleep(std::time::Duration::from_secs_f64(SPAN));
            10 * name
        };
        let jobs: Vec<Job<'_, usize>> = vec![Box::new(|| spin(1)), Box::new(|| spin(2))];
        let found = interleaved(&jobs, Rounds { count: 3, long: 1e9 });
        assert_eq!(*turns.borrow(), [1, 2, 1, 2, 1, 2]);
        assert_eq!(found.iter().map(|(result, _)| *result).collect::<Vec<_>>(), [10, 20]);
        for (_, time) in found {
            assert!(time.rounds == 3 && time.wall.low >= SPAN);
            assert!(time.wall.low <= time.wall.median && time.wall.median <= time.wall.high);
        }
    }
}
