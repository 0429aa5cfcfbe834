//! Any bytes as a document of GeoJSON: features, or a typed error that names the file. Features are the same when they are
//! written and read, and memory stays within a multiple of the file.
#![no_main]
use fuzz::within_memory;
use libfuzzer_sys::fuzz_target;
use polycsg_cli::fuzzing::Reader;

fuzz_target!(|bytes: &[u8]| {
    within_memory(bytes.len(), || Reader::GeoJson.survives(bytes));
});
