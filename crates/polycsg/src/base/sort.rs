//! Sorts, and counts what is sorted.

use super::meter::{Meter, Refusal};
use super::threads::Threads;
use std::cmp::Ordering;

/// Fewer items are sorted quickly, and not counted: who lists them does so.
const FEW: usize = 1 << 10;

/// More items take so long that the caller is asked in between.
const MANY: usize = if cfg!(test) { FEW } else { 1 << 20 };

/// Sorts by an order in which only what is the same is equal, or where it does not matter which of equals is first.
///
/// # Errors
/// Those of the meter's limits.
#[inline]
pub(crate) fn sort<T>(
    items: &mut [T],
    mut order: impl FnMut(&T, &T) -> Ordering,
    meter: &Meter<'_>,
) -> Result<(), Refusal> {
    if items.len() > MANY && meter.is_limited() {
        return sort_halves(items, &mut order, meter);
    }
    items.sort_unstable_by(order);
    count(items.len(), meter)
}

#[cold]
fn sort_halves<T>(
    items: &mut [T],
    order: &mut impl FnMut(&T, &T) -> Ordering,
    meter: &Meter<'_>,
) -> Result<(), Refusal> {
    meter.spend(items.len())?;
    if items.len() <= MANY {
        items.sort_unstable_by(order);
        return Ok(());
    }
    let (low, _, high) = items.select_nth_unstable_by(items.len() / 2, &mut *order);
    sort_halves(low, order, meter)?;
    sort_halves(high, order, meter)
}

/// The same on some threads.
///
/// # Errors
/// Those of the meter's limits.
#[inline]
pub(crate) fn sort_on<T: Send>(
    threads: Threads,
    items: &mut [T],
    order: impl Fn(&T, &T) -> Ordering + Sync,
    meter: &Meter<'_>,
) -> Result<(), Refusal> {
    threads.sort(items, order);
    count(items.len(), meter)
}

#[inline]
fn count(items: usize, meter: &Meter<'_>) -> Result<(), Refusal> {
    if items < FEW { Ok(()) } else { meter.spend(items) }
}

#[cfg(test)]
mod tests {
    use super::{Refusal, sort};
    use crate::base::meter::Meter;
    use crate::limits::Limits;
    use proptest::prelude::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    proptest! {
        /// With the caller asked in between as without.
        #[test]
        fn any_list(items in (1..9000_u32).prop_flat_map(|most| prop::collection::vec(0..most, 0..9000))) {
            let (mut wanted, mut found) = (items.clone(), items);
            wanted.sort_unstable();
            let stop = || false;
            prop_assert_eq!(sort(&mut found, u32::cmp, &Meter::new(Limits::default().stop(&stop))), Ok(()));
            prop_assert_eq!(found, wanted);
        }
    }

    #[test]
    fn a_sort_can_be_stopped() {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) == 2;
        let mut items: Vec<u32> = (0..100_000).rev().collect();
        let meter = Meter::new(Limits::default().stop(&stop));
        assert_eq!(sort(&mut items, u32::cmp, &meter), Err(Refusal::Stopped));
        items.sort_unstable();
        assert!(items.into_iter().eq(0..100_000));
    }
}
