//! B-spline coefficients of piecewise polynomials and of Hermite data, by blossoms.
//!
//! The coefficient `cₖ` is the blossom of any piece in the support of `bₖ` at `ξₖ₊₁, …, ξₖ₊ₙ`; a piecewise polynomial is in the space
//! iff all of these pieces give the same value. The blossom of `(x − o)ʲ` is the elementary symmetric mean of order `j` of the
//! arguments minus `o`. Course: section 4.4.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::SplineSpace;
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

/// A polynomial `Σ coefficients[j]·(x − origin)ʲ`.
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialPiece<P> {
    /// Where the powers are centred; near the piece, for accuracy.
    pub origin: f64,
    /// Coefficients, constant first, at most `n + 1`.
    pub coefficients: Vec<P>,
}

/// Disagreement of two pieces, relative to the coefficients, that still counts as rounding.
const AGREEMENT: f64 = 1e-10;

impl<P: Point> Spline<P> {
    /// The open spline of `space` with one given polynomial on every nonempty knot interval of D, from left to right.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for the number of pieces or of coefficients of a piece; `NotInSpace` where two pieces are not joined as smoothly
    /// as the space demands, or if the space is periodic; those of [`Spline::new`].
    pub fn from_piecewise(space: SplineSpace, pieces: &[PolynomialPiece<P>]) -> Result<Self, SplineError> {
        if space.is_periodic() {
            let reason = "pieces are joined in an open space only".to_owned();
            return Err(SplineError::NotInSpace { reason });
        }
        let (n, breaks) = (space.degree(), space.breaks());
        if pieces.len() != breaks.len() - 1 {
            let (expected, found) = (breaks.len() - 1, pieces.len());
            return Err(SplineError::SizeMismatch { what: "pieces", expected, found });
        }
        for piece in pieces {
            let found = piece.coefficients.len();
            if found > n + 1 {
                return Err(SplineError::SizeMismatch {
                    what: "coefficients of a piece",
                    expected: n + 1,
                    found,
                });
            }
        }
        let mut coefficients = Vec::with_capacity(space.dimension());
        for k in 0..space.dimension() {
            let arguments = &space.knots()[k + 1..=k + n];
            let (low, high) = space.support(k);
            let first = breaks.partition_point(|&x| x <= low).saturating_sub(1);
            let after = breaks.partition_point(|&x| x < high).min(pieces.len());
            let values: Vec<P> = pieces[first..after].iter().map(|piece| piece.blossom(arguments)).collect();
            let value = values[values.len() / 2];
            let scale = pieces[first..after]
                .iter()
                .flat_map(|piece| piece.coefficients.iter().map(|c| c.norm()))
                .fold(value.norm(), f64::max);
            if let Some(bad) = values.iter().position(|&other| (other - value).norm() > AGREEMENT * scale) {
                let (piece, gap) = (first + bad, (values[bad] - value).norm());
                let reason =
                    format!("pieces give coefficient {k} differently, by {gap:.3e} on piece {piece}");
                return Err(SplineError::NotInSpace { reason });
            }
            coefficients.push(value);
        }
        Self::new(space, coefficients)
    }

    /// The cubic spline with `values` and `slopes` at the breaks of D, all of which are at least double knots:
    /// `c = f + d (a − x)/3`, where the three inner knots of a B-spline are `a, x, x`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for the degree or the number of data; `NotInSpace` where a break of D is a simple knot;
    /// those of [`Spline::new`].
    pub fn from_hermite(space: SplineSpace, values: &[P], slopes: &[P]) -> Result<Self, SplineError> {
        if space.degree() != 3 {
            let found = space.degree();
            return Err(SplineError::SizeMismatch { what: "is the degree, which", expected: 3, found });
        }
        let (breaks, expected) = (space.breaks(), space.breaks().len() - usize::from(space.is_periodic()));
        for (what, found) in [("values", values.len()), ("slopes", slopes.len())] {
            if found != expected {
                return Err(SplineError::SizeMismatch { what, expected, found });
            }
        }
        let coefficient = |k: usize| {
            let knots = [1, 2, 3].map(|i| space.knot((k + i) as isize).unwrap_or(f64::NAN));
            // A double knot among three sorted ones is the middle one.
            let (x, a) = if knots[0] >= knots[1] { (knots[1], knots[2]) } else { (knots[1], knots[0]) };
            if knots[0] < knots[1] && knots[1] < knots[2] {
                return Err(SplineError::NotInSpace { reason: format!("{x} is a simple knot") });
            }
            let reduced = space.reduce(x)?;
            let index = breaks.partition_point(|&at| at < reduced) % expected;
            Ok(values[index] + slopes[index] * ((a - x) / 3.0))
        };
        let coefficients = (0..space.dimension()).map(coefficient).collect::<Result<_, _>>()?;
        Self::new(space, coefficients)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hermite_data_come_back() {
        let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 3.0, 3.0, 3.0, 4.0];
        let space = SplineSpace::new(3, knots).unwrap();
        let spline = Spline::from_hermite(space, &[1.0, -2.0, 0.5], &[3.0, 0.0, -1.0]).unwrap();
        for (x, f, d) in [(0.0, 1.0, 3.0), (1.0, -2.0, 0.0), (3.0, 0.5, -1.0)] {
            let found = spline.derivatives(x, 1, crate::core::bspline::Side::Left).unwrap();
            assert!((found[0] - f).abs() < 1e-14 && (found[1] - d).abs() < 1e-14, "at {x}: {found:?}");
        }
        let simple = SplineSpace::uniform(3, 0.0, 1.0, 2).unwrap();
        let error = Spline::from_hermite(simple, &[0.0; 3], &[0.0; 3]).unwrap_err();
        assert_eq!(error.name(), "NotInSpace", "simple knots");
    }

    #[test]
    fn closed_hermite_data_come_back() {
        let space = SplineSpace::periodic(3, 4.0, vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        let spline = Spline::from_hermite(space, &[1.0, -2.0], &[3.0, 0.5]).unwrap();
        for (x, f, d) in [(0.0, 1.0, 3.0), (1.0, -2.0, 0.5), (4.0, 1.0, 3.0)] {
            let found = spline.derivatives(x, 1, crate::core::bspline::Side::Left).unwrap();
            assert!((found[0] - f).abs() < 1e-14 && (found[1] - d).abs() < 1e-14, "at {x}: {found:?}");
        }
    }
}
