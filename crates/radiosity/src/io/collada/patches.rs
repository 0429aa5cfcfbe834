//! From instances to patches: each primitive with its material, where the node puts it.
use super::primitive::{Primitive, primitives};
use super::walk::{Instance, name_of};
use super::{file::File, images::Images, lights::AreaLamp, material::finish, material::is_double_sided};
use crate::io::error::FileError;
use crate::io::surface::place::Surfaces;
use crate::io::surface::polygon::{Corner, Facet};
use crate::io::{surface::facets, surface::finish::Finish, surface::finish::Surface};
use crate::scene::{
    finding::Finding,
    patch::{Origin, Patch},
};
use glam::{DVec2, DVec3};
use std::{collections::HashMap, collections::hash_map::Entry};

/// The patches of all instances, and where polygons were split or left out.
pub(super) fn patches<'a>(
    file: &File<'a>,
    instances: &[Instance<'a>],
    areas: &[AreaLamp<'a, '_>],
    images: &mut Images,
    warnings: &mut Vec<Finding>,
) -> Result<(Vec<Patch>, Vec<Origin>), FileError> {
    let mut geometries = HashMap::new();
    let (mut surfaces, mut flawed) = (Surfaces::default(), Vec::new());
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
                two_sided: is_double_sided(file, instance, primitive.element)?,
                origin: Origin { instance: index, primitive: number, polygon: 0 },
            };
            let added = surfaces.add(&surface, warnings);
            let polygons = added.map_err(|refusal| file.fault(primitive.element, refusal.into()))?;
            flawed.extend(polygons.into_iter().map(|polygon| Origin { polygon, ..surface.origin }));
        }
    }
    for lamp in areas {
        let added = surfaces.add(&area_surface(lamp, &[facet(&lamp.corners)]), warnings);
        added.map_err(|refusal| file.fault(lamp.instance.light, refusal.into()))?;
    }
    Ok((surfaces.named(), flawed))
}

/// A lamp's outline as a surface: it shines and reflects nothing.
fn area_surface<'s>(lamp: &AreaLamp<'s, '_>, facets: &'s [Facet]) -> Surface<'s> {
    Surface {
        name: name_of(lamp.instance.visit.node, "light"),
        place: "",
        facets,
        world: lamp.instance.visit.world,
        finish: Finish {
            material: "".into(),
            reflectance: [0.0; 3],
            emission: lamp.emission,
            image: None,
            spectra: None,
        },
        two_sided: false,
        origin: Origin::NOWHERE,
    }
}

fn facet(corners: &[DVec3]) -> Facet {
    let corner = |point: &DVec3| Corner { point: *point, place: DVec2::ZERO, normal: DVec3::ZERO };
    let loops = vec![corners.iter().map(corner).collect()];
    Facet { number: 0, loops, parts: Vec::new(), members: vec![0] }
}
