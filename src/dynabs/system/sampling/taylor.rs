//! One step of a differential equation by a Taylor series whose remainder is bounded.

use crate::system::Interval;
use crate::system::expression::{Graph, NodeId, Tape};
use imdp::numeric::Rational;
use num_traits::One;

/// The flow of `ẋ = f(x, u, θ)` over a time `T`, inputs and parameters held:
/// `x(T) ∈ Σ_{i≤K} hⁱ/i! · L_fⁱ x + R`, in sub-steps of length `h`, with `L_f g = Σ_k ∂g/∂x_k · f_k` and
/// `R ⊇ h^{K+1}/(K+1)! · L_f^{K+1} x` over everything that the flow meets in one sub-step (Moore 1966).
#[derive(Clone, Debug)]
pub struct TaylorStep {
    /// The state after the time, with the remainders as numbers known only by an enclosure.
    pub next: Vec<NodeId>,
    /// The degree `K` of the series.
    pub degree: u32,
    /// The number of sub-steps.
    pub substeps: u32,
    /// The width of the widest remainder of a sub-step.
    pub remainder: f64,
}

/// Why no step was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TaylorError {
    /// The right-hand side has a kink.
    #[error("{name}, which has a kink")]
    Kink {
        /// The function.
        name: &'static str,
        /// Where it is.
        node: NodeId,
    },
    /// Its derivatives have too many terms.
    #[error("a right-hand side whose derivatives have more than {MOST_NODES} operations")]
    TooLong,
    /// No box was found that the flow stays in, or the remainder stays large.
    #[error("a flow whose Taylor series cannot be bounded over a step")]
    NotBounded,
}

/// The degree of the series.
const DEGREE: u32 = 5;
/// Derivatives of more operations than this take too long.
const MOST_NODES: usize = 300_000;
/// The most sub-steps that are tried.
const MOST_SUBSTEPS: u32 = 16;
/// The domain is cut into about this many boxes for bounding the remainder.
const BOXES: u32 = 1024;
/// A remainder is small if it is below this part of the domain's width.
const SMALL: f64 = 1e-4;

impl TaylorError {
    /// Where in the texts it is.
    pub fn place(self, graph: &Graph) -> Option<(&str, u32)> {
        match self {
            Self::Kink { node, .. } => graph.place(node),
            Self::TooLong | Self::NotBounded => None,
        }
    }

    /// What is expected.
    pub fn expected(self) -> &'static str {
        match self {
            Self::Kink { .. } => "a right-hand side with all its derivatives",
            Self::TooLong => "a shorter right-hand side",
            Self::NotBounded => "a shorter sample_time, or more steps that one input is held for",
        }
    }

    /// What to do.
    pub fn remedy(self) -> &'static str {
        match self {
            Self::Kink { .. } => "Replace it by a smooth function, or discretise by hand and give \"next\".",
            Self::TooLong => "Discretise by hand and give \"next\".",
            Self::NotBounded => "Divide sample_time by some number and give that number as \"hold\".",
        }
    }
}

impl TaylorStep {
    /// The flow over `held` times the time `time`, for states, inputs and parameters in `domain` (the variables of
    /// the expressions in their order). The number of sub-steps is the least power of two, per step of length
    /// `time`, for which the remainder is small.
    ///
    /// # Errors
    /// [`TaylorError`] if `rates` have kinks, or no remainder is small.
    pub fn find(
        graph: &mut Graph,
        rates: &[NodeId],
        time: &Rational,
        held: u32,
        domain: &[Interval],
    ) -> Result<Self, TaylorError> {
        if let Some((node, name)) = rates.iter().find_map(|&rate| graph.kink(rate)) {
            return Err(TaylorError::Kink { name, node });
        }
        let lie = lie_derivatives(graph, rates).ok_or(TaylorError::TooLong)?;
        let mut substeps = 1;
        while substeps <= MOST_SUBSTEPS {
            let length = time / Rational::from_integer(substeps.into());
            if let Some(step) = substep_chain(graph, rates, &lie, &length, substeps * held, domain) {
                return Ok(step);
            }
            substeps *= 2;
        }
        Err(TaylorError::NotBounded)
    }
}

/// `L_fⁱ x_j` for `i = 0, …, DEGREE + 1`, by degree, then state.
fn lie_derivatives(graph: &mut Graph, rates: &[NodeId]) -> Option<Vec<Vec<NodeId>>> {
    let states: Vec<NodeId> = (0..rates.len() as u32).map(|k| graph.variable(k)).collect();
    let mut by_degree = vec![states, rates.to_vec()];
    for degree in 1..=DEGREE as usize {
        let of_state = |j: usize, graph: &mut Graph| {
            rates.iter().enumerate().fold(graph.integer(0), |sum, (k, &rate)| {
                let slope = graph.derivative(by_degree[degree][j], k as u32);
                let term = graph.multiply(slope, rate);
                graph.add(sum, term)
            })
        };
        let next = (0..rates.len()).map(|j| of_state(j, graph)).collect();
        by_degree.push(next);
        if graph.len() > MOST_NODES {
            return None;
        }
    }
    Some(by_degree)
}

