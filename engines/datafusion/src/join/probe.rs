//! A batch of the right input against the held left one.
use super::build::{Build, features};
use super::condition::Condition;
use super::overlaid::Overlaid;
use crate::column::features::Features;
use crate::column::write::Written;
use crate::error::Error;
use crate::scalar::pairs::{Overlay, Pairs, Relation};
use arrow_array::cast::AsArray;
use arrow_array::{ArrayRef, RecordBatch, RecordBatchOptions, UInt64Array};
use arrow_schema::SchemaRef;
use arrow_select::take::take;
use datafusion_common::{JoinSide, Result};
use datafusion_physical_plan::joins::utils::{ColumnIndex, JoinFilter};
use geo_types::MultiPolygon;
use polycsg::Region;
use std::sync::Arc;

/// So many candidates are looked at in one order.
const CANDIDATES: usize = 1 << 16;

/// Pairs of so many points in all are looked at in one step, so that a query that is cancelled ends soon.
const POINTS: usize = 1 << 17;

/// What a join gives.
#[derive(Debug)]
pub(crate) struct Output {
    pub(crate) schema: SchemaRef,
    /// The columns of the inputs.
    pub(crate) columns: Vec<ColumnIndex>,
    /// Those behind them.
    pub(crate) overlaid: Vec<Overlaid>,
    /// The most rows of a batch.
    pub(crate) batch_size: usize,
}

/// A batch of the right input, and how far it was compared.
pub(crate) struct Probe {
    build: Arc<Build>,
    batch: RecordBatch,
    features: Arc<Features>,
    pairs: Pairs,
    /// The rows of the right input whose candidates were listed.
    listed: usize,
    /// The rows of both sides whose boxes meet; those that were not looked at.
    candidates: std::vec::IntoIter<[usize; 2]>,
}

impl Probe {
    pub(crate) fn new(build: Arc<Build>, batch: RecordBatch, condition: &Condition) -> Result<Probe> {
        let features = Arc::new(features(&batch, &condition.keys[1])?);
        let sides = [Arc::clone(&build.features), Arc::clone(&features)];
        let pairs = Pairs::new(sides, condition.contacts);
        Ok(Probe { build, batch, features, pairs, listed: 0, candidates: Vec::new().into_iter() })
    }

    /// The next rows, maybe none; none at all, if the batch is done.
    pub(crate) fn step(&mut self, condition: &Condition, output: &Output) -> Result<Option<RecordBatch>> {
        if self.candidates.as_slice().is_empty() && !self.list() {
            return Ok(None);
        }
        let candidates = self.next_candidates(output.batch_size);
        let candidates = self.passing(candidates, condition.rest.as_ref())?;
        let (mut written, mut rows) = (Columns::new(&output.overlaid)?, [vec![], vec![]]);
        for pair in candidates {
            if self.compare(pair, condition, &mut written)? {
                (0..2).for_each(|side| rows[side].push(pair[side] as u64));
            }
        }
        let mut columns = self.taken(&output.columns, &rows.map(UInt64Array::from))?;
        let options = RecordBatchOptions::new().with_row_count(Some(written.rows));
        columns.extend(written.finish());
        Ok(Some(RecordBatch::try_new_with_options(Arc::clone(&output.schema), columns, &options)?))
    }

    /// Lists candidates of some more rows; false, if there are no more.
    fn list(&mut self) -> bool {
        let (mut found, mut pairs) = (Vec::new(), Vec::new());
        while self.listed < self.features.len() && pairs.len() < CANDIDATES {
            if let Some(feature) = self.features.at(self.listed) {
                self.build.tree.find(&self.features.bounds(feature), &mut found);
                pairs.extend(found.drain(..).map(|row| [row, self.listed]));
            }
            self.listed += 1;
        }
        // An area stays prepared as long as pairs of it follow one another, so points are the side that changes.
        let is_point = |pair: &[usize; 2]| {
            self.build.features.at(pair[0]).is_some_and(|it| self.build.features.point(it).is_some())
        };
        match pairs.iter().any(is_point) {
            true => pairs.sort_unstable_by_key(|&[left, right]| [right, left]),
            false => pairs.sort_unstable(),
        }
        let is_any = !pairs.is_empty();
        self.candidates = pairs.into_iter();
        is_any
    }

