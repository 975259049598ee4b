//! Vertices of plane curves: where the signed curvature is locally largest or smallest.
//!
//! Inside the pieces these are the sign changes of the numerator of the [derivative of the curvature](super::curvature_polynomial). At a knot the curvature may jump or have a
//! peak, and at the ends of an open curve it is extreme to one side; both are kinds of their own. Course: beyond, section B.7; S. Mukhopadhyaya 1909 for the four
//! vertices of closed convex curves.

use glam::DVec2;

use crate::core::bspline::{Side, SplineError};
use crate::core::spline_curve::Nurbs;
use crate::core::spline_curve::curvature_polynomial::{checked, turning_change};
use crate::core::spline_curve::piecewise_sign::{PieceSigns, PiecewiseSign, SignPlace};

/// Curvatures on both sides of a knot that differ by less than this part of them are one.
const SAME: f64 = 1e-9;
/// The rounding error of a curvature in units of that of the coordinates over the square of the size.
const NOISE: f64 = 100.0;

/// Curvatures above this, times the size of the pieces, belong to cusps.
const SHARPEST: f64 = 1e10;

/// What kind of extremum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VertexKind {
    /// The signed curvature has a local maximum, with derivative 0.
    Maximum,
    /// The signed curvature has a local minimum, with derivative 0.
    Minimum,
    /// At a knot: the curvature jumps, or it has an extremum where its derivative jumps.
    Knot,
    /// The end of an open curve.
    End,
}

/// A vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Its parameter.
    pub parameter: f64,
    /// The signed curvature, the limits from the left and from the right.
    pub curvatures: [f64; 2],
    /// What kind it is.
    pub kind: VertexKind,
}

/// The vertices of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertices {
    /// Increasing by parameter.
    pub vertices: Vec<Vertex>,
    /// The parts on which the curvature is constant: circular arcs and straight parts, neighbours in one.
    pub constant: Vec<[f64; 2]>,
}

impl Nurbs<DVec2> {
    /// All vertices, with the ends of an open curve. At a cusp, where the curvature has no value, there is none.
    ///
    /// ```
    /// use glam::DVec2;
    /// use spline_lab::core::spline_curve::Nurbs;
    ///
    /// let circle = Nurbs::circle(DVec2::ZERO, 2.0)?.vertices()?;
    /// assert!(circle.vertices.is_empty() && circle.constant.len() == 1);
    /// # Ok::<(), spline_lab::core::bspline::SplineError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// `NonFinite` where products of coordinates overflow.
    pub fn vertices(&self) -> Result<Vertices, SplineError> {
        let (mut signs, mut noise, mut size) = (Vec::new(), Vec::new(), 0.0_f64);
        for (index, piece) in self.local_pieces()?.iter().enumerate() {
            let piece_signs = match checked(index, turning_change(piece))? {
                Some(change) => PieceSigns::new(&change.coefficients, change.noise),
                None => PieceSigns::new(&[0.0], 0.0),
            };
            signs.push((piece.interval, piece_signs));
            size = size.max(piece.extent);
            noise.push(NOISE * piece.error / (piece.extent * piece.extent));
        }
        let is_closed = self.space().is_periodic();
        let sign = PiecewiseSign::new(&signs, is_closed);
        let (start, end) = self.space().parameter_interval();
        let mut vertices = Vec::new();
        for place in &sign.places {
            let t = place.parameter;
            let is_end = !is_closed && (t == start || t == end);
            let sides = [if t == start && !is_closed { Side::Right } else { Side::Left }, Side::Right];
            let sides = if is_end && t == end { [Side::Left; 2] } else { sides };
            let [Ok(left), Ok(right)] = sides.map(|side| self.curvature(t, side)) else { continue };
            // Of a speed that is 0 up to rounding nothing is left but rounding.
            if left.abs().max(right.abs()) * size > SHARPEST {
                continue;
            }
            // The pieces on both sides; the last one goes before the first of a closed curve.
            let noise = noise[place.piece.min(noise.len() - 1)]
                .max(noise[place.piece.checked_sub(1).unwrap_or(noise.len() - 1)]);
            if let Some(kind) = if is_end { Some(VertexKind::End) } else { kind(place, left, right, noise) } {
                vertices.push(Vertex { parameter: t, curvatures: [left, right], kind });
            }
        }
        Ok(Vertices { vertices, constant: sign.zero })
    }
}

