//! Derivatives of Bezier curves.
//!
//! `p⁽ᵐ⁾ = n!/(n−m)! Σ Δᵐcₖ bⁿ⁻ᵐₖ/(b − a)ᵐ`: derivatives are Bezier curves (hodographs), and the `m`-th is also the `m`-th difference of level
//! `n − m` of de Casteljau's scheme. Course: section 2.4.

use crate::core::bezier::curve::BezierCurve;
use crate::core::bezier::error::BezierError;
use crate::core::point::Point;

impl<P: Point> BezierCurve<P> {
    /// The derivative, a curve of degree `n − 1` over the same interval; for degree 0 the origin.
    ///
    /// # Errors
    ///
    /// `NonFinite` with the index of a control point that overflows.
    pub fn derivative(&self) -> Result<Self, BezierError> {
        self.hodograph(1)
    }

    /// The derivative of the given order, a curve of degree `n − order`; beyond the degree it is the origin, of degree 0.
    ///
    /// # Errors
    ///
    /// As [`Self::derivative`].
    pub fn hodograph(&self, order: usize) -> Result<Self, BezierError> {
        let width = self.width();
        let mut points = self.points().to_vec();
        for _ in 0..order {
            let n = points.len() - 1;
            if n == 0 {
                points[0] = P::ZERO;
                break;
            }
            for k in 0..n {
                points[k] = (points[k + 1] - points[k]) * (n as f64 / width);
            }
            points.truncate(n);
        }
        Self::on_interval(points, self.interval())
    }

    /// `p(x), p′(x), …, p⁽ᶜᵒᵘⁿᵗ⁾(x)`; beyond the degree they are 0.
    ///
    /// # Errors
    ///
    /// `NonFinite` for the parameter, or with the order of a derivative that overflows.
    pub fn derivatives(&self, x: f64, count: usize) -> Result<Vec<P>, BezierError> {
        let mut values = vec![P::ZERO; count + 1];
        self.write_derivatives(x, &mut self.points().to_vec(), &mut values)?;
        Ok(values)
    }

    /// As [`Self::derivatives`] up to the order `values.len() − 1`, written into `values`; `scratch` has room for `2 n + 2` points
    /// or gets it, so that repeated calls do not allocate.
    ///
    /// # Errors
    ///
    /// As [`Self::derivatives`].
    pub fn write_derivatives(
        &self,
        x: f64,
        scratch: &mut Vec<P>,
        values: &mut [P],
    ) -> Result<(), BezierError> {
        let t = self.local_parameter(x)?;
        let (n, width) = (self.degree(), self.width());
        let orders = values.len().min(n + 1);
        scratch.clear();
        scratch.extend_from_slice(self.points());
        scratch.extend_from_slice(self.points());
        let (level, differences) = scratch.split_at_mut(n + 1);
        for count in (1..=n + 1).rev() {
            // `level[..count]` is level n + 1 − count of the scheme.
            let m = count - 1;
            if m < orders {
                differences[..count].copy_from_slice(&level[..count]);
                for step in (1..count).rev() {
                    for k in 0..step {
                        differences[k] = differences[k + 1] - differences[k];
                    }
                }
                values[m] = differences[0] * (0..m).map(|j| (n - j) as f64 / width).product();
            }
            for j in 0..count - 1 {
                level[j] = level[j].mix(level[j + 1], t);
            }
        }
        values[orders..].fill(P::ZERO);
        match values.iter().position(|value| !value.is_finite()) {
            Some(index) => {
                let value = values[index].norm();
                Err(BezierError::NonFinite { what: "derivative", index, value })
            }
            None => Ok(()),
        }
    }

    /// `b − a`.
    pub(super) fn width(&self) -> f64 {
        self.interval().1 - self.interval().0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use proptest::prelude::*;

    fn curves() -> impl Strategy<Value = BezierCurve<DVec2>> {
        let point = (-4.0..4.0_f64, -4.0..4.0_f64).prop_map(DVec2::from);
        (prop::collection::vec(point, 1..9), -2.0..2.0_f64, 0.2..3.0_f64)
            .prop_map(|(points, a, width)| BezierCurve::on_interval(points, (a, a + width)).unwrap())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_scheme_gives_the_hodographs(curve in curves(), t in 0.0..=1.0_f64) {
            let x = curve.interval().0.mix(curve.interval().1, t);
            let values = curve.derivatives(x, 10).unwrap();
            for (order, value) in values.iter().enumerate() {
                let hodograph = curve.hodograph(order).unwrap();
                let size = hodograph.points().iter().map(|c| c.length()).fold(1.0, f64::max);
                let gap = (hodograph.evaluate(x).unwrap() - *value).length();
                prop_assert!(gap < 1e-11 * size, "order {order}: {gap}");
            }
        }

        #[test]
        fn the_derivative_is_the_limit_of_difference_quotients(curve in curves(), t in 0.0..=1.0_f64) {
            let x = curve.interval().0.mix(curve.interval().1, t);
            let at = |x| curve.evaluate(x).unwrap();
            let exact = curve.derivatives(x, 1).unwrap()[1];
            let error = |h: f64| ((at(x + h) - at(x - h)) / (2.0 * h) - exact).length();
            let (coarse, fine) = (error(0.02), error(0.01));
            prop_assert!(fine < 0.3 * coarse + 1e-9, "order 2: {coarse} then {fine}");
        }

        #[test]
        fn derivatives_feel_the_linear_part_of_a_map_and_the_direction(curve in curves(), t in 0.0..=1.0_f64) {
            let linear = |p: DVec2| DVec2::new(2.0 * p.x - p.y, p.x + 0.5 * p.y);
            let image = curve.transformed(|p| linear(p) + DVec2::new(3.0, -1.0)).unwrap();
            let (a, b) = curve.interval();
            let (x, mirrored) = (a.mix(b, t), b.mix(a, t));
            let mine = curve.derivatives(x, 4).unwrap();
            let theirs = image.derivatives(x, 4).unwrap();
            let back = curve.reversed().derivatives(mirrored, 4).unwrap();
            for m in 1..=4 {
                let size = 1.0 + mine[m].length() + 1e3_f64.powi(m as i32) * 0.01;
                prop_assert!((linear(mine[m]) - theirs[m]).length() < 1e-9 * size, "order {m}");
                let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
                prop_assert!((back[m] * sign - mine[m]).length() < 1e-9 * size, "reversed, order {m}");
            }
        }
    }

    #[test]
    fn what_overflows_is_refused() {
        let curve = BezierCurve::new(vec![1e308, -1e308, 1e308]).unwrap();
        assert_eq!(curve.derivative().unwrap_err().name(), "NonFinite", "hodograph");
        assert_eq!(curve.derivatives(0.0, 1).unwrap_err().name(), "NonFinite", "first derivative");
        assert_eq!(curve.derivatives(f64::NAN, 1).unwrap_err().name(), "NonFinite", "parameter");
        assert_eq!(curve.derivatives(0.5, 0).unwrap().len(), 1, "the value is fine");
        let mut nothing = [];
        curve.write_derivatives(0.5, &mut Vec::new(), &mut nothing).unwrap();
    }
}
