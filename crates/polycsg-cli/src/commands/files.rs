//! Which files a command reads and writes, and in what format.
use crate::failure::Failure;
use crate::formats::reader::Source;
use crate::formats::{self, Format};
use crate::input::Input;
use crate::interrupt::Interrupt;
use crate::output::Output;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};

/// How inputs are read.
#[derive(Args, Debug)]
pub(crate) struct InputFormat {
    /// The format of the input [default: by the file's name]; of a second file only where its name tells none
    #[arg(long, value_enum, value_name = "FORMAT")]
    from: Option<Format>,
}

/// Where features are written.
#[derive(Args, Debug)]
pub(crate) struct OutputFile {
    /// The file to write, - for stdout
    #[arg(short, long, default_value = "-", value_name = "FILE")]
    output: PathBuf,
    /// The format of the output [default: by the file's name; on stdout that of the input]
    #[arg(long, value_enum, value_name = "FORMAT")]
    to: Option<Format>,
}

impl InputFormat {
    /// The format of an input.
    pub(crate) fn named(&self, path: &Path) -> Result<Format, Failure> {
        Format::named(path, self.from, "--from")
    }

    /// Opens a second layer, which has a format of its own where its name tells it.
    pub(crate) fn open_other(&self, path: &Path, interrupt: &Interrupt) -> Result<Box<dyn Source>, Failure> {
        let format = Format::of(path).map_or_else(|| self.named(path), Ok)?;
        formats::open(&Input::new(path, interrupt), format)
    }

    /// Opens a layer.
    pub(crate) fn open(&self, path: &Path, interrupt: &Interrupt) -> Result<Box<dyn Source>, Failure> {
        formats::open(&Input::new(path, interrupt), self.named(path)?)
    }
}

impl OutputFile {
    /// Opens the output, before anything is read.
    pub(crate) fn open(
        &self,
        like: &Path,
        input: &InputFormat,
        interrupt: &Interrupt,
    ) -> Result<(Output, Format), Failure> {
        let is_stdout = self.output.as_os_str() == "-";
        let format = match (self.to, is_stdout) {
            (None, true) => input.named(like)?,
            (to, _) => Format::named(&self.output, to, "--to")?,
        };
        Ok((Output::open(&self.output, interrupt)?, format))
    }
}

/// Refuses to read stdin twice.
pub(crate) fn only_one_stdin(a: &Path, b: &Path) -> Result<(), Failure> {
    if a.as_os_str() == "-" && b.as_os_str() == "-" {
        return Err(Failure::Usage("both inputs are stdin; give a file for one of them".into()));
    }
    Ok(())
}

/// Prints a text on stdout.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut output = Output::open(Path::new("-"), &Interrupt::default())?;
    output.write_all(text.as_bytes()).map_err(|error| Failure::write("stdout", error))?;
    output.commit()
}
