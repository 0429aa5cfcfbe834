//! Polygons as lists of indices, and the text of the elements that hold them.
use super::file::{File, XmlNode, child, children};
use super::primitive::{polylist, triangles};
use super::spectra::PROFILE;
use crate::escape::escape;
use crate::io::error::FileError;
use crate::io::words::list;

/// The corners of a polygon, its outline before its holes: as many indices for each as its element has inputs.
pub(super) type IndexedPolygon = Vec<Vec<Vec<usize>>>;

/// All polygons of an element.
pub(super) fn indexed<'a>(
    file: &File<'a>,
    element: XmlNode<'a>,
    stride: usize,
) -> Result<Vec<IndexedPolygon>, FileError> {
    let ring = |p: XmlNode<'a>| Ok(file.wholes(p)?.chunks(stride).map(<[usize]>::to_vec).collect::<Vec<_>>());
    let tag = element.tag_name().name();
    let mut all = Vec::new();
    for node in element.children() {
        match (node.tag_name().name(), tag) {
            ("p", "polygons") => all.push(vec![ring(node)?]),
            ("p", "polylist") => {
                all.extend(polylist(file, element, &ring(node)?)?.into_iter().map(|ring| vec![ring]));
            }
            ("p", _) => {
                all.extend(triangles(file, node, tag, &ring(node)?)?.into_iter().map(|ring| vec![ring]));
            }
            ("ph", "polygons") => {
                let outline = child(node, "p").into_iter().chain(children(node, "h"));
                all.push(outline.map(ring).collect::<Result<_, FileError>>()?);
            }
            _ => {}
        }
    }
    Ok(all)
}

/// What an element has beside its polygons.
pub(super) struct ElementFrame<'a> {
    /// The element of the file whose attributes it takes.
    old: XmlNode<'a>,
    pub(super) inputs: String,
    extras: String,
}

impl<'a> ElementFrame<'a> {
    /// That of an element of the file.
    pub(super) fn of(text: &str, element: XmlNode<'a>) -> ElementFrame<'a> {
        let all = |name: &'static str| {
            children(element, name).map(|node| format!("{}\n", &text[node.range()])).collect::<String>()
        };
        ElementFrame { old: element, inputs: all("input"), extras: all("extra") }
    }

    /// The same of one side, which its material need not have: the first word counts.
    pub(super) fn one_sided(self) -> ElementFrame<'a> {
        let flag = format!(
            "<extra><technique profile=\"{PROFILE}\"><double_sided>0</double_sided></technique></extra>\n"
        );
        ElementFrame { extras: flag + &self.extras, ..self }
    }

    /// An element of triangles, for a program that may join them.
    pub(super) fn triangles(&self, polygons: &[IndexedPolygon]) -> String {
        let corners = list(polygons.iter().flatten().flatten().flatten());
        self.wrapped("triangles", polygons.len(), &format!("<p>{corners}</p>\n"))
    }

    /// `<polygons>` where there are holes, else a `<polylist>`.
    pub(super) fn polygons(&self, polygons: &[IndexedPolygon]) -> String {
        if polygons.iter().any(|rings| rings.len() != 1) {
            let inside: String = polygons.iter().map(|rings| with_holes(rings)).collect();
            return self.wrapped("polygons", polygons.len(), &inside);
        }
        let counts = list(polygons.iter().map(|rings| rings[0].len()));
        let corners = list(polygons.iter().flatten().flatten().flatten());
        let inside = format!("<vcount>{counts}</vcount>\n<p>{corners}</p>\n");
        self.wrapped("polylist", polygons.len(), &inside)
    }

    /// An element with the attributes of the old one but for the count.
    fn wrapped(&self, tag: &str, count: usize, inside: &str) -> String {
        let ElementFrame { old, inputs, extras } = self;
        let kept = old.attributes().filter(|attribute| attribute.name() != "count");
        let attributes: String = kept
            .map(|attribute| format!(" {}=\"{}\"", attribute.name(), escape(attribute.value())))
            .collect();
        format!("<{tag}{attributes} count=\"{count}\">\n{inputs}{inside}{extras}</{tag}>")
    }
}

fn with_holes(rings: &[Vec<Vec<usize>>]) -> String {
    let words = |ring: &Vec<Vec<usize>>| list(ring.iter().flatten());
    match rings {
        [ring] => format!("<p>{}</p>\n", words(ring)),
        [ring, holes @ ..] => {
            let holes: String = holes.iter().map(|hole| format!("<h>{}</h>", words(hole))).collect();
            format!("<ph><p>{}</p>{holes}</ph>\n", words(ring))
        }
        [] => String::new(),
    }
}
