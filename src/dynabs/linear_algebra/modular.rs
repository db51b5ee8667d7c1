//! Ranks by arithmetic modulo primes: fast, whatever the size of the numbers.

use super::ExactMatrix;
use imdp::numeric::Rational;
use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive};

/// Primes of about 60 bits. No decimal has one of them in its denominator.
const PRIMES: [u64; 3] = [(1 << 61) - 1, (1 << 62) - 57, (1 << 59) - 55];

/// A matrix modulo a prime.
#[derive(Clone, Debug)]
struct Modular {
    prime: u64,
    rows: usize,
    columns: usize,
    entries: Vec<u64>,
}

/// The rank of `M`.
///
/// Never more than the rank over the rationals, for a minor that is not 0 modulo a prime is not 0; less only if all of
/// three primes of 60 bits divide every minor of that size, which no matrix does by accident.
pub fn rank(matrix: &ExactMatrix) -> usize {
    let of = |&prime: &u64| Some(Modular::new(matrix, prime)?.rank());
    PRIMES.iter().filter_map(of).max().unwrap_or(0)
}

/// The rank of `[B AB … Aᵈ⁻¹B]`, understood as [`rank`].
pub fn krylov_rank(a: &ExactMatrix, b: &ExactMatrix, d: usize) -> usize {
    let of = |&prime: &u64| {
        let (a, mut power) = (Modular::new(a, prime)?, Modular::new(b, prime)?);
        let mut blocks = power.clone();
        for _ in 1..d {
            power = a.times(&power);
            blocks = blocks.beside(&power);
        }
        Some(blocks.rank())
    };
    PRIMES.iter().filter_map(of).max().unwrap_or(0)
}

impl ExactMatrix {
    /// The rank, in the sense of [`rank`].
    pub fn rank(&self) -> usize {
        rank(self)
    }
}

impl Modular {
    /// `None` if the prime divides a denominator.
    fn new(matrix: &ExactMatrix, prime: u64) -> Option<Self> {
        let entries = matrix.entries().iter().map(|entry| residue(entry, prime)).collect::<Option<_>>()?;
        Some(Self { prime, rows: matrix.rows(), columns: matrix.columns(), entries })
    }

    fn get(&self, i: usize, j: usize) -> u64 {
        self.entries[i * self.columns + j]
    }

    fn times(&self, other: &Self) -> Self {
        let entry = |at: usize| {
            let (i, j) = (at / other.columns, at % other.columns);
            (0..self.columns).fold(0, |sum, k| {
                let product = times(self.get(i, k), other.get(k, j), self.prime);
                plus(sum, product, self.prime)
            })
        };
        let entries = (0..self.rows * other.columns).map(entry).collect();
        Self { prime: self.prime, rows: self.rows, columns: other.columns, entries }
    }

    fn beside(&self, other: &Self) -> Self {
        let row = |i: usize| {
            let part = |matrix: &Self| matrix.entries[i * matrix.columns..(i + 1) * matrix.columns].to_vec();
            [part(self), part(other)].concat()
        };
        let entries = (0..self.rows).flat_map(row).collect();
        Self { prime: self.prime, rows: self.rows, columns: self.columns + other.columns, entries }
    }

    fn rank(mut self) -> usize {
        let mut rank = 0;
        for column in 0..self.columns {
            let Some(pivot) = (rank..self.rows).find(|&i| self.get(i, column) != 0) else { continue };
            for j in 0..self.columns {
                self.entries.swap(rank * self.columns + j, pivot * self.columns + j);
            }
            let inverse = power(self.get(rank, column), self.prime - 2, self.prime);
            for i in rank + 1..self.rows {
                let factor = self.prime - times(self.get(i, column), inverse, self.prime);
                for j in column..self.columns {
                    let change = times(factor, self.get(rank, j), self.prime);
                    self.entries[i * self.columns + j] = plus(self.get(i, j), change, self.prime);
                }
            }
            rank += 1;
            if rank == self.rows {
                break;
            }
        }
        rank
    }
}

fn residue(x: &Rational, prime: u64) -> Option<u64> {
    let of = |part: &BigInt| (part.abs() % prime).to_u64();
    let (numerator, denominator) = (of(x.numer())?, of(x.denom())?);
    let size = times(numerator, power(denominator, prime - 2, prime), prime);
    (denominator != 0).then_some(if x.is_negative() { plus(0, prime - size, prime) } else { size })
}

fn plus(a: u64, b: u64, prime: u64) -> u64 {
    ((u128::from(a) + u128::from(b)) % u128::from(prime)) as u64
}

fn times(a: u64, b: u64, prime: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(prime)) as u64
}

fn power(mut base: u64, mut exponent: u64, prime: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = times(result, base, prime);
        }
        base = times(base, base, prime);
        exponent >>= 1;
    }
    result
}
