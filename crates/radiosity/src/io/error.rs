//! What can go wrong with files.
use std::path::PathBuf;
use thiserror::Error;

/// Why a file was not read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file could not be read.
    #[error("{}: cannot be read: {source}; check its name and permissions", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file could not be written; an older file in its place is unchanged.
    #[error("{}: cannot be written: {source}; check the folder and its permissions", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// More data than the format can hold.
    #[error("{bytes} bytes do not fit into a GLB file, which ends at 4 GiB; use fewer elements")]
    Size {
        /// Length of the data.
        bytes: usize,
    },
    /// The bytes are not text in the encoding that the file says.
    #[error("{file}: byte {position} is not {encoding}; save the file in UTF-8")]
    Encoding {
        /// The file.
        file: String,
        /// The encoding.
        encoding: String,
        /// Offset of the first wrong byte.
        position: usize,
    },
    /// The text is not well-formed XML.
    #[error("{file}:{}:{}: not well-formed XML: {source}; export the file again", source.pos().row, source.pos().col)]
    Xml {
        /// The file.
        file: String,
        /// What the parser says.
        source: roxmltree::Error,
    },
    /// The bytes are not glTF 2.0.
    #[error("{file}: not glTF 2.0: {source}; export the file again")]
    Gltf {
        /// The file.
        file: String,
        /// What the parser says.
        source: Box<gltf::Error>,
    },
    /// A part of a glTF file has a fault.
    #[error("{file}: {part}: {fault}")]
    Part {
        /// The file.
        file: String,
        /// Which part: `accessor 3`, `mesh 0, primitive 1`.
        part: String,
        /// What is wrong with it.
        fault: Fault,
    },
    /// A line of a text file has a fault.
    #[error("{file}:{line}: {fault}")]
    Line {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong with it.
        fault: Fault,
    },
    /// Neither the file's extension nor its contents are of a format that is read.
    #[error(
        "{file}: unknown kind of scene; give a COLLADA (.dae), glTF (.gltf, .glb), OBJ (.obj), PLY (.ply), STL (.stl) or View3D (.vs3) \
         file"
    )]
    Unknown {
        /// The file.
        file: String,
    },
    /// The file's extension names no photometry that is read.
    #[error("{file}: unknown kind of photometry; give an IES (.ies) or EULUMDAT (.ldt) file")]
    Photometry {
        /// The file.
        file: String,
    },
    /// The extension names no format that scenes are written in.
    #[error("{}: unknown kind of scene; name it .dae, .glb, .obj, .ply or .stl", path.display())]
    UnknownOutput {
        /// The file.
        path: PathBuf,
    },
    /// A format, or a part of one, that is known and not read.
    #[error("{file}: {feature} is not read; {repair}")]
    Unread {
        /// The file.
        file: String,
        /// The format or the part.
        feature: String,
        /// What to do.
        repair: &'static str,
    },
    /// The bytes are not of the format that the file's name says.
    #[error("{file}: not {wanted}: {reason}; export the scene again, or correct the file's name")]
    Garbled {
        /// The file.
        file: String,
        /// The format.
        wanted: &'static str,
        /// What is wrong.
        reason: &'static str,
    },
    /// An element of a COLLADA file has a fault.
    #[error("{file}:{line}:{column}: <{element}>: {fault}")]
    Scene {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in bytes, from 1.
        column: usize,
        /// The element's tag.
        element: String,
        /// What is wrong with it.
        fault: Fault,
    },
}

/// A line's number, from 1, and what is wrong there.
pub(crate) type Wrong = (usize, Fault);

