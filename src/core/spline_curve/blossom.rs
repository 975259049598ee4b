//! The blossom of a spline, and the labels of its control points.
//!
//! The polynomial over one knot interval has a unique symmetric function `P[u₁, …, uₙ]`, affine in every argument, with
//! `P[t, …, t] = p(t)`. Control points are `cₖ = P[τₖ₊₁, …, τₖ₊ₙ]`, Bezier points `P[a, …, a, b, …, b]`. Over uniform knots two points
//! whose labels differ in one index, `a` and `e`, span a segment that carries `e − a − 1` equally spaced labelled points.
//!
//! L. Ramshaw, *Blossoming: a connect-the-dots approach to splines*, 1987. Course: section 6.4.

use std::collections::BTreeSet;

use crate::core::bspline::{MAX_DEGREE, Spline, SplineError};
use crate::core::point::Point;

impl<P: Point> Spline<P> {
    /// The blossom of the polynomial over the knot interval `span` at `n` arguments.
    ///
    /// `span` counts the evaluation knots, as [`SplineSpace::span`](crate::core::bspline::SplineSpace::span) returns it.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless there are `n` arguments, or if `span` is no knot interval of D; `NonFinite` with the index of the argument.
    pub fn blossom(&self, span: usize, arguments: &[f64]) -> Result<P, SplineError> {
        let (n, space) = (self.degree(), self.space());
        if arguments.len() != n {
            let (expected, found) = (n, arguments.len());
            return Err(SplineError::SizeMismatch { what: "arguments", expected, found });
        }
        if let Some(index) = arguments.iter().position(|argument| !argument.is_finite()) {
            return Err(SplineError::NonFinite { what: "argument", index, value: arguments[index] });
        }
        let (knots, m) = (space.evaluation_knots(), space.evaluation_dimension());
        if !(n..m).contains(&span) || knots[span] >= knots[span + 1] {
            return Err(SplineError::SizeMismatch { what: "as knot interval", expected: m - 1, found: span });
        }
        Ok(self.blossom_in_span(span, arguments.iter().copied()))
    }

    /// As [`Self::blossom`] without checks: de Boor's scheme with another argument in every step.
    pub(super) fn blossom_in_span(&self, span: usize, arguments: impl Iterator<Item = f64>) -> P {
        let (n, knots) = (self.degree(), self.space().evaluation_knots());
        let mut row = [P::ZERO; MAX_DEGREE + 1];
        for (j, slot) in row[..=n].iter_mut().enumerate() {
            *slot = self.evaluation_coefficient(span - n + j);
        }
        for (step, argument) in arguments.take(n).enumerate() {
            for j in (step + 1..=n).rev() {
                let k = span + j - n;
                row[j] = row[j - 1].mix(row[j], (argument - knots[k]) / (knots[k + n - step] - knots[k]));
            }
        }
        row[n]
    }
}

/// A label of a point between two labelled points, and the share of the second.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelBetween {
    /// Increasing indices.
    pub label: Vec<i64>,
    /// The point is `(1 − share)·first + share·second`.
    pub share: f64,
}

/// The labelled points inside the segment of two points whose labels differ in one index; none if they do not.
///
/// Labels are increasing lists of equal length, of indices of uniform knots.
pub fn labels_between(first: &[i64], second: &[i64]) -> Vec<LabelBetween> {
    let Some((common, a, e)) = single_difference(first, second) else { return Vec::new() };
    let (low, high) = (a.min(e), a.max(e));
    let mut between: Vec<LabelBetween> = (low + 1..high)
        .map(|index| {
            let mut label = common.clone();
            label.insert(label.partition_point(|&other| other < index), index);
            LabelBetween { label, share: (index - a) as f64 / (e - a) as f64 }
        })
        .collect();
    between.sort_by(|x, y| x.share.total_cmp(&y.share));
    between
}

