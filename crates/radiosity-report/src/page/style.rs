//! Colours and markers.

/// A method has one style in all plots.
pub(crate) fn style(name: &str) -> usize {
    const NAMES: [&str; 10] = [
        "exact",
        "disk",
        "Wallace",
        "Pietrek",
        "visibility index, 4 × 4 rays",
        "visibility index, 8 × 8 rays",
        "hemicube",
        "Baum",
        "paraboloid",
        "single plane",
    ];
    const OTHERS: [&str; 4] = ["shooting", "full matrix", "conjugate gradients", "GMRES"];
    let at = |names: &[&str]| names.iter().position(|known| *known == name);
    match name {
        "area to area" => 0,
        "points, exact" => 4,
        "points, hemicube" => 6,
        "points, rays" => 11,
        "View3D" => 3,
        "qualities" => 5,
        "hemicubes, 64 × 64 cells" => 6,
        "levels" => 7,
        "path tracing" => 10,
        "Mitsuba" => 11,
        "reference" => 1,
        "rays, random" => 10,
        "rays, stratified" => 11,
        _ => at(&NAMES).or_else(|| at(&OTHERS).map(|index| [2, 3, 0, 4][index])).unwrap_or(0),
    }
}
