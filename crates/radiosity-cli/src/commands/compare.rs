//! `radiosity compare`
use crate::failure::Failure;
use crate::messages::say;
use crate::outputs::print;
use crate::{input, json};
use clap::Args;
use radiosity::compare::{Comparison, compare};
use std::fmt::Write;
use std::{path::PathBuf, process::ExitCode};

/// What `--fail-above` ends with.
const ABOVE: u8 = 5;

/// `radiosity compare`
#[derive(Args, Debug)]
pub(crate) struct Compare {
    /// A solution: a .json file of solve
    a: PathBuf,
    /// The reference: another solution of the same scene, with any mesh
    b: PathBuf,
    /// Exit with code 5 when a norm in a band is above this; 0 demands the same light
    #[arg(long, value_name = "SHARE", value_parser = share)]
    fail_above: Option<f64>,
    /// Print JSON instead of text; an infinite norm is null
    #[arg(long)]
    json: bool,
}

/// A finite number, 0 too.
fn share(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if number >= 0.0 && number.is_finite() {
        Ok(number)
    } else {
        Err("give 0 or a finite number above 0".to_owned())
    }
}

/// Prints how far two solutions are from each other.
pub(crate) fn run(arguments: &Compare) -> Result<ExitCode, Failure> {
    let (a, b) = (input::solution(&arguments.a)?, input::solution(&arguments.b)?);
    let names = format!("{}, {}", arguments.a.display(), arguments.b.display());
    let comparison = compare(&a, &b).map_err(|unlike| Failure::scene(format!("{names}: {unlike}")))?;
    print(&if arguments.json { json::line(&comparison) } else { text(&comparison) })?;
    let above = arguments.fail_above.filter(|most| comparison.largest() > *most);
    Ok(match above {
        Some(most) => {
            say!("{:.3e} is above {most:.3e}", comparison.largest());
            ExitCode::from(ABOVE)
        }
        None => ExitCode::SUCCESS,
    })
}

/// Lines for people.
fn text(comparison: &Comparison) -> String {
    let mut text = format!("{:>4} {:>10} {:>10} {:>10}\n", "band", "L1", "L2", "max");
    for (band, off) in comparison.bands.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{band:>4} {:>10.3e} {:>10.3e} {:>10.3e}", off.l1, off.l2, off.max);
    }
    if let Some(worst) = &comparison.worst {
        let [x, y, z] = worst.place.to_array();
        let _ = writeln!(
            text,
            "worst: element {} of {} at {x:.4} {y:.4} {z:.4}, band {}: {:.6e} against {:.6e} W/m²",
            worst.element, worst.patch, worst.band, worst.a, worst.b
        );
    }
    if !comparison.same_mesh {
        text += "the meshes differ: each element is compared with all elements that it overlaps\n";
    }
    text
}
