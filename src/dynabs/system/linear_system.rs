//! The system `x⁺ = A x + B u + q + η`.

use crate::linear_algebra::{ExactMatrix, krylov_rank};

/// `x⁺ = A x + B u + q + η` with `x ∈ ℝⁿ`, `u ∈ ℝᵖ`; all matrices in exact decimals.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinearSystem {
    a: ExactMatrix,
    b: ExactMatrix,
    q: ExactMatrix,
}

impl LinearSystem {
    /// The system with `A` (`n×n`), `B` (`n×p`) and `q` (`n×1`).
    pub fn new(a: ExactMatrix, b: ExactMatrix, q: ExactMatrix) -> Self {
        assert_eq!(a.rows(), a.columns(), "A is square");
        assert_eq!(a.rows(), b.rows(), "A and B have the same height");
        assert_eq!((q.rows(), q.columns()), (a.rows(), 1), "q is a column as high as A");
        Self { a, b, q }
    }

    /// The dimension `n` of the state.
    pub fn state_dimension(&self) -> usize {
        self.a.rows()
    }

    /// The dimension `p` of the input.
    pub fn input_dimension(&self) -> usize {
        self.b.columns()
    }

    /// `A`, `n×n`.
    pub fn a(&self) -> &ExactMatrix {
        &self.a
    }

    /// `B`, `n×p`.
    pub fn b(&self) -> &ExactMatrix {
        &self.b
    }

    /// `q`, `n×1`.
    pub fn q(&self) -> &ExactMatrix {
        &self.q
    }

    /// Whether `A` is non-singular, exactly.
    pub fn is_regular(&self) -> bool {
        self.a.rank() == self.state_dimension()
    }

    /// The rank of the controllability matrix `[B AB … Aⁿ⁻¹B]`; `(A, B)` is controllable iff it is `n`.
    pub fn controllability_rank(&self) -> usize {
        self.grouped_rank(self.state_dimension())
    }

    /// The rank of `[B AB … Aᵈ⁻¹B]`, which is the `B` of `d` grouped steps in another order.
    pub fn grouped_rank(&self, d: usize) -> usize {
        krylov_rank(&self.a, &self.b, d)
    }
}
