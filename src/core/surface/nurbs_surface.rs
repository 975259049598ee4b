//! NURBS surfaces: `r = Σ w_k c_k b_k/Σ w_k b_k` over two directions.
//!
//! Cartesian points and weights are kept exactly as given; algorithms run on the homogeneous net `(w c, w)`. Axis 0 (u) counts the rows
//! of the net, axis 1 (v) its columns. Course: section 8.2.

use glam::{DVec3, DVec4};

use crate::core::bspline::{MAX_DEGREE, Side, Spline};
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::Nurbs;
use crate::core::surface::curvature::{Curvatures, SurfaceJet};
use crate::core::surface::error::SurfaceError;
use crate::core::surface::spline_surface::SplineSurface;
use crate::core::tensor::{TensorError, TensorSpline, TensorSplineSpace};

/// Rounding of a derivative, as a part of `coordinate size · degree/parameter step`; some tens of units in the last place.
const DERIVATIVE_NOISE: f64 = 1e-14;

/// A rational surface, open or periodic in each direction; all weights equal make it polynomial.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsSurface {
    net: SplineSurface,
    weights: Vec<f64>,
    homogeneous: TensorSpline<DVec4, 2>,
    /// Diagonal of the box of the control points.
    size: f64,
    /// Lengths up to which the first derivatives are rounding.
    noise: [f64; 2],
}

/// The rational Bezier patch over one cell.
#[derive(Clone, Debug, PartialEq)]
pub struct RationalPatch {
    /// The cell `(a, b)` in both directions.
    pub cell: [(f64, f64); 2],
    /// The degrees.
    pub degrees: [usize; 2],
    /// The control points, row by row.
    pub points: Vec<DVec3>,
    /// Their weights.
    pub weights: Vec<f64>,
}

impl NurbsSurface {
    /// The surface with control points `points`, row by row, and positive `weights`, one for each.
    ///
    /// # Errors
    ///
    /// Those of [`TensorSpline::new`]; `SizeMismatch`, `NonFinite`, `WeightNotPositive` for the weights; `NonFinite` where the
    /// product of a weight and a coordinate overflows.
    pub fn new(
        space: TensorSplineSpace<2>,
        points: Vec<DVec3>,
        weights: Vec<f64>,
    ) -> Result<Self, SurfaceError> {
        let net = TensorSpline::new(space, points)?;
        if weights.len() != net.coefficients().len() {
            let (expected, found) = (net.coefficients().len(), weights.len());
            return Err(TensorError::SizeMismatch { what: "weights", expected, found }.into());
        }
        if let Some(index) = weights.iter().position(|weight| !weight.is_finite()) {
            return Err(TensorError::NonFinite { what: "weight", index, value: weights[index] }.into());
        }
        if let Some(index) = weights.iter().position(|&weight| weight <= 0.0) {
            return Err(TensorError::WeightNotPositive { index, value: weights[index] }.into());
        }
        let lifted =
            net.coefficients().iter().zip(&weights).map(|(point, &weight)| point.lift(weight)).collect();
        let homogeneous = TensorSpline::new(net.space().clone(), lifted)?;
        let points = net.coefficients();
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let reach = low.abs().max(high.abs()).max_element();
        let noise = net.space().axes().each_ref().map(|axis| {
            let (left, right) = axis.parameter_interval();
            DERIVATIVE_NOISE * reach * (axis.degree() * axis.breaks().len()) as f64 / (right - left)
        });
        let size = (high - low).length();
        Ok(Self { net, weights, homogeneous, size, noise })
    }

    /// The polynomial surface: all weights 1.
    ///
    /// # Errors
    ///
    /// Those of [`TensorSpline::new`].
    pub fn polynomial(space: TensorSplineSpace<2>, points: Vec<DVec3>) -> Result<Self, SurfaceError> {
        let weights = vec![1.0; points.len()];
        Self::new(space, points, weights)
    }

    /// The space of both directions.
    pub fn space(&self) -> &TensorSplineSpace<2> {
        self.net.space()
    }

    /// The control points as given, row by row.
    pub fn points(&self) -> &[DVec3] {
        self.net.coefficients()
    }

