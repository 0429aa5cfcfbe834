//! From instances to patches: each primitive with its material, where the node puts it.
use super::primitive::{Primitive, primitives};
use super::walk::{Instance, name_of};
use super::{file::File, images::Images, material::finish, material::is_double_sided};
use crate::io::error::FileError;
use crate::io::surface::place::Surfaces;
use crate::io::{surface::facets, surface::finish::Surface};
use crate::scene::{
    finding::Finding,
    patch::{Origin, Patch},
};
use std::{collections::HashMap, collections::hash_map::Entry};

/// The patches of all instances.
pub(super) fn patches<'a>(
    file: &File<'a>,
    instances: &[Instance<'a>],
    images: &mut Images,
    warnings: &mut Vec<Finding>,
) -> Result<Vec<Patch>, FileError> {
    let mut geometries = HashMap::new();
    let mut surfaces = Surfaces::default();
    for (index, instance) in instances.iter().enumerate() {
        let primitives: &mut Vec<Primitive<'a>> = match geometries.entry(instance.geometry) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(primitives(file, instance.geometry, warnings)?),
        };
        let filled = primitives.iter().enumerate().filter(|(_, primitive)| !primitive.polygons.is_empty());
        for (number, primitive) in filled {
            let finish = finish(file, instance.element, primitive.material, images, warnings)?;
            let facets = facets(&primitive.polygons, primitive.is_cut, finish.image.is_some());
            let surface = Surface {
                name: name_of(instance.visit.node, "patch"),
                place: &file.place(primitive.element),
                facets: &facets,
                world: instance.visit.world,
                finish,
                two_sided: is_double_sided(file, instance, primitive.material)?,
                origin: Origin { instance: index, primitive: number, polygon: 0 },
            };
            let added = surfaces.add(&surface, warnings);
            added.map_err(|refusal| file.fault(primitive.element, refusal.into()))?;
        }
    }
    Ok(surfaces.named())
}
