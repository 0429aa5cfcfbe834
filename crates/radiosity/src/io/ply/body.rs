//! The numbers behind the header, one after the other, as text or as bytes.
use super::header::{Header, NumberType, PlyElement, Property, Writing};
use crate::io::error::Fault;

/// Where the next number stands.
pub(super) struct PlyBody<'b> {
    bytes: &'b [u8],
    at: usize,
    writing: Writing,
    line: usize,
}

impl<'b> PlyBody<'b> {
    pub(super) fn new(bytes: &'b [u8], header: &Header) -> PlyBody<'b> {
        PlyBody { bytes, at: header.length, writing: header.writing, line: header.lines + 1 }
    }

    /// The line, where there are lines.
    pub(super) fn line(&self) -> Option<usize> {
        (self.writing == Writing::Text).then_some(self.line)
    }

    /// The rows of an element, each handed over property by property. The fault comes with the row's index.
    pub(super) fn rows(
        &mut self,
        element: &PlyElement,
        mut take: impl FnMut(usize, &Property, &[f64]) -> Result<(), Fault>,
    ) -> Result<(), (usize, Fault)> {
        // A row without properties takes no bytes: a hostile file may claim any number of these.
        let count = if element.properties.is_empty() { 0 } else { element.count };
        let mut numbers = Vec::new();
        for row in 0..count {
            for property in &element.properties {
                let mut read = || {
                    self.values(property, &mut numbers)?;
                    take(row, property, &numbers)
                };
                read().map_err(|fault| (row, fault))?;
            }
        }
        Ok(())
    }

    /// A property's one number, or the numbers of its list.
    fn values(&mut self, property: &Property, numbers: &mut Vec<f64>) -> Result<(), Fault> {
        numbers.clear();
        let count = match property.length {
            None => 1,
            Some(length) => whole(self.number(length)?)?,
        };
        for _ in 0..count {
            numbers.push(self.number(property.number)?);
        }
        Ok(())
    }

    fn number(&mut self, kind: NumberType) -> Result<f64, Fault> {
        let number = match self.writing {
            Writing::Text => self.word()?,
            Writing::LittleEndian => self.binary(kind, false)?,
            Writing::BigEndian => self.binary(kind, true)?,
        };
        if number.is_finite() { Ok(number) } else { Err(Fault::Number(number.to_string())) }
    }

    fn word(&mut self) -> Result<f64, Fault> {
        let rest = &self.bytes[self.at..];
        let gap = rest.iter().take_while(|byte| byte.is_ascii_whitespace());
        self.line += gap.clone().filter(|byte| **byte == b'\n').count();
        let start = gap.count();
        let length = rest[start..].iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
        let word = &rest[start..start + length];
        self.at += start + length;
        if word.is_empty() {
            return Err(Fault::Short { found: self.bytes.len() });
        }
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| Fault::Number(String::from_utf8_lossy(word).chars().take(40).collect()))
    }

    fn binary(&mut self, kind: NumberType, is_big: bool) -> Result<f64, Fault> {
        use NumberType as T;
        Ok(match kind {
            T::I8 => f64::from(i8::from_le_bytes(self.take(is_big)?)),
            T::U8 => f64::from(u8::from_le_bytes(self.take(is_big)?)),
            T::I16 => f64::from(i16::from_le_bytes(self.take(is_big)?)),
            T::U16 => f64::from(u16::from_le_bytes(self.take(is_big)?)),
            T::I32 => f64::from(i32::from_le_bytes(self.take(is_big)?)),
            T::U32 => f64::from(u32::from_le_bytes(self.take(is_big)?)),
            T::F32 => f64::from(f32::from_le_bytes(self.take(is_big)?)),
            T::F64 => f64::from_le_bytes(self.take(is_big)?),
        })
    }

    /// The next bytes, least significant first.
    fn take<const N: usize>(&mut self, is_big: bool) -> Result<[u8; N], Fault> {
        let found = self.bytes.get(self.at..self.at + N).and_then(|bytes| <[u8; N]>::try_from(bytes).ok());
        let mut bytes = found.ok_or(Fault::Short { found: self.bytes.len() })?;
        self.at += N;
        if is_big {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

/// A count or an index.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number within 32 bits")]
pub(super) fn whole(number: f64) -> Result<usize, Fault> {
    let is_whole = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
    if is_whole { Ok(number as usize) } else { Err(Fault::Whole(number.to_string())) }
}
