//! What steps cost.

use crate::Diagnostic;
use crate::system::expression::{Graph, Scope, Tape, parse};
use crate::system::{Interval, Variable};

/// What a step costs, not yet checked.
#[derive(Clone, Debug, PartialEq)]
pub struct CostParts {
    /// What it is called in properties.
    pub name: String,
    /// The cost of a step from state x with input u, an expression in both; it counts as 0 where it is negative.
    pub step: String,
    /// What a step costs at most when the task has failed; as much as any other step if absent.
    pub outside: Option<f64>,
    /// What the next step's cost is worth today; 1 if absent.
    pub discount: Option<f64>,
}

/// What a step costs.
#[derive(Clone, Debug)]
pub struct Cost {
    name: String,
    tape: Tape,
    outside: Option<f64>,
    discount: Option<f64>,
}

/// Costs come with the least that they can be, under a name of its own, which no other cost may have.
pub(super) fn require_apart(costs: &[Cost]) -> Result<(), Diagnostic> {
    let least = |other: &Cost| format!("{}_least", other.name);
    match costs.iter().find(|cost| costs.iter().any(|other| cost.name == least(other))) {
        None => Ok(()),
        Some(cost) => {
            let found = "the name under which the model has the least of another cost";
            Err(Diagnostic::at(format!("/costs/{}", cost.name), found, "another name"))
        }
    }
}

impl CostParts {
    /// Checks the parts: an expression in these coordinates of state and input.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub(super) fn cost(&self, coordinates: [&[Variable]; 2]) -> Result<Cost, Diagnostic> {
        let place = format!("/costs/{}", self.name);
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if !self.name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            || !self.name.chars().all(is_word)
        {
            let expected = "a name of letters, digits and _, which does not begin with a digit";
            return Err(Diagnostic::at(place, "another name", expected));
        }
        let (mut graph, mut scope) = (Graph::default(), Scope::default());
        for (number, variable) in (0..).zip(coordinates.into_iter().flatten()) {
            let node = graph.variable(number);
            scope.insert(&variable.name, node).map_err(|error| {
                Diagnostic::at(&place, error.to_string(), "names of states and inputs that differ")
            })?;
        }
        let text = format!("{place}/step");
        let root = parse(&mut graph, &scope, &self.step, &text).map_err(|error| {
            let diagnostic =
                Diagnostic::at(format!("{text} (column {})", error.column), error.found, error.expected);
            match error.remedy {
                Some(remedy) => diagnostic.remedy(remedy),
                None => diagnostic,
            }
        })?;
        if let Some(outside) = self.outside.filter(|x| !(0.0..f64::INFINITY).contains(x)) {
            let expected = "a number of at least 0";
            return Err(Diagnostic::at(format!("{place}/outside"), outside.to_string(), expected));
        }
        if let Some(discount) = self.discount.filter(|x| !(0.0..1.0).contains(x)) {
            let expected = "a factor of at least 0 and below 1";
            return Err(Diagnostic::at(format!("{place}/discount"), discount.to_string(), expected));
        }
        let tape = Tape::new(&graph, &[root]);
        Ok(Cost { name: self.name.clone(), tape, outside: self.outside, discount: self.discount })
    }
}

impl Cost {
    /// What it is called in properties.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What a step costs at most when the task has failed, if that was said.
    pub fn outside(&self) -> Option<f64> {
        self.outside
    }

    /// What the next step's cost is worth today, if less than now.
    pub fn discount(&self) -> Option<f64> {
        self.discount
    }

    /// The least and the greatest cost over a box of states and inputs, both at least 0; perhaps infinite.
    pub fn range(&self, variables: &[Interval], scratch: &mut Vec<Interval>) -> (f64, f64) {
        let mut found = [Interval::point(0.0)];
        self.tape.on_box(variables, scratch, &mut found);
        let [range] = found;
        match range.is_bounded() {
            true => (range.lower().max(0.0), range.upper().max(0.0)),
            false => (0.0, f64::INFINITY),
        }
    }
}
