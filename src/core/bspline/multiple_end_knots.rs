//! The convention of other programs: `(n+1)`-fold knots at the ends of D.
//!
//! No value on D depends on the outermost knot of each side, so both conventions describe the same splines with the same
//! coefficients. This file alone knows the other one. Course: section 4.4.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::{SplineSpace, check_nondecreasing};

impl SplineSpace {
    /// The open space of knots in either convention, as people type or load them.
    ///
    /// At an end with `n + 1` equal outermost knots the outermost one moves one length of the adjacent interval outside; all other
    /// knots are taken as they are. Each end is looked at on its own.
    ///
    /// # Errors
    ///
    /// Those of [`SplineSpace::new`].
    pub fn from_either_convention(degree: usize, mut knots: Vec<f64>) -> Result<Self, SplineError> {
        // Too few, unsorted or infinite knots are for `new` to name.
        if degree > 0 && knots.len() >= 2 * degree + 2 && check_nondecreasing(&knots).is_ok() {
            let last = knots.len() - 1;
            let (left, right) = (knots[degree], knots[last - degree]);
            let (first_width, last_width) = (knots[degree + 1] - left, right - knots[last - degree - 1]);
            if knots[0] >= left && first_width > 0.0 {
                knots[0] = left - first_width;
            }
            if knots[last] <= right && last_width > 0.0 {
                knots[last] = right + last_width;
            }
        }
        Self::new(degree, knots)
    }

    /// The knots with `(n+1)`-fold ends, for other programs; the coefficients are the same.
    ///
    /// `None` unless the space is open with `n`-fold ends; insert end knots first then.
    pub fn multiple_end_knots(&self) -> Option<Vec<f64>> {
        let (n, m) = (self.degree(), self.dimension());
        if self.is_periodic() {
            return None;
        }
        let mut knots = self.knots().to_vec();
        let last = knots.len() - 1;
        if knots[1] < knots[n] || knots[last - 1] > knots[m] {
            return None;
        }
        knots[0] = knots[n];
        knots[last] = knots[m];
        Some(knots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_conventions_give_the_same_space_and_go_back() {
        let other = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0];
        let space = SplineSpace::from_either_convention(3, other.clone()).unwrap();
        assert_eq!(space.knots(), [-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 3.0], "outer knots outside");
        assert_eq!(space.multiple_end_knots(), Some(other), "and back");
        let ours = SplineSpace::from_either_convention(3, space.knots().to_vec()).unwrap();
        assert_eq!(ours, space, "our own knots stay");
    }

    #[test]
    fn nothing_else_is_repaired() {
        let five_fold = vec![0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0];
        let error = SplineSpace::from_either_convention(3, five_fold).unwrap_err();
        assert_eq!(error.name(), "KnotMultiplicityTooHigh", "one too many");
        let inner = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
        let error = SplineSpace::from_either_convention(2, inner).unwrap_err();
        assert_eq!(error.name(), "KnotMultiplicityTooHigh", "a jump inside");
        let uniform = SplineSpace::uniform(2, 0.0, 1.0, 3).unwrap();
        assert_eq!(uniform.multiple_end_knots(), None, "simple end knots");
    }
}
