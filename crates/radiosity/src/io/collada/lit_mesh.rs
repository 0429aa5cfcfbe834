//! A `<mesh>` with a colour at every vertex, as text.
use crate::escape::escape;
use crate::io::words::{decimal, list};
use glam::{DVec2, DVec3};

/// Triangles in a geometry's coordinates, grouped by material symbol.
#[derive(Default)]
pub(super) struct LitMesh {
    pub(super) positions: Vec<DVec3>,
    pub(super) colours: Vec<[f64; 3]>,
    /// Where in a texture's picture; as many as positions, or none.
    pub(super) places: Vec<DVec2>,
    pub(super) groups: Vec<Group>,
}

/// The triangles of one primitive.
pub(super) struct Group {
    pub(super) material: Option<String>,
    pub(super) triangles: Vec<[usize; 3]>,
}

/// The ids of the mesh's parts, none of them used elsewhere in the file.
pub(super) struct Ids {
    pub(super) positions: String,
    pub(super) colours: String,
    pub(super) places: String,
    pub(super) vertices: String,
}

impl LitMesh {
    /// The element, from `<mesh>` to `</mesh>`.
    pub(super) fn text(&self, ids: &Ids) -> String {
        let points = self.positions.iter().map(|point| point.to_array());
        let positions = source(&ids.positions, ["X", "Y", "Z"], points);
        let colours = source(&ids.colours, ["R", "G", "B"], self.colours.iter().copied());
        // COLLADA counts a picture's rows from below.
        let turned = self.places.iter().map(|place| [place.x, 1.0 - place.y]);
        let textured = !self.places.is_empty();
        let places = if textured { source(&ids.places, ["S", "T"], turned) } else { String::new() };
        let vertices = format!(
            "<vertices id=\"{}\"><input semantic=\"POSITION\" source=\"#{}\"/></vertices>\n",
            escape(&ids.vertices),
            escape(&ids.positions)
        );
        let groups: String = self.groups.iter().map(|group| group.text(ids, textured)).collect();
        format!("<mesh>\n{positions}{colours}{places}{vertices}{groups}</mesh>")
    }
}

impl Group {
    fn text(&self, ids: &Ids, textured: bool) -> String {
        let places = if textured {
            let id = escape(&ids.places);
            format!("<input semantic=\"TEXCOORD\" source=\"#{id}\" offset=\"0\" set=\"0\"/>\n")
        } else {
            String::new()
        };
        let symbol = self.material.as_ref().map(|symbol| format!(" material=\"{}\"", escape(symbol)));
        format!(
            "<triangles{} count=\"{}\">\n\
             <input semantic=\"VERTEX\" source=\"#{}\" offset=\"0\"/>\n\
             <input semantic=\"COLOR\" source=\"#{}\" offset=\"0\" set=\"0\"/>\n{places}<p>{}</p>\n</triangles>\n",
            symbol.unwrap_or_default(),
            self.triangles.len(),
            escape(&ids.vertices),
            escape(&ids.colours),
            list(self.triangles.iter().flatten())
        )
    }
}

/// A `<source>` of rows of numbers.
fn source<const N: usize>(id: &str, names: [&str; N], rows: impl Iterator<Item = [f64; N]>) -> String {
    let numbers: Vec<f64> = rows.flatten().collect();
    let parameters = names.map(|name| format!("<param name=\"{name}\" type=\"float\"/>")).concat();
    let (id, count, rows) = (escape(id), numbers.len(), numbers.len() / N);
    let array = format!(
        "<float_array id=\"{id}-array\" count=\"{count}\">{}</float_array>",
        list(numbers.iter().map(decimal))
    );
    let accessor =
        format!("<accessor source=\"#{id}-array\" count=\"{rows}\" stride=\"{N}\">{parameters}</accessor>");
    format!("<source id=\"{id}\">\n{array}\n<technique_common>{accessor}</technique_common>\n</source>\n")
}
