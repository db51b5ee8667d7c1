//! The checker of [certificates](crate::certificate).
//!
//! The checker shares the readers of files, the property parser, [`crate::model`] and the exact arithmetic of one row
//! with the solver, and nothing else: it computes in exact rational arithmetic and believes nothing that a certificate says.
//! [`check`] accepts or says which state and step fails.
//!
//! # What is proved
//!
//! The model is what its files say: bounds of rows are the decimals written in texts, and the shortest decimals that
//! give the doubles of UMB, NetCDF and native files. A
//! row to which rounding left no distribution is widened by the rounding (`exact_row`). A property asks for
//! the probability of `safe U goal`, perhaps within `H` steps, or of `X goal`; that of `G` is 1 minus that
//! of its complement with both players flipped. States are *moving* if their value depends on choices: safe,
//! not in the goal (for `X`: any), with rows. All others have the value 1 in the goal and 0 elsewhere. For
//! moving states let `W_a(V) = opt_p p·V` over all distributions of the row `a`, the minimum or the maximum
//! as nature pulls, and `T(V)(s) = opt_a W_a(V)`, as the policy pulls.
//!
//! **Bounded.** The exact values are `V_0 = 1_goal` and `V_k = T(V_{k−1})`, where `k` is the number of steps
//! left. Given `L_0 = U_0 = 1_goal` and for every moving state
//!
//! | | the policy maximises | the policy minimises |
//! |---|---|---|
//! | lower | `L_k(s) ≤ W_a(L_{k−1})` for its choice `a = σ_k(s)` | for all choices `a` |
//! | upper | `U_k(s) ≥ W_a(U_{k−1})` for all choices `a` | for its choice `a = σ_k(s)` |
//!
//! induction and the monotonicity of `W_a` give `L_k ≤ V_k ≤ U_k`, and that the policy `σ` attains `L_H` if
//! it maximises, `U_H` if it minimises. Nature needs no witness: `W_a` is computed as the exact optimum over
//! all distributions of a row, and nature may choose anew in every step. After the last step listed
//! nothing changes any more; one further step is checked, which stands for all that follow, as their
//! premises are the same.
//!
//! **Unbounded, upper.** `V` is the least fixed point of `T`, so `T(U) ≤ U` implies `V ≤ U` (Knaster and
//! Tarski). The inequalities are those of the table with `U` on both sides. For a minimising policy they
//! say `T_σ(U) ≤ U`, so that `σ` attains `U`.
//!
//! **Unbounded, lower.** The inequalities of the table with `L` on both sides do not suffice: a cycle could
//! feed itself. Let `D` be the moving states with `L > 0`. The certificate gives every state of `D` a rank
//! `r ≥ 1`, all others count as rank 0, and for the choice `σ(s)` of a maximising policy, or all choices
//! `a` of a minimising one,
//!
//! - if nature minimises, every distribution of the row must give `{r < r(s)}` positive probability:
//!   `max(Σ l, 1 − Σ u) > 0`, the first sum over successors of lower rank, the second over the others;
//! - if nature maximises, some distribution that attains `W_a(L)` must. (All of them give successors above
//!   a threshold value `u`, those below it `l`, and share the rest among those at the threshold.)
//!
//! *Proof.* If nature minimises let `P_s` be all distributions of the row, otherwise the one just described,
//! chosen once for every state and choice. Every one satisfies `p·L ≥ L(s)`, and by compactness gives lower
//! ranks at least some `ε > 0`, the same for all states. So from anywhere in `D`, whatever the minimising
//! players do, within `|D|` steps `D` is left with probability at least `ε^|D|`, hence almost surely at
//! some time `τ`. Up to `τ` the values `L(s_k)` are a bounded submartingale, so `L(s) ≤ E L(s_τ)`; and
//! outside `D` `L` is at most `1_goal`. So `L(s) ≤ P(goal)`, against all minimising players. Where nature
//! maximises this is the value of one of its strategies, and its best one is no worse. ∎
//!
//! Values 0 and 1 need no special treatment: `U = 0` and `L = 1` are proved like all others.
//!
//! **Claims.** The bounds of every state are those after the last step; the claim about the initial states
//! must follow from them in exact arithmetic.
//!
//! **Rewards.** With `r ≥ 0` what a choice earns, `T(V)(s) = opt_a opt_p (r + γ p·V)`.
//!
//! - *A number of steps*: as for probabilities, from `V_0 = 0`, or from the states' rewards if only the last state's counts.
//! - *Discounted for ever*: from `L ≤ T(L)`, `L` bounded, follows `L ≤ Tⁿ(L) ≤ Tⁿ(0) + γⁿ max L → V`; from `U ≥ T(U)`,
//!   `U ≥ Tⁿ(U) ≥ Tⁿ(0) → V`.
//! - *Until a goal*, infinite where the goal may be missed. *Infinite*: an upper bound below 1 on the probability that the goal
//!   is met, for the best that those can do who want to earn little; proved as above. *Lower*: `L ≤ T(L)`, `L` bounded, 0 in
//!   the goal, infinite where that is proved. Whatever those do who want to earn little, either the goal is missed with
//!   positive probability and the rewards are infinite, or it is met almost surely, and so only states are met from which it
//!   is; then `L` and the rewards so far are a submartingale, and what is left of `L` vanishes. *Upper*: `U > T(U)` where `U` is
//!   finite, outside of the goal. Those who want to earn little keep to what attains `T(U)`. There are finitely many states,
//!   so `U` falls by some `ε > 0` more than what is earned in every step: the goal is met after at most `U/ε` expected steps,
//!   and what is earned until then is at most `U`. ∎
//!
//! A reward is read as the double, if that is a whole number, and otherwise as anything between the doubles next to it, on
//! the safe side: what was written lies there.
//!
//! # Cost
//!
//! A row's expectation is computed once per step and side, and only if a successor's value changed, rounded
//! exactly to the double next to it on the side to be proved and then compared with the bounds of all
//! states that share it: bounds are doubles, so nothing is lost. Bounds that are fractions are compared exactly.

mod bounds;
mod check;
mod earned;
mod extremum;
mod masses;
mod one_step;
mod ranks;
mod rejection;
mod rewards;
mod side;
mod staying;
mod task;

pub use check::{Proved, ProvedBounds, check, check_model, prove};
pub use rejection::Rejection;
pub use rewards::{RewardTask, prove_rewards};
pub use side::Side;
pub use staying::{OmegaCondition, prove_accepting, prove_nothing_missed};
