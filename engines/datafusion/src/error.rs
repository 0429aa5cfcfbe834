//! What can be wrong with the rows and groups of a query.
use datafusion_common::DataFusionError;
use polycsg::DVec2;

/// Why a query was refused while it ran. It travels as [`DataFusionError::External`]: `error.find_root()` leads to it.
///
/// Rows are counted from 0 in the batch that the engine handed over, which has 8 192 rows unless its `batch_size` says otherwise. The left
/// side of a join by boxes is one batch.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A geometry cannot be read.
    #[error("row {row} of its batch: {why}")]
    Row {
        /// The row.
        row: usize,
        /// What is wrong, and what to do.
        why: String,
    },
    /// A group cannot be evaluated. An aggregate does not see its group's key, so the group is named by what it holds.
    #[error("the group of {features} different geometries within ({low}) and ({high}): {why}")]
    Group {
        /// How many geometries it has, equal ones counted once.
        features: usize,
        /// The lower left corner of the box around them.
        low: DVec2,
        /// The upper right corner.
        high: DVec2,
        /// What is wrong, and what to do.
        why: String,
    },
    /// The state of an aggregate that came from another partition is not one.
    #[error(
        "the state of an aggregate is broken: {0}; do all executors run one version of polycsg-datafusion?"
    )]
    State(&'static str),
    /// The result of a batch does not fit into its type.
    #[error(
        "the geometries of one batch take more than 2 GiB; cast the column first: arrow_cast(geom, 'LargeBinary')"
    )]
    TooLarge,
}

impl Error {
    pub(crate) fn row(row: usize, why: impl ToString) -> Error {
        Error::Row { row, why: why.to_string() }
    }
}

impl From<Error> for DataFusionError {
    fn from(error: Error) -> DataFusionError {
        DataFusionError::External(Box::new(error))
    }
}
