//! Polygons in place of spline curves, within a tolerance that is proved.
//!
//! Where the bound of section 6.2 exceeds the tolerance, the widest knot intervals around are halved by knot insertion until it does not: each point of the
//! curve is then within the tolerance of the control polygon at the same parameter. Every halving divides the bound by about 4.
//! Course: sections 6.2 and 6.3.

use crate::core::bspline::{Spline, SplineError, SplineSpace};
use crate::core::point::Point;
use crate::core::spline_curve::editing::clamped;

/// Most vertices of a polygon.
const MAX_VERTICES: usize = 1 << 22;

/// A polygon near a curve, as a function of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessellation<P> {
    /// Increasing parameters of the vertices, from the left to the right end of D.
    pub parameters: Vec<f64>,
    /// The vertices.
    pub points: Vec<P>,
    /// The Euclidean distance of curve and polygon at equal parameters is not larger, up to rounding.
    pub bound: f64,
}

impl<P: Point> Spline<P> {
    /// A polygon within `tolerance` of the curve over D, or over one period.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `StepLimit` if the polygon would need more than 2²² vertices, or intervals too small to be halved.
    pub fn tessellate(&self, tolerance: f64) -> Result<Tessellation<P>, SplineError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance });
        }
        // End-interpolating knots: outer knots would keep the bounds of the end intervals large.
        let mut spline = clamped(self)?;
        let bound = loop {
            let bounds = spline.distance_bounds(P::norm);
            let bound = bounds.iter().copied().fold(0.0, f64::max);
            if bound <= tolerance {
                break bound;
            }
            let middles = wide_middles(spline.space(), &bounds, tolerance);
            let value = spline.coefficients().len() + middles.len();
            if middles.is_empty() || value > MAX_VERTICES {
                return Err(SplineError::StepLimit {
                    what: "number of vertices",
                    value,
                    limit: MAX_VERTICES,
                });
            }
            spline = spline.insert_knots(&middles)?;
        };
        let (left, right) = spline.space().parameter_interval();
        let (mut parameters, mut points) = (vec![left], vec![spline.control_polygon_at(left)?]);
        for (k, &point) in spline.coefficients().iter().enumerate() {
            let at = spline.knot_average(k);
            if left < at && at < right {
                parameters.push(at);
                points.push(point);
            }
        }
        parameters.push(right);
        points.push(spline.control_polygon_at(right)?);
        Ok(Tessellation { parameters, points, bound })
    }
}

/// The middles of the intervals that keep a bound above the tolerance: of those whose knots it sees, all at least half as wide as the
/// widest.
fn wide_middles(space: &SplineSpace, bounds: &[f64], tolerance: f64) -> Vec<f64> {
    let (n, m, knots) = (space.degree(), space.dimension(), space.knots());
    let mut halved = vec![false; m + 1];
    let intervals = (n..m).filter(|&l| knots[l] < knots[l + 1]);
    for (l, _) in intervals.zip(bounds).filter(|&(_, &bound)| bound > tolerance) {
        let seen = n.max(l + 1 - n)..m.min(l + n);
        let width = |k: usize| knots[k + 1] - knots[k];
        let widest = seen.clone().map(width).fold(0.0, f64::max);
        for k in seen.filter(|&k| width(k) >= 0.5 * widest) {
            halved[k] = true;
        }
    }
    let middles =
        (n..m).filter(|&k| halved[k]).map(|k| (knots[k], knots[k].mix(knots[k + 1], 0.5), knots[k + 1]));
    middles.filter(|(a, middle, b)| a < middle && middle < b).map(|(_, middle, _)| middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::samples::any_spline;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn the_curve_is_within_the_tolerance(spline in any_spline(1..=8), exponent in -3.0..1.0_f64) {
            let tolerance = 10_f64.powf(exponent);
            let polygon = spline.tessellate(tolerance).unwrap();
            prop_assert!(polygon.bound <= tolerance, "bound {}", polygon.bound);
            let ends = (polygon.parameters[0], polygon.parameters[polygon.parameters.len() - 1]);
            prop_assert_eq!(ends, spline.space().parameter_interval(), "from end to end");
            prop_assert!(polygon.parameters.windows(2).all(|pair| pair[0] < pair[1]), "increasing");
            for (pair, points) in polygon.parameters.windows(2).zip(polygon.points.windows(2)) {
                for share in [0.0, 0.3, 0.5, 0.8] {
                    let curve = spline.evaluate(pair[0].mix(pair[1], share)).unwrap();
                    let distance = curve.distance(points[0].mix(points[1], share));
                    prop_assert!(distance <= polygon.bound + 1e-12, "{distance} > {}", polygon.bound);
                }
            }
        }
    }

    #[test]
    fn tolerances_must_be_positive_and_possible() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let parabola = Spline::new(space, vec![0.0, 0.0, 1.0]).unwrap();
        for tolerance in [0.0, -1.0, f64::NAN] {
            assert_eq!(parabola.tessellate(tolerance).unwrap_err().name(), "InvalidTolerance", "{tolerance}");
        }
        assert_eq!(parabola.tessellate(1e-18).unwrap_err().name(), "StepLimit", "beyond 2^22 vertices");
        // Doubled knots halve the distance: four times the tolerance, half the vertices.
        let count = |tolerance: f64| parabola.tessellate(tolerance).unwrap().points.len() as f64;
        assert!((count(1e-6) / count(4e-6) - 2.0).abs() < 0.1, "{} and {}", count(1e-6), count(4e-6));
    }
}
