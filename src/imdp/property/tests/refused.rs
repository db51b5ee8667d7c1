//! Texts that are refused, and the words of the message that matter.

use crate::property::{ParseErrorKind, Property, TextPosition, parse_properties};

const REFUSED: [(&str, &[&str]); 47] = [
    ("", &["1, column 1", "expected a property", "the end"]),
    ("\"name\":", &["expected a property"]),
    ("\"goal\"", &["asks for a probability", "`\"goal\"`"]),
    ("F b", &["temporal operator", "parentheses"]),
    ("Pmaxmin", &["expected `=?`", "the end"]),
    ("Pmaxmin=", &["expected `=?`"]),
    ("Pmaxmin=? F b", &["expected `[`"]),
    ("Pmaxmin=? [ F b", &["expected `]`", "the end"]),
    ("Pmaxmin=? [ F b ] ]", &["expected the end"]),
    ("Pmaxmin=? [ F b ]; Pmin=? [ F b ]", &["one property"]),
    ("Pmaxmin=? [ ]", &["expected a formula"]),
    ("Pmaxmin=? [ b ]", &["path formula", "X, F, G, U, W and R"]),
    ("Pmaxmin=? [ F ]", &["expected a formula", "`]`"]),
    ("Pmaxmin=? [ F 1 ]", &["expected a formula", "`1`"]),
    ("Pmaxmin=? [ F x+1 ]", &["expected a formula", "`x+1`"]),
    ("Pmaxmin=? [ F (b ]", &["expected `)`"]),
    ("Pmaxmin=? [ F b) ]", &["expected `]`"]),
    ("Pmaxmin=? [ F x=!b ]", &["parentheses"]),
    ("Pmaxmin=? [ F b & ]", &["expected a formula"]),
    ("Pmaxmin=? [ F \"a\"+1=2 ]", &["expected a number", "`\"a\"`"]),
    ("Pmaxmin=? [ F x<1<2 ]", &["expected a number", "`x<1`"]),
    ("Pmaxmin=? [ F x=2147483648 ]", &["at most 2147483647"]),
    ("Pmaxmin=? [ F x=99999999999999999999 ]", &["at most 2147483647"]),
    ("Pmaxmin=? [ F module ]", &["no keyword of PRISM", "`module`"]),
    ("Pmaxmin=? [ F b § ]", &["expected `]`", "`§`"]),
    ("Pmaxmin>=0.9 [ F b ]", &["a threshold between", "(Pmaxmin=? [ F \"goal\" ])>=0.9"]),
    ("Pmaxminmin=? [ F b ]", &["Pmaxmin", "before `=?`"]),
    ("P>=1.5 [ F b ]", &["between 0 and 1", "1.5"]),
    ("P>=-0.5 [ F b ]", &["between 0 and 1", "-0.5"]),
    ("(Pmaxmin=? [ F b ])>=2", &["between 0 and 1", "2"]),
    ("(Pmaxmin=? [ F b ])>=-1", &["between 0 and 1", "-1"]),
    ("P>=p [ F b ]", &["the constant p, which has no value", "const p = VALUE"]),
    ("Pmaxmin=? [ F b ] & Pmin=? [ F b ]", &["expected a formula"]),
    ("(P>=0.5 [ F b ])>=0.5", &["expected a number"]),
    ("Pmaxmin=? [ b & F b ]", &["temporal operator", "parentheses"]),
    ("Pmaxmin=? [ a U b U c ]", &["expected `]`", "`U`"]),
    ("Pmaxmin=? [ X<=3 b ]", &["step bounds on X"]),
    ("Pmaxmin=? [ F<0 b ]", &["from 1 to", "found 0"]),
    ("Pmaxmin=? [ F<=-1 b ]", &["from 0 to", "found -1"]),
    ("Pmaxmin=? [ F<=1.5 b ]", &["from 0 to", "found 1.5"]),
    ("Pmaxmin=? [ F<=8 -x=1 ]", &["expected a formula", "`=`"]),
    ("Pmaxmin=? [ F<=k b ]", &["the constant k, which has no value"]),
    ("const int k=3;", &["keyword"]),
    ("label \"a\" = b;", &["keyword"]),
    ("S=? [ b ]", &["steady-state"]),
    ("multi(Pmaxmin=? [ F b ], Pmaxmin=? [ F c ])", &["multi-objective"]),
    ("Pmaxmin=? [ F b {\"init\"} ]", &["filters in braces"]),
];

const ALSO_REFUSED: [(&str, &[&str]); 5] = [
    ("<<1>> Pmaxmin=? [ F b ]", &["strategy"]),
    ("A [ F b ]", &["CTL"]),
    ("P(modifier)=? [ F b ]", &["modifier"]),
    ("Pmaxmin=? [ F x^2=1 ]", &["powers"]),
    ("P>=1e-99999 [ F b ]", &["exponent"]),
];

#[test]
fn refusals_say_why() {
    for (text, words) in REFUSED.into_iter().chain(ALSO_REFUSED) {
        let error = text.parse::<Property>().expect_err(text).to_string();
        let message = error.lines().next().unwrap();
        for word in words {
            assert!(message.contains(word), "{text}\n{error}\nlacks {word}");
        }
    }
}

#[test]
fn positions_are_exact() {
    let error = parse_properties("Pmin=? [ F b ];\n é").unwrap_err();
    assert_eq!(error.position(), TextPosition { offset: 17, line: 2, column: 2 });
    let text = "// é\n  Pmin=? [ F<=0.5 b ]";
    let error = parse_properties(text).unwrap_err();
    assert_eq!(error.position(), TextPosition { offset: 20, line: 2, column: 15 });
    let shown = error.to_string();
    assert_eq!(
        shown.lines().skip(1).collect::<Vec<_>>(),
        ["    Pmin=? [ F<=0.5 b ]", "                ^^^"],
        "{shown}"
    );
}

#[test]
fn long_lines_are_shortened() {
    let text = format!("Pmin=? [ F {} § {} ]", "b | ".repeat(1000), "| b".repeat(1000));
    let shown = text.parse::<Property>().unwrap_err().to_string();
    assert!(shown.len() < 400, "{shown}");
}

#[test]
fn names_are_unique() {
    let error = parse_properties("\"a\": Pmin=? [ F b ]; \"a\": Pmax=? [ F b ]").unwrap_err();
    assert_eq!(*error.kind(), ParseErrorKind::DuplicateName { name: "a".into() });
    assert_eq!(error.position().column, 22);
}

#[test]
fn depth_is_limited() {
    let deep = 100_000;
    let texts = [
        format!("Pmin=? [ F {}b", "(".repeat(deep)),
        format!("Pmin=? [ F {}b ]", "!".repeat(deep)),
        format!("Pmin=? [ F x={}1 ]", "-".repeat(deep)),
        format!("Pmin=? [ {}b ]", "F ".repeat(deep)),
        format!("Pmin=? [ F b{} ]", "=>b".repeat(deep)),
        format!("Pmin=? [ F b{} ]", "<=>b".repeat(deep)),
        format!("Pmin=? [ F x=1{} ]", "+1".repeat(deep)),
        "P>0[F ".repeat(deep),
        "(".repeat(deep),
    ];
    // Threads have 2 MiB unless told otherwise; half of that shows that the limit is safe.
    let parse_all = move || {
        for text in texts {
            let error = text.parse::<Property>().unwrap_err();
            assert!(matches!(error.kind(), ParseErrorKind::TooDeep { .. }), "{error}");
        }
    };
    std::thread::Builder::new().stack_size(1 << 20).spawn(parse_all).unwrap().join().unwrap();
}
