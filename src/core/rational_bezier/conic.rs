//! Conics given by an equation: type, centre, axes and foci.
//!
//! `a₁₁ x² + 2 a₁₂ x y + 2 a₁₃ x + a₂₂ y² + 2 a₂₃ y + a₃₃ = 0`, that is `z A zᵗ = 0` with `z = (x, y, 1)` and symmetric `A`. With `δ = a₁₁ a₂₂ − a₁₂²` a conic with
//! `det A ≠ 0` is an ellipse for `δ > 0`, a parabola for `δ = 0`, a hyperbola for `δ < 0`. Course: section 3.4.

use glam::{DMat3, DVec2, DVec3};

use crate::core::rational_bezier::error::{RationalBezierError, check_finite};

/// Determinants of coefficients of size 1 count as 0 up to this size.
const VANISHING: f64 = 1e-12;

/// The type of a conic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ConicKind {
    /// One closed curve.
    Ellipse,
    /// One point at infinity.
    Parabola,
    /// Two branches, two points at infinity.
    Hyperbola,
    /// No proper curve.
    Degenerate(DegenerateConic),
}

impl ConicKind {
    /// `ellipse`, `parabola`, `hyperbola`, or the kind of degenerate conic in words.
    pub fn label(self) -> &'static str {
        match self {
            Self::Ellipse => "ellipse",
            Self::Parabola => "parabola",
            Self::Hyperbola => "hyperbola",
            Self::Degenerate(DegenerateConic::Empty) => "no real point",
            Self::Degenerate(DegenerateConic::Point) => "point",
            Self::Degenerate(DegenerateConic::CrossingLines) => "crossing lines",
            Self::Degenerate(DegenerateConic::ParallelLines) => "parallel lines",
            Self::Degenerate(DegenerateConic::DoubleLine) => "double line",
            Self::Degenerate(DegenerateConic::Line) => "line",
        }
    }
}

/// What the equation of a degenerate conic describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DegenerateConic {
    /// No real point.
    Empty,
    /// One point.
    Point,
    /// Two lines that meet.
    CrossingLines,
    /// Two parallel lines.
    ParallelLines,
    /// One line, counted twice.
    DoubleLine,
    /// One line; the other is at infinity.
    Line,
}

/// A conic `z A zᵗ = 0`; the equation is kept as given, up to the rounding of no operation.
///
/// ```
/// use glam::DVec2;
/// use spline_lab::core::rational_bezier::{Conic, ConicKind};
///
/// // The circle of radius 1 through five of its points.
/// let points = [0.0_f64, 1.0, 2.0, 3.0, 4.0].map(DVec2::from_angle);
/// let conic = Conic::through_points(points)?;
/// assert_eq!(conic.kind(), ConicKind::Ellipse);
/// assert!(conic.center()?.length() < 1e-14);
/// # Ok::<(), spline_lab::core::rational_bezier::RationalBezierError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conic {
    coefficients: [f64; 6],
}

/// Principal axes of an ellipse or a hyperbola.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConicAxes {
    /// The centre.
    pub center: DVec2,
    /// Semi-axes: of an ellipse the longer one first, of a hyperbola the one between its vertices first.
    pub lengths: [f64; 2],
    /// Their unit directions; the second is the first turned left by 90 degrees.
    pub directions: [DVec2; 2],
}

impl Conic {
    /// The conic with the coefficients `(a₁₁, a₁₂, a₁₃, a₂₂, a₂₃, a₃₃)`.
    ///
    /// # Errors
    ///
    /// `NonFinite`; `Degenerate` if all coefficients are 0.
    pub fn new(coefficients: [f64; 6]) -> Result<Self, RationalBezierError> {
        check_finite("coefficient", &coefficients)?;
        if coefficients.iter().all(|&a| a == 0.0) {
            return Err(RationalBezierError::Degenerate { what: "the conic", value: 0.0 });
        }
        Ok(Self { coefficients })
    }

    /// The conic `z A zᵗ = 0`.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]; `NoSolution` if the matrix is not symmetric.
    pub fn from_matrix(a: [[f64; 3]; 3]) -> Result<Self, RationalBezierError> {
        let conic = Self::new([a[0][0], a[0][1], a[0][2], a[1][1], a[1][2], a[2][2]])?;
        check_finite("coefficient", &[a[1][0], a[2][0], a[2][1]])?;
        if a[1][0] != a[0][1] || a[2][0] != a[0][2] || a[2][1] != a[1][2] {
            return Err(RationalBezierError::NoSolution { reason: "the matrix of a conic is symmetric" });
        }
        Ok(conic)
    }

    /// `(a₁₁, a₁₂, a₁₃, a₂₂, a₂₃, a₃₃)`.
    pub fn coefficients(&self) -> [f64; 6] {
        self.coefficients
    }

