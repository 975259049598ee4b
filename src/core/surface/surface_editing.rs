//! Surfaces made from a NURBS surface: other points and weights, more knots, a higher degree, parts. Course: section 8.2.

use glam::DVec3;

use crate::core::bspline::SplineError;
use crate::core::spline_curve::Nurbs;
use crate::core::surface::error::SurfaceError;
use crate::core::surface::nurbs_surface::NurbsSurface;
use crate::core::tensor::{TensorError, TensorSplineSpace};

impl NurbsSurface {
    /// The surface with control point `k` replaced; the weight stays.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such point, `NonFinite`.
    pub fn with_point(&self, k: [usize; 2], point: DVec3) -> Result<Self, SurfaceError> {
        let mut points = self.points().to_vec();
        points[self.place(k)?] = point;
        Self::new(self.space().clone(), points, self.weights().to_vec())
    }

    /// The surface with weight `k` replaced; the control point stays.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such weight, `NonFinite`, `WeightNotPositive`.
    pub fn with_weight(&self, k: [usize; 2], weight: f64) -> Result<Self, SurfaceError> {
        let mut weights = self.weights().to_vec();
        weights[self.place(k)?] = weight;
        Self::new(self.space().clone(), self.points().to_vec(), weights)
    }

    fn place(&self, k: [usize; 2]) -> Result<usize, TensorError> {
        for (&found, expected) in k.iter().zip(self.shape()) {
            if found >= expected {
                return Err(TensorError::SizeMismatch {
                    what: "as index of a control point",
                    expected,
                    found,
                });
            }
        }
        Ok(self.space().flat_index(k))
    }

    /// The surface with every control point mapped; an affine map maps the surface.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the place of the first control point that is mapped to no point.
    pub fn transformed(&self, map: impl Fn(DVec3) -> DVec3) -> Result<Self, SurfaceError> {
        let points = self.points().iter().map(|&point| map(point)).collect();
        Self::new(self.space().clone(), points, self.weights().to_vec())
    }

    /// Runs a construction of curves on every line of the net in direction `axis`; all lines must come out with the same knots.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such direction; those of `construct` with the axis.
    pub fn map_lines(
        &self,
        axis: usize,
        construct: impl Fn(&Nurbs<DVec3>) -> Result<Nurbs<DVec3>, SplineError>,
    ) -> Result<Self, SurfaceError> {
        let (line_space, [rows, columns]) = (self.space().axis(axis)?, self.shape());
        let (lines, count) = if axis == 0 { (columns, rows) } else { (rows, columns) };
        let place = |line: usize, k: usize, count: usize| {
            if axis == 0 { k * lines + line } else { line * count + k }
        };
        let (mut points, mut weights, mut space) = (Vec::new(), Vec::new(), line_space.clone());
        for line in 0..lines {
            let at = |k: usize| place(line, k, count);
            let old_points = (0..count).map(|k| self.points()[at(k)]).collect();
            let old_weights = (0..count).map(|k| self.weights()[at(k)]).collect();
            let curve = Nurbs::new(line_space.clone(), old_points, old_weights)
                .and_then(|curve| construct(&curve))
                .map_err(SurfaceError::on_axis(axis))?;
            let new_count = curve.points().len();
            points.resize(lines * new_count, DVec3::ZERO);
            weights.resize(lines * new_count, 0.0);
            for k in 0..new_count {
                points[place(line, k, new_count)] = curve.points()[k];
                weights[place(line, k, new_count)] = curve.weights()[k];
            }
            space = curve.space().clone();
        }
        let mut axes = self.space().axes().clone();
        axes[axis] = space;
        Self::new(TensorSplineSpace::new(axes)?, points, weights)
    }

    /// The same surface with more knots in one direction; points and weights that stay are kept bit by bit.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; `NonFinite`, `OutsideInterval`, `KnotMultiplicityTooHigh` with the axis.
    pub fn insert_knots(&self, axis: usize, new: &[f64]) -> Result<Self, SurfaceError> {
        self.map_lines(axis, |curve| curve.insert_knots(new))
    }

    /// The same surface with the degree of one direction raised by one.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; `StepLimit` with the axis.
    pub fn elevate_degree(&self, axis: usize) -> Result<Self, SurfaceError> {
        self.map_lines(axis, Nurbs::elevate_degree)
    }

    /// The same surface with one direction run backwards, which turns the normal.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist.
    pub fn reversed(&self, axis: usize) -> Result<Self, SurfaceError> {
        self.map_lines(axis, Nurbs::reversed)
    }

    /// The same surface with end-interpolating knots in one direction, over one period if it was periodic.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist.
    pub fn opened(&self, axis: usize) -> Result<Self, SurfaceError> {
        self.map_lines(axis, Nurbs::opened)
    }

    /// The parts before and after parameter `t` of one direction.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` for a direction that does not exist; `NonFinite`, `OutsideInterval` with the axis.
    pub fn split(&self, axis: usize, t: f64) -> Result<(Self, Self), SurfaceError> {
        let before = self.map_lines(axis, |curve| Ok(curve.split(t)?.0))?;
        let after = self.map_lines(axis, |curve| Ok(curve.split(t)?.1))?;
        Ok((before, after))
    }
}
