//! Reads FlatGeobuf in a row, its index skipped. The crate flatgeobuf checks what it parses; framing is done here, as it would
//! believe any size, and take a file that is cut short for a whole one.
use super::properties::{Table, field};
use super::shapes;
use crate::failure::Failure;
use crate::formats::reader::{Each, Source, warn_of_flattened};
use crate::input::Input;
use crate::layer::areas::Reading;
use crate::layer::batch::{Batch, Gathered, Layer};
use crate::layer::crs::{Crs, Definition};
use arrow_schema::{Field, Schema};
use flatgeobuf::packed_r_tree::PackedRTree;
use flatgeobuf::{
    Feature, GeometryType, Header, size_prefixed_root_as_feature, size_prefixed_root_as_header,
};
use std::io::{self, BufRead, Read};
use std::sync::Arc;

const MAGIC: &[u8; 3] = b"fgb";
const VERSION: u8 = 3;
/// More bytes than headers have, and more features than files have.
const MOST_HEADER: usize = 1 << 24;
const MOST_FEATURES: u64 = 1 << 40;

/// A file whose header is read.
pub(crate) struct FlatGeobuf {
    input: Input,
    bytes: Box<dyn BufRead>,
    layer: Layer,
    kind: GeometryType,
    is_flattened: bool,
    /// How many features there are; none where the header does not say.
    count: Option<u64>,
}

impl FlatGeobuf {
    pub(crate) fn open(input: &Input) -> Result<FlatGeobuf, Failure> {
        let mut bytes = input.stream()?;
        let header = header(&mut bytes).map_err(|error| failed(input, error))?;
        let (layer, kind, is_flattened, count, index) =
            described(&header, input.name()).map_err(|error| Failure::data(input.name(), error))?;
        let skipped = io::copy(&mut (&mut bytes).take(index), &mut io::sink());
        if skipped.map_err(|error| failed(input, error))? < index {
            return Err(Failure::data(&layer.name, "the file is cut short: its index ends too early"));
        }
        Ok(FlatGeobuf { input: input.clone(), bytes, layer, kind, is_flattened, count })
    }

    /// The next feature's bytes; false where there are no more.
    fn next(&mut self, number: usize, buffer: &mut Vec<u8>) -> Result<bool, Failure> {
        buffer.clear();
        let is_end = self.bytes.fill_buf().map_err(|error| failed(&self.input, error))?.is_empty();
        if self.count.map_or(is_end, |count| number as u64 >= count) {
            return Ok(false);
        }
        match sized(&mut self.bytes, usize::MAX, buffer) {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                Err(Failure::data(&self.layer.name, format!("feature {number}: the file is cut short")))
            }
            Err(error) => Err(failed(&self.input, error)),
        }
    }

    /// Adds a feature of its bytes.
    fn add(&self, buffer: &[u8], gathered: &mut Gathered, table: &mut Table) -> Result<(), String> {
        let feature = parsed(buffer)?;
        let reading = shapes::read(&feature, self.kind)?;
        table.push(feature.properties().map_or(&[], |bytes| bytes.bytes()))?;
        gathered.push(Reading { is_flattened: self.is_flattened, ..reading });
        Ok(())
    }

    fn batch(&self, gathered: &mut Gathered, table: &mut Table) -> Result<Batch, Failure> {
        let attributes = table.take().map_err(|error| Failure::data(&self.layer.name, error))?;
        Ok(gathered.take(attributes))
    }
}

impl Source for FlatGeobuf {
    fn layer(&self) -> &Layer {
        &self.layer
    }

    fn read(mut self: Box<Self>, each: &mut Each<'_>) -> Result<(), Failure> {
        let (mut gathered, mut table) = (Gathered::default(), Table::new(&self.layer.schema));
        let mut buffer = Vec::new();
        while self.next(gathered.next, &mut buffer)? {
            let number = gathered.next;
            self.add(&buffer, &mut gathered, &mut table)
                .map_err(|error| Failure::data(&self.layer.name, format!("feature {number}: {error}")))?;
            if gathered.is_full() {
                self.input.interrupt.check()?;
                each(self.batch(&mut gathered, &mut table)?)?;
            }
        }
        warn_of_flattened(&self.layer, &gathered);
        each(self.batch(&mut gathered, &mut table)?)
    }
}

fn parsed(buffer: &[u8]) -> Result<Feature<'_>, String> {
    let feature =
        size_prefixed_root_as_feature(buffer).map_err(|error| format!("it cannot be read: {error}"))?;
    if feature.columns().is_some_and(|columns| !columns.is_empty()) {
        return Err("it has columns of its own; only a file's columns are read".into());
    }
    Ok(feature)
}

fn failed(input: &Input, error: io::Error) -> Failure {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => Failure::data(input.name(), "the file is cut short"),
        io::ErrorKind::InvalidData => Failure::data(input.name(), error),
        _ => input.unreadable(error),
    }
}

/// Reads a part with its size before it. No more is allocated than is there.
fn sized(bytes: &mut impl Read, most: usize, buffer: &mut Vec<u8>) -> io::Result<()> {
    let mut size = [0; 4];
    bytes.read_exact(&mut size)?;
    let length = u32::from_le_bytes(size) as usize;
    if length > most {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "this is no FlatGeobuf: its header is too long",
        ));
    }
    buffer.extend(size);
    if bytes.take(length as u64).read_to_end(buffer)? < length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    Ok(())
}

fn header(bytes: &mut impl Read) -> io::Result<Vec<u8>> {
    let mut magic = [0; 8];
    bytes.read_exact(&mut magic)?;
    if !magic.starts_with(MAGIC) || magic[3] > VERSION || &magic[4..7] != MAGIC {
        return Err(io::Error::new(io::ErrorKind::InvalidData, "this is no FlatGeobuf"));
    }
    let mut buffer = Vec::new();
    sized(bytes, MOST_HEADER, &mut buffer)?;
    Ok(buffer)
}

/// The layer, the kind of its geometries, whether they have Z or M, how many there are, and the bytes of the index.
type Described = (Layer, GeometryType, bool, Option<u64>, u64);

fn described(buffer: &[u8], name: String) -> Result<Described, String> {
    let header =
        size_prefixed_root_as_header(buffer).map_err(|error| format!("this is no FlatGeobuf: {error}"))?;
    let columns = header.columns().into_iter().flatten();
    let fields: Result<Vec<Field>, String> =
        columns.map(|column| field(column.name(), column.type_())).collect();
    let (count, node) = (header.features_count(), header.index_node_size());
    if node == 1 || count > MOST_FEATURES {
        return Err("this is no FlatGeobuf: its index cannot be".into());
    }
    let index = match usize::try_from(count) {
        Ok(features) if features > 0 && node > 0 => PackedRTree::index_size(features, node) as u64,
        _ => 0,
    };
    let is_flattened = header.has_z() || header.has_m();
    let layer = Layer { name, schema: Arc::new(Schema::new(fields?)), crs: crs(&header) };
    Ok((layer, header.geometry_type(), is_flattened, (count > 0).then_some(count), index))
}

fn crs(header: &Header<'_>) -> Crs {
    let Some(crs) = header.crs() else { return Crs::default() };
    let code = match (crs.code(), crs.code_string()) {
        (0, text) => text.map(str::to_owned),
        (code, _) => Some(code.to_string()),
    };
    let authority = crs.org().unwrap_or("EPSG").to_owned();
    Crs {
        code: code.map(|code| (authority, code)),
        definition: crs.wkt().map(|text| Definition::Wkt(text.into())),
    }
}
