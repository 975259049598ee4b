//! Sign changes of Bernstein coefficients and intervals that contain the zeros.
//!
//! A polynomial has at most as many zeros in `(0, 1)`, counted with multiplicity, as its coefficients have sign changes, and
//! the difference is even. Halving sheds the surplus: intervals without sign change contain no zero, with one exactly one.
//! Course: section 1.5. [`bernstein_zeros`](crate::core::root_finding::bernstein_zeros) gives the zeros themselves.

use crate::core::polynomial::error::{PolynomialError, check_coefficients};
use crate::core::triangular_scheme::collapse_both;

/// Number of sign changes in a sequence; zeros are passed over.
pub fn sign_changes(c: &[f64]) -> usize {
    let mut last = 0.0;
    let mut changes = 0;
    for &value in c.iter().filter(|&&value| value != 0.0) {
        changes += usize::from(last * value.signum() < 0.0);
        last = value.signum();
    }
    changes
}

/// What is known about the zeros in an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ZeroKind {
    /// Exactly one zero, a simple one.
    Simple,
    /// A multiple zero, several zeros, or complex ones within the tolerance of the interval.
    PossiblyMultiple,
}

/// An interval `[low, high]` with zeros; `low = high` if the zero was hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZeroInterval {
    /// Left end.
    pub low: f64,
    /// Right end.
    pub high: f64,
    /// What is in it.
    pub kind: ZeroKind,
}

/// Intervals of at most `tolerance` length (those of possibly multiple zeros may have merged), increasing, that contain all zeros in `[0, 1]`.
///
/// By halving in floating point: values below the rounding error of the subdivision count as 0. The zero polynomial gives the
/// one interval `[0, 1]`.
///
/// # Errors
///
/// `Empty`, `NonFinite`, `InvalidTolerance` unless the tolerance is positive.
pub fn isolate_zeros(c: &[f64], tolerance: f64) -> Result<Vec<ZeroInterval>, PolynomialError> {
    check_coefficients(c)?;
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(PolynomialError::InvalidTolerance { value: tolerance });
    }
    let largest = c.iter().fold(0.0_f64, |most, value| value.abs().max(most));
    let noise = 2.0 * c.len() as f64 * f64::EPSILON * largest;
    if largest == 0.0 {
        return Ok(vec![ZeroInterval { low: 0.0, high: 1.0, kind: ZeroKind::PossiblyMultiple }]);
    }
    let clean =
        |c: &[f64]| -> Vec<f64> { c.iter().map(|&v| if v.abs() <= noise { 0.0 } else { v }).collect() };
    let mut found: Vec<ZeroInterval> = Vec::new();
    let mut report = |low: f64, high: f64, kind| match found.last_mut() {
        Some(last) if last.high >= low && (kind == ZeroKind::PossiblyMultiple || last.kind == kind) => {
            // A zero at a joint is found in both halves.
            let same = last.low == high || (last.low == last.high && low == high);
            last.high = high.max(last.high);
            if !same {
                last.kind = ZeroKind::PossiblyMultiple;
            }
        }
        _ => found.push(ZeroInterval { low, high, kind }),
    };
    let mut waiting = vec![(0.0, 1.0, clean(c))];
    while let Some((low, high, mut c)) = waiting.pop() {
        let n = c.len() - 1;
        // Two zero coefficients at an end make that end a multiple zero.
        let at_end = |first: f64, second: Option<&f64>| {
            (first == 0.0).then_some(match second {
                Some(0.0) | None => ZeroKind::PossiblyMultiple,
                Some(_) => ZeroKind::Simple,
            })
        };
        let left = at_end(c[0], c.get(1));
        let right = at_end(c[n], n.checked_sub(1).and_then(|k| c.get(k)));
        let inside = sign_changes(&c);
        let ends_differ = c[0] * c[n] < 0.0;
        if let Some(kind) = left {
            report(low, low, kind);
        }
        if inside == 1 && high - low <= tolerance {
            report(low, high, if ends_differ { ZeroKind::Simple } else { ZeroKind::PossiblyMultiple });
        } else if inside > 0 && (high - low <= tolerance || c.iter().all(|&value| value == 0.0)) {
            report(low, high, ZeroKind::PossiblyMultiple);
        } else if inside > 0 {
            let middle = 0.5 * (low + high);
            let mut first = vec![0.0; n + 1];
            collapse_both(&mut c, 0.5, &mut first);
            waiting.push((middle, high, clean(&c)));
            waiting.push((low, middle, clean(&first)));
            continue;
        }
        if let Some(kind) = right {
            report(high, high, kind);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::polynomial::bernstein_product;
    use crate::core::root_finding::bernstein_zeros;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_zero_lies_in_an_interval_of_its_kind(c in prop::collection::vec(-1.0..1.0_f64, 1..12)) {
            let intervals = isolate_zeros(&c, 1e-6).unwrap();
            let zeros = bernstein_zeros(&c, 0.0);
            for zero in zeros.isolated() {
                let holder = intervals.iter().find(|i| i.low - 1e-12 <= zero.at && zero.at <= i.high + 1e-12);
                prop_assert!(holder.is_some(), "{zero:?} is in none of {intervals:?}");
            }
            let simple = intervals.iter().filter(|i| i.kind == ZeroKind::Simple).count();
            prop_assert!(simple <= zeros.isolated().len(), "{intervals:?} {zeros:?}");
            prop_assert!(intervals.windows(2).all(|pair| pair[0].high <= pair[1].low), "sorted {intervals:?}");
        }
    }

    #[test]
    fn a_double_zero_off_the_grid_is_possibly_multiple() {
        let factor = [-0.3, 0.7];
        let c = bernstein_product(&factor, &bernstein_product(&factor, &[1.0, 2.0]).unwrap()).unwrap();
        let intervals = isolate_zeros(&c, 1e-5).unwrap();
        assert_eq!(intervals.len(), 1, "{intervals:?}");
        assert_eq!(intervals[0].kind, ZeroKind::PossiblyMultiple, "{intervals:?}");
        assert!(intervals[0].low <= 0.3 && 0.3 <= intervals[0].high, "{intervals:?}");
    }

    #[test]
    fn zeros_at_ends_and_joints_are_counted_once() {
        let simple = |low, high| ZeroInterval { low, high, kind: ZeroKind::Simple };
        assert_eq!(isolate_zeros(&[-1.0, 1.0], 1e-3), Ok(vec![simple(0.5, 0.5)]), "the middle");
        assert_eq!(isolate_zeros(&[0.0, 1.0], 1e-3), Ok(vec![simple(0.0, 0.0)]), "the left end");
        assert_eq!(
            isolate_zeros(&[0.0, 1.0, 0.0], 1e-3),
            Ok(vec![simple(0.0, 0.0), simple(1.0, 1.0)]),
            "both"
        );
        assert_eq!(isolate_zeros(&[1.0], 1e-3), Ok(vec![]), "a constant");
        assert_eq!(isolate_zeros(&[1.0], 0.0).unwrap_err().name(), "InvalidTolerance", "zero tolerance");
        assert_eq!(isolate_zeros(&[0.0, 0.0], 1e-3).unwrap()[0].high, 1.0, "the zero polynomial");
    }
}
