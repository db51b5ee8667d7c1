//! The affine feedback law that steers a state to a target, and how exactly it does so.

use super::allocation::ControlAllocation;
use super::{Demands, LinearSystem, Shares, TwoLayer};
use crate::geometry::Polytope;
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::{Rational, UNIT_ROUNDOFF, from_decimal, rounding_factor, to_f64, to_f64_up};
use nalgebra::DMatrix;
use num_traits::{Signed, Zero};

/// An affine function `v = M d + N x + c` of target and state, with coefficients rounded to doubles.
#[derive(Clone, Debug)]
pub(super) struct AffineMap {
    pub(super) target: ExactMatrix,
    pub(super) state: ExactMatrix,
    pub(super) constant: ExactMatrix,
}

/// A half-space condition `α·d + γ·x ≤ β` on target `d` and state `x`.
#[derive(Clone, Debug)]
pub struct SteeringConstraint {
    /// `α`, one entry per dimension of the state space.
    pub target: Vec<f64>,
    /// `γ`, one entry per dimension of the state space.
    pub state: Vec<f64>,
    /// `β`, less a bound on every rounding error made in evaluating the law and this condition.
    pub bound: f64,
}

/// The law `u = M d + N x + c` with which the controller steers from `x` to the target `d`.
///
/// - One layer: `u = ū + B†(d − A x − q − B ū)`, so `M = B†`, `N = −B†A`, `c = ū − B†(q + B ū)`.
/// - Two layers: `u = −K(x − x̄) + u′` with `u′` as above for `A_cl`, `q_cl` and `U′`.
///
/// `B†` is a right inverse of `B`, and `ū` an input, by which what is to be done is shared among the inputs according to the
/// widths of `U` (or `U′`): see `ControlAllocation`. For more inputs than states the paper's `R⁻¹(d)`
/// asks whether *some* input reaches `d`, while its controller applies one; the constraints here
/// are those of the law itself, so that `u ∈ U` holds for whatever is applied.
///
/// The coefficients are computed in exact rationals, rounded once to doubles, and from then on taken as
/// they are: [`steering_error`](Self::steering_error) says how far `A x + B u + q` can be from `d`.
#[derive(Clone, Debug)]
pub struct FeedbackLaw {
    pub(super) input: AffineMap,
    /// The abstract input `u′`, for two layers.
    abstract_input: Option<AffineMap>,
    system: LinearSystem,
}

/// The largest absolute value of each coordinate over the states and over the targets.
#[derive(Clone, Debug)]
pub struct Extent {
    /// `max |x_j|` over the partition, per dimension.
    pub state: Vec<f64>,
    /// `max |d_j|` over the targets, per dimension.
    pub target: Vec<f64>,
}

impl AffineMap {
    fn steering(system: &LinearSystem, input: &Polytope, shares: Option<&Shares>) -> Option<Self> {
        let ControlAllocation { right_inverse, center } = ControlAllocation::new(system, input, shares)?;
        let drift = system.q().plus(&system.b().times(&center));
        Some(Self {
            state: right_inverse.times(system.a()).negated(),
            constant: center.minus(&right_inverse.times(&drift)),
            target: right_inverse,
        })
    }

    fn rounded(&self) -> Self {
        Self { target: rounded(&self.target), state: rounded(&self.state), constant: rounded(&self.constant) }
    }

    /// Per row, a bound on the rounding error of evaluating the map in doubles, in any order.
    pub(super) fn evaluation_error(&self, extent: &Extent) -> Vec<f64> {
        let factor = rounding_factor(2 * self.target.columns() + 2);
        self.magnitudes(extent).iter().map(|magnitude| factor * magnitude).collect()
    }

    /// Per row, `|M| |d| + |N| |x| + |c|`.
    pub(super) fn magnitudes(&self, extent: &Extent) -> Vec<f64> {
        (0..self.target.rows())
            .map(|i| {
                absolute_product(&self.target, i, &extent.target)
                    + absolute_product(&self.state, i, &extent.state)
                    + to_f64(self.constant.get(i, 0)).abs()
            })
            .collect()
    }
}

