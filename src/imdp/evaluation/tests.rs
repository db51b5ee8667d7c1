//! Expressions with known values.

use super::{Evaluation, Nature, Values};
use crate::formats::prism;
use crate::model::{IntervalMdp, StateId};
use crate::property::{Compound, Definitions, Inquiry, Verdict, parse_inquiry};
use crate::solver::SolverOptions;

/// PRISM's robot with intervals, its rewards, and a state that earns nothing and may be left.
const MODEL: &str = "# Transitions (IMDP)\n7 12 19\n0 0 0 [0.35,0.45] east\n0 0 1 [0.55,0.65] east\n0 1 1 [0.05,0.15] s\n\
    0 1 3 [0.75,0.85] s\n0 1 4 [0.05,0.15] s\n1 0 2 1 e\n1 1 2 0.5 s\n1 1 4 0.5 s\n2 0 2 1 stuck\n3 0 3 1 stuck\n\
    4 0 5 1 e\n4 1 3 0.6 w\n4 1 4 0.4 w\n5 0 4 1 w\n5 1 2 0.9 n\n5 1 5 0.1 n\n6 0 6 1 wait\n6 1 3 [0.25,0.5] go\n\
    6 1 6 [0.5,0.75] go\n\
    # States\n(s)\n0:(0)\n1:(1)\n2:(2)\n3:(3)\n4:(4)\n5:(5)\n6:(6)\n\
    # Labels\n0=\"init\" 1=\"deadlock\" 2=\"hazard\" 3=\"goal1\" 4=\"goal2\"\n0: 0\n1: 2\n2: 4\n3: 4\n5: 3\n\
    # Reward structure \"time\"\n# State rewards\n7 7\n0 1\n1 1\n2 1\n3 1\n4 1\n5 1\n6 1\n\
    # Reward structure \"time\"\n# Transition rewards\n7 12 0\n\
    # Reward structure \"go\"\n# State rewards\n7 0\n\
    # Reward structure \"go\"\n# Transition rewards\n7 12 4\n6 1 3 3\n6 1 6 3\n0 1 3 2\n0 1 1 10\n";

fn model() -> IntervalMdp {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.pexp");
    std::fs::write(&path, MODEL).unwrap();
    prism::import_combined(&path, &mut |_| {}).unwrap().model
}

fn compound(text: &str) -> Compound {
    match parse_inquiry(text, &Definitions::default()).unwrap_or_else(|error| panic!("{error}")) {
        Inquiry::Compound(compound) => compound,
        // A single probability is an expression as well, once it is no property any more.
        Inquiry::Probability(_) if text.contains('?') => compound(&format!("1*({text})")),
        Inquiry::Probability(_) => compound(&format!("({text}) & true")),
    }
}

