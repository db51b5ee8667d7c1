//! The image in one coordinate that is not affine: an enclosure of an expression over a box.

use super::lattice::{LatticeAxis, LatticeRange};
use crate::system::Interval;
use crate::system::expression::{Graph, NodeId, Tape};

/// An expression over a box of its variables, with its partial derivatives.
#[derive(Clone, Debug)]
pub(super) struct Enclosure {
    /// The value alone.
    value: Tape,
    /// The value and the derivatives in the directions, in this order.
    with_derivatives: Tape,
    /// The variables along which the box extends.
    directions: Vec<Direction>,
}

/// One variable of the box, and what moves with it.
#[derive(Clone, Debug)]
pub(super) struct Direction {
    /// The number of the variable.
    pub(super) variable: u32,
    /// The other variables that are functions of it: `v = … − gain · (x − center)`.
    pub(super) followers: Vec<Follower>,
}

/// An input that local feedback makes a function of the state.
#[derive(Clone, Debug)]
pub(super) struct Follower {
    /// The number of the input's variable.
    pub(super) variable: u32,
    /// The entry of `K`.
    pub(super) gain: Interval,
    /// The same as a node, for derivatives.
    pub(super) gain_node: NodeId,
}

/// Where an expression is not defined.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Undefined {
    /// The operation.
    pub(super) node: NodeId,
    /// What its last operand can be.
    pub(super) operand: Interval,
}

/// A box of all variables, the nominal values that followers start from, and the center they refer to.
#[derive(Clone, Debug)]
pub(super) struct VariableBox {
    /// Per variable; entries of followers are ignored.
    pub(super) values: Vec<Interval>,
    /// Per variable: the nominal value of a follower.
    pub(super) nominal: Vec<Interval>,
    /// Per variable: the center of the cell.
    pub(super) centers: Vec<Interval>,
}

/// Scratch space of one thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    slots: Vec<Interval>,
    variables: Vec<Interval>,
    points: Vec<f64>,
    point_slots: Vec<f64>,
    outputs: Vec<Interval>,
}

/// A cell is cut into at most `2⁵` parts: beyond that, a finer partition helps more.
const MAX_CUTS: u32 = 5;

impl Enclosure {
    /// The expression `root` with the given directions.
    pub(super) fn new(graph: &mut Graph, root: NodeId, directions: Vec<Direction>) -> Self {
        let mut roots = vec![root];
        for direction in &directions {
            let mut slope = graph.derivative(root, direction.variable);
            for follower in &direction.followers {
                let by_input = graph.derivative(root, follower.variable);
                let change = graph.multiply(follower.gain_node, by_input);
                slope = graph.subtract(slope, change);
            }
            roots.push(slope);
        }
        Self { value: Tape::new(graph, &[root]), with_derivatives: Tape::new(graph, &roots), directions }
    }

    /// The sub-cells that the values over `domain` meet.
    ///
    /// # Errors
    /// [`Undefined`] if the expression may be undefined or unbounded in `domain`.
    pub(super) fn range(
        &self,
        graph: &Graph,
        domain: &VariableBox,
        axis: &LatticeAxis,
        scratch: &mut Scratch,
    ) -> Result<LatticeRange, Undefined> {
        let reached = self.reached(domain, scratch).map(|reached| axis.range(reached));
        self.cut(graph, &mut domain.clone(), axis, reached, MAX_CUTS, scratch)
    }

    /// An enclosure of the values, cut into parts where that can take away sub-cells that no value reaches.
    fn cut(
        &self,
        graph: &Graph,
        domain: &mut VariableBox,
        axis: &LatticeAxis,
        reached: Option<LatticeRange>,
        cuts: u32,
        scratch: &mut Scratch,
    ) -> Result<LatticeRange, Undefined> {
        let (enclosure, widest) = self.on_box(domain, scratch);
        let range = axis.range(enclosure);
        if enclosure.is_bounded() && (cuts == 0 || reached.is_some_and(|reached| reached.encloses(range))) {
            return Ok(range);
        }
        let Some(widest) = widest.filter(|_| cuts > 0) else {
            return match self.undefined(graph, domain, scratch) {
                None if enclosure.is_bounded() => Ok(range),
                None => Ok(LatticeRange::EVERYTHING),
                Some(undefined) => Err(undefined),
            };
        };
        let whole = domain.values[widest];
        let middle = whole.middle();
        domain.values[widest] = Interval::new(whole.lower(), middle);
        let left = self.cut(graph, domain, axis, reached, cuts - 1, scratch)?;
        domain.values[widest] = Interval::new(middle, whole.upper());
        let right = self.cut(graph, domain, axis, reached, cuts - 1, scratch)?;
        domain.values[widest] = whole;
        // What the parts reach can still not exceed what is known of the whole.
        let hull = LatticeRange::new(left.first.min(right.first), left.last.max(right.last));
        Ok(LatticeRange::new(hull.first.max(range.first), hull.last.min(range.last)))
    }