    /// The weights as given, row by row.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Numbers of rows and columns of the net.
    pub fn shape(&self) -> [usize; 2] {
        self.space().shape()
    }

    /// Whether all weights are the same number, so that the surface is polynomial.
    pub fn is_polynomial(&self) -> bool {
        self.weights.windows(2).all(|pair| pair[0].to_bits() == pair[1].to_bits())
    }

    /// The spline of the control points without the weights; the surface itself if [`Self::is_polynomial`].
    pub fn without_weights(&self) -> &SplineSurface {
        &self.net
    }

    /// The homogeneous spline with coefficients `(w c, w)`.
    pub fn homogeneous(&self) -> &TensorSpline<DVec4, 2> {
        &self.homogeneous
    }

    /// Diagonal of the box around the control points.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Lengths of `r_u` and `r_v` that are rounding errors of zero.
    pub(super) fn noise(&self) -> [f64; 2] {
        self.noise
    }

    /// `r(u, v)`. Does not allocate.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn evaluate(&self, at: [f64; 2]) -> Result<DVec3, SurfaceError> {
        if self.is_polynomial() {
            return Ok(self.net.evaluate(at)?);
        }
        Ok(DVec3::project(self.homogeneous.evaluate(at)?).0)
    }

    /// Point and derivatives up to order two, the limits from `sides` at knots. Does not allocate.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn jet(&self, at: [f64; 2], sides: [Side; 2]) -> Result<SurfaceJet, SurfaceError> {
        let mut rows = [[0.0; 3 * (MAX_DEGREE + 1)]; 2];
        let mut first = [0; 2];
        let degrees = self.space().degrees();
        for axis in 0..2 {
            let row = &mut rows[axis][..3 * (degrees[axis] + 1)];
            first[axis] = self.space().axes()[axis]
                .write_basis_derivatives(at[axis], 2, sides[axis], row)
                .map_err(SurfaceError::on_axis(axis))?;
        }
        let derivative = |u: usize, v: usize| {
            let row = |axis: usize, order: usize| {
                let width = degrees[axis] + 1;
                &rows[axis][order * width..(order + 1) * width]
            };
            self.homogeneous.contract(first, [row(0, u), row(1, v)])
        };
        // r = p/w: from p = w r follow p_u = w r_u + w_u r, p_uv = w r_uv + w_u r_v + w_v r_u + w_uv r, and so on.
        let whole = derivative(0, 0);
        let weight = whole.w;
        let point = whole.truncate() / weight;
        let (u, v) = (derivative(1, 0), derivative(0, 1));
        let du = (u.truncate() - point * u.w) / weight;
        let dv = (v.truncate() - point * v.w) / weight;
        let (uu, uv, vv) = (derivative(2, 0), derivative(1, 1), derivative(0, 2));
        let duu = (uu.truncate() - du * (2.0 * u.w) - point * uu.w) / weight;
        let duv = (uv.truncate() - dv * u.w - du * v.w - point * uv.w) / weight;
        let dvv = (vv.truncate() - dv * (2.0 * v.w) - point * vv.w) / weight;
        Ok(SurfaceJet { at, point, du, dv, duu, duv, dvv, noise: self.noise, size: self.size })
    }

    /// The unit normal `r_u × r_v/|r_u × r_v|`, at knots from the right.
    ///
    /// # Errors
    ///
    /// As [`Self::jet`]; `SingularPoint`.
    pub fn normal(&self, at: [f64; 2]) -> Result<DVec3, SurfaceError> {
        self.jet(at, [Side::Right; 2])?.normal()
    }

    /// The unit normal, at a singular point the one a small step (1e-6 of each interval) towards the middle of the parameter box.
    ///
    /// # Errors
    ///
    /// As [`Self::normal`]; `SingularPoint` if the neighbour is singular as well.
    pub fn normal_nearby(&self, at: [f64; 2]) -> Result<DVec3, SurfaceError> {
        match self.normal(at) {
            Err(SurfaceError::SingularPoint { .. }) => {
                let step = |axis: usize| {
                    let (left, right) = self.space().parameter_box()[axis];
                    at[axis] + ((0.5 * left + 0.5 * right) - at[axis]).signum() * 1e-6 * (right - left)
                };
                self.normal([step(0), step(1)]).map_err(|_| SurfaceError::SingularPoint { at })
            }
            result => result,
        }
    }

    /// Curvatures at a point, at knots from the right.
    ///
    /// # Errors
    ///
    /// As [`Self::jet`]; `SingularPoint`.
    pub fn curvatures(&self, at: [f64; 2]) -> Result<Curvatures, SurfaceError> {
        self.jet(at, [Side::Right; 2])?.curvatures()
    }

    /// The curve on the surface where the parameter of direction `axis` is `t`; it runs in the other direction.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; `NonFinite`, `OutsideInterval` with the axis.
    pub fn iso_curve(&self, axis: usize, t: f64) -> Result<Nurbs<DVec3>, SurfaceError> {
        let (space, [_, columns]) = (self.space().axis(axis)?, self.shape());
        let other = &self.space().axes()[1 - axis];
        let on_axis = SurfaceError::on_axis(axis);
        let point = |line: usize| {
            let at = |k: usize| if axis == 0 { k * columns + line } else { line * columns + k };
            let lifted = (0..space.dimension()).map(|k| self.homogeneous.coefficients()[at(k)]).collect();
            Spline::new(space.clone(), lifted)?.evaluate(t)
        };
        let lifted: Vec<DVec4> =
            (0..other.dimension()).map(point).collect::<Result<_, _>>().map_err(&on_axis)?;
        let homogeneous = Spline::new(other.clone(), lifted).map_err(SurfaceError::on_axis(1 - axis))?;
        Nurbs::from_homogeneous(homogeneous).map_err(SurfaceError::on_axis(1 - axis))
    }

    /// One rational Bezier patch for each nonempty cell, row by row; periodic directions over one period.
    ///
    /// # Errors
    ///
    /// Those of knot insertion; none is known to occur.
    pub fn bezier_patches(&self) -> Result<Vec<RationalPatch>, SurfaceError> {
        let patches = self.homogeneous.bezier_form()?.into_iter().map(|piece| {
            let (points, weights) = piece.points.into_iter().map(DVec3::project).unzip();
            RationalPatch { cell: piece.cell, degrees: piece.degrees, points, weights }
        });
        Ok(patches.collect())
    }
}

