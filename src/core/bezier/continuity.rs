//! Smooth joints of Bezier curves.
//!
//! A curve over `[a, b]` goes on over `[b, b + h]` as the same polynomial with the control points `b[bⁿ⁻ᵏ, (b + h)ᵏ]` of its blossom; the first `m + 1` of
//! them decide the derivatives to order `m` at the joint. Course: section 2.4.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::{BezierError, check_tolerance};
use crate::core::point::Point;

impl<P: Point> BezierCurve<P> {
    /// The first `order + 1` control points that a curve of the same degree over an interval of the length `length` after this one must have
    /// to join with continuous derivatives to that order; all of them if the order is at least the degree.
    ///
    /// # Errors
    ///
    /// `EmptyInterval` unless the length is positive and finite; `NonFinite` where a control point overflows.
    pub fn continuation(&self, length: f64, order: usize) -> Result<Vec<P>, BezierError> {
        let (_, joint) = self.interval();
        let end = joint + length;
        if !(length > 0.0 && end.is_finite() && joint < end) {
            return Err(BezierError::EmptyInterval { left: joint, right: end });
        }
        let n = self.degree();
        let mut arguments = vec![joint; n];
        let mut points = Vec::with_capacity(order.min(n) + 1);
        for k in 0..=order.min(n) {
            if k > 0 {
                arguments[n - k] = end;
            }
            points.push(self.blossom(&arguments)?);
        }
        Ok(Self::new(points)?.points().to_vec())
    }

    /// The number of continuous derivatives where `next` begins and this curve ends; `None` if they do not meet.
    ///
    /// At most the larger degree, which means that both are parts of one polynomial. Derivatives of order `m`, multiplied by `hᵐ` with the smaller of
    /// the lengths of both intervals, may differ by `tolerance` times the larger [`Self::extent`]. The intervals need not adjoin.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `NonFinite` where a derivative overflows.
    pub fn continuity(&self, next: &Self, tolerance: f64) -> Result<Option<usize>, BezierError> {
        check_tolerance(tolerance)?;
        let most = self.degree().max(next.degree());
        let before = self.derivatives(self.interval().1, most)?;
        let after = next.derivatives(next.interval().0, most)?;
        let width = self.width().min(next.width());
        let mut allowed = tolerance * self.extent().max(next.extent());
        let mut joined = 0;
        for (left, right) in before.into_iter().zip(after) {
            if (left - right).norm() > allowed {
                break;
            }
            joined += 1;
            allowed /= width;
        }
        Ok(usize::checked_sub(joined, 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_continuation_has_at_least_the_order_asked_for(
            points in prop::collection::vec(-4.0..4.0_f64, 2..7), more in prop::collection::vec(-4.0..4.0_f64, 7),
            length in 0.3..3.0_f64, order in 0_usize..7,
        ) {
            let curve = BezierCurve::on_interval(points, (1.0, 2.0)).unwrap();
            let mut next = curve.continuation(length, order).unwrap();
            let missing = curve.degree() + 1 - next.len();
            next.extend(&more[..missing]);
            let next = BezierCurve::on_interval(next, (2.0, 2.0 + length)).unwrap();
            let found = curve.continuity(&next, 1e-9).unwrap();
            prop_assert!(found >= Some(order.min(curve.degree())), "{found:?}");
        }
    }

    #[test]
    fn long_intervals_do_not_hide_a_jump() {
        // Second derivatives of size 1e-6 over intervals of length 1000 bend the curve by its own size.
        let before = BezierCurve::on_interval(vec![0.0, 1.0, 2.0], (0.0, 1000.0)).unwrap();
        let after = BezierCurve::on_interval(vec![2.0, 3.0, 5.0], (1000.0, 2000.0)).unwrap();
        assert_eq!(before.continuity(&after, 1e-3), Ok(Some(1)), "the curvature jumps");
    }

    #[test]
    fn curves_apart_are_not_continuous() {
        let curve = BezierCurve::new(vec![0.0, 1.0, 4.0]).unwrap();
        let apart = BezierCurve::new(vec![5.0, 1.0, 4.0]).unwrap();
        assert_eq!(curve.continuity(&apart, 1e-9), Ok(None), "a gap");
        let corner = BezierCurve::new(vec![4.0, 8.0]).unwrap();
        assert_eq!(curve.continuity(&corner, 1e-9), Ok(Some(0)), "a corner");
        assert_eq!(curve.continuity(&corner, f64::NAN).unwrap_err().name(), "InvalidTolerance", "NaN");
        assert_eq!(curve.continuation(0.0, 1).unwrap_err().name(), "EmptyInterval", "no length");
    }
}