/// What is wrong with an element of a scene file, and how to repair it.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// The root element is another one.
    #[error("the root element is not <COLLADA>; export the scene as COLLADA 1.4 or 1.5")]
    NotCollada,
    /// A version that is not read.
    #[error("COLLADA version {0:?} is not read; export the scene as COLLADA 1.4 or 1.5")]
    Version(String),
    /// An attribute is missing.
    #[error("the attribute {0} is missing; add it")]
    Attribute(&'static str),
    /// A property of an element is missing.
    #[error("it has no property {0}; export the file again")]
    Property(&'static str),
    /// A child element is missing.
    #[error("a child <{0}> is missing; add it")]
    Child(&'static str),
    /// A reference to something that does not exist.
    #[error("{url:?} names no <{wanted}> of this file; correct the reference or add the element")]
    Unresolved {
        /// The reference.
        url: String,
        /// The element it should name.
        wanted: &'static str,
    },
    /// A reference to another file.
    #[error("{0:?} refers to another file; merge the files into one")]
    External(String),
    /// Text that is no finite number.
    #[error("{0:?} is not a finite number; correct it")]
    Number(String),
    /// Text that is no index.
    #[error("{0:?} is not a whole number from 0 on; correct it")]
    Whole(String),
    /// Another number of values than needed.
    #[error("{found} values stand where {wanted} are needed; correct the list")]
    Count {
        /// How many stand there.
        found: usize,
        /// How many are needed.
        wanted: usize,
    },
    /// An index beyond the end of what it points into.
    #[error("index {index} is out of range: there are {len}; correct it")]
    Index {
        /// The index.
        index: usize,
        /// Number of things it may point to.
        len: usize,
    },
    /// An index that counts back from the end, beyond the start of what it points into.
    #[error("index -{back} is out of range: there are {len}; correct it")]
    FromEnd {
        /// How far back, from 1.
        back: usize,
        /// Number of things it may point to.
        len: usize,
    },
    /// An accessor or input whose numbers cannot be right.
    #[error("{0} is too large; correct it")]
    Huge(&'static str),
    /// A rotation axis or view direction of length zero, or parallel to another.
    #[error("its axes have no direction of their own; give axes that are neither zero nor parallel")]
    Axis,
    /// A matrix with a perspective part.
    #[error("the matrix's last row is not 0 0 0 1; bake the transform into the geometry")]
    Projective,
    /// Something that is not read.
    #[error("this element is not read; bake the transform into a <matrix>")]
    Unsupported,
    /// The product of the node transforms leaves the range of numbers.
    #[error("the node's transform is not finite; give smaller factors")]
    Overflow,
    /// A field of view outside the possible.
    #[error("the angle {0} is not between 0 and 180 degrees; correct it")]
    Angle(f64),
    /// A ratio of width to height that no picture has.
    #[error("no picture is {0} times as wide as high; correct the ratio, or the angles")]
    Ratio(f64),
    /// A number below zero.
    #[error("the {what} {value} is negative; give 0 or more")]
    Negative {
        /// What it is of: `colour`, `intensity`.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// A node that contains itself.
    #[error("the node instances itself; remove one of the <instance_node>")]
    Cycle,
    /// Nesting of instances beyond the limit.
    #[error("instances are nested more than {0} deep; flatten the scene")]
    Nesting(usize),
    /// More things than the reader takes.
    #[error("the scene has more than {limit} {what}; split it")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// Bytes that are not there.
    #[error("its bytes cannot be had: {0}; put them beside the scene or into it")]
    Missing(String),
    /// A file that ends before its part does.
    #[error("it is cut short after {found} bytes; export the file again")]
    Short {
        /// How many bytes there are.
        found: usize,
    },
    /// Rows of another width than needed.
    #[error("it has another number of {0} than its use needs; export the file again")]
    Kind(&'static str),
    /// What a checker says of a part of a file.
    #[error("{0}; export the file again")]
    Invalid(String),
    /// A word where another is needed.
    #[error("{found:?} stands where {wanted} is needed; correct the line")]
    Word {
        /// What stands there.
        found: String,
        /// What is needed.
        wanted: &'static str,
    },
    /// A fault in another file that this one names.
    #[error("{file}:{line}: {fault}")]
    Within {
        /// The other file.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// What is wrong there.
        fault: Box<Fault>,
    },
    /// A polygon that the form factors refuse.
    #[error("polygon {polygon}: {source}")]
    Shape {
        /// Index of the polygon within the element, from 0.
        polygon: usize,
        /// What the form factors say.
        source: formfactor::Error,
    },
}
