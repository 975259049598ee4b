//! The pieces of a spline as polynomials, for many evaluations.
//!
//! Over a nonempty knot interval `[a, b]` with middle `o` and half width `h`,
//!
//! ```text
//! p(x) = Σⱼ qⱼ uʲ,   qⱼ = hʲ/j! p⁽ʲ⁾(o),   u = (x − o)/h ∈ [−1, 1],
//! ```
//!
//! evaluated by Horner's scheme. A piece with `|p| ≤ 1` has `Σ|qⱼ| ≤ (1 + √2)ⁿ` (the coefficients of Chebyshev polynomials are the
//! largest), so rounding grows by that factor: 14 for cubics, 82 for degree 5, but 10⁹ for degree 25, for which de Boor's algorithm is
//! the better choice. The piece of an `x` is found through a table over equal parts of D. Course: section 4.4.

use crate::core::bspline::error::SplineError;
use crate::core::bspline::space::{MAX_DEGREE, SplineSpace};
use crate::core::bspline::spline::Spline;
use crate::core::point::Point;

/// Parts of the table for each piece, on average.
const PARTS_PER_PIECE: usize = 2;
/// So many ends of pieces are compared with every parameter, without a branch; where a part of the table has more, the rest is halved.
const AHEAD: usize = 4;

/// A spline prepared for many evaluations: over `[a, b]` with middle `o` and half width `h` the piece `Σⱼ qⱼ uʲ` with `u = (x − o)/h` and
/// `qⱼ = hʲ/j! p⁽ʲ⁾(o)`.
///
/// Rounding grows by at most `(1 + √2)ⁿ`: 14 for cubics, 82 for degree 5, but 10⁹ for degree 25, where
/// [`Spline::evaluate_into`] is the better choice.
///
/// ```
/// use spline_lab::core::bspline::{EndKnots, PowerForm, Spline, SplineSpace};
///
/// let space = SplineSpace::from_breaks(2, &[0.0, 1.0, 3.0], EndKnots::Interpolating)?;
/// let spline = Spline::new(space, vec![1.0, -1.0, 0.5, 2.0])?;
/// let prepared = PowerForm::new(&spline);
/// let mut values = [0.0; 3];
/// prepared.evaluate_into(&[0.0, 1.5, 3.0], &mut values)?;
/// assert_eq!([values[0], values[2]], [1.0, 2.0]);
/// # Ok::<(), spline_lab::core::bspline::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PowerForm<P> {
    space: SplineSpace,
    /// Ends of the pieces, and behind them `AHEAD` times infinity.
    breaks: Vec<f64>,
    /// Middle and reciprocal half width of each piece.
    frames: Vec<Frame>,
    /// `n + 1` coefficients for each piece, the highest power first.
    coefficients: Vec<P>,
    table: Table,
}

/// The local variable of a piece: `u = (x − middle)·per_unit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    middle: f64,
    per_unit: f64,
}

/// Number `j`: the last piece that begins before part `j`.
#[derive(Clone, Debug, PartialEq)]
struct Table {
    start: f64,
    parts_per_unit: f64,
    before: Vec<u32>,
}

impl Frame {
    /// That of `[a, b]`, `a < b`.
    pub(super) fn new(a: f64, b: f64) -> Self {
        // Half of the sum could overflow, halves of tiny ends vanish: neither matters beside the other.
        Self { middle: 0.5 * a + 0.5 * b, per_unit: 2.0 / (b - a) }
    }

    #[inline(always)]
    pub(super) fn local(self, x: f64) -> f64 {
        (x - self.middle) * self.per_unit
    }
}

/// Coefficients of the piece over `span`, the highest power first.
pub(super) fn fill_piece<P: Point>(spline: &Spline<P>, span: usize, frame: Frame, piece: &mut [P]) {
    let mut values = [P::ZERO; MAX_DEGREE + 1];
    let count = piece.len();
    spline.derivatives_in_span(span, frame.middle, &mut values[..count]);
    let mut factor = 1.0;
    for (j, (slot, &value)) in piece.iter_mut().rev().zip(&values).enumerate() {
        if j > 0 {
            factor /= frame.per_unit * j as f64;
        }
        *slot = value * factor;
    }
}

/// Horner's scheme.
#[inline(always)]
pub(super) fn horner<P: Point>(piece: &[P], u: f64) -> P {
    let mut value = piece[0];
    for &next in &piece[1..] {
        value = value * u + next;
    }
    value
}

