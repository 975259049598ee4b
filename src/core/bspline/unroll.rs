//! A periodic spline as an open one over its first period.
//!
//! With `μ` copies of `ξ₀` the open knots are `ξ` number `μ − 1 − n … M + n`: the last copy of `ξ₀` starts D, the first copy of `ξ₀ + T`
//! ends it. Course: sections 4.6 and 6.1.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::SplineSpace;
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

impl<P: Point> Spline<P> {
    /// The open spline with the same values over D, one period from `ξ₀` for a periodic spline; an open one is copied.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::new`]; none is known to occur.
    pub fn unroll(&self) -> Result<Self, SplineError> {
        let space = SplineSpace::new(self.degree(), self.space().evaluation_knots().to_vec())?;
        let coefficients = (0..space.dimension()).map(|k| self.evaluation_coefficient(k)).collect();
        Self::new(space, coefficients)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_periodic_spline_is_its_unrolled_one(
            degree in 1_usize..=12, gaps in prop::collection::vec(0_u8..4, 1..12), at in 0.0..=1.0_f64,
        ) {
            let mut knots = vec![0.0];
            for gap in &gaps {
                knots.push(knots[knots.len() - 1] + f64::from(*gap));
            }
            let period = knots[knots.len() - 1] + 1.0;
            let coefficients: Vec<f64> = (0..knots.len()).map(|k| ((k * k + 3) % 7) as f64).collect();
            let Ok(space) = SplineSpace::periodic(degree, period, knots) else { return Ok(()) };
            let spline = Spline::new(space, coefficients).unwrap();
            let open = spline.unroll().unwrap();
            let x = period * at;
            prop_assert_eq!(spline.evaluate(x).unwrap(), open.evaluate(x).unwrap(), "the same arithmetic");
            let later = spline.evaluate(x + 5.0 * period).unwrap();
            let error = (later - spline.evaluate(x).unwrap()).abs();
            // x + 5T is rounded; near a knot of degree 1 the slope is at most 7.
            prop_assert!(error < 1e-10, "five periods later: {}", error);
        }
    }
}
