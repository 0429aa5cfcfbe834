//! What all writers are.
use crate::failure::Failure;
use crate::layer::batch::Batch;
use crate::output::Output;

/// What a format does with batches.
pub(crate) trait Sink {
    fn write(&mut self, batch: &Batch) -> Result<(), Failure>;

    /// Writes what stands behind the features; gives the output back to be put in its place.
    fn finish(self: Box<Self>) -> Result<Output, Failure>;
}

/// A layer in the making.
pub(crate) struct Writer(Box<dyn Sink>);

impl Writer {
    pub(crate) fn new(sink: impl Sink + 'static) -> Writer {
        Writer(Box::new(sink))
    }

    pub(crate) fn write(&mut self, batch: &Batch) -> Result<(), Failure> {
        self.0.write(batch)
    }

    /// Ends the layer and puts it in its place.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        self.0.finish()?.commit()
    }
}
