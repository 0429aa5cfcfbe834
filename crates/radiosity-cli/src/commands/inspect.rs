//! `radiosity inspect`
use super::patience::Patience;
use crate::clashes;
use crate::digits::{own_digits, six_digits};
use crate::failure::Failure;
use crate::input::{self, Sides};
use crate::json;
use crate::messages::say;
use crate::outputs::print;
use crate::parse::positive;
use clap::Args;
use radiosity::inspect::{Finding, Inspection, KindSummary, in_one_line, inspect_until, summary};
use radiosity::{Scene, io::RepairedFile, repair_until};
use std::{
    fmt::Write,
    path::{Path, PathBuf},
    process::ExitCode,
};

/// How many emitters are listed for people.
const EMITTERS: usize = 20;
/// How many findings of a kind.
const FINDINGS: usize = 10;
/// How many patches of a finding.
const NAMES: usize = 8;

/// `radiosity inspect`
#[derive(Args, Debug)]
pub(crate) struct Inspect {
    /// The scene: a COLLADA (.dae), glTF (.gltf, .glb), OBJ (.obj), PLY (.ply), STL (.stl) or View3D (.vs3) file; - for standard input
    scene: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sides: Sides,
    /// Repair the surfaces, as solve does while reading; needs -o
    #[arg(long, requires = "output")]
    repair: bool,
    /// Write the repaired file to this file, in the format of its extension; of COLLADA and glTF only what was cut changes
    #[arg(short, long, value_name = "FILE", requires = "repair")]
    output: Option<PathBuf>,
    /// Stop after so many seconds, and print what was found so far
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    time: Option<f64>,
}

/// Prints what a scene is and what will trouble a solution; writes it repaired, if asked.
pub(crate) fn run(arguments: &Inspect) -> Result<ExitCode, Failure> {
    let patience = Patience::new(arguments.time);
    arguments.output.iter().try_for_each(|output| check(&arguments.scene, output))?;
    let sides = arguments.sides;
    let (_, source, scene) =
        input::read_quietly(&arguments.scene, move |scene| sides.of(scene), || patience.is_over())?;
    patience.listen()?;
    let inspection = inspect_until(&scene, &|| patience.is_over());
    print(&if arguments.json { json::line(&inspection) } else { text(&inspection) })?;
    if inspection.stopped {
        let unwritten = arguments.output.as_ref().map_or("", |_| "; nothing was written");
        say!("stopped: not all was looked at{unwritten}");
        return Ok(patience.code());
    }
    if let Some(path) = &arguments.output {
        let Some(repaired) = repair_until(&scene, &|| patience.is_over()) else {
            say!("stopped: nothing was written");
            return Ok(patience.code());
        };
        let sides = |scene: &Scene| arguments.sides.of(scene);
        let RepairedFile { left_out, remaining, .. } =
            source.save_repaired([&scene, &repaired.scene], &sides, path)?;
        let repairs = summary(&repaired.repairs);
        let what = if repairs.is_empty() { "nothing".to_owned() } else { input::counts(&repairs) };
        say!("repaired: {what}; written to {}", path.display());
        if let Some(line) = in_one_line(&remaining) {
            say!("warning: {}: not all could be repaired: {line}", path.display());
        }
        if !left_out.is_empty() {
            say!("warning: {}: the format has no place for {}", path.display(), left_out.join(", "));
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses to write over the scene but where all else in it stays: COLLADA and glTF may be repaired in place; other formats are written
/// anew, without what is not read of them.
fn check(scene: &Path, output: &Path) -> Result<(), Failure> {
    let end = |path: &Path| path.extension().unwrap_or_default().to_ascii_lowercase();
    let stays = ["dae", "glb", "gltf"].iter().any(|kept| end(scene) == *kept) && end(scene) == end(output);
    if !stays {
        clashes::refuse([scene], [output])?;
    }
    clashes::refuse_materials_of_others(output, Some(scene))
}

/// Lines for people.
fn text(inspection: &Inspection) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<10} {value}");
    };
    let [low, high] = inspection.extent;
    let unit = inspection.unit;
    line(
        "patches",
        format!(
            "{} with {} vertices, area {}",
            inspection.patches,
            inspection.vertices,
            six_digits(inspection.area)
        ),
    );
    let [low, high, up] = [low, high, inspection.up].map(|point| list(&point, own_digits));
    line("extent", format!("{low} to {high}; the unit is {unit} m, up is {up}"));
    line("bands", inspection.bands.to_string());
    line("cameras", inspection.cameras.to_string());
    for emitter in inspection.emitters.iter().take(EMITTERS) {
        let power = list(&emitter.power, six_digits);
        line("emitter", format!("{} emits {power} W (in units of {unit} m)", emitter.name));
    }
    if inspection.emitters.len() > EMITTERS {
        line("emitters", format!("{} in all; --json lists them", inspection.emitters.len()));
    }
    line("openness", openness(inspection));
    let cost = &inspection.cost;
    let seconds =
        if cost.seconds > 0.0 { format!("about {:.1} s", cost.seconds) } else { "not timed".into() };
    line(
        "cost",
        format!(
            "{} elements with {} form factors to whole patches, {seconds}; large patches are split and need more",
            cost.elements, cost.factors
        ),
    );
    text + &findings(inspection)
}

