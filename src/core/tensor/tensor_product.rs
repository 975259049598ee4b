//! Splines of two and three variables: `p(x) = Σ c_k b_k(x)`, coefficients row-major with the first index slowest.
//!
//! Evaluation contracts one direction after the other, `Σ_{k₁} b_{k₁}(x₁) Σ_{k₂} b_{k₂}(x₂) …`, over the active block only.
//! Course: sections 7.3 and 7.4.

use crate::core::bspline::{MAX_DEGREE, Side, Spline, SplineError};
use crate::core::point::Point;
use crate::core::tensor::error::TensorError;
use crate::core::tensor::space::TensorSplineSpace;

/// The tensor counterpart of [`Spline`]: coefficients of any [`Point`] over a [`TensorSplineSpace`].
#[derive(Clone, Debug, PartialEq)]
pub struct TensorSpline<P, const D: usize> {
    space: TensorSplineSpace<D>,
    coefficients: Vec<P>,
}

/// All partial derivatives up to one order in each direction.
#[derive(Clone, Debug, PartialEq)]
pub struct PartialDerivatives<P> {
    order: usize,
    values: Vec<P>,
}

impl<P: Point> PartialDerivatives<P> {
    /// The derivative of order `orders[ν]` in direction `ν`; `None` above the order asked for.
    pub fn get<const D: usize>(&self, orders: [usize; D]) -> Option<P> {
        let inside = orders.iter().all(|&order| order <= self.order);
        let place = orders.iter().fold(0, |place, &order| place * (self.order + 1) + order);
        inside.then(|| self.values.get(place).copied()).flatten()
    }
}

impl<P: Point, const D: usize> TensorSpline<P, D> {
    /// The spline with the given coefficients, `∏ m_ν` of them, row-major.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`, `NonFinite` with the place of the coefficient.
    pub fn new(space: TensorSplineSpace<D>, coefficients: Vec<P>) -> Result<Self, TensorError> {
        if coefficients.len() != space.dimension() {
            let (expected, found) = (space.dimension(), coefficients.len());
            return Err(TensorError::SizeMismatch { what: "coefficients", expected, found });
        }
        if let Some(index) = coefficients.iter().position(|point| !point.is_finite()) {
            let point = coefficients[index];
            let bad = (0..P::DIMENSION).map(|i| point.coordinate(i)).find(|value| !value.is_finite());
            let value = bad.unwrap_or(f64::NAN);
            return Err(TensorError::NonFinite { what: "coefficient", index, value });
        }
        Ok(Self { space, coefficients })
    }

    /// The space.
    pub fn space(&self) -> &TensorSplineSpace<D> {
        &self.space
    }

    /// The coefficients, row-major.
    pub fn coefficients(&self) -> &[P] {
        &self.coefficients
    }

    /// Coefficient `k`; `None` outside the array.
    pub fn coefficient(&self, k: [usize; D]) -> Option<P> {
        let inside = k.iter().zip(self.space.shape()).all(|(&k, count)| k < count);
        inside.then(|| self.coefficients[self.space.flat_index(k)])
    }

    /// Space and coefficients.
    pub fn into_parts(self) -> (TensorSplineSpace<D>, Vec<P>) {
        (self.space, self.coefficients)
    }

