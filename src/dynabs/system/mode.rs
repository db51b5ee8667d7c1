//! One way in which a system can move.

use super::expression::{Graph, NodeId, Tape};
use super::{Interval, LinearSystem};
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::Rational;
use num_traits::Zero;

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
    step: Tape,
}

/// A coordinate of the state or of the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// The unit that it is measured in.
    pub unit: Option<String>,
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
        Self { graph, next, states, inputs, parameters, step }
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
        Self::new(graph, next, self.states.clone(), self.inputs.clone(), self.parameters.clone())
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