impl FeedbackLaw {
    /// The law of `system` with inputs in `input`, with a stabilising lower layer if `two_layer` is given, made for
    /// `demands`.
    ///
    /// `None` unless `B` has full row rank.
    pub fn new(
        system: &LinearSystem,
        input: &Polytope,
        two_layer: Option<&TwoLayer>,
        demands: &Demands,
    ) -> Option<Self> {
        let shares = Self::shares(system, input, two_layer, demands);
        Self::with_shares(system, input, two_layer, shares.as_ref())
    }

    /// How inputs share what is to be done if that is made for `demands`; `None` if there is nothing to share.
    pub fn shares(
        system: &LinearSystem,
        input: &Polytope,
        two_layer: Option<&TwoLayer>,
        demands: &Demands,
    ) -> Option<Shares> {
        match two_layer {
            None => ControlAllocation::rehearsed(system, input, demands),
            Some(layers) => {
                ControlAllocation::rehearsed(layers.closed_loop(), layers.abstract_input(), demands)
            }
        }
    }

    /// The law with which inputs share what is to be done as they are told; `None` unless `B` has full row rank.
    pub fn with_shares(
        system: &LinearSystem,
        input: &Polytope,
        two_layer: Option<&TwoLayer>,
        shares: Option<&Shares>,
    ) -> Option<Self> {
        let (input, abstract_input) = match two_layer {
            None => (AffineMap::steering(system, input, shares)?, None),
            Some(layers) => {
                let upper = AffineMap::steering(layers.closed_loop(), layers.abstract_input(), shares)?;
                let input = AffineMap {
                    target: upper.target.clone(),
                    state: upper.state.minus(layers.gain()),
                    constant: upper.constant.plus(&layers.gain().times(layers.about())),
                };
                (input, Some(upper.rounded()))
            }
        };
        Some(Self { input: input.rounded(), abstract_input, system: system.clone() })
    }

    /// `M`, `p×n`.
    pub fn target_gain(&self) -> DMatrix<f64> {
        self.input.target.to_f64()
    }

    /// `N`, `p×n`.
    pub fn state_gain(&self) -> DMatrix<f64> {
        self.input.state.to_f64()
    }

    /// `c`, `p×1`.
    pub fn constant(&self) -> DMatrix<f64> {
        self.input.constant.to_f64()
    }

    /// Per dimension, a bound on `|A x + B u + q − d|` for the `u` that the law computes in doubles.
    ///
    /// `|(BM − I) d + (A + BN) x + (Bc + q)| + |B| · (evaluation error of u)`; the first part is exact
    /// rational arithmetic on the rounded coefficients. To it come the roundings of `d` and `x`
    /// themselves.
    pub fn steering_error(&self, extent: &Extent) -> Vec<f64> {
        let n = self.system.state_dimension();
        let b = self.system.b();
        let by_target = b.times(&self.input.target).minus(&ExactMatrix::identity(n));
        let by_state = b.times(&self.input.state).plus(self.system.a());
        let constant = b.times(&self.input.constant).plus(self.system.q());
        let of_input = self.input.evaluation_error(extent);
        (0..n)
            .map(|j| {
                let law = absolute_product(&by_target, j, &extent.target)
                    + absolute_product(&by_state, j, &extent.state)
                    + to_f64_up(&constant.get(j, 0).abs());
                let evaluation = absolute_product(b, j, &of_input);
                (law + evaluation) * (1.0 + rounding_factor(4 * n + 4))
                    + 2.0 * UNIT_ROUNDOFF * (extent.target[j] + extent.state[j])
            })
            .collect()
    }

    /// The conditions `u ∈ U` (and `u′ ∈ U′`) on target and state, tightened by their rounding errors.
    ///
    /// `G (M d + N x + c) ≤ g` gives `α = G M`, `γ = G N`, `β = g − G c`. Every condition that holds in
    /// doubles, evaluated in any order with at most `4n + 8` operations, holds for the exact values and
    /// for the input that the controller computes.
    pub fn constraints(
        &self,
        input: &Polytope,
        abstract_input: Option<&Polytope>,
        extent: &Extent,
    ) -> Vec<SteeringConstraint> {
        let mut constraints = constraints_of(&self.input, input, extent);
        if let (Some(map), Some(set)) = (&self.abstract_input, abstract_input) {
            constraints.extend(constraints_of(map, set, extent));
        }
        constraints
    }