/// What is at a place that is no end.
fn kind(place: &SignPlace, left: f64, right: f64, noise: f64) -> Option<VertexKind> {
    let jumps = place.is_joint && (left - right).abs() > SAME * left.abs().max(right.abs()) + noise;
    let changes = place.before * place.after < 0;
    match (jumps || (changes && !place.is_zero), changes, place.before > 0) {
        (true, ..) => Some(VertexKind::Knot),
        (false, true, true) => Some(VertexKind::Maximum),
        (false, true, false) => Some(VertexKind::Minimum),
        (false, false, _) => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::core::point::Point as _;
    use crate::core::spline_curve::samples::any_curve;

    /// An ellipse with half axes 2 and 1 of four quarters.
    fn ellipse() -> Nurbs<DVec2> {
        let circle = Nurbs::circle(DVec2::ZERO, 1.0).unwrap();
        let points =
            circle.points().iter().map(|&p| p * DVec2::new(2.0, 1.0) + DVec2::new(5.0, 3.0)).collect();
        Nurbs::new(circle.space().clone(), points, circle.weights().to_vec()).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        #[test]
        fn the_curvature_grows_up_to_a_maximum_and_falls_behind_it(curve in any_curve(3..=5)) {
            let found = curve.vertices().unwrap();
            let (a, b) = curve.space().parameter_interval();
            let breaks = curve.space().breaks();
            for vertex in &found.vertices {
                let sign = match vertex.kind { VertexKind::Maximum => 1.0, VertexKind::Minimum => -1.0, _ => continue };
                let h = 1e-4 * (b - a);
                let t = vertex.parameter;
                let others = found.vertices.iter().map(|other| other.parameter).chain(breaks.iter().copied());
                if others.filter(|&s| s != t).any(|s| (s - t).abs() < 2.0 * h) || t - h < a || t + h > b {
                    continue;
                }
                for s in [t - h, t + h] {
                    let beside = curve.curvature(s, Side::Right).unwrap();
                    let slack = 1e-9 * (1.0 + beside.abs());
                    prop_assert!(sign * (vertex.curvatures[0] - beside) > -slack, "{vertex:?}, {beside} at {s}");
                }
            }
            let rotate = |p: DVec2| DVec2::from_angle(0.8).rotate(p) * 3.0 + DVec2::new(3.0, -4.0);
            let image = Nurbs::new(curve.space().clone(), curve.points().iter().map(|&p| rotate(p)).collect(), curve.weights().to_vec()).unwrap();
            let image = image.vertices().unwrap();
            prop_assert_eq!(image.vertices.len(), found.vertices.len(), "{:?} {:?}", image, found);
            for (one, other) in image.vertices.iter().zip(&found.vertices) {
                prop_assert!(one.kind == other.kind && (one.parameter - other.parameter).abs() < 1e-4 * (b - a), "{one:?} {other:?}");
            }
            if !curve.space().is_periodic() {
                let back = curve.reversed().unwrap().vertices().unwrap();
                prop_assert_eq!(back.vertices.len(), found.vertices.len(), "reversal");
                let maxima = |list: &Vertices, kind| list.vertices.iter().filter(|vertex| vertex.kind == kind).count();
                prop_assert_eq!(maxima(&back, VertexKind::Maximum), maxima(&found, VertexKind::Minimum), "kappa changes its sign");
            }
        }
    }

    #[test]
    fn an_ellipse_has_four_vertices() {
        let found = ellipse().vertices().unwrap();
        assert!(found.constant.is_empty(), "{found:?}");
        assert_eq!(found.vertices.len(), 4, "{found:?}");
        for vertex in &found.vertices {
            let expected = match vertex.kind {
                VertexKind::Maximum => 2.0,
                VertexKind::Minimum => 0.25,
                _ => f64::NAN,
            };
            assert!((vertex.curvatures[0] - expected).abs() < 1e-12, "{vertex:?}");
        }
    }

    #[test]
    fn arcs_are_constant_and_their_joints_are_knots() {
        // A quarter of radius 1 and one of radius 2 with the same tangent at the joint.
        let s = 0.5_f64.sqrt();
        let points =
            [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-2.0, 1.0], [-2.0, -1.0]].map(DVec2::from).to_vec();
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0]).unwrap();
        let found = Nurbs::new(space, points, vec![1.0, s, 1.0, s, 1.0]).unwrap().vertices().unwrap();
        assert_eq!(found.constant, [[0.0, 2.0]], "{found:?}");
        let kinds: Vec<_> = found.vertices.iter().map(|vertex| (vertex.parameter, vertex.kind)).collect();
        assert_eq!(kinds, [(0.0, VertexKind::End), (1.0, VertexKind::Knot), (2.0, VertexKind::End)]);
        let [left, right] = found.vertices[1].curvatures;
        assert!((left - 1.0).abs() < 1e-13 && (right - 0.5).abs() < 1e-13, "{left}, {right}");
        let space = SplineSpace::from_breaks(1, &[0.0, 1.0], EndKnots::Interpolating).unwrap();
        let line = Nurbs::polynomial(space, vec![DVec2::ZERO, DVec2::X]).unwrap().vertices().unwrap();
        assert_eq!(line.constant, [[0.0, 1.0]], "a line: {line:?}");
        assert_eq!(0.0.mix(2.0, 0.5), 1.0, "its middle");
    }
}
