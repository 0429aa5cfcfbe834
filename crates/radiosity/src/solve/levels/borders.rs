//! The borders of shadows, along which pieces are cut: light bends there, and is smooth in between.
use super::line_tree::LineTree;
use super::tile::Outline;
use super::tiling::Tiling;
use crate::mesh::shadows::Shadows;
use glam::DVec2;

/// So many of the strongest lamps are looked at.
const LAMPS: usize = 4;
/// Where the borders lie in more planes than this there are none.
const PLANES: usize = 20_000;
/// What is inside of an outline by less than this share of the shorter axis passes it by.
const SCRATCH: f64 = 1e-4;
/// A border is worth a cut where more of it is inside than this share of the shorter axis,
const SHORT: f64 = 0.5;
/// and no less than this share of the area is cut off.
const SLIVER: f64 = 0.1;
/// So many borders are tried.
const TRIED: usize = 8;

/// The borders of shadows on patches.
pub(super) struct Borders<'b> {
    tiling: &'b Tiling<'b>,
    shadows: Option<Shadows<'b>>,
    /// Those of each patch that was asked for, in its frame.
    lines: Vec<Option<LineTree>>,
}

impl<'b> Borders<'b> {
    pub(super) fn new(tiling: &'b Tiling<'b>) -> Borders<'b> {
        let shadows = Some(Shadows::new(tiling.scene, LAMPS)).filter(|shadows| shadows.planes() <= PLANES);
        Borders { tiling, shadows, lines: tiling.scene.patches.iter().map(|_| None).collect() }
    }

    /// All borders on a patch that pass through an outline.
    pub(super) fn of(&mut self, patch: usize, outline: &Outline) -> Vec<usize> {
        let (tiling, shadows) = (self.tiling, &self.shadows);
        let lines = self.lines[patch].get_or_insert_with(|| {
            let lines = shadows.as_ref().map(|shadows| shadows.on(patch)).unwrap_or_default();
            LineTree::of(lines.into_iter().map(|ends| ends.map(|end| tiling.flatten(patch, end))).collect())
        });
        let near = lines.near(outline);
        let mut inside: Vec<usize> =
            self.within(patch, outline, &near).into_iter().map(|(_, line)| line).collect();
        inside.sort_unstable();
        inside
    }

    fn ends(&self, patch: usize) -> &[[DVec2; 2]] {
        self.lines[patch].as_ref().map_or(&[], |lines| &lines.ends)
    }

    /// Those of some borders that pass through an outline, the longest first, and how much of each does.
    pub(super) fn within(&self, patch: usize, outline: &Outline, some: &[usize]) -> Vec<(f64, usize)> {
        let lines = self.ends(patch);
        let least = SCRATCH * outline.axes[1].length();
        let inside = some.iter().map(|&line| (outline.within(lines[line]), line));
        let mut inside: Vec<(f64, usize)> = inside.filter(|(length, _)| *length > least).collect();
        inside.sort_by(|a, b| b.0.total_cmp(&a.0));
        inside
    }

    /// The parts on both sides of one of the borders.
    pub(super) fn cut(
        &self,
        patch: usize,
        outline: &Outline,
        inside: &[(f64, usize)],
    ) -> Option<[Outline; 2]> {
        let lines = self.ends(patch);
        let least = SHORT * outline.axes[1].length();
        let halves = |(_, line): &(f64, usize)| {
            let [start, end] = lines[*line];
            let halves = outline.cut([start, end - start], |flat| self.tiling.lift(patch, flat))?;
            (halves[0].area.min(halves[1].area) >= SLIVER * outline.area).then_some(halves)
        };
        inside.iter().take_while(|(length, _)| *length > least).take(TRIED).find_map(halves)
    }
}
