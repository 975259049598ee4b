//! The matrix that takes coefficients to those over more knots.
//!
//! `c̃ = A c` with `A[j][k]` the share of `cₖ` in `c̃ⱼ`, from the Oslo algorithm: `c̃ⱼ` is the blossom of the old spline at the new knots
//! `τ̃ⱼ₊₁, …, τ̃ⱼ₊ₙ`. Rows are convex combinations of `n + 1` neighbours.
//!
//! E. Cohen, T. Lyche, R. Riesenfeld, *Discrete B-splines and subdivision techniques*, 1980. Course: section 6.3.

use crate::core::bspline::{SplineError, SplineSpace};
use crate::core::linear_system::BandMatrix;

/// The refinement matrix from an open space to one with the same degree and interval whose knots contain the old ones.
///
/// # Errors
///
/// `SizeMismatch` for different degrees; `NotInSpace` if one space is periodic, or if a knot of `from` is missing or differs in `to`.
pub fn refinement_matrix(from: &SplineSpace, to: &SplineSpace) -> Result<BandMatrix, SplineError> {
    let n = from.degree();
    if to.degree() != n {
        return Err(SplineError::SizeMismatch {
            what: "is the degree, which",
            expected: n,
            found: to.degree(),
        });
    }
    if from.is_periodic() || to.is_periodic() {
        let reason = "the matrix is for open spaces; unroll periodic ones".to_owned();
        return Err(SplineError::NotInSpace { reason });
    }
    let (old, new) = (from.knots(), to.knots());
    check_contained(from, to)?;
    let mut matrix = BandMatrix::with_capacity(to.dimension(), from.dimension(), n + 1);
    // n more knots on the left, so that every new B-spline starts in an interval with n + 1 old ones; the additional ones have no share.
    let before = (1..=n).rev().map(|i| old[0] - i as f64 * (old[n + 1] - old[n]));
    let padded: Vec<f64> = before.chain(old.iter().copied()).collect();
    let mut row = vec![0.0; n + 1];
    let mut span = n;
    for j in 0..to.dimension() {
        while span + 1 < n + from.dimension() && padded[span + 1] <= new[j] {
            span += 1;
        }
        // Discrete B-splines of degree 0, 1, … over the knots at `span`, with one new knot in each step. They are not negative;
        // rounding may say otherwise where they vanish.
        row.fill(0.0);
        row[0] = 1.0;
        for level in 1..=n {
            let x = new[j + level];
            let mut from_left = 0.0;
            for i in 0..level {
                let (left, right) = (padded[span + 1 + i - level], padded[span + 1 + i]);
                let share = row[i] / (right - left);
                row[i] = (from_left + (right - x) * share).max(0.0);
                from_left = (x - left) * share;
            }
            row[level] = from_left.max(0.0);
        }
        // Entry i belongs to coefficient span − 2n + i.
        let missing = (2 * n).saturating_sub(span);
        row.rotate_left(missing);
        row[n + 1 - missing..].fill(0.0);
        matrix
            .push_row((span + missing) - 2 * n, &row)
            .map_err(|error| SplineError::NotInSpace { reason: error.to_string() })?;
    }
    Ok(matrix)
}

/// Every inner knot of `from` stands at least as often in `to`; ends and outer knots are the same.
fn check_contained(from: &SplineSpace, to: &SplineSpace) -> Result<(), SplineError> {
    let (old, new) = (from.knots(), to.knots());
    let mut place = 0;
    for &knot in old {
        while new.get(place).is_some_and(|&other| other < knot) {
            place += 1;
        }
        if new.get(place).is_none_or(|&other| other > knot) {
            return Err(SplineError::NotInSpace { reason: format!("the knot {knot} is missing") });
        }
        place += 1;
    }
    if from.parameter_interval() != to.parameter_interval()
        || old[0] > new[0]
        || old[old.len() - 1] < new[new.len() - 1]
    {
        return Err(SplineError::NotInSpace { reason: "the intervals differ".to_owned() });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::any_spline;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_are_convex_and_give_the_refined_coefficients(
            spline in any_spline(1..=12), shares in prop::collection::vec(0.001..0.999_f64, 1..12), at_knots in any::<bool>(),
        ) {
            let spline = spline.unroll().unwrap();
            let (left, right) = spline.space().parameter_interval();
            let place = |share: &f64| {
                let t = left + (right - left) * share;
                if at_knots && t.round() > left && t.round() < right { t.round() } else { t }
            };
            let new: Vec<f64> = shares.iter().map(place).collect();
            let Ok(refined) = spline.insert_knots(&new) else { return Ok(()) };
            let matrix = refinement_matrix(spline.space(), refined.space()).unwrap();
            for i in 0..matrix.rows() {
                let (_, row) = matrix.row(i);
                prop_assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-13, "row {i}: {row:?}");
                prop_assert!(row.iter().all(|&entry| entry >= 0.0), "row {i}: {row:?}");
            }
            for (a, b) in matrix.multiply(spline.coefficients()).unwrap().iter().zip(refined.coefficients()) {
                prop_assert!(a.distance(*b) < 1e-12, "{a} and {b}");
            }
        }
    }

    #[test]
    fn spaces_that_are_not_nested_are_refused() {
        let space = |knots: &[f64]| SplineSpace::new(1, knots.to_vec()).unwrap();
        let from = space(&[-1.0, 0.0, 1.0, 2.0, 3.0]);
        for (to, name) in [
            (space(&[-1.0, 0.0, 0.5, 2.0, 3.0]), "NotInSpace"),
            (space(&[-1.0, 0.0, 1.0, 2.0, 3.0, 4.0]), "NotInSpace"),
            (SplineSpace::uniform(2, 0.0, 2.0, 2).unwrap(), "SizeMismatch"),
            (SplineSpace::periodic(1, 2.0, vec![0.0, 1.0]).unwrap(), "NotInSpace"),
        ] {
            assert_eq!(refinement_matrix(&from, &to).unwrap_err().name(), name, "{to:?}");
        }
    }
}