impl<P: Point> PowerForm<P> {
    /// The pieces of `spline`; linear in their number.
    pub fn new(spline: &Spline<P>) -> Self {
        let (space, n) = (spline.space(), spline.degree());
        let knots = space.evaluation_knots();
        let spans = || (n..space.evaluation_dimension()).filter(|&span| knots[span] < knots[span + 1]);
        let count = spans().count();
        let mut breaks: Vec<f64> = Vec::with_capacity(count + 1 + AHEAD);
        let mut frames = Vec::with_capacity(count);
        let mut coefficients = vec![P::ZERO; count * (n + 1)];
        for (span, piece) in spans().zip(coefficients.chunks_exact_mut(n + 1)) {
            let frame = Frame::new(knots[span], knots[span + 1]);
            fill_piece(spline, span, frame, piece);
            breaks.push(knots[span]);
            frames.push(frame);
        }
        breaks.push(space.parameter_interval().1);
        let table = Table::new(&breaks);
        breaks.resize(count + 1 + AHEAD, f64::INFINITY);
        Self { space: space.clone(), breaks, frames, coefficients, table }
    }

    /// The space of the spline.
    pub fn space(&self) -> &SplineSpace {
        &self.space
    }

    /// `p(x)` for `x` in D, for any `x` if periodic; at a knot the value from the right.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn evaluate(&self, x: f64) -> Result<P, SplineError> {
        let x = self.reduce(x)?;
        let index = self.find(x);
        Ok(horner(self.piece(index), self.frames[index].local(x)))
    }

    /// `out[i] = p(xs[i])`, without allocating. Sorted parameters are the quickest, but any order will do.
    ///
    /// # Errors
    ///
    /// `SizeMismatch` unless both slices are of the same length; those of [`Self::evaluate`], with the index of the first bad parameter
    /// in `NonFinite`. What stands in `out` then is unspecified.
    pub fn evaluate_into(&self, xs: &[f64], out: &mut [P]) -> Result<(), SplineError> {
        match self.space.degree() {
            1 => self.evaluate_degree::<2>(xs, out),
            2 => self.evaluate_degree::<3>(xs, out),
            3 => self.evaluate_degree::<4>(xs, out),
            4 => self.evaluate_degree::<5>(xs, out),
            5 => self.evaluate_degree::<6>(xs, out),
            _ => self.walk(xs, out, |piece, u, _| horner(piece, u)),
        }
    }

    /// `out[i] = [p, p′, …]` at `xs[i]`: `K ≥ 1` values, derivatives above the degree being zero; at a knot those from the right.
    ///
    /// # Errors
    ///
    /// As [`Self::evaluate_into`].
    pub fn derivatives_into<const K: usize>(
        &self,
        xs: &[f64],
        out: &mut [[P; K]],
    ) -> Result<(), SplineError> {
        match self.space.degree() {
            3 => self.walk(xs, out, |piece, u, frame| {
                let piece: &[P; 4] = piece.try_into().expect("four coefficients");
                derivatives(piece, u, frame)
            }),
            _ => self.walk(xs, out, |piece, u, frame| derivatives(piece, u, frame)),
        }
    }

    fn evaluate_degree<const N: usize>(&self, xs: &[f64], out: &mut [P]) -> Result<(), SplineError> {
        self.walk(xs, out, |piece, u, _| {
            let piece: &[P; N] = piece.try_into().expect("n + 1 coefficients");
            horner(piece, u)
        })
    }

    /// `out[i]` is what `value` makes of the piece and the local variable of `xs[i]`.
    #[inline(always)]
    fn walk<T>(
        &self,
        xs: &[f64],
        out: &mut [T],
        value: impl Fn(&[P], f64, Frame) -> T,
    ) -> Result<(), SplineError> {
        if xs.len() != out.len() {
            return Err(SplineError::SizeMismatch { what: "values", expected: xs.len(), found: out.len() });
        }
        let mut index = 0;
        let mut ends = (self.breaks[0], self.breaks[1]);
        let (start, end) = (ends.0, self.breaks[self.frames.len()]);
        for (i, (&given, slot)) in xs.iter().zip(out).enumerate() {
            let mut x = given;
            if !(ends.0 <= x && x < ends.1) {
                if !(start <= x && x < end) {
                    x = self.reduce(x).map_err(|error| at_index(error, i))?;
                }
                index = self.find(x);
                ends = (self.breaks[index], self.breaks[index + 1]);
            }
            let frame = self.frames[index];
            *slot = value(self.piece(index), frame.local(x), frame);
        }
        Ok(())
    }

    /// `x` in one period, whose end is the start of the next.
    fn reduce(&self, x: f64) -> Result<f64, SplineError> {
        let x = self.space.reduce(x)?;
        let (start, end) = self.space.parameter_interval();
        Ok(if x >= end && self.space.is_periodic() { start } else { x })
    }

    #[inline(always)]
    fn piece(&self, index: usize) -> &[P] {
        let count = self.space.degree() + 1;
        &self.coefficients[index * count..(index + 1) * count]
    }

    /// The piece of an `x` in D.
    #[inline(always)]
    fn find(&self, x: f64) -> usize {
        let part = self.table.part(x);
        let (low, high) = (self.table.before[part] as usize, self.table.before[part + 1] as usize);
        let ahead: &[f64; AHEAD] =
            self.breaks[low + 1..].first_chunk().expect("infinities follow the last end");
        let passed: usize = ahead.iter().map(|&start| usize::from(start <= x)).sum();
        if passed == AHEAD && low + AHEAD < high {
            let from = low + AHEAD;
            return from + self.breaks[from + 1..=high].partition_point(|&start| start <= x);
        }
        (low + passed).min(high)
    }
}

