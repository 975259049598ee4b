//! A closed spline written out over several periods, as plain arrays: local algorithms then need no wrapping.

use crate::core::bspline::Spline;
use crate::core::point::Point;

/// Knots and coefficients of a periodic spline over `2·reach + 1` periods, the period `[ξ₀, ξ₀ + T)` in the middle.
pub(super) struct Extension<P> {
    /// `m + n + 1` knots.
    pub(super) knots: Vec<f64>,
    /// `m` coefficients; number `k` belongs to the B-spline that starts at knot `k`.
    pub(super) coefficients: Vec<P>,
    reach: isize,
}

impl<P: Point> Extension<P> {
    /// The extension of a periodic spline by as many periods as the longest support takes, and one more.
    pub(super) fn of(spline: &Spline<P>) -> Self {
        let (space, n) = (spline.space(), spline.degree());
        let count = space.dimension() as isize;
        let reach = (n as isize + 1) / count + 2;
        let indices = -reach * count..(reach + 1) * count;
        let coefficient = |k: isize| spline.coefficients()[k.rem_euclid(count) as usize];
        let coefficients = indices.clone().map(coefficient).collect();
        let beyond = indices.end + n as isize + 1;
        let knots = (indices.start..beyond).filter_map(|k| space.knot(k)).collect();
        Self { knots, coefficients, reach }
    }

    /// The numbers of the periods whose copies of a knot lie well inside the arrays.
    pub(super) fn periods(&self) -> std::ops::RangeInclusive<isize> {
        1 - self.reach..=self.reach
    }
}
