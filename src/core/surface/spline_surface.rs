//! Polynomial spline surfaces: tensor splines of two variables with points of space. Course: section 8.2.

use glam::DVec3;

use crate::core::bspline::Side;
use crate::core::surface::curvature::SurfaceJet;
use crate::core::surface::error::SurfaceError;
use crate::core::surface::nurbs_surface::NurbsSurface;
use crate::core::tensor::TensorSpline;

/// `p(u, v) = Σ c_{k₁k₂} b_{k₁}(u) b_{k₂}(v)`; u is axis 0 and counts the rows of the net, v is axis 1 and counts the columns.
pub type SplineSurface = TensorSpline<DVec3, 2>;

impl SplineSurface {
    /// Point and derivatives up to order two, the limits from `sides` at knots.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn jet(&self, at: [f64; 2], sides: [Side; 2]) -> Result<SurfaceJet, SurfaceError> {
        NurbsSurface::from(self.clone()).jet(at, sides)
    }
}
