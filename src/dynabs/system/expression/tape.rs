//! Several expressions as one straight-line program.

use super::graph::{Function, Graph, Node, NodeId};
use super::number::Number;
use crate::system::Interval;
use imdp::numeric::to_f64;

/// One step of a program: it computes the slot with its own position from earlier ones.
#[derive(Clone, Copy, Debug)]
enum Instruction {
    /// A number: its double and its enclosure.
    Constant(f64, Interval),
    Variable(u32),
    Negate(u32),
    Add(u32, u32),
    Subtract(u32, u32),
    Multiply(u32, u32),
    Divide(u32, u32),
    Power(u32, i32),
    PowerReal(u32, u32),
    Min(u32, u32),
    Max(u32, u32),
    Select(u32, u32, u32),
    Call(Function, u32),
}

/// Expressions in a form that is quickly evaluated, on doubles or on intervals.
///
/// Parts without variables are evaluated when the tape is made.
#[derive(Clone, Debug)]
pub struct Tape {
    instructions: Vec<Instruction>,
    outputs: Vec<u32>,
    /// The node that each slot computes.
    nodes: Vec<NodeId>,
}

impl Tape {
    /// The program that computes `roots`, in this order.
    pub fn new(graph: &Graph, roots: &[NodeId]) -> Self {
        let last = roots.iter().map(|root| root.index() + 1).max().unwrap_or(0);
        let mut slots: Vec<Option<u32>> = vec![None; last];
        let mut tape = Self { instructions: Vec::new(), outputs: Vec::new(), nodes: Vec::new() };
        for &root in roots {
            for id in graph.below(root) {
                if slots[id.index()].is_none() {
                    slots[id.index()] = Some(tape.nodes.len() as u32);
                    let slot = |a: NodeId| slots[a.index()].unwrap_or_default();
                    tape.push(graph, id, slot);
                }
            }
            tape.outputs.extend(slots[root.index()]);
        }
        tape
    }

    fn push(&mut self, graph: &Graph, id: NodeId, slot: impl Fn(NodeId) -> u32) {
        let instruction = match *graph.node(id) {
            Node::Constant(ref value) => Instruction::Constant(to_f64(value), Interval::of_rational(value)),
            Node::Pi => Instruction::Constant(std::f64::consts::PI, Interval::PI),
            Node::Enclosed(number) => {
                let enclosure = graph.enclosure(number);
                Instruction::Constant(enclosure.middle(), enclosure)
            }
            Node::Variable(number) => Instruction::Variable(number),
            Node::Negate(a) => Instruction::Negate(slot(a)),
            Node::Add(a, b) => Instruction::Add(slot(a), slot(b)),
            Node::Subtract(a, b) => Instruction::Subtract(slot(a), slot(b)),
            Node::Multiply(a, b) => Instruction::Multiply(slot(a), slot(b)),
            Node::Divide(a, b) => Instruction::Divide(slot(a), slot(b)),
            Node::Power(a, n) => Instruction::Power(slot(a), n),
            Node::PowerReal(a, b) => Instruction::PowerReal(slot(a), slot(b)),
            Node::Min(a, b) => Instruction::Min(slot(a), slot(b)),
            Node::Max(a, b) => Instruction::Max(slot(a), slot(b)),
            Node::Select(a, b, c) => Instruction::Select(slot(a), slot(b), slot(c)),
            Node::Call(function, a) => Instruction::Call(function, slot(a)),
        };
        let constant = !matches!(instruction, Instruction::Variable(_))
            && graph.operands(id).into_iter().flatten().all(|a| self.is_constant(slot(a)));
        let folded = constant.then(|| self.folded(instruction)).flatten();
        self.instructions.push(folded.unwrap_or(instruction));
        self.nodes.push(id);
    }

    fn is_constant(&self, slot: u32) -> bool {
        matches!(self.instructions[slot as usize], Instruction::Constant(..))
    }

    /// The value of an operation on constants; none if it is undefined, so that an evaluation can say where.
    fn folded(&self, instruction: Instruction) -> Option<Instruction> {
        let double = run(instruction, &|slot: u32| self.slot(slot), &[]);
        let enclosure: Interval = run(instruction, &|slot: u32| self.slot(slot), &[]);
        enclosure.is_bounded().then_some(Instruction::Constant(double, enclosure))
    }

    /// The value of a slot that needs no variables.
    fn slot<N: Number>(&self, slot: u32) -> N {
        run(self.instructions[slot as usize], &|slot: u32| self.slot(slot), &[])
    }

    /// The values at a point, in doubles, in one fixed order of operations.
    ///
    /// `slots` is scratch space.
    pub fn at_point(&self, variables: &[f64], slots: &mut Vec<f64>, out: &mut [f64]) {
        self.evaluate(variables, slots, out);
    }

    /// Enclosures of the values over a box.
    ///
    /// `slots` is scratch space; afterwards [`undefined`](Self::undefined) can say what went wrong in it.
    pub fn on_box(&self, variables: &[Interval], slots: &mut Vec<Interval>, out: &mut [Interval]) {
        self.evaluate(variables, slots, out);
    }

    fn evaluate<N: Number>(&self, variables: &[N], slots: &mut Vec<N>, out: &mut [N]) {
        slots.clear();
        for &instruction in &self.instructions {
            let value = run(instruction, &|slot: u32| slots[slot as usize], variables);
            slots.push(value);
        }
        for (out, &slot) in out.iter_mut().zip(&self.outputs) {
            *out = slots[slot as usize];
        }
    }

    /// After an evaluation on a box: the first operation whose result is unbounded although its operands are
    /// bounded, and the enclosure of its last operand.
    pub fn undefined(&self, graph: &Graph, slots: &[Interval]) -> Option<(NodeId, Interval)> {
        let of = |id: NodeId| {
            let slot = self.nodes.iter().position(|own| *own == id)?;
            slots.get(slot).copied()
        };
        self.nodes.iter().zip(slots).find_map(|(&id, value)| {
            let mut operands = graph.operands(id).into_iter().flatten().filter_map(of);
            let last = operands.clone().next_back()?;
            (!value.is_bounded() && operands.all(Interval::is_bounded)).then_some((id, last))
        })
    }

    /// The numbers of the variables that occur, ascending.
    pub fn variables(&self) -> Vec<u32> {
        let number = |instruction: &Instruction| match instruction {
            Instruction::Variable(number) => Some(*number),
            _ => None,
        };
        let mut variables: Vec<u32> = self.instructions.iter().filter_map(number).collect();
        variables.sort_unstable();
        variables
    }
}

/// The value of one instruction.
fn run<N: Number>(instruction: Instruction, slot: &impl Fn(u32) -> N, variables: &[N]) -> N {
    match instruction {
        Instruction::Constant(nearest, enclosure) => N::constant(nearest, enclosure),
        Instruction::Variable(number) => variables[number as usize],
        Instruction::Negate(a) => -slot(a),
        Instruction::Add(a, b) => slot(a) + slot(b),
        Instruction::Subtract(a, b) => slot(a) - slot(b),
        Instruction::Multiply(a, b) => slot(a) * slot(b),
        Instruction::Divide(a, b) => slot(a) / slot(b),
        Instruction::Power(a, n) => slot(a).power(n),
        Instruction::PowerReal(a, b) => slot(a).power_real(slot(b)),
        Instruction::Min(a, b) => slot(a).min(slot(b)),
        Instruction::Max(a, b) => slot(a).max(slot(b)),
        Instruction::Select(a, b, c) => slot(a).select(slot(b), slot(c)),
        Instruction::Call(function, a) => slot(a).call(function),
    }
}