    /// The same conic with the first coefficient equal to 1 that is not 0; coefficients below 1e-12 of the largest count as 0.
    #[must_use]
    pub fn normalised(&self) -> Self {
        let largest = self.coefficients.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        let scaled = self.coefficients.map(|a| a / largest);
        let first = scaled.into_iter().find(|a| a.abs() > VANISHING).unwrap_or(1.0);
        Self { coefficients: scaled.map(|a| a / first) }
    }

    /// The symmetric matrix `A`.
    pub fn matrix(&self) -> DMat3 {
        let [a, b, d, c, e, f] = self.coefficients;
        DMat3::from_cols(DVec3::new(a, b, d), DVec3::new(b, c, e), DVec3::new(d, e, f))
    }

    /// The value `z A zᵗ` of the equation at `place`.
    pub fn value(&self, place: DVec2) -> f64 {
        let z = place.extend(1.0);
        z.dot(self.matrix() * z)
    }

    /// `|z A zᵗ|` relative to the sum of the moduli of its terms: 0 on the conic, at most 1.
    pub fn residual(&self, place: DVec2) -> f64 {
        let z = place.extend(1.0).abs();
        let a = self.matrix();
        let terms = DMat3::from_cols(a.x_axis.abs(), a.y_axis.abs(), a.z_axis.abs());
        let sum = z.dot(terms * z);
        if sum > 0.0 { self.value(place).abs() / sum } else { 0.0 }
    }

    /// The discriminant `δ = a₁₁ a₂₂ − a₁₂²`, exactly 0 if it is below 1e-12 of the square of the largest of these three coefficients.
    pub fn discriminant(&self) -> f64 {
        let [a, b, _, c, ..] = self.coefficients;
        let size = a.abs().max(b.abs()).max(c.abs());
        // Divided by the size before multiplying, so that nothing over- or underflows.
        let minor = (a / size) * (c / size) - (b / size) * (b / size);
        if size == 0.0 || minor.abs() <= VANISHING { 0.0 } else { minor * size * size }
    }

    /// What the conic is.
    ///
    /// With the largest quadratic coefficient `q` and the length `s`, the largest of `|a₁₃|/q`, `|a₂₃|/q`, `√(|a₃₃|/q)`, the discriminant counts as 0
    /// below `1e-12 q²` and the determinant below `1e-12 q³ s²`.
    pub fn kind(&self) -> ConicKind {
        let [a, b, d, c, e, f] = self.coefficients;
        let q = a.abs().max(b.abs()).max(c.abs());
        if q == 0.0 {
            let is_line = d != 0.0 || e != 0.0;
            return ConicKind::Degenerate(if is_line {
                DegenerateConic::Line
            } else {
                DegenerateConic::Empty
            });
        }
        let s = (d / q).abs().max((e / q).abs()).max((f / q).abs().sqrt());
        let unit = if s > 0.0 { s } else { 1.0 };
        // In units in which all coefficients are at most 1.
        let (a, b, c) = (a / q, b / q, c / q);
        let (d, e, f) = (d / q / unit, e / q / unit, f / q / unit / unit);
        let minor = vanishing(a * c - b * b);
        let determinant = vanishing(minor * f + b * e * d + d * b * e - a * e * e - d * c * d);
        if determinant != 0.0 {
            return if minor < 0.0 {
                ConicKind::Hyperbola
            } else if minor == 0.0 {
                ConicKind::Parabola
            } else if determinant * (a + c) < 0.0 {
                ConicKind::Ellipse
            } else {
                ConicKind::Degenerate(DegenerateConic::Empty)
            };
        }
        // For a pair of parallel lines: the discriminant of λ s² + 2 g s + f, with λ = a + c and |g| = |(d, e)|.
        let apart = vanishing(d * d + e * e - (a + c) * f);
        ConicKind::Degenerate(if minor < 0.0 {
            DegenerateConic::CrossingLines
        } else if minor > 0.0 {
            DegenerateConic::Point
        } else if apart > 0.0 {
            DegenerateConic::ParallelLines
        } else if apart < 0.0 {
            DegenerateConic::Empty
        } else {
            DegenerateConic::DoubleLine
        })
    }

    /// The centre of symmetry of an ellipse, a hyperbola, or a pair of crossing lines.
    ///
    /// # Errors
    ///
    /// `Degenerate` if the discriminant vanishes.
    pub fn center(&self) -> Result<DVec2, RationalBezierError> {
        let minor = self.discriminant();
        let [a, b, d, c, e, _] = self.coefficients;
        let center = DVec2::new(b * e - c * d, b * d - a * e) / minor;
        if minor == 0.0 || !center.is_finite() {
            return Err(RationalBezierError::Degenerate { what: "the centre", value: minor });
        }
        Ok(center)
    }

