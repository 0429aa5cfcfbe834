//! What was left out in a scene: how much of it, what it would have cost, and so what leaving it out bought.
use super::test_scene::TestScene;
use crate::clock::{Job, interleaved};
use crate::plan::Rounds;
use crate::rows::{LeftOut, Row, Time};
use formfactor::{DifferentialArea, PlanarPolygon, Stats, form_factor, visible_part};
use radiosity::{Error, Options, solve};
use std::ops::ControlFlow;

/// How many form factors are looked at.
const PAIRS: usize = 400;

/// Points that look at emitters, and the work behind each.
struct Pairs<'s> {
    test_scene: &'s TestScene<'s>,
    pairs: Vec<(DifferentialArea, usize)>,
    stats: Vec<Stats>,
}

/// The economies of form factors in a scene, and those of its solution.
pub(crate) fn measure(test_scene: &TestScene<'_>, rounds: Rounds) -> Result<Vec<Row>, Error> {
    let pairs = Pairs::of(test_scene);
    let mut rows = if pairs.pairs.is_empty() { Vec::new() } else { pairs.economies(rounds) };
    rows.extend(unlit(test_scene)?);
    Ok(rows.into_iter().map(Row::LeftOut).collect())
}

impl<'s> Pairs<'s> {
    /// Evenly picked from all points and emitters.
    fn of(test_scene: &'s TestScene<'s>) -> Pairs<'s> {
        let all = test_scene.points.len() * test_scene.emitters.len();
        let pick = |at: usize| {
            (
                test_scene.points[at / test_scene.emitters.len()],
                test_scene.emitters[at % test_scene.emitters.len()],
            )
        };
        let pairs: Vec<_> = (0..all).step_by(all.div_ceil(PAIRS).max(1)).map(pick).collect();
        let stats =
            pairs.iter().map(|(from, emitter)| test_scene.enclosure.form_factor_with_stats(from, *emitter).1);
        Pairs { stats: stats.collect(), pairs, test_scene }
    }

    /// All economies: what is done is timed against what would be done without them.
    fn economies(&self, rounds: Rounds) -> Vec<LeftOut> {
        let polygons = self.test_scene.enclosure.polygons();
        let (count, total) = (self.pairs.len() as f64, self.stats.iter().copied().sum::<Stats>());
        let others = (polygons.len() - 1) as f64;
        let corners: usize = polygons.iter().flat_map(PlanarPolygon::loops).map(<[_]>::len).sum();
        let corners = corners as f64 / polygons.len() as f64;
        let [done, listed, traced, by_csg] = self.times(rounds);
        let candidates = count * others;
        let unseen = candidates - total.looked_at as f64;
        // Without the tree of boxes and the bodies every polygon is looked at; beyond that the work is the same.
        let look = (listed - done).max(0.0) / unseen.max(1.0);
        let hard = self.hidden_in_part().count().max(1) as f64;
        let csg = (by_csg - traced).max(0.0) / hard;
        // A CSG's time by its edges: those of the target and of what stands in between.
        let standing = total.looked_at - total.culled;
        let edges = corners * (standing as f64 + hard);
        let edge = by_csg / edges.max(1.0);
        let decided = (total.none + total.total) as f64;
        let row = |economy, left: f64, of: f64, unit: f64| LeftOut {
            scene: self.test_scene.name.to_owned(),
            economy,
            count: left / count,
            share: if of > 0.0 { left / of } else { 0.0 },
            unit,
            saved: left * unit / done,
        };
        vec![
            row(
                "occluders never looked at: outside of boxes, far sides of bodies, faces of the emitter's own",
                unseen,
                candidates,
                look,
            ),
            row(
                "occluders culled before any CSG",
                total.culled as f64,
                total.looked_at as f64,
                corners * edge,
            ),
            row("pairs decided without CSG: none or all is seen", decided, count, by_csg / hard),
            row("pairs hidden in part, traced without CSG", total.traced as f64, total.partial as f64, csg),
            row("edges never classified", edges - total.csg_edges as f64, edges, edge),
        ]
    }

    /// Those that need more than a look.
    fn hidden_in_part(&self) -> impl Iterator<Item = &(DifferentialArea, usize)> {
        self.pairs.iter().zip(&self.stats).filter(|(_, stats)| stats.partial > 0).map(|(pair, _)| pair)
    }

    /// CPU seconds of all pairs as they are found; of all pairs past a plain list of polygons; of those hidden in part as
    /// they are found; and of these by CSG.
    fn times(&self, rounds: Rounds) -> [f64; 4] {
        let enclosure = &self.test_scene.enclosure;
        let found = |(from, emitter): &(DifferentialArea, usize)| enclosure.form_factor(from, *emitter).value;
        // A plain list knows of no owner: what lies in dA's plane hides nothing there either.
        let listed = |(from, emitter): &(DifferentialArea, usize)| {
            form_factor(from, &enclosure.polygons()[*emitter], &self.without(*emitter, from)).value
        };
        let by_csg = |(from, emitter): &(DifferentialArea, usize)| {
            visible_part(from, &enclosure.polygons()[*emitter], &self.without(*emitter, from)).area()
        };
        let jobs: [Job<'_, f64>; 4] = [
            Box::new(|| self.pairs.iter().map(found).sum()),
            Box::new(|| self.pairs.iter().map(listed).sum()),
            Box::new(|| self.hidden_in_part().map(found).sum()),
            Box::new(|| self.hidden_in_part().map(by_csg).sum()),
        ];
        let copies: Job<'_, f64> = Box::new(|| {
            self.pairs.iter().map(|(from, emitter)| self.without(*emitter, from).len() as f64).sum()
        });
        let jobs: Vec<Job<'_, f64>> = jobs.into_iter().chain([copies]).collect();
        let seconds: Vec<f64> =
            interleaved(&jobs, rounds).iter().map(|(_, time): &(f64, Time)| time.cpu.median).collect();
        let share = self.hidden_in_part().count() as f64 / self.pairs.len() as f64;
        [seconds[0], seconds[1] - seconds[4], seconds[2], seconds[3] - share * seconds[4]]
    }

    /// All polygons but the emitter and what owns the point.
    fn without(&self, emitter: usize, from: &DifferentialArea) -> Vec<PlanarPolygon> {
        let polygons = self.test_scene.enclosure.polygons().iter().enumerate();
        let kept = polygons.filter(|(id, _)| *id != emitter && Some(*id) != from.owner());
        kept.map(|(_, polygon)| polygon.clone()).collect()
    }
}

/// Elements that no light reaches, for which nothing is solved.
fn unlit(test_scene: &TestScene<'_>) -> Result<Option<LeftOut>, Error> {
    if test_scene.scene.patches.len() > 250 {
        return Ok(None);
    }
    let options = Options { tolerance: 1e-2, spread: 1e-3, ..Options::mesh(test_scene.points.len()) };
    let job: Job<'_, _> = Box::new(|| solve(test_scene.scene, &options, |_| ControlFlow::Continue(())));
    let (solution, time) = interleaved(&[job], Rounds::ONCE).remove(0);
    let solution = solution?;
    let elements = solution.irradiance.chunks(solution.bands);
    let dark = elements.clone().filter(|bands| bands.iter().all(|h| *h == 0.0)).count() as f64;
    let all = elements.len() as f64;
    let unit = time.cpu.median / (all - dark).max(1.0);
    Ok(Some(LeftOut {
        scene: test_scene.name.to_owned(),
        economy: "elements never solved, as no light reaches them",
        count: dark,
        share: dark / all,
        unit,
        saved: dark / (all - dark).max(1.0),
    }))
}