    fn next_candidates(&mut self, most: usize) -> Vec<[usize; 2]> {
        let mut points = 0;
        let mut next = Vec::new();
        while next.len() < most && points < POINTS {
            let Some(pair) = self.candidates.next() else { break };
            let count = |features: &Features, row| features.at(row).map_or(0, |it| features.point_count(it));
            points += count(&self.build.features, pair[0]) + count(&self.features, pair[1]);
            next.push(pair);
        }
        next
    }

    /// Those of the pairs that the rest of the filter lets pass.
    fn passing(&self, pairs: Vec<[usize; 2]>, rest: Option<&JoinFilter>) -> Result<Vec<[usize; 2]>> {
        let Some(rest) = rest else { return Ok(pairs) };
        let side = |side: usize| pairs.iter().map(|pair| pair[side] as u64).collect::<UInt64Array>();
        let columns = self.taken(rest.column_indices(), &[side(0), side(1)])?;
        let options = RecordBatchOptions::new().with_row_count(Some(pairs.len()));
        let batch = RecordBatch::try_new_with_options(Arc::clone(rest.schema()), columns, &options)?;
        let passes = rest.expression().evaluate(&batch)?.into_array(pairs.len())?;
        let passes = passes.as_boolean().iter().map(|it| it == Some(true));
        Ok(pairs.into_iter().zip(passes).filter(|(_, passes)| *passes).map(|(pair, _)| pair).collect())
    }

    fn taken(&self, columns: &[ColumnIndex], [left, right]: &[UInt64Array; 2]) -> Result<Vec<ArrayRef>> {
        let taken = |column: &ColumnIndex| match column.side {
            JoinSide::Left => take(self.build.rows.column(column.index), left, None),
            _ => take(self.batch.column(column.index), right, None),
        };
        Ok(columns.iter().map(taken).collect::<Result<_, _>>()?)
    }

    /// Whether a pair is one of the join's; if so, what is made of it is written.
    fn compare(
        &mut self,
        rows: [usize; 2],
        condition: &Condition,
        written: &mut Columns<'_>,
    ) -> Result<bool> {
        let (Some(a), Some(b)) = (self.build.features.at(rows[0]), self.features.at(rows[1])) else {
            return Ok(false);
        };
        let is_area = |features: &Features, feature| features.point(feature).is_none();
        let are_areas = is_area(&self.build.features, a) && is_area(&self.features, b);
        let common = if written.has_intersection() && are_areas && condition.relation == Relation::Intersects
        {
            let Some(common) = self.pairs.common([a, b], rows[1])? else { return Ok(false) };
            Some(common)
        } else {
            let holds = |pairs: &mut Pairs, pair| pairs.holds(condition.relation, pair, rows[1]);
            if !self.pairs.turned(condition.is_swapped, [a, b], holds)? {
                return Ok(false);
            }
            None
        };
        written.push(&mut self.pairs, common, [a, b], rows[1], are_areas)?;
        Ok(true)
    }
}

/// The columns of Booleans in the making.
struct Columns<'o> {
    overlaid: &'o [Overlaid],
    written: Vec<Written>,
    rows: usize,
}

impl<'o> Columns<'o> {
    fn new(overlaid: &'o [Overlaid]) -> Result<Columns<'o>> {
        let written = overlaid.iter().map(|it| Written::new(&it.field)).collect::<Result<_>>()?;
        Ok(Columns { overlaid, written, rows: 0 })
    }

    fn has_intersection(&self) -> bool {
        self.overlaid.iter().any(|it| it.overlay == Overlay::Intersection)
    }

    /// One more row.
    fn push(
        &mut self,
        pairs: &mut Pairs,
        common: Option<Region>,
        pair: [usize; 2],
        row: usize,
        are_areas: bool,
    ) -> Result<()> {
        self.rows += 1;
        for (overlaid, written) in self.overlaid.iter().zip(&mut self.written) {
            if !are_areas {
                return Err(Error::row(row, "a Polygon or a MultiPolygon is needed, not a Point").into());
            }
            let found = match &common {
                Some(common) if overlaid.overlay == Overlay::Intersection => MultiPolygon::from(common),
                _ => {
                    let overlay = |pairs: &mut Pairs, pair| pairs.overlay(overlaid.overlay, pair, row);
                    MultiPolygon::from(&pairs.turned(overlaid.is_swapped, pair, overlay)?)
                }
            };
            written.push(Some(&found))?;
        }
        Ok(())
    }

    fn finish(self) -> Vec<ArrayRef> {
        self.written.into_iter().map(Written::finish).collect()
    }
}
