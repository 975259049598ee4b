//! R-functions: Boolean operations on the signs of weight functions.
//!
//! ```text
//! r_c(a) = −a,   r_∪(a, b) = a + b + s,   r_∩(a, b) = a + b − s,   r_\(a, b) = a − b − s = r_∩(a, −b),   s = √(a² + b²).
//! ```
//!
//! The result is positive exactly where the operation on "is positive" says so. Where just one of the weights
//! vanishes, and it decides, the slope of the result across that boundary is the slope of that weight. At a
//! corner, `a = b = 0`, there is no gradient: the value is 0 and the gradient returned is 0.
//!
//! V. Rvachev, T. Sheiko, *R-functions in boundary value problems in mechanics*, 1995. Course: section 9.2.

use crate::core::domain::Jet;

/// `r_c(a) = −a`: outside of a region.
pub fn r_complement(a: Jet) -> Jet {
    Jet { value: -a.value, gradient: -a.gradient }
}

/// `r_∩(a, b) = a + b − s`: common part.
pub fn r_intersection(a: Jet, b: Jet) -> Jet {
    let s = a.value.hypot(b.value);
    if s == 0.0 {
        return Jet::default();
    }
    let sum = a.value + b.value;
    // The second form has no cancellation where the result is positive; halves cannot overflow.
    let value = if sum > 0.0 { 2.0 * (a.value / (sum + s)) * b.value } else { sum - s };
    // 1 − a/s = b²/(s (s + a)) for a > 0.
    let one_less = |a: f64, b: f64| if a > 0.0 { (b / s) * (b / (s + a)) } else { 1.0 - a / s };
    let gradient = a.gradient * one_less(a.value, b.value) + b.gradient * one_less(b.value, a.value);
    Jet { value, gradient }
}

/// `r_∪(a, b) = a + b + s`: what belongs to one or both.
pub fn r_union(a: Jet, b: Jet) -> Jet {
    r_complement(r_intersection(r_complement(a), r_complement(b)))
}

/// `r_\(a, b) = a − b − s`: what belongs to the first and not to the second.
pub fn r_difference(a: Jet, b: Jet) -> Jet {
    r_intersection(a, r_complement(b))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;

    fn jet(value: f64, x: f64, y: f64) -> Jet {
        Jet { value, gradient: DVec2::new(x, y) }
    }

    proptest! {
        #[test]
        fn signs_follow_the_boolean_operations(a in -5.0..5.0f64, b in -5.0..5.0f64) {
            let (ja, jb) = (jet(a, 1.0, 0.0), jet(b, 0.0, 1.0));
            prop_assert_eq!(r_intersection(ja, jb).value > 0.0, a > 0.0 && b > 0.0);
            prop_assert_eq!(r_union(ja, jb).value > 0.0, a > 0.0 || b > 0.0);
            prop_assert_eq!(r_difference(ja, jb).value > 0.0, a > 0.0 && b <= 0.0);
        }

        #[test]
        fn values_and_gradients_are_those_of_the_definition(a in -5.0..5.0f64, b in -5.0..5.0f64) {
            let s = a.hypot(b);
            let (both, one) = (r_intersection(jet(a, 1.0, 0.0), jet(b, 0.0, 1.0)), r_union(jet(a, 1.0, 0.0), jet(b, 0.0, 1.0)));
            prop_assert!((both.value - (a + b - s)).abs() < 1e-14 * s, "{both:?}");
            prop_assert!((one.value - (a + b + s)).abs() < 1e-14 * s, "{one:?}");
            prop_assert!((both.gradient - DVec2::new(1.0 - a / s, 1.0 - b / s)).length() < 1e-14, "{both:?}");
            prop_assert!((one.gradient - DVec2::new(1.0 + a / s, 1.0 + b / s)).length() < 1e-14, "{one:?}");
        }
    }

    #[test]
    fn small_weights_beside_large_ones_do_not_cancel() {
        let value = r_intersection(jet(1e-20, 1.0, 0.0), jet(1.0, 0.0, 1.0)).value;
        assert!((value - 1e-20).abs() < 1e-34, "{value} is the small weight");
    }

    #[test]
    fn corners_and_extreme_numbers_give_no_nan() {
        let numbers = [0.0, -0.0, 5e-324, -1e-300, 1e300, -1.7e308, 1.7e308];
        for a in numbers {
            for b in numbers {
                for result in
                    [r_intersection, r_union, r_difference].map(|r| r(jet(a, 1.0, 2.0), jet(b, 3.0, 4.0)))
                {
                    assert!(!result.value.is_nan() && !result.gradient.is_nan(), "{a}, {b}: {result:?}");
                }
            }
        }
        assert_eq!(r_union(jet(0.0, 1.0, 0.0), jet(0.0, 0.0, 1.0)).gradient, DVec2::ZERO, "corner");
    }
}
