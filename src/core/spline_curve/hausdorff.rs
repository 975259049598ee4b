//! The distance of two curves as point sets, by samples.
//!
//! The Hausdorff distance is the largest distance of a point of one curve from the other curve. It does not depend on
//! parametrisations; at equal parameters [`deviation`](crate::core::spline_curve::deviation) bounds it from above.
//! Course: beyond, sections B.3 and B.5.

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::Nurbs;

/// The largest distance, from the other curve, of `samples + 1` points of each curve at equal parameter steps: a lower bound.
///
/// # Errors
///
/// `Empty` for no samples.
pub fn hausdorff_sampled<P: Projective>(
    p: &Nurbs<P>,
    q: &Nurbs<P>,
    samples: usize,
) -> Result<f64, SplineError> {
    if samples == 0 {
        return Err(SplineError::Empty { what: "samples" });
    }
    let mut largest = 0.0_f64;
    for (from, to) in [(p, q), (q, p)] {
        let (left, right) = from.space().parameter_interval();
        for i in 0..=samples {
            let point = from.evaluate(left.mix(right, i as f64 / samples as f64))?;
            largest = largest.max(to.closest_point(point)?.distance);
        }
    }
    Ok(largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::spline_curve::deviation;
    use glam::DVec2;

    #[test]
    fn the_parametrisation_does_not_matter() {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let arc = circle.trimmed(0.0, 1.0).unwrap();
        // Other weights of the same ratio w₁²/(w₀ w₂): the same arc with another speed.
        let weights = vec![1.0, 1.0, 2.0];
        let faster = Nurbs::new(arc.space().clone(), arc.points().to_vec(), weights).unwrap();
        let distance = hausdorff_sampled(&arc, &faster, 40).unwrap();
        assert!(distance < 1e-7, "one arc, {distance}");
        assert!(deviation(&arc, &faster).unwrap().lower > 0.1, "at equal parameters they are apart");
        let larger = Nurbs::circle(DVec2::X, 2.0).unwrap();
        let distance = hausdorff_sampled(&circle, &larger, 64).unwrap();
        assert!((distance - 2.0).abs() < 1e-9, "the far point (3, 0) is 2 away: {distance}");
        assert_eq!(hausdorff_sampled(&arc, &arc, 0).unwrap_err().name(), "Empty", "no samples");
    }
}
