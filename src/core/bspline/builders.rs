//! Spline spaces from what people have: breaks, an interval, or the knots of another program.
//!
//! *End-interpolating knots*: both ends of D are `n`-fold, with one outer knot on each side one length of the adjacent interval
//! outside. *Simple end knots*: `n` exterior knots on each side, spaced by the adjacent interval.
//! Course: section 4.4.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::SplineSpace;

/// The choice of the exterior knots of an open space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EndKnots {
    /// `n` exterior knots on each side, spaced by the adjacent interval of D.
    Simple,
    /// `n`-fold ends: the first and the last coefficient are values of the spline.
    Interpolating,
}

impl SplineSpace {
    /// The open space whose inner knots and ends of D are `breaks`; a repeated inner break is a multiple knot.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for fewer than two breaks, else those of [`SplineSpace::new`], with indices into all knots.
    pub fn from_breaks(degree: usize, breaks: &[f64], ends: EndKnots) -> Result<Self, SplineError> {
        let &[first, second, ..] = breaks else {
            let found = breaks.len();
            return Err(SplineError::SizeMismatch { what: "breaks", expected: 2, found });
        };
        let (before_last, last) = (breaks[breaks.len() - 2], breaks[breaks.len() - 1]);
        let (left, right) = (second - first, last - before_last);
        let outside = |i: usize| match ends {
            EndKnots::Simple => i as f64,
            EndKnots::Interpolating => f64::from(u8::from(i == degree)),
        };
        let mut knots: Vec<f64> = (1..=degree).rev().map(|i| first - outside(i) * left).collect();
        knots.extend_from_slice(breaks);
        knots.extend((1..=degree).map(|i| last + outside(i) * right));
        Self::new(degree, knots)
    }

    /// The open space over `intervals` equal intervals of `[left, right]` with uniform exterior knots: `ξₖ = left + (k − n) h`.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::new`].
    pub fn uniform(degree: usize, left: f64, right: f64, intervals: usize) -> Result<Self, SplineError> {
        if intervals == 0 {
            return Err(SplineError::Empty { what: "intervals" });
        }
        let width = (right - left) / intervals as f64;
        let knot = |k: usize| {
            if k == degree + intervals { right } else { left + (k as f64 - degree as f64) * width }
        };
        Self::new(degree, (0..=2 * degree + intervals).map(knot).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_knots_hit_both_ends_exactly() {
        let space = SplineSpace::uniform(3, 0.1, 0.7, 7).unwrap();
        assert_eq!(space.parameter_interval(), (0.1, 0.7), "no rounding at the ends");
        assert_eq!(space.dimension(), 10, "intervals plus degree");
    }

    #[test]
    fn bad_breaks_are_refused() {
        let error =
            |breaks: &[f64]| SplineSpace::from_breaks(2, breaks, EndKnots::Interpolating).unwrap_err().name();
        assert_eq!(error(&[1.0]), "SizeMismatch", "one break");
        assert_eq!(error(&[0.0, 2.0, 1.0, 3.0]), "KnotsDecreasing", "unsorted");
        assert_eq!(SplineSpace::uniform(2, 0.0, 1.0, 0).unwrap_err().name(), "Empty", "no interval");
    }
}
