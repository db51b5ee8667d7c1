//! One way in which a system can move.

use super::expression::{Graph, NodeId, Tape};
use super::{Interval, LinearSystem};
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::Rational;
use num_traits::Zero;
use serde::{Deserialize, Serialize};

/// The map `x⁺ = f(x, u, θ)` of one mode, before noise is added.
///
/// Its expressions use the variables `0..n` for states, then inputs, then parameters.
#[derive(Clone, Debug)]
pub struct Mode {
    graph: Graph,
    next: Vec<NodeId>,
    states: Vec<Variable>,
    inputs: Vec<Variable>,
    parameters: Vec<Interval>,
    discretisation: Option<Discretisation>,
    step: Tape,
}

/// How a differential equation became one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Discretisation {
    /// By the exponential of the matrices, whose entries are known exactly.
    Exact {
        /// How long a step takes.
        time: f64,
    },
    /// By the exponential of the matrices, whose entries are enclosed.
    Enclosed {
        /// How long a step takes.
        time: f64,
    },
    /// By a Taylor series with a bounded remainder.
    Taylor {
        /// How long a step takes.
        time: f64,
        /// The degree of the series.
        degree: u32,
        /// The number of sub-steps.
        substeps: u32,
        /// The width of the widest remainder of a sub-step.
        remainder: f64,
    },
}

impl std::fmt::Display for Discretisation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exact { time } => write!(f, "{time} of time, by the exponential of the matrices, exactly"),
            Self::Enclosed { time } => {
                write!(f, "{time} of time, by the exponential of the matrices, its entries enclosed")
            }
            Self::Taylor { time, degree, substeps, remainder } => write!(
                f,
                "{time} of time, by a Taylor series of degree {degree} in {substeps} sub-steps, each with a remainder of \
                 width {remainder:.1e} that is part of the image"
            ),
        }
    }
}

/// A coordinate of the state or of the input.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// The unit that it is measured in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
}

impl std::fmt::Display for Variable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name)?;
        self.unit.as_ref().map_or(Ok(()), |unit| write!(f, " [{unit}]"))
    }
}

impl Variable {
    /// The variables `x1, x2, …` without units, for the letter `x`.
    pub fn numbered(letter: &str, count: usize) -> Vec<Self> {
        (1..=count).map(|k| Self { name: format!("{letter}{k}"), unit: None }).collect()
    }
}

impl Mode {
    /// The mode in which state `j` becomes `next[j]`; `parameters` are the boxes of the parameters.
    pub fn new(
        graph: Graph,
        next: Vec<NodeId>,
        states: Vec<Variable>,
        inputs: Vec<Variable>,
        parameters: Vec<Interval>,
    ) -> Self {
        let step = Tape::new(&graph, &next);
        Self { graph, next, states, inputs, parameters, discretisation: None, step }
    }

    /// The same mode, which came from a differential equation in this way.
    pub fn discretised(self, how: Discretisation) -> Self {
        Self { discretisation: Some(how), ..self }
    }

    /// How a differential equation became this mode, if one did.
    pub fn discretisation(&self) -> Option<&Discretisation> {
        self.discretisation.as_ref()
    }

    /// The mode `x⁺ = A x + B u + q`.
    pub fn linear(system: &LinearSystem, states: Vec<Variable>, inputs: Vec<Variable>) -> Self {
        let (n, p) = (system.state_dimension(), system.input_dimension());
        let mut graph = Graph::default();
        let mut next = Vec::with_capacity(n);
        for j in 0..n {
            let mut sum = graph.constant(system.q().get(j, 0).clone());
            let entries = (0..n).map(|k| (k, system.a().get(j, k)));
            for (variable, factor) in entries.chain((0..p).map(|i| (n + i, system.b().get(j, i)))) {
                let (factor, variable) = (graph.constant(factor.clone()), graph.variable(variable as u32));
                let term = graph.multiply(factor, variable);
                sum = graph.add(sum, term);
            }
            next.push(sum);
        }
        Self::new(graph, next, states, inputs, Vec::new())
    }

