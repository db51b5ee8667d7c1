//! What is read, what is refused, and whether values and derivatives are enclosed.

use super::{ExpressionError, Graph, NodeId, Scope, Tape, parse};
use crate::system::Interval;
use proptest::prelude::*;

fn read(text: &str) -> Result<(Graph, NodeId), ExpressionError> {
    let (mut graph, mut scope) = (Graph::default(), Scope::default());
    for (number, name) in ["x", "y", "u"].into_iter().enumerate() {
        let variable = graph.variable(number as u32);
        scope.insert(name, variable).unwrap();
    }
    let root = parse(&mut graph, &scope, text, "f")?;
    Ok((graph, root))
}

fn at(text: &str, variables: &[f64]) -> f64 {
    let (graph, root) = read(text).unwrap();
    let mut out = [f64::NAN];
    Tape::new(&graph, &[root]).at_point(variables, &mut Vec::new(), &mut out);
    out[0]
}

fn on(text: &str, variables: &[Interval]) -> Interval {
    let (graph, root) = read(text).unwrap();
    let mut out = [Interval::EVERYTHING];
    Tape::new(&graph, &[root]).on_box(variables, &mut Vec::new(), &mut out);
    out[0]
}

#[test]
fn values() {
    for (text, expected) in [
        ("1 + 2*3^2", 19.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("8/4/2", 1.0),
        ("1 - 2 - 3", -4.0),
        ("--3", 3.0),
        ("+3", 3.0),
        (".5e1 + 1.E0", 6.0),
        ("2 − 3", -1.0),
        ("min(x, y) - max(x, y)", -1.0),
        ("clip(10*x, -3, 3)", 3.0),
        ("abs(x - y)", 1.0),
        ("sqrt(x*y + 2)", 2.0),
        ("4^0.5", 2.0),
        ("2*(x + y)*u", 30.0),
        ("sin(pi/2)", 1.0),
        ("exp(ln(y))", 2.0),
        ("x/y", 0.5),
    ] {
        assert_eq!(at(text, &[1.0, 2.0, 5.0]), expected, "{text}");
    }
}

#[test]
fn refused_with_a_column() {
    for (text, column, found) in [
        ("", 1, "the end"),
        ("1 +", 4, "the end"),
        ("2x", 2, "\"x\""),
        ("(x + y", 7, "the end"),
        ("x + y)", 6, "\")\""),
        ("x ** 2", 3, "\"**\""),
        ("x + z", 5, "the unknown name \"z\""),
        ("foo(x)", 1, "the unknown function \"foo\""),
        ("sin x", 5, "\"x\""),
        ("min(x)", 1, "1 arguments"),
        ("sin(x, y)", 1, "2 arguments"),
        ("x / 0", 3, "a division by 0"),
        ("x / (1 - 1)", 3, "a division by 0"),
        ("1e999", 1, "the exponent"),
        ("1e309", 1, "a number beyond"),
        (".", 1, "\".\""),
        ("x = 1", 3, "\"=\""),
        ("clip(x, 2, 1)", 1, "a clip"),
        ("x +* y", 4, "\"*\""),
        ("é + x", 1, "the unknown name"),
    ] {
        let error = read(text).unwrap_err();
        assert_eq!(error.column, column, "{text}: {error}");
        assert!(error.found.starts_with(found), "{text}: {error}");
    }
}

#[test]
fn absurd_sizes_are_refused() {
    let nested = format!("{}x{}", "(".repeat(100_000), ")".repeat(100_000));
    assert!(read(&nested).is_err());
    let nested = format!("{}x{}", "(".repeat(20_000), ")".repeat(20_000));
    assert!(read(&nested).unwrap_err().found.contains("nested"));
    assert!(read(&"-".repeat(60_000)).unwrap_err().found.contains("nested"));
    assert!(read(&format!("2{}", "^2".repeat(20_000))).is_err());
    assert!(read(&format!("x{}", "+x*y".repeat(12_000))).is_ok());
    // A tower of powers is no reason to compute for ever: it is too large, and says so when evaluated.
    assert!(!on("10^1000000*x", &[Interval::point(1.0); 3]).is_bounded());
    assert_eq!(at("1e-400 * x", &[1.0; 3]), 0.0);
}

#[test]
fn names() {
    let mut graph = Graph::default();
    let (mut scope, node) = (Scope::default(), graph.integer(1));
    for bad in ["", "1x", "x y", "sin", "pi", "clip", "x-1"] {
        assert!(scope.insert(bad, node).is_err(), "{bad}");
    }
    scope.insert("θ_1", node).unwrap();
    assert!(scope.insert("θ_1", node).is_err());
}

#[test]
fn powers_of_one_base_know_their_sign() {
    let around = Interval::new(-1.0, 2.0);
    assert_eq!(on("x*x", &[around; 3]), Interval::new(0.0, 4.0));
    assert_eq!(on("x*x*x*x", &[around; 3]), Interval::new(0.0, 16.0));
    assert_eq!(on("x - x", &[around; 3]), Interval::ZERO);
    assert_eq!(on("0*sin(x)", &[around; 3]), Interval::ZERO);
}

#[test]
fn what_is_undefined_has_a_place() {
    let (graph, root) = read("u + 2/(x - y)").unwrap();
    let tape = Tape::new(&graph, &[root]);
    let (mut slots, mut out) = (Vec::new(), [Interval::ZERO]);
    tape.on_box(&[Interval::new(-1.0, 2.0), Interval::new(0.0, 1.0), Interval::ZERO], &mut slots, &mut out);
    assert_eq!(out[0], Interval::EVERYTHING);
    let (node, operand) = tape.undefined(&graph, &slots).unwrap();
    assert_eq!((graph.place(node), operand), (Some(("f", 6)), Interval::new(-2.0, 2.0)));
}

#[test]
fn affine_functions_are_recognised() {
    let exact = |text: &str| {
        let (mut graph, root) = read(text).unwrap();
        let form = graph.affine(root, 2)?;
        let slope = |v| form.slopes.get(&v).map_or("0".into(), ToString::to_string);
        Some(format!("{} {}", slope(0), slope(1)))
    };
    assert_eq!(exact("x + 0.1*y - (y - 2*x)/4 + sin(u)").as_deref(), Some("3/2 -3/20"));
    assert_eq!(exact("u^2 - 3").as_deref(), Some("0 0"));
    assert_eq!(exact("2*(0.1*(x - y) - x)*5").as_deref(), Some("-9 -1"));
    for text in ["x*y", "u*x", "sin(x)", "min(x, y)", "x/u", "x^2"] {
        assert_eq!(exact(text), None, "{text}");
    }
}

/// Random expressions over x, y, u that are defined everywhere.
fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("x".to_owned()),
        Just("y".to_owned()),
        Just("u".to_owned()),
        (-50i32..50).prop_map(|n| format!("{}", f64::from(n) / 10.0)),
    ];
    leaf.prop_recursive(5, 40, 3, |inner| {
        let unary = prop::sample::select(vec!["sin", "cos", "atan", "tanh", "abs"]);
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} + {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} - {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a})*({b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("min({a}, {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("max({a}, {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a})/(1 + ({b})^2)")),
            (unary, inner.clone()).prop_map(|(f, a)| format!("{f}({a})")),
            (inner.clone(), 2i32..4).prop_map(|(a, n)| format!("({a})^{n}")),
            inner.clone().prop_map(|a| format!("exp(-({a})^2)")),
            inner.clone().prop_map(|a| format!("sqrt(1 + ({a})^2)")),
            inner.clone().prop_map(|a| format!("ln(2 + sin({a}))")),
            inner.prop_map(|a| format!("clip({a}, -1, 2)")),
        ]
    })
}