    /// `p(x)`; any parameter in a periodic direction. Does not allocate.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn evaluate(&self, x: [f64; D]) -> Result<P, TensorError> {
        let mut rows = [[0.0; MAX_DEGREE + 1]; D];
        let mut first = [0; D];
        for axis in 0..D {
            let space = &self.space.axes()[axis];
            let row = &mut rows[axis][..=space.degree()];
            first[axis] = space.write_active_basis(x[axis], row).map_err(TensorError::on_axis(axis))?;
        }
        Ok(self.contract(first, std::array::from_fn(|axis| rows[axis].as_slice())))
    }

    /// All partial derivatives of orders `0 … order` in each direction, the limits from `sides` at knots.
    ///
    /// Derivatives above the degree of their direction are zero.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval` with the axis.
    pub fn derivatives(
        &self,
        x: [f64; D],
        order: usize,
        sides: [Side; D],
    ) -> Result<PartialDerivatives<P>, TensorError> {
        let mut rows: [Vec<f64>; D] = std::array::from_fn(|_| Vec::new());
        let mut first = [0; D];
        for axis in 0..D {
            let space = &self.space.axes()[axis];
            rows[axis] = vec![0.0; (order + 1) * (space.degree() + 1)];
            first[axis] = space
                .write_basis_derivatives(x[axis], order, sides[axis], &mut rows[axis])
                .map_err(TensorError::on_axis(axis))?;
        }
        let count = (order + 1).pow(D as u32);
        let value = |mut place: usize| {
            let mut orders = [0; D];
            for axis in (0..D).rev() {
                orders[axis] = place % (order + 1);
                place /= order + 1;
            }
            let row = |axis: usize| {
                let width = self.space.axes()[axis].degree() + 1;
                &rows[axis][orders[axis] * width..(orders[axis] + 1) * width]
            };
            self.contract(first, std::array::from_fn(row))
        };
        Ok(PartialDerivatives { order, values: (0..count).map(value).collect() })
    }

    /// Sum of the second derivatives in all directions, the limit from `sides` at knots.
    ///
    /// # Errors
    ///
    /// As [`Self::derivatives`].
    pub fn laplacian(&self, x: [f64; D], sides: [Side; D]) -> Result<P, TensorError> {
        let all = self.derivatives(x, 2, sides)?;
        let second = |axis: usize| all.get::<D>(std::array::from_fn(|other| 2 * usize::from(other == axis)));
        Ok((0..D).filter_map(second).fold(P::ZERO, |sum, value| sum + value))
    }

    /// `Σ c_{first + j} ∏ rows[ν][j_ν]` over the active block; `first` and `j` count the evaluation knots' B-splines.
    pub(crate) fn contract(&self, first: [usize; D], rows: [&[f64]; D]) -> P {
        self.contract_from(0, 0, &first, &rows)
    }

    fn contract_from(&self, axis: usize, base: usize, first: &[usize; D], rows: &[&[f64]; D]) -> P {
        let space = &self.space.axes()[axis];
        let base = base * space.dimension();
        let mut sum = P::ZERO;
        for j in 0..=space.degree() {
            let index = base + space.coefficient_index(first[axis] + j);
            let value = if axis + 1 == D {
                self.coefficients[index]
            } else {
                self.contract_from(axis + 1, index, first, rows)
            };
            sum = sum + value * rows[axis][j];
        }
        sum
    }

    /// Runs a construction of one variable on every coefficient line in direction `axis`.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` if there is no such direction; those of `construct` with the axis.
    pub fn map_lines<Q: Point>(
        &self,
        axis: usize,
        construct: impl Fn(&Spline<P>) -> Result<Spline<Q>, SplineError>,
    ) -> Result<TensorSpline<Q, D>, TensorError> {
        let line_space = self.space.axis(axis)?;
        let (count, shape) = (line_space.dimension(), self.space.shape());
        let stride: usize = shape[axis + 1..].iter().product();
        let blocks: usize = shape[..axis].iter().product();
        let mut new: Vec<Q> = Vec::new();
        let mut new_space = line_space.clone();
        for line in 0..blocks * stride {
            let (block, within) = (line / stride, line % stride);
            let place = |k: usize, count: usize| (block * count + k) * stride + within;
            let coefficients = (0..count).map(|k| self.coefficients[place(k, count)]).collect();
            let (space, mapped) = Spline::new(line_space.clone(), coefficients)
                .and_then(|spline| construct(&spline))
                .map_err(TensorError::on_axis(axis))?
                .into_parts();
            new.resize(blocks * stride * mapped.len(), Q::ZERO);
            for (k, &coefficient) in mapped.iter().enumerate() {
                new[place(k, mapped.len())] = coefficient;
            }
            new_space = space;
        }
        let mut axes = self.space.axes().clone();
        axes[axis] = new_space;
        TensorSpline::new(TensorSplineSpace::new(axes)?, new)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::core::bspline::{SplineSpace, basis_function};
    use glam::DVec3;
    use proptest::prelude::*;

    /// A spline of three variables with an inner double knot, a periodic direction and degree 1.
    pub(in crate::core::tensor) fn mixed() -> TensorSpline<DVec3, 3> {
        let open = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 4.0, 5.0, 5.5, 7.0]).unwrap();
        let closed = SplineSpace::periodic(2, 4.0, vec![0.0, 0.5, 1.0, 3.0]).unwrap();
        let line = SplineSpace::uniform(1, 0.0, 1.0, 3).unwrap();
        let space = TensorSplineSpace::new([open, closed, line]).unwrap();
        let point = |i: usize| DVec3::new((i * 7 % 11) as f64, (i * i % 13) as f64 - 4.0, (i * 3 % 5) as f64);
        let coefficients = (0..space.dimension()).map(point).collect();
        TensorSpline::new(space, coefficients).unwrap()
    }

    proptest! {
        #[test]
        fn the_value_is_the_sum_over_all_products(x in 0.0..4.0_f64, y in 0.0..4.0_f64, z in 0.0..1.0_f64) {
            let spline = mixed();
            let space = spline.space();
            let single = |axis: usize, k: usize, x: f64| {
                let line = &space.axes()[axis];
                let knots: Vec<f64> =
                    (k..=k + line.degree() + 1).filter_map(|i| line.knot(i as isize)).collect();
                let period = line.period().unwrap_or(f64::INFINITY);
                let copies: &[f64] = if line.is_periodic() { &[0.0, 1.0, 2.0] } else { &[] };
                let copies = copies.iter().map(|turn| basis_function(line.degree(), &knots, x + turn * period));
                let first = basis_function(line.degree(), &knots, x).unwrap();
                if line.is_periodic() { copies.map(Result::unwrap).sum() } else { first }
            };
            let mut slow = DVec3::ZERO;
            for (place, &c) in spline.coefficients().iter().enumerate() {
                let k = space.multi_index(place);
                slow += c * (single(0, k[0], x) * single(1, k[1], y) * single(2, k[2], z));
            }
            let fast = spline.evaluate([x, y, z]).unwrap();
            prop_assert!((fast - slow).length() < 1e-11, "{fast} and {slow}");
        }
    }

    #[test]
    fn mixed_derivatives_agree_with_differences_and_commute() {
        let (spline, h) = (mixed(), 1e-5);
        let sides = [Side::Right; 3];
        let at = [2.2, 1.7, 0.4];
        let all = spline.derivatives(at, 2, sides).unwrap();
        let first = |x: f64, axis: usize, orders: [usize; 3]| {
            let mut moved = at;
            moved[axis] += x;
            spline.derivatives(moved, 2, sides).unwrap().get(orders).unwrap()
        };
        for (axis, lower, upper) in [
            (0, [0, 0, 0], [1, 0, 0]),
            (1, [1, 0, 0], [1, 1, 0]),
            (0, [0, 1, 0], [1, 1, 0]),
            (2, [1, 1, 0], [1, 1, 1]),
            (0, [1, 0, 1], [2, 0, 1]),
        ] {
            let difference = (first(h, axis, lower) - first(-h, axis, lower)) / (2.0 * h);
            let error = (difference - all.get(upper).unwrap()).length();
            assert!(error < 1e-6, "∂{axis} of {lower:?}: off by {error}");
        }
        assert_eq!(all.get([0, 0, 2]), Some(DVec3::ZERO), "degree 1 has no second derivative");
        assert_eq!(all.get([0, 3, 0]), None, "not asked for");
    }

    #[test]
    fn a_bad_coefficient_is_named() {
        let (space, mut coefficients) = mixed().into_parts();
        coefficients[5].y = f64::INFINITY;
        let error = TensorSpline::new(space.clone(), coefficients.clone()).unwrap_err();
        assert!(matches!(error, TensorError::NonFinite { index: 5, .. }), "{error}");
        coefficients.pop();
        assert_eq!(TensorSpline::new(space, coefficients).unwrap_err().name(), "SizeMismatch", "one too few");
        let error = mixed().evaluate([0.0, f64::NAN, 0.0]).unwrap_err();
        assert!(matches!(error, TensorError::Axis { axis: 1, .. }), "{error}");
    }
}