/// `NonFinite` with the index of the parameter among several.
pub(super) fn at_index(error: SplineError, index: usize) -> SplineError {
    match error {
        SplineError::NonFinite { what, value, .. } => SplineError::NonFinite { what, index, value },
        other => other,
    }
}

#[inline(always)]
fn derivatives<P: Point, const K: usize>(piece: &[P], u: f64, frame: Frame) -> [P; K] {
    // The Taylor coefficients at u, by repeated division by the linear factor.
    let mut values = [P::ZERO; K];
    for &next in piece {
        for j in (1..K).rev() {
            values[j] = values[j] * u + values[j - 1];
        }
        values[0] = values[0] * u + next;
    }
    let mut factor = 1.0;
    for (j, value) in values.iter_mut().enumerate().skip(1) {
        factor *= frame.per_unit * j as f64;
        *value = *value * factor;
    }
    values
}

impl Table {
    /// For pieces between `breaks`.
    fn new(breaks: &[f64]) -> Self {
        let pieces = breaks.len() - 1;
        let parts = PARTS_PER_PIECE * pieces;
        let (start, end) = (breaks[0], breaks[pieces]);
        let parts_per_unit = parts as f64 / (end - start);
        let mut table = Self { start, parts_per_unit, before: vec![0; parts + 1] };
        // A part that rounds up to `parts` is the last; the entry after it ends the search.
        for (index, &a) in breaks[..pieces].iter().enumerate().skip(1) {
            let part = table.part(a);
            table.before[part + 1] = index as u32;
        }
        let mut last = 0;
        for entry in &mut table.before {
            last = last.max(*entry);
            *entry = last;
        }
        table
    }