proptest! {
    #[test]
    fn values_of_points_lie_in_the_values_of_boxes(
        text in expression(),
        ends in prop::array::uniform3((-3f64..3.0, 0f64..0.5)),
        inside in prop::array::uniform3(0f64..=1.0),
    ) {
        let domain = ends.map(|(lower, width)| Interval::new(lower, lower + width));
        let point: Vec<f64> =
            domain.iter().zip(inside).map(|(d, t)| (d.lower() + t * d.width()).clamp(d.lower(), d.upper())).collect();
        let number = on(&text, &[point[0], point[1], point[2]].map(Interval::point));
        let range = on(&text, &domain);
        prop_assert!(range.encloses(number), "{} at {:?}: {:?}, over the box {:?}", text, point, number, range);
        let value = at(&text, &point);
        prop_assert!(number.contains(value) || (value - number.middle()).abs() <= 1e-9 * (1.0 + value.abs()));
    }

    /// Difference quotients are means of the derivative, so they lie in its enclosure over the segment.
    #[test]
    fn derivatives_enclose_difference_quotients(
        text in expression(),
        ends in prop::array::uniform3((-3f64..3.0, 1e-3f64..0.3)),
    ) {
        let (mut graph, root) = read(&text).unwrap();
        let domain = ends.map(|(lower, width)| Interval::new(lower, lower + width));
        for variable in 0..3 {
            let derivative = graph.derivative(root, variable as u32);
            let tape = Tape::new(&graph, &[root, derivative]);
            let mut line = domain.map(|d| Interval::point(d.lower()));
            let value = |x: f64, line: &mut [Interval; 3]| {
                line[variable] = Interval::point(x);
                let mut out = [Interval::ZERO; 2];
                tape.on_box(&line[..], &mut Vec::new(), &mut out);
                out[0]
            };
            let (low, high) = (domain[variable].lower(), domain[variable].upper());
            let change = value(high, &mut line) - value(low, &mut line);
            let quotient = change / (Interval::point(high) - Interval::point(low));
            line[variable] = domain[variable];
            let mut out = [Interval::ZERO; 2];
            tape.on_box(&line[..], &mut Vec::new(), &mut out);
            let met = out[1].lower() <= quotient.upper() && quotient.lower() <= out[1].upper();
            prop_assert!(met, "{} along {}: quotient {:?}, derivative {:?}", text, variable, quotient, out[1]);
        }
    }
}
