//! What the report comes to: a sentence, and one plot of all scenes.
use super::escape::escape;
use super::marker::Sign;
use super::plot::{Curve, Plot, Point};
use super::style::style;
use super::table::{error, seconds, short};
use crate::analysis::{Verdict, lines, subjects, verdict};
use crate::methods::EXACT;
use crate::results::Report;
use crate::rows::{Chapter, Measured};

/// Nothing where no scene was measured.
pub(crate) fn html(report: &Report) -> String {
    let scenes = subjects(report.measured(Chapter::Scenes));
    let lines: Vec<_> = scenes.iter().map(|(name, rows)| (*name, lines(rows))).collect();
    let verdicts: Vec<(&str, Verdict<'_>)> =
        lines.iter().filter_map(|(name, lines)| Some((*name, verdict(lines)?))).collect();
    if verdicts.is_empty() {
        return String::new();
    }
    format!(
        "<p class=\"lead\">{}</p>\n<div class=\"overview\">\n{}</div>\n",
        escape(&sentence(&verdicts)),
        plot(&scenes)
    )
}

/// How exact, how soon, and who else.
fn sentence(verdicts: &[(&str, Verdict<'_>)]) -> String {
    let exact = || verdicts.iter().map(|(_, verdict)| verdict.exact);
    let worst = exact().map(|[bound, _]| bound).fold(0.0, f64::max);
    let [soonest, latest] =
        exact().fold([f64::INFINITY, 0.0], |[low, high], [_, time]| [low.min(time), high.max(time)]);
    let others: Vec<String> = verdicts
        .iter()
        .flat_map(|(scene, verdict)| verdict.beaten_by.iter().map(move |name| format!("{name} in {scene}")))
        .collect();
    let but = if others.is_empty() { String::new() } else { format!(" except {}", others.join(", ")) };
    let scenes =
        if verdicts.len() == 1 { "one scene".to_owned() } else { format!("{} scenes", verdicts.len()) };
    let times = if verdicts.len() == 1 {
        seconds(latest)
    } else {
        format!("{} to {}", seconds(soonest), seconds(latest))
    };
    format!(
        "In {scenes} the exact method finds form factors in {times} a point, proven right within {}; no other method comes \
         within 1e-6 in its time{but}.",
        // A number does not break at the end of a line.
        error(worst).replace('-', "\u{2011}")
    )
}

/// A method at a setting, in one scene: time in units of the exact method's there, and error.
type Place = [f64; 2];

/// Medians over the scenes of error and time, for every setting of every method.
fn plot(scenes: &[(&str, Vec<&Measured>)]) -> String {
    let mut curves: Vec<Curve> = Vec::new();
    for (series, setting) in settings(scenes) {
        let places: Vec<Place> = scenes.iter().filter_map(|(_, rows)| place(rows, series, setting)).collect();
        let Some(point) = middle(&places, series, setting) else { continue };
        match curves.iter_mut().find(|curve| curve.name == series) {
            Some(curve) => curve.points.push(point),
            None => curves.push(curve(series, point, scenes.len())),
        }
    }
    let title = match scenes {
        [(name, _)] => format!("{name}: largest error of a form factor against time"),
        all => format!("Largest error of a form factor against time, medians of {} scenes", all.len()),
    };
    Plot { title, x: "CPU time, of the exact method's (1 is as fast)", y: "largest error of F", curves }
        .html()
}

/// Every method with its settings, in the order in which they come.
fn settings<'r>(scenes: &[(&str, Vec<&'r Measured>)]) -> Vec<(&'r str, &'r str)> {
    let mut known = Vec::new();
    for row in scenes.iter().flat_map(|(_, rows)| rows) {
        let here = (row.series.as_str(), row.setting.as_str());
        if !known.contains(&here) {
            known.push(here);
        }
    }
    known
}

fn place(rows: &[&Measured], series: &str, setting: &str) -> Option<Place> {
    let unit = rows.iter().find(|row| row.series == EXACT)?.time.cpu.median;
    let row = rows.iter().find(|row| row.series == series && row.setting == setting)?;
    Some([row.time.cpu.median / unit, row.error.max])
}

/// The medians; of the exact method the worst bound, which holds in every scene.
fn middle(places: &[Place], series: &str, setting: &str) -> Option<Point> {
    let sorted = |k: usize| {
        let mut values: Vec<f64> = places.iter().map(|place| place[k]).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let [times, errors] = [sorted(0), sorted(1)];
    let (x, least, most) = (times.get(times.len() / 2)?, errors.first()?, errors.last()?);
    let y = if series == EXACT { *most } else { errors[errors.len() / 2] };
    let hint = format!(
        "{series} {setting}: errors from {} to {}, {} to {} × the exact method's time",
        error(*least),
        error(*most),
        short(times[0]),
        short(times[times.len() - 1])
    );
    Some(Point { x: *x, y, spread: None, hint })
}

fn curve(series: &str, point: Point, scenes: usize) -> Curve {
    let own = style(series);
    let (sign, note) = if series == EXACT {
        (Sign::Bound(own), if scenes > 1 { "the worst of all scenes" } else { "" })
    } else {
        (Sign::Measured(own), "")
    };
    Curve { sign, name: series.to_owned(), note: note.to_owned(), points: vec![point], floor: None }
}
