//! One B-spline and the B-splines of lower degree that it is made of.

use crate::core::bspline::{SplineSpace, basis_function};

/// Samples of one polynomial piece.
const SAMPLES: usize = 32;

/// The B-spline that is built, and everything that it is built of.
#[derive(Clone, Debug)]
pub(super) struct Pyramid {
    /// Degree of the B-spline.
    pub(super) degree: usize,
    /// Its knots `ξₖ … ξₖ₊ₙ₊₁`.
    pub(super) knots: Vec<f64>,
}

impl Pyramid {
    pub(super) fn new(space: &SplineSpace, spline: usize) -> Self {
        let degree = space.degree();
        let knots = (spline..=spline + degree + 1).filter_map(|k| space.knot(k as isize)).collect();
        Self { degree, knots }
    }

    /// Its support.
    pub(super) fn support(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// `bᵈₖ₊ᵢ(x)`.
    pub(super) fn value(&self, degree: usize, i: usize, x: f64) -> f64 {
        let knots = self.knots.get(i..=i + degree + 1);
        knots.and_then(|knots| basis_function(degree, knots, x).ok()).unwrap_or(0.0)
    }

    /// `γᵈₖ₊ᵢ(x)`; 0 for a B-spline of degree `d − 1` without support.
    pub(super) fn factor(&self, degree: usize, i: usize, x: f64) -> f64 {
        let (low, high) = (self.knots[i], self.knots[i + degree]);
        if low < high { (x - low) / (high - low) } else { 0.0 }
    }

    /// Both parts of `bᵈₖ₊ᵢ(x)`.
    pub(super) fn parts(&self, degree: usize, i: usize, x: f64) -> [f64; 2] {
        [
            self.factor(degree, i, x) * self.value(degree - 1, i, x),
            (1.0 - self.factor(degree, i + 1, x)) * self.value(degree - 1, i + 1, x),
        ]
    }

    /// Parameters that show every jump and every bend of functions over the knots `from … to`.
    pub(super) fn samples(&self, from: usize, to: usize) -> Vec<f64> {
        let mut samples = Vec::new();
        for ends in self.knots[from..=to].windows(2).filter(|ends| ends[0] < ends[1]) {
            let (a, b) = (ends[0], ends[1]);
            samples.extend((0..SAMPLES).map(|i| a + (b - a) * i as f64 / SAMPLES as f64));
            // The limit from the left.
            samples.push(b - 1e-9 * (b - a));
        }
        samples.push(self.knots[to]);
        samples
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_parts_make_the_b_spline_at_every_degree_and_every_knot() {
        let space =
            SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 4.0, 4.0, 4.0, 5.0]).unwrap();
        for spline in 0..space.dimension() {
            let pyramid = Pyramid::new(&space, spline);
            for degree in 1..=3 {
                for i in 0..=3 - degree {
                    for x in pyramid.samples(i, i + degree + 1) {
                        let [a, b] = pyramid.parts(degree, i, x);
                        let value = pyramid.value(degree, i, x);
                        assert!(
                            (a + b - value).abs() < 1e-14,
                            "{spline} {degree} {i} at {x}: {a} + {b}, {value}"
                        );
                        assert!(a >= 0.0 && b >= 0.0, "{spline} {degree} {i} at {x}: {a} and {b}");
                    }
                }
            }
        }
    }
}
