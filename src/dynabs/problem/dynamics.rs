//! The dynamics of one step, and how many steps become one.

use super::values::{matrix, vector};
use crate::Diagnostic;
use crate::linear_algebra::ExactMatrix;
use crate::system::{LinearSystem, TooManyDigits, require_digits, smallest_group};

/// The dynamics of one step.
#[derive(Clone, Debug, PartialEq)]
pub enum Dynamics {
    /// Linear ones.
    Linear(LinearDynamics),
}

/// `x⁺ = A x + B u + q + η` for `n` states and `p` inputs; numbers stand for the shortest decimals of theirs.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearDynamics {
    /// `A`, `n×n`, row by row; not singular.
    pub a: Vec<Vec<f64>>,
    /// `B`, `n×p`, row by row.
    pub b: Vec<Vec<f64>>,
    /// `q`, `n` numbers; 0 if absent.
    pub q: Option<Vec<f64>>,
}

/// How many steps become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GroupSteps {
    /// As few as make the grouped `B` of full row rank and, as far as can be seen beforehand, let actions leave the start and
    /// meet the goal. With a lower layer or samples of grouped steps, which are for one number of steps: the
    /// fewest.
    #[default]
    Auto,
    /// This many.
    Steps(u32),
}

impl From<LinearDynamics> for Dynamics {
    fn from(dynamics: LinearDynamics) -> Self {
        Self::Linear(dynamics)
    }
}

impl LinearDynamics {
    /// The system, if shapes fit; `B` may be empty.
    pub(crate) fn any_system(&self) -> Result<LinearSystem, Diagnostic> {
        let a = matrix("/dynamics/A", &self.a, None, Some(self.a.len()), "A is square")?;
        let n = a.rows();
        let b = match self.b.iter().all(Vec::is_empty) {
            true => ExactMatrix::zeros(n, 0),
            false => matrix("/dynamics/B", &self.b, Some(n), None, "as many as A has")?,
        };
        let q = match &self.q {
            None => ExactMatrix::zeros(n, 1),
            Some(q) => {
                let q = vector("/dynamics/q", q, n, "one per dimension of the state")?;
                ExactMatrix::from_fn(n, 1, |i, _| q[i].clone())
            }
        };
        Ok(LinearSystem::new(a, b, q))
    }

    /// The system, if shapes fit, `A` is regular and `(A, B)` controllable.
    pub(super) fn system(&self) -> Result<LinearSystem, Diagnostic> {
        if self.b.is_empty() {
            return Err(Diagnostic::at(
                "/dynamics/B",
                "no rows",
                format!("{}, as many as A has", self.a.len()),
            ));
        }
        if self.b.iter().all(Vec::is_empty) {
            return Err(Diagnostic::at("/dynamics/B", "no inputs", "at least one, to steer to targets with")
                .remedy("With \"actions\": \"inputs\" a system needs none: leave B and /input out."));
        }
        let system = self.any_system()?;
        let n = system.state_dimension();
        if !system.is_regular() {
            let found = format!("a singular matrix of rank {}", system.a().rank());
            return Err(Diagnostic::at("/dynamics/A", found, format!("a non-singular matrix of rank {n}"))
                .remedy("Remove states that do not depend on the past, or discretise with another step."));
        }
        let rank = system.controllability_rank();
        if rank < n {
            let found = format!("an uncontrollable pair (A, B): [B AB …] has rank {rank}");
            let remedy =
                "Some directions of the state cannot be steered: add inputs or leave those states out.";
            return Err(Diagnostic::at("/dynamics", found, format!("rank {n}, the dimension of the state"))
                .remedy(remedy));
        }
        Ok(system)
    }
}

/// Refuses matrices that cannot be computed with exactly.
pub(super) fn require_short_numbers(system: &LinearSystem, d: usize) -> Result<(), Diagnostic> {
    require_digits(system, d).map_err(|TooManyDigits { digits, steps }| {
        let found = format!("matrices with numbers of up to {digits} digits after {steps} steps");
        Diagnostic::at("/dynamics", found, "numbers that can be computed with exactly")
            .remedy("Write the matrices with fewer digits, or group fewer steps.")
    })
}

/// The number of steps, if the grouped `B` has full row rank with it.
pub(super) fn group_steps(steps: GroupSteps, system: &LinearSystem) -> Result<usize, Diagnostic> {
    let n = system.state_dimension();
    let smallest = smallest_group(system).unwrap_or(n);
    let place = "/dynamics/group_steps";
    match steps {
        GroupSteps::Auto => Ok(smallest),
        GroupSteps::Steps(d) if d == 0 || d > 64 => {
            Err(Diagnostic::at(place, d.to_string(), format!("at most 64; {smallest} would do")))
        }
        GroupSteps::Steps(d) => {
            let rank = system.grouped_rank(d as usize);
            if rank == n {
                return Ok(d as usize);
            }
            let found = format!("{d}, for which the grouped B has rank {rank}");
            Err(Diagnostic::at(place, found, format!("a number of steps that makes its rank {n}"))
                .remedy(format!("Use \"auto\" or {smallest}.")))
        }
    }
}
