//! Texts that are properties, and the form in which they are printed.

use crate::property::{PathFormula, Property, StateFormula, parse_properties};

/// State formulas inside of `Pmaxmin=? [ F … ]`.
const FORMULAS: [(&str, &str); 41] = [
    ("\"goal\"", "\"goal\""),
    ("\" goal \"", "\"goal\""),
    ("\"F\"", "\"F\""),
    ("\"init\"", "\"init\""),
    ("true", "true"),
    ("(((false)))", "false"),
    ("b", "b"),
    ("!!b", "!!b"),
    ("!(b)&c", "!b & c"),
    ("!(b&c)", "!(b & c)"),
    ("a&b&c", "a & b & c"),
    ("(a&b)&c", "(a & b) & c"),
    ("a&(b&c)", "a & (b & c)"),
    ("a|b&c", "a | b & c"),
    ("(a|b)&c", "(a | b) & c"),
    ("a&b|c&d", "a & b | c & d"),
    ("a=>b=>c", "a => b => c"),
    ("(a=>b)=>c", "(a => b) => c"),
    ("a<=>b<=>c", "a <=> b <=> c"),
    ("a<=>(b<=>c)", "a <=> (b <=> c)"),
    ("a<=>b=>c|d", "a <=> b => c | d"),
    ("a<=>(b=>c)", "a <=> (b => c)"),
    ("x=1", "x = 1"),
    ("!x=1", "!(x = 1)"),
    ("!!x=1", "!!(x = 1)"),
    ("x=-1", "x = -1"),
    ("x<-1", "x < -1"),
    ("x!=1&x<=2|x>=3&y<4", "x != 1 & x <= 2 | x >= 3 & y < 4"),
    ("x+y*2-1>-x", "x+y*2-1 > -x"),
    ("(x+y)*2>1", "(x+y)*2 > 1"),
    ("x-(y-1)=x-y-1", "x-(y-1) = x-y-1"),
    ("x*(y*2)=0", "x*(y*2) = 0"),
    ("--x=-(x+1)", "--x = -(x+1)"),
    ("-x*y=0", "-x*y = 0"),
    ("-(x*y)=0", "-(x*y) = 0"),
    ("a=b", "a = b"),
    ("b=true", "b <=> true"),
    ("\"goal\"!=b", "\"goal\" != b"),
    ("x=1=(y=2)", "x = 1 <=> y = 2"),
    ("x>0=y>0&b", "(x > 0 <=> y > 0) & b"),
    ("x=2147483647", "x = 2147483647"),
];

