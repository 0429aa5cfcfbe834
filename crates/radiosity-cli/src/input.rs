//! Scenes and solutions from files, or from standard input.
use crate::failure::Failure;
use crate::messages::say;
use crate::waiting::wait;
use clap::Args;
use radiosity::inspect::{Finding, KindSummary, in_one_line, summary};
use radiosity::{Record, Repaired, Scene, io::Source, needed_sides, one_sided, repair};
use serde::Deserialize;
use std::{io::Read, path::Path};

/// The name that stands for standard input and output.
pub(crate) const STREAM: &str = "-";

/// What is not there when the time is up.
const UNREAD: &str = "the scene was read";

/// How scenes are read for a solution.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct Reading {
    /// Refuse a scene whose surfaces need repair, and list what is wrong with them, instead of repairing them
    #[arg(long)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) sides: Sides,
}

/// Which sides of surfaces are read.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct Sides {
    /// Take the fronts of double-sided materials alone
    #[arg(long)]
    pub(crate) one_sided: bool,
}

/// A scene that can be solved, its file, and what was repaired.
#[derive(Debug)]
pub(crate) struct RepairedInput {
    pub(crate) scene: Scene,
    pub(crate) source: Source,
    pub(crate) repairs: Vec<KindSummary>,
}

/// Reads a scene, lets `light` light it, and repairs it; prints what the reader had to say on stderr, and in a line what was repaired. It is
/// no longer waited for when it `is_late`.
pub(crate) fn read_repaired(
    path: &Path,
    reading: Reading,
    light: impl FnOnce(&mut Scene) -> Result<(), Failure> + Send + 'static,
    is_late: impl Fn() -> bool,
) -> Result<RepairedInput, Failure> {
    let file = path.to_owned();
    let work = move || {
        let (mut scene, source) = scene_and_source(&file)?;
        if scene.patches.is_empty() {
            return Err(without_patches(&file, &scene));
        }
        light(&mut scene)?;
        Ok((repair(&reading.sides.of(&scene)), source))
    };
    let (Repaired { scene, repairs, .. }, source) = wait(work, is_late, UNREAD)?;
    if reading.strict && !repairs.is_empty() {
        return Err(refusal(path, &repairs));
    }
    let notes = scene.warnings.iter().filter(|warning| warning.kind.remedy().is_none()).cloned();
    tell(path, &notes.collect::<Vec<_>>());
    let repairs = summary(&repairs);
    if !repairs.is_empty() {
        say!("warning: repaired: {}; inspect lists them, --strict refuses them", counts(&repairs));
    }
    Ok(RepairedInput { scene, source, repairs })
}

/// Why a scene without patches is refused: what the reader had to say may be the cause.
fn without_patches(path: &Path, scene: &Scene) -> Failure {
    let notes = in_one_line(&scene.warnings).map(|line| format!(" ({line})")).unwrap_or_default();
    Failure::scene(format!("{}: {}{notes}", path.display(), radiosity::Error::NoPatches))
}

/// One line on stderr for all that the reader had to say.
fn tell(path: &Path, notes: &[Finding]) {
    if let Some(line) = in_one_line(notes) {
        let more = match notes {
            [_] => String::new(),
            _ => format!("; `radiosity inspect {}` says where, and what to do", path.display()),
        };
        say!("warning: {line}{more}");
    }
}

impl Sides {
    /// The scene with the sides that are asked for.
    pub(crate) fn of(self, scene: &Scene) -> Scene {
        if self.one_sided { one_sided(scene) } else { needed_sides(scene) }
    }
}

/// All findings at once.
pub(crate) fn refusal(path: &Path, repairs: &[Finding]) -> Failure {
    let line = |finding: &Finding| {
        let names = finding.patches.join(", ");
        let gap = if names.is_empty() { "" } else { ": " };
        format!("\n  {names}{gap}{finding}")
    };
    let (kinds, lines) = (summary(repairs), repairs.iter().map(line).collect::<String>());
    let counts: Vec<String> = kinds.iter().map(KindSummary::counted).collect();
    Failure::scene(format!(
        "{}: {}; leave out --strict to have them repaired{lines}",
        path.display(),
        counts.join(", ")
    ))
}

/// How many of each kind, and what became of them.
pub(crate) fn counts(repairs: &[KindSummary]) -> String {
    let count = |kind: &KindSummary| format!("{} {}", kind.counted(), kind.remedy.unwrap_or_default());
    repairs.iter().map(count).collect::<Vec<_>>().join(", ")
}

/// Reads a scene, makes something `more` of it, and prints what the reader had to say on stderr. It is no longer waited for when it `is_late`.
pub(crate) fn read<T: Send + 'static>(
    path: &Path,
    more: impl FnOnce(&Scene) -> T + Send + 'static,
    is_late: impl Fn() -> bool,
) -> Result<(Scene, Source, T), Failure> {
    let read = read_quietly(path, more, is_late)?;
    tell(path, &read.0.warnings);
    Ok(read)
}

/// Reads a scene, and makes something `more` of it; what the reader had to say stays in the scene. It is no longer waited for when it
/// `is_late`.
pub(crate) fn read_quietly<T: Send + 'static>(
    path: &Path,
    more: impl FnOnce(&Scene) -> T + Send + 'static,
    is_late: impl Fn() -> bool,
) -> Result<(Scene, Source, T), Failure> {
    let file = path.to_owned();
    let work = move || {
        let (scene, source) = scene_and_source(&file)?;
        let made = more(&scene);
        Ok((scene, source, made))
    };
    wait(work, is_late, UNREAD)
}

fn scene_and_source(path: &Path) -> Result<(Scene, Source), Failure> {
    let source = if path == Path::new(STREAM) {
        Source::from_bytes("standard input", bytes(path)?)?
    } else {
        Source::open(path)?
    };
    Ok((source.scene()?, source))
}

/// The bytes of a file, or of standard input.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = if path == Path::new(STREAM) {
        std::io::stdin().read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes))
    };
    match read {
        Ok(_) => Ok(bytes),
        Err(error) => {
            let name = path.display();
            Err(Failure::internal(format!("{name}: cannot be read: {error}; check its name")))
        }
    }
}

/// A solution's file as `solve` writes it; its other fields are for people and programs.
#[derive(Deserialize)]
struct WrittenSolution {
    light: Record,
}

/// Reads a written solution.
pub(crate) fn solution(path: &Path) -> Result<Record, Failure> {
    let name = path.display();
    let written: WrittenSolution = serde_json::from_slice(&bytes(path)?).map_err(|error| {
        Failure::scene(format!("{name}: not a solution: {error}; write one: solve SCENE -o FILE.json"))
    })?;
    written.light.check().map_err(|reason| Failure::scene(format!("{name}: {reason}; solve again")))?;
    Ok(written.light)
}
