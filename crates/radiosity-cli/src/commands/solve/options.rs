//! The options of `radiosity solve`, and those of the solver that they lead to.
use super::lights::LightOptions;
use crate::failure::Failure;
use crate::input::Reading;
use crate::outputs::is_stream;
use crate::parse::{count, positive, share};
use crate::view_options::ViewOptions;
use clap::{Args, ValueEnum};
use radiosity::Options;
use std::path::{Path, PathBuf};

/// `radiosity solve`
#[derive(Args, Debug)]
pub(crate) struct Solve {
    /// The scene: a COLLADA (.dae), glTF (.gltf, .glb), OBJ (.obj), PLY (.ply), STL (.stl) or View3D (.vs3) file; - for standard input
    pub(super) scene: PathBuf,
    #[command(flatten)]
    pub(super) reading: Reading,
    /// Write the result to this file, in the format of its extension: a picture (.png; .exr or .hdr without exposure), a scene (.dae, .glb,
    /// .obj, .ply), a page (.html), everything (.json), a table of patches (.csv) or of elements (.elements.csv); - for stdout; may be given
    /// several times
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// What -o - writes: an extension as above
    #[arg(long, value_name = "EXTENSION", default_value = "json")]
    pub(super) format: String,
    /// Print the result's figures on stdout as JSON
    #[arg(long)]
    pub(super) json: bool,
    /// How fine and how exact the result is
    #[arg(long, value_enum, default_value_t = Quality::Normal)]
    pub(super) quality: Quality,
    /// About how many elements to cut the scene into; a mesh is solved for then [default: by quality]
    #[arg(long, value_name = "N", value_parser = count)]
    pub(super) elements: Option<usize>,
    /// How often to refine the mesh where the light is not resolved; 0: equal elements [default: by quality]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=4))]
    pub(super) passes: Option<u8>,
    /// The norm that tells where the light is not resolved [default: l2]
    #[arg(long, value_enum)]
    pub(super) norm: Option<Norm>,
    /// How many of the strongest emitters get element edges along the edges of their shadows [default: by quality]
    #[arg(long, value_name = "EMITTERS")]
    pub(super) shadows: Option<u8>,
    /// The method of solution
    #[arg(long, value_enum, default_value_t = Method::Auto)]
    pub(super) method: Method,
    /// Stop when the bound on the error of every radiosity, as a solution of the discrete system, is at most this share of the reflected
    /// light's brightness; no form factor is taken roughly then [default: by quality]
    #[arg(long, value_name = "SHARE", value_parser = positive)]
    pub(super) tolerance: Option<f64>,
    /// What the mean irradiance of each patch may be off by, as a share like 0.01 or 1% of itself or of 1 % of the scene's mean; of more than
    /// 300 patches those below 1e-4 of the area, 5 % of it at most, may be further off; the scene is solved by levels then [default: by quality]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pub(super) error: Option<f64>,
    /// Find the light for the camera of the picture, see --camera: what it sees is within --error, the rest as far as that matters to what
    /// it sees; the scene is solved by levels then
    #[arg(long)]
    pub(super) for_camera: bool,
    /// Split a piece while its power deviates from a uniform piece by more than this share of all power [default: by quality]
    #[arg(long, value_name = "SHARE", value_parser = positive)]
    pub(super) spread: Option<f64>,
    /// Take form factors from hemicubes of N × N cells instead of exact ones, to compare
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=4096))]
    pub(super) hemicube: Option<u32>,
    /// Stop shooting after this many shots [default: 1000000]
    #[arg(long, value_name = "N")]
    pub(super) max_shots: Option<usize>,
    /// Stop after this many seconds; where a final gather shows the light, it takes half of them at most [default: 55 at draft]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub(super) time: Option<f64>,
    /// Resume from the state that a stopped run of the same scene wrote
    #[arg(long, value_name = "FILE")]
    pub(super) resume: Option<PathBuf>,
    /// Write all outputs and the state whenever this many seconds have passed; the state stands beside the first output
    #[arg(long, value_name = "SECONDS", value_parser = positive, requires = "output")]
    pub(super) snapshot_every: Option<f64>,
    /// Write the bound and the ledger of every step as CSV
    #[arg(long, value_name = "FILE")]
    pub(super) steps: Option<PathBuf>,
    /// Keep the steps of the run in the page (.html) and in .json, to walk through them: who shoots, each reflection, each round of links
    #[arg(long, requires = "output")]
    pub(super) record: bool,
    #[command(flatten)]
    pub(super) lights: LightOptions,
    #[command(flatten)]
    pub(super) view: ViewOptions,
}

/// `--quality`
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Quality {
    /// A first look: an error of 3 %; on a mesh 1500 equal elements and a bound of 1 % on light unshot, with 0.3 % of what each
    /// element sees taken roughly unless --tolerance is given
    Draft,
    /// For pictures: an error of 1 %; on a mesh 6000 elements, half of them where the light changes most, a bound of 0.1 %
    Normal,
    /// For figures and close views: an error of 0.3 %; on a mesh 20 000 elements, shadow edges along element edges, a bound of
    /// 0.1 %
    High,
}

/// `--norm`
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Norm {
    /// The largest difference between corners of an element
    Gradient,
    /// Power in the wrong place
    L1,
    /// Squared difference: what the eye sees
    L2,
    /// The worst place
    Linf,
}

