//! Random formulas for tests.

use super::ltl::Ltl;

/// A formula over two propositions, as deep as that, from random numbers.
pub(super) fn formula(numbers: &mut impl Iterator<Item = u32>, depth: u32) -> Ltl {
    let kind = numbers.next().unwrap_or(0) % if depth == 0 { 2 } else { 11 };
    let mut operand = || Box::new(formula(numbers, depth - 1));
    match kind {
        0 => Ltl::Proposition(0),
        1 => Ltl::Proposition(1),
        2 => Ltl::Not(operand()),
        3 => Ltl::And(vec![*operand(), *operand()]),
        4 => Ltl::Or(vec![*operand(), *operand()]),
        5 => Ltl::Next(operand()),
        6 => Ltl::Finally(operand()),
        7 => Ltl::Globally(operand()),
        8 => Ltl::Until(operand(), operand()),
        9 => Ltl::Weak(operand(), operand()),
        _ => Ltl::Release(operand(), operand()),
    }
}

/// The same random numbers for the same seed.
pub(super) fn numbers(mut seed: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        Some((seed >> 40) as u32)
    })
}
