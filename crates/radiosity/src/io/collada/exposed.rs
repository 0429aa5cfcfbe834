//! Radiosity at the vertices turned to colours that a screen can show.
use super::file::{File, XmlNode, children, descend};
use super::primitive::surfaces;
use crate::expose::Exposure;
use crate::io::error::{Fault, FileError};
use crate::io::words::{decimal, list};
use std::collections::BTreeMap;

/// A colour source's numbers: their element, how many a row has, and themselves.
struct ColourSource<'a> {
    array: XmlNode<'a>,
    stride: usize,
    numbers: Vec<f64>,
}

/// Under which name the file keeps its exposure.
const PROFILE: &str = "radiosity";

/// The text with an exposure for its light, as an `<extra>` at its end.
pub(super) fn with_exposure(text: &str, exposure: Exposure) -> String {
    let (body, end) = text.split_at(text.rfind("</").unwrap_or(text.len()));
    let k = decimal(&exposure.k());
    format!(
        "{body}<extra><technique profile=\"{PROFILE}\"><exposure>{k}</exposure></technique></extra>\n{end}"
    )
}

/// The exposure that a file was given last.
fn kept(file: &File<'_>) -> Option<Exposure> {
    let techniques = children(file.root, "extra").flat_map(|extra| children(extra, "technique"));
    let own = techniques.filter(|technique| technique.attribute("profile") == Some(PROFILE)).last()?;
    Exposure::new(descend(own, &["exposure"])?.text()?.trim().parse().ok()?)
}

/// The text with the first three numbers of every row of every vertex colour exposed; all else byte for byte. Without an
/// exposure it is the one that the file was given, or that of all its rows.
pub(super) fn exposed<'a>(
    text: &str,
    file: &File<'a>,
    exposure: Option<Exposure>,
) -> Result<String, FileError> {
    let sources = sources(file)?;
    if sources.is_empty() {
        return Err(file.fault(file.root, Fault::Child("input semantic=\"COLOR\"")));
    }
    let rows = sources.values().flat_map(|light| light.numbers.chunks_exact(light.stride));
    let of_rows = || Exposure::of(rows.map(|row| ([row[0], row[1], row[2]], 1.0, false)));
    let exposure = exposure.or_else(|| kept(file)).unwrap_or_else(of_rows);
    let (mut new, mut at) = (String::new(), 0);
    for light in sources.values() {
        let range = light.array.range();
        // What stands between the start tag and the end tag.
        let inner = light.array.first_child().map_or(range.end, |first| first.range().start);
        let end = light.array.last_child().map_or(range.end, |last| last.range().end);
        new.push_str(&text[at..inner]);
        let colour = |row: &[f64]| {
            let [red, green, blue] = exposure.intensity([row[0], row[1], row[2]]);
            list([red, green, blue].iter().chain(&row[3..]).map(decimal))
        };
        new.push_str(&list(light.numbers.chunks_exact(light.stride).map(colour)));
        at = end;
    }
    new.push_str(&text[at..]);
    Ok(new)
}

/// The colour sources that surfaces use, by where they stand in the text.
fn sources<'a>(file: &File<'a>) -> Result<BTreeMap<usize, ColourSource<'a>>, FileError> {
    let mut all = BTreeMap::new();
    let libraries = children(file.root, "library_geometries");
    let geometries = libraries.flat_map(|library| children(library, "geometry"));
    for input in geometries.flat_map(surfaces).flat_map(|surface| children(surface, "input")) {
        if input.attribute("semantic") != Some("COLOR") {
            continue;
        }
        let source = file.target(input, "source", "source")?;
        let array = file.child(source, "float_array")?;
        let accessor = descend(source, &["technique_common", "accessor"]);
        let stride = accessor.map_or(Ok(3), |accessor| file.whole_attribute(accessor, "stride", 1))?;
        if !(3..=4).contains(&stride) {
            return Err(file.fault(source, Fault::Count { found: stride, wanted: 3 }));
        }
        let numbers = file.numbers(array)?;
        if numbers.len() % stride != 0 {
            let wanted = numbers.len().next_multiple_of(stride);
            return Err(file.fault(array, Fault::Count { found: numbers.len(), wanted }));
        }
        all.insert(array.range().start, ColourSource { array, stride, numbers });
    }
    Ok(all)
}