    /// The conditions `G′ M (d − d̄) ≤ g′` on how far off a target `d` is from a planned one `d̄`: `u′ = M (d − d̄)` is what is
    /// added to the input that steers to `d̄`. They are conditions `α·(d − d̄) ≤ β`, one for each half-space of `U′`.
    ///
    /// Nothing is proven by them: `u ∈ U` is what [`constraints`](Self::constraints) are for.
    pub fn deviations(&self, abstract_input: &Polytope) -> Vec<(Vec<f64>, f64)> {
        let normals = abstract_input.normals().times(&self.input.target);
        let row = |i| (0..normals.columns()).map(|j| to_f64(normals.get(i, j))).collect();
        abstract_input.offsets().iter().enumerate().map(|(i, offset)| (row(i), to_f64(offset))).collect()
    }
}

fn constraints_of(map: &AffineMap, set: &Polytope, extent: &Extent) -> Vec<SteeringConstraint> {
    let n = map.target.columns();
    let normals = set.normals();
    let (target, state) = (normals.times(&map.target), normals.times(&map.state));
    let constant = normals.times(&map.constant);
    let of_input = map.evaluation_error(extent);
    (0..normals.rows())
        .map(|i| {
            let bound = to_f64(&(&set.offsets()[i] - constant.get(i, 0)));
            let magnitude = absolute_product(&target, i, &extent.target)
                + absolute_product(&state, i, &extent.state)
                + bound.abs();
            let margin = rounding_factor(4 * n + 8) * magnitude + absolute_product(normals, i, &of_input);
            SteeringConstraint {
                target: (0..n).map(|j| to_f64(target.get(i, j))).collect(),
                state: (0..n).map(|j| to_f64(state.get(i, j))).collect(),
                bound: (bound - margin).next_down(),
            }
        })
        .collect()
}

/// The matrix of the doubles nearest to the entries of `m`, as exact rationals again.
fn rounded(m: &ExactMatrix) -> ExactMatrix {
    ExactMatrix::from_fn(m.rows(), m.columns(), |i, j| {
        imdp::numeric::from_dyadic(to_f64(m.get(i, j))).unwrap_or_else(Rational::zero)
    })
}

/// `Σ_j |m_ij| v_j` for `v ≥ 0`, rounded to nearest.
pub(super) fn absolute_product(m: &ExactMatrix, i: usize, v: &[f64]) -> f64 {
    v.iter().enumerate().map(|(j, v)| to_f64_up(&m.get(i, j).abs()) * v).sum()
}

/// Whether `−K (x − x̄) ∈ U` for all `x` in a box: the paper's sufficient condition for a non-empty `Ũ`.
///
/// Returns the first half-space of `U` that is violated, as (its left-hand side at worst, its offset).
pub fn lower_layer_violation(
    layers: &TwoLayer,
    input: &Polytope,
    lower: &[Rational],
    upper: &[Rational],
) -> Option<(f64, f64)> {
    let gain = input.normals().times(layers.gain()).negated();
    let constant = gain.times(layers.about()).negated();
    (0..gain.rows()).find_map(|i| {
        let worst = (0..gain.columns()).fold(constant.get(i, 0).clone(), |sum, j| {
            let slope = gain.get(i, j);
            sum + slope * if slope.is_negative() { &lower[j] } else { &upper[j] }
        });
        let offset = &input.offsets()[i];
        (worst > *offset).then(|| (to_f64(&worst), to_f64(offset)))
    })
}

/// The exact decimals of a computed gain, optionally rounded to `decimals` places (ties to even).
///
/// # Errors
/// `None` if an entry is not finite.
pub fn decimal_gain(gain: &DMatrix<f64>, decimals: Option<u32>) -> Option<ExactMatrix> {
    let entries: Option<Vec<_>> = gain
        .iter()
        .map(|&x| match decimals {
            None => from_decimal(x),
            Some(places) => from_decimal(format!("{x:.*}", places as usize).parse().ok()?),
        })
        .collect();
    let entries = entries?;
    Some(ExactMatrix::from_fn(gain.nrows(), gain.ncols(), |i, j| entries[j * gain.nrows() + i].clone()))
}
