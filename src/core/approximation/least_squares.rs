//! Least squares with splines on given knots: `Σ wᵢ |yᵢ − p(xᵢ)|²` becomes minimal.
//!
//! Course: section 5.6.

use crate::core::approximation::data::{check_finite, check_length, check_weights};
use crate::core::approximation::error::ApproximationError;
use crate::core::bspline::{MAX_DEGREE, Spline, SplineSpace};
use crate::core::linear_system::{BandLeastSquares, CyclicLu};
use crate::core::point::Point;

/// A least squares spline and what it leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquares<P> {
    /// The spline.
    pub spline: Spline<P>,
    /// `Σ wᵢ |yᵢ − p(xᵢ)|²`.
    pub residual: f64,
}

/// The spline of `space` closest to the data in the sense of least squares; all weights 1 if none are given.
///
/// The data may come in any sequence, and several at one site; sorted sites save a sort. Open spaces use Givens rotations, periodic ones the normal
/// equations.
///
/// # Errors
///
/// `SizeMismatch`, `NonFinite`, `WeightNotPositive`, `TooFewData` for fewer data than coefficients, `OutsideInterval` in an open space, `RankDeficient` with the first B-spline
/// that finds no site; in a periodic space `Singular`.
pub fn least_squares<P: Point>(
    space: SplineSpace,
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
) -> Result<LeastSquares<P>, ApproximationError> {
    check_length("values", sites.len(), values.len())?;
    check_finite("site", sites)?;
    check_finite("value", values)?;
    check_weights(sites.len(), weights)?;
    if sites.len() < space.dimension() {
        return Err(ApproximationError::TooFewData {
            what: "data",
            least: space.dimension(),
            found: sites.len(),
        });
    }
    if space.is_periodic() {
        return periodic(space, sites, values, weights);
    }
    if sites.windows(2).all(|pair| pair[0] <= pair[1]) {
        return sorted(space, sites, values, weights);
    }
    let mut sequence: Vec<usize> = (0..sites.len()).collect();
    sequence.sort_by(|&i, &j| sites[i].total_cmp(&sites[j]));
    let reorder = |all: &[f64]| sequence.iter().map(|&i| all[i]).collect::<Vec<_>>();
    let values: Vec<P> = sequence.iter().map(|&i| values[i]).collect();
    sorted(space, &reorder(sites), &values, weights.map(reorder).as_deref())
}

/// Whether data at the `sites`, which must not decrease, determine a spline of the open `space`: some of the sites must satisfy the condition of Schoenberg and Whitney.
///
/// # Errors
///
/// `RankDeficient` with the first B-spline that finds no site left.
pub fn check_determined(space: &SplineSpace, sites: &[f64]) -> Result<(), ApproximationError> {
    let mut next = 0;
    for index in 0..space.dimension() {
        let (left, right) = space.support(index);
        next += sites[next..].partition_point(|&site| site <= left);
        match sites.get(next) {
            Some(&site) if site < right => next += sites[next..].partition_point(|&other| other <= site),
            _ => return Err(ApproximationError::RankDeficient { index, left, right }),
        }
    }
    Ok(())
}

fn sorted<P: Point>(
    space: SplineSpace,
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
) -> Result<LeastSquares<P>, ApproximationError> {
    let (n, m) = (space.degree(), space.dimension());
    let (left, right) = space.parameter_interval();
    if let Some(index) = sites.iter().position(|site| !(left..=right).contains(site)) {
        let value = sites[index];
        return Err(ApproximationError::OutsideInterval { what: "site", index, value, left, right });
    }
    check_determined(&space, sites)?;
    let mut system = BandLeastSquares::new(m, n + 1);
    let mut row = [0.0; MAX_DEGREE + 1];
    let mut span = n;
    for (i, &site) in sites.iter().enumerate() {
        while span + 1 < m && space.knots()[span + 1] <= site {
            span += 1;
        }
        let root = weights.map_or(1.0, |weights| weights[i].sqrt());
        space.write_basis_in_span(span, site, 0, &mut row[..=n]);
        row[..=n].iter_mut().for_each(|entry| *entry *= root);
        system.add(span - n, &mut row[..=n], values[i] * root)?;
    }
    Ok(LeastSquares { residual: system.residual(), spline: Spline::new(space, system.solve()?)? })
}

