//! Files with definitions, and questions about more than one probability.

use crate::property::{Definitions, Entry, Inquiry, parse_document, parse_inquiry};

const COMPOUND: [&str; 30] = [
    "(Pmaxmin=? [ F b ])=0.5",
    "0.5<=Pmaxmin=? [ F b ]",
    "1-Pmaxmin=? [ F b ]",
    "Pmaxmin=? [ F P>=0.5 [ F b ] ]",
    "Pmaxmin=? [ F G b ]",
    "Pmaxmin=? [ !(F b) ]",
    "Pmaxmin=? [ (F b) & (G b) ]",
    "Pmaxmin=? [ a U (b U c) ]",
    "Pmaxmin=? [ a W b ]",
    "Pmaxmin=? [ a R b ]",
    "Pmaxmin=? [ F>=2 b ]",
    "Pmaxmin=? [ F=2 b ]",
    "Pmaxmin=? [ F[1,2] b ]",
    "Pmaxmin=? [ X X b ]",
    "Pmaxmin=? [ F x<0.5 ]",
    "Pmaxmin=? [ F b?c:d ]",
    "Pmaxmin=? [ F x/2=1 ]",
    "Pmaxmin=? [ F max(x,y,2)=1 ]",
    "Pmaxmin=? [ F mod(x,2)=floor(1.5) ]",
    "Pmaxmin=? [ F func(mod,x,2)=1 ]",
    "Rmaxmin=? [ F b ]",
    "R{\"time\"}minmax=? [ C<=2/5*10 ]",
    "R{2}max=? [ I=3 ]",
    "R<=4 [ F b ]",
    "Rmin=? [ C, discount=0.9 ]",
    "filter(min, Pmaxmin=? [ F b ], \"init\" & x>0)",
    "filter(count, P>=0.5 [ F b ])",
    "P>=0.5 [ F b ] & !(P<0.1 [ X b ])",
    "max(Pmaxmin=? [ F b ], Pmaxmin=? [ F c ])/2",
    "x>0 ? Pmaxmin=? [ F b ] : 1",
];

#[test]
fn other_questions_are_compound() {
    for text in COMPOUND {
        let inquiry = parse_inquiry(text, &Definitions::default()).unwrap_or_else(|error| panic!("{error}"));
        let Inquiry::Compound(compound) = inquiry else { panic!("{text}") };
        assert_eq!(compound.to_string(), text);
    }
}

fn read(text: &str, constants: &str) -> Vec<Entry> {
    let mut definitions = Definitions::default();
    definitions.give(constants).unwrap();
    parse_document(text, &mut definitions)
}

fn printed(entry: &Entry) -> String {
    match &entry.inquiry {
        Ok(Inquiry::Probability(property)) => property.to_string(),
        Ok(Inquiry::Compound(compound)) => compound.to_string(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn definitions_are_put_in_their_places() {
    let text = "const int K=2; const double p; // a comment\nconst int L = K*2+1;\nformula near = x<=K;\n\
                label \"close\" = near | \"goal\";\n\"a\": Pmaxmin=? [ F<=(K+L) \"close\" ]\n\
                P>=p [ X near ];\nP>=2/5 [ F<=K/2+1 b ]\n(Pmaxmin=? [ F b ])>=1/3";
    let entries = read(text, "p=0.25");
    let texts: Vec<_> = entries.iter().map(printed).collect();
    assert_eq!(
        texts,
        [
            "\"a\": Pmaxmin=? [ F<=7 (x <= 2 | \"goal\") ]",
            "P>=0.25 [ X x <= 2 ]",
            "P>=0.4 [ F<=2 b ]",
            "(Pmaxmin=? [ F b ])>=1/3",
        ]
    );
    assert_eq!(entries[0].name.as_deref(), Some("a"));
    // What is given from outside counts more.
    assert!(printed(&read(text, "K=5,p=1")[0]).contains("F<=16"));
}

#[test]
fn one_broken_line_does_not_stop_the_others() {
    let text = "Pmaxmin=? [ F b ]\nPmaxmin=? [ F b \nPmaxmin=? [ S b ];\nmulti(Pmax=? [ F b ], Pmax=? [ F c ]);\n\
                const int = 3;\nPmaxmin=? [ G b ]; P>=q [ F b ]; Pminmin=? [ X b ]";
    let entries = read(text, "");
    let answered: Vec<_> = entries.iter().filter(|entry| entry.inquiry.is_ok()).map(printed).collect();
    assert_eq!(answered, ["Pmaxmin=? [ F b ]", "Pmaxmin=? [ G b ]", "Pminmin=? [ X b ]"]);
    assert_eq!(entries.len(), 8, "{entries:?}");
    assert!(printed(&entries[3]).contains("multi-objective"));
}

#[test]
fn constants_without_a_value_are_named() {
    let entries = read("const int N; Pmaxmin=? [ F<=N b ]; Pmaxmin=? [ F b ]", "");
    assert!(printed(&entries[0]).contains("the constant N, which has no value"), "{}", printed(&entries[0]));
    assert!(entries[1].inquiry.is_ok());
}
