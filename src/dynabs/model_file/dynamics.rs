//! The field `dynamics` of a model file, and the mode it describes.

use super::given::given;
use super::named::Named;
use super::set_fields::{GridSpec, SetSpec};
use crate::Diagnostic;
use crate::problem::{Constant, Equations, ExpressionDynamics, GroupSteps, LinearDynamics};
use crate::system::{Discretisation, Interval, Mode, SampledLinear, Variable};
use imdp::numeric::from_decimal;
use schemars::JsonSchema;
use serde::Deserialize;

/// The dynamics of one step, before noise is added: matrices `A x + B u + q`, or expressions.
///
/// With `sample_time` they are differential equations, and a step is what they do in that time while the input is
/// held: exactly for matrices, by a Taylor series with a bounded remainder for expressions.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Dynamics")]
pub(super) struct DynamicsSpec {
    /// `A`, n×n, row by row; not singular for actions "targets".
    #[serde(rename = "A", default)]
    pub(super) a: Option<Vec<Vec<f64>>>,
    /// `B`, n×p, row by row; absent if there is nothing to choose.
    #[serde(rename = "B", default)]
    pub(super) b: Option<Vec<Vec<f64>>>,
    /// `q`, n numbers; 0 if absent.
    #[serde(default)]
    pub(super) q: Option<Vec<f64>>,
    /// For actions "targets": how many steps d become one: an integer, or "auto" (the default) for the smallest
    /// number that makes the grouped `B` of full row rank.
    #[serde(default)]
    pub(super) group_steps: GroupSteps,
    /// One expression per state: its next value, such as "x1 + 0.1*x2*cos(x3)", in states, inputs, parameters,
    /// constants and definitions, with + - * / ^, sin cos tan atan asin acos sinh cosh tanh exp ln sqrt abs min max
    /// clip(x, lower, upper), pi.
    #[serde(default)]
    pub(super) next: Option<Vec<String>>,
    /// One expression per state: its rate of change; needs `sample_time`.
    #[serde(default)]
    pub(super) derivative: Option<Vec<String>>,
    /// How long a step takes, in the unit of time of the equations.
    #[serde(default)]
    pub(super) sample_time: Option<f64>,
    /// How many steps one input is held for; noise is added after the last one. 1 if absent.
    #[serde(default)]
    pub(super) hold: Option<u32>,
    /// The names of the states; x1, x2, … if absent.
    #[serde(default)]
    pub(super) states: Option<Vec<String>>,
    /// The names of the inputs; u1, u2, … if absent.
    #[serde(default)]
    pub(super) inputs: Option<Vec<String>>,
    /// The units of states and inputs, by name.
    #[serde(default)]
    pub(super) units: Named<String>,
    /// Parameters of which only an interval is known, [lower, upper]; they may change at every step.
    #[serde(default)]
    pub(super) parameters: Named<[f64; 2]>,
    /// Named constants: numbers, or expressions in the constants before them.
    #[serde(default)]
    pub(super) constants: Named<ConstantSpec>,
    /// Named parts of the expressions; each may use those before it.
    #[serde(default)]
    pub(super) definitions: Named<String>,
}

/// A named constant.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Constant")]
pub(super) enum ConstantSpec {
    /// A number.
    Number(f64),
    /// An expression in the constants before it.
    Expression(String),
}

