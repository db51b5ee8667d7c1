//! What PRISM has and this crate has not, by name.

use super::ParseErrorKind;

const PATH: &str = "write F, G or U with a bound, or X that often";
const PROPERTY: &str = "ask for a probability, as in Pmaxmin=? [ F \"goal\" ]";
const NAMED: &str =
    "ask for one probability, as in Pmaxmin=? [ F \"goal\" ] or (Pmaxmin=? [ F \"goal\" ])>=0.9";
const STATE: &str = "a state formula has labels, variables, numbers, ( ) ! & | => <=> = != < <= > >= + - * / ?: min max mod pow floor ceil round";

pub(super) const NEXT_BOUND: ParseErrorKind = unsupported("step bounds on X are", PATH);
pub(super) const BOUNDED_LTL: ParseErrorKind = unsupported(
    "step bounds on nested path formulas are",
    "write X that often, or bound the formula as a whole",
);
pub(super) const AUTOMATON: ParseErrorKind = unsupported(
    "an automaton inside of another path formula is",
    "let the automaton accept what the whole formula means",
);
pub(super) const PATH_OUTSIDE: ParseErrorKind =
    unsupported("path formulas outside of P are", "put it into P…=? [ … ]");
pub(super) const REWARD_PATH: ParseErrorKind =
    unsupported("rewards of other path formulas are", "write F formula, C, C<=k or I=k in the brackets");
pub(super) const COMBINED: ParseErrorKind =
    unsupported("anything but one probability, perhaps compared with a threshold, is", NAMED);
pub(super) const BOUNDED_OPTIMUM: ParseErrorKind = unsupported(
    "a threshold between Pmaxmin and [ is",
    "write it behind, as in (Pmaxmin=? [ F \"goal\" ])>=0.9",
);
pub(super) const MODIFIER: ParseErrorKind = unsupported("P with a modifier in parentheses is", PROPERTY);
pub(super) const FILTER: ParseErrorKind = unsupported(
    "this kind of filter is",
    "write min, max, avg, sum, count, state, first, forall, exists or print",
);
pub(super) const OLD_FILTER: ParseErrorKind =
    unsupported("filters in braces are", "write filter(min, P…, states) around the property");
pub(super) const STEADY: ParseErrorKind =
    unsupported("steady-state rewards are", "write F formula, C, C<=k or I=k in the brackets");
const LTL: ParseErrorKind = unsupported(
    "a temporal operator inside of another expression without parentheses is",
    "write them, as in (F \"a\") & (G \"b\")",
);
pub(super) const POWER: ParseErrorKind = unsupported("powers are", STATE);
pub(super) const STRATEGY: ParseErrorKind = unsupported("strategy operators << >> and [[ ]] are", PROPERTY);
pub(super) const FUNCTION: ParseErrorKind = unsupported("functions are", STATE);

const fn unsupported(what: &'static str, instead: &'static str) -> ParseErrorKind {
    ParseErrorKind::Unsupported { what, instead }
}

/// What a word at the start of an expression stands for, if it is a keyword for something unsupported.
pub(super) fn keyword(word: &str) -> Option<ParseErrorKind> {
    Some(match word {
        "S" => unsupported("steady-state probabilities (S) are", NAMED),
        "E" | "A" => unsupported("the CTL operators E and A are", NAMED),
        "X" | "F" | "G" => LTL,
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
