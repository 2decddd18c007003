use nalgebra::DMatrix;
use serde::Serialize;
use thiserror::Error;

/// What can be wrong with a linear model. Every variant carries the offending value.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum LinearError {
    /// Matrices whose sizes do not fit together.
    #[error("{matrix} is {rows} x {columns}, expected {expected_rows} x {expected_columns}")]
    Dimension {
        /// Name of the matrix.
        matrix: &'static str,
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
        /// Rows that would fit.
        expected_rows: usize,
        /// Columns that would fit.
        expected_columns: usize,
    },
    /// A question that only a square plant can answer.
    #[error("the model has {inputs} inputs and {outputs} outputs; this needs as many of one as of the other")]
    NotSquare {
        /// Number of inputs.
        inputs: usize,
        /// Number of outputs.
        outputs: usize,
    },
    /// det G(s) ≡ 0: the plant is singular for every s and has no transmission zeros.
    #[error("the plant has normal rank {rank} of {size}: it is singular at every frequency")]
    DegenerateRank {
        /// Normal rank of G(s).
        rank: usize,
        /// Number of inputs.
        size: usize,
    },
    /// The gain, G(0) or G at the frequency asked for, does not exist or cannot be inverted.
    #[error("the gain is singular (reciprocal condition {reciprocal_condition})")]
    SingularGain {
        /// Smallest over largest singular value; 0 where the gain does not exist.
        reciprocal_condition: f64,
    },
    /// An eigenvalue iteration that did not end, or a matrix with an entry that is not finite.
    #[error("no eigenvalues found for a matrix of size {size}")]
    NoConvergence {
        /// Rows of the matrix.
        size: usize,
    },
    /// An argument for which the question makes no sense, such as a sampling time that is not positive.
    #[error("{field} = {value} is out of range")]
    OutOfRange {
        /// Name of the argument.
        field: &'static str,
        /// Its value.
        #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
        value: f64,
    },
}

/// Checks the size of one matrix.
pub(super) fn expect_shape(
    name: &'static str,
    matrix: &DMatrix<f64>,
    expected_rows: usize,
    expected_columns: usize,
) -> Result<(), LinearError> {
    let (rows, columns) = matrix.shape();
    if (rows, columns) == (expected_rows, expected_columns) {
        Ok(())
    } else {
        Err(LinearError::Dimension { matrix: name, rows, columns, expected_rows, expected_columns })
    }
}