/// All labels that [`labels_between`] gives from the given ones, again and again, in lexicographic order.
///
/// # Errors
///
/// `StepLimit` if the labels or their indices are so many that the closure has more than 100,000.
pub fn label_closure(labels: &[Vec<i64>]) -> Result<Vec<Vec<i64>>, SplineError> {
    const LIMIT: usize = 100_000;
    let mut known: Vec<Vec<i64>> = labels.iter().cloned().collect::<BTreeSet<_>>().into_iter().collect();
    let mut seen: BTreeSet<Vec<i64>> = known.iter().cloned().collect();
    let mut next = 0;
    while next < known.len() {
        for other in 0..next {
            for between in labels_between(&known[other].clone(), &known[next].clone()) {
                if seen.insert(between.label.clone()) {
                    known.push(between.label);
                }
            }
            if known.len() > LIMIT {
                return Err(SplineError::StepLimit {
                    what: "number of labels",
                    value: known.len(),
                    limit: LIMIT,
                });
            }
        }
        next += 1;
    }
    Ok(seen.into_iter().collect())
}

/// The common indices, and the one that only the first and only the second has.
fn single_difference(first: &[i64], second: &[i64]) -> Option<(Vec<i64>, i64, i64)> {
    if first.len() != second.len() {
        return None;
    }
    let (mut common, mut only) = (Vec::new(), [None, None]);
    let (mut i, mut j) = (0, 0);
    while i < first.len() || j < second.len() {
        let (a, b) = (first.get(i), second.get(j));
        if a.is_some() && a == b {
            common.extend(a);
            i += 1;
            j += 1;
            continue;
        }
        // The smaller of both has no partner.
        let (slot, value) = if b.is_none() || a.is_some_and(|a| b.is_some_and(|b| a < b)) {
            i += 1;
            (0, a)
        } else {
            j += 1;
            (1, b)
        };
        if only[slot].replace(*value?).is_some() {
            return None;
        }
    }
    Some((common, only[0]?, only[1]?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::any_spline;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_blossom_is_symmetric_affine_and_diagonal(
            spline in any_spline(1..=9), at in 0.0..1.0_f64, shares in prop::collection::vec(0.0..1.0_f64, 10), t in -1.0..2.0_f64,
        ) {
            let (left, right) = spline.space().parameter_interval();
            let x = left.mix(right, at);
            let span = spline.space().span(x).unwrap();
            let (n, knots) = (spline.degree(), spline.space().evaluation_knots());
            let arguments: Vec<f64> = shares[..n].iter().map(|&share| knots[span].mix(knots[span + 1], share)).collect();
            let value = spline.blossom(span, &arguments).unwrap();
            let reversed: Vec<f64> = arguments.iter().rev().copied().collect();
            prop_assert!((spline.blossom(span, &reversed).unwrap() - value).norm() < 1e-12, "symmetric");
            let other = knots[span].mix(knots[span + 1], shares[n]);
            let with = |last: f64| {
                let mut arguments = arguments.clone();
                arguments[n / 2] = last;
                spline.blossom(span, &arguments).unwrap()
            };
            let mixed = with(arguments[n / 2].mix(other, t));
            prop_assert!((value.mix(with(other), t) - mixed).norm() < 1e-11, "affine");
            let diagonal = spline.blossom(span, &vec![x; n]).unwrap();
            prop_assert!((diagonal - spline.evaluate(x).unwrap()).norm() < 1e-12, "diagonal");
        }

        #[test]
        fn coefficients_are_blossoms_of_their_knots(spline in any_spline(1..=7), at in 0.0..1.0_f64) {
            let (left, right) = spline.space().parameter_interval();
            let span = spline.space().span(left.mix(right, at)).unwrap();
            let (n, knots) = (spline.degree(), spline.space().evaluation_knots());
            for k in span - n..=span {
                let error = (spline.blossom(span, &knots[k + 1..=k + n]).unwrap() - spline.evaluation_coefficient(k)).norm();
                // The knots of a coefficient reach beyond the interval: the blossom extrapolates.
                prop_assert!(error < 1e-10, "coefficient {k}: off by {error}");
            }
        }
    }

    #[test]
    fn labels_name_blossom_values() {
        let between = labels_between(&[1, 2, 3, 4], &[2, 3, 4, 5]);
        assert_eq!(between[0], LabelBetween { label: vec![2, 2, 3, 4], share: 0.25 }, "{between:?}");
        assert_eq!(labels_between(&[5, 6], &[1, 6])[0].label, [4, 6], "from the first to the second");
        assert!(labels_between(&[1, 2], &[3, 4]).is_empty(), "two indices differ");
        assert!(labels_between(&[1, 2], &[1, 2]).is_empty(), "none differs");
        let wide = label_closure(&[vec![0, 0], vec![0, 1_000_000]]).unwrap_err();
        assert_eq!(wide.name(), "StepLimit", "too many");
    }
}
