//! A profile as SVG.
use super::data::{Crossing, Profile, ProfilePoint};
use super::scale::Scale;
use crate::escape::escape;
use glam::DVec3;
use std::fmt::Write;

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 474.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 736.0;
const TOP: f64 = 86.0;
const BOTTOM: f64 = 400.0;

/// No more bands are drawn: lines of more could not be told apart.
const BANDS: usize = 6;
/// Colours and dashes of bands: red, green and blue are those of three.
const STYLES: [(&str, &str); BANDS] = [
    ("#c22f2f", ""),
    ("#2b8a3e", "9 4"),
    ("#2b5fc2", "3 3"),
    ("#8a5a00", "12 3 3 3"),
    ("#7a3f9d", "6 6"),
    ("#00707a", "1 4"),
];
/// Two stretches that are closer are joined by a line, in shares of the whole one.
const JOINED: f64 = 1e-9;

pub(super) fn svg(profile: &Profile) -> String {
    let length = profile.ends[0].distance(profile.ends[1]);
    let across = Scale::to(length, [LEFT, RIGHT], false);
    let up = Scale::to(brightest(profile), [BOTTOM, TOP], true);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
         font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"13\" fill=\"#1b1d21\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n"
    );
    title(&mut svg, profile);
    grid(&mut svg, [across, up], profile.is_estimated());
    match drawn(profile.bands).as_slice() {
        [band] => draw(&mut svg, profile, [across, up], *band, ("#1b1d21", "")),
        bands => {
            for (row, &band) in bands.iter().enumerate() {
                draw(&mut svg, profile, [across, up], band, STYLES[row]);
                entry(&mut svg, &name(profile, band), row);
            }
        }
    }
    svg + "</svg>\n"
}

/// The largest value that is drawn.
fn brightest(profile: &Profile) -> f64 {
    let ends = profile.points().flat_map(|point| &point.radiosity);
    let own = profile.crossings.iter().flat_map(|crossing| &crossing.radiosity);
    let above = profile.crossings.iter().flat_map(|crossing| {
        let sums = |end: &ProfilePoint| -> Vec<f64> {
            end.radiosity.iter().zip(&crossing.estimate).map(|(light, error)| light + error).collect()
        };
        crossing.ends.iter().flat_map(sums).collect::<Vec<f64>>()
    });
    ends.chain(own).copied().chain(above).fold(0.0, f64::max)
}

/// Both lines of a band.
fn draw(svg: &mut String, profile: &Profile, axes: [Scale; 2], band: usize, (colour, dashes): (&str, &str)) {
    if profile.is_estimated() {
        let area = area(profile, axes, band);
        let _ = writeln!(svg, "<path class=\"estimate\" d=\"{area}\" fill=\"{colour}\" opacity=\".16\"/>");
    }
    let thick = path(profile, axes, |_, end| end.radiosity[band]);
    let thin = path(profile, axes, |crossing, _| crossing.radiosity[band]);
    let _ = writeln!(
        svg,
        "<g fill=\"none\" stroke=\"{colour}\"><path class=\"elements\" d=\"{thin}\" stroke-width=\"1\" opacity=\".5\"/>\
         <path class=\"interpolated\" d=\"{thick}\" stroke-width=\"2.2\" stroke-dasharray=\"{dashes}\"/></g>"
    );
}

/// What a band's line looks like.
fn entry(svg: &mut String, name: &str, row: usize) {
    let (x, (colour, dashes)) = (LEFT + 108.0 * row as f64, STYLES[row]);
    let _ = writeln!(
        svg,
        "<path d=\"M{x} 66h26\" stroke=\"{colour}\" stroke-width=\"2.2\" stroke-dasharray=\"{dashes}\"/>\
         <text x=\"{:.0}\" y=\"70\">{name}</text>",
        x + 32.0
    );
}

/// All bands, or some of them, evenly picked.
fn drawn(bands: usize) -> Vec<usize> {
    match bands {
        0..=BANDS => (0..bands).collect(),
        _ => (0..BANDS).map(|k| k * (bands - 1) / (BANDS - 1)).collect(),
    }
}

