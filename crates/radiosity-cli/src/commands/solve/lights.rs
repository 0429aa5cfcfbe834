//! Lights that the command line adds to a scene.
use crate::failure::Failure;
use crate::messages::say;
use crate::parse::strength;
use clap::{Args, ValueEnum};
use radiosity::io::photometry;
use radiosity::{Distribution, Scene, Sky, SkyKind, Solution, Units};
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    str::FromStr,
    sync::Arc,
};

/// How many names an error lists.
const NAMES: usize = 12;

/// Options of lights.
#[derive(Args, Clone, Debug)]
pub(super) struct LightOptions {
    /// The sky: uniform or overcast, with the radiance L of its zenith where that is not 1, or none. A scene without any light gets
    /// `uniform` if this is not given
    #[arg(long, value_name = "KIND[=L]")]
    sky: Option<SkyOption>,
    /// Let a material emit the radiance L, of all bands or of each: a lamp that the file lacks; may be given several times
    #[arg(long, value_name = "MATERIAL=L[,L,L]")]
    emit: Vec<Emit>,
    /// Let a lamp of the file shine as an IES (.ies) or EULUMDAT (.ldt) file says; may be given several times
    #[arg(long, value_name = "LAMP=FILE")]
    photometry: Vec<LampFile>,
    /// What powers are counted in, in the file, above, and in the result: watts, or lumens (candela and lux); lx stand beside both
    /// [default: as the file says, else w]
    #[arg(long, value_enum)]
    units: Option<UnitOption>,
}

/// `--units`
#[derive(Clone, Copy, Debug, ValueEnum)]
enum UnitOption {
    /// Watts, of which white light has 179 lm each
    W,
    /// Lumens
    Lm,
}

/// `--sky`
#[derive(Clone, Copy, Debug)]
struct SkyOption {
    kind: Option<SkyKind>,
    radiance: f64,
}

/// `--emit`
#[derive(Clone, Debug)]
struct Emit {
    material: String,
    radiance: Vec<f64>,
}

/// `--photometry`
#[derive(Clone, Debug)]
struct LampFile {
    lamp: String,
    file: PathBuf,
}

impl FromStr for SkyOption {
    type Err = String;

    fn from_str(text: &str) -> Result<SkyOption, String> {
        let (name, radiance) = text.split_once('=').unwrap_or((text, "1"));
        let kind = match name {
            "uniform" => Some(SkyKind::Uniform),
            "overcast" => Some(SkyKind::Overcast),
            "none" => None,
            _ => return Err("give uniform, overcast or none".to_owned()),
        };
        Ok(SkyOption { kind, radiance: strength(radiance)? })
    }
}

impl FromStr for Emit {
    type Err = String;

    fn from_str(text: &str) -> Result<Emit, String> {
        let (material, values) = text.rsplit_once('=').ok_or("give MATERIAL=L")?;
        let radiance = values.split(',').map(strength).collect::<Result<_, _>>()?;
        Ok(Emit { material: material.to_owned(), radiance })
    }
}

impl FromStr for LampFile {
    type Err = String;

    fn from_str(text: &str) -> Result<LampFile, String> {
        let (lamp, file) = text.rsplit_once('=').ok_or("give LAMP=FILE")?;
        Ok(LampFile { lamp: lamp.to_owned(), file: file.into() })
    }
}

impl LightOptions {
    /// The files that are read.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        self.photometry.iter().map(|lamp| lamp.file.as_path())
    }
}

/// Adds the lights that are asked for, and a sky where there is no light at all.
pub(super) fn light(scene: &mut Scene, options: &LightOptions) -> Result<(), Failure> {
    if let Some(units) = options.units {
        scene.units = match units {
            UnitOption::W => Units::Radiant,
            UnitOption::Lm => Units::Luminous,
        };
    }
    options.emit.iter().try_for_each(|emit| emit.apply(scene))?;
    options.photometry.iter().try_for_each(|lamp| lamp.apply(scene))?;
    match options.sky {
        Some(SkyOption { kind, radiance }) => {
            scene.sky = kind.map(|kind| Sky { radiance: vec![radiance; scene.bands], kind });
        }
        None if !scene.has_light() => {
            scene.sky = Some(Sky { radiance: vec![1.0; scene.bands], kind: SkyKind::Uniform });
            say!(
                "warning: nothing in the scene gives light: a uniform sky of radiance 1 lights it; {}",
                of_lamps(scene)
            );
        }
        None => {}
    }
    Ok(())
}

/// Says so where lights reach no surface. A run that was stopped may not have looked yet.
pub(super) fn warn_of_darkness(scene: &Scene, solution: &Solution) {
    if solution.converged && solution.ledger.emitted.iter().all(|power| *power == 0.0) {
        say!("warning: no light reaches any surface, so the scene is dark; {}", of_lamps(scene));
    }
}

/// How a scene gets lamps.
fn of_lamps(scene: &Scene) -> &'static str {
    if scene.patches.iter().any(|patch| !patch.material.is_empty()) {
        "a material emits by --emit MATERIAL=L, another sky shines by --sky KIND=L"
    } else {
        "another sky shines by --sky KIND=L; lamps take a file with materials (.dae, .glb, or .obj with .mtl): this one has none"
    }
}

impl Emit {
    fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        let Emit { material, radiance } = self;
        let bands = match radiance.as_slice() {
            [even] => vec![*even; scene.bands],
            bands if bands.len() == scene.bands => bands.to_vec(),
            bands => {
                return Err(Failure::usage(format!(
                    "--emit {material}: {} values for {} bands; give one, or one for each",
                    bands.len(),
                    scene.bands
                )));
            }
        };
        let mut is_found = false;
        for patch in scene.patches.iter_mut().filter(|patch| *patch.material == **material) {
            patch.emission.clone_from(&bands);
            is_found = true;
        }
        let names = scene.patches.iter().map(|patch| &*patch.material);
        if is_found { Ok(()) } else { Err(unknown("--emit", "material", material, names)) }
    }
}

impl LampFile {
    fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        let table = Arc::new(photometry::open(&self.file)?);
        let intensity = vec![scene.white(); scene.bands];
        let mut is_found = false;
        for lamp in scene.lamps.iter_mut().filter(|lamp| lamp.name == self.lamp) {
            lamp.distribution = Distribution::Measured(table.clone());
            lamp.intensity.clone_from(&intensity);
            is_found = true;
        }
        let names = scene.lamps.iter().map(|lamp| lamp.name.as_str());
        if is_found { Ok(()) } else { Err(unknown("--photometry", "lamp", &self.lamp, names)) }
    }
}

/// A name that the scene does not have, with those that it has.
fn unknown<'n>(option: &str, kind: &str, name: &str, known: impl Iterator<Item = &'n str>) -> Failure {
    let known: BTreeSet<&str> = known.filter(|name| !name.is_empty()).collect();
    let mut listed: Vec<&str> = known.iter().take(NAMES).copied().collect();
    if known.len() > NAMES {
        listed.push("…");
    }
    let have = if listed.is_empty() { "has none".to_owned() } else { format!("has {}", listed.join(", ")) };
    Failure::usage(format!("{option}: no {kind} is named {name:?}; the scene {have}"))
}
