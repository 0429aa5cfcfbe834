//! What is said on stderr.
use std::fmt::Arguments;
use std::io::Write;

/// Says a line on stderr, formatted as `println!` does.
macro_rules! say {
    ($($message:tt)*) => { $crate::messages::write(format_args!($($message)*)) };
}
pub(crate) use say;

/// Writes a line. One that cannot be written is let go, where `eprintln!` would panic: a closed or full stderr costs no result.
pub(crate) fn write(message: Arguments<'_>) {
    let _ = std::io::stderr().write_all(format!("{message}\n").as_bytes());
}
