//! Degree elevation, which keeps the curve.
//!
//! It raises every multiplicity in D by one; the new coefficients are means of blossom values,
//!
//! ```text
//! c′ₖ = 1/(n+1) Σᵢ P[τ′ₖ₊₁, …, τ′ₖ₊ₙ₊₁ without τ′ₖ₊ᵢ].
//! ```
//!
//! H. Prautzsch, *Degree elevation of B-spline curves*, 1984. Course: beyond, section B.1.

use crate::core::bspline::{MAX_DEGREE, Spline, SplineError, SplineSpace};
use crate::core::linear_system::BandMatrix;
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

impl<P: Point> Spline<P> {
    /// The same spline as one of degree `n + 1`. An open one gets end-interpolating knots.
    ///
    /// # Errors
    ///
    /// `StepLimit` above [`MAX_DEGREE`].
    pub fn elevate_degree(&self) -> Result<Self, SplineError> {
        let n = self.degree();
        check_raised(n, 1)?;
        let raised = match self.space().period() {
            Some(period) => {
                let mut knots = Vec::new();
                for knot in self.space().distinct_knots() {
                    knots.extend(std::iter::repeat_n(knot.value, knot.multiplicity + 1));
                }
                SplineSpace::periodic(n + 1, period, knots)?
            }
            None => clamped_space(self.space(), n + 1, |multiplicity| multiplicity + 1)?,
        };
        let coefficients = (0..raised.dimension()).map(|k| self.elevated_coefficient(&raised, k)).collect();
        Self::new(raised, coefficients)
    }

    /// The same spline as one of degree `n + by`.
    ///
    /// # Errors
    ///
    /// As [`Self::elevate_degree`].
    pub fn elevate_degree_by(&self, by: usize) -> Result<Self, SplineError> {
        check_raised(self.degree(), by)?;
        (0..by).try_fold(self.clone(), |spline, _| spline.elevate_degree())
    }

    fn elevated_coefficient(&self, raised: &SplineSpace, k: usize) -> P {
        let n = self.degree();
        let knots: Vec<f64> = (1..=n + 1).filter_map(|i| raised.knot((k + i) as isize)).collect();
        let middle = knots[0] + 0.5 * (knots[n] - knots[0]);
        // The arguments of a closed spline may lie beyond the period that is written out: everything moves by whole periods.
        let (left, right) = self.space().parameter_interval();
        let shift = self.space().period().map_or(0.0, |period| period * ((middle - left) / period).floor());
        let span = self.space().span((middle - shift).clamp(left, right)).unwrap_or(n);
        let mut sum = P::ZERO;
        for left_out in 0..=n {
            let arguments = (0..=n).filter(|&i| i != left_out).map(|i| knots[i] - shift);
            sum = sum + self.blossom_in_span(span, arguments);
        }
        sum * ((n + 1) as f64).recip()
    }
}

impl<P: Projective> Nurbs<P> {
    /// The same curve as one of degree `n + 1`; see [`Spline::elevate_degree`].
    ///
    /// # Errors
    ///
    /// Those of [`Spline::elevate_degree`].
    pub fn elevate_degree(&self) -> Result<Self, SplineError> {
        self.mapped(Spline::elevate_degree, Spline::elevate_degree)
    }

    /// The same curve as one of degree `n + by`; see [`Spline::elevate_degree_by`].
    ///
    /// # Errors
    ///
    /// Those of [`Spline::elevate_degree_by`].
    pub fn elevate_degree_by(&self, by: usize) -> Result<Self, SplineError> {
        self.mapped(|spline| spline.elevate_degree_by(by), |spline| spline.elevate_degree_by(by))
    }
}

fn check_raised(degree: usize, by: usize) -> Result<(), SplineError> {
    let value = degree.saturating_add(by);
    if value <= MAX_DEGREE {
        Ok(())
    } else {
        Err(SplineError::StepLimit { what: "degree", value, limit: MAX_DEGREE })
    }
}

