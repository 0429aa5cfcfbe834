//! How long this process has computed.
use std::time::{SystemTime, UNIX_EPOCH};

/// The seconds that all threads of this process have computed; on other systems than Linux those since 1970.
#[must_use]
pub fn cpu_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = |field: &str| field.parse::<f64>().ok();
    let fields = || stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    match (fields().nth(11).and_then(ticks), fields().nth(12).and_then(ticks)) {
        (Some(user), Some(system)) => (user + system) / 100.0,
        _ => SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |since| since.as_secs_f64()),
    }
}
