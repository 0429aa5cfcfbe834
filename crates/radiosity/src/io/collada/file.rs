//! The parsed file: elements found by tag and by id, faults reported with their line.
use crate::io::error::{Fault, FileError};
use std::{collections::HashMap, str::FromStr};

pub(super) type XmlNode<'a> = roxmltree::Node<'a, 'a>;

/// A COLLADA document and its ids.
pub(super) struct File<'a> {
    name: &'a str,
    pub(super) root: XmlNode<'a>,
    ids: HashMap<&'a str, XmlNode<'a>>,
    /// Where each line starts: warnings may be many, and each names its line.
    lines: Vec<usize>,
}

impl<'a> File<'a> {
    /// Checks the root element and its version; where an id stands twice, the first counts.
    pub(super) fn new(name: &'a str, document: &'a roxmltree::Document<'a>) -> Result<Self, FileError> {
        let mut ids = HashMap::new();
        for node in document.descendants() {
            if let Some(id) = node.attribute("id") {
                ids.entry(id).or_insert(node);
            }
        }
        let breaks = document.input_text().match_indices('\n').map(|(at, _)| at + 1);
        let lines = std::iter::once(0).chain(breaks).collect();
        let file = Self { name, root: document.root_element(), ids, lines };
        if file.root.tag_name().name() != "COLLADA" {
            return Err(file.fault(file.root, Fault::NotCollada));
        }
        let version = file.attribute(file.root, "version")?;
        if !["1.4", "1.5"].iter().any(|known| version.starts_with(known)) {
            return Err(file.fault(file.root, Fault::Version(version.into())));
        }
        Ok(file)
    }

    /// `file:line:column` of an element.
    pub(super) fn place(&self, node: XmlNode) -> String {
        let (line, column) = self.position(node);
        format!("{}:{line}:{column}", self.name)
    }

    /// Line and column, the latter in bytes, both from 1.
    fn position(&self, node: XmlNode) -> (usize, usize) {
        let start = node.range().start;
        let line = self.lines.partition_point(|line| *line <= start);
        (line, start + 1 - self.lines[line - 1])
    }

    pub(super) fn fault(&self, node: XmlNode, fault: Fault) -> FileError {
        let (line, column) = self.position(node);
        FileError::Scene {
            file: self.name.into(),
            line,
            column,
            element: node.tag_name().name().into(),
            fault,
        }
    }

    pub(super) fn attribute(&self, node: XmlNode<'a>, name: &'static str) -> Result<&'a str, FileError> {
        node.attribute(name).ok_or_else(|| self.fault(node, Fault::Attribute(name)))
    }

    pub(super) fn child(&self, node: XmlNode<'a>, name: &'static str) -> Result<XmlNode<'a>, FileError> {
        child(node, name).ok_or_else(|| self.fault(node, Fault::Child(name)))
    }

    /// Whether some element has this id.
    pub(super) fn has_id(&self, id: &str) -> bool {
        self.ids.contains_key(id)
    }

    /// The element with this id, if it is a `wanted`.
    pub(super) fn by_id(&self, id: &str, wanted: &str) -> Option<XmlNode<'a>> {
        self.ids.get(id).copied().filter(|node| node.tag_name().name() == wanted)
    }

    /// What the reference in an attribute names. A bare id, without `#`, is taken as well.
    pub(super) fn target(
        &self,
        node: XmlNode<'a>,
        attribute: &'static str,
        wanted: &'static str,
    ) -> Result<XmlNode<'a>, FileError> {
        let url = self.attribute(node, attribute)?.trim();
        let id = url.strip_prefix('#').unwrap_or(url);
        self.by_id(id, wanted).ok_or_else(|| {
            let external = id == url && url.contains(['#', '/', ':']);
            let fault = if external {
                Fault::External(url.into())
            } else {
                Fault::Unresolved { url: url.into(), wanted }
            };
            self.fault(node, fault)
        })
    }

    /// The finite numbers that are an element's text.
    pub(super) fn numbers(&self, node: XmlNode<'a>) -> Result<Vec<f64>, FileError> {
        words(node).map(|word| self.number(node, word)).collect()
    }

    fn number(&self, node: XmlNode<'a>, word: &str) -> Result<f64, FileError> {
        let number = f64::from_str(word).ok().filter(|number| number.is_finite());
        number.ok_or_else(|| self.fault(node, Fault::Number(shorten(word))))
    }

    /// Exactly `N` numbers.
    pub(super) fn array<const N: usize>(&self, node: XmlNode<'a>) -> Result<[f64; N], FileError> {
        let numbers = self.numbers(node)?;
        let found = numbers.len();
        numbers.try_into().map_err(|_| self.fault(node, Fault::Count { found, wanted: N }))
    }

    /// The whole numbers that are an element's text.
    pub(super) fn wholes(&self, node: XmlNode<'a>) -> Result<Vec<usize>, FileError> {
        words(node).map(|word| self.whole(node, word)).collect()
    }

    fn whole(&self, node: XmlNode<'a>, word: &str) -> Result<usize, FileError> {
        word.parse().map_err(|_| self.fault(node, Fault::Whole(shorten(word))))
    }

    /// A whole number in an attribute, or `otherwise` where it is absent.
    pub(super) fn whole_attribute(
        &self,
        node: XmlNode<'a>,
        name: &'static str,
        otherwise: usize,
    ) -> Result<usize, FileError> {
        node.attribute(name).map_or(Ok(otherwise), |text| self.whole(node, text.trim()))
    }
}

/// Child elements of that tag, in any namespace.
pub(super) fn children<'a>(node: XmlNode<'a>, name: &'static str) -> impl Iterator<Item = XmlNode<'a>> {
    node.children().filter(move |child| child.tag_name().name() == name)
}

pub(super) fn child<'a>(node: XmlNode<'a>, name: &'static str) -> Option<XmlNode<'a>> {
    children(node, name).next()
}

/// Follows child elements down a path of tags.
pub(super) fn descend<'a>(node: XmlNode<'a>, path: &[&'static str]) -> Option<XmlNode<'a>> {
    path.iter().try_fold(node, |at, name| child(at, name))
}

/// The words of an element's text; comments between them are skipped.
fn words<'a>(node: XmlNode<'a>) -> impl Iterator<Item = &'a str> {
    let texts = node.children().filter(XmlNode::is_text);
    texts.flat_map(|text| text.text().unwrap_or_default().split_ascii_whitespace())
}

/// A hostile word may be as long as the file.
fn shorten(word: &str) -> String {
    word.chars().take(40).collect()
}
