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
use crate::exact::nearest;
use crate::generators::Pair;
use crate::oracle::{Arrangement, Operand, Operation, Rule};
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
    let value = value(path)?;
    let mut areas = [0.0; 4];
    for (area, operation) in areas.iter_mut().zip(Operation::ALL) {
        *area = number(&value["areas"][column(operation)])?;
    }
    Ok(Case { pair: pair(&value)?, source: text_of(&value, "source")?, areas })
}

/// The operands of one file; what else it says, and whether, does not matter.
pub fn read_pair(path: &Path) -> Result<Pair, String> {
    value(path).and_then(|value| pair(&value)).map_err(|e| format!("{}: {e}", path.display()))
}

/// The named inputs of one file: a list of operands each.
pub fn read_inputs(path: &Path) -> Result<Vec<(String, Vec<Operand>)>, String> {
    let input = |value: &Value| {
        let operands = list(&value["operands"])?.iter().map(operand).collect::<Result<_, _>>()?;
        Ok((text_of(value, "name")?, operands))
    };
    list(&value(path)?)?.iter().map(input).collect()
}

fn value(path: &Path) -> Result<Value, String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    serde_json::from_str(&text).map_err(|e| e.to_string())
}

fn pair(value: &Value) -> Result<Pair, String> {
    Ok(Pair { name: text_of(value, "name")?, a: operand(&value["a"])?, b: operand(&value["b"])? })
}

fn text_of(value: &Value, key: &str) -> Result<String, String> {
    value[key].as_str().map(str::to_owned).ok_or(format!("no text \"{key}\""))
}

/// A pair as a file, its areas by the oracle.
pub fn written(pair: &Pair, source: &str) -> String {
    let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    let area = |operation: Operation| {
        format!("\"{}\": {:?}", column(operation), nearest(&arrangement.operation(operation).area()))
    };
    format!(
        "{{\n  \"name\": {},\n  \"source\": {},\n  \"a\": {},\n  \"b\": {},\n  \"areas\": {{{}}}\n}}\n",
        Value::from(pair.name.as_str()),
        Value::from(source),
        written_operand(&pair.a),
        written_operand(&pair.b),
        Operation::ALL.map(area).join(", ")
    )
}

fn written_operand(operand: &Operand) -> String {
    let rule = match operand.rule {
        Rule::EvenOdd => "even-odd",
        Rule::NonZero => "non-zero",
        Rule::Positive => "positive",
    };
    let point = |p: &DVec2| format!("[{:?}, {:?}]", p.x, p.y);
    let ring = |ring: &Ring| format!("\n      [{}]", ring.iter().map(point).collect::<Vec<_>>().join(", "));
    let rings = operand.rings.iter().map(ring).collect::<Vec<_>>().join(",");
    format!("{{ \"rule\": \"{rule}\", \"rings\": [{rings}\n    ] }}")
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
