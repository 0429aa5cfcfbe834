//! From instances to patches: transformed, checked, split where needed, named.
use super::super::{Error, Fault};
use super::file::File;
use super::material::{Finish, finish};
use super::primitive::{Polygon, Primitive, primitives};
use super::split::split;
use super::walk::{Instance, name_of};
use crate::{Origin, Patch};
use formfactor::PlanarPolygon;
use glam::{DMat4, DVec3};
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap, HashSet};

/// More polygons than any solver takes; what the walk multiplies must end somewhere.
const MAX_PATCHES: usize = 1_000_000;

/// A patch before it has its name: `base`, the number of its polygon among those of that base, and its piece.
struct Draft {
    base: String,
    number: usize,
    piece: Option<usize>,
    polygon: PlanarPolygon,
    finish: Finish,
    origin: Origin,
}

/// The patches of all instances.
pub(super) fn patches<'a>(
    file: &File<'a>,
    instances: &[Instance<'a>],
    warnings: &mut Vec<String>,
) -> Result<Vec<Patch>, Error> {
    let mut geometries = HashMap::new();
    let mut drafts = Drafts { file, warnings, all: Vec::new(), counts: BTreeMap::new() };
    for (index, instance) in instances.iter().enumerate() {
        let primitives = match geometries.entry(instance.geometry) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(primitives(file, instance.geometry, drafts.warnings)?),
        };
        drafts.add(index, instance, primitives)?;
    }
    Ok(named(drafts.all, &drafts.counts))
}

/// The patches so far, and how many polygons each base name has.
struct Drafts<'d, 'a> {
    file: &'d File<'a>,
    warnings: &'d mut Vec<String>,
    all: Vec<Draft>,
    counts: BTreeMap<String, usize>,
}

impl<'a> Drafts<'_, 'a> {
    fn add(
        &mut self,
        index: usize,
        instance: &Instance<'a>,
        primitives: &[Primitive<'a>],
    ) -> Result<(), Error> {
        let world = &instance.visit.world;
        let flat = !(world.determinant().is_normal() && world.inverse().is_finite());
        if flat && !primitives.is_empty() {
            let place = self.file.place(instance.visit.node);
            self.warnings
                .push(format!("{place}: the node's transform flattens it to nothing; it is left out"));
            return Ok(());
        }
        for (number, primitive) in primitives.iter().enumerate() {
            let finish = finish(self.file, instance.element, primitive.material, self.warnings)?;
            for (polygon, loops) in primitive.polygons.iter().enumerate() {
                let origin = Origin { instance: index, primitive: number, polygon };
                self.add_polygon(instance, primitive, loops, finish, origin)?;
            }
        }
        Ok(())
    }

    fn add_polygon(
        &mut self,
        instance: &Instance<'a>,
        primitive: &Primitive<'a>,
        loops: &Polygon,
        finish: Finish,
        origin: Origin,
    ) -> Result<(), Error> {
        if self.all.len() >= MAX_PATCHES {
            let fault = Fault::TooMany { what: "polygons", limit: MAX_PATCHES };
            return Err(self.file.fault(primitive.element, fault));
        }
        let base = name_of(instance.visit.node, "patch");
        let count = self.counts.entry(base.into()).or_default();
        *count += 1;
        let number = *count;
        let loops = transformed(loops, &instance.visit.world);
        let draft = |polygon, piece| Draft { base: base.into(), number, piece, polygon, finish, origin };
        let warn = |why: String| {
            format!(
                "{}: {base}, polygon {} of this element: {why}",
                self.file.place(primitive.element),
                origin.polygon
            )
        };
        match PlanarPolygon::new(&loops) {
            Ok(polygon) => self.all.push(draft(polygon, None)),
            Err(formfactor::Error::NotPlanar { distance, .. }) => {
                let pieces = split(&loops);
                let count = pieces.len();
                self.warnings
                    .push(warn(format!("not planar by {distance:.3e}; split into {count} triangles")));
                let pieces = pieces.into_iter().zip(1..);
                self.all.extend(pieces.map(|(polygon, piece)| draft(polygon, Some(piece))));
            }
            Err(
                formfactor::Error::ZeroArea
                | formfactor::Error::NoLoops
                | formfactor::Error::TooFewVertices { .. },
            ) => {
                self.warnings.push(warn("no area; left out".into()));
            }
            Err(source) => {
                return Err(self
                    .file
                    .fault(primitive.element, Fault::Shape { polygon: origin.polygon, source }));
            }
        }
        Ok(())
    }
}

/// Into the world, without repeated vertices and holes of fewer than three; a mirrored solid keeps its outside outside.
fn transformed(loops: &Polygon, world: &DMat4) -> Polygon {
    let mirrored = world.determinant() < 0.0;
    let turn = |ring: &Vec<DVec3>| {
        let mut points: Vec<DVec3> = ring.iter().map(|point| world.transform_point3(*point)).collect();
        points.dedup();
        if points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if mirrored {
            points.reverse();
        }
        points
    };
    let loops = loops.iter().map(turn).enumerate();
    loops.filter(|(index, points)| *index == 0 || points.len() > 2).map(|(_, points)| points).collect()
}

/// Names the patches: the base alone where it has one polygon, `base.k` (from 1, in the order of the file, polygons left
/// out counted) where it has several, `base.k.m` for the pieces of a split one. Nodes of the same name are numbered
/// together; a name that is taken gets a `'`.
fn named(drafts: Vec<Draft>, counts: &BTreeMap<String, usize>) -> Vec<Patch> {
    let mut taken = HashSet::new();
    let name = |draft: &Draft| match draft.piece {
        Some(piece) => format!("{}.{}.{piece}", draft.base, draft.number),
        None if counts[&draft.base] > 1 => format!("{}.{}", draft.base, draft.number),
        None => draft.base.clone(),
    };
    let mut unique = |mut name: String| {
        while !taken.insert(name.clone()) {
            name.push('\'');
        }
        name
    };
    let patch = |draft: Draft| Patch {
        name: unique(name(&draft)),
        polygon: draft.polygon,
        reflectance: draft.finish.reflectance.into(),
        emission: draft.finish.emission.into(),
        origin: draft.origin,
    };
    drafts.into_iter().map(patch).collect()
}
