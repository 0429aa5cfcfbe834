//! What an aggregate reports covers what it takes. The heap is one, so this test stands alone.
mod common;

use arrow_array::{Array, ArrayRef, BinaryArray};
use arrow_schema::{DataType, Field, Schema};
use common::{Random, polygon_wkb, rectangle};
use datafusion_common::Result;
use datafusion_expr::function::AccumulatorArgs;
use datafusion_expr::{AggregateUDF, EmitTo};
use peak_alloc::PeakAlloc;
use polycsg_datafusion::Functions;
use std::sync::Arc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

fn aggregate(functions: Functions) -> AggregateUDF {
    functions.aggregates().remove(0)
}

fn accumulator(function: &AggregateUDF) -> Result<Box<dyn datafusion_expr::GroupsAccumulator>> {
    let field = Arc::new(Field::new("geom", DataType::Binary, true));
    let schema = Schema::new(vec![field.clone()]);
    function.create_groups_accumulator(AccumulatorArgs {
        return_field: function.return_field(std::slice::from_ref(&field))?,
        schema: &schema,
        ignore_nulls: false,
        order_bys: &[],
        is_reversed: false,
        name: "union",
        is_distinct: false,
        exprs: &[],
        expr_fields: &[field],
    })
}

type Shapes = Box<dyn FnMut(&mut Random) -> Vec<u8>>;

/// Batches of shapes, and how many groups they are dealt out to.
fn inputs() -> Vec<(&'static str, usize, Vec<ArrayRef>)> {
    let mut random = Random(11);
    let mut batches = |count: usize, mut shape: Shapes| -> Vec<ArrayRef> {
        let mut batch =
            || -> ArrayRef { Arc::new(BinaryArray::from_iter_values((0..1000).map(|_| shape(&mut random)))) };
        (0..count).map(|_| batch()).collect()
    };
    let octagon = |side: f64| move |random: &mut Random| polygon_wkb(&[random.octagon(side, 1.0)]);
    let star = |random: &mut Random| {
        let [x, y] = [random.number() * 2000.0, random.number() * 2000.0];
        let corner = |i: u32| {
            let (angle, radius) =
                (f64::from(i) * 0.031_415_926, if i.is_multiple_of(2) { 20.0 } else { 12.0 });
            [x + radius * angle.cos(), y + radius * angle.sin()]
        };
        polygon_wkb(&[(0..200).map(corner).collect()])
    };
    vec![
        ("one crowded group", 1, batches(20, Box::new(octagon(280.0)))),
        ("one group of shapes apart", 1, batches(20, Box::new(octagon(20_000.0)))),
        ("many groups", 500, batches(20, Box::new(octagon(280.0)))),
        ("one group of stars", 1, batches(2, Box::new(star))),
    ]
}

/// Blocks of 100 parcels that share their edges; blocks do not touch.
fn blocks() -> Vec<ArrayRef> {
    let cell = |i: usize| {
        let [block, row, column] = [i / 100, i / 10 % 10, i % 10].map(|n| n as f64);
        polygon_wkb(&[rectangle([block * 11.0 + column, row], [1.0, 1.0])])
    };
    let batch = |first: usize| -> ArrayRef {
        Arc::new(BinaryArray::from_iter_values((first..first + 1000).map(cell)))
    };
    (0..20).map(|batch_number| batch(1000 * batch_number)).collect()
}

#[test]
fn what_is_reported_covers_what_is_taken() -> Result<()> {
    let unlimited = aggregate(Functions::default());
    for (name, groups, batches) in inputs() {
        holds(name, &unlimited, groups, &batches)?;
    }
    // In small parts, whatever all of them take together.
    let limited = aggregate(Functions::default().bytes(1 << 20));
    let (name, groups, apart) = inputs().remove(1);
    holds(name, &limited, groups, &apart)?;
    holds("blocks in parts", &limited, 1, &blocks())
}

/// Of an accumulator that is asked for its result, and of one that is asked for its state.
fn holds(name: &str, function: &AggregateUDF, groups: usize, batches: &[ArrayRef]) -> Result<()> {
    let before = HEAP.current_usage();
    let (mut filled, reported) = filled(name, function, groups, batches)?;
    HEAP.reset_peak_usage();
    let result = filled.evaluate(EmitTo::All)?;
    let taken = HEAP.peak_usage() - before;
    assert!(taken <= reported, "{name}: {taken} bytes taken, {reported} reported");
    assert!(reported <= 24 * taken, "{name}: {taken} bytes taken, {reported} reported");
    drop((filled, result));
    let before = HEAP.current_usage();
    let (mut filled, reported) = self::filled(name, function, groups, batches)?;
    HEAP.reset_peak_usage();
    filled.state(EmitTo::All)?;
    let taken = HEAP.peak_usage() - before;
    assert!(taken <= reported, "{name}: {taken} bytes taken by the state, {reported} reported");
    Ok(())
}

/// An accumulator of all batches, and the most that it reported.
fn filled(
    name: &str,
    function: &AggregateUDF,
    groups: usize,
    batches: &[ArrayRef],
) -> Result<(Box<dyn datafusion_expr::GroupsAccumulator>, usize)> {
    let before = HEAP.current_usage();
    let (mut accumulator, mut reported) = (accumulator(function)?, 0);
    for batch in batches {
        let indices: Vec<usize> = (0..batch.len()).map(|row| row % groups).collect();
        accumulator.update_batch(std::slice::from_ref(batch), &indices, None, groups)?;
        reported = reported.max(accumulator.size());
        // A batch is read beside the state, as engines let functions do; what stays is what counts.
        let held = HEAP.current_usage() - before;
        assert!(held <= accumulator.size(), "{name}: {held} bytes held, {} reported", accumulator.size());
    }
    Ok((accumulator, reported))
}
