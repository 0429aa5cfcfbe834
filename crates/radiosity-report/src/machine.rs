//! Where the figures were measured.
use serde::Serialize;
use std::fs;

/// The machine and the versions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Machine {
    /// The processor's name, where the system tells it.
    pub(crate) processor: String,
    /// How many threads it runs at once.
    pub(crate) cores: usize,
    /// Operating system and architecture.
    pub(crate) system: String,
    /// This program's version.
    pub(crate) version: &'static str,
    /// Whether it was built with optimisation.
    pub(crate) optimised: bool,
}

impl Machine {
    /// The one that this runs on.
    pub(crate) fn here() -> Machine {
        let of = |path: &str, key: &str| {
            let text = fs::read_to_string(path).ok()?;
            let line = text.lines().find(|line| line.starts_with(key))?.to_owned();
            Some(line.split([':', '=']).nth(1)?.trim().trim_matches('"').to_owned())
        };
        let system = of("/etc/os-release", "PRETTY_NAME=").unwrap_or_else(|| std::env::consts::OS.to_owned());
        Machine {
            processor: of("/proc/cpuinfo", "model name").unwrap_or_else(|| "unknown processor".to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            system: format!("{system}, {}", std::env::consts::ARCH),
            version: env!("CARGO_PKG_VERSION"),
            optimised: !cfg!(debug_assertions),
        }
    }
}
