//! What PRISM has and this crate has not, by name.

use super::ParseErrorKind;

const PATH: &str = "F, G or U with a bound, or X that often";
const PROPERTY: &str = "a probability, as in Pmaxmin=? [ F \"goal\" ]";
const NAMED: &str = "one probability, as in Pmaxmin=? [ F \"goal\" ] or (Pmaxmin=? [ F \"goal\" ])>=0.9";
const STATE: &str = "a state formula of labels, variables, numbers, ( ) ! & | => <=> = != < <= > >= + - * / ?: min max mod pow floor ceil round";

pub(super) const NEXT_BOUND: ParseErrorKind = unsupported("step bounds on X", PATH);
pub(super) const BOUNDED_LTL: ParseErrorKind =
    unsupported("step bounds on nested path formulas", "X that often, or a bound of the formula as a whole");
pub(super) const AUTOMATON: ParseErrorKind = unsupported(
    "an automaton inside of another path formula",
    "an automaton that accepts what the whole formula means",
);
pub(super) const PATH_OUTSIDE: ParseErrorKind =
    unsupported("path formulas outside of P", "them in the brackets of P…=? [ … ]");
pub(super) const REWARD_PATH: ParseErrorKind =
    unsupported("rewards of other path formulas", "F formula, C, C<=k or I=k in the brackets");
pub(super) const COMBINED: ParseErrorKind =
    unsupported("something else than one probability, perhaps compared with a threshold", NAMED);
pub(super) const BOUNDED_OPTIMUM: ParseErrorKind =
    unsupported("a threshold between Pmaxmin and [", "it behind, as in (Pmaxmin=? [ F \"goal\" ])>=0.9");
pub(super) const MODIFIER: ParseErrorKind = unsupported("P with a modifier in parentheses", PROPERTY);
pub(super) const FILTER: ParseErrorKind =
    unsupported("this kind of filter", "min, max, avg, sum, count, state, first, forall, exists or print");
pub(super) const OLD_FILTER: ParseErrorKind =
    unsupported("filters in braces", "filter(min, P…, states) around the property");
pub(super) const STEADY: ParseErrorKind =
    unsupported("steady-state rewards", "F formula, C, C<=k or I=k in the brackets");
const LTL: ParseErrorKind = unsupported(
    "a temporal operator inside of another expression without parentheses",
    "them, as in (F \"a\") & (G \"b\")",
);
pub(super) const POWER: ParseErrorKind = unsupported("powers", STATE);
pub(super) const STRATEGY: ParseErrorKind = unsupported("strategy operators << >> and [[ ]]", PROPERTY);
pub(super) const FUNCTION: ParseErrorKind = unsupported("functions", STATE);

const fn unsupported(what: &'static str, instead: &'static str) -> ParseErrorKind {
    ParseErrorKind::Unsupported { what, instead }
}

/// What a word at the start of an expression stands for, if it is a keyword for something unsupported.
pub(super) fn keyword(word: &str) -> Option<ParseErrorKind> {
    Some(match word {
        "S" => unsupported("steady-state probabilities (S)", NAMED),
        "E" | "A" => unsupported("the CTL operators E and A", NAMED),
        "X" | "F" | "G" => LTL,
        _ => return None,
    })
}

/// What a function call stands for.
pub(super) fn function(name: &str) -> ParseErrorKind {
    if name == "multi" { unsupported("multi-objective properties", NAMED) } else { FUNCTION }
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