impl DynamicsSpec {
    /// A field that actions "targets" have no use for, if there is one.
    pub(super) fn beyond_matrices(&self) -> Option<&'static str> {
        let fields = [
            ("next", self.next.is_some()),
            ("derivative", self.derivative.is_some()),
            ("sample_time", self.sample_time.is_some()),
            ("hold", self.hold.is_some()),
            ("parameters", !self.parameters.0.is_empty()),
            ("constants", !self.constants.0.is_empty()),
            ("definitions", !self.definitions.0.is_empty()),
        ];
        fields.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
    }

    /// The mode, for the partition and the inputs of the model file.
    pub(super) fn mode(self, partition: &GridSpec, input: Option<&SetSpec>) -> Result<Mode, Diagnostic> {
        match (&self.a, &self.next, &self.derivative) {
            (Some(_), None, None) => self.matrices(),
            (None, Some(_), None) | (None, None, Some(_)) => self.expressions(partition, input),
            _ => {
                let given = given(&[
                    ("A", self.a.is_some()),
                    ("next", self.next.is_some()),
                    ("derivative", self.derivative.is_some()),
                ]);
                let found = if given.is_empty() { "none".to_owned() } else { given };
                Err(Diagnostic::at("/dynamics", found, "exactly one of A, next and derivative"))
            }
        }
    }

    fn matrices(self) -> Result<Mode, Diagnostic> {
        for (field, given) in [
            ("parameters", !self.parameters.0.is_empty()),
            ("constants", !self.constants.0.is_empty()),
            ("definitions", !self.definitions.0.is_empty()),
        ] {
            if given {
                let place = format!("/dynamics/{field}");
                return Err(Diagnostic::at(place, "a field for expressions", "only fields for matrices")
                    .remedy("Write the dynamics as expressions under \"next\" or \"derivative\"."));
            }
        }
        let linear =
            LinearDynamics { a: self.a.unwrap_or_default(), b: self.b.unwrap_or_default(), q: self.q };
        let system = linear.any_system()?;
        let mut states = named("states", self.states, "x", system.state_dimension())?;
        let mut inputs = named("inputs", self.inputs, "u", system.input_dimension())?;
        with_units([&mut states, &mut inputs], self.units)?;
        let held = self.hold.unwrap_or(1);
        if held == 0 || held > 64 {
            return Err(Diagnostic::at("/dynamics/hold", held.to_string(), "a number of steps from 1 to 64"));
        }
        let Some(sample_time) = self.sample_time else {
            let mode = Mode::linear(&system, states, inputs);
            return Ok(if held > 1 { mode.held(held) } else { mode });
        };
        let place = "/dynamics/sample_time";
        let time = from_decimal(sample_time)
            .filter(num_traits::Signed::is_positive)
            .ok_or_else(|| Diagnostic::at(place, sample_time.to_string(), "a positive number"))?;
        let sampled = SampledLinear::new(&system, &time).map_err(|error| {
            Diagnostic::at(place, error.to_string(), "a step that is short for these dynamics")
                .remedy("Divide sample_time by some number and give that number as \"hold\".")
        })?;
        let how = match sampled.is_exact() {
            true => Discretisation::Exact { time: sample_time },
            false => Discretisation::Enclosed { time: sample_time },
        };
        let mode = sampled.mode(states, inputs).discretised(how);
        Ok(if held > 1 { mode.held(held) } else { mode })
    }

    fn expressions(self, partition: &GridSpec, input: Option<&SetSpec>) -> Result<Mode, Diagnostic> {
        if self.b.is_some() || self.q.is_some() {
            let found = if self.b.is_some() { "B" } else { "q" };
            return Err(Diagnostic::at("/dynamics", found, "only fields for expressions"));
        }
        let count = self.next.as_ref().or(self.derivative.as_ref()).map_or(0, Vec::len);
        let mut states = named("states", self.states, "x", count)?;
        let count = self.inputs.as_ref().map_or_else(|| input.map_or(0, inputs_of), Vec::len);
        let mut inputs = named("inputs", self.inputs, "u", count)?;
        with_units([&mut states, &mut inputs], self.units)?;
        let domain = match self.derivative {
            None => Vec::new(),
            Some(_) => domain(partition, input, states.len(), inputs.len())?,
        };
        let equations = match (self.next, self.derivative, self.sample_time) {
            (Some(next), _, None) => Equations::Next(next),
            (Some(_), _, Some(time)) => {
                let place = "/dynamics/sample_time";
                return Err(Diagnostic::at(place, time.to_string(), "no sample_time beside \"next\"")
                    .remedy("Differential equations are given as \"derivative\"."));
            }
            (None, rates, Some(sample_time)) => {
                Equations::Rates { rates: rates.unwrap_or_default(), sample_time }
            }
            (None, ..) => {
                return Err(Diagnostic::at("/dynamics", "derivative without sample_time", "both"));
            }
        };
        let constants = self.constants.0.into_iter().map(|(name, constant)| match constant {
            ConstantSpec::Number(x) => (name, Constant::Number(x)),
            ConstantSpec::Expression(text) => (name, Constant::Expression(text)),
        });
        let dynamics = ExpressionDynamics {
            states,
            inputs,
            parameters: self.parameters.0,
            constants: constants.collect(),
            definitions: self.definitions.0,
            equations,
            hold: self.hold.unwrap_or(1),
        };
        dynamics.mode(&domain)
    }
}

