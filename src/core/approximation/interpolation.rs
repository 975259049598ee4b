//! Interpolation with splines of any degree, open and periodic, of values and derivatives.
//!
//! Course: section 5.5.

use crate::core::approximation::collocation::Collocation;
use crate::core::approximation::data::{check_finite, check_length};
use crate::core::approximation::error::ApproximationError;
use crate::core::approximation::sites::check_sites;
use crate::core::bspline::{Spline, SplineSpace};
use crate::core::point::Point;

/// The spline of `space` with `p(tᵢ) = values[i]` at the `sites`.
///
/// In an open space the `j`-th further copy of a site takes the derivative of order `j`. In a periodic space the sites lie in one period, anywhere on the line.
///
/// # Errors
///
/// Those of [`check_sites`](super::check_sites) in its order; `SizeMismatch` and `NonFinite` for the values; `Singular` in a periodic space (for equally spaced knots of even degree and an even
/// number of sites at the knots, for example).
pub fn interpolate<P: Point>(
    space: SplineSpace,
    sites: &[f64],
    values: &[P],
) -> Result<Spline<P>, ApproximationError> {
    check_sites(&space, sites)?;
    check_length("values", sites.len(), values.len())?;
    check_finite("value", values)?;
    let mut coefficients = values.to_vec();
    Collocation::new(&space, sites)?.solve(&mut coefficients)?;
    Ok(Spline::new(space, coefficients)?)
}

