//! Dynamics written as expressions.

use super::values::count;
use crate::Diagnostic;
use crate::system::expression::{Graph, NodeId, Scope, parse};
use crate::system::{Discretisation, Interval, Mode, TaylorStep, Variable};
use imdp::numeric::{Rational, from_decimal};
use num_traits::Signed;

/// `x⁺ = f(x, u, θ) + η` or `ẋ = f(x, u, θ)`, in texts such as `"x1 + 0.1*x2*cos(x3)"`.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionDynamics {
    /// The coordinates of the state, by the names that expressions use.
    pub states: Vec<Variable>,
    /// The coordinates of the input.
    pub inputs: Vec<Variable>,
    /// Parameters known only to lie in an interval `[lower, upper]`, free to change at every step.
    pub parameters: Vec<(String, [f64; 2])>,
    /// Named constants, in order: each may use those before it.
    pub constants: Vec<(String, Constant)>,
    /// Named parts of the equations, in order: each may use those before it.
    pub definitions: Vec<(String, String)>,
    /// One expression per state.
    pub equations: Equations,
    /// How many steps one input is held for; noise is added after the last one.
    pub hold: u32,
}

/// A named constant.
#[derive(Clone, Debug, PartialEq)]
pub enum Constant {
    /// The decimal as written.
    Number(f64),
    /// An expression in other constants.
    Expression(String),
}

/// What the expressions are.
#[derive(Clone, Debug, PartialEq)]
pub enum Equations {
    /// The next state.
    Next(Vec<String>),
    /// The rate of change of the state.
    Rates {
        /// One expression per state.
        rates: Vec<String>,
        /// How long a step takes.
        sample_time: f64,
    },
}

/// One input is held for at most this many steps: each makes the expressions longer.
const MOST_HELD: u32 = 64;

impl ExpressionDynamics {
    /// The mode they describe. `domain` holds the box of states and the box of inputs that steps start from; only
    /// rates need it, to bound what their Taylor series leaves out.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub fn mode(&self, domain: &[Interval]) -> Result<Mode, Diagnostic> {
        let (mut graph, mut scope) = (Graph::default(), Scope::default());
        self.declare(&mut graph, &mut scope)?;
        let parameters = self.parameter_boxes()?;
        let (field, texts) = match &self.equations {
            Equations::Next(texts) => ("next", texts),
            Equations::Rates { rates, .. } => ("derivative", rates),
        };
        if texts.len() != self.states.len() {
            let expected = format!("{}, one per state", count(self.states.len(), "expression"));
            return Err(Diagnostic::at(
                format!("/dynamics/{field}"),
                count(texts.len(), "expression"),
                expected,
            ));
        }
        let mut roots = Vec::with_capacity(texts.len());
        for (i, text) in texts.iter().enumerate() {
            roots.push(expression(&mut graph, &scope, text, &format!("/dynamics/{field}/{i}"))?);
        }
        if self.hold == 0 || self.hold > MOST_HELD {
            let expected = format!("a number of steps from 1 to {MOST_HELD}");
            return Err(Diagnostic::at("/dynamics/hold", self.hold.to_string(), expected));
        }
        let (next, how) = match &self.equations {
            Equations::Next(_) => (roots, None),
            Equations::Rates { sample_time, .. } => {
                let time = positive("/dynamics/sample_time", *sample_time)?;
                let mut variables = domain.to_vec();
                variables.extend_from_slice(&parameters);
                let found =
                    TaylorStep::find(&mut graph, &roots, &time, self.hold, &variables).map_err(|error| {
                        let place = match error.place(&graph) {
                            Some((text, column)) => format!("{text} (column {column})"),
                            None => "/dynamics/sample_time".into(),
                        };
                        Diagnostic::at(place, error.to_string(), error.expected()).remedy(error.remedy())
                    })?;
                let TaylorStep { next, degree, substeps, remainder } = found;
                let time = *sample_time;
                (next, Some(Discretisation::Taylor { time, degree, substeps, remainder }))
            }
        };
        let mode = Mode::new(graph, next, self.states.clone(), self.inputs.clone(), parameters);
        let mode = match how {
            Some(how) => mode.discretised(how),
            None => mode,
        };
        // The Taylor series has taken all its steps already.
        let repeats = matches!(self.equations, Equations::Next(_)) && self.hold > 1;
        Ok(if repeats { mode.held(self.hold) } else { mode })
    }

    /// Gives all names a meaning.
    fn declare(&self, graph: &mut Graph, scope: &mut Scope) -> Result<(), Diagnostic> {
        let states = self.states.iter().map(|v| ("states", v.name.as_str()));
        let inputs = self.inputs.iter().map(|v| ("inputs", v.name.as_str()));
        // Constants are read without states and inputs in scope.
        let mut constants = Scope::default();
        let mut values = Vec::new();
        for (name, constant) in &self.constants {
            let place = format!("/dynamics/constants/{name}");
            let node = match constant {
                Constant::Number(x) => {
                    let value = from_decimal(*x)
                        .ok_or_else(|| Diagnostic::at(&place, x.to_string(), "a finite number"))?;
                    graph.constant(value)
                }
                Constant::Expression(text) => expression(graph, &constants, text, &place)?,
            };
            declare(&mut constants, &place, name, node)?;
            values.push((place, name.as_str(), node));
        }
        let parameters = self.parameters.iter().map(|(name, _)| ("parameters", name.as_str()));
        for (number, (field, name)) in states.chain(inputs).chain(parameters).enumerate() {
            let node = graph.variable(number as u32);
            declare(scope, &format!("/dynamics/{field}"), name, node)?;
        }
        for (place, name, node) in values {
            declare(scope, &place, name, node)?;
        }
        for (name, text) in &self.definitions {
            let place = format!("/dynamics/definitions/{name}");
            let node = expression(graph, scope, text, &place)?;
            declare(scope, &place, name, node)?;
        }
        Ok(())
    }

    fn parameter_boxes(&self) -> Result<Vec<Interval>, Diagnostic> {
        let parameter = |(name, [lower, upper]): &(String, [f64; 2])| {
            let ends = (from_decimal(*lower), from_decimal(*upper));
            match ends {
                (Some(lower), Some(upper)) if lower <= upper => Ok(Interval::enclosing(&lower, &upper)),
                _ => {
                    let found = format!("[{lower}, {upper}]");
                    let place = format!("/dynamics/parameters/{name}");
                    Err(Diagnostic::at(place, found, "an interval [lower, upper] with lower ≤ upper"))
                }
            }
        };
        self.parameters.iter().map(parameter).collect()
    }
}

fn declare(scope: &mut Scope, place: &str, name: &str, node: NodeId) -> Result<(), Diagnostic> {
    scope
        .insert(name, node)
        .map_err(|error| Diagnostic::at(place, error.to_string(), "a name of its own for every quantity"))
}

fn expression(graph: &mut Graph, scope: &Scope, text: &str, place: &str) -> Result<NodeId, Diagnostic> {
    parse(graph, scope, text, place).map_err(|error| {
        let place = format!("{place} (column {})", error.column);
        let diagnostic = Diagnostic::at(place, error.found, error.expected);
        match error.remedy {
            Some(remedy) => diagnostic.remedy(remedy),
            None => diagnostic,
        }
    })
}

/// A positive decimal, exactly.
pub(super) fn positive(place: &str, x: f64) -> Result<Rational, Diagnostic> {
    from_decimal(x)
        .filter(Signed::is_positive)
        .ok_or_else(|| Diagnostic::at(place, x.to_string(), "a positive number"))
}
