//! NURBS: `r = p/q` with `p = Σ cₖ wₖ bₖ` and `q = Σ wₖ bₖ`.
//!
//! Cartesian points and weights are kept exactly as given, never normalised. Every algorithm runs on the
//! homogeneous spline with coefficients `(wₖ cₖ, wₖ)` and divides at the end. Course: section 6.1.

use crate::core::bspline::{DeBoorScheme, MAX_DEGREE, Side, Spline, SplineError, SplineSpace};
use crate::core::point::Point as _;
use crate::core::rational_bezier::Projective;

/// A rational spline curve, open or closed; all weights equal make it polynomial.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::bspline::{EndKnots, Side, SplineSpace};
/// use spline_lab::core::spline_curve::Nurbs;
///
/// // A quarter of the unit circle.
/// let space = SplineSpace::from_breaks(2, &[0.0, 1.0], EndKnots::Interpolating)?;
/// let points = vec![DVec2::X, DVec2::ONE, DVec2::Y];
/// let arc = Nurbs::new(space, points, vec![1.0, 0.5_f64.sqrt(), 1.0])?;
/// assert!((arc.evaluate(0.3)?.length() - 1.0).abs() < 1e-15);
/// assert!((arc.curvature(0.3, Side::Right)? - 1.0).abs() < 1e-14);
/// let refined = arc.insert_knots(&[0.25, 0.5])?;
/// assert!((refined.evaluate(0.3)? - arc.evaluate(0.3)?).length() < 1e-15);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs<P: Projective> {
    points: Spline<P>,
    weights: Vec<f64>,
    homogeneous: Spline<P::Homogeneous>,
    /// Whether all weights are the same number; evaluation asks for every point.
    is_polynomial: bool,
}

impl<P: Projective> Nurbs<P> {
    /// The curve with control points `points` and positive `weights`, one for each.
    ///
    /// # Errors
    ///
    /// Those of [`Spline::new`]; `SizeMismatch`, `NonFinite`, `WeightNotPositive` for the weights; `NonFinite` where the
    /// product of a weight and a coordinate overflows.
    pub fn new(space: SplineSpace, points: Vec<P>, weights: Vec<f64>) -> Result<Self, SplineError> {
        let points = Spline::new(space, points)?;
        if weights.len() != points.coefficients().len() {
            let (expected, found) = (points.coefficients().len(), weights.len());
            return Err(SplineError::SizeMismatch { what: "weights", expected, found });
        }
        if let Some(index) = weights.iter().position(|weight| !weight.is_finite()) {
            return Err(SplineError::NonFinite { what: "weight", index, value: weights[index] });
        }
        if let Some(index) = weights.iter().position(|&weight| weight <= 0.0) {
            return Err(SplineError::WeightNotPositive { index, value: weights[index] });
        }
        let lifted =
            points.coefficients().iter().zip(&weights).map(|(point, &weight)| point.lift(weight)).collect();
        let homogeneous = Spline::new(points.space().clone(), lifted)?;
        let is_polynomial = weights.windows(2).all(|pair| pair[0].to_bits() == pair[1].to_bits());
        Ok(Self { points, weights, homogeneous, is_polynomial })
    }

    /// The polynomial curve: all weights 1.
    ///
    /// # Errors
    ///
    /// Those of [`Spline::new`].
    pub fn polynomial(space: SplineSpace, points: Vec<P>) -> Result<Self, SplineError> {
        let weights = vec![1.0; points.len()];
        Self::new(space, points, weights)
    }

    /// The curve whose homogeneous form is `homogeneous`; points and weights are read off it.
    ///
    /// # Errors
    ///
    /// `WeightNotPositive`, `NonFinite`.
    pub fn from_homogeneous(homogeneous: Spline<P::Homogeneous>) -> Result<Self, SplineError> {
        let (space, coefficients) = homogeneous.into_parts();
        let (points, weights) = coefficients.into_iter().map(P::project).unzip();
        Self::new(space, points, weights)
    }