    /// The part of an `x` in D. It never falls as `x` grows, which is all that the search needs.
    #[inline(always)]
    fn part(&self, x: f64) -> usize {
        // The number is saturated: an infinite factor of a tiny D sends everything to the last part.
        (((x - self.start) * self.parts_per_unit) as usize).min(self.before.len() - 2)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::core::bspline::error::Side;

    /// Knots of multiplicity 1 to `degree`, some intervals a thousand times as long as others.
    fn spaces() -> impl Strategy<Value = SplineSpace> {
        let steps = prop::collection::vec((1_usize..4, -3.0..0.5_f64), 2..30);
        (1_usize..9, steps, any::<bool>()).prop_map(|(degree, steps, closed)| {
            let mut at = -1.0;
            let mut knots = Vec::new();
            for (multiplicity, exponent) in steps {
                at += 10_f64.powf(exponent);
                knots.extend(std::iter::repeat_n(at, multiplicity.min(degree)));
            }
            if closed {
                return SplineSpace::periodic(degree, at + 2.5, knots).unwrap();
            }
            let mut all: Vec<f64> = (0..=degree).map(|i| -2.0 - (degree - i) as f64).collect();
            all.extend(knots);
            all.extend((1..=degree + 1).map(|i| at + i as f64));
            SplineSpace::new(degree, all).unwrap()
        })
    }

    fn spline(space: &SplineSpace) -> Spline<DVec2> {
        let point = |k: usize| DVec2::new((1.7 * k as f64).sin(), (2.9 * k as f64).cos());
        Spline::new(space.clone(), (0..space.dimension()).map(point).collect()).unwrap()
    }

    proptest! {
        #[test]
        fn values_and_derivatives_are_those_of_de_boor(space in spaces(), parts in prop::collection::vec(0.0..=1.0_f64, 1..40)) {
            let spline = spline(&space);
            let form = PowerForm::new(&spline);
            let (a, b) = space.parameter_interval();
            let mut xs: Vec<f64> = parts.iter().map(|part| (a + (b - a) * part).min(b)).collect();
            xs.extend(space.breaks());
            let mut values = vec![DVec2::ZERO; xs.len()];
            form.evaluate_into(&xs, &mut values).unwrap();
            let mut all = vec![[DVec2::ZERO; 4]; xs.len()];
            form.derivatives_into(&xs, &mut all).unwrap();
            let breaks = space.breaks();
            let width = breaks.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::MAX, f64::min);
            for ((&x, value), jet) in xs.iter().zip(&values).zip(&all) {
                prop_assert_eq!(form.evaluate(x).unwrap(), *value, "{}", x);
                let exact = spline.derivatives(x, 3, Side::Right).unwrap();
                for (order, (found, exact)) in jet.iter().zip(&exact).enumerate() {
                    let scale = (2.0 / width).powi(order as i32) * 2.5_f64.powi(space.degree() as i32) * 200.0;
                    prop_assert!((*found - *exact).length() < 1e-15 * scale + 1e-13 * exact.length(), "{}: derivative {order} {found} {exact}", x);
                }
                prop_assert!((*value - exact[0]).length() < 1e-12, "{}: {} {}", x, value, exact[0]);
            }
        }

        #[test]
        fn the_table_finds_every_piece(space in spaces(), part in 0.0..=1.0_f64) {
            let form = PowerForm::new(&spline(&space));
            let (a, b) = space.parameter_interval();
            let mut xs = space.breaks();
            xs.push((a + (b - a) * part).min(b));
            for x in xs {
                let slow = (0..form.frames.len()).rev().find(|&i| form.breaks[i] <= x).unwrap();
                prop_assert_eq!(form.find(x), slow, "{}", x);
            }
        }
    }

    #[test]
    fn crowded_knots_are_searched_by_halving() {
        let mut breaks: Vec<f64> = (0..1000).map(|i| 1e-9 * f64::from(i)).collect();
        breaks.push(1.0);
        let table = Table::new(&breaks);
        assert!(table.before[1] > 900, "nearly all pieces begin in the first part");
        let space =
            SplineSpace::from_breaks(2, &breaks, crate::core::bspline::EndKnots::Interpolating).unwrap();
        let spline = spline(&space);
        let form = PowerForm::new(&spline);
        for i in [0, 1, 7, 500, 998] {
            let x = 1e-9 * (f64::from(i) + 0.5);
            assert_eq!(form.find(x), i as usize, "{x}");
            assert!((form.evaluate(x).unwrap() - spline.evaluate(x).unwrap()).length() < 1e-12, "{x}");
        }
    }

    #[test]
    fn bad_parameters_are_named() {
        let space = SplineSpace::new(1, vec![-1.0, 0.0, 1.0, 2.0]).unwrap();
        let form = PowerForm::new(&Spline::new(space, vec![0.0, 1.0]).unwrap());
        let mut out = [0.0; 2];
        let found = form.evaluate_into(&[0.5, f64::NAN], &mut out);
        assert!(matches!(found, Err(SplineError::NonFinite { index: 1, .. })), "{found:?}");
        let found = form.evaluate_into(&[0.5, 1.5], &mut out);
        assert!(matches!(found, Err(SplineError::OutsideInterval { .. })), "{found:?}");
        let found = form.evaluate_into(&[0.5], &mut out);
        assert!(matches!(found, Err(SplineError::SizeMismatch { .. })), "{found:?}");
        assert_eq!(form.evaluate_into(&[0.25, 1.0], &mut out).map(|()| out), Ok([0.25, 1.0]), "the end of D");
    }
}
