//! Degree reduction of splines, with the certified deviation.
//!
//! The space of degree `n − 1` has the same breaks with multiplicities one lower, at least 1, and end-interpolating knots. The new
//! spline is the best one in the mean-square sense, with its ends kept or free. An elevated spline comes back.
//! Course: beyond, section B.1.

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::degree::clamped_space;
use crate::core::spline_curve::nearest_spline::nearest_spline;
use crate::core::spline_curve::{Deviation, Nurbs, deviation};

/// What happens to the ends of an open spline whose degree is reduced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ReductionEnds {
    /// They stay where they are.
    #[default]
    Fixed,
    /// They move with the rest, which makes the mean-square error smaller.
    Free,
}

/// A curve of one degree less, and how far it is from the one before.
#[derive(Clone, Debug, PartialEq)]
pub struct DegreeReduction<P: Projective> {
    /// The curve of lower degree.
    pub curve: Nurbs<P>,
    /// Its deviation from the curve before.
    pub deviation: Deviation,
}

impl<P: Point> Spline<P> {
    /// The spline of degree `n − 1` nearest to this one in the mean-square sense among those with the same ends.
    ///
    /// # Errors
    ///
    /// `DegreeZero` for degree 1.
    pub fn reduce_degree(&self) -> Result<Self, SplineError> {
        self.reduce_degree_with(ReductionEnds::Fixed)
    }

    /// As [`Self::reduce_degree`] with a choice of the ends, which a closed spline does not have.
    ///
    /// # Errors
    ///
    /// `DegreeZero` for degree 1.
    pub fn reduce_degree_with(&self, ends: ReductionEnds) -> Result<Self, SplineError> {
        let n = self.degree();
        if n <= 1 {
            return Err(SplineError::DegreeZero);
        }
        let lower = |multiplicity: usize| (multiplicity - 1).max(1);
        let space = match self.space().period() {
            None => clamped_space(self.space(), n - 1, lower)?,
            Some(period) => {
                let distinct = self.space().distinct_knots();
                let copies = |knot: &crate::core::bspline::DistinctKnot| {
                    std::iter::repeat_n(knot.value, lower(knot.multiplicity))
                };
                SplineSpace::periodic(n - 1, period, distinct.iter().flat_map(copies).collect())?
            }
        };
        nearest_spline(self, space, [ends == ReductionEnds::Fixed; 2])
    }

    /// The spline of degree `n − 1` that this one is, up to `tolerance` at equal parameters.
    ///
    /// # Errors
    ///
    /// `DegreeZero`; `InvalidTolerance`; `NotInSpace` if the nearest spline of that degree is further away.
    pub fn reduce_degree_exactly(&self, tolerance: f64) -> Result<Self, SplineError>
    where
        P: Projective,
    {
        check_tolerance(tolerance)?;
        let reduced = self.reduce_degree()?;
        let with_weights =
            |spline: &Self| Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec());
        let found = deviation(&with_weights(self)?, &with_weights(&reduced)?)?;
        if found.upper <= tolerance {
            return Ok(reduced);
        }
        let reason =
            format!("the nearest spline of degree {} is up to {:.3e} away", self.degree() - 1, found.upper);
        Err(SplineError::NotInSpace { reason })
    }
}

impl<P: Projective> Nurbs<P> {
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

    /// The curve of the lowest degree that repeated reduction reaches with a certified deviation of at most `tolerance` from this one.
    ///
    /// `None` if the first step is already too far, or the degree 1.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`.
    pub fn reduce_degree_within(&self, tolerance: f64) -> Result<Option<DegreeReduction<P>>, SplineError> {
        check_tolerance(tolerance)?;
        let mut best: Option<DegreeReduction<P>> = None;
        loop {
            let current = best.as_ref().map_or(self, |reduction| &reduction.curve);
            let next = current.mapped(Spline::reduce_degree, Spline::reduce_degree);
            // Degree 1, or weights that are not positive, end the search.
            let Ok(curve) = next else { return Ok(best) };
            let deviation = deviation(self, &curve)?;
            if deviation.upper > tolerance {
                return Ok(best);
            }
            best = Some(DegreeReduction { curve, deviation });
        }
    }
}

