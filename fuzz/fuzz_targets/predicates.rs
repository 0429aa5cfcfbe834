//! Every predicate against big integers, over the whole range of exponents and close to degeneracy.
#![no_main]
use arbitrary::Unstructured;
use libfuzzer_sys::fuzz_target;
use polycsg::fuzzing::check_predicates;

const MOST_CONFIGURATIONS: usize = 8;

fuzz_target!(|bytes: &[u8]| {
    let mut words = Unstructured::new(bytes);
    for _ in 0..MOST_CONFIGURATIONS {
        if words.is_empty() {
            break;
        }
        // Without bytes left, every word is 0.
        let checked = check_predicates(|| words.arbitrary().unwrap_or(0));
        checked.unwrap_or_else(|e| panic!("{e}"));
    }
});