    /// This mode `times` times with one input (and one value of each parameter), noise added after the last.
    pub fn held(&self, times: u32) -> Self {
        let mut graph = self.graph.clone();
        let mut next = self.next.clone();
        for _ in 1..times {
            let replacements: Vec<_> = next.iter().copied().map(Some).collect();
            next = self.next.iter().map(|&root| graph.substitute(root, &replacements)).collect();
        }
        let held = Self::new(graph, next, self.states.clone(), self.inputs.clone(), self.parameters.clone());
        Self { discretisation: self.discretisation, ..held }
    }

    /// The graph of the expressions.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The next states.
    pub fn next(&self) -> &[NodeId] {
        &self.next
    }

    /// The dimension of the state.
    pub fn num_states(&self) -> usize {
        self.next.len()
    }

    /// The dimension of the input.
    pub fn num_inputs(&self) -> usize {
        self.inputs.len()
    }

    /// The coordinates of the state.
    pub fn states(&self) -> &[Variable] {
        &self.states
    }

    /// The coordinates of the input.
    pub fn inputs(&self) -> &[Variable] {
        &self.inputs
    }

    /// The boxes of the parameters.
    pub fn parameters(&self) -> &[Interval] {
        &self.parameters
    }

    /// `f(x, u, θ)` in doubles: the same on every machine, for functions are correctly rounded and sums have one
    /// order. `scratch` is any vector.
    pub fn step(&self, x: &[f64], u: &[f64], parameters: &[f64], scratch: &mut Vec<f64>, next: &mut [f64]) {
        let variables: Vec<f64> = x.iter().chain(u).chain(parameters).copied().collect();
        self.step.at_point(&variables, scratch, next);
    }

    /// The partial derivatives at a point, in doubles: `A = ∂f/∂x` (`n×n`) and `B = ∂f/∂u` (`n×p`).
    pub fn linearised(&self, x: &[f64], u: &[f64]) -> (nalgebra::DMatrix<f64>, nalgebra::DMatrix<f64>) {
        let (n, p) = (self.num_states(), self.num_inputs());
        let mut graph = self.graph.clone();
        let mut roots = Vec::with_capacity(n * (n + p));
        for &next in &self.next {
            roots.extend((0..(n + p) as u32).map(|variable| graph.derivative(next, variable)));
        }
        let parameters = self.parameters.iter().map(|parameter| parameter.middle());
        let variables: Vec<f64> = x.iter().chain(u).copied().chain(parameters).collect();
        let mut slopes = vec![0.0; roots.len()];
        Tape::new(&graph, &roots).at_point(&variables, &mut Vec::new(), &mut slopes);
        let entry = |j: usize, variable: usize| slopes[j * (n + p) + variable];
        (nalgebra::DMatrix::from_fn(n, n, &entry), nalgebra::DMatrix::from_fn(n, p, |j, i| entry(j, n + i)))
    }

    /// The system `A x + B u + q`, if the mode is one with exact entries.
    pub fn as_linear(&self) -> Option<LinearSystem> {
        let (n, p) = (self.num_states(), self.num_inputs());
        let mut graph = self.graph.clone();
        let forms: Option<Vec<_>> =
            self.next.iter().map(|&next| graph.affine(next, (n + p) as u32)).collect();
        let forms = forms?;
        let rests: Option<Vec<Rational>> =
            forms.iter().map(|form| graph.number(form.rest).cloned()).collect();
        let rests = rests?;
        let slope =
            |j: usize, k: usize| forms[j].slopes.get(&(k as u32)).cloned().unwrap_or_else(Rational::zero);
        Some(LinearSystem::new(
            ExactMatrix::from_fn(n, n, slope),
            ExactMatrix::from_fn(n, p, |j, i| slope(j, n + i)),
            ExactMatrix::from_fn(n, 1, |j, _| rests[j].clone()),
        ))
    }
}
