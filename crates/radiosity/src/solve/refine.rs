//! Which cells need to be finer: the local error by the difference to a higher-order basis.
//!
//! An element carries one radiosity B; the linear function u through the means at its corners is the better guess, and
//! u − B estimates what the mesh does not resolve (Gomes 2010, section 2.8).
use super::{magnitude::mean_by_itself, norm::Norm, solution::Solution};
use crate::mesh::{element::Element, lattice::LEVELS, plan::Plan, subdivide::Subdivision};

impl Solution {
    /// The estimated error of every element, in shares of the brightness of what is reflected, the bands added up.
    ///
    /// An element with radiosity B has the error ‖u − B‖, where u is linear between the radiosities at its corners.
    #[must_use]
    pub fn error_estimate(&self, norm: Norm) -> Vec<f64> {
        let vertices = self.vertex_radiosity();
        let weights = self.weights();
        let estimate = |(index, element): (usize, &Element)| {
            let bands = (0..self.bands).filter(|&band| weights[band] > 0.0);
            let area = self.mesh.area(index);
            let in_band = |band: usize| {
                let here = self.radiosity[index * self.bands + band];
                let there = element.corners.map(|corner| vertices[corner * self.bands + band] - here);
                norm.of(there.map(|difference| difference * weights[band]), area)
            };
            bands.map(in_band).sum()
        };
        self.mesh.elements.iter().enumerate().map(estimate).collect()
    }

    /// 1 / brightness of every band; 0 where nothing is bright.
    fn weights(&self) -> Vec<f64> {
        let areas: Vec<f64> = (0..self.mesh.elements.len()).map(|element| self.mesh.area(element)).collect();
        let brightness = mean_by_itself(&self.radiosity, &areas, self.bands);
        brightness.iter().map(|b| if *b > 0.0 { 1.0 / b } else { 0.0 }).collect()
    }
}

/// A plan that halves the cells of the largest estimated error until there are about `elements` elements. That halving a
/// cell halves its error is what all these norms have in common where light is smooth.
pub(super) fn refine(
    plan: &Plan,
    subdivision: &Subdivision,
    solution: &Solution,
    norm: Norm,
    elements: usize,
) -> Plan {
    let starts: Vec<usize> = subdivision
        .cell_counts
        .iter()
        .scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count)))
        .collect();
    let mut cells = vec![Cell::default(); subdivision.cell_counts.iter().sum()];
    for (index, error) in solution.error_estimate(norm).into_iter().enumerate() {
        let patch = subdivision.mesh.elements[index].patch;
        let cell = &mut cells[starts[patch] + subdivision.cells[index]];
        cell.error = norm.join(cell.error, error);
        cell.elements += 1;
        cell.level = plan.levels.get(patch).map_or(0, |levels| levels[subdivision.cells[index]]);
    }
    let mut count = subdivision.mesh.elements.len();
    let mut order: Vec<usize> = (0..cells.len()).collect();
    while count < elements && !order.is_empty() {
        order.retain(|&cell| {
            cells[cell].level < LEVELS && cells[cell].elements > 0 && cells[cell].error > 0.0
        });
        order.sort_by(|&a, &b| cells[b].error.total_cmp(&cells[a].error));
        // A quarter at a time, so that a cell may be halved again before a better one is at all.
        for &cell in order.iter().take(order.len().div_ceil(4)) {
            if count >= elements {
                break;
            }
            count += 3 * cells[cell].elements;
            cells[cell].halve();
        }
    }
    let levels = subdivision.cell_counts.iter().zip(&starts);
    let levels =
        levels.map(|(&count, &start)| cells[start..start + count].iter().map(|cell| cell.level).collect());
    Plan { levels: levels.collect(), ..plan.clone() }
}

/// A cell of a patch's lattice.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    error: f64,
    elements: usize,
    level: u8,
}

impl Cell {
    fn halve(&mut self) {
        self.error /= 2.0;
        self.elements *= 4;
        self.level += 1;
    }
}