/// Gives units to the variables that have them.
fn with_units(variables: [&mut [Variable]; 2], units: Named<String>) -> Result<(), Diagnostic> {
    let mut variables: Vec<&mut Variable> = variables.into_iter().flatten().collect();
    for (name, unit) in units.0 {
        match variables.iter_mut().find(|variable| variable.name == name) {
            Some(variable) => variable.unit = Some(unit),
            None => {
                let place = format!("/dynamics/units/{name}");
                return Err(Diagnostic::at(place, "an unknown name", "the name of a state or an input"));
            }
        }
    }
    Ok(())
}

/// The variables with the given names, if there are `count` of them; numbered ones if none are given.
fn named(
    field: &str,
    names: Option<Vec<String>>,
    letter: &str,
    count: usize,
) -> Result<Vec<Variable>, Diagnostic> {
    match names {
        None => Ok(Variable::numbered(letter, count)),
        Some(names) if names.len() == count => {
            Ok(names.into_iter().map(|name| Variable { name, unit: None }).collect())
        }
        Some(names) => {
            let place = format!("/dynamics/{field}");
            Err(Diagnostic::at(place, format!("{} names", names.len()), format!("{count}, one for each")))
        }
    }
}

fn inputs_of(spec: &SetSpec) -> usize {
    let of_list = || spec.list.as_ref().and_then(|list| list.first()).map(Vec::len);
    let of_normals = || spec.normals.as_ref().and_then(|normals| normals.first()).map(Vec::len);
    spec.lower.as_ref().map(Vec::len).or_else(of_list).or_else(of_normals).unwrap_or(0)
}

/// The boxes of states and inputs that steps start from.
fn domain(
    partition: &GridSpec,
    input: Option<&SetSpec>,
    states: usize,
    inputs: usize,
) -> Result<Vec<Interval>, Diagnostic> {
    let mut domain = sides("/partition", &partition.lower, &partition.upper, states)?;
    let Some(spec) = input.filter(|_| inputs > 0) else { return Ok(domain) };
    match (&spec.lower, &spec.upper, &spec.list) {
        (Some(lower), Some(upper), _) => domain.extend(sides("/input", lower, upper, inputs)?),
        (None, None, Some(list)) => {
            let end = |i: usize, pick: fn(f64, f64) -> f64, start: f64| {
                list.iter().filter_map(|input| input.get(i)).fold(start, |end, &u| pick(end, u))
            };
            let lower: Vec<f64> = (0..inputs).map(|i| end(i, f64::min, f64::INFINITY)).collect();
            let upper: Vec<f64> = (0..inputs).map(|i| end(i, f64::max, f64::NEG_INFINITY)).collect();
            domain.extend(sides("/input/list", &lower, &upper, inputs)?);
        }
        _ => {
            let expected = "a box {lower, upper} or a list, for differential equations";
            return Err(Diagnostic::at("/input", "another kind of set", expected));
        }
    }
    Ok(domain)
}

fn sides(place: &str, lower: &[f64], upper: &[f64], count: usize) -> Result<Vec<Interval>, Diagnostic> {
    if lower.len() != count || upper.len() != count {
        let found = format!("{} lower and {} upper ends", lower.len(), upper.len());
        return Err(Diagnostic::at(place, found, format!("{count} of each")));
    }
    let side = |(&lower, &upper): (&f64, &f64)| match (from_decimal(lower), from_decimal(upper)) {
        (Some(lower), Some(upper)) if lower <= upper => Ok(Interval::enclosing(&lower, &upper)),
        _ => Err(Diagnostic::at(place, format!("[{lower}, {upper}]"), "finite ends, lower ≤ upper")),
    };
    lower.iter().zip(upper).map(side).collect()
}
