//! The syntax tree of a property, and its printing.

use std::fmt;

/// How the two nondeterminisms of an interval MDP are resolved: policy first, then nature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resolution {
    /// The policy maximises, nature minimises: the robust value.
    Pmaxmin,
    /// Both maximise.
    Pmaxmax,
    /// Both minimise.
    Pminmin,
    /// The policy minimises, nature maximises.
    Pminmax,
}

/// A formula that holds in a state or does not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StateFormula {
    /// Holds everywhere.
    True,
    /// Holds where the label does.
    Label(String),
    /// Holds where the operand does not.
    Not(Box<StateFormula>),
}

/// A formula that holds along a path or does not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PathFormula {
    /// `left U right`, or `left U<=k right` within `k` steps.
    Until {
        /// What must hold on the way.
        left: StateFormula,
        /// What must be reached.
        right: StateFormula,
        /// The number of steps, if bounded.
        steps: Option<u64>,
    },
}

/// What is asked about a path formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Objective {
    /// Who maximises and who minimises.
    pub resolution: Resolution,
    /// The event whose probability is meant.
    pub path: PathFormula,
}

/// A value that is asked for, or compared with a threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct Property {
    /// The value.
    pub objective: Objective,
    /// `Some(ρ)` asks whether the value is at least `ρ`.
    pub at_least: Option<f64>,
}

impl fmt::Display for Resolution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Pmaxmin => "Pmaxmin",
            Self::Pmaxmax => "Pmaxmax",
            Self::Pminmin => "Pminmin",
            Self::Pminmax => "Pminmax",
        })
    }
}

impl fmt::Display for StateFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::True => f.write_str("true"),
            Self::Label(name) => write!(f, "\"{name}\""),
            Self::Not(operand) => write!(f, "!{operand}"),
        }
    }
}

impl fmt::Display for PathFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Until { left, right, steps } = self;
        let bound = steps.map(|k| format!("<={k}")).unwrap_or_default();
        match left {
            StateFormula::True => write!(f, "F{bound} {right}"),
            left => write!(f, "{left} U{bound} {right}"),
        }
    }
}

impl fmt::Display for Property {
    /// PRISM has no `Pmaxmin>=ρ`, and its `P>=ρ` means `Pminmin`: a threshold becomes `(Pmaxmin=? […])>=ρ`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let query = format!("{}=? [ {} ]", self.objective.resolution, self.objective.path);
        match self.at_least {
            None => f.write_str(&query),
            Some(threshold) => write!(f, "({query})>={}", crate::numeric::shortest_decimal(threshold)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn properties_print_as_prism_reads_them() {
        let label = |name: &str| StateFormula::Label(name.into());
        let path = PathFormula::Until {
            left: StateFormula::Not(Box::new(label("failed"))),
            right: label("reached"),
            steps: Some(8),
        };
        let objective = Objective { resolution: Resolution::Pmaxmin, path };
        let property = Property { objective: objective.clone(), at_least: None };
        assert_eq!(property.to_string(), "Pmaxmin=? [ !\"failed\" U<=8 \"reached\" ]");
        let property = Property { objective, at_least: Some(0.5) };
        assert_eq!(property.to_string(), "(Pmaxmin=? [ !\"failed\" U<=8 \"reached\" ])>=0.5");
    }
}