    /// Runs a construction on the control points if all weights are equal, else on the homogeneous spline.
    ///
    /// Control points that come out of the homogeneous construction with unchanged bits keep the Cartesian
    /// coordinates and weights that were given.
    pub(super) fn mapped(
        &self,
        on_points: impl FnOnce(&Spline<P>) -> Result<Spline<P>, SplineError>,
        on_homogeneous: impl FnOnce(&Spline<P::Homogeneous>) -> Result<Spline<P::Homogeneous>, SplineError>,
    ) -> Result<Self, SplineError> {
        if self.is_polynomial() {
            let (space, points) = on_points(&self.points)?.into_parts();
            let weights = vec![self.weights[0]; points.len()];
            return Self::new(space, points, weights);
        }
        let (space, lifted) = on_homogeneous(&self.homogeneous)?.into_parts();
        let old = self.homogeneous.coefficients();
        let mut next = 0;
        let (mut points, mut weights) = (Vec::with_capacity(lifted.len()), Vec::with_capacity(lifted.len()));
        for coefficient in lifted {
            // A construction changes at most a few neighbours between two that it keeps.
            let reach = old.len().min(next + 2 * self.degree() + 2);
            let kept = (next.min(reach)..reach).find(|&k| old[k] == coefficient);
            let (point, weight) = kept.map_or_else(
                || P::project(coefficient),
                |k| (self.points.coefficients()[k], self.weights[k]),
            );
            next = kept.map_or(next, |k| k + 1);
            points.push(point);
            weights.push(weight);
        }
        Self::new(space, points, weights)
    }

    /// The space of the homogeneous spline.
    pub fn space(&self) -> &SplineSpace {
        self.points.space()
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.points.degree()
    }

    /// The control points, as given.
    pub fn points(&self) -> &[P] {
        self.points.coefficients()
    }

    /// The weights, as given.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Whether all weights are the same number, so that the curve is polynomial.
    pub fn is_polynomial(&self) -> bool {
        self.is_polynomial
    }

    /// The spline `Σ cₖ bₖ` of the control points without the weights; the curve itself if [`Self::is_polynomial`].
    pub fn without_weights(&self) -> &Spline<P> {
        &self.points
    }

    /// The homogeneous spline with coefficients `(wₖ cₖ, wₖ)`.
    pub fn homogeneous(&self) -> &Spline<P::Homogeneous> {
        &self.homogeneous
    }

    /// `r(t)`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn evaluate(&self, t: f64) -> Result<P, SplineError> {
        if self.is_polynomial() {
            return self.points.evaluate(t);
        }
        Ok(P::project(self.homogeneous.evaluate(t)?).0)
    }

    /// `r, r′, …` up to order `count`, the limits from `side` at a knot:
    /// `r⁽ʲ⁾ = (p⁽ʲ⁾ − Σᵢ C(j,i) q⁽ⁱ⁾ r⁽ʲ⁻ⁱ⁾)/q`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn derivatives(&self, t: f64, count: usize, side: Side) -> Result<Vec<P>, SplineError> {
        let mut values = vec![P::ZERO; count + 1];
        self.derivatives_into(t, side, &mut values)?;
        Ok(values)
    }

    /// As many of `r, r′, …` as `values` has room for, as [`Self::derivatives`]; does not allocate.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`; `values` then stay as they are.
    pub fn derivatives_into(&self, t: f64, side: Side, values: &mut [P]) -> Result<(), SplineError> {
        if self.is_polynomial() {
            return self.points.derivatives_into(t, side, values);
        }
        // Derivatives of the homogeneous curve above the degree are 0.
        let mut buffer = [P::Homogeneous::ZERO; MAX_DEGREE + 1];
        let lifted = &mut buffer[..values.len().min(self.degree() + 1)];
        self.homogeneous.derivatives_into(t, side, lifted)?;
        let Some(&point) = lifted.first() else { return Ok(()) };
        let weight = |j: usize| lifted[j].coordinate(P::DIMENSION);
        let scale = point.coordinate(P::DIMENSION).recip();
        for j in 0..values.len() {
            let mut numerator = lifted.get(j).map_or(P::ZERO, |&lifted| P::numerator(lifted));
            let mut binomial = 1.0;
            for i in 1..=j.min(lifted.len() - 1) {
                binomial *= (j + 1 - i) as f64 / i as f64;
                numerator = numerator - values[j - i] * (binomial * weight(i));
            }
            values[j] = numerator * scale;
        }
        Ok(())
    }

    /// De Boor's scheme of the homogeneous spline at `t`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn de_boor_scheme(&self, t: f64) -> Result<DeBoorScheme<P::Homogeneous>, SplineError> {
        self.homogeneous.de_boor_scheme(t)
    }
}