    /// The natural extension, the mean-value form and monotonicity, intersected; and the variable along which
    /// the value varies most without being monotone.
    fn on_box(&self, domain: &VariableBox, scratch: &mut Scratch) -> (Interval, Option<usize>) {
        let count = self.directions.len();
        let mut outputs = std::mem::take(&mut scratch.outputs);
        outputs.clear();
        outputs.resize(count + 1, Interval::EVERYTHING);
        self.fill(domain, &mut scratch.variables);
        self.with_derivatives.on_box(&scratch.variables, &mut scratch.slots, &mut outputs);
        let (natural, slopes) = (outputs[0], &outputs[1..]);
        let enclosure = if natural.is_bounded() {
            natural
                .meet(self.mean_value(domain, slopes, scratch))
                .meet(self.at_corner(domain, slopes, false, scratch))
                .meet(self.at_corner(domain, slopes, true, scratch))
        } else {
            natural
        };
        let widest = (0..count)
            .map(|i| {
                let variable = self.directions[i].variable as usize;
                let extent = domain.values[variable].width();
                let steepness = slopes[i].lower().abs().max(slopes[i].upper().abs());
                // Unbounded slopes come first; along a point there is nothing to cut.
                (if extent > 0.0 { (steepness * extent).min(f64::MAX) } else { -1.0 }, variable)
            })
            .filter(|(variation, _)| *variation > 0.0 || !natural.is_bounded() && *variation >= 0.0)
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
            .map(|(_, variable)| variable);
        scratch.outputs = outputs;
        (enclosure, widest)
    }

    /// `f(c) + Σ_k D_k (v_k − c_k)` with `D_k ⊇ ∂f/∂v_k` over the box.
    fn mean_value(&self, domain: &VariableBox, slopes: &[Interval], scratch: &mut Scratch) -> Interval {
        let mut center = domain.clone();
        let mut spread = Interval::ZERO;
        for (direction, &slope) in self.directions.iter().zip(slopes) {
            let variable = direction.variable as usize;
            let middle = Interval::point(domain.values[variable].middle());
            center.values[variable] = middle;
            spread = spread + slope * (domain.values[variable] - middle);
        }
        if !spread.is_bounded() {
            return Interval::EVERYTHING;
        }
        self.value_on(&center, scratch) + spread
    }

    /// Where the sign of a slope is known, only one end of that variable matters for the greatest (`upper`) or
    /// least value; the other variables are bounded over what remains by the natural extension and the
    /// mean-value form. The result is an enclosure on one side only.
    fn at_corner(
        &self,
        domain: &VariableBox,
        slopes: &[Interval],
        upper: bool,
        scratch: &mut Scratch,
    ) -> Interval {
        let mut corner = domain.clone();
        let mut remaining = Vec::with_capacity(slopes.len());
        for (direction, &slope) in self.directions.iter().zip(slopes) {
            let value = &mut corner.values[direction.variable as usize];
            if slope.lower() >= 0.0 || slope.upper() <= 0.0 {
                *value = if (slope.lower() >= 0.0) == upper { value.upper_end() } else { value.lower_end() };
                remaining.push(Interval::ZERO);
            } else {
                remaining.push(slope);
            }
        }
        let natural = self.value_on(&corner, scratch);
        let bound = natural.meet(self.mean_value(&corner, &remaining, scratch));
        if upper {
            Interval::new(f64::NEG_INFINITY, bound.upper())
        } else {
            Interval::new(bound.lower(), f64::INFINITY)
        }
    }

    fn value_on(&self, domain: &VariableBox, scratch: &mut Scratch) -> Interval {
        let mut out = [Interval::EVERYTHING];
        self.fill(domain, &mut scratch.variables);
        self.value.on_box(&scratch.variables, &mut scratch.slots, &mut out);
        out[0]
    }

    /// The variables over a box, followers included.
    fn fill(&self, domain: &VariableBox, variables: &mut Vec<Interval>) {
        variables.clear();
        variables.extend_from_slice(&domain.values);
        let followers = || self.directions.iter().flat_map(|d| d.followers.iter().map(move |f| (d, f)));
        for (_, follower) in followers() {
            variables[follower.variable as usize] = domain.nominal[follower.variable as usize];
        }
        for (direction, follower) in followers() {
            let k = direction.variable as usize;
            let change = follower.gain * (domain.values[k] - domain.centers[k]);
            let input = &mut variables[follower.variable as usize];
            *input = *input - change;
        }
    }

    /// The hull of the values at the middle and at two opposite corners, those that the slopes there point to:
    /// in doubles, for it only decides what is worth cutting.
    fn reached(&self, domain: &VariableBox, scratch: &mut Scratch) -> Option<Interval> {
        let mut outputs = vec![0.0; self.directions.len() + 1];
        let mut point = domain.clone();
        for direction in &self.directions {
            let value = &mut point.values[direction.variable as usize];
            *value = Interval::point(value.middle());
        }
        let at = |point: &VariableBox, outputs: &mut [f64], scratch: &mut Scratch| {
            self.fill(point, &mut scratch.variables);
            scratch.points.clear();
            scratch.points.extend(scratch.variables.iter().map(|v| v.middle()));
            self.with_derivatives.at_point(&scratch.points, &mut scratch.point_slots, outputs);
            outputs[0]
        };
        let mut hull = Interval::point(at(&point, &mut outputs, scratch));
        let slopes = outputs[1..].to_vec();
        for upper in [false, true] {
            for (direction, slope) in self.directions.iter().zip(&slopes) {
                let k = direction.variable as usize;
                let whole = domain.values[k];
                let end = if (*slope >= 0.0) == upper { whole.upper() } else { whole.lower() };
                point.values[k] = Interval::point(end);
            }
            hull = hull.hull(Interval::point(at(&point, &mut outputs, scratch)));
        }
        hull.is_bounded().then_some(hull)
    }

    fn undefined(&self, graph: &Graph, domain: &VariableBox, scratch: &mut Scratch) -> Option<Undefined> {
        self.value_on(domain, scratch);
        let (node, operand) = self.value.undefined(graph, &scratch.slots)?;
        Some(Undefined { node, operand })
    }

    /// The variables along which the box extends.
    pub(super) fn directions(&self) -> &[Direction] {
        &self.directions
    }
}
