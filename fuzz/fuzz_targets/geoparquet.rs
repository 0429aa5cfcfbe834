//! Any rows of WKB and any text of what is said of them in a GeoParquet file, or any bytes as a file: features, or a typed error that
//! names the file. Features are the same when they are written and read.
#![no_main]
use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use polycsg_cli::fuzzing::{Reader, parquet_of};

#[derive(Arbitrary, Debug)]
enum Input<'a> {
    Rows(Vec<&'a [u8]>),
    Metadata(&'a str),
    File(&'a [u8]),
}

fuzz_target!(|input: Input| {
    let file = match input {
        Input::Rows(rows) => parquet_of(&rows, None),
        Input::Metadata(geo) => parquet_of(&[], Some(geo)),
        Input::File(file) => file.to_vec(),
    };
    Reader::GeoParquet.survives(&file);
});
