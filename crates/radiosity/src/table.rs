//! Tables for spreadsheets: comma-separated values with a header.
use crate::record::{PatchRecord, Record};

/// A table with a row for every patch: its name, area, reflectances, emissions, mean irradiances and mean radiosities
/// per band, what the irradiances may be off by where that was estimated, and the mean illuminance in lx.
#[must_use]
pub fn patch_table(record: &Record) -> String {
    let is_estimated = record.patches.iter().any(|patch| !patch.estimate.is_empty());
    let groups = ["reflectance", "emission", "irradiance", "radiosity", "estimate"];
    let groups = &groups[..if is_estimated { 5 } else { 4 }];
    let is_luminous = !record.lumens.is_empty();
    let last = is_luminous.then(|| "illuminance".to_owned());
    let header =
        ["patch", "area"].map(Into::into).into_iter().chain(columns(groups, record.bands)).chain(last);
    let row = |patch: &PatchRecord| {
        let lux: f64 = patch.irradiance.iter().zip(&record.lumens).map(|(h, lumens)| h * lumens).sum();
        let values =
            [&patch.reflectance, &patch.emission, &patch.irradiance, &patch.radiosity, &patch.estimate];
        let numbers = std::iter::once(&patch.area).chain(values.into_iter().flatten());
        let numbers = numbers.chain(is_luminous.then_some(&lux));
        std::iter::once(patch.name.clone()).chain(numbers.map(ToString::to_string)).collect()
    };
    table(header.collect(), record.patches.iter().map(row))
}

/// A table with a row for every element: its number, the patch's name, centroid, area, irradiances and radiosities per band.
#[must_use]
pub fn element_table(record: &Record) -> String {
    let first = ["element", "patch", "x", "y", "z", "area"].map(Into::into);
    let header = first.into_iter().chain(columns(&["irradiance", "radiosity"], record.bands));
    let mesh = record.mesh();
    let row = |element: usize| {
        let bands = element * record.bands..(element + 1) * record.bands;
        let [x, y, z] = mesh.centroid(element).to_array();
        let own = [x, y, z, mesh.area(element)];
        let values = record.irradiance[bands.clone()].iter().chain(&record.radiosity[bands]);
        let name = record.patches[mesh.elements[element].patch].name.clone();
        let numbers = own.iter().chain(values).map(ToString::to_string);
        [element.to_string(), name].into_iter().chain(numbers).collect()
    };
    table(header.collect(), (0..mesh.elements.len()).map(row))
}

/// `name.0`, `name.1`, … for each name.
pub(crate) fn columns(names: &[&str], bands: usize) -> impl Iterator<Item = String> {
    names.iter().flat_map(move |name| (0..bands).map(move |band| format!("{name}.{band}")))
}

/// A header and rows of the same length; what needs quotes gets them.
pub(crate) fn table(header: Vec<String>, rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in std::iter::once(header).chain(rows) {
        writer.write_record(&row).expect("rows have the header's length, and memory takes them");
    }
    let bytes = writer.into_inner().expect("memory takes what is written");
    String::from_utf8(bytes).expect("names and numbers are UTF-8")
}
