//! The light of the leaves on a mesh.
use super::cutting::LeafPart;
use super::direct::Direct;
use super::equilibrium::{Equilibrium, largest};
use super::flow::{Linear, value};
use super::members::PlateMembers;
use super::tile::SQUARE;
use super::tiling::{Tile, Tiling};
use crate::mesh::{cover::Cover, cover::CoverTile, guests::Guests};
use crate::scene::Scene;
use crate::solve::interpolate::welds;
use crate::solve::ledger::Ledger;
use crate::solve::solution::{Gathered, Solution};
use glam::DVec2;

/// What the leaves receive, in the units of the bands, and what is known of it, in those of the scene.
#[derive(Debug)]
pub(super) struct LeafLight {
    /// What each leaf receives, band by band.
    pub(super) received: Vec<Vec<Linear>>,
    pub(super) bound: Vec<f64>,
    pub(super) ledger: Ledger,
    /// Σ|A ΔB| per band.
    unshot: Vec<f64>,
    /// How bright what is reflected is, per band.
    brightness: Vec<f64>,
}

impl LeafLight {
    /// The light when the tiles send so much.
    pub(super) fn of(
        tiling: &Tiling<'_>,
        equilibrium: &Equilibrium<'_>,
        sent: &[Vec<Linear>],
        direct: &Direct<'_>,
    ) -> LeafLight {
        let none = || Vec::with_capacity(sent.len());
        let ledger =
            Ledger { emitted: none(), absorbed: none(), escaped: none(), unshot: none(), defect: none() };
        let mut light =
            LeafLight { received: Vec::new(), bound: none(), ledger, unshot: none(), brightness: none() };
        for (band, sent) in sent.iter().enumerate() {
            light.add(tiling, equilibrium, &equilibrium.of_leaves(sent), direct, band);
        }
        light
    }

    /// Adds a band: with what the leaves send, b, and receive, H, what is unshot is e + ρH − b. What lamps send and no leaf receives escapes.
    fn add(
        &mut self,
        tiling: &Tiling<'_>,
        equilibrium: &Equilibrium<'_>,
        sent: &[Linear],
        direct: &Direct<'_>,
        band: usize,
    ) {
        let mut received = equilibrium.receive(sent);
        let reflectance = equilibrium.reflectance(band);
        let [mut emitted, mut absorbed, mut escaped, mut unshot, mut open, mut reflected, mut squares] =
            [0.0; 7];
        let power = direct.power(tiling, band);
        emitted += power;
        escaped += power;
        let mut residual = Vec::with_capacity(sent.len());
        for (leaf, &tile) in equilibrium.leaves().iter().enumerate() {
            let (area, rho) = (tiling.tiles[tile].area, reflectance[leaf]);
            let straight = direct.received(tile, band);
            received[leaf].iter_mut().zip(straight).for_each(|(h, straight)| *h += straight);
            let (b, h, sums) = (sent[leaf], received[leaf], equilibrium.sums(leaf));
            let beyond = direct.beyond(tile, band);
            emitted += area * beyond;
            escaped -= area * (straight[0] - beyond);
            let emittance = tiling.emittance(tile, band);
            let rest = [emittance + rho * h[0] - b[0], rho * h[1] - b[1], rho * h[2] - b[2]];
            emitted += area * emittance;
            absorbed += area * (1.0 - rho) * h[0];
            escaped += area * (b[0] * (1.0 - sums[0]) - SQUARE * (b[1] * sums[1] + b[2] * sums[2]));
            unshot += area * rest[0];
            open += area * rest[0].abs();
            reflected += area * rho * h[0];
            squares += area * (rho * h[0]).powi(2);
            residual.push(rest);
        }
        let (unit, ledger) = (tiling.units()[band], &mut self.ledger);
        ledger.emitted.push(unit * emitted);
        ledger.absorbed.push(unit * absorbed);
        ledger.escaped.push(unit * escaped);
        ledger.unshot.push(unit * unshot);
        ledger.defect.push(ledger.remainder(band));
        let residual = largest(&residual);
        self.bound.push(if residual == 0.0 { 0.0 } else { unit * residual / equilibrium.gap(&reflectance) });
        self.unshot.push(unit * open);
        self.brightness.push(if reflected > 0.0 { unit * squares / reflected } else { 0.0 });
        self.received.push(received);
    }

