//! Extrema over boxes of sub-cells: for every place of a box of one size.

use super::side::Side;
use rayon::prelude::*;

/// How many numbers one task looks at, at least.
const BLOCK: usize = 1 << 14;

/// One axis of an array.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) len: usize,
    /// How far apart neighbours are.
    pub(super) stride: usize,
    pub(super) periodic: bool,
}

/// The extrema over boxes of one size after the other; what sizes have in common is computed once.
///
/// Level `j` holds the extrema over boxes that extend along the first `j` axes only.
#[derive(Debug)]
pub(super) struct Windows<'a> {
    extents: &'a [Extent],
    values: &'a [f64],
    size: Vec<u32>,
    /// By axis: the array after this axis, or nothing if a box has one sub-cell along it.
    levels: Vec<Vec<f64>>,
}

impl<'a> Windows<'a> {
    pub(super) fn new(extents: &'a [Extent], values: &'a [f64]) -> Self {
        Self { extents, values, size: vec![0; extents.len()], levels: vec![vec![]; extents.len()] }
    }

    /// The extremum over the box of `size` that begins at each place. Boxes must not go beyond the end of an axis
    /// that is not periodic.
    pub(super) fn of<S: Side>(&mut self, size: &[u32]) -> &[f64] {
        let same = self.size.iter().zip(size).take_while(|(a, b)| a == b).count();
        for (axis, &length) in size.iter().enumerate().skip(same) {
            let mut level = std::mem::take(&mut self.levels[axis]);
            level.clear();
            if length > 1 {
                level.extend_from_slice(self.up_to(axis));
                slide::<S>(&mut level, self.extents[axis], length as usize);
            }
            self.levels[axis] = level;
        }
        self.size.copy_from_slice(size);
        self.up_to(size.len())
    }

    /// The last level before an axis.
    fn up_to(&self, axis: usize) -> &[f64] {
        self.levels[..axis].iter().rev().find(|level| !level.is_empty()).map_or(self.values, Vec::as_slice)
    }
}

/// Replaces every number by the extremum of `size` numbers along an axis from there on.
///
/// In powers of two: windows of `w` make windows of up to `2w`.
fn slide<S: Side>(values: &mut Vec<f64>, extent: Extent, size: usize) {
    let mut width = 1;
    while width < size {
        let shift = width.min(size - width);
        *values = shifted::<S>(values, extent, shift);
        width += shift;
    }
}

/// `opt(v(i), v(i + shift))` along an axis; places whose partner is beyond the end keep their value.
fn shifted<S: Side>(values: &[f64], Extent { len, stride, periodic }: Extent, shift: usize) -> Vec<f64> {
    let block = len * stride;
    let (kept, apart) = ((len - shift.min(len)) * stride, shift * stride);
    let mut out = vec![0.0; values.len()];
    let chunk = if block >= BLOCK { block } else { BLOCK / block * block };
    out.par_chunks_mut(chunk).zip(values.par_chunks(chunk)).for_each(|(out, values)| {
        for (out, values) in out.chunks_mut(block).zip(values.chunks(block)) {
            let pick = |(out, (a, b)): (&mut f64, (&f64, &f64))| *out = S::of(*a, *b);
            if block >= 2 * BLOCK {
                let pairs = values.par_iter().zip(values[apart.min(block)..].par_iter());
                out[..kept].par_iter_mut().zip(pairs).with_min_len(BLOCK).for_each(pick);
            } else {
                out[..kept].iter_mut().zip(values.iter().zip(&values[apart.min(block)..])).for_each(pick);
            }
            if periodic {
                out[kept..].iter_mut().zip(values[kept..].iter().zip(values)).for_each(pick);
            } else {
                out[kept..].copy_from_slice(&values[kept..]);
            }
        }
    });
    out
}

#[cfg(test)]
mod tests {
    use super::super::side::{Lower, Upper};
    use super::*;

    fn extents(shape: &[(usize, bool)]) -> Vec<Extent> {
        let mut stride = shape.iter().map(|(len, _)| len).product();
        let of = |&(len, periodic): &(usize, bool)| {
            stride /= len;
            Extent { len, stride, periodic }
        };
        shape.iter().map(of).collect()
    }

    #[test]
    fn boxes_are_searched_through() {
        let shape = [(7, false), (5, true), (6, false)];
        let extents = extents(&shape);
        let values: Vec<f64> = (0..210).map(|i| f64::from((i * 83 + i * i * 31) % 211)).collect();
        let mut windows = Windows::new(&extents, &values);
        let mut greatest = Windows::new(&extents, &values);
        for size in [[1, 1, 1], [1, 1, 4], [1, 3, 1], [1, 5, 6], [2, 3, 2], [2, 3, 5], [7, 4, 1]] {
            let (least, most) = (windows.of::<Lower>(&size).to_vec(), greatest.of::<Upper>(&size).to_vec());
            for x in 0..=7 - size[0] as usize {
                for y in 0..5 {
                    for z in 0..=6 - size[2] as usize {
                        let mut expected = (f64::INFINITY, f64::NEG_INFINITY);
                        for i in 0..size[0] as usize * size[1] as usize * size[2] as usize {
                            let (a, b, c) = (
                                i / (size[1] * size[2]) as usize,
                                i / size[2] as usize % size[1] as usize,
                                i % size[2] as usize,
                            );
                            let value = values[(x + a) * 30 + (y + b) % 5 * 6 + z + c];
                            expected = (expected.0.min(value), expected.1.max(value));
                        }
                        let at = x * 30 + y * 6 + z;
                        assert_eq!((least[at], most[at]), expected, "{size:?} at {x} {y} {z}");
                    }
                }
            }
        }
    }
}