/// So many sub-steps of this length, if each has a small remainder.
fn substep_chain(
    graph: &mut Graph,
    rates: &[NodeId],
    lie: &[Vec<NodeId>],
    length: &Rational,
    substeps: u32,
    domain: &[Interval],
) -> Option<TaylorStep> {
    let n = rates.len();
    let flow = Tape::new(graph, rates);
    let factors = factors(length);
    let remainder = Tape::new(graph, &lie[DEGREE as usize + 1]);
    let polynomial: Vec<NodeId> = (0..n)
        .map(|j| {
            (0..=DEGREE as usize).fold(graph.integer(0), |sum, i| {
                let factor = graph.constant(factors[i].clone());
                let term = graph.multiply(factor, lie[i][j]);
                graph.add(sum, term)
            })
        })
        .collect();
    let values = Tape::new(graph, &polynomial);
    let last = Interval::of_rational(&factors[DEGREE as usize + 1]);
    let time = Interval::enclosing(&Rational::from_integer(0.into()), length);
    let mut domain = domain.to_vec();
    let mut next: Vec<NodeId> = (0..n as u32).map(|k| graph.variable(k)).collect();
    let mut widest = 0.0f64;
    for _ in 0..substeps {
        let (bounds, reached) = bounds(&domain, n, &flow, time, &remainder, last, &values)?;
        let small = |(bound, side): (&Interval, &Interval)| bound.width() <= SMALL * side.width();
        if !bounds.iter().zip(&domain).all(small) {
            return None;
        }
        widest = bounds.iter().fold(widest, |widest, bound| widest.max(bound.width()));
        let replacements: Vec<_> = next.iter().copied().map(Some).collect();
        next = (0..n)
            .map(|j| {
                let moved = graph.substitute(polynomial[j], &replacements);
                let rest = graph.enclosed(bounds[j]);
                graph.add(moved, rest)
            })
            .collect();
        domain[..n].copy_from_slice(&reached);
    }
    Some(TaylorStep { next, degree: DEGREE, substeps, remainder: widest })
}

/// `hⁱ/i!` for `i = 0, …, DEGREE + 1`.
fn factors(length: &Rational) -> Vec<Rational> {
    let mut factors = vec![Rational::one()];
    for i in 1..=i64::from(DEGREE) + 1 {
        let last = &factors[factors.len() - 1];
        let factor = last * length / Rational::from_integer(i.into());
        factors.push(factor);
    }
    factors
}

/// The remainder of each state over all of `domain`, and a box of the states after the sub-step: the hull over
/// boxes that `domain` is cut into.
fn bounds(
    domain: &[Interval],
    n: usize,
    flow: &Tape,
    time: Interval,
    remainder: &Tape,
    factor: Interval,
    polynomial: &Tape,
) -> Option<(Vec<Interval>, Vec<Interval>)> {
    let parts = (f64::from(BOXES).powf(1.0 / n as f64) as u32).max(1);
    let mut hull: Option<(Vec<Interval>, Vec<Interval>)> = None;
    let (mut slots, mut out) = (Vec::new(), vec![Interval::ZERO; n]);
    for index in 0..parts.checked_pow(n as u32)? {
        let mut part = domain.to_vec();
        let mut rest = index;
        for side in &mut part[..n] {
            *side = slice(*side, rest % parts, parts);
            rest /= parts;
        }
        let start = part.clone();
        stays_in(flow, time, n, &mut part)?;
        remainder.on_box(&part, &mut slots, &mut out);
        let bound: Vec<Interval> = out.iter().map(|&out| factor * out).collect();
        polynomial.on_box(&start, &mut slots, &mut out);
        // The flow also stays in the box that was found for it.
        let reached: Vec<Interval> = (0..n).map(|j| (out[j] + bound[j]).meet(part[j])).collect();
        if !bound.iter().chain(&reached).all(|side| side.is_bounded()) {
            return None;
        }
        hull = Some(match hull {
            None => (bound, reached),
            Some((bounds, all)) => (hulls(&bounds, &bound), hulls(&all, &reached)),
        });
    }
    hull
}

fn hulls(a: &[Interval], b: &[Interval]) -> Vec<Interval> {
    a.iter().zip(b).map(|(a, b)| a.hull(*b)).collect()
}

/// Part `i` of `parts` equal ones, which together cover the interval.
fn slice(whole: Interval, i: u32, parts: u32) -> Interval {
    let at = |i: u32| {
        if i == 0 {
            whole.lower()
        } else if i >= parts {
            whole.upper()
        } else {
            whole.lower() + whole.width() * f64::from(i) / f64::from(parts)
        }
    };
    Interval::new(at(i), at(i + 1))
}

/// Widens the states of `domain` to a box that the flow does not leave within the time: `X + [0, h] f(B) ⊆ B`
/// (Picard and Lindelöf, Moore 1966).
fn stays_in(flow: &Tape, time: Interval, n: usize, domain: &mut [Interval]) -> Option<()> {
    let start = domain[..n].to_vec();
    let (mut slots, mut rates) = (Vec::new(), vec![Interval::ZERO; n]);
    for _ in 0..30 {
        flow.on_box(domain, &mut slots, &mut rates);
        let moved: Vec<Interval> = (0..n).map(|j| start[j] + time * rates[j]).collect();
        if !moved.iter().all(|side| side.is_bounded()) {
            return None;
        }
        if moved.iter().zip(domain.iter()).all(|(moved, side)| side.encloses(*moved)) {
            domain[..n].copy_from_slice(&moved);
            return Some(());
        }
        for (side, moved) in domain.iter_mut().zip(moved) {
            let hull = side.hull(moved);
            let more = Interval::point(0.1 * hull.width() + 1e-12);
            *side = (hull - more).hull(hull + more);
        }
    }
    None
}
