//! The named cases of `tests/corpus`: one JSON file each.
//!
//! ```json
//! {
//!   "name": "what it is about",
//!   "source": "where it comes from",
//!   "a": { "rule": "even-odd", "rings": [[[0, 0], [2, 0], [1, 1]]] },
//!   "b": { "rule": "non-zero", "rings": [] },
//!   "areas": { "union": 1, "intersection": 0, "difference": 1, "symmetric_difference": 1 }
//! }
//! ```
//!
//! Areas are the doubles nearest to the exact ones; rules are `even-odd`, `non-zero` and `positive`.
use crate::Ring;
use crate::generators::Pair;
use crate::oracle::{Operand, Operation, Rule};
use glam::DVec2;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A named case.
#[derive(Clone, Debug)]
pub struct Case {
    /// The operands; the pair's name is the case's.
    pub pair: Pair,
    /// Where it comes from.
    pub source: String,
    /// Area of each operation, in the order of [`Operation::ALL`].
    pub areas: [f64; 4],
}

/// All cases, by file name. Errors name the file and what is wrong in it.
pub fn read() -> Result<Vec<Case>, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "json"));
    paths.sort();
    paths.iter().map(|p| read_case(p).map_err(|e| format!("{}: {e}", p.display()))).collect()
}

fn read_case(path: &Path) -> Result<Case, String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let value: Value = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    let text_of = |key: &str| value[key].as_str().map(str::to_owned).ok_or(format!("no text \"{key}\""));
    let pair = Pair { name: text_of("name")?, a: operand(&value["a"])?, b: operand(&value["b"])? };
    let mut areas = [0.0; 4];
    for (area, operation) in areas.iter_mut().zip(Operation::ALL) {
        *area = number(&value["areas"][column(operation)])?;
    }
    Ok(Case { pair, source: text_of("source")?, areas })
}

/// The name of an operation's area in a file.
pub fn column(operation: Operation) -> &'static str {
    match operation {
        Operation::Union => "union",
        Operation::Intersection => "intersection",
        Operation::Difference => "difference",
        Operation::SymmetricDifference => "symmetric_difference",
    }
}

fn operand(value: &Value) -> Result<Operand, String> {
    let rule = match value["rule"].as_str() {
        Some("even-odd") => Rule::EvenOdd,
        Some("non-zero") => Rule::NonZero,
        Some("positive") => Rule::Positive,
        other => return Err(format!("no rule {other:?}")),
    };
    let rings = list(&value["rings"])?.iter().map(ring).collect::<Result<_, _>>()?;
    Ok(Operand { rings, rule })
}

fn ring(value: &Value) -> Result<Ring, String> {
    list(value)?.iter().map(|p| Ok(DVec2::new(number(&p[0])?, number(&p[1])?))).collect()
}

fn list(value: &Value) -> Result<&Vec<Value>, String> {
    value.as_array().ok_or(format!("not a list: {value}"))
}

fn number(value: &Value) -> Result<f64, String> {
    value.as_f64().ok_or(format!("not a number: {value}"))
}