    /// The mean irradiance in each band, in its unit.
    pub(super) fn means(&self, equilibrium: &Equilibrium<'_>) -> Vec<f64> {
        let areas: Vec<f64> = (0..equilibrium.leaves().len()).map(|leaf| equilibrium.area(leaf)).collect();
        let mean = |received: &Vec<Linear>| {
            let power: f64 = received.iter().zip(&areas).map(|(light, area)| area * light[0]).sum();
            power / areas.iter().sum::<f64>()
        };
        self.received.iter().map(mean).collect()
    }

    /// Unshot over emitted power in the worst band.
    pub(super) fn unshot(&self) -> f64 {
        let shares = self.unshot.iter().zip(&self.ledger.emitted).filter(|(_, emitted)| **emitted > 0.0);
        shares.map(|(unshot, emitted)| unshot / emitted).fold(0.0, f64::max)
    }

    /// Whether the bound of every band is within a share of the brightness; where there is none, what is unshot.
    pub(super) fn is_within(&self, tolerance: f64) -> bool {
        let within =
            |(bound, brightness): (&f64, &f64)| !bound.is_finite() || *bound <= tolerance * brightness;
        self.unshot() <= tolerance && self.bound.iter().zip(&self.brightness).all(within)
    }
}

/// A mesh of pieces of the leaves, and the leaf that each element is a part of.
pub(super) fn cover(
    tiling: &Tiling<'_>,
    members: &PlateMembers<'_>,
    equilibrium: &Equilibrium<'_>,
    lines: &[Vec<[DVec2; 2]>],
    pieces: &[LeafPart],
) -> Cover {
    let mut of_patch = vec![Vec::new(); tiling.scene.patches.len()];
    for LeafPart { leaf, outline } in pieces {
        // Where leaves were looked from.
        let [middle, ..] = outline.points();
        let patch = equilibrium.patch(*leaf);
        let middle = (middle, tiling.lift(patch, middle));
        of_patch[patch].push(CoverTile { number: *leaf, corners: &outline.corners, middle });
    }
    let corners = of_patch.iter().flatten().flat_map(|tile| tile.corners.iter().map(|corner| corner.1));
    let (mut cover, all) = (Cover::default(), Guests::new(corners.chain(members.corners())));
    for (patch, (tiles, lines)) in of_patch.iter().zip(lines).enumerate() {
        let loops = tiling.scene.patches[patch].polygon.loops();
        let sides = loops.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
        let on_sides = sides.flat_map(|(start, end)| all.on([*start, *end]));
        let guests: Vec<_> = on_sides.map(|place| (tiling.flatten(patch, place), place)).collect();
        cover.add(patch, tiles, lines, &guests);
    }
    cover
}

/// The lines on each patch across which light jumps: where other patches touch it, and the edges of shadows of what is direct.
pub(super) fn lines(tiling: &Tiling<'_>, direct: &Direct<'_>) -> Vec<Vec<[DVec2; 2]>> {
    let edges = direct.edges(tiling).into_iter().enumerate();
    edges.map(|(patch, edges)| [tiling.contacts(patch), &edges].concat()).collect()
}

/// Light that is negative nowhere, with the same mean: less steep where that is needed.
fn positive(tile: &Tile, [mean, first, second]: Linear) -> Linear {
    let dip = |corner: &(glam::DVec2, glam::DVec3)| {
        let [a, b] = tile.outline.linear(corner.0);
        -(a * first + b * second)
    };
    let dip = tile.outline.corners.iter().map(dip).fold(0.0, f64::max);
    let mean = mean.max(0.0);
    let share = if dip > mean { mean / dip } else { 1.0 };
    [mean, share * first, share * second]
}

