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
            let origin = Origin { instance: index, primitive: number, polygon: 0 };
            self.add_primitive(instance, primitive, finish, origin)?;
        }
        Ok(())
    }

    fn add_primitive(
        &mut self,
        instance: &Instance<'a>,
        primitive: &Primitive<'a>,
        finish: Finish,
        origin: Origin,
    ) -> Result<(), Error> {
        let fault = |fault| self.file.fault(primitive.element, fault);
        let base = name_of(instance.visit.node, "patch");
        let count = self.counts.entry(base.into()).or_default();
        let mut flaws = Flaws::default();
        for (polygon, loops) in primitive.polygons.iter().enumerate() {
            if self.all.len() >= MAX_PATCHES {
                return Err(fault(Fault::TooMany { what: "polygons", limit: MAX_PATCHES }));
            }
            *count += 1;
            let number = *count;
            let loops = transformed(loops, &instance.visit.world);
            let pieces = planar(&loops, polygon, &mut flaws);
            let pieces = pieces.map_err(|source| fault(Fault::Shape { polygon, source }))?;
            let origin = Origin { polygon, ..origin };
            let draft =
                |(piece, polygon)| Draft { base: base.into(), number, piece, polygon, finish, origin };
            self.all.extend(pieces.into_iter().map(draft));
        }
        let place = self.file.place(primitive.element);
        self.warnings.extend(flaws.sentences().map(|sentence| format!("{place}: {base}: {sentence}")));
        Ok(())
    }
}

/// The polygon as it is, or, where it is not planar, its pieces, numbered from 1; nothing where it has no area.
fn planar(
    loops: &Polygon,
    polygon: usize,
    flaws: &mut Flaws,
) -> Result<Vec<(Option<usize>, PlanarPolygon)>, formfactor::Error> {
    match PlanarPolygon::new(loops) {
        Ok(polygon) => Ok(vec![(None, polygon)]),
        Err(formfactor::Error::NotPlanar { distance, .. }) => {
            flaws.bent.push((polygon, distance));
            Ok(split(loops).into_iter().zip(1..).map(|(piece, number)| (Some(number), piece)).collect())
        }
        Err(
            formfactor::Error::ZeroArea
            | formfactor::Error::NoLoops
            | formfactor::Error::TooFewVertices { .. },
        ) => {
            flaws.empty.push(polygon);
            Ok(Vec::new())
        }
        Err(other) => Err(other),
    }
}

/// What is wrong with a primitive's polygons and was mended.
#[derive(Default)]
struct Flaws {
    /// Those that are not planar, and by how much.
    bent: Vec<(usize, f64)>,
    /// Those that have no area.
    empty: Vec<usize>,
}

impl Flaws {
    /// One sentence for each kind of flaw.
    fn sentences(&self) -> impl Iterator<Item = String> {
        let worst = self.bent.iter().copied().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let bent = worst.map(|(polygon, distance)| {
            let count = self.bent.len();
            format!("{count} not planar (polygon {polygon} by {distance:.1e}); split into triangles")
        });
        let empty = self.empty.first().map(|polygon| {
            let count = self.empty.len();
            format!("{count} without area (the first is polygon {polygon}); left out")
        });
        bent.into_iter().chain(empty)
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
        texture: None,
        smoothing: None,
        origin: draft.origin,
    };
    drafts.into_iter().map(patch).collect()
}
