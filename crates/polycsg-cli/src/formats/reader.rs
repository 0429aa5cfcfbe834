//! What all readers are.
use crate::failure::Failure;
use crate::layer::batch::{Batch, Gathered, Layer};

/// What takes the batches of a layer, in their order.
pub(crate) type Each<'e> = dyn FnMut(Batch) -> Result<(), Failure> + 'e;

/// A layer to read, once.
pub(crate) trait Source {
    /// What its features share.
    fn layer(&self) -> &Layer;

    /// Reads all features, some at a time.
    fn read(self: Box<Self>, each: &mut Each<'_>) -> Result<(), Failure>;
}

/// Says once that coordinates had more than x and y.
pub(crate) fn warn_of_flattened(layer: &Layer, gathered: &Gathered) {
    if let Some(feature) = gathered.flattened {
        let name = &layer.name;
        crate::input::warn(format!(
            "{name}: feature {feature} has Z or M, which is left out here and in all other features"
        ));
    }
}
