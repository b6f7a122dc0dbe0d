//! What is done about the part of the kernel that is missing at the edge of a body (SS, below Eq. 11), as types.

use crate::math::Real;

/// By what the Shepard sum s_a = sum_b W_ab V_b, a itself included, divides.
pub trait Normalisation: Copy + Send + Sync + 'static {
    /// Factor of the sum of a gradient.
    fn gradient<S: Real>(s: S) -> S;
    /// Factor of the stress that a particle brings into its own sum and those of its neighbours.
    fn stress<S: Real>(s: S) -> S;
    /// Factor of the sum of forces.
    fn force<S: Real>(s: S) -> S;
}

/// Nothing: SS Eqs. (7) and (9) as they are printed. Gradients at a straight edge are half of what they should be.
#[derive(Clone, Copy, Debug)]
pub struct Bare;

/// The words of the paper: both sums over the Shepard sum of the particle that sums. Momentum is not conserved, and loads
/// meet stresses that are too low.
#[derive(Clone, Copy, Debug)]
pub struct Literal;

/// Gradients over the Shepard sum, and each stress over that of its own particle. So the force is minus the adjoint of the strain: momentum and energy
/// are conserved, and the operator is symmetric.
#[derive(Clone, Copy, Debug)]
pub struct Adjoint;

impl Normalisation for Bare {
    #[inline(always)]
    fn gradient<S: Real>(_: S) -> S {
        S::one()
    }
    #[inline(always)]
    fn stress<S: Real>(_: S) -> S {
        S::one()
    }
    #[inline(always)]
    fn force<S: Real>(_: S) -> S {
        S::one()
    }
}

impl Normalisation for Literal {
    #[inline(always)]
    fn gradient<S: Real>(s: S) -> S {
        S::one() / s
    }
    #[inline(always)]
    fn stress<S: Real>(_: S) -> S {
        S::one()
    }
    #[inline(always)]
    fn force<S: Real>(s: S) -> S {
        S::one() / s
    }
}

impl Normalisation for Adjoint {
    #[inline(always)]
    fn gradient<S: Real>(s: S) -> S {
        S::one() / s
    }
    #[inline(always)]
    fn stress<S: Real>(s: S) -> S {
        S::one() / s
    }
    #[inline(always)]
    fn force<S: Real>(_: S) -> S {
        S::one()
    }
}
