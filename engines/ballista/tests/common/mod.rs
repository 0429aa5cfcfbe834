//! Layers from TopoJSON, and a cluster of processes.
use serde_json::Value;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};

/// A feature's id and its polygons as WKB.
pub struct Feature {
    pub id: String,
    pub wkb: Vec<u8>,
}

/// The features of a layer of a TopoJSON file.
pub fn layer(file: &Path, name: &str) -> Vec<Feature> {
    let text = std::fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let topology: Value = serde_json::from_str(&text).expect("JSON");
    let arcs: Vec<Vec<[f64; 2]>> =
        topology["arcs"].as_array().expect("arcs").iter().map(|arc| decoded(arc, &topology)).collect();
    let geometries = topology["objects"][name]["geometries"].as_array().expect("geometries");
    let feature = |(number, geometry): (usize, &Value)| {
        let id = geometry["id"].as_str().map_or(number.to_string(), str::to_string);
        let polygons = match geometry["type"].as_str() {
            Some("Polygon") => vec![&geometry["arcs"]],
            Some("MultiPolygon") => geometry["arcs"].as_array().expect("parts").iter().collect(),
            _ => vec![],
        };
        Feature { id, wkb: wkb(&polygons, &arcs) }
    };
    geometries.iter().enumerate().map(feature).collect()
}

fn pair(value: &Value) -> [f64; 2] {
    [0, 1].map(|i| value[i].as_f64().expect("a number"))
}

/// Arcs are steps in whole numbers.
fn decoded(arc: &Value, topology: &Value) -> Vec<[f64; 2]> {
    let (scale, shift) = (pair(&topology["transform"]["scale"]), pair(&topology["transform"]["translate"]));
    let mut at = [0.0; 2];
    let step = |point: &Value| {
        let by = pair(point);
        at = [at[0] + by[0], at[1] + by[1]];
        [at[0] * scale[0] + shift[0], at[1] * scale[1] + shift[1]]
    };
    arc.as_array().expect("points").iter().map(step).collect()
}

fn wkb(polygons: &[&Value], arcs: &[Vec<[f64; 2]>]) -> Vec<u8> {
    let word = |count: usize| u32::try_from(count).expect("a small count").to_le_bytes();
    let mut bytes: Vec<u8> = [1].into_iter().chain(word(6)).chain(word(polygons.len())).collect();
    for rings in polygons {
        let rings = rings.as_array().expect("rings");
        bytes.extend([1].into_iter().chain(word(3)).chain(word(rings.len())));
        for ring in rings {
            let points = joined(ring, arcs);
            bytes.extend(word(points.len()));
            bytes.extend(points.iter().flatten().flat_map(|x| x.to_le_bytes()));
        }
    }
    bytes
}

/// A negative number is an arc that is run through backwards. Each arc starts where the one before ends.
fn joined(ring: &Value, arcs: &[Vec<[f64; 2]>]) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = vec![];
    for number in ring.as_array().expect("arcs").iter().map(|number| number.as_i64().expect("an index")) {
        points.pop();
        let at = |number: i64| &arcs[usize::try_from(number).expect("an index")];
        if number < 0 {
            points.extend(at(!number).iter().rev());
        } else {
            points.extend(at(number));
        }
    }
    points
}

/// A process that ends with the test.
pub struct Process(Child);

impl Process {
    /// Starts one of the two programs; what it says goes to a file.
    pub fn start(program: &str, arguments: &[String], log: &Path) -> Process {
        let log = File::create(log).expect("a log");
        // So executors tell the plans that they run.
        let level = "info,ballista_executor::execution_engine=debug";
        let started = Command::new(program)
            .env("RUST_LOG", level)
            .args(arguments)
            .stdout(log.try_clone().expect("a log"))
            .stderr(log)
            .spawn();
        Process(started.expect("the program starts"))
    }

    /// As a power cut does it.
    pub fn kill(&mut self) {
        self.0.kill().expect("it runs");
        self.0.wait().expect("it ended");
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// All files below a folder.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return vec![] };
    let below = |path: PathBuf| if path.is_dir() { files(&path) } else { vec![path] };
    entries.filter_map(Result::ok).flat_map(|entry| below(entry.path())).collect()
}

/// A port that nobody has.
pub fn free_port() -> u16 {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    listener.local_addr().expect("an address").port()
}
