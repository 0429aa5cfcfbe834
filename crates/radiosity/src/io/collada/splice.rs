//! Edits to a file's text: everything else stays byte for byte.
//!
//! Where an `<instance_node>` makes one `<instance_geometry>` stand for several surfaces, it is replaced by a copy of the node that it
//! names, and edits are made in the copy.
use super::file::{File, XmlNode, child};
use super::walk::Instance;
use crate::escape::escape;
use crate::io::error::{Fault, FileError};
use crate::io::words::TOOL;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// The doors (`<instance_node>`s) that were opened into copies to come to a place; none for the file's own text.
pub(super) type Path<'a> = Vec<XmlNode<'a>>;

/// New text for a range of the old.
pub(super) type Edit = (Range<usize>, String);

/// The `<instance_node>`s on the way to an `<instance_geometry>` that is met more than once. Such a door's outer doors are
/// copied too, since they lead to the same element.
pub(super) fn copied_doors<'i, 'a: 'i>(
    instances: impl Iterator<Item = &'i Instance<'a>> + Clone,
) -> HashSet<XmlNode<'a>> {
    let mut met: HashMap<XmlNode, usize> = HashMap::new();
    for instance in instances.clone() {
        *met.entry(instance.element).or_default() += 1;
    }
    let several = instances.filter(|instance| met[&instance.element] > 1);
    several.flat_map(|instance| instance.visit.via.iter().copied()).collect()
}

/// The edits so far.
pub(super) struct Splice<'t, 'f, 'a> {
    pub(super) text: &'t str,
    pub(super) file: &'f File<'a>,
    /// By the copy that they are made in.
    edits: HashMap<Path<'a>, Vec<Edit>>,
    /// The doors that are replaced by copies, by the copy (or the file's own text) that they stand in.
    doors: HashMap<Path<'a>, Vec<XmlNode<'a>>>,
    /// New ids.
    used: HashSet<String>,
    /// The next number to try behind a stem.
    numbers: HashMap<String, usize>,
}

impl<'t, 'f, 'a> Splice<'t, 'f, 'a> {
    /// The text of a file, with no edits yet.
    pub(super) fn new(text: &'t str, file: &'f File<'a>) -> Splice<'t, 'f, 'a> {
        let (edits, doors, numbers) = (HashMap::new(), HashMap::new(), HashMap::new());
        Splice { text, file, edits, doors, used: HashSet::new(), numbers }
    }

    /// Opens the doors that are to be copied; returns the copy in which the instance behind them stands.
    pub(super) fn open(&mut self, via: &[XmlNode<'a>], copied: &HashSet<XmlNode<'a>>) -> Path<'a> {
        // What stands behind a door that is not copied is met once, and edited in the file's own text.
        if !via.last().is_some_and(|door| copied.contains(door)) {
            return Vec::new();
        }
        for (depth, door) in via.iter().enumerate() {
            let doors = self.doors.entry(via[..depth].to_vec()).or_default();
            if !doors.contains(door) {
                doors.push(*door);
            }
        }
        via.to_vec()
    }

    /// Names this program as the file's tool.
    pub(super) fn sign(&mut self) {
        let tool = format!("<authoring_tool>{TOOL}</authoring_tool>");
        let Some(asset) = child(self.file.root, "asset") else { return };
        let old = child(asset, "contributor").and_then(|contributor| child(contributor, "authoring_tool"));
        if let Some(old) = old {
            self.edit(Vec::new(), old.range(), tool);
        } else if let Some(first) = asset.first_child() {
            let start = first.range().start;
            self.edit(Vec::new(), start..start, format!("<contributor>{tool}</contributor>"));
        }
    }

    /// New text in a copy.
    pub(super) fn edit(&mut self, path: Path<'a>, range: Range<usize>, text: String) {
        self.edits.entry(path).or_default().push((range, text));
    }

    /// Lets an instance, in the copy `path`, show another geometry.
    pub(super) fn point_at(
        &mut self,
        instance: &Instance<'a>,
        geometry: &str,
        path: Path<'a>,
    ) -> Result<(), FileError> {
        let url = instance.element.attribute_node("url");
        let url = url.ok_or_else(|| self.file.fault(instance.element, Fault::Attribute("url")))?;
        self.edit(path, url.range_value(), format!("#{}", escape(geometry)));
        Ok(())
    }

    /// An id that neither the file nor an earlier call uses: the stem itself or the first free `stem-2`, `stem-3`, …
    pub(super) fn fresh(&mut self, stem: &str) -> String {
        let number = self.numbers.entry(stem.into()).or_insert(1);
        loop {
            let id = if *number == 1 { stem.to_owned() } else { format!("{stem}-{number}") };
            *number += 1;
            if !self.file.has_id(&id) && self.used.insert(id.clone()) {
                return id;
            }
        }
    }

    /// The old text of a range with the edits made in the copy `path`. Nesting ends where the walk ended it.
    pub(super) fn render(&mut self, range: Range<usize>, path: &Path<'a>) -> Result<String, FileError> {
        let mut edits = self.edits.remove(path).unwrap_or_default();
        for door in self.doors.remove(path).unwrap_or_default() {
            let mut inner = path.clone();
            inner.push(door);
            let node = self.file.target(door, "url", "node")?;
            self.rename(node, &inner);
            edits.push((door.range(), self.render(node.range(), &inner)?));
        }
        edits.sort_by_key(|(range, _)| range.start);
        Ok(spliced(self.text, range, &edits))
    }

    /// Ids are unique in a file: those of the copied node get new ones.
    fn rename(&mut self, node: XmlNode<'a>, path: &Path<'a>) {
        for id in node.descendants().filter_map(|inner| inner.attribute_node("id")) {
            let fresh = self.fresh(id.value());
            self.edit(path.clone(), id.range_value(), escape(&fresh));
        }
    }
}

/// The old text of a range with its edits, sorted; one inside an earlier one has nothing left to edit.
pub(super) fn spliced(text: &str, range: Range<usize>, edits: &[Edit]) -> String {
    let (mut new, mut at) = (String::new(), range.start);
    for (place, replacement) in edits {
        if place.start >= at {
            new.push_str(&text[at..place.start]);
            new.push_str(replacement);
            at = place.end;
        }
    }
    new.push_str(&text[at..range.end]);
    new
}
