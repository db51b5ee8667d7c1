//! Interval functions against mpmath: scripts/interval-reference.py writes the exact ranges.

use dynabs::system::Interval;

const RANGES: &str = include_str!("data/intervals.csv");

struct Case<'a> {
    function: &'a str,
    argument: Interval,
    exponent: Option<Interval>,
    exact: Interval,
}

fn cases() -> impl Iterator<Item = Case<'static>> {
    let double = |hex: &str| f64::from_bits(u64::from_str_radix(hex, 16).unwrap());
    RANGES.lines().skip(1).map(move |line| {
        let fields: Vec<_> = line.split(',').collect();
        let ends = |i: usize| fields[i].split(' ').map(double).collect::<Vec<_>>();
        let (lower, upper) = (ends(1), ends(2));
        Case {
            function: fields[0],
            argument: Interval::new(lower[0], upper[0]),
            exponent: lower.get(1).map(|&exponent| Interval::new(exponent, upper[1])),
            exact: Interval::new(double(fields[3]), double(fields[4])),
        }
    })
}

fn value(case: &Case<'_>) -> Interval {
    let x = case.argument;
    match case.function {
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "atan" => x.atan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "exp" => x.exp(),
        "ln" => x.ln(),
        "sqrt" => x.sqrt(),
        "power" => x.power_real(case.exponent.unwrap()),
        other => panic!("unknown function {other}"),
    }
}

#[test]
fn ranges_are_enclosed() {
    for case in cases() {
        let result = value(&case);
        let what = format!("{} of {:?}: {result:?}, exactly {:?}", case.function, case.argument, case.exact);
        assert!(result.encloses(case.exact), "{what}");
    }
}

/// At most one unit wider on either side than an exact computation would be.
#[test]
fn ranges_are_tight() {
    for case in cases() {
        let result = value(&case);
        let widest = Interval::new(case.exact.lower().next_down(), case.exact.upper().next_up());
        let what = format!("{} of {:?}: {result:?}, exactly {:?}", case.function, case.argument, case.exact);
        assert!(widest.encloses(result), "{what}");
    }
}

/// The control: results that are only rounded to nearest do not enclose, so the test above would notice.
#[test]
fn a_forgotten_rounding_would_be_noticed() {
    let (mut numbers, mut missed) = (0, 0);
    for case in cases().filter(|case| case.argument.is_point() && case.exponent.is_none()) {
        let result = value(&case);
        numbers += 1;
        let nearest = Interval::point(result.middle());
        missed += usize::from(!nearest.encloses(case.exact));
    }
    assert!(numbers > 700 && missed * 10 > numbers * 9, "{missed} of {numbers}");
}