/// A band's wavelength, colour or number.
fn name(profile: &Profile, band: usize) -> String {
    match profile.wavelengths.get(band) {
        Some(wavelength) => format!("{wavelength} nm"),
        None if profile.bands == 3 => ["red", "green", "blue"][band].to_owned(),
        None => format!("band {band}"),
    }
}

fn title(svg: &mut String, profile: &Profile) {
    let mut patches: Vec<&str> = profile.crossings.iter().map(|crossing| crossing.patch.as_str()).collect();
    patches.dedup();
    let more = patches.len().saturating_sub(3);
    let mut on = patches[..patches.len() - more].join(", ");
    if more > 0 {
        let _ = write!(on, " and {more} more");
    }
    let place = |point: DVec3| {
        let [x, y, z] = point.to_array();
        format!("({x}, {y}, {z})")
    };
    let [from, to] = profile.ends.map(place);
    let _ = writeln!(
        svg,
        "<text x=\"{LEFT}\" y=\"24\" font-size=\"16\" font-weight=\"600\">Radiosity along a line on {}</text>\n\
         <text x=\"{LEFT}\" y=\"44\" fill=\"#5d626b\">{}: {from} to {to}</text>",
        escape(&on),
        escape(profile.scene.rsplit(['/', '\\']).next().unwrap_or_default()),
    );
}

fn grid(svg: &mut String, [across, up]: [Scale; 2], is_estimated: bool) {
    for (value, text) in across.ticks() {
        let x = across.place(value);
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.2} {TOP}V{BOTTOM}\" stroke=\"#d9dade\"/><text x=\"{x:.2}\" y=\"{}\" text-anchor=\"middle\">{text}</text>",
            BOTTOM + 20.0
        );
    }
    for (value, text) in up.ticks() {
        let y = up.place(value);
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {y:.2}H{RIGHT}\" stroke=\"#d9dade\"/><text x=\"{}\" y=\"{:.2}\" text-anchor=\"end\">{text}</text>",
            LEFT - 8.0,
            y + 4.5
        );
    }
    let around = if is_estimated { "; around it: what the patch's mean may be off by" } else { "" };
    let (middle, centre) = (f64::midpoint(LEFT, RIGHT), f64::midpoint(TOP, BOTTOM));
    let _ = writeln!(
        svg,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">distance from the start (the scene's unit)</text>\
         <text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" fill=\"#5d626b\">thick: interpolated; thin: the elements' own{around}</text>\
         <text transform=\"translate(20 {centre}) rotate(-90)\" text-anchor=\"middle\">radiosity (W/m²)</text>",
        BOTTOM + 42.0,
        BOTTOM + 62.0
    );
}

/// What is within the estimate of the error around a band's interpolated radiosity, element by element.
fn area(profile: &Profile, [across, up]: [Scale; 2], band: usize) -> String {
    let mut area = String::new();
    for Crossing { ends: [enter, leave], estimate, .. } in &profile.crossings {
        let error = estimate.get(band).copied().unwrap_or(0.0);
        for (end, sign, word) in
            [(enter, 1.0, "M"), (leave, 1.0, "L"), (leave, -1.0, "L"), (enter, -1.0, "L")]
        {
            let light = (end.radiosity[band] + sign * error).max(0.0);
            let _ = write!(area, "{word}{:.2} {:.2}", across.place(end.distance), up.place(light));
        }
        area.push('Z');
    }
    area
}

/// A line over all crossings, which breaks where the surface does.
fn path(
    profile: &Profile,
    [across, up]: [Scale; 2],
    value: impl Fn(&Crossing, &ProfilePoint) -> f64,
) -> String {
    let joined = JOINED * profile.ends[0].distance(profile.ends[1]);
    let mut path = String::new();
    let mut last = f64::NEG_INFINITY;
    for crossing in &profile.crossings {
        let word = if crossing.ends[0].distance - last > joined { "M" } else { "L" };
        for (end, word) in crossing.ends.iter().zip([word, "L"]) {
            let (x, y) = (across.place(end.distance), up.place(value(crossing, end)));
            let _ = write!(path, "{word}{x:.2} {y:.2}");
        }
        last = crossing.ends[1].distance;
    }
    path
}
