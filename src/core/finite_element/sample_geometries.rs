//! Plane patches that are worth having by name.
//!
//! Course: sections 9.3 and 9.5.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::geometry::PlanePatch;

/// The unit square; the parameters are the coordinates.
pub fn unit_square() -> PlanePatch {
    rectangle(DVec2::ZERO, DVec2::ONE)
}

/// The course's patch of degree (1, 2): `φ = ((1 − t₁)t₂ + 4t₁t₂, (1 − t₁)(1 + t₂²) + 2t₁t₂²)` on the unit square.
///
/// Its bottom side (`t₂ = 0`) lies on the axis `x₁ = 0`; its area is 14/3.
pub fn book_patch() -> PlanePatch {
    bezier([1, 2], DVec2::ONE, &[[0.0, 1.0], [0.5, 1.0], [1.0, 2.0], [0.0, 0.0], [2.0, 0.0], [4.0, 2.0]])
}

/// The course's channel of degree (3, 1) over `[0, 2] × [0, 1]`; it runs from the left, narrows, and ends on the right.
pub fn channel() -> PlanePatch {
    let points = [
        [0.0, 10.0],
        [0.0, 20.0],
        [21.0, 15.0],
        [18.0, 12.0],
        [9.0, 0.0],
        [9.0, 10.0],
        [33.0, 0.0],
        [33.0, 10.0],
    ];
    bezier([3, 1], DVec2::new(2.0, 1.0), &points)
}

/// A quarter of the annulus between two radii, exact: `t₁` runs outward, `t₂` from the first axis to the second.
///
/// # Errors
///
/// `NonFinite`; `OutsideInterval` unless `0 < inner < outer`.
pub fn quarter_annulus(inner: f64, outer: f64) -> Result<PlanePatch, FiniteElementError> {
    annulus_quarter(inner, outer, DVec2::X, DVec2::Y)
}

/// The whole annulus as four quarters, in the order of the quadrants.
///
/// # Errors
///
/// As [`quarter_annulus`].
pub fn annulus(inner: f64, outer: f64) -> Result<Vec<PlanePatch>, FiniteElementError> {
    let axes = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
    (0..4).map(|i| annulus_quarter(inner, outer, axes[i], axes[(i + 1) % 4])).collect()
}

/// The L-shaped domain `[−1, 1]² \ [0, 1] × [−1, 0]` as three unit squares.
pub fn l_shape() -> Vec<PlanePatch> {
    [[-1.0, -1.0], [-1.0, 0.0], [0.0, 0.0]]
        .map(|corner| rectangle(DVec2::from(corner), DVec2::from(corner) + DVec2::ONE))
        .to_vec()
}

fn rectangle(low: DVec2, high: DVec2) -> PlanePatch {
    bezier([1, 1], DVec2::ONE, &[[low.x, low.y], [low.x, high.y], [high.x, low.y], [high.x, high.y]])
}

fn bezier(degrees: [usize; 2], size: DVec2, points: &[[f64; 2]]) -> PlanePatch {
    let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
    let weights = vec![1.0; points.len()];
    PlanePatch::bezier(degrees, size, points, weights).expect("the numbers written here make a patch")
}

fn annulus_quarter(inner: f64, outer: f64, from: DVec2, to: DVec2) -> Result<PlanePatch, FiniteElementError> {
    if !(inner > 0.0 && inner < outer) {
        return Err(SplineError::OutsideInterval { value: inner, left: 0.0, right: outer }.into());
    }
    let corner = from + to;
    let points = [inner, outer].map(|radius| [from * radius, corner * radius, to * radius]).concat();
    let weights = [1.0, FRAC_1_SQRT_2, 1.0].repeat(2);
    PlanePatch::bezier([1, 2], DVec2::ONE, points, weights)
}
