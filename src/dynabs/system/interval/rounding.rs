//! One operation of doubles, rounded down; up is its mirror image.
//!
//! Whether the nearest double lies above the exact result is decided by its error, which is itself computed
//! without error (Dekker 1971; Handbook of Floating-Point Arithmetic, 4.3–4.7). So exact results stay exact,
//! and others are the directed roundings that hardware would give.

/// Below this, errors of products may be too small for a double.
const ERROR_IS_EXACT_FROM: f64 = f64::MIN_POSITIVE * 4.503_599_627_370_496e15 * 4.0;

/// The largest double at most `a + b`.
pub(super) fn add_down(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if !sum.is_finite() {
        return overflow_down(sum, a.is_finite() && b.is_finite());
    }
    let b_part = sum - a;
    let error = (a - (sum - b_part)) + (b - b_part);
    // Intermediate results that overflow make the error NaN: then a step down is always enough.
    if error >= 0.0 { sum } else { sum.next_down() }
}

/// The smallest double at least `a + b`.
pub(super) fn add_up(a: f64, b: f64) -> f64 {
    -add_down(-a, -b)
}

/// The largest double at most `a · b`, where an infinite factor stands for arbitrarily large ones: `0 · ∞ = 0`.
pub(super) fn mul_down(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    let product = a * b;
    if !product.is_finite() {
        return overflow_down(product, a.is_finite() && b.is_finite());
    }
    if product.abs() < ERROR_IS_EXACT_FROM {
        return product.next_down();
    }
    if a.mul_add(b, -product) >= 0.0 { product } else { product.next_down() }
}

/// The smallest double at least `a · b`, with `0 · ∞ = 0`.
pub(super) fn mul_up(a: f64, b: f64) -> f64 {
    -mul_down(-a, b)
}

/// The largest double at most `a / b`, for `b ≠ 0`; `∞` in the denominator stands for arbitrarily large ones.
pub(super) fn div_down(a: f64, b: f64) -> f64 {
    if a == 0.0 {
        return 0.0;
    }
    let quotient = a / b;
    if quotient.is_nan() {
        return f64::NEG_INFINITY;
    }
    if !quotient.is_finite() {
        return overflow_down(quotient, a.is_finite());
    }
    if b.is_infinite() {
        // The quotients tend to 0; those by the other end of the denominator bound them on the other side.
        return 0.0;
    }
    if a.abs() < ERROR_IS_EXACT_FROM || quotient.abs() < ERROR_IS_EXACT_FROM {
        return quotient.next_down();
    }
    // a − q·b has the sign of (a/b − q)·b.
    let rest = (-quotient).mul_add(b, a);
    let at_most = rest == 0.0 || (rest > 0.0) == (b > 0.0);
    if at_most { quotient } else { quotient.next_down() }
}

/// The smallest double at least `a / b`, for `b ≠ 0`.
pub(super) fn div_up(a: f64, b: f64) -> f64 {
    -div_down(-a, b)
}

/// The largest double at most `√a`, for `a ≥ 0`.
pub(super) fn sqrt_down(a: f64) -> f64 {
    let root = a.sqrt();
    if a == 0.0 || a.is_infinite() {
        return root;
    }
    if a < ERROR_IS_EXACT_FROM {
        return root.next_down();
    }
    if (-root).mul_add(root, a) >= 0.0 { root } else { root.next_down() }
}

/// The smallest double at least `√a`, for `a ≥ 0`.
pub(super) fn sqrt_up(a: f64) -> f64 {
    let root = a.sqrt();
    if a == 0.0 || a.is_infinite() {
        return root;
    }
    if a < ERROR_IS_EXACT_FROM {
        return root.next_up();
    }
    if (-root).mul_add(root, a) <= 0.0 { root } else { root.next_up() }
}

/// The largest double at most `aⁿ`, for `a ≥ 0`.
pub(super) fn power_down(a: f64, n: u32) -> f64 {
    power(a, n, mul_down)
}

/// The smallest double at least `aⁿ`, for `a ≥ 0`.
pub(super) fn power_up(a: f64, n: u32) -> f64 {
    power(a, n, mul_up)
}

/// Repeated squaring; every factor is non-negative, so directed roundings add up in one direction.
fn power(a: f64, mut n: u32, product: fn(f64, f64) -> f64) -> f64 {
    let (mut result, mut square) = (1.0, a);
    while n > 0 {
        if n % 2 == 1 {
            result = product(result, square).max(0.0);
        }
        n /= 2;
        if n > 0 {
            square = product(square, square).max(0.0);
        }
    }
    result
}

/// What an operation with a result beyond all doubles is rounded down to.
fn overflow_down(result: f64, operands_are_finite: bool) -> f64 {
    match (result.is_nan(), result > 0.0, operands_are_finite) {
        (true, ..) => f64::NEG_INFINITY,
        (false, true, true) => f64::MAX,
        (false, ..) => result,
    }
}