fn check_tolerance(tolerance: f64) -> Result<(), SplineError> {
    if tolerance > 0.0 { Ok(()) } else { Err(SplineError::InvalidTolerance { value: tolerance }) }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::core::quadrature::gauss_legendre;
    use crate::core::spline_curve::samples::{any_curve, any_spline, distance};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(96))]
        #[test]
        fn elevated_curves_come_back(curve in any_curve(1..=9)) {
            let back = curve.elevate_degree().unwrap().reduce_degree().unwrap();
            prop_assert!(back.deviation.upper < 1e-9, "{:?}", back.deviation);
            prop_assert_eq!(back.curve.degree(), curve.degree(), "the old degree");
            prop_assert!(distance(&curve, &back.curve) < 1e-9, "off by {}", distance(&curve, &back.curve));
        }

        #[test]
        fn the_bound_holds_and_affine_maps_commute(spline in any_spline(2..=7), factor in 0.1..5.0_f64) {
            let curve = Nurbs::polynomial(spline.space().clone(), spline.coefficients().to_vec()).unwrap();
            let reduced = curve.reduce_degree().unwrap();
            prop_assert!(distance(&curve, &reduced.curve) <= reduced.deviation.upper + 1e-13, "{:?}", reduced.deviation);
            let map = |p: DVec2| DVec2::new(p.y * factor - 3.0, p.x + 2.0 * p.y);
            let mapped = curve.transformed(map).unwrap().reduce_degree().unwrap().curve;
            let expected = reduced.curve.transformed(map).unwrap();
            prop_assert!(distance(&mapped, &expected) < 1e-8 * factor.max(1.0), "off by {}", distance(&mapped, &expected));
        }

        #[test]
        fn no_neighbour_is_better_in_the_mean(spline in any_spline(2..=5), choice in 0_usize..20, step in -0.1..0.1_f64, free in any::<bool>()) {
            let ends = if free { ReductionEnds::Free } else { ReductionEnds::Fixed };
            let best = spline.reduce_degree_with(ends).unwrap();
            let rule = gauss_legendre(8).unwrap();
            let error = |other: &Spline<DVec2>| -> f64 {
                let square = |x: f64| (other.evaluate(x).unwrap() - spline.evaluate(x).unwrap()).length_squared();
                spline.space().breaks().windows(2).map(|ends| rule.integrate(ends[0], ends[1], square)).sum()
            };
            let mut moved = best.coefficients().to_vec();
            let inner = if free || best.space().is_periodic() { 0..moved.len() } else { 1..moved.len() - 1 };
            if inner.is_empty() {
                return Ok(());
            }
            moved[inner.start + choice % inner.len()] += DVec2::new(step, -step);
            let moved = Spline::new(best.space().clone(), moved).unwrap();
            prop_assert!(error(&best) <= error(&moved) * (1.0 + 1e-12) + 1e-12, "{} and {}", error(&best), error(&moved));
        }
    }

    #[test]
    fn reduction_goes_on_while_the_tolerance_allows() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let parabolas = Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::Y, DVec2::ONE, DVec2::X]).unwrap();
        let raised = parabolas.elevate_degree_by(3).unwrap();
        let back = raised.reduce_degree_within(1e-10).unwrap().unwrap();
        assert_eq!(back.curve.degree(), 2, "down to the parabolas");
        assert!(parabolas.reduce_degree_within(1e-3).unwrap().is_none(), "no polygon");
        assert_eq!(
            parabolas.reduce_degree_within(0.0).unwrap_err().name(),
            "InvalidTolerance",
            "tolerance 0"
        );
        let spline = parabolas.without_weights();
        assert_eq!(spline.reduce_degree_exactly(1e-6).unwrap_err().name(), "NotInSpace", "curved");
        let back = spline.elevate_degree().unwrap().reduce_degree_exactly(1e-12).unwrap();
        assert_eq!(back.degree(), 2, "elevated");
    }

    #[test]
    fn closed_curves_may_be_long() {
        let count = 3000;
        let points: Vec<DVec2> =
            (0..count).map(|k| DVec2::from_angle(0.01 * f64::from(k)) * f64::from(k % 7)).collect();
        let curve = Nurbs::closed(points, vec![1.0; 3000], 2).unwrap();
        let raised = curve.without_weights().elevate_degree().unwrap();
        let back = raised.reduce_degree().unwrap();
        for (a, b) in back.coefficients().iter().zip(curve.points()) {
            assert!(a.distance(*b) < 1e-10, "{a} and {b}");
        }
    }
}