fn evaluate(text: &str) -> Evaluation {
    Evaluation::new(&model(), &compound(text), Some(Nature::Robust), &SolverOptions::default())
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn numbers_have_their_values() {
    for (text, state, value) in [
        ("R{\"time\"}minmax=? [ F \"goal2\" ]", 4, 5.0 / 3.0),
        ("R{1}minmin=? [ F \"goal2\" ]", 0, 1.1 + 0.05 * 5.0 / 3.0),
        ("Rminmax=? [ F \"goal2\" ]", 6, 4.0),
        ("Rminmin=? [ F \"goal2\" ]", 6, 2.0),
        // Waiting earns nothing, but never arrives.
        ("R{\"go\"}minmax=? [ F \"goal2\" ]", 6, 12.0),
        ("R{\"go\"}minmin=? [ F \"goal2\" ]", 6, 6.0),
        ("R{\"go\"}maxmin=? [ F \"goal2\" ]", 6, f64::INFINITY),
        ("Rminmin=? [ F \"goal1\" ]", 2, f64::INFINITY),
        // What a branch earns depends on nature: 10 by the hazard, 2 if it goes well.
        ("R{\"go\"}maxmax=? [ C<=1 ]", 0, 10.0 * 0.15 + 2.0 * 0.8),
        ("R{\"go\"}maxmin=? [ C<=1 ]", 0, 10.0 * 0.05 + 2.0 * 0.8),
        ("R{\"time\"}maxmin=? [ C<=7 ]", 3, 7.0),
        ("R{\"time\"}minmin=? [ C, discount=0.5 ]", 3, 2.0),
        ("R{\"time\"}maxmin=? [ C<=3, discount=1/2 ]", 2, 1.75),
        ("R{\"time\"}minmin=? [ I=2 ]", 0, 1.0),
        // Until a co-safe formula holds.
        ("R{\"time\"}minmin=? [ X (F \"goal2\") ]", 0, 1.1 + 0.05 * 5.0 / 3.0),
        ("R{\"time\"}minmax=? [ F ((s=5) & (F (s=4))) ]", 4, 2.0),
        ("R{\"go\"}minmin=? [ X (F \"goal2\") ]", 6, 6.0),
        ("R{\"go\"}minmax=? [ (F (s=6)) & !(G (s=6)) ]", 6, 12.0),
        ("R{\"go\"}maxmin=? [ X (F \"goal2\") ]", 6, f64::INFINITY),
        ("R{\"time\"}minmin=? [ X (X (s=3)) ]", 3, 2.0),
        ("Pmaxmin=? [ G F \"goal1\" ]", 0, 0.5),
        ("Pmaxmax=? [ (G !\"hazard\") & (G F \"goal1\") ]", 0, 0.15),
        ("Pminmin=? [ !((G !\"hazard\") & (G F \"goal1\")) ]", 0, 0.85),
        ("Pmaxmin=? [ F G \"goal2\" ]", 0, 1.0),
        ("Pminmin=? [ F G !\"goal1\" ]", 4, 0.0),
        ("Pmaxmin=? [ X X \"goal2\" ]", 4, 0.9),
        ("Pmaxmin=? [ X F \"goal1\" ]", 0, 0.5),
        ("Pmaxmin=? [ (F \"goal1\") & (F \"goal2\") ]", 4, 1.0),
        ("Pmaxmin=? [ !\"goal2\" W \"goal1\" ]", 4, 1.0),
        ("Pminmin=? [ \"goal2\" R !\"goal1\" ]", 4, 0.0),
        ("Pmaxmin=? [ F=2 s=5 ]", 4, 0.4),
        ("Pmaxmax=? [ F[2,3] \"goal2\" ]", 6, 0.875),
        ("Pminmin=? [ G[1,2] s!=2 ]", 5, 0.01),
        ("Pmaxmin=? [ F>=2 s=4 ]", 5, 1.0),
        ("Pmaxmin=? [ F<=1 P>=0.8 [ X \"goal2\" ] ]", 0, 0.75),
        ("filter(min, Pmaxmin=? [ F \"goal1\" ], s=0|s=4)", 2, 0.5),
        ("filter(sum, s, s>2)", 0, 18.0),
        ("filter(avg, s*1.0, s<=1)", 0, 0.5),
        ("filter(count, \"goal2\")", 0, 2.0),
        ("filter(state, R{\"time\"}minmax=? [ F \"goal2\" ], s=4)*3", 0, 5.0),
        ("max(mod(s,4), 2) + floor(Pmaxmin=? [ F \"goal1\" ]) * 0", 3, 3.0),
        ("s>3 ? 7 : Pmaxmin=? [ F s=3 ]", 5, 7.0),
    ] {
        let text = if text.contains('P') || text.contains('R') {
            text.to_owned()
        } else {
            format!("{text} + 0*Pmaxmax=? [ X true ]")
        };
        let (lower, upper) = evaluate(&text).bounds(StateId(state)).unwrap();
        let close = 2e-6 * value.clamp(1.0, 100.0);
        let holds = if value.is_finite() {
            lower <= value * (1.0 + 1e-15) + 1e-15 && value <= upper + 1e-15 && upper - lower <= close
        } else {
            lower == value && upper == value
        };
        assert!(holds, "{text} in {state}: [{lower}, {upper}], not {value}");
    }
}

#[test]
fn formulas_hold_where_they_should() {
    for (text, states) in [
        ("P>=0.8 [ X \"goal2\" ]", &[2, 3][..]),
        ("P>=0.5 [ X \"goal2\" ] | \"hazard\"", &[1, 2, 3]),
        ("R{\"time\"}<=2 [ F \"goal2\" ]", &[2, 3]),
        ("!(P<1 [ F \"goal2\" ]) & s<=1", &[0, 1]),
        ("(Pmaxmin=? [ F \"goal1\" ]) = 1", &[4, 5]),
        ("filter(exists, P>=1 [ X \"goal2\" ], s>1)", &[0, 1, 2, 3, 4, 5, 6]),
        ("filter(forall, P>=1 [ X \"goal2\" ], s>1)", &[]),
        ("s/4 < 0.3 & P>=0 [ X true ]", &[0, 1]),
        ("s/4 = 0.25 & P>=0 [ X true ]", &[1]),
    ] {
        let evaluation = evaluate(text);
        let Values::Truth(_) = &evaluation.values else { panic!("{text}") };
        let found: Vec<u32> =
            (0..7).filter(|&state| evaluation.verdict(StateId(state)) == Some(Verdict::Holds)).collect();
        assert_eq!(found, states, "{text}");
    }
}

#[test]
fn what_does_not_fit_is_named() {
    let refused = |text: &str| {
        let outcome = Evaluation::new(&model(), &compound(text), None, &SolverOptions::default());
        outcome.expect_err(text).to_string()
    };
    for (text, words) in [
        ("R{\"energy\"}minmax=? [ F \"goal2\" ]", "\"time\", \"go\""),
        ("R{3}minmax=? [ F \"goal2\" ]", "no reward structure 3"),
        ("Rmin=? [ F \"goal2\" ]", "Pminmin"),
        ("R{\"time\"}minmax=? [ C ]", "discount"),
        ("filter(state, Pmaxmin=? [ F s=3 ], s>3)", "found 3"),
        ("filter(min, Pmaxmin=? [ F s=3 ], s>9)", "no state"),
        ("Pmaxmin=? [ F G t=3 ]", "no variable t"),
        ("1/s + Pmaxmin=? [ F s=3 ]", "division by 0"),
    ] {
        let message = refused(text);
        assert!(message.contains(words), "{text}: {message}");
    }
}

#[test]
fn automata_from_files_say_what_the_formula_says() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("again.hoa");
    let text = "HOA: v1\nStates: 1\nStart: 0\nAP: 1 \"goal1\"\nAcceptance: 1 Inf(0)\n--BODY--\nState: 0\n[0] 0 {0}\n[!0] 0\n--END--\n";
    std::fs::write(&file, text).unwrap();
    let file = file.display().to_string();
    for resolution in ["maxmin", "maxmax", "minmin", "minmax"] {
        for (mapping, negation) in [("", ""), (", \"goal1\" <- s=4|s=6", ""), (", \"goal1\" <- s<3", "!")] {
            let formula = mapping.split("<- ").nth(1).unwrap_or("\"goal1\"");
            let of_file = evaluate(&format!("P{resolution}=? [ {negation}(HOA: {{\"{file}\"{mapping}}}) ]"));
            let of_formula = evaluate(&format!("P{resolution}=? [ {negation}(G (F ({formula}))) ]"));
            for state in model().initial().ones() {
                let state = crate::model::StateId::from_index(state);
                assert_eq!(of_file.bounds(state), of_formula.bounds(state), "{resolution} {mapping}");
            }
        }
    }
    let fails = |text: &str| {
        let text = text.replace("FILE", &file);
        Evaluation::new(&model(), &compound(&text), None, &SolverOptions::default()).unwrap_err().to_string()
    };
    let unknown = fails("Pmaxmin=? [ HOA: {\"FILE\", \"a\" <- s=1} ]");
    assert!(unknown.contains("found no proposition \"a\"; expected one of \"goal1\""), "{unknown}");
    assert!(fails("Pmaxmin=? [ HOA: {\"nowhere.hoa\"} ]").contains("nowhere.hoa: "));
    std::fs::write(directory.path().join("again.hoa"), text.replace("goal1", "reached")).unwrap();
    assert!(
        fails("Pmaxmin=? [ HOA: {\"FILE\"} ]")
            .contains("found the proposition \"reached\", which is no label")
    );
}