/// The matrix of [`Spline::elevate_degree`] for the splines of an open space: row `j` holds the shares of the old coefficients in the
/// new coefficient `j`, not negative and with sum 1.
///
/// # Errors
///
/// Those of [`Spline::elevate_degree`]; `NotInSpace` for a periodic space.
pub fn elevation_matrix(space: &SplineSpace) -> Result<BandMatrix, SplineError> {
    if space.is_periodic() {
        let reason = "the matrix is for open spaces; unroll periodic ones".to_owned();
        return Err(SplineError::NotInSpace { reason });
    }
    let (m, width) = (space.dimension(), (2 * space.degree() + 1).min(space.dimension()));
    // Columns that are `width` apart share no row: one spline carries the shares of all of them.
    let mut carried = Vec::with_capacity(width);
    for phase in 0..width {
        let unit = (0..m).map(|k| f64::from(u8::from(k % width == phase))).collect();
        carried.push(Spline::new(space.clone(), unit)?.elevate_degree()?);
    }
    let raised = carried[0].space();
    let mut matrix = BandMatrix::with_capacity(raised.dimension(), m, width);
    let mut least = 0;
    for j in 0..raised.dimension() {
        // The old B-splines around the middle of the new one.
        let (low, high) = raised.support(j);
        let (left, right) = space.parameter_interval();
        let span = space.span(low.mix(high, 0.5).clamp(left, right))?;
        let first = (span + 1).saturating_sub(space.degree() + width.div_ceil(2)).clamp(least, m - width);
        least = first;
        let row: Vec<f64> = (first..first + width).map(|k| carried[k % width].coefficients()[j]).collect();
        matrix
            .push_row(first, &row)
            .map_err(|error| SplineError::NotInSpace { reason: error.to_string() })?;
    }
    Ok(matrix)
}

