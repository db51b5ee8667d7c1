//! Who maximises and who minimises.

use std::fmt;

/// How the two nondeterminisms of an interval MDP are resolved: policy first, then nature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

impl Resolution {
    /// All four.
    pub const ALL: [Self; 4] = [Self::Pmaxmin, Self::Pmaxmax, Self::Pminmin, Self::Pminmax];

    /// The resolution of the complementary event: both players change direction.
    ///
    /// `Pmaxmin[φ] = 1 − Pminmax[¬φ]`, and so on for the other three.
    pub fn flipped(self) -> Self {
        match self {
            Self::Pmaxmin => Self::Pminmax,
            Self::Pminmax => Self::Pmaxmin,
            Self::Pmaxmax => Self::Pminmin,
            Self::Pminmin => Self::Pmaxmax,
        }
    }

    /// Whether the policy maximises.
    pub fn policy_maximises(self) -> bool {
        matches!(self, Self::Pmaxmin | Self::Pmaxmax)
    }

    /// Whether nature maximises.
    pub fn nature_maximises(self) -> bool {
        matches!(self, Self::Pmaxmax | Self::Pminmax)
    }
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

/// What nature does where a property names only the policy's direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// It works against the policy, as Storm reads `Pmax`.
    Robust,
    /// It works with the policy, as PRISM reads `Pmax`.
    Cooperative,
}

/// The optimum that a property names, before it is known whether its model has a policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimum {
    /// `Pmaxmin`, `Pmaxmax`, `Pminmin` or `Pminmax`: for interval MDPs.
    Both(Resolution),
    /// `Pmin`: nature minimises, for interval DTMCs.
    Min,
    /// `Pmax`: nature maximises, for interval DTMCs.
    Max,
    /// `P`: for models in which nobody has anything to choose.
    Only,
}

impl Optimum {
    /// The optimum called `P<suffix>`.
    pub(super) fn from_suffix(suffix: &str) -> Option<Self> {
        Some(match suffix {
            "min" => Self::Min,
            "max" => Self::Max,
            "maxmin" => Self::Both(Resolution::Pmaxmin),
            "maxmax" => Self::Both(Resolution::Pmaxmax),
            "minmin" => Self::Both(Resolution::Pminmin),
            "minmax" => Self::Both(Resolution::Pminmax),
            _ => return None,
        })
    }
}

impl fmt::Display for Optimum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Both(resolution) => resolution.fmt(f),
            Self::Min => f.write_str("Pmin"),
            Self::Max => f.write_str("Pmax"),
            Self::Only => f.write_str("P"),
        }
    }
}
