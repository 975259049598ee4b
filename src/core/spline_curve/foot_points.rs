//! All foot points: where the distance of a curve from a given point is stationary.
//!
//! The zeros of the foot polynomials of all pieces, told apart by the signs on both sides. At a corner the distance has a smallest or largest value without
//! being stationary; it counts too. Course: beyond, section B.5.

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::Projective;
use crate::core::spline_curve::piecewise_sign::PiecewiseSign;
use crate::core::spline_curve::{ClosestPoint, ClosestPointTree, Nurbs};

/// What the distance does at a foot point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FootKind {
    /// It is locally smallest.
    Minimum,
    /// It is locally largest.
    Maximum,
    /// It is stationary and goes on growing or falling.
    Flat,
}

/// A foot point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationaryDistance<P> {
    /// Where, and how far.
    pub foot: ClosestPoint<P>,
    /// What the distance does there.
    pub kind: FootKind,
}

impl<P: Projective> ClosestPointTree<P> {
    /// All foot points, by parameter; the ends of an open curve are none unless the distance is stationary there, and then count as flat.
    ///
    /// # Errors
    ///
    /// `NonFinite` if `place` is not finite; `Degenerate` if the distance is constant along a piece.
    pub fn foot_points(&self, place: P) -> Result<Vec<StationaryDistance<P>>, SplineError> {
        self.closest_point(place)?;
        let signs: Vec<_> = self
            .pieces
            .iter()
            .enumerate()
            .map(|(i, piece)| (piece.0.interval, self.signs(i, place)))
            .collect();
        let sign = PiecewiseSign::new(&signs, self.is_closed);
        if let Some(&[parameter, _]) = sign.zero.first() {
            return Err(SplineError::Degenerate { what: "the foot point of a part that begins", parameter });
        }
        let kind = |before: i8, after: i8, is_zero: bool| match (before, after) {
            (-1, 1) => Some(FootKind::Minimum),
            (1, -1) => Some(FootKind::Maximum),
            _ => is_zero.then_some(FootKind::Flat),
        };
        let found = sign.places.iter().filter_map(|place_of| {
            let kind = kind(place_of.before, place_of.after, place_of.is_zero)?;
            let piece = place_of.piece.min(self.pieces.len() - 1);
            let ((a, b), parameter) = (self.pieces[piece].0.interval, place_of.parameter);
            let foot = self.place_at(piece, (parameter - a) / (b - a), place);
            Some(StationaryDistance { foot: ClosestPoint { parameter, ..foot }, kind })
        });
        Ok(found.collect())
    }
}

impl<P: Projective> Nurbs<P> {
    /// All foot points of `place`, see [`ClosestPointTree::foot_points`].
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::spline_curve::{FootKind, Nurbs};
    ///
    /// let feet = Nurbs::circle(DVec2::ZERO, 1.0)?.foot_points(DVec2::new(0.3, 0.4))?;
    /// let kinds: Vec<FootKind> = feet.iter().map(|foot| foot.kind).collect();
    /// assert!(kinds == [FootKind::Minimum, FootKind::Maximum] && feet[1].foot.distance == 1.5);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`ClosestPointTree::foot_points`].
    pub fn foot_points(&self, place: P) -> Result<Vec<StationaryDistance<P>>, SplineError> {
        ClosestPointTree::new(self)?.foot_points(place)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::{EndKnots, Side, SplineSpace};
    use crate::core::spline_curve::samples::any_curve;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn minima_and_maxima_alternate_and_the_way_is_perpendicular(
            curve in any_curve(2..=5), place in prop::array::uniform2(-9.0..9.0_f64).prop_map(DVec2::from),
        ) {
            let Ok(feet) = curve.foot_points(place) else { return Ok(()) };
            prop_assert!(feet.windows(2).all(|pair| pair[0].foot.parameter < pair[1].foot.parameter), "{feet:?}");
            let extrema: Vec<_> = feet.iter().filter(|foot| foot.kind != FootKind::Flat).collect();
            prop_assert!(extrema.windows(2).all(|pair| pair[0].kind != pair[1].kind), "{feet:?}");
            if curve.space().is_periodic() {
                prop_assert!(extrema.len() >= 2 && extrema.len().is_multiple_of(2), "{feet:?}");
            }
            let breaks = curve.space().breaks();
            for foot in feet.iter().map(|foot| foot.foot).filter(|foot| !breaks.contains(&foot.parameter)) {
                let velocity = curve.derivatives(foot.parameter, 1, Side::Right).unwrap()[1];
                let cosine = velocity.dot(place - foot.point);
                prop_assert!(cosine.abs() < 1e-6 * (1.0 + velocity.length_squared()), "{foot:?}: {cosine}");
            }
        }
    }

    #[test]
    fn corners_are_extrema_and_smooth_joints_are_none() {
        let space =
            |degree| SplineSpace::from_breaks(degree, &[0.0, 1.0, 2.0], EndKnots::Interpolating).unwrap();
        let roof = Nurbs::polynomial(space(1), vec![DVec2::ZERO, DVec2::ONE, 2.0 * DVec2::X]).unwrap();
        let feet = roof.foot_points(DVec2::new(1.0, 3.0)).unwrap();
        assert_eq!(
            feet.iter().map(|foot| (foot.foot.parameter, foot.kind)).collect::<Vec<_>>(),
            [(1.0, FootKind::Minimum)]
        );
        let line = [0.0, 0.5, 1.5, 2.0].map(|x| DVec2::new(x, 0.0)).to_vec();
        let feet = Nurbs::polynomial(space(2), line).unwrap().foot_points(DVec2::new(1.0, 3.0)).unwrap();
        assert_eq!(
            feet.iter().map(|foot| (foot.foot.parameter, foot.kind)).collect::<Vec<_>>(),
            [(1.0, FootKind::Minimum)]
        );
    }
}
