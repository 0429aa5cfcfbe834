//! The header of a PLY file: which elements follow, and the properties of each.
use crate::io::error::{Fault, Wrong};

/// How the rows behind the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Writing {
    Text,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A column: of numbers, or of lists with the type of their lengths.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) number: NumberType,
    pub(super) length: Option<NumberType>,
}

#[derive(Clone, Debug)]
pub(super) struct PlyElement {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) writing: Writing,
    pub(super) elements: Vec<PlyElement>,
    /// The picture that a comment names, as many programs have it.
    pub(super) picture: Option<String>,
    /// How many bytes and lines the header has.
    pub(super) length: usize,
    pub(super) lines: usize,
}

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Header, Wrong> {
        let mut header =
            Header { writing: Writing::Text, elements: Vec::new(), picture: None, length: 0, lines: 0 };
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            header.length += line.len();
            header.lines += 1;
            let text = String::from_utf8_lossy(line);
            let words: Vec<&str> = text.split_whitespace().collect();
            if words == ["end_header"] {
                return Ok(header);
            }
            header.read(&words).map_err(|fault| (header.lines, fault))?;
        }
        Err((header.lines, Fault::Word { found: "the end of the file".into(), wanted: "end_header" }))
    }

    /// Finds what faces need and the header does not have.
    pub(super) fn check(&self) -> Result<(), (&'static str, Fault)> {
        let named = |name: &str| self.elements.iter().find(|element| element.name == name);
        let Some(vertex) = named("vertex").filter(|vertex| vertex.count > 0) else { return Ok(()) };
        let has = |element: &PlyElement, name: &str| element.properties.iter().any(|one| one.name == name);
        match ["x", "y", "z"].into_iter().find(|axis| !has(vertex, axis)) {
            Some(axis) => Err(("vertex", Fault::Property(axis))),
            None => Ok(()),
        }
    }

    fn read(&mut self, words: &[&str]) -> Result<(), Fault> {
        match *words {
            [] | ["ply" | "obj_info", ..] => {}
            ["format", writing, _] => {
                self.writing = match writing {
                    "ascii" => Writing::Text,
                    "binary_little_endian" => Writing::LittleEndian,
                    "binary_big_endian" => Writing::BigEndian,
                    _ => return Err(word(writing, "ascii, binary_little_endian or binary_big_endian")),
                };
            }
            ["comment", "TextureFile", ref name @ ..] => self.picture = Some(name.join(" ")),
            ["comment", ..] => {}
            ["element", name, count] => {
                let count = count.parse().map_err(|_| Fault::Whole(count.chars().take(40).collect()))?;
                self.elements.push(PlyElement { name: name.to_owned(), count, properties: Vec::new() });
            }
            ["property", "list", length, number, name] => {
                let (length, number) = (Some(number_type(length)?), number_type(number)?);
                self.add(Property { name: name.to_owned(), number, length })?;
            }
            ["property", number, name] => {
                let number = number_type(number)?;
                self.add(Property { name: name.to_owned(), number, length: None })?;
            }
            [first, ..] => {
                return Err(word(first, "format, element, property, comment or end_header, complete"));
            }
        }
        Ok(())
    }

    fn add(&mut self, property: Property) -> Result<(), Fault> {
        let element = self.elements.last_mut().ok_or_else(|| word("property", "element"))?;
        element.properties.push(property);
        Ok(())
    }
}

fn word(found: &str, wanted: &'static str) -> Fault {
    Fault::Word { found: found.chars().take(40).collect(), wanted }
}

fn number_type(name: &str) -> Result<NumberType, Fault> {
    Ok(match name {
        "char" | "int8" => NumberType::I8,
        "uchar" | "uint8" => NumberType::U8,
        "short" | "int16" => NumberType::I16,
        "ushort" | "uint16" => NumberType::U16,
        "int" | "int32" => NumberType::I32,
        "uint" | "uint32" => NumberType::U32,
        "float" | "float32" => NumberType::F32,
        "double" | "float64" => NumberType::F64,
        _ => return Err(word(name, "a type of number, as float or uchar")),
    })
}