fn periodic<P: Point>(
    space: SplineSpace,
    sites: &[f64],
    values: &[P],
    weights: Option<&[f64]>,
) -> Result<LeastSquares<P>, ApproximationError> {
    let (n, m) = (space.degree(), space.dimension());
    let mut basis = [0.0; MAX_DEGREE + 1];
    // Row i of the matrix holds the products with the n coefficients before and after i.
    let mut products = vec![0.0; m * (2 * n + 1)];
    let mut right = vec![P::ZERO; m];
    for (i, &site) in sites.iter().enumerate() {
        let weight = weights.map_or(1.0, |weights| weights[i]);
        let first = space.write_active_basis(site, &mut basis[..=n])?;
        for j in 0..=n {
            let row = space.coefficient_index(first + j);
            right[row] = right[row] + values[i] * (weight * basis[j]);
            for k in 0..=n {
                products[row * (2 * n + 1) + n + k - j] += weight * basis[j] * basis[k];
            }
        }
    }
    let column = |index: usize| (index / (2 * n + 1) + index % (2 * n + 1) + n * m - n) % m;
    let triplets: Vec<_> = products
        .iter()
        .enumerate()
        .map(|(index, &entry)| (index / (2 * n + 1), column(index), entry))
        .collect();
    CyclicLu::factor(m, 0, &triplets)?.solve(&mut right)?;
    let spline = Spline::new(space, right)?;
    let mut residual = 0.0;
    for (i, &site) in sites.iter().enumerate() {
        let gap = (values[i] - spline.evaluate(site)?).norm();
        residual += weights.map_or(1.0, |weights| weights[i]) * gap * gap;
    }
    Ok(LeastSquares { spline, residual })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use glam::DVec2;
    use proptest::prelude::*;

    fn spaces() -> [SplineSpace; 3] {
        [
            SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 4.0, 5.0, 5.5, 7.0]).unwrap(),
            SplineSpace::new(1, vec![-1.0, 0.0, 1.0, 3.0, 4.0, 5.0]).unwrap(),
            SplineSpace::periodic(2, 4.0, vec![0.0, 0.5, 1.0, 2.5, 3.0]).unwrap(),
        ]
    }

    proptest! {
        #[test]
        fn residuals_are_orthogonal_to_all_b_splines_in_any_sequence(
            shares in prop::collection::vec((0.0..=1.0_f64, -3.0..3.0_f64, 0.1..4.0_f64), 30..60),
        ) {
            for space in spaces() {
                let (left, right) = space.parameter_interval();
                let sites: Vec<f64> = shares.iter().map(|share| left.mix(right, share.0)).collect();
                let values: Vec<f64> = shares.iter().map(|share| share.1).collect();
                let weights: Vec<f64> = shares.iter().map(|share| share.2).collect();
                let Ok(fit) = least_squares(space.clone(), &sites, &values, Some(&weights)) else { continue };
                let mut gradient = vec![0.0; space.dimension()];
                let (mut basis, n) = ([0.0; MAX_DEGREE + 1], space.degree());
                let mut residual = 0.0;
                for i in 0..sites.len() {
                    let gap = values[i] - fit.spline.evaluate(sites[i]).unwrap();
                    residual += weights[i] * gap * gap;
                    let first = space.write_active_basis(sites[i], &mut basis[..=n]).unwrap();
                    for j in 0..=n {
                        gradient[space.coefficient_index(first + j)] += weights[i] * gap * basis[j];
                    }
                }
                prop_assert!(gradient.iter().all(|g| g.abs() < 1e-10), "{:?}", gradient);
                prop_assert!((residual - fit.residual).abs() < 1e-10 * residual, "{} {}", residual, fit.residual);
            }
        }
    }

    #[test]
    fn data_of_a_curve_of_the_space_give_it_back() {
        for space in spaces() {
            let points = (0..space.dimension()).map(|k| DVec2::new(k as f64, (k * k % 5) as f64)).collect();
            let curve = Spline::new(space.clone(), points).unwrap();
            let (left, right) = space.parameter_interval();
            let sites: Vec<f64> = (0..60).map(|i| left.mix(right, f64::from(i * 37 % 60) / 59.0)).collect();
            let values: Vec<DVec2> = sites.iter().map(|&x| curve.evaluate(x).unwrap()).collect();
            let fit = least_squares(space, &sites, &values, None).unwrap();
            for (a, b) in fit.spline.coefficients().iter().zip(curve.coefficients()) {
                assert!((*a - *b).length() < 1e-11, "{a} and {b}");
            }
            assert!(fit.residual < 1e-24, "{}", fit.residual);
        }
    }

    #[test]
    fn undetermined_coefficients_and_bad_data_are_named() {
        let space = || SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 2.0, 4.0, 4.0, 5.0]).unwrap();
        let error = |sites: &[f64], weights: Option<&[f64]>| {
            least_squares(space(), sites, &vec![1.0; sites.len()], weights).unwrap_err()
        };
        let found = error(&[0.0, 0.5, 1.0, 1.5, 2.0], None);
        assert!(matches!(found, ApproximationError::RankDeficient { index: 3, .. }), "{found}");
        let found = error(&[4.0, 2.5, 2.5, 2.5, 3.0], None);
        assert!(matches!(found, ApproximationError::RankDeficient { index: 0, .. }), "{found}");
        let found = error(&[0.0, 1.0, 1.0, 1.0], None);
        assert!(
            matches!(found, ApproximationError::RankDeficient { index: 2, .. }),
            "one site counts once: {found}"
        );
        assert_eq!(error(&[0.0, 1.0, 3.0], None).name(), "TooFewData", "three data");
        assert_eq!(error(&[0.0, 1.0, 3.0, 4.1], None).name(), "OutsideInterval", "beyond D");
        assert_eq!(error(&[0.0, 1.0, f64::NAN, 4.0], None).name(), "NonFinite", "no number");
        assert_eq!(
            error(&[0.0, 1.0, 3.0, 4.0], Some(&[1.0, 0.0, 1.0, 1.0])).name(),
            "WeightNotPositive",
            "0"
        );
        assert_eq!(error(&[0.0, 1.0, 3.0, 4.0], Some(&[1.0])).name(), "SizeMismatch", "one weight");
    }
}