    /// Semi-axes and their directions.
    ///
    /// # Errors
    ///
    /// `Degenerate` unless the conic is an ellipse or a hyperbola.
    pub fn axes(&self) -> Result<ConicAxes, RationalBezierError> {
        let kind = self.kind();
        if !matches!(kind, ConicKind::Ellipse | ConicKind::Hyperbola) {
            return Err(RationalBezierError::Degenerate { what: "the axes", value: self.discriminant() });
        }
        let center = self.center()?;
        let ([a, b, _, c, ..], level) = (self.coefficients, self.value(center));
        let [(first, u), (second, v)] = eigenvalues(a, b, c);
        // level + λ s² = 0 along an axis.
        let squares = [-level / first, -level / second];
        let swap = if kind == ConicKind::Ellipse { squares[0] < squares[1] } else { squares[0] < 0.0 };
        let (squares, direction) = if swap { ([squares[1], squares[0]], v) } else { (squares, u) };
        let lengths = squares.map(|square| square.abs().sqrt());
        if !lengths.iter().all(|length| length.is_finite() && *length > 0.0) {
            return Err(RationalBezierError::Degenerate { what: "the axes", value: level });
        }
        Ok(ConicAxes { center, lengths, directions: [direction, direction.perp()] })
    }

    /// The foci: two of an ellipse (equal for a circle) or a hyperbola, one of a parabola.
    ///
    /// # Errors
    ///
    /// `Degenerate` for a degenerate conic.
    pub fn foci(&self) -> Result<Vec<DVec2>, RationalBezierError> {
        if self.kind() == ConicKind::Parabola {
            let frame = self.parabola_frame();
            return Ok(vec![frame.vertex + frame.axis * frame.focal_length]);
        }
        let axes = self.axes()?;
        let [a, b] = axes.lengths;
        let distance = match self.kind() {
            ConicKind::Ellipse => ((a - b) * (a + b)).max(0.0).sqrt(),
            _ => a.hypot(b),
        };
        let way = axes.directions[0] * distance;
        Ok(vec![axes.center + way, axes.center - way])
    }

    /// Vertex, axis and focal length of a parabola.
    pub(super) fn parabola_frame(&self) -> ParabolaFrame {
        let [a, b, d, c, e, f] = self.coefficients;
        let [(first, u), (second, v)] = eigenvalues(a, b, c);
        // Across the axis along u, in the direction v.
        let (curved, u, v) = if first.abs() >= second.abs() { (first, u, v) } else { (second, v, u) };
        let linear = DVec2::new(d, e);
        let across = -linear.dot(u) / curved;
        let slope = linear.dot(v);
        let along = (curved * across * across - f) / (2.0 * slope);
        let focal_length = -slope / (2.0 * curved);
        let axis = v * focal_length.signum();
        ParabolaFrame { vertex: u * across + v * along, axis, focal_length: focal_length.abs() }
    }
}

/// A parabola `s² = 4 f r` with `r` along the axis from the vertex and `s` across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ParabolaFrame {
    /// The vertex.
    pub(super) vertex: DVec2,
    /// Unit direction to the inside.
    pub(super) axis: DVec2,
    /// Distance `f` of vertex and focus.
    pub(super) focal_length: f64,
}

/// `value`, exactly 0 if it is below [`VANISHING`].
fn vanishing(value: f64) -> f64 {
    if value.abs() <= VANISHING { 0.0 } else { value }
}

/// `p − q`, exactly 0 if it is below [`VANISHING`] of `|p| + |q|`.
pub(super) fn difference(p: f64, q: f64) -> f64 {
    if (p - q).abs() <= VANISHING * (p.abs() + q.abs()) { 0.0 } else { p - q }
}