/// Twenty nines are not 1, though the nearest double is: what stays for ever as doubles leaves in the end.
#[test]
fn products_keep_decimals_to_the_last_digit() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.tra");
    std::fs::write(&path, "2 2 3\n0 0 0 [0.5,0.99999999999999999999] a\n0 0 1 [0,0.5] a\n1 0 1 [1,1] a\n")
        .unwrap();
    std::fs::write(path.with_extension("lab"), "0=\"init\" 1=\"deadlock\" 2=\"good\"\n0: 0 2\n").unwrap();
    let model = prism::import(&path, None, Some(&path.with_extension("lab"))).unwrap().model;
    let again = compound("Pmaxmax=? [ G (F \"good\") ]");
    let evaluation = Evaluation::new(&model, &again, None, &SolverOptions::default()).unwrap();
    assert_eq!(evaluation.bounds(StateId(0)), Some((0.0, 0.0)));
}

/// A state whose first choice keeps it in a component must not lose what its second one reaches there.
#[test]
fn components_are_those_of_all_choices() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.tra");
    let rows = "0 0 0 [0.5,0.6] stay\n0 0 1 [0.4,0.5] stay\n0 1 1 [0.1,0.4] go\n0 1 2 [0.6,0.9] go\n1 0 0 [1,1] back\n2 0 0 [1,1] back\n";
    std::fs::write(&path, format!("3 4 6\n{rows}")).unwrap();
    std::fs::write(path.with_extension("lab"), "0=\"init\" 1=\"deadlock\" 2=\"goal\"\n0: 0\n2: 2\n").unwrap();
    let model = prism::import(&path, None, Some(&path.with_extension("lab"))).unwrap().model;
    for (resolution, value) in [("maxmin", 1.0), ("maxmax", 1.0), ("minmin", 0.0), ("minmax", 0.0)] {
        let again = compound(&format!("P{resolution}=? [ G (F \"goal\") ]"));
        let evaluation = Evaluation::new(&model, &again, None, &SolverOptions::default()).unwrap();
        assert_eq!(evaluation.bounds(StateId::from_index(0)), Some((value, value)), "{resolution}");
    }
}

/// Bounds inside of LTL are unfolded: so many steps that this would never end are refused.
#[test]
fn long_bounds_inside_of_ltl_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.tra");
    std::fs::write(&path, "2 2 3\n0 0 0 [0.5,0.6] a\n0 0 1 [0.4,0.5] a\n1 0 1 [1,1] a\n").unwrap();
    std::fs::write(path.with_extension("lab"), "0=\"init\" 1=\"deadlock\" 2=\"good\"\n0: 0\n1: 2\n").unwrap();
    let model = prism::import(&path, None, Some(&path.with_extension("lab"))).unwrap().model;
    let bounds = |path: &str| {
        let asked = compound(&format!("Pmaxmin=? [ {path} ]"));
        let evaluation = Evaluation::new(&model, &asked, None, &SolverOptions::default());
        evaluation.map(|evaluation| evaluation.bounds(StateId(0))).map_err(|error| error.to_string())
    };
    assert_eq!(bounds("G (F<=200 \"good\")").map(|bounds| bounds.is_some()), Ok(true));
    for path in ["G (F<=1000000000 \"good\")", "F (true U>=257 \"good\")"] {
        assert!(bounds(path).unwrap_err().contains("expected at most 256"), "{path}");
    }
}