/// The bound `(1 + ‖A⁻¹‖) dist(f, S)` of the error of interpolation, from the norm that [`inverse_norm`](super::inverse_norm) gives and any bound of the distance of `f` from the
/// spline space, such as the error of a quasi-interpolant.
pub fn interpolation_error_bound(inverse_norm: f64, distance: f64) -> f64 {
    (1.0 + inverse_norm) * distance
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::approximation::collocation::{collocation_matrix, inverse_norm};
    use crate::core::approximation::error::ApproximationError;
    use crate::core::approximation::sites::{averaged_knots, not_a_knot_space};
    use crate::core::bspline::Side;
    use glam::DVec2;
    use proptest::prelude::*;

    prop_compose! {
        /// A space with knots of all multiplicities, open or periodic.
        fn any_space()(degree in 1_usize..7, closed in any::<bool>())(
            degree in Just(degree),
            closed in Just(closed),
            gaps in prop::collection::vec(prop_oneof![Just(0_u8), Just(1), Just(1), Just(3)], 2 * degree + 1..2 * degree + 8),
        ) -> Option<SplineSpace> {
            let mut knots = vec![-1.0];
            for gap in gaps {
                knots.push(knots[knots.len() - 1] + f64::from(gap));
            }
            let period = knots[knots.len() - 1] + 2.0;
            if closed { SplineSpace::periodic(degree, period, knots) } else { SplineSpace::new(degree, knots) }.ok()
        }
    }

    fn coefficients(count: usize) -> Vec<f64> {
        (0..count).map(|k| (k * k * 3 % 7) as f64 - 3.0).collect()
    }

    proptest! {
        #[test]
        fn a_spline_of_the_space_is_given_back(space in any_space(), shift in 0.1..0.9_f64) {
            let Some(space) = space else { return Ok(()) };
            let spline = Spline::new(space.clone(), coefficients(space.dimension())).unwrap();
            let (left, right) = space.parameter_interval();
            let mut sites = space.greville_abscissae();
            if space.is_periodic() {
                sites.iter_mut().for_each(|site| *site += 0.01 * shift);
            } else {
                sites.iter_mut().for_each(|site| *site = site.clamp(left, right));
            }
            // Near an end with simple exterior knots several averages may fall on the end itself; then the sites are no data for this test.
            if sites.windows(2).any(|pair| pair[1] <= pair[0]) {
                return Ok(());
            }
            let values: Vec<f64> = sites.iter().map(|&x| spline.evaluate(x).unwrap()).collect();
            let found = match interpolate(space.clone(), &sites, &values) {
                Ok(found) => found,
                // Periodic interpolation may be singular, and nearly so.
                Err(error) => {
                    prop_assert!(space.is_periodic() && error.name() == "Singular", "{}", error);
                    return Ok(());
                }
            };
            let norm = inverse_norm(&space, &sites).unwrap();
            prop_assert!(norm >= 1.0 - 1e-9, "rows sum to one, so that the norm is at least 1: {}", norm);
            for (a, b) in found.coefficients().iter().zip(spline.coefficients()) {
                prop_assert!((a - b).abs() < 1e-13 * norm, "{} and {}, norm {}", a, b, norm);
            }
        }

        #[test]
        fn the_check_agrees_with_exact_determinants(
            gaps in prop::collection::vec(0_u8..3, 9), marks in prop::collection::vec(0_u8..=16, 6),
        ) {
            // Degree 2, at most 6 B-splines; knots and sites are multiples of 1/2, and everything is exact.
            let mut knots = vec![0.0];
            for gap in &gaps {
                knots.push(knots[knots.len() - 1] + f64::from(*gap));
            }
            let Ok(space) = SplineSpace::new(2, knots[..8].to_vec()) else { return Ok(()) };
            let (left, right) = space.parameter_interval();
            let mut sites: Vec<f64> = marks.iter().map(|&mark| left + (right - left) * f64::from(mark) / 16.0).collect();
            sites.sort_by(f64::total_cmp);
            sites.truncate(space.dimension());
            if sites.windows(2).any(|pair| pair[0] >= pair[1]) {
                return Ok(());
            }
            let matrix = collocation_matrix(&space, &sites).unwrap();
            let m = matrix.rows();
            let rows: Vec<Vec<f64>> = (0..m).map(|i| (0..m).map(|j| matrix.get(i, j)).collect()).collect();
            let determinant = determinant(&rows);
            let check = check_sites(&space, &sites);
            prop_assert!(determinant > -1e-15, "totally positive: {}", determinant);
            match check {
                Ok(()) => prop_assert!(determinant > 1e-12, "{:?} {:?}: {}", space.knots(), sites, determinant),
                Err(error) => {
                    prop_assert_eq!(error.name(), "SchoenbergWhitney");
                    prop_assert!(determinant.abs() < 1e-15, "{:?} {:?}: {}", space.knots(), sites, determinant);
                }
            }
        }

        #[test]
        fn knots_made_for_the_sites_serve_them(
            degree in 1_usize..8, gaps in prop::collection::vec(0.05..1.0_f64, 12..20),
        ) {
            let mut sites = vec![0.3];
            for gap in gaps {
                sites.push(sites[sites.len() - 1] + gap);
            }
            let points: Vec<DVec2> = sites.iter().map(|&x| DVec2::new(x.powi(degree as i32), (3.0 * x).sin())).collect();
            for space in [averaged_knots(degree, &sites).unwrap(), not_a_knot_space(degree, &sites).unwrap()] {
                let norm = inverse_norm(&space, &sites).unwrap();
                let curve = interpolate(space, &sites, &points).unwrap();
                let size = points.iter().fold(0.0_f64, |size, p| size.max(p.length()));
                for (&x, point) in sites.iter().zip(&points) {
                    let gap = (curve.evaluate(x).unwrap() - *point).length();
                    prop_assert!(gap < 1e-13 * norm * size, "at {}: {}, norm {}", x, gap, norm);
                }
                let middle = 0.5 * (sites[3] + sites[4]);
                let power = middle.powi(degree as i32);
                let found = curve.evaluate(middle).unwrap().x;
                prop_assert!((found - power).abs() < 1e-12 * norm * size, "x^n is reproduced: {} and {}", found, power);
            }
        }
    }

    /// By the formula of Leibniz, for small matrices.
    fn determinant(rows: &[Vec<f64>]) -> f64 {
        if rows.is_empty() {
            return 1.0;
        }
        let minor = |column: usize| -> Vec<Vec<f64>> {
            let without = |row: &Vec<f64>| [&row[..column], &row[column + 1..]].concat();
            rows[1..].iter().map(without).collect()
        };
        (0..rows.len())
            .filter(|&j| rows[0][j] != 0.0)
            .map(|j| if j % 2 == 0 { 1.0 } else { -1.0 } * rows[0][j] * determinant(&minor(j)))
            .sum()
    }

    #[test]
    fn one_solution_gives_the_norm_of_a_totally_positive_inverse() {
        let space =
            SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.5, 4.0, 4.5, 7.0, 7.0, 7.0, 8.0]).unwrap();
        let sites = space.greville_abscissae();
        let norm = inverse_norm(&space, &sites).unwrap();
        let mut sums = vec![0.0; sites.len()];
        for j in 0..sites.len() {
            let unit: Vec<f64> = (0..sites.len()).map(|i| f64::from(u8::from(i == j))).collect();
            let column = interpolate(space.clone(), &sites, &unit).unwrap();
            sums.iter_mut().zip(column.coefficients()).for_each(|(sum, c)| *sum += c.abs());
        }
        let slow = sums.into_iter().fold(0.0, f64::max);
        assert!((norm - slow).abs() < 1e-13 * slow, "{norm} and {slow}");
        assert_eq!(interpolation_error_bound(3.0, 0.5), 2.0, "(1 + 3)/2");
    }

    #[test]
    fn derivatives_at_repeated_sites_inside_and_at_both_ends() {
        let space =
            SplineSpace::new(4, vec![-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 4.0, 5.0])
                .unwrap();
        let sites = [0.0, 0.0, 0.0, 1.0, 1.0, 1.5, 3.0, 4.0, 4.0];
        let spline = Spline::new(space.clone(), coefficients(9)).unwrap();
        let mut copies = 0;
        let mut data = Vec::new();
        for (i, &x) in sites.iter().enumerate() {
            copies = if i > 0 && sites[i - 1] >= x { copies + 1 } else { 0 };
            data.push(spline.derivatives(x, copies, Side::Right).unwrap()[copies]);
        }
        let found = interpolate(space.clone(), &sites, &data).unwrap();
        for (a, b) in found.coefficients().iter().zip(spline.coefficients()) {
            assert!((a - b).abs() < 1e-12, "{a} and {b}");
        }
        assert!(inverse_norm(&space, &sites).unwrap() > 1.0, "computed column by column");
        let error = check_sites(&space, &[0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0, 3.0, 4.0]).unwrap_err();
        let name =
            matches!(error, ApproximationError::KnotMultiplicityTooHigh { index: 3, sites: 4, knots: 2, .. });
        assert!(name, "no third derivative at a double knot: {error}");
    }

    #[test]
    fn bad_sites_and_values_are_named() {
        let space = || SplineSpace::uniform(2, 0.0, 2.0, 2).unwrap();
        let name = |sites: &[f64], values: &[f64]| interpolate(space(), sites, values).unwrap_err().name();
        let y = [1.0; 4];
        assert_eq!(name(&[0.0, 1.0, 2.0], &y[..3]), "SizeMismatch", "three sites");
        assert_eq!(name(&[0.0, 0.5, 1.5, 2.0], &y[..3]), "SizeMismatch", "three values");
        assert_eq!(name(&[0.0, 0.5, f64::NAN, 2.0], &y), "NonFinite", "site");
        assert_eq!(name(&[0.0, 0.5, 1.5, 2.0], &[1.0, 1.0, f64::INFINITY, 1.0]), "NonFinite", "value");
        assert_eq!(name(&[0.0, 1.5, 0.5, 2.0], &y), "SitesNotSorted", "unsorted");
        assert_eq!(name(&[0.0, 0.5, 1.5, 2.1], &y), "OutsideInterval", "outside D");
        assert_eq!(
            averaged_knots(3, &[0.0, 1.0, 2.0]).unwrap_err().name(),
            "TooFewData",
            "three sites, degree 3"
        );
        assert_eq!(averaged_knots(3, &[]).unwrap_err().name(), "TooFewData", "none");
        let closed = SplineSpace::periodic(3, 3.0, vec![0.0, 1.0, 2.0]).unwrap();
        let error = interpolate(closed, &[0.0, 1.0, 3.0], &y[..3]).unwrap_err();
        assert_eq!(error.name(), "SitesNotSorted", "more than a period");
    }
}