/// Eigenvalues and unit eigenvectors of the symmetric matrix `(a, b; b, c)`; the second vector is the first turned left by 90 degrees.
fn eigenvalues(a: f64, b: f64, c: f64) -> [(f64, DVec2); 2] {
    let angle = 0.5 * (2.0 * b).atan2(a - c);
    let u = DVec2::from_angle(angle);
    let radius = (0.5 * (a - c)).hypot(b);
    let mean = 0.5 * (a + c);
    // The smaller one from the determinant, without cancellation.
    let large = if mean >= 0.0 { mean + radius } else { mean - radius };
    let small = if large == 0.0 { 0.0 } else { difference(a * c, b * b) / large };
    let [first, second] = if mean >= 0.0 { [large, small] } else { [small, large] };
    [(first, u), (second, u.perp())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn conic(coefficients: [f64; 6]) -> Conic {
        Conic::new(coefficients).unwrap()
    }

    /// The image of a conic under `p ↦ R p + t`: with `z ↦ M z` the matrix becomes `M⁻ᵗ A M⁻¹`.
    fn moved(conic: &Conic, angle: f64, shift: DVec2) -> Conic {
        let inverse = DMat3::from_angle(-angle) * DMat3::from_translation(-shift);
        let a = inverse.transpose() * conic.matrix() * inverse;
        Conic::new([a.x_axis.x, a.y_axis.x, a.z_axis.x, a.y_axis.y, a.z_axis.y, a.z_axis.z]).unwrap()
    }

    proptest! {
        #[test]
        fn ellipses_and_hyperbolas_have_the_axes_they_were_made_with(
            p in 0.3..3.0_f64, q in 0.3..3.0_f64, sign in prop::bool::ANY, angle in -3.0..3.0_f64,
            shift in (-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), factor in -3.0..3.0_f64,
        ) {
            prop_assume!(factor.abs() > 0.1 && (p - q).abs() > 0.01);
            let s = if sign { 1.0 } else { -1.0 };
            let plain = conic([factor / (p * p), 0.0, 0.0, s * factor / (q * q), 0.0, -factor]);
            let image = moved(&plain, angle, shift);
            let kind = if sign { ConicKind::Ellipse } else { ConicKind::Hyperbola };
            prop_assert_eq!(image.kind(), kind, "kind");
            let axes = image.axes().unwrap();
            prop_assert!((axes.center - shift).length() < 1e-10, "centre {}", axes.center);
            let expected = if sign { [p.max(q), p.min(q)] } else { [p, q] };
            for j in 0..2 {
                prop_assert!((axes.lengths[j] - expected[j]).abs() < 1e-9, "axes {:?}", axes.lengths);
            }
            let vertex = axes.center + axes.directions[0] * axes.lengths[0];
            prop_assert!(image.residual(vertex) < 1e-11, "the vertex is on the conic");
            // Sum or difference of the distances from the foci at another point.
            let point = DVec2::from_angle(angle).rotate(if sign {
                DVec2::new(p * 0.6, q * 0.8)
            } else {
                DVec2::new(p * 1.25, q * 0.75)
            }) + shift;
            prop_assert!(image.residual(point) < 1e-11, "a point of the conic");
            let foci = image.foci().unwrap();
            let (near, far) = (point.distance(foci[0]), point.distance(foci[1]));
            let measure = if sign { near + far } else { (near - far).abs() };
            prop_assert!((measure - 2.0 * axes.lengths[0]).abs() < 1e-8, "{measure}");
        }

        #[test]
        fn parabolas_have_focus_and_directrix(
            f in 0.2..3.0_f64, angle in -3.0..3.0_f64, shift in (-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from), s in -3.0..3.0_f64,
        ) {
            // s² = 4 f r with r to the right.
            let image = moved(&conic([0.0, 0.0, -2.0 * f, 1.0, 0.0, 0.0]), angle, shift);
            prop_assert_eq!(image.kind(), ConicKind::Parabola, "kind");
            let focus = image.foci().unwrap()[0];
            let spin = DVec2::from_angle(angle);
            prop_assert!((focus - (spin * f + shift)).length() < 1e-7, "focus {focus}");
            let r = s * s / (4.0 * f);
            let point = spin.rotate(DVec2::new(r, s)) + shift;
            prop_assert!((point.distance(focus) - (r + f)).abs() < 1e-7, "distance from the directrix");
        }
    }

    #[test]
    fn every_degenerate_kind_is_told() {
        use DegenerateConic::{CrossingLines, DoubleLine, Empty, Line, ParallelLines, Point};
        for (coefficients, kind) in [
            ([1.0, 0.0, 0.0, 1.0, 0.0, 1.0], Empty),
            ([1.0, 0.0, -2.0, 3.0, 0.0, 4.0], Point),
            ([1.0, 0.0, 0.0, -1.0, 0.0, 0.0], CrossingLines),
            ([0.0, 0.5, -0.5, 0.0, -1.0, 2.0], CrossingLines),
            ([1.0, 1.0, 0.0, 1.0, 0.0, -1.0], ParallelLines),
            ([4.0, 2.0, 0.0, 1.0, 0.0, 3.0], Empty),
            ([1.0, -1.0, 1.0, 1.0, -1.0, 1.0], DoubleLine),
            ([0.0, 0.0, 1.0, 0.0, 2.0, 5.0], Line),
            ([0.0, 0.0, 0.0, 0.0, 0.0, -5.0], Empty),
        ] {
            assert_eq!(conic(coefficients).kind(), ConicKind::Degenerate(kind), "{coefficients:?}");
            assert!(conic(coefficients).axes().is_err(), "no axes: {coefficients:?}");
        }
        assert_eq!(Conic::new([0.0; 6]).unwrap_err().name(), "Degenerate", "no equation");
        assert_eq!(Conic::new([f64::NAN; 6]).unwrap_err().name(), "NonFinite", "NaN");
        let skew = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
        assert_eq!(Conic::from_matrix(skew).unwrap_err().name(), "NoSolution", "not symmetric");
    }
}