/// `--method`
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Method {
    /// `hierarchical` for scenes of at most 1000 patches, those of a plane that are alike as one, and with `--error`; else `mesh`, and with an option of meshes
    Auto,
    /// By levels: light goes between parts of patches as large as `--error` allows, and each patch gets an estimate of its error
    Hierarchical,
    /// On a mesh of `--elements`: `cg` where a closed room reflects 0.9 of its light or more, else `shoot`
    Mesh,
    /// Progressive refinement: the piece with the most unshot light shoots it, again and again
    Shoot,
    /// Gaussian elimination on the full matrix, for checks with up to a few thousand elements
    Matrix,
    /// Conjugate gradients on symmetric exchange areas: for bright closed rooms
    Cg,
    /// GMRES on unscaled form factors
    Gmres,
}

/// The first of the given options that only meshes have.
fn of_meshes(arguments: &Solve) -> Option<&'static str> {
    let options = [
        ("--elements", arguments.elements.is_some()),
        ("--passes", arguments.passes.is_some()),
        ("--norm", arguments.norm.is_some()),
        ("--shadows", arguments.shadows.is_some()),
        ("--spread", arguments.spread.is_some()),
        ("--hemicube", arguments.hemicube.is_some()),
        ("--max-shots", arguments.max_shots.is_some()),
    ];
    options.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
}

/// The first of the given options that only levels have.
fn of_levels(arguments: &Solve) -> Option<&'static str> {
    let options = [("--error", arguments.error.is_some()), ("--for-camera", arguments.for_camera)];
    options.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
}

/// The method that the options ask for; refuses those that it would have to ignore.
fn method(arguments: &Solve) -> Result<radiosity::Method, Failure> {
    match (arguments.method, of_meshes(arguments), of_levels(arguments)) {
        (Method::Hierarchical, Some(name), _) => Err(Failure::usage(format!(
            "{name} has no meaning with --method hierarchical, which cuts patches by --error"
        ))),
        (Method::Auto, Some(name), Some(other)) => Err(Failure::usage(format!(
            "{name} and {other} do not go together: {name} is of meshes, whose error is not known; leave out one of them"
        ))),
        (Method::Mesh | Method::Shoot | Method::Matrix | Method::Cg | Method::Gmres, _, Some(name)) => {
            Err(Failure::usage(format!(
                "{name} needs --method hierarchical: the other methods do not know their errors"
            )))
        }
        (Method::Auto, None, Some(_)) | (Method::Hierarchical, None, _) => {
            Ok(radiosity::Method::Hierarchical)
        }
        (Method::Auto, None, None) => Ok(radiosity::Method::Auto),
        (Method::Auto, Some(_), _) | (Method::Mesh, ..) => Ok(radiosity::Method::Mesh),
        (Method::Shoot, ..) => Ok(radiosity::Method::Shoot),
        (Method::Matrix, ..) => Ok(radiosity::Method::Matrix),
        (Method::Cg, ..) => Ok(radiosity::Method::Cg),
        (Method::Gmres, ..) => Ok(radiosity::Method::Gmres),
    }
}

/// A draft is there within a minute.
const DRAFT_SECONDS: f64 = 55.0;

impl Solve {
    /// Where the state goes: beside the first output that is a file.
    pub(super) fn state(&self) -> Option<PathBuf> {
        self.output.iter().find_map(|path| state_beside(path))
    }

    /// After how many seconds the run stops.
    pub(super) fn seconds(&self) -> Option<f64> {
        self.time.or(matches!(self.quality, Quality::Draft).then_some(DRAFT_SECONDS))
    }
}

/// Where the state of an output goes; nowhere beside what is no file (stdout, a pipe).
pub(super) fn state_beside(output: &Path) -> Option<PathBuf> {
    let mut name = output.to_owned().into_os_string();
    name.push(".state");
    let is_file = !is_stream(output) && (!output.exists() || output.is_file());
    is_file.then(|| name.into())
}

/// The options of the solver.
///
/// # Errors
/// Options that the method would have to ignore.
pub(super) fn options(arguments: &Solve) -> Result<Options, Failure> {
    let method = method(arguments)?;
    let by_quality = match arguments.quality {
        Quality::Draft => radiosity::Quality::Draft,
        Quality::Normal => radiosity::Quality::Normal,
        Quality::High => radiosity::Quality::High,
    };
    let norm = match arguments.norm.unwrap_or(Norm::L2) {
        Norm::Gradient => radiosity::Norm::Gradient,
        Norm::L1 => radiosity::Norm::L1,
        Norm::L2 => radiosity::Norm::L2,
        Norm::Linf => radiosity::Norm::LInfinity,
    };
    let given = by_quality.options();
    Ok(Options {
        method,
        norm,
        elements: arguments.elements.unwrap_or(given.elements),
        passes: arguments.passes.map_or(given.passes, usize::from),
        shadows: arguments.shadows.map_or(given.shadows, usize::from),
        tolerance: arguments.tolerance.unwrap_or(given.tolerance),
        error: arguments.error.unwrap_or(given.error),
        for_camera: None,
        // Whoever says how good the bound is to be gets one as good.
        rough: if arguments.tolerance.is_some() { 0.0 } else { given.rough },
        spread: arguments.spread.unwrap_or(given.spread),
        hemicube: arguments.hemicube,
        gather: given.gather,
        record: arguments.record,
        max_shots: arguments.max_shots.unwrap_or(given.max_shots),
        max_seconds: arguments.seconds(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        solve: Solve,
    }

    #[test]
    fn a_draft_stops_within_a_minute_unless_a_time_is_given() {
        let seconds = |line: &str| Line::parse_from(line.split(' ')).solve.seconds();
        assert_eq!(seconds("solve a.dae --quality draft"), Some(55.0));
        assert_eq!(seconds("solve a.dae --quality draft --time 5"), Some(5.0));
        assert_eq!(seconds("solve a.dae --quality draft --time 500"), Some(500.0));
        assert_eq!(seconds("solve a.dae"), None);
        assert_eq!(seconds("solve a.dae --quality high"), None);
    }
}