/// End-interpolating knots of `degree` over the breaks of an open space, inner multiplicities changed by `change`.
pub(super) fn clamped_space(
    space: &SplineSpace,
    degree: usize,
    change: impl Fn(usize) -> usize,
) -> Result<SplineSpace, SplineError> {
    let (left, right) = space.parameter_interval();
    let breaks = space.breaks();
    let mut knots = vec![left - (breaks[1] - left)];
    knots.extend(std::iter::repeat_n(left, degree));
    for &value in &breaks[1..breaks.len() - 1] {
        knots.extend(std::iter::repeat_n(value, change(space.multiplicity(value)).min(degree)));
    }
    knots.extend(std::iter::repeat_n(right, degree));
    knots.push(right + (right - breaks[breaks.len() - 2]));
    SplineSpace::new(degree, knots)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::core::bspline::Side;
    use crate::core::spline_curve::samples::{any_curve, any_spline, distance};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn curves_of_every_kind_stay(curve in any_curve(1..=24)) {
            let raised = curve.elevate_degree().unwrap();
            let error = distance(&curve, &raised);
            prop_assert!(error < 1e-9, "degree {}: off by {error}", curve.degree());
            prop_assert!(raised.weights().iter().all(|&weight| weight > 0.0), "positive weights stay positive");
        }

        #[test]
        fn one_sided_limits_stay_and_twice_is_by_two(spline in any_spline(1..=6), at in 0.0..1.0_f64, at_knot in any::<bool>()) {
            let raised = spline.elevate_degree().unwrap();
            let (left, right) = spline.space().parameter_interval();
            let t = if at_knot { left.mix(right, at).floor().max(left) } else { left.mix(right, at) };
            for side in [Side::Left, Side::Right] {
                let (a, b) = (spline.derivatives(t, 2, side).unwrap(), raised.derivatives(t, 2, side).unwrap());
                for (order, (a, b)) in a.iter().zip(&b).enumerate() {
                    prop_assert!(a.distance(*b) < 1e-8 * a.length().max(10.0), "order {order} at {t} {side:?}: {a}, {b}");
                }
            }
            prop_assert_eq!(raised.elevate_degree().unwrap(), spline.elevate_degree_by(2).unwrap(), "twice");
        }

        #[test]
        fn rows_of_the_matrix_are_convex_and_elevate(spline in any_spline(1..=6)) {
            let spline = spline.unroll().unwrap();
            let matrix = elevation_matrix(spline.space()).unwrap();
            let expected = spline.elevate_degree().unwrap();
            for i in 0..matrix.rows() {
                let (_, row) = matrix.row(i);
                prop_assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-12, "row {i}: {row:?}");
                prop_assert!(row.iter().all(|&entry| entry > -1e-12), "row {i}: {row:?}");
            }
            for (a, b) in matrix.multiply(spline.coefficients()).unwrap().iter().zip(expected.coefficients()) {
                prop_assert!(a.distance(*b) < 1e-10, "{a} and {b}");
            }
        }
    }

    #[test]
    fn polygons_of_repeated_elevation_approach_the_curve() {
        let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 3.0]).unwrap();
        let spline = Spline::new(space, vec![0.0, 3.0, -2.0, 4.0, 1.0]).unwrap();
        let bounds: Vec<f64> = [0, 4, 11]
            .map(|by| {
                let raised = spline.elevate_degree_by(by).unwrap();
                raised.polygon_distances().unwrap().iter().map(|d| d.measured).fold(0.0, f64::max)
            })
            .to_vec();
        // Degrees 3, 7, 14: like 1/n.
        assert!((1.5..3.5).contains(&(bounds[1] / bounds[2])), "{bounds:?}");
        assert_eq!(spline.elevate_degree_by(23).unwrap_err().name(), "StepLimit", "degree 26");
    }

    fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
        list.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
    }

    #[test]
    fn elevated_quadratic_has_the_knots_and_points_of_the_course() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let spline = Spline::new(space, points(&[(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)])).unwrap();
        let raised = spline.elevate_degree().unwrap();
        assert_eq!(raised.space().knots(), [-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0], "knots");
        let third = 1.0 / 3.0;
        let expected = points(&[
            (0.0, 0.0),
            (2.0 * third, 4.0 * third),
            (4.0 * third, 2.0),
            (8.0 * third, 2.0),
            (10.0 * third, 4.0 * third),
            (4.0, 0.0),
        ]);
        for (got, expected) in raised.coefficients().iter().zip(&expected) {
            assert!(got.distance(*expected) < 1e-14, "{got} is not {expected}");
        }
    }

    #[test]
    fn elevated_closed_quadratic_has_the_points_of_the_course() {
        let space = SplineSpace::periodic(2, 6.0, vec![0.0, 0.0, 3.0, 5.0]).unwrap();
        let spline = Spline::new(space, points(&[(0.0, 3.0), (5.0, 3.0), (5.0, 0.0), (0.0, 0.0)])).unwrap();
        let raised = spline.elevate_degree().unwrap();
        assert_eq!(raised.space().knots(), [0.0, 0.0, 0.0, 3.0, 3.0, 5.0, 5.0], "knots");
        let third = 1.0 / 3.0;
        let expected = points(&[
            (0.0, 2.0),
            (1.0, 3.0),
            (13.0 * third, 3.0),
            (5.0, 7.0 * third),
            (5.0, third),
            (10.0 * third, 0.0),
            (0.0, 0.0),
        ]);
        for (got, expected) in raised.coefficients().iter().zip(&expected) {
            assert!(got.distance(*expected) < 1e-14, "{got} is not {expected}");
        }
    }

    #[test]
    fn elevation_keeps_values_and_derivatives_of_an_unclamped_spline_of_every_degree() {
        for n in 1..=11 {
            let knots: Vec<f64> =
                (0..2 * n + 6).map(|k| f64::from(k as u32) + 0.3 * f64::from((k * k % 3) as u32)).collect();
            let space = SplineSpace::new(n, knots).unwrap();
            let coefficients = (0..space.dimension()).map(|k| ((k * 7 + 3) % 11) as f64 - 5.0).collect();
            let spline = Spline::new(space, coefficients).unwrap();
            let raised = spline.elevate_degree().unwrap();
            let (left, right) = spline.space().parameter_interval();
            for step in 0..=60 {
                let x = left + (right - left) * f64::from(step) / 60.0;
                let (a, b) = (
                    spline.derivatives(x, 1, Side::Right).unwrap(),
                    raised.derivatives(x, 1, Side::Right).unwrap(),
                );
                assert!(
                    (a[0] - b[0]).abs() < 1e-11 && (a[1] - b[1]).abs() < 1e-9,
                    "degree {n}, x = {x}: {a:?} {b:?}"
                );
            }
        }
    }

    #[test]
    fn a_rational_quarter_circle_is_elevated_in_homogeneous_form() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let arc =
            Nurbs::new(space, vec![DVec2::X, DVec2::ONE, DVec2::Y], vec![1.0, 0.5_f64.sqrt(), 1.0]).unwrap();
        let raised = arc.elevate_degree().unwrap();
        let weight = (1.0 + 2.0_f64.sqrt()) / 3.0;
        assert!((raised.weights()[1] - weight).abs() < 1e-15, "{:?}", raised.weights());
        assert!((raised.points()[1].y - (2.0 - 2.0_f64.sqrt())).abs() < 1e-15, "{:?}", raised.points());
    }
}
