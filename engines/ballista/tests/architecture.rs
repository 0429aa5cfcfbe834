//! Imports run one way, and no two types have one name.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{complaints, shared_names};
use std::path::Path;

/// The programs take everything from the library, and nothing from one another.
const ORDER: [&str; 2] = ["bin/polycsg-executor", "bin/polycsg-scheduler"];

#[test]
fn imports_run_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    assert_eq!(complaints(&src, &ORDER), Vec::<String>::new());
    assert_eq!(shared_names(&src), Vec::<String>::new());
}
