//! What PRISM has and this crate has not, by name.

use super::ParseErrorKind;

const PATH: &str =
    "write one of X, F, G and U over state formulas, F, G and U with a bound <=k or <k if you like";
const PROPERTY: &str = "ask for a probability, as in Pmaxmin=? [ F \"goal\" ]";
const NAMED: &str =
    "ask for one probability, as in Pmaxmin=? [ F \"goal\" ] or (Pmaxmin=? [ F \"goal\" ])>=0.9";
const STATE: &str = "a state formula has labels, variables, integers, ( ) ! & | => <=> = != < <= > >= + - *";

pub(super) const LTL: ParseErrorKind = unsupported("nested path formulas (LTL) are", PATH);
pub(super) const WEAK_UNTIL: ParseErrorKind = unsupported("the operator W (weak until) is", PATH);
pub(super) const RELEASE: ParseErrorKind = unsupported("the operator R (release) is", PATH);
pub(super) const LOWER_STEP_BOUND: ParseErrorKind = unsupported("lower or exact step bounds are", PATH);
pub(super) const STEP_INTERVAL: ParseErrorKind = unsupported("intervals of steps, as in F[a,b], are", PATH);
pub(super) const NEXT_BOUND: ParseErrorKind = unsupported("step bounds on X are", PATH);
pub(super) const NESTED: ParseErrorKind = unsupported(
    "nested probability operators are",
    "write a state formula without P, or give the model a label",
);
pub(super) const COMBINED: ParseErrorKind = unsupported(
    "combinations of probabilities are",
    "write one property for each; a threshold goes to its right",
);
pub(super) const NO_DIRECTION: ParseErrorKind = unsupported(
    "P=? of interval models is",
    "write Pmaxmin, Pmaxmax, Pminmin or Pminmax (interval MDP) or Pmin or Pmax (interval DTMC)",
);
pub(super) const BOUNDED_OPTIMUM: ParseErrorKind = unsupported(
    "a threshold between Pmaxmin and [ is",
    "write it behind, as in (Pmaxmin=? [ F \"goal\" ])>=0.9",
);
pub(super) const MODIFIER: ParseErrorKind = unsupported("P with a modifier in parentheses is", PROPERTY);
pub(super) const FILTER: ParseErrorKind =
    unsupported("filters are", "values are computed for all states, and reported for the initial ones");
pub(super) const CONDITIONAL: ParseErrorKind = unsupported("`? :` is", STATE);
pub(super) const DIVISION: ParseErrorKind = unsupported("division is", STATE);
pub(super) const POWER: ParseErrorKind = unsupported("powers are", STATE);
pub(super) const STRATEGY: ParseErrorKind = unsupported("strategy operators << >> and [[ ]] are", PROPERTY);
pub(super) const FUNCTION: ParseErrorKind = unsupported("functions are", STATE);
pub(super) const CONSTANT_BOUND: ParseErrorKind =
    unsupported("constants are", "write the number of steps itself, as in F<=8");

const fn unsupported(what: &'static str, instead: &'static str) -> ParseErrorKind {
    ParseErrorKind::Unsupported { what, instead }
}

/// What a word at the start of an expression stands for, if it is a keyword for something unsupported.
pub(super) fn keyword(word: &str) -> Option<ParseErrorKind> {
    Some(match word {
        "R" | "Rmin" | "Rmax" | "Rminmin" | "Rminmax" | "Rmaxmin" | "Rmaxmax" => {
            unsupported("rewards (R) are", NAMED)
        }
        "S" => unsupported("steady-state probabilities (S) are", NAMED),
        "E" | "A" => unsupported("the CTL operators E and A are", NAMED),
        "filter" => FILTER,
        "const" => unsupported("constants are", "write the numbers themselves into the properties"),
        "label" => {
            unsupported("labels in a properties file are", "write the formula itself into the properties")
        }
        "formula" => unsupported("formulas in a properties file are", "write them into the properties"),
        "X" | "F" | "G" => LTL,
        "min" | "max" | "func" => FUNCTION,
        _ => return None,
    })
}

/// What a function call stands for.
pub(super) fn function(name: &str) -> ParseErrorKind {
    if name == "multi" { unsupported("multi-objective properties are", NAMED) } else { FUNCTION }
}

/// PRISM's other keywords: no variable can be called this.
pub(super) const KEYWORDS: [&str; 35] = [
    "bool",
    "clock",
    "C",
    "ctmc",
    "double",
    "dtmc",
    "endinit",
    "endinvariant",
    "endmodule",
    "endobservables",
    "endrewards",
    "endsystem",
    "global",
    "I",
    "init",
    "int",
    "invariant",
    "maxmax",
    "maxmin",
    "mdp",
    "minmax",
    "minmin",
    "module",
    "nondeterministic",
    "observable",
    "observables",
    "pomdp",
    "popta",
    "probabilistic",
    "prob",
    "pta",
    "rate",
    "rewards",
    "stochastic",
    "system",
];
