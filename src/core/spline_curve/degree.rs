//! Degree elevation, which keeps the curve, and degree reduction with its certified deviation.
//!
//! Elevation raises every multiplicity in D by one; the new coefficients are means of blossom values (Prautzsch, 1984),
//!
//! ```text
//! c′ₖ = 1/(n+1) Σᵢ P[τ′ₖ₊₁, …, τ′ₖ₊ₙ₊₁ without τ′ₖ₊ᵢ].
//! ```
//!
//! Reduction interpolates at the Greville abscissae of the space of degree `n − 1` with the same breaks and multiplicities one lower
//! (at least 1); it gives an elevated curve back and keeps the ends. A closed curve is reduced by least squares at `n + 1` points of
//! every interval. Course: beyond, section B.1.

use crate::core::bspline::{MAX_DEGREE, Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::{Deviation, Nurbs, deviation};

/// Above this many unknowns the dense system of a closed reduction would take too long.
const MAX_CLOSED_UNKNOWNS: usize = 1000;

/// A curve of one degree less, and how far it is from the one before.
#[derive(Clone, Debug, PartialEq)]
pub struct DegreeReduction<P: Projective> {
    /// The curve of degree `n − 1`.
    pub curve: Nurbs<P>,
    /// Its deviation from the curve of degree `n`.
    pub deviation: Deviation,
}

impl<P: Point> Spline<P> {
    /// The same spline as one of degree `n + 1`. An open one gets end-interpolating knots.
    ///
    /// # Errors
    ///
    /// `StepLimit` above [`MAX_DEGREE`].
    pub fn elevate_degree(&self) -> Result<Self, SplineError> {
        let n = self.degree();
        if n >= MAX_DEGREE {
            return Err(SplineError::StepLimit { what: "degree", value: n + 1, limit: MAX_DEGREE });
        }
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

    /// A spline of degree `n − 1` near this one; see the head of this file.
    ///
    /// # Errors
    ///
    /// `DegreeZero` for degree 1; `StepLimit` for a closed spline with more than 1000 unknowns.
    pub fn reduce_degree(&self) -> Result<Self, SplineError> {
        let n = self.degree();
        if n <= 1 {
            return Err(SplineError::DegreeZero);
        }
        match self.space().period() {
            Some(period) => self.reduce_closed(period),
            None => self.interpolate_in(clamped_space(self.space(), n - 1, |multiplicity| {
                (multiplicity - 1).max(1)
            })?),
        }
    }

    /// The spline of `space`, whose ends interpolate, that agrees with this one at the Greville abscissae.
    fn interpolate_in(&self, space: SplineSpace) -> Result<Self, SplineError> {
        let (left, right) = self.space().parameter_interval();
        let sites: Vec<f64> =
            space.greville_abscissae().into_iter().map(|site| site.clamp(left, right)).collect();
        let mut right_side = sites.iter().map(|&site| self.evaluate(site)).collect::<Result<Vec<P>, _>>()?;
        let (n, m) = (space.degree(), space.dimension());
        let mut rows = Vec::with_capacity(m);
        for &site in &sites {
            rows.push(basis_row(&space, site)?);
        }
        // Gauss without pivoting: the collocation matrix is totally positive (de Boor and Pinkus, 1977). Row i holds the columns
        // first … first + n; elimination with row i touches the rows below that still reach column i.
        for i in 0..m {
            let (pivot_first, pivot_row) = rows[i].clone();
            let pivot = pivot_row.get(i.wrapping_sub(pivot_first)).copied().unwrap_or(0.0);
            if pivot.abs() < 1e-300 {
                return Err(SplineError::NoSolution {
                    reason: format!("the system is singular at site {i}"),
                });
            }
            for below in i + 1..m.min(i + n + 1) {
                let (first, row) = &mut rows[below];
                if *first > i {
                    continue;
                }
                let factor = row[i - *first] / pivot;
                for (offset, &value) in pivot_row.iter().enumerate().skip(i - pivot_first) {
                    let column = pivot_first + offset;
                    // Sorted sites: a row below reaches at least as far to the right as the rows above.
                    if column - *first < row.len() {
                        row[column - *first] -= factor * value;
                    }
                }
                let change = right_side[i] * factor;
                right_side[below] = right_side[below] - change;
            }
        }
        for i in (0..m).rev() {
            let (first, row) = &rows[i];
            let mut value = right_side[i];
            for (offset, &entry) in row.iter().enumerate() {
                let column = first + offset;
                if column > i {
                    value = value - right_side[column] * entry;
                }
            }
            right_side[i] = value * row[i - first].recip();
        }
        Self::new(space, right_side)
    }

    /// Least squares over one period, by the normal equations of a small dense system.
    fn reduce_closed(&self, period: f64) -> Result<Self, SplineError> {
        let n = self.degree();
        let mut knots = Vec::new();
        for knot in self.space().distinct_knots() {
            knots.extend(std::iter::repeat_n(knot.value, (knot.multiplicity - 1).max(1)));
        }
        let space = SplineSpace::periodic(n - 1, period, knots)?;
        let m = space.dimension();
        if m > MAX_CLOSED_UNKNOWNS {
            return Err(SplineError::StepLimit {
                what: "number of control points",
                value: m,
                limit: MAX_CLOSED_UNKNOWNS,
            });
        }
        let mut matrix = vec![vec![0.0; m]; m];
        let mut right_side = vec![P::ZERO; m];
        for pair in self.space().breaks().windows(2) {
            let samples = 2 * n;
            for step in 0..samples {
                let site = pair[0] + (pair[1] - pair[0]) * (step as f64 + 0.5) / samples as f64;
                let weight = pair[1] - pair[0];
                let value = self.evaluate(site)?;
                let (first, row) = basis_row(&space, site)?;
                for (i, &a) in row.iter().enumerate() {
                    let at = space.coefficient_index(first + i);
                    right_side[at] = right_side[at] + value * (a * weight);
                    for (j, &b) in row.iter().enumerate() {
                        matrix[at][space.coefficient_index(first + j)] += a * b * weight;
                    }
                }
            }
        }
        for i in 0..m {
            for below in i + 1..m {
                let factor = matrix[below][i] / matrix[i][i];
                if factor == 0.0 {
                    continue;
                }
                for column in i..m {
                    let entry = matrix[i][column];
                    matrix[below][column] -= factor * entry;
                }
                let change = right_side[i] * factor;
                right_side[below] = right_side[below] - change;
            }
        }
        for i in (0..m).rev() {
            let mut value = right_side[i];
            for column in i + 1..m {
                value = value - right_side[column] * matrix[i][column];
            }
            right_side[i] = value * matrix[i][i].recip();
        }
        Self::new(space, right_side)
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

    /// A curve of degree `n − 1` near this one, with the deviation; see [`Spline::reduce_degree`].
    ///
    /// # Errors
    ///
    /// Those of [`Spline::reduce_degree`]; `WeightNotPositive` if the weights of a rational curve cannot be reduced.
    pub fn reduce_degree(&self) -> Result<DegreeReduction<P>, SplineError> {
        let curve = self.mapped(Spline::reduce_degree, Spline::reduce_degree)?;
        let deviation = deviation(self, &curve)?;
        Ok(DegreeReduction { curve, deviation })
    }
}

/// End-interpolating knots of `degree` over the breaks of an open space, inner multiplicities changed by `change`.
fn clamped_space(
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

/// The `n + 1` B-splines of the evaluation knots that can be nonzero at `x`, and the index of the first.
fn basis_row(space: &SplineSpace, x: f64) -> Result<(usize, Vec<f64>), SplineError> {
    let x = space.reduce(x)?;
    let (span, n, knots) = (space.span(x)?, space.degree(), space.evaluation_knots());
    let mut values = vec![1.0];
    for degree in 1..=n {
        let mut raised = vec![0.0; degree + 1];
        for (j, &value) in values.iter().enumerate() {
            let k = span + 1 - degree + j;
            let gamma = (x - knots[k]) / (knots[k + degree] - knots[k]);
            raised[j] += (1.0 - gamma) * value;
            raised[j + 1] += gamma * value;
        }
        values = raised;
    }
    Ok((span - n, values))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::core::bspline::Side;

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
    fn reduction_gives_an_elevated_curve_back() {
        for closed in [false, true] {
            let control = points(&[(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0), (2.0, -3.0)]);
            let space = if closed {
                SplineSpace::periodic(3, 5.0, vec![0.0, 1.0, 2.0, 3.0, 4.5]).unwrap()
            } else {
                SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 0.7, 2.0, 2.0, 2.0, 3.0]).unwrap()
            };
            let curve = Nurbs::polynomial(space, control).unwrap();
            let back = curve.elevate_degree().unwrap().reduce_degree().unwrap();
            assert!(back.deviation.upper < 1e-12, "closed: {closed}, {:?}", back.deviation);
            assert_eq!(back.curve.space().dimension(), 5, "closed: {closed}");
            for (got, expected) in back.curve.points().iter().zip(curve.points()) {
                assert!(got.distance(*expected) < 1e-11, "closed: {closed}, {got} is not {expected}");
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
#[cfg(test)]
mod probe {
    use crate::core::spline_curve::samples::{any_curve, distance};
    use proptest::prelude::*;
    proptest! {
        #[test]
        fn elevation_keeps_every_curve(curve in any_curve(1..=24)) {
            let raised = curve.elevate_degree().unwrap();
            let error = distance(&curve, &raised);
            prop_assert!(error < 1e-10, "degree {}: off by {error}", curve.degree());
        }
    }
}
