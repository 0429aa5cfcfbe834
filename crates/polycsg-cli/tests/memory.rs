//! What streams takes no more memory for a larger file.
#![cfg(target_os = "linux")]
mod program;

use program::Folder;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::process::{Command, Stdio};

/// Squares with a hole and some columns, so many bytes of them.
fn generated(folder: &Folder, name: &str, bytes: usize) -> String {
    let path = folder.path(name);
    let mut file = BufWriter::new(File::create(&path).expect("a file"));
    file.write_all(b"{\"type\":\"FeatureCollection\",\"features\":[\n").expect("written");
    let (mut count, mut written) = (0_u32, 0);
    while written < bytes {
        let (x, y) = (f64::from(count % 1000) * 1.1, f64::from(count / 1000) * 1.1);
        let ring = |low: f64, high: f64| {
            let [a, b, c, d] = [x + low, y + low, x + high, y + high];
            format!("[[{a},{b}],[{c},{b}],[{c},{d}],[{a},{d}],[{a},{b}]]")
        };
        let comma = if count == 0 { "" } else { ",\n" };
        let feature = format!(
            "{comma}{{\"type\":\"Feature\",\"properties\":{{\"n\":{count},\"name\":\"house {count}\"}},\"geometry\":{{\
             \"type\":\"Polygon\",\"coordinates\":[{},{}]}}}}",
            ring(0.0, 1.0),
            ring(0.3, 0.6)
        );
        file.write_all(feature.as_bytes()).expect("written");
        written += feature.len();
        count += 1;
    }
    file.write_all(b"\n]}\n").expect("written");
    file.flush().expect("written");
    path
}

/// The most memory that a run has taken, in bytes.
fn peak(arguments: &[&str]) -> usize {
    let mut command = Command::new(env!("CARGO_BIN_EXE_polycsg"));
    let mut child = command
        .args(arguments)
        .args(["-j", "2"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    let mut most = 0;
    loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.trim().parse::<usize>().ok());
        most = most.max(kilobytes.unwrap_or_default());
        if let Some(status) = child.try_wait().expect("a child") {
            assert!(status.success(), "{arguments:?}");
            return most * 1024;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
}

#[test]
fn what_streams_takes_no_more_memory_for_a_larger_file() {
    let folder = Folder::new();
    let mask = folder.put(
        "mask.geojson",
        r#"{"type":"Polygon","coordinates":[[[-1,-1],[900.05,-1],[900.05,500],[-1,500],[-1,-1]]]}"#,
    );
    let [small, large] = [("small.geojson", 6 << 20), ("large.geojson", 36 << 20)]
        .map(|(name, bytes)| generated(&folder, name, bytes));
    let [small_file, large_file] =
        [("small.parquet", &small), ("large.parquet", &large)].map(|(name, from)| {
            let file = folder.path(name);
            peak(&["repair", from, "-o", &file]);
            file
        });
    let out = folder.path("out.parquet");
    for (command, more) in [
        ("clip", vec!["--by", &mask, "-o", &out]),
        ("overlay", vec![&mask, "--op", "intersection", "-o", &out]),
        ("overlay", vec![&mask, "--op", "difference", "-o", &out]),
        ("repair", vec!["-o", &out]),
        ("validate", vec![]),
        ("area", vec![]),
    ] {
        for [small, large] in [[&small, &large], [&small_file, &large_file]] {
            let [little, much] = [small, large].map(|file| peak(&[&[command, file], &more[..]].concat()));
            // The files differ by 30 MB of text, and by more as features.
            assert!(
                much < little + (20 << 20),
                "{command} {large}: {little} bytes, and {much} of a larger one"
            );
        }
    }
}
