//! Any bytes as a state, their checksum put right: refused, or a state that is written as it was read.
#![no_main]
use fuzz::within_memory;
use libfuzzer_sys::fuzz_target;
use radiosity::State;

fuzz_target!(|body: &[u8]| {
    let name = name();
    assert!(body.starts_with(&name) || State::from_bytes(body).is_err(), "a state without its name");
    let bytes = [&name, &fnv1a(body).to_le_bytes()[..], body].concat();
    if let Ok(state) = within_memory(bytes.len(), || State::from_bytes(&bytes)) {
        let written = state.to_bytes();
        let again = State::from_bytes(&written).expect("what was written");
        assert_eq!(again.to_bytes(), written);
    }
});

/// What every state of this version starts with.
fn name() -> Vec<u8> {
    let mut bytes = State::default().to_bytes();
    bytes.truncate(bytes.iter().position(|byte| *byte == b'\n').expect("a line") + 1);
    bytes
}

/// Fowler, Noll and Vo's hash, 64 bits.
fn fnv1a(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}
