//! Random properties print and parse back; random texts are refused without a panic.

use crate::property::{
    IntegerExpression, Optimum, PathFormula, Probability, Property, Question, Relation, Resolution,
    StateFormula, Threshold, ThresholdComparison, parse_properties,
};
use proptest::option;
use proptest::prelude::*;

fn name() -> impl Strategy<Value = String> {
    // No keyword of PRISM starts like this.
    "[xyz_][a-zA-Z0-9_]{0,3}"
}

fn integer() -> impl Strategy<Value = IntegerExpression> {
    use IntegerExpression::{Add, Literal, Multiply, Negate, Subtract, Variable};
    let leaf = prop_oneof![(0..=i32::MAX as u32).prop_map(Literal), name().prop_map(Variable)];
    leaf.prop_recursive(4, 16, 2, |inner| {
        let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        prop_oneof![
            inner.clone().prop_map(|operand| Negate(Box::new(operand))),
            pair().prop_map(|(left, right)| Add(left, right)),
            pair().prop_map(|(left, right)| Subtract(left, right)),
            pair().prop_map(|(left, right)| Multiply(left, right)),
        ]
    })
}

fn comparison() -> impl Strategy<Value = Relation> {
    use Relation::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
    prop::sample::select(vec![Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual])
}

fn formula() -> impl Strategy<Value = StateFormula> {
    use StateFormula::{And, Compare, Differ, False, Iff, Implies, Label, Not, Or, True, Variable};
    let leaf = prop_oneof![
        Just(True),
        Just(False),
        name().prop_map(Label),
        name().prop_map(Variable),
        (integer(), comparison(), integer()).prop_map(|(left, how, right)| Compare(left, how, right)),
    ];
    leaf.prop_recursive(5, 32, 4, |inner| {
        let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        prop_oneof![
            inner.clone().prop_map(|operand| Not(Box::new(operand))),
            prop::collection::vec(inner.clone(), 2..4).prop_map(And),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Or),
            pair().prop_map(|(left, right)| Implies(left, right)),
            pair().prop_map(|(left, right)| Iff(left, right)),
            // Two variables are compared as integers.
            (inner.clone(), name()).prop_map(|(left, name)| Differ(Box::new(left), Box::new(Label(name)))),
        ]
    })
}

fn path() -> impl Strategy<Value = PathFormula> {
    let steps = || option::of(0..=i32::MAX as u64);
    prop_oneof![
        formula().prop_map(PathFormula::Next),
        (formula(), steps()).prop_map(|(formula, steps)| PathFormula::Finally { formula, steps }),
        (formula(), steps()).prop_map(|(formula, steps)| PathFormula::Globally { formula, steps }),
        (formula(), formula(), steps()).prop_map(|(left, right, steps)| PathFormula::Until {
            left,
            right,
            steps
        }),
    ]
}

fn question() -> impl Strategy<Value = Question> {
    use ThresholdComparison::{Above, AtLeast, AtMost, Below};
    let optimum = || {
        let resolution = prop::sample::select(Resolution::ALL.to_vec());
        prop_oneof![Just(Optimum::Min), Just(Optimum::Max), resolution.prop_map(Optimum::Both)]
    };
    let threshold = || {
        let comparison = prop::sample::select(vec![AtLeast, Above, AtMost, Below]);
        (comparison, prop_oneof![0.0..=1.0, 0.0..1e-9]).prop_map(|(comparison, x)| {
            let probability = Probability::from_f64(x).unwrap();
            Threshold { comparison, probability }
        })
    };
    prop_oneof![
        optimum().prop_map(Question::Value),
        (optimum(), threshold()).prop_map(|(optimum, threshold)| Question::Verdict(optimum, threshold)),
        threshold().prop_map(Question::ForAll),
    ]
}

fn property() -> impl Strategy<Value = Property> {
    (option::of(name()), question(), path()).prop_map(|(name, question, path)| Property {
        name,
        question,
        path,
    })
}

/// Texts made of what properties are made of.
fn almost_property() -> impl Strategy<Value = String> {
    let parts = "Pmaxmin =? P > >= 0.5 [ ] ( ) F G X U W R <= < 8 -1 \" goal x = != ! & | => <=> + - * / ? : ; // , { }";
    let parts: Vec<&str> = parts.split(' ').collect();
    prop::collection::vec(prop::sample::select(parts), 0..40).prop_map(|parts| parts.join(" "))
}

proptest! {
    #[test]
    fn printed_properties_parse_back(property in property()) {
        let printed = property.to_string();
        prop_assert_eq!(printed.parse(), Ok(property), "{}", printed);
    }

    #[test]
    fn files_parse_back(properties in prop::collection::vec(property(), 0..4)) {
        // Names may coincide by chance.
        let number = |(i, property): (usize, Property)| property.named(format!("n{i}"));
        let properties: Vec<_> = properties.into_iter().enumerate().map(number).collect();
        for separator in [";\n", "\n"] {
            let printed: Vec<_> = properties.iter().map(Property::to_string).collect();
            prop_assert_eq!(parse_properties(&printed.join(separator)), Ok(properties.clone()));
        }
    }

    #[test]
    fn random_texts_do_not_panic(text in "[ -~\n]{0,80}", unicode in "\\PC{0,20}", parts in almost_property()) {
        for text in [text, unicode, parts] {
            if let Err(error) = parse_properties(&text) {
                prop_assert!(text.is_char_boundary(error.position().offset));
                prop_assert!(!error.to_string().is_empty());
            }
        }
    }

    #[test]
    fn mutated_properties_do_not_panic(
        property in property(),
        at in any::<prop::sample::Index>(),
        removed in 0usize..4,
        inserted in "[ -~é]{0,3}",
    ) {
        let mut characters: Vec<char> = property.to_string().chars().collect();
        let start = at.index(characters.len());
        let end = (start + removed).min(characters.len());
        characters.splice(start..end, inserted.chars());
        let text: String = characters.into_iter().collect();
        // What is still a property keeps its meaning when printed.
        if let Ok(property) = text.parse::<Property>() {
            prop_assert_eq!(property.to_string().parse(), Ok(property));
        }
    }
}
