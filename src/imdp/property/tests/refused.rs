//! Texts that are refused, and the words of the message that matter.

use crate::property::{ParseErrorKind, Property, TextPosition, parse_properties};

const REFUSED: [(&str, &[&str]); 68] = [
    ("", &["1, column 1", "expected a property", "the end"]),
    ("\"name\":", &["expected a property"]),
    ("\"goal\"", &["asks for a probability", "`\"goal\"`"]),
    ("F b", &["LTL"]),
    ("Pmaxmin", &["expected `=?`", "the end"]),
    ("Pmaxmin=", &["expected `=?`"]),
    ("Pmaxmin=? F b", &["expected `[`"]),
    ("Pmaxmin=? [ F b", &["expected `]`", "the end"]),
    ("Pmaxmin=? [ F b ] ]", &["expected the end"]),
    ("Pmaxmin=? [ F b ]; Pmin=? [ F b ]", &["one property"]),
    ("Pmaxmin=? [ ]", &["expected a formula"]),
    ("Pmaxmin=? [ b ]", &["path formula", "X, F, G and U"]),
    ("Pmaxmin=? [ F ]", &["expected a formula", "`]`"]),
    ("Pmaxmin=? [ F 1 ]", &["expected a formula", "`1`"]),
    ("Pmaxmin=? [ F x+1 ]", &["expected a formula", "`x+1`"]),
    ("Pmaxmin=? [ F (b ]", &["expected `)`"]),
    ("Pmaxmin=? [ F b) ]", &["expected `]`"]),
    ("Pmaxmin=? [ F \"a b\" ]", &["after the name of a label"]),
    ("Pmaxmin=? [ F \"1\" ]", &["name of a label", "`1`"]),
    ("Pmaxmin=? [ F x=!b ]", &["parentheses"]),
    ("Pmaxmin=? [ F b & ]", &["expected a formula"]),
    ("Pmaxmin=? [ F \"a\"+1=2 ]", &["expected an integer", "`\"a\"`"]),
    ("Pmaxmin=? [ F x<0.5 ]", &["expected an integer", "`0.5`"]),
    ("Pmaxmin=? [ F x<1<2 ]", &["expected an integer", "`x<1`"]),
    ("Pmaxmin=? [ F x=2147483648 ]", &["at most 2147483647"]),
    ("Pmaxmin=? [ F x=99999999999999999999 ]", &["at most 2147483647"]),
    ("Pmaxmin=? [ F module ]", &["no keyword of PRISM", "`module`"]),
    ("Pmaxmin=? [ F b § ]", &["expected `]`", "`§`"]),
    ("Pmaxmin>=0.9 [ F b ]", &["a threshold between", "(Pmaxmin=? [ F \"goal\" ])>=0.9"]),
    ("Pmaxminmin=? [ F b ]", &["Pmaxmin", "before `=?`"]),
    ("P=? [ F b ]", &["P=?", "Pmaxmin", "Pmin"]),
    ("P>=1.5 [ F b ]", &["between 0 and 1", "1.5"]),
    ("P>=-0.5 [ F b ]", &["between 0 and 1", "-0.5"]),
    ("(Pmaxmin=? [ F b ])>=2", &["between 0 and 1", "2"]),
    ("(Pmaxmin=? [ F b ])>=-1", &["between 0 and 1", "-1"]),
    ("(Pmaxmin=? [ F b ])=0.5", &["one of >=, >, <= and <"]),
    ("(Pmaxmin=? [ F b ])>=p", &["single decimal"]),
    ("P>=1/3 [ F b ]", &["single decimal", "`/`"]),
    ("P>=p [ F b ]", &["a probability such as 0.95", "`p`"]),
    ("0.5<=Pmaxmin=? [ F b ]", &["combinations", "to its right"]),
    ("Pmaxmin=? [ F b ] & Pmin=? [ F b ]", &["combinations"]),
    ("1-Pmaxmin=? [ F b ]", &["combinations"]),
    ("(P>=0.5 [ F b ])>=0.5", &["combinations"]),
    ("Pmaxmin=? [ F P>=0.5 [ F b ] ]", &["nested probability"]),
    ("Pmaxmin=? [ F G b ]", &["LTL"]),
    ("Pmaxmin=? [ !(F b) ]", &["LTL"]),
    ("Pmaxmin=? [ (F b) & (G b) ]", &["LTL"]),
    ("Pmaxmin=? [ b & F b ]", &["LTL"]),
    ("Pmaxmin=? [ a U (b U c) ]", &["LTL"]),
    ("Pmaxmin=? [ a U b U c ]", &["expected `]`", "`U`"]),
    ("Pmaxmin=? [ a W b ]", &["weak until"]),
    ("Pmaxmin=? [ a R b ]", &["release"]),
    ("Pmaxmin=? [ X<=3 b ]", &["step bounds on X"]),
    ("Pmaxmin=? [ F>=2 b ]", &["lower or exact step bounds"]),
    ("Pmaxmin=? [ F=2 b ]", &["lower or exact step bounds"]),
    ("Pmaxmin=? [ F[1,2] b ]", &["F[a,b]"]),
    ("Pmaxmin=? [ F<0 b ]", &["from 1 to", "found 0"]),
    ("Pmaxmin=? [ F<=-1 b ]", &["from 0 to", "found -1"]),
    ("Pmaxmin=? [ F<=1.5 b ]", &["from 0 to", "found 1.5"]),
    ("Pmaxmin=? [ F<=8 -x=1 ]", &["from 0 to", "found 8 -x"]),
    ("Pmaxmin=? [ F<=k b ]", &["constants", "number of steps"]),
    ("const int k=3;", &["constants"]),
    ("label \"a\" = b;", &["labels in a properties file"]),
    ("Rmaxmin=? [ F b ]", &["rewards"]),
    ("S=? [ b ]", &["steady-state"]),
    ("multi(Pmaxmin=? [ F b ], Pmaxmin=? [ F c ])", &["multi-objective"]),
    ("filter(min, Pmaxmin=? [ F b ])", &["filters"]),
    ("Pmaxmin=? [ F b {\"init\"} ]", &["filters"]),
];

const ALSO_REFUSED: [(&str, &[&str]); 9] = [
    ("<<1>> Pmaxmin=? [ F b ]", &["strategy"]),
    ("A [ F b ]", &["CTL"]),
    ("P(modifier)=? [ F b ]", &["modifier"]),
    ("Pmaxmin=? [ F b?c:d ]", &["? :"]),
    ("Pmaxmin=? [ F x/2=1 ]", &["division"]),
    ("Pmaxmin=? [ F x^2=1 ]", &["powers"]),
    ("Pmaxmin=? [ F max(x,y)=1 ]", &["functions"]),
    ("Pmaxmin=? [ F mod(x,2)=1 ]", &["functions"]),
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
    let error = parse_properties("Pmin=? [ F b ];\n\"é\"").unwrap_err();
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