impl From<SplineSurface> for NurbsSurface {
    /// The surface with all weights 1.
    fn from(net: SplineSurface) -> Self {
        let (space, points) = net.into_parts();
        Self::polynomial(space, points).expect("a spline surface has finite points, and 1 is a weight")
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::core::bspline::{EndKnots, SplineSpace};
    use crate::core::surface::samples;

    /// A rational surface, periodic in v, with a double knot in u.
    pub(in crate::core::surface) fn bumpy() -> NurbsSurface {
        let u = SplineSpace::from_breaks(3, &[0.0, 1.0, 2.5, 4.0], EndKnots::Interpolating).unwrap();
        let u = Spline::new(u.clone(), vec![0.0; u.dimension()])
            .unwrap()
            .insert_knot(1.0)
            .unwrap()
            .into_parts()
            .0;
        let v = SplineSpace::periodic(2, 4.0, vec![0.0, 0.5, 1.0, 2.0, 3.0]).unwrap();
        let space = TensorSplineSpace::new([u, v]).unwrap();
        let [rows, columns] = space.shape();
        let point = |i: usize| {
            let (row, angle) = ((i / columns) as f64, (i % columns) as f64 * 1.25);
            let radius = 1.0 + 0.3 * (row * 1.7).sin();
            DVec3::new(radius * angle.cos(), radius * angle.sin(), row)
        };
        let weights = (0..rows * columns).map(|i| 0.5 + (i * 7 % 5) as f64 * 0.3).collect();
        NurbsSurface::new(space, (0..rows * columns).map(point).collect(), weights).unwrap()
    }

    fn places() -> impl Iterator<Item = [f64; 2]> {
        (0..60).map(|i| [4.0 * f64::from(i) / 59.0, f64::from(i * 13 % 60) / 15.0])
    }

    #[test]
    fn constructions_that_keep_the_surface_keep_it() {
        let surface = bumpy();
        let (before, after) = surface.split(0, 1.7).unwrap();
        for at in places() {
            let expected = surface.evaluate(at).unwrap();
            let part = if at[0] < 1.7 { &before } else { &after };
            for (what, found) in [
                ("inserted u", surface.insert_knots(0, &[0.5, 2.0]).unwrap().evaluate(at)),
                ("inserted v", surface.insert_knots(1, &[0.7]).unwrap().evaluate(at)),
                ("elevated", surface.elevate_degree(0).unwrap().evaluate(at)),
                ("opened", surface.opened(1).unwrap().evaluate(at)),
                ("reversed", surface.reversed(0).unwrap().evaluate([4.0 - at[0], at[1]])),
                ("split", part.evaluate(at)),
                ("iso u", Ok(surface.iso_curve(0, at[0]).unwrap().evaluate(at[1]).unwrap())),
                ("iso v", Ok(surface.iso_curve(1, at[1]).unwrap().evaluate(at[0]).unwrap())),
                ("jet", surface.jet(at, [Side::Right; 2]).map(|jet| jet.point)),
            ] {
                let error = (found.unwrap() - expected).length();
                assert!(error < 1e-12, "{what} at {at:?}: off by {error}");
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let (surface, h) = (bumpy(), 1e-5);
        let jet = |u: f64, v: f64| surface.jet([u, v], [Side::Right; 2]).unwrap();
        for [u, v] in [[0.4, 0.3], [1.8, 2.2], [3.3, 3.7]] {
            let j = jet(u, v);
            let across = |f: fn(SurfaceJet) -> DVec3| {
                let u_difference = (f(jet(u + h, v)) - f(jet(u - h, v))) / (2.0 * h);
                [u_difference, (f(jet(u, v + h)) - f(jet(u, v - h))) / (2.0 * h)]
            };
            let [first, second, third] = [across(|j| j.point), across(|j| j.du), across(|j| j.dv)];
            for (found, expected) in
                [(first, [j.du, j.dv]), (second, [j.duu, j.duv]), (third, [j.duv, j.dvv])]
            {
                let error = (found[0] - expected[0]).length() + (found[1] - expected[1]).length();
                assert!(error < 1e-7, "at {u}, {v}: off by {error}");
            }
        }
    }

    #[test]
    fn patches_are_the_surface_at_their_corners() {
        let surface = bumpy();
        let patches = surface.bezier_patches().unwrap();
        assert_eq!(patches.len(), 15, "3 by 5 cells");
        for patch in &patches {
            let last = (patch.degrees[0] + 1) * (patch.degrees[1] + 1) - 1;
            for (place, at) in [
                (0, [patch.cell[0].0, patch.cell[1].0]),
                (patch.degrees[1], [patch.cell[0].0, patch.cell[1].1]),
                (last, [patch.cell[0].1, patch.cell[1].1]),
            ] {
                let error = (patch.points[place] - surface.evaluate(at).unwrap()).length();
                assert!(error < 1e-12, "corner {place} of {:?}: off by {error}", patch.cell);
            }
        }
    }

    #[test]
    fn the_pole_of_a_sphere_is_singular_but_its_normal_has_a_limit() {
        let octant = samples::sphere_octant();
        for i in 0..=10 {
            let u = f64::from(i) / 10.0;
            let error = octant.normal([u, 0.0]).unwrap_err();
            assert_eq!(error.name(), "SingularPoint", "pole at u = {u}");
            let near = octant.normal_nearby([u, 0.0]).unwrap();
            assert!((near - DVec3::NEG_Z).length() < 1e-5, "the limit points inwards: {near}");
        }
    }

    #[test]
    fn bad_weights_and_indices_are_named() {
        let surface = bumpy();
        let error = surface.with_weight([1, 2], -1.0).unwrap_err();
        assert!(
            matches!(error, SurfaceError::Tensor(TensorError::WeightNotPositive { index: 7, .. })),
            "{error}"
        );
        assert_eq!(
            surface.with_point([0, 5], DVec3::ZERO).unwrap_err().name(),
            "SizeMismatch",
            "no column 5"
        );
        assert_eq!(surface.with_point([0, 0], DVec3::NAN).unwrap_err().name(), "NonFinite", "no point");
        assert_eq!(surface.insert_knots(2, &[0.1]).unwrap_err().name(), "SizeMismatch", "no third direction");
    }
}
