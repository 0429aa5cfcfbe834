//! Any bytes as lines of WKB, or behind a zero as one geometry: features, or a typed error that names the file. Features are the same when they are
//! written and read, and memory stays within a multiple of the file.
#![no_main]
use fuzz::within_memory;
use libfuzzer_sys::fuzz_target;
use polycsg_cli::fuzzing::Reader;

fuzz_target!(|bytes: &[u8]| {
    let text = match bytes {
        [0, geometry @ ..] => {
            geometry.iter().map(|byte| format!("{byte:02x}")).collect::<String>().into_bytes()
        }
        lines => lines.to_vec(),
    };
    within_memory(text.len(), || Reader::Wkb.survives(&text));
});
