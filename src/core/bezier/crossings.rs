//! Variation diminution: no line or plane crosses a Bezier curve more often than its control polygon.
//!
//! The distances `a·cₖ − d` of the control points are the Bernstein coefficients of the distance of the curve; their sign changes are the crossings of
//! the polygon and bound the zeros. Course: section 2.2.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;
use crate::core::polynomial::sign_changes;
use crate::core::root_finding::{Zero, Zeros, bernstein_zeros};

/// Crossings of a line (a plane in space) with a curve and with its control polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossings {
    /// How often the control polygon crosses; corners on the line are passed over.
    pub polygon: usize,
    /// Where the curve meets the line: parameters with the order of contact; `Everywhere` for a curve in the line.
    pub curve: Zeros,
}

impl<P: Point> BezierCurve<P> {
    /// Crossings with `{x : normal·x = offset}`.
    ///
    /// # Errors
    ///
    /// `NonFinite` for a normal or offset that is not finite or makes a product overflow.
    pub fn crossings(&self, normal: P, offset: f64) -> Result<Crossings, BezierError> {
        let distance = |point: P| {
            (0..P::DIMENSION).map(|i| normal.coordinate(i) * point.coordinate(i)).sum::<f64>() - offset
        };
        let distances: Vec<f64> = self.points().iter().map(|&point| distance(point)).collect();
        if let Some(index) = distances.iter().position(|value| !value.is_finite()) {
            return Err(BezierError::NonFinite { what: "distance of point", index, value: distances[index] });
        }
        let size = self.points().iter().map(|point| point.norm()).fold(0.0, f64::max);
        let noise = 2.0 * f64::EPSILON * (normal.norm() * size + offset.abs());
        let (a, b) = self.interval();
        let curve = match bernstein_zeros(&distances, noise) {
            Zeros::Isolated(zeros) => Zeros::Isolated(
                zeros.into_iter().map(|zero| Zero { at: a.mix(b, zero.at), ..zero }).collect(),
            ),
            Zeros::Everywhere => Zeros::Everywhere,
        };
        Ok(Crossings { polygon: sign_changes(&distances), curve })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_polygon_is_crossed_at_least_as_often(
            points in prop::collection::vec((-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), 1..10),
            angle in 0.0..6.3_f64, offset in -3.0..3.0_f64,
        ) {
            let curve = BezierCurve::on_interval(points, (2.0, 5.0)).unwrap();
            let normal = DVec2::from_angle(angle);
            let crossings = curve.crossings(normal, offset).unwrap();
            let count: usize = crossings.curve.isolated().iter().map(|zero| zero.multiplicity).sum();
            prop_assert!(count <= crossings.polygon && (crossings.polygon - count).is_multiple_of(2), "{crossings:?}");
            for zero in crossings.curve.isolated() {
                let gap = normal.dot(curve.evaluate(zero.at).unwrap()) - offset;
                prop_assert!(gap.abs() < 1e-12, "off the line by {gap}");
            }
        }

        #[test]
        fn convex_polygons_make_convex_curves(angles in prop::collection::vec(0.0..3.0_f64, 3..9)) {
            let mut angles = angles;
            angles.sort_by(f64::total_cmp);
            let curve = BezierCurve::new(angles.into_iter().map(DVec2::from_angle).collect()).unwrap();
            let samples: Vec<DVec2> = (0..=60).map(|i| curve.evaluate(f64::from(i) / 60.0).unwrap()).collect();
            for triple in samples.windows(3) {
                let turn = (triple[1] - triple[0]).perp_dot(triple[2] - triple[1]);
                prop_assert!(turn >= -1e-15, "turns right by {turn}");
            }
        }
    }

    #[test]
    fn planes_and_contained_curves() {
        let twisted = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0], [3.0, 3.0, 3.0]].map(DVec3::from);
        let curve = BezierCurve::new(twisted.to_vec()).unwrap();
        let contact = curve.crossings(DVec3::Z, 0.0).unwrap();
        assert_eq!(
            contact.curve.isolated(),
            [Zero { at: 0.0, multiplicity: 3 }],
            "osculating plane of (t, t², t³)"
        );
        let flat = BezierCurve::new(vec![DVec2::ZERO, DVec2::X]).unwrap();
        assert_eq!(flat.crossings(DVec2::Y, 0.0).unwrap().curve, Zeros::Everywhere, "in the line");
        assert_eq!(flat.crossings(DVec2::NAN, 0.0).unwrap_err().name(), "NonFinite", "no normal");
    }
}