/// The solution of a scene on a mesh of the leaves, as far as it is known here.
pub(super) fn solution(
    scene: &Scene,
    tiling: &Tiling<'_>,
    equilibrium: &Equilibrium<'_>,
    light: &LeafLight,
    Cover { mesh, owners }: Cover,
) -> Solution {
    let bands = light.received.len();
    let [mut irradiance, mut radiosity, mut reflectance] =
        [(); 3].map(|()| Vec::with_capacity(owners.len() * bands));
    for (element, &leaf) in owners.iter().enumerate() {
        let index = equilibrium.leaves()[leaf];
        let tile = &tiling.tiles[index];
        let linear = tile.outline.linear(tiling.flatten(tile.patch, mesh.centroid(element)));
        for (band, received) in light.received.iter().enumerate() {
            let (here, unit) = (value(positive(tile, received[leaf]), linear), tiling.units()[band]);
            irradiance.push(unit * here);
            reflectance.push(tile.reflectance[band]);
            radiosity.push(unit * (tiling.emittance(index, band) + tile.reflectance[band] * here));
        }
    }
    Solution {
        bands,
        welds: welds(scene, &mesh),
        mesh,
        radiosity,
        irradiance,
        reflectance,
        ledger: light.ledger.clone(),
        bound: light.bound.clone(),
        estimate: None,
        in_view: None,
        transfers: None,
        gathered: None,
        fine: None,
        closure: None,
        scaling: Some(equilibrium.scaling()),
        shots: 0,
        products: 0,
        converged: false,
        fault: None,
        seconds: 0.0,
    }
}

/// The solution with what its vertices receive, in the units of the bands: elements are as bright as their vertices, and patches as bright as they were.
pub(super) fn with_vertices(
    scene: &Scene,
    tiling: &Tiling<'_>,
    mut solution: Solution,
    mut vertices: Vec<f64>,
) -> Solution {
    let bands = solution.bands;
    vertices.iter_mut().enumerate().for_each(|(at, light)| *light *= tiling.units()[at % bands]);
    let mean = |element: usize, band: usize| {
        let corners = solution.mesh.elements[element].corners;
        corners.map(|corner| vertices[corner * bands + band]).iter().sum::<f64>() / 3.0
    };
    let count = solution.mesh.elements.len();
    let shown: Vec<f64> = (0..count * bands).map(|at| mean(at / bands, at % bands)).collect();
    let [before, after] =
        [&solution.irradiance, &shown].map(|light| solution.patch_means(light, scene.patches.len()));
    for (at, shown) in shown.into_iter().enumerate() {
        let (patch, band) = (solution.mesh.elements[at / bands].patch, at % bands);
        // Where no vertex sees what the patch receives it is even.
        let [is, was] = [after[patch][band], before[patch][band]];
        let here = if is > 0.0 { was * (shown / is) } else { was };
        solution.radiosity[at] += solution.reflectance[at] * (here - solution.irradiance[at]);
        solution.irradiance[at] = here;
    }
    solution.gathered = Some(Gathered { elements: solution.irradiance.clone(), vertices });
    solution
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::patch::Patch;
    use formfactor::PlanarPolygon;

    /// Products leave a patch in the dark a little less than nothing, and level.
    #[test]
    fn less_than_nothing_is_nothing() {
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let patch = Patch::new("floor", PlanarPolygon::new([square]).unwrap(), vec![0.5], vec![0.0]);
        let scene = Scene { patches: vec![patch], bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        assert_eq!(positive(&tiling.tiles[0], [-1e-30, 0.0, 0.0]), [0.0; 3]);
        assert_eq!(positive(&tiling.tiles[0], [-1e-30, 1.0, -2.0]), [0.0; 3]);
    }
}
