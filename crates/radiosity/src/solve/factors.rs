//! Exact form factors from the elements to the pieces.
use crate::{Error, Scene, mesh::Subdivision};
use formfactor::{DifferentialArea, Enclosure};
use rayon::prelude::*;
use std::{collections::BTreeMap, sync::Arc};

/// How many numbers the kept columns may hold: 1 GiB.
const KEPT: usize = 1 << 27;

/// Columns of form factors: from the centroid of every element to one piece, all other patches occluding.
#[derive(Debug)]
pub(super) struct Factors<'s> {
    scene: &'s Scene,
    subdivision: &'s Subdivision,
    enclosure: Enclosure,
    receivers: Vec<DifferentialArea>,
    kept: BTreeMap<usize, Arc<[f64]>>,
}

impl<'s> Factors<'s> {
    /// Puts a receiver on the centroid of every element.
    pub(super) fn new(scene: &'s Scene, subdivision: &'s Subdivision) -> Result<Factors<'s>, Error> {
        let mesh = &subdivision.mesh;
        let receiver = |(index, element): (usize, &crate::Element)| {
            let patch = &scene.patches[element.patch];
            DifferentialArea::new(mesh.centroid(index), patch.polygon.normal())
                .map(|area| area.owned_by(element.patch))
                .map_err(|source| Error::Shape { patch: patch.name.clone(), source })
        };
        Ok(Factors {
            scene,
            subdivision,
            enclosure: Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect()),
            receivers: mesh.elements.iter().enumerate().map(receiver).collect::<Result<_, _>>()?,
            kept: BTreeMap::new(),
        })
    }

    /// The form factors from all elements to one piece. They never change, so they are kept while memory lasts.
    pub(super) fn column(&mut self, node: usize) -> Result<Arc<[f64]>, Error> {
        if let Some(column) = self.kept.get(&node) {
            return Ok(Arc::clone(column));
        }
        let column = self.find(node)?;
        if (self.kept.len() + 1) * column.len() <= KEPT {
            self.kept.insert(node, Arc::clone(&column));
        }
        Ok(column)
    }

    /// Finds the form factors from all elements to one piece: each by itself, so threads change nothing.
    fn find(&self, node: usize) -> Result<Arc<[f64]>, Error> {
        let Subdivision { mesh, nodes, flat } = self.subdivision;
        let patch = nodes[node].patch;
        if node == patch {
            let whole = |from| self.enclosure.form_factor(from, patch).value;
            return Ok(self.receivers.par_iter().with_min_len(8).map(whole).collect());
        }
        let piece = flat
            .outline(mesh, &mesh.elements[nodes[node].elements.clone()])
            .map_err(|source| Error::Shape { patch: self.scene.patches[patch].name.clone(), source })?;
        let part = |from| self.enclosure.form_factor_to_part(from, patch, &piece).value;
        Ok(self.receivers.par_iter().with_min_len(8).map(part).collect())
    }

    /// The largest |ΣF − 1| over the elements, for pieces that cover the patches once.
    pub(super) fn closure(&mut self, pieces: impl Iterator<Item = usize>) -> Result<f64, Error> {
        let mut sums = vec![0.0; self.receivers.len()];
        for node in pieces {
            for (sum, factor) in sums.iter_mut().zip(self.column(node)?.iter()) {
                *sum += factor;
            }
        }
        Ok(sums.iter().map(|sum| (sum - 1.0f64).abs()).fold(0.0, f64::max))
    }
}
