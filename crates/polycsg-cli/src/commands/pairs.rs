//! A layer held as regions, and what others have in common with it or apart from it.
use crate::failure::Failure;
use crate::formats::reader::Source;
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::batch::Layer;
use crate::operands::{Boxes, evaluated, regions};
use arrow_array::RecordBatch;
use arrow_select::concat::concat_batches;
use polycsg::{Csg, Error, PreparedRegion, Region, Scratch};
use rayon::prelude::*;
use std::sync::Arc;

/// All features of a layer.
pub(crate) struct HeldLayer {
    pub(crate) layer: Layer,
    pub(crate) attributes: RecordBatch,
    pub(crate) regions: Vec<PreparedRegion>,
    boxes: Boxes,
}

/// Parts of features, each with the places of those that it is of.
#[derive(Default)]
pub(crate) struct Parts {
    /// Places in the first layer.
    pub(crate) first: Vec<u32>,
    /// Places in the layer that is held.
    pub(crate) second: Vec<u32>,
    pub(crate) areas: Vec<Option<Areas>>,
}

/// So many pairs are asked at a time.
const MOST_PAIRS: usize = 1 << 14;

impl HeldLayer {
    pub(crate) fn read(source: Box<dyn Source>, interrupt: &Interrupt) -> Result<HeldLayer, Failure> {
        let (layer, mut all, mut tables) = (source.layer().clone(), Vec::new(), Vec::new());
        source.read(&mut |batch| {
            all.par_extend(prepared(regions(&layer, &batch, interrupt)?));
            tables.push(batch.attributes);
            Ok(())
        })?;
        let attributes = if layer.schema.fields().is_empty() {
            crate::layer::batch::table(Arc::clone(&layer.schema), vec![], all.len())
        } else {
            concat_batches(&layer.schema, &tables)
        };
        let attributes = attributes.map_err(|error| Failure::data(&layer.name, error))?;
        let boxes = Boxes::of(all.iter().map(PreparedRegion::region));
        Ok(HeldLayer { layer, attributes, regions: all, boxes })
    }

    /// What each of some regions has in common with each of these, in the order of both.
    pub(crate) fn common(
        &self,
        others: &[PreparedRegion],
        interrupt: &Interrupt,
        each: &mut dyn FnMut(Parts) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let near: Vec<Vec<u32>> = others.par_iter().map(|other| self.boxes.near(other.region())).collect();
        let pairs: Vec<[u32; 2]> =
            (0..).zip(near).flat_map(|(a, near)| near.into_iter().map(move |b| [a, b])).collect();
        for pairs in pairs.chunks(MOST_PAIRS) {
            let common = |scratch: &mut Scratch, &[a, b]: &[u32; 2]| {
                let both = Csg::from(&others[a as usize]) & Csg::from(&self.regions[b as usize]);
                evaluated(&both, scratch, interrupt)
            };
            let found = found(pairs, common)?;
            let mut parts = Parts::default();
            for (&[a, b], part) in pairs.iter().zip(&found).filter(|(_, part)| !part.is_empty()) {
                parts.first.push(a);
                parts.second.push(b);
                parts.areas.push(Areas::of(part));
            }
            each(parts)?;
        }
        Ok(())
    }

    /// What is left of some regions without all of these; those of which nothing is left are left out.
    pub(crate) fn apart(&self, others: &[PreparedRegion], interrupt: &Interrupt) -> Result<Parts, Failure> {
        let rest = |scratch: &mut Scratch, other: &PreparedRegion| {
            let near = self.boxes.near(other.region());
            let near = Csg::union(near.iter().map(|&b| Csg::from(&self.regions[b as usize])));
            evaluated(&(Csg::from(other) - near), scratch, interrupt)
        };
        let found = found(others, rest)?;
        let mut parts = Parts::default();
        for (a, part) in (0..).zip(&found).filter(|(_, part)| !part.is_empty()) {
            parts.first.push(a);
            parts.areas.push(Areas::of(part));
        }
        Ok(parts)
    }
}

/// Regions with an index each.
pub(crate) fn prepared(regions: Vec<Region>) -> impl IndexedParallelIterator<Item = PreparedRegion> {
    regions.into_par_iter().map(PreparedRegion::from)
}

fn found<T: Sync>(
    of: &[T],
    find: impl Fn(&mut Scratch, &T) -> Result<Region, Error> + Sync + Send,
) -> Result<Vec<Region>, Failure> {
    let found: Result<Vec<Region>, Error> = of.par_iter().map_init(Scratch::default, find).collect();
    // Regions have no other error.
    found.map_err(|_| Failure::Interrupted)
}
