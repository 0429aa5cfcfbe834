//! Park.
fn main() {}
