//! Many values of a spline at once.
//!
//! The first value in a knot interval comes from de Boor's algorithm; where another follows in the same interval, its polynomial is
//! written as in [`PowerForm`](crate::core::bspline::PowerForm), on the stack, and evaluated by Horner's scheme as long as
//! parameters stay there. Course: section 4.5.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::power_form::{Frame, at_index, fill_piece, horner};
use crate::core::bspline::space::MAX_DEGREE;
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

/// Up to this degree Horner's scheme loses less than three digits.
const MOST_DEGREE: usize = 7;

impl<P: Point> Spline<P> {
    /// `out[i] = p(xs[i])`, without allocating; quickest for sorted parameters.
    ///
    /// ```
    /// use spline_lab::core::bspline::{EndKnots, Spline, SplineSpace};
    ///
    /// let space = SplineSpace::from_breaks(1, &[0.0, 1.0, 2.0], EndKnots::Interpolating)?;
    /// let hat = Spline::new(space, vec![0.0, 1.0, 0.0])?;
    /// let mut values = [0.0; 4];
    /// hat.evaluate_into(&[0.0, 0.5, 0.75, 2.0], &mut values)?;
    /// assert_eq!(values, [0.0, 0.5, 0.75, 0.0]);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless both slices are of the same length, `NonFinite` with the index of the parameter, `OutsideInterval`. What
    /// stands in `out` then is unspecified.
    pub fn evaluate_into(&self, xs: &[f64], out: &mut [P]) -> Result<(), SplineError> {
        if xs.len() != out.len() {
            return Err(SplineError::SizeMismatch { what: "values", expected: xs.len(), found: out.len() });
        }
        let mut slots = out.iter_mut();
        self.for_each_value(xs, |value| {
            if let Some(slot) = slots.next() {
                *slot = value;
            }
        })
    }

    /// Hands the values at `xs` to `take`, in order.
    #[inline(always)]
    pub(in crate::core) fn for_each_value(&self, xs: &[f64], take: impl FnMut(P)) -> Result<(), SplineError> {
        match self.degree() {
            1 => self.walk::<2>(xs, take),
            2 => self.walk::<3>(xs, take),
            3 => self.walk::<4>(xs, take),
            4 => self.walk::<5>(xs, take),
            5 => self.walk::<6>(xs, take),
            _ => self.walk::<0>(xs, take),
        }
    }

    /// `N` is `n + 1`, or 0 where the loop over the coefficients is not unrolled.
    #[inline(always)]
    fn walk<const N: usize>(&self, xs: &[f64], mut take: impl FnMut(P)) -> Result<(), SplineError> {
        let (space, n) = (self.space(), self.degree());
        let knots = space.evaluation_knots();
        let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut span, mut written) = (0, false);
        let mut frame = Frame::new(0.0, 1.0);
        let mut piece = [P::ZERO; MAX_DEGREE + 1];
        for (i, &x) in xs.iter().enumerate() {
            let inside = ends.0 <= x && x < ends.1;
            if inside && written {
                let count = if N > 0 { N } else { n + 1 };
                take(horner(&piece[..count], frame.local(x)));
                continue;
            }
            if inside && n <= MOST_DEGREE {
                frame = Frame::new(ends.0, ends.1);
                fill_piece(self, span, frame, &mut piece[..=n]);
                written = true;
                take(horner(&piece[..=n], frame.local(x)));
                continue;
            }
            let x = space.reduce(x).map_err(|error| at_index(error, i))?;
            // Sorted parameters mostly move on to the next interval.
            let next = span + 1;
            let is_next =
                n < next && next < space.evaluation_dimension() && knots[next] <= x && x < knots[next + 1];
            span = if is_next { next } else { space.span(x)? };
            ends = (knots[span], knots[span + 1]);
            written = false;
            take(self.evaluate_in_span(span, x));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::space::SplineSpace;

    proptest! {
        #[test]
        fn values_are_those_of_single_evaluations(
            degree in 1_usize..13,
            gaps in prop::collection::vec(0.0..1.0_f64, 30..60),
            mut parts in prop::collection::vec(0.0..=1.0_f64, 1..100),
            sorted in any::<bool>(),
            closed in any::<bool>(),
        ) {
            let mut at = 0.0;
            let knots: Vec<f64> = gaps.iter().map(|gap| { at += gap * gap + 1e-3; at }).collect();
            let space = if closed {
                SplineSpace::periodic(degree, at + 1.0, knots).unwrap()
            } else {
                SplineSpace::new(degree, knots).unwrap()
            };
            let coefficients = (0..space.dimension()).map(|k| (1.3 * k as f64).sin()).collect();
            let spline = Spline::new(space, coefficients).unwrap();
            let (a, b) = spline.space().parameter_interval();
            if sorted {
                parts.sort_by(f64::total_cmp);
            }
            let beyond = if closed { 3.0 } else { 1.0 };
            let xs: Vec<f64> = parts.iter().map(|part| (a + (b - a) * part * beyond).min(if closed { f64::MAX } else { b })).collect();
            let mut out = vec![0.0; xs.len()];
            spline.evaluate_into(&xs, &mut out).unwrap();
            for (&x, value) in xs.iter().zip(&out) {
                let exact = spline.evaluate(x).unwrap();
                prop_assert!((value - exact).abs() < 1e-12, "{x}: {value} instead of {exact}");
            }
        }
    }

    #[test]
    fn bad_parameters_are_named() {
        let space = SplineSpace::new(1, vec![-1.0, 0.0, 1.0, 2.0]).unwrap();
        let spline = Spline::new(space, vec![0.0, 1.0]).unwrap();
        let mut out = [0.0; 3];
        let found = spline.evaluate_into(&[0.5, 0.6, f64::INFINITY], &mut out);
        assert!(matches!(found, Err(SplineError::NonFinite { index: 2, .. })), "{found:?}");
        assert!(
            matches!(
                spline.evaluate_into(&[0.5, 0.6, 1.1], &mut out),
                Err(SplineError::OutsideInterval { .. })
            ),
            "beyond D"
        );
        assert!(
            matches!(spline.evaluate_into(&[], &mut out), Err(SplineError::SizeMismatch { .. })),
            "lengths"
        );
    }
}
