//! Regions with names.

use crate::geometry::Polytope;
use crate::partition::Region;
use imdp::numeric::to_f64;

/// A set of regions, as bits.
pub type Letter = u64;

/// A part of the state space with a name: a union of shapes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedRegion {
    /// The name.
    pub name: String,
    /// The shapes.
    pub shapes: Vec<Shape>,
}

/// A box or a polytope.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A half-open box.
    Box(Region),
    /// `{x : G x ≤ g}`.
    Polytope(Polytope),
}

impl NamedRegion {
    /// The boxes among the shapes.
    pub(crate) fn boxes(&self) -> Vec<Region> {
        let of = |shape: &Shape| match shape {
            Shape::Box(region) => Some(region.clone()),
            Shape::Polytope(_) => None,
        };
        self.shapes.iter().filter_map(of).collect()
    }

    /// The polytopes among the shapes.
    pub(super) fn polytopes(&self) -> impl Iterator<Item = &Polytope> {
        self.shapes.iter().filter_map(|shape| match shape {
            Shape::Box(_) => None,
            Shape::Polytope(polytope) => Some(polytope),
        })
    }

    /// The half-spaces of each shape, nearest doubles: a state is in a shape if `normal · x < offset` for those that are
    /// strict and `normal · x ≤ offset` for the others.
    pub fn half_spaces(&self) -> Vec<Vec<HalfSpace>> {
        self.shapes.iter().map(half_spaces).collect()
    }
}

/// `normal · x ≤ offset`, or `<` if it is strict.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfSpace {
    /// One number per dimension.
    pub normal: Vec<f64>,
    /// The bound.
    pub offset: f64,
    /// Whether the bound itself is outside.
    pub strict: bool,
}

impl HalfSpace {
    /// Whether it contains a state; the sum is taken from left to right.
    pub fn contains(&self, x: &[f64]) -> bool {
        let sum = self.normal.iter().zip(x).fold(0.0, |sum, (g, x)| sum + g * x);
        if self.strict { sum < self.offset } else { sum <= self.offset }
    }
}

/// The regions of a task for states in doubles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LetterLookup {
    /// By region and shape.
    regions: Vec<Vec<Vec<HalfSpace>>>,
}

impl LetterLookup {
    /// The lookup of some regions.
    pub fn new(regions: &[NamedRegion]) -> Self {
        Self { regions: regions.iter().map(NamedRegion::half_spaces).collect() }
    }

    /// The half-spaces, by region and shape.
    pub fn regions(&self) -> &[Vec<Vec<HalfSpace>>] {
        &self.regions
    }

    /// The regions that contain a state, as bits.
    pub fn letter(&self, x: &[f64]) -> Letter {
        let contains = |shapes: &[Vec<HalfSpace>]| {
            shapes.iter().any(|shape| shape.iter().all(|half_space| half_space.contains(x)))
        };
        (0..)
            .zip(&self.regions)
            .fold(0, |letter, (bit, shapes)| letter | Letter::from(contains(shapes)) << bit)
    }
}

fn half_spaces(shape: &Shape) -> Vec<HalfSpace> {
    match shape {
        Shape::Box(region) => {
            let n = region.lower.len();
            let unit = |j: usize, sign: f64| (0..n).map(|k| if k == j { sign } else { 0.0 }).collect();
            let mut all = vec![];
            for j in 0..n {
                if let Some(lower) = &region.lower[j] {
                    all.push(HalfSpace { normal: unit(j, -1.0), offset: -to_f64(lower), strict: false });
                }
                if let Some(upper) = &region.upper[j] {
                    all.push(HalfSpace { normal: unit(j, 1.0), offset: to_f64(upper), strict: true });
                }
            }
            all
        }
        Shape::Polytope(polytope) => (0..polytope.offsets().len())
            .map(|row| HalfSpace {
                normal: (0..polytope.dimension()).map(|j| to_f64(polytope.normals().get(row, j))).collect(),
                offset: to_f64(&polytope.offsets()[row]),
                strict: false,
            })
            .collect(),
    }
}
