//! Automata from files.

use super::*;

/// Whether `stem` and then `cycle` for ever is accepted.
fn accepts(acceptor: &mut dyn Acceptor, stem: &[u64], cycle: &[u64]) -> bool {
    let mut state = 0;
    for &letter in stem {
        state = acceptor.step(state, letter).unwrap();
    }
    let mut met = vec![];
    for round in 0..64 {
        for &letter in cycle {
            state = acceptor.step(state, letter).unwrap();
            if let Some(outcome) = acceptor.decided(state) {
                return outcome;
            }
            // The first rounds may still be on their way to what is repeated.
            if round >= 32 {
                met.push(state);
            }
        }
    }
    let decided = |check: &usize| met.iter().any(|&state| acceptor.decides(state, *check));
    acceptor
        .conditions()
        .iter()
        .any(|condition| !condition.finitely.iter().any(decided) && condition.infinitely.iter().all(decided))
}

fn both(text: &str, stem: &[u64], cycle: &[u64]) -> bool {
    let automaton = read_hoa(text).unwrap();
    let accepted = accepts(&mut MarkedAutomaton::new(&automaton, false), stem, cycle);
    let rejected = accepts(&mut MarkedAutomaton::new(&automaton, true), stem, cycle);
    assert_ne!(accepted, rejected);
    accepted
}

/// `G F a`, with marks on edges.
const AGAIN: &str = "HOA: v1\nname: \"G F a\"\nStates: 1\nStart: 0\nAP: 1 \"a\"\nacc-name: Buchi\nAcceptance: 1 Inf(0)\n\
                     properties: trans-labels explicit-labels trans-acc complete\n--BODY--\nState: 0\n[0] 0 {0}\n[!0] 0\n--END--\n";

/// `(F G a) | (G F b)`, as a Rabin automaton of states, without labels: edges in the order of the letters.
const RABIN: &str = "HOA: v1 States: 4 Start: 0 AP: 2 \"a\" \"b\" acc-name: Rabin 2\nAcceptance: 4 (Fin(0)&Inf(1))|(Fin(2)&Inf(3))\n\
                     --BODY-- State: 0 {0} 0 1 2 3 State: 1 {1} 0 1 2 3 State: 2 {0 3} 0 1 2 3 State: 3 {1 3} 0 1 2 3 --END--";

/// `a U b`: incomplete, and decided after finitely many letters; with an alias, a comment and a complemented set.
const UNTIL: &str = "HOA: v1 /* a /* nested */ comment */\nStart: 1\nAP: 2 \"a\" \"b\"\nAlias: @wait 0 & !1\nAcceptance: 1 Fin(!0)\n\
                     --BODY--\nState: 1 \"waiting\"\n[@wait] 1 [1] 0\nState: [t] 0 \"done\" {0}\n0\n--END--";

#[test]
fn automata_accept_what_they_should() {
    assert!(both(AGAIN, &[0, 0], &[0, 0, 1]));
    assert!(!both(AGAIN, &[1, 1, 1], &[0]));
    for (stem, cycle, expected) in [
        (&[0u64, 2][..], &[1u64][..], true),
        (&[], &[1, 3], true),
        (&[], &[1, 0], false),
        (&[1, 3], &[0, 1, 0], false),
        (&[], &[0, 2], true),
    ] {
        assert_eq!(both(RABIN, stem, cycle), expected, "{stem:?} {cycle:?}");
    }
    assert!(both(UNTIL, &[1, 1, 2], &[0]));
    assert!(!both(UNTIL, &[1, 0, 2], &[2]));
    assert!(!both(UNTIL, &[], &[1]));
}

#[test]
fn what_is_decided_is_known() {
    let automaton = read_hoa(UNTIL).unwrap();
    assert_eq!(automaton.propositions(), ["a", "b"]);
    let (start, sink) = (automaton.start(), automaton.num_states() as u32 - 1);
    assert_eq!(
        (start, automaton.step(start, 1), automaton.step(start, 3), automaton.step(start, 0)),
        (1, 1, 0, sink)
    );
    assert_eq!([start, 0, sink].map(|state| automaton.decided(state)), [None, Some(true), Some(false)]);
    let again = read_hoa(AGAIN).unwrap();
    assert_eq!(again.decided(0), None);
}

#[test]
fn prefixes_decide_what_is_safe_or_cosafe() {
    let (dfa, aim) = read_hoa(UNTIL).unwrap().on_prefixes().unwrap();
    assert_eq!((dfa.num_states(), aim), (3, Aim::Reach));
    assert!(dfa.accepts(dfa.step(dfa.step(dfa.start(), 1), 3)));
    let safe = "HOA: v1 Start: 0 AP: 1 \"bad\" Acceptance: 0 t --BODY-- State: 0 [!0] 0 --END--";
    let (dfa, aim) = read_hoa(safe).unwrap().on_prefixes().unwrap();
    assert_eq!((dfa.num_states(), aim), (2, Aim::Stay));
    assert!(dfa.accepts(dfa.step(dfa.start(), 0)) && !dfa.accepts(dfa.step(dfa.start(), 1)));
    assert_eq!(read_hoa(AGAIN).unwrap().on_prefixes(), Err(LtlError::Undecided));
}

#[test]
fn files_that_are_no_deterministic_automata_are_refused() {
    let replaced = |from: &str, to: &str| {
        let text = AGAIN.replace(from, to);
        assert_ne!(text, AGAIN, "{from}");
        read_hoa(&text).unwrap_err().to_string()
    };
    for (from, to, expected) in [
        ("HOA: v1", "HOA: v2", "line 1: found `v2`; expected `v1`"),
        ("HOA: v1", "digraph", "expected `HOA: v1`"),
        ("Start: 0", "Start: 1", "found the initial state 1; expected one below 1"),
        ("Start: 0", "Start: 0\nStart: 0", "several initial states"),
        ("Start: 0\n", "", "found no `Start:` in the header"),
        ("Start: 0", "Start: 0&0", "a conjunction of states"),
        ("[!0] 0", "[t] 0", "line 13: found two edges of state 0 for the same letter"),
        ("[!0] 0", "[!0] 1", "found the state 1; expected one below 1"),
        ("[!0] 0", "[!1] 0", "line 12: found the proposition 1; expected one below 1"),
        ("[!0] 0", "[!0] 0 {1}", "found the acceptance set 1; expected one below 1"),
        ("[!0] 0", "[!@b] 0", "an alias that the header defines before"),
        ("AP: 1 \"a\"", "AP: 65", "found 65 propositions; expected at most 64"),
        ("AP: 1 \"a\"", "AP: 2 \"a\"", "the name of a proposition in quotation marks"),
        ("AP: 1 \"a\"", "AP: 1 \"a", "line 5: found"),
        ("acc-name: Buchi", "Strange: 1", "found `Strange:`; expected"),
        ("Inf(0)", "Inf(1)", "found the acceptance set 1; expected one below 1"),
        ("Inf(0)", "Many(0)", "expected Fin, Inf, t or f"),
        ("[!0] 0\n", "[!0] 0\nState: 0\n", "found state 0 for the second time"),
        ("--END--", "", "found the end of the file; expected `State:` or --END--"),
        ("name: \"G F a\"", "/* never ends", "the end of the comment"),
    ] {
        let found = replaced(from, to);
        assert!(found.contains(expected), "{from} → {to}: {found}");
    }
    let deep = AGAIN.replace("[!0]", &format!("[{}0]", "!".repeat(100_000)));
    assert!(read_hoa(&deep).unwrap_err().to_string().contains("more than 64 parentheses"));
}
