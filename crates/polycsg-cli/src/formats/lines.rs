//! WKT and WKB, a geometry a line. They have no columns; an empty line is a feature without a geometry.
use super::reader::{Each, Source, warn_of_flattened};
use super::wkb;
use super::writer::Sink;
use crate::failure::Failure;
use crate::input::{Input, warn};
use crate::layer::areas::{Areas, Reading};
use crate::layer::batch::{Batch, Gathered, Layer, table};
use crate::layer::crs::Crs;
use crate::output::Output;
use arrow_schema::{ArrowError, Schema, SchemaRef};
use std::io::{self, BufRead, BufWriter, Write};
use std::str::FromStr;
use std::sync::Arc;

/// How a line is written.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Text {
    /// Well-known text.
    Wkt,
    /// Well-known binary in hexadecimal digits.
    Wkb,
}

/// Lines to read.
pub(crate) struct Lines {
    input: Input,
    bytes: Box<dyn BufRead>,
    layer: Layer,
    text: Text,
}

impl Lines {
    pub(crate) fn open(input: &Input, text: Text) -> Result<Lines, Failure> {
        let layer = Layer { name: input.name(), schema: Arc::new(Schema::empty()), crs: Crs::default() };
        Ok(Lines { input: input.clone(), bytes: input.stream()?, layer, text })
    }
}

impl Source for Lines {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn read(mut self: Box<Self>, each: &mut Each<'_>) -> Result<(), Failure> {
        let (mut gathered, mut line) = (Gathered::default(), Vec::new());
        let empty = |error| Failure::data(&self.layer.name, error);
        loop {
            line.clear();
            let count =
                self.bytes.read_until(b'\n', &mut line).map_err(|error| self.input.unreadable(error))?;
            if count > 0 {
                let number = gathered.next;
                gathered.push(self.text.read(&line).map_err(|error| {
                    Failure::data(
                        &self.layer.name,
                        format!("feature {number} (line {}): {error}", number + 1),
                    )
                })?);
            }
            if count == 0 || gathered.is_full() {
                let batch = batch(&mut gathered, &self.layer.schema).map_err(empty)?;
                self.input.interrupt.check()?;
                each(batch)?;
            }
            if count == 0 {
                warn_of_flattened(&self.layer, &gathered);
                return Ok(());
            }
        }
    }
}

fn batch(gathered: &mut Gathered, schema: &SchemaRef) -> Result<Batch, ArrowError> {
    let attributes = table(Arc::clone(schema), vec![], gathered.areas.len())?;
    Ok(gathered.take(attributes))
}

impl Text {
    /// What a line says.
    pub(crate) fn read(self, line: &[u8]) -> Result<Reading, String> {
        let line = std::str::from_utf8(line).map_err(|error| error.to_string())?.trim();
        match self {
            _ if line.is_empty() => Ok(Reading::default()),
            Text::Wkt => Reading::of(&::wkt::Wkt::<f64>::from_str(line)?),
            Text::Wkb => wkb::read(&decoded(line)?),
        }
    }

    fn write(self, areas: &Areas, line: &mut Vec<u8>) -> Result<(), String> {
        match self {
            Text::Wkt => {
                let mut text = String::new();
                match &areas.polygons.0[..] {
                    [polygon] if !areas.is_multi => ::wkt::to_wkt::write_polygon(&mut text, polygon),
                    _ => ::wkt::to_wkt::write_multi_polygon(&mut text, &areas.polygons),
                }
                .map_err(|error| error.to_string())?;
                line.extend(text.as_bytes());
            }
            Text::Wkb => {
                let digits = wkb::written(areas)?.into_iter().flat_map(|byte| [byte >> 4, byte & 15]);
                line.extend(digits.map(|digit| b"0123456789ABCDEF"[usize::from(digit)]));
            }
        }
        Ok(())
    }

    fn name(self) -> &'static str {
        match self {
            Text::Wkt => "WKT",
            Text::Wkb => "WKB",
        }
    }
}

/// Bytes of hexadecimal digits.
fn decoded(line: &str) -> Result<Vec<u8>, String> {
    let digit = |digit: u8| char::from(digit).to_digit(16).and_then(|value| u8::try_from(value).ok());
    let (pairs, []) = line.as_bytes().as_chunks::<2>() else {
        return Err("the number of hexadecimal digits is odd: the line is cut short".into());
    };
    let byte = |(place, pair): (usize, &[u8; 2])| {
        let [high, low] = pair.map(digit);
        let byte = high.zip(low).map(|(high, low)| high << 4 | low);
        byte.ok_or_else(|| format!("column {}: there is no hexadecimal digit", 2 * place + 1))
    };
    pairs.iter().enumerate().map(byte).collect()
}

/// Lines in the making.
pub(crate) struct LinesSink {
    output: BufWriter<Output>,
    name: String,
    text: Text,
}

impl LinesSink {
    pub(crate) fn new(output: Output, layer: &Layer, text: Text) -> LinesSink {
        let columns: Vec<&str> = layer.schema.fields().iter().map(|field| field.name().as_str()).collect();
        if !columns.is_empty() {
            warn(format!("{} has no columns: left out are {}", text.name(), columns.join(", ")));
        }
        let name = output.name();
        LinesSink { output: BufWriter::new(output), name, text }
    }
}

impl Sink for LinesSink {
    fn write(&mut self, batch: &Batch) -> Result<(), Failure> {
        let mut line = Vec::new();
        for areas in &batch.areas {
            line.clear();
            let written = areas.as_ref().map_or(Ok(()), |areas| self.text.write(areas, &mut line));
            written.map_err(|error| Failure::write(&self.name, error))?;
            line.push(b'\n');
            self.output.write_all(&line).map_err(|error| Failure::write(&self.name, error))?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Output, Failure> {
        let ended = self.output.into_inner().map_err(io::IntoInnerError::into_error);
        ended.map_err(|error| Failure::write(&self.name, error))
    }
}