/// Numbers in brackets.
fn list(numbers: &[f64], digits: fn(f64) -> String) -> String {
    let digits: Vec<String> = numbers.iter().map(|number| digits(*number)).collect();
    format!("[{}]", digits.join(", "))
}

/// What was found by kind, one line each, then the findings themselves.
fn findings(inspection: &Inspection) -> String {
    let mut lines = vec![format!("{:<10} {}", "findings", inspection.findings.len())];
    for kind in &inspection.summary {
        let label = if kind.matters { "matters" } else { "harmless" };
        lines.push(format!("{label:<10} {kind}"));
    }
    lines.extend(inspection.summary.iter().flat_map(|kind| of_kind(kind, &inspection.findings)));
    lines.join("\n") + "\n"
}

/// The first findings of a kind, and how many more there are.
fn of_kind(summary: &KindSummary, all: &[Finding]) -> Vec<String> {
    let here = all.iter().filter(|finding| finding.kind == summary.kind);
    let mut lines: Vec<String> = here.take(FINDINGS).map(detail).collect();
    if let Some(more) = summary.count.checked_sub(FINDINGS).filter(|more| *more > 0) {
        lines.push(format!(
            "{:<10} {}: {more} more; --json lists them",
            "finding",
            json::word(&summary.kind)
        ));
    }
    lines
}

/// A finding on a line.
fn detail(finding: &Finding) -> String {
    let who = names(&finding.patches);
    let gap = if who.is_empty() { "" } else { ": " };
    let (kind, what, repair) = (json::word(&finding.kind), &finding.what, &finding.repair);
    format!("{:<10} {kind}: {who}{gap}{what}; repair: {repair}", "finding")
}

/// The first names, and how many more there are.
fn names(patches: &[String]) -> String {
    let listed = patches[..patches.len().min(NAMES)].join(", ");
    match patches.len().saturating_sub(NAMES) {
        0 => listed,
        more => format!("{listed} and {more} more"),
    }
}

fn openness(inspection: &Inspection) -> String {
    match &inspection.opening {
        None => "no patch to look from".to_owned(),
        Some(_) if inspection.closed => "closed: no view from a patch leaves the scene".to_owned(),
        Some(opening) if opening.share < 0.0 => {
            format!("overlapping: {} sees {:.3} % twice", opening.patch, -100.0 * opening.share)
        }
        Some(opening) => {
            format!(
                "open: {:.3} % of the view from {} leaves the scene or ends on a back",
                100.0 * opening.share,
                opening.patch
            )
        }
    }
}
