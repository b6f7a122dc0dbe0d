//! Why a study has no result.

use crate::CaseError;
use crate::run::RunError;
use taut::diagnostics::disorder::DisorderError;
use taut::integrator::Diverged;

/// A study that failed.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The case is wrong, or its bodies cannot be started.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A body that is not solved by `small-strain`.
    #[error(
        "the body `{0}` is not solved by small-strain, and only that has an operator that stays the same\nhint: --formulation small-strain, with a material that is linear-elastic"
    )]
    NotSmall(String),
    /// A body without an operator.
    #[error("a rigid body has no modes")]
    Rigid,
    /// More numbers than can be counted.
    #[error("the matrix of this body is too large\nhint: choose a larger spacing")]
    TooLarge,
    /// The matrix has no Cholesky factors.
    #[error(
        "the matrix of this body cannot be factored: a displacement is not resisted\nhint: does every particle have neighbours on all sides? a larger `smoothing` gives more"
    )]
    Unstable,
    /// The subspace did not converge.
    #[error("the lowest modes of this body do not converge\nhint: ask for a few more or fewer with --count")]
    Unconverged,
}

impl StudyError {
    pub(super) fn unstarted(diverged: Diverged) -> Self {
        Self::Run(RunError::unstarted(diverged))
    }
}

impl From<CaseError> for StudyError {
    fn from(error: CaseError) -> Self {
        Self::Run(error.into())
    }
}

impl From<DisorderError> for StudyError {
    fn from(error: DisorderError) -> Self {
        Self::Run(error.into())
    }
}
