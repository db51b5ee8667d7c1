//! The row-sharing encoding: the same model for explicit engines, with one intermediate state per row.
//!
//! Explicit formats list the transitions of every choice, although thousands of states choose from the same few
//! rows. In the encoding of a model `M`, a choice of row `a` leads with probability `[1,1]` to a *row state* `ρ_a`,
//! whose single choice has the intervals of row `a`. A model with `n` choices and `m` entries in its rows has
//! `n + m` transitions then. States whose only choice is to stay, and states without choices, stay what they are.
//!
//! # Why values are equal
//!
//! Let `W(a) = opt_p Σ p(t) V(t)` over the distributions of row `a` (nature's turn), and `(T V)(s) = opt_a W(a)` over
//! the choices of `s` (the policy's turn): `T` is a step of `M`. In the encoding, a step from `s` gives
//! `opt_a 1·V(ρ_a)`, in which nature has no say, and a step from `ρ_a` gives `opt_p Σ p(t) V(t)`, in which the policy has
//! none. Two steps from `s` are therefore `opt_a W(a) = (T V)(s)`: the players are asked the same questions in the same
//! order, whichever of them maximises. A path of the encoding from a state of `M` is in states of `M` at all even
//! times, and there it is a path of `M`; at odd times it is in a row state, or where `M` stays for ever. So for
//! formulas that
//!
//! - count `2k` steps for `k`,
//! - hold where `M` must not leave them (`a` of `a U b` and `G a`) in row states too, and
//! - are not reached in row states (`b` of `a U b` and `F b`),
//!
//! the `2k`-step iterates on the states of `M` are the `k`-step iterates of `M`, and their limits, the values of
//! unbounded formulas, are equal as well. With `row` the label of row states:
//!
//! | formula | encoded |
//! |---|---|
//! | `F<=k b`, `F b` | `F<=2k (b & !"row")`, `F (b & !"row")` |
//! | `G<=k a`, `G a` | `G<=2k (a \| "row")`, `G (a \| "row")` |
//! | `a U<=k b`, `a U b` | `(a \| "row") U<=2k (b & !"row")`, without `<=2k` |
//! | `X b` | `X X b` |
//!
//! `F<k` is `F<=k-1` and becomes `F<=2(k-1)`. A row state has none of the labels of `M`, so that for formulas over labels it
//! is often known what they are there, and nothing is added: `!"failed" U<=8 "reached"` becomes
//! `!"failed" U<=16 "reached"`. Variables have the values of the first state in row states, which the additions make
//! irrelevant.
//!
//! In doubles, sums with a single `1·W(a)` are exact, so that the bounded iterates of an engine that sums in the order
//! of the file are even bitwise equal. Engines that stop when values change little may stop elsewhere.

mod model;
mod property;

pub use model::{EncodingError, RowStates};
