//! Any bytes as a EULUMDAT file: photometry that is finite and negative nowhere, or a typed error that names the line.
#![no_main]
use fuzz::{is_sound_photometry, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::photometry::parse_ldt;

fuzz_target!(|bytes: &[u8]| {
    match within_memory(bytes.len(), || parse_ldt("fuzz.ldt", bytes)) {
        Err(e) => assert!(e.to_string().contains("fuzz.ldt:"), "which line? {e}"),
        Ok(table) => is_sound_photometry(&table),
    }
});
