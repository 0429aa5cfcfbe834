//! Features as regions, and which of them meet.
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::layer::areas::Areas;
use crate::layer::batch::{Batch, Layer};
use crate::layer::columns::named;
use geo_index::rtree::sort::HilbertSort;
use geo_index::rtree::{RTree, RTreeBuilder, RTreeIndex};
use polycsg::{Csg, Error, Limits, Region, Scratch};
use rayon::prelude::*;

/// The polygons of a feature as an operand; an error names ring and vertex.
pub(crate) fn operand(areas: &Areas) -> Result<Csg<'static>, Error> {
    Csg::try_from(&areas.polygons)
}

/// A valid region of an expression, or a stop.
pub(crate) fn evaluated(
    expression: &Csg<'_>,
    scratch: &mut Scratch,
    interrupt: &Interrupt,
) -> Result<Region, Error> {
    expression.try_evaluate_with(scratch, Limits::default().stop(&|| interrupt.is_set()))
}

/// Something for each feature of a batch on all threads, in their order. Without a geometry there is none to ask.
pub(crate) fn each<T: Send>(
    layer: &Layer,
    batch: &Batch,
    find: impl Fn(&mut Scratch, &Areas) -> Result<T, Error> + Sync,
) -> Result<Vec<Option<T>>, Failure> {
    let found: Vec<_> = (batch.areas.par_iter())
        .map_init(Scratch::default, |scratch, areas| {
            areas.as_ref().map(|areas| find(scratch, areas)).transpose()
        })
        .collect();
    let of_row = |(row, found): (usize, Result<Option<T>, Error>)| {
        found.map_err(|error| match error {
            Error::Stopped => Failure::Interrupted,
            error => Failure::data(&layer.name, format!("{}: {error}", named(layer, batch, row))),
        })
    };
    found.into_iter().enumerate().map(of_row).collect()
}

/// The features of a batch as regions; empty where there is no geometry.
pub(crate) fn regions(layer: &Layer, batch: &Batch, interrupt: &Interrupt) -> Result<Vec<Region>, Failure> {
    let region = |scratch: &mut Scratch, areas: &Areas| evaluated(&operand(areas)?, scratch, interrupt);
    Ok(each(layer, batch, region)?.into_iter().map(Option::unwrap_or_default).collect())
}

/// Left, low, right and high; none of an empty region.
pub(crate) fn bounds(region: &Region) -> Option<[f64; 4]> {
    let points = region.polygons().flat_map(|polygon| polygon.outer());
    points.fold(None, |bounds, p| {
        let [left, low, right, high] = bounds.unwrap_or([p.x, p.y, p.x, p.y]);
        Some([left.min(p.x), low.min(p.y), right.max(p.x), high.max(p.y)])
    })
}

/// An index of regions by their boxes.
pub(crate) struct Boxes {
    /// None where all regions are empty.
    tree: Option<RTree<f64>>,
    /// The numbers of those that are not.
    filled: Vec<u32>,
}

impl Boxes {
    pub(crate) fn of<'r>(regions: impl Iterator<Item = &'r Region>) -> Boxes {
        let boxes: Vec<_> = (0..).zip(regions).filter_map(|(i, region)| Some((i, bounds(region)?))).collect();
        let filled: Vec<u32> = boxes.iter().map(|(i, _)| *i).collect();
        let count = u32::try_from(filled.len()).expect("features are counted in 32 bits");
        let mut builder = RTreeBuilder::<f64>::new(count);
        for (_, [left, low, right, high]) in boxes {
            builder.add(left, low, right, high);
        }
        Boxes { tree: (count > 0).then(|| builder.finish::<HilbertSort>()), filled }
    }

    /// The numbers of those whose box meets that of a region, in order.
    pub(crate) fn near(&self, region: &Region) -> Vec<u32> {
        let (Some(tree), Some([left, low, right, high])) = (&self.tree, bounds(region)) else {
            return vec![];
        };
        let mut found = tree.search(left, low, right, high);
        found.sort_unstable();
        found.into_iter().map(|i| self.filled[i as usize]).collect()
    }
}