const PROPERTIES: [(&str, &str); 34] = [
    ("Pmaxmin=?[F\"g\"]", "Pmaxmin=? [ F \"g\" ]"),
    ("Pmaxmax =? [ F \"g\" ]", "Pmaxmax=? [ F \"g\" ]"),
    ("P min min = ? [F \"g\"]", "Pminmin=? [ F \"g\" ]"),
    ("P minmax=? [F \"g\"];", "Pminmax=? [ F \"g\" ]"),
    ("Pmin=? [F \"g\"]", "Pmin=? [ F \"g\" ]"),
    ("P max=? [F \"g\"]", "Pmax=? [ F \"g\" ]"),
    ("\"safe\": Pmin=? [ G !\"g\" ]", "\"safe\": Pmin=? [ G !\"g\" ]"),
    ("(Pmaxmin=? [F \"g\"])>=0.95", "(Pmaxmin=? [ F \"g\" ])>=0.95"),
    ("Pmaxmin=? [F \"g\"] > .5", "(Pmaxmin=? [ F \"g\" ])>.5"),
    ("((Pminmax=? [F \"g\"])) <= 1e-3", "(Pminmax=? [ F \"g\" ])<=1e-3"),
    ("(Pmax=? [F \"g\"])<(0.50)", "(Pmax=? [ F \"g\" ])<0.50"),
    ("P>=0.9 [F \"g\"]", "P>=0.9 [ F \"g\" ]"),
    ("P > 0 [F \"g\"]", "P>0 [ F \"g\" ]"),
    ("P<=1[F \"g\"]", "P<=1 [ F \"g\" ]"),
    ("P<0.0000000000000000000001 [F \"g\"]", "P<0.0000000000000000000001 [ F \"g\" ]"),
    ("Pmin=? [ X b ]", "Pmin=? [ X b ]"),
    ("Pmin=? [ F<=0 b ]", "Pmin=? [ F<=0 b ]"),
    ("Pmin=? [ F<1 b ]", "Pmin=? [ F<=0 b ]"),
    ("Pmin=? [ F<=2*4-1 b ]", "Pmin=? [ F<=7 b ]"),
    ("Pmin=? [ F<=(8) (b) ]", "Pmin=? [ F<=8 b ]"),
    ("Pmin=? [ F<=8(b)|c ]", "Pmin=? [ F<=8 (b | c) ]"),
    ("Pmin=? [ F<=8(-x=1) ]", "Pmin=? [ F<=8 (-x = 1) ]"),
    ("Pmin=? [ F -x=1 ]", "Pmin=? [ F -x = 1 ]"),
    ("Pmin=? [ F<=8!b ]", "Pmin=? [ F<=8 !b ]"),
    ("Pmin=? [ (F b) ]", "Pmin=? [ F b ]"),
    ("Pmin=? [ G b ]", "Pmin=? [ G b ]"),
    ("Pmin=? [ G<=4 b ]", "Pmin=? [ G<=4 b ]"),
    ("Pmin=? [ G<4 b ]", "Pmin=? [ G<=3 b ]"),
    ("Pmin=? [ a U b ]", "Pmin=? [ a U b ]"),
    ("Pmin=? [ a U<4 b ]", "Pmin=? [ a U<=3 b ]"),
    ("Pmin=? [ !\"a\" U<=2147483647 \"b\" ]", "Pmin=? [ !\"a\" U<=2147483647 \"b\" ]"),
    ("Pmin=? [ (a=>b) U c=>d ]", "Pmin=? [ (a => b) U (c => d) ]"),
    ("Pmin=? [ true U b ]", "Pmin=? [ true U b ]"),
    ("// why\nPmin=? [ // how\n F b ] // end", "Pmin=? [ F b ]"),
];

#[test]
fn formulas_print_in_one_form() {
    for (text, printed) in FORMULAS {
        assert_eq!(read(text).to_string(), printed);
        assert_eq!(read(printed), read(text), "{printed}");
    }
}

fn read(formula: &str) -> StateFormula {
    match parse(&format!("Pmaxmin=? [ F {formula} ]")).path {
        PathFormula::Finally { formula, steps: None } => formula,
        path => panic!("{path}"),
    }
}

fn parse(text: &str) -> Property {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn properties_print_in_one_form() {
    for (text, printed) in PROPERTIES {
        assert_eq!(parse(text).to_string(), printed);
        assert_eq!(parse(printed), parse(text), "{printed}");
    }
}

#[test]
fn files_hold_any_number_of_properties() {
    let text =
        "// two\n\"one\": Pmaxmin=? [ F \"g\" ];\n\n(Pmaxmin=? [ F \"g\" ])>=0.5 \n P>0.1[X b];;Pmin=?[G b]";
    let printed: Vec<_> = parse_properties(text).unwrap().iter().map(Property::to_string).collect();
    let expected =
        ["\"one\": Pmaxmin=? [ F \"g\" ]", "(Pmaxmin=? [ F \"g\" ])>=0.5", "P>0.1 [ X b ]", "Pmin=? [ G b ]"];
    assert_eq!(printed, expected);
    assert_eq!(parse_properties(" // nothing \n"), Ok(vec![]));
}

#[test]
fn long_chains_are_not_deep() {
    let chain = vec!["x=1"; 10_000].join("|");
    assert!(format!("Pmin=? [ F {chain} ]").parse::<Property>().is_ok());
}
