//! All zeros in `[0, 1]` of a polynomial `p = Σ cₖ bⁿₖ` in Bernstein form, with multiplicities.
//!
//! The sign changes of the coefficients bound the number of zeros: none or one are settled at once. Otherwise the zeros of
//! `p′`, found in the same way, divide `[0, 1]` into pieces on which `p` is monotone: each has at most one zero, and
//! a zero of `p′` at which `p` is 0 up to rounding is a multiple one. Neighbouring zeros that rounding cannot tell apart
//! count as one multiple zero, and so do two complex ones as close to the interval.
//!
//! Each derivative magnifies the error of the coefficients, by `2n` at most. Where that would leave nothing of the last ones, halving
//! comes first: parts with one sign change or none are settled, and only the small parts near multiple zeros are left to derivatives.

use std::iter::once;

use crate::core::point::Point as _;
use crate::core::triangular_scheme::{collapse, collapse_both};

/// Parts of `[0, 1]` that are not divided any more.
const SMALLEST_PART: f64 = 1e-9;

/// A zero of a polynomial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zero {
    /// Where, in `[0, 1]`.
    pub at: f64,
    /// Its multiplicity, at least 1; odd multiplicities inside the interval are sign changes.
    pub multiplicity: usize,
}

/// The zeros of a polynomial in `[0, 1]`.
#[derive(Clone, Debug, PartialEq)]
pub enum Zeros {
    /// Finitely many, increasing.
    Isolated(Vec<Zero>),
    /// All coefficients are 0 up to the tolerance.
    Everywhere,
}

impl Zeros {
    /// The zeros; none if the polynomial is 0.
    pub fn isolated(&self) -> &[Zero] {
        match self {
            Self::Isolated(zeros) => zeros,
            Self::Everywhere => &[],
        }
    }

    /// The parameters at which the polynomial changes sign: the zeros of odd multiplicity inside `(0, 1)`.
    pub fn sign_changes(&self) -> impl Iterator<Item = f64> + '_ {
        self.isolated()
            .iter()
            .filter(|zero| zero.multiplicity % 2 == 1 && 0.0 < zero.at && zero.at < 1.0)
            .map(|zero| zero.at)
    }
}

/// The zeros of `Σ coefficients[k]·bⁿₖ` in `[0, 1]`; values up to `noise` in modulus, or up to the rounding error of
/// an evaluation if that is larger, count as 0.
///
/// Give as `noise` the error of the coefficients themselves, 0 if they are exact. Coefficients that are not finite, or
/// none at all, have no zeros.
///
/// ```
/// use spline_lab::core::root_finding::bernstein_zeros;
///
/// let zeros = bernstein_zeros(&[1.0, -1.0, 1.0], 0.0); // (1 − 2t)²
/// assert_eq!(zeros.isolated()[0].at, 0.5);
/// assert_eq!(zeros.isolated()[0].multiplicity, 2);
/// ```
pub fn bernstein_zeros(coefficients: &[f64], noise: f64) -> Zeros {
    if coefficients.is_empty() || coefficients.iter().any(|c| !c.is_finite()) {
        return Zeros::Isolated(Vec::new());
    }
    let largest = largest(coefficients);
    // A power of two keeps differences and products in range and changes no zero.
    let scale = 2.0_f64.powi(-exponent(largest));
    let scaled: Vec<f64> = coefficients.iter().map(|c| c * scale).collect();
    if largest == 0.0 || largest <= noise {
        return Zeros::Everywhere;
    }
    Zeros::Isolated(zeros(&scaled, noise.max(0.0) * scale))
}

fn largest(coefficients: &[f64]) -> f64 {
    coefficients.iter().fold(0.0, |most, c| c.abs().max(most))
}

/// An exponent near that of `value`, in the range in which `2^(−exponent)` is a normal number.
fn exponent(value: f64) -> i32 {
    if value > 0.0 { (value.log2() as i32).clamp(-1000, 1000) } else { 0 }
}

/// `noise`, or the error of an evaluation if that is larger: de Casteljau's algorithm takes n convex combinations of three
/// rounded operations each.
fn with_rounding(c: &[f64], noise: f64) -> f64 {
    noise.max(2.0 * c.len() as f64 * f64::EPSILON * largest(c))
}

/// The zeros of a polynomial that is not 0; `noise` is the error of its coefficients.
fn zeros(c: &[f64], noise: f64) -> Vec<Zero> {
    let noise = with_rounding(c, noise);
    // The errors of the highest derivatives.
    let magnified = (1..c.len()).fold(noise, |error, k| 2.0 * k as f64 * error);
    if magnified <= 1e-3 * largest(c) { zeros_by_derivative(c, noise) } else { zeros_by_halving(c, noise) }
}

/// Parts of `[0, 1]` are divided until they have a sign change or none, or everything in them is small.
fn zeros_by_halving(c: &[f64], noise: f64) -> Vec<Zero> {
    let n = c.len() - 1;
    let is_zero = |value: f64| value.abs() <= noise;
    // A part with a double zero is left while its second derivative still stands out of the noise.
    let small = (noise * largest(c)).sqrt();
    let mut scratch = c.to_vec();
    let mut found = Vec::new();
    let mut unsettled: Option<(f64, f64)> = None;
    let mut parts = vec![(0.0, 1.0, c.to_vec())];
    while let Some((a, b, mut part)) = parts.pop() {
        let changes = strict_sign_changes(&part, noise);
        if changes <= 1 && !is_zero(part[0]) && !is_zero(part[n]) {
            found.extend(unsettled.take().into_iter().flat_map(|ends| zeros_of_part(c, ends, noise)));
            if changes == 1 {
                let at = a.mix(b, bracketed_zero(&part, &mut scratch, 0.0, 1.0));
                found.push(Zero { at, multiplicity: 1 });
            }
            continue;
        }
        // Not at a zero, which would be one of both parts.
        let place = [0.5, 0.4375, 0.5625].into_iter().find(|&t| !is_zero(value_at(&part, &mut scratch, t)));
        match place.filter(|_| largest(&part) > small && b - a > SMALLEST_PART) {
            Some(t) => {
                let middle = a.mix(b, t);
                let mut left = vec![0.0; n + 1];
                collapse_both(&mut part, t, &mut left);
                parts.push((middle, b, part));
                parts.push((a, middle, left));
            }
            None => unsettled = Some((unsettled.map_or(a, |(start, _)| start), b)),
        }
    }
    found.extend(unsettled.into_iter().flat_map(|ends| zeros_of_part(c, ends, noise)));
    found
}

/// The zeros in `[a, b]`, by derivatives.
fn zeros_of_part(c: &[f64], (a, b): (f64, f64), noise: f64) -> Vec<Zero> {
    let mut part = c.to_vec();
    let mut left = c.to_vec();
    collapse_both(&mut part, b, &mut left);
    if b > 0.0 {
        collapse(&mut left, a / b);
    }
    let mut found = zeros_by_derivative(&left, noise);
    found.iter_mut().for_each(|zero| zero.at = a.mix(b, zero.at));
    found
}

/// The zeros of a polynomial whose coefficients have errors up to `noise`, between those of its derivative.
fn zeros_by_derivative(c: &[f64], noise: f64) -> Vec<Zero> {
    let n = c.len() - 1;
    let is_zero = |value: f64| value.abs() <= noise;
    let changes = strict_sign_changes(c, noise);
    if changes == 0 {
        let leading = c.iter().take_while(|&&value| is_zero(value)).count();
        let trailing = c.iter().rev().take_while(|&&value| is_zero(value)).count();
        let ends = [(0.0, leading), (1.0, trailing)];
        return ends
            .into_iter()
            .filter(|&(_, multiplicity)| multiplicity > 0 && multiplicity <= n)
            .map(|(at, multiplicity)| Zero { at, multiplicity })
            .collect();
    }
    let mut scratch = c.to_vec();
    if changes == 1 && !is_zero(c[0]) && !is_zero(c[n]) {
        return vec![Zero { at: bracketed_zero(c, &mut scratch, 0.0, 1.0), multiplicity: 1 }];
    }
    let derivative: Vec<f64> = c.windows(2).map(|pair| n as f64 * (pair[1] - pair[0])).collect();
    let derivative_noise = 2.0 * n as f64 * noise;
    // A derivative within its noise has no zeros that mean anything.
    let critical = if largest(&derivative) <= derivative_noise {
        Vec::new()
    } else {
        zeros_by_derivative(&derivative, with_rounding(&derivative, derivative_noise))
    };
    let inner = critical.iter().filter(|zero| 0.0 < zero.at && zero.at < 1.0).copied();
    let at_end = |end: f64| {
        let multiplicity = critical.iter().find(|zero| zero.at == end).map_or(0, |zero| zero.multiplicity);
        Zero { at: end, multiplicity }
    };
    let mut found = Vec::new();
    let mut cluster: Option<Cluster> = None;
    let mut before: Option<(f64, f64)> = None;
    for node in once(at_end(0.0)).chain(inner).chain(once(at_end(1.0))) {
        let value = value_at(c, &mut scratch, node.at);
        if is_zero(value) {
            cluster.get_or_insert_default().add(node);
            before = None;
            continue;
        }
        found.extend(cluster.take().map(Cluster::zero));
        if let Some((left, other)) = before
            && (other < 0.0) != (value < 0.0)
        {
            let at = bracketed_zero(c, &mut scratch, left, node.at);
            found.push(Zero { at, multiplicity: 1 });
        }
        before = Some((node.at, value));
    }
    found.extend(cluster.take().map(Cluster::zero));
    found
}

/// Consecutive ends and zeros of the derivative at which the polynomial is 0 up to rounding.
#[derive(Default)]
struct Cluster {
    first: f64,
    nodes: usize,
    weighted: f64,
    multiplicity: usize,
}

impl Cluster {
    fn add(&mut self, node: Zero) {
        if self.nodes == 0 {
            self.first = node.at;
        }
        self.nodes += 1;
        self.weighted += node.at * node.multiplicity as f64;
        self.multiplicity += node.multiplicity;
    }

    fn zero(self) -> Zero {
        let mean = self.weighted / self.multiplicity as f64;
        let at = if self.multiplicity == 0 || self.nodes == 1 { self.first } else { mean };
        Zero { at, multiplicity: self.multiplicity + 1 }
    }
}

/// Sign changes of the coefficients above `noise` in modulus.
fn strict_sign_changes(c: &[f64], noise: f64) -> usize {
    let mut signs = c.iter().filter(|value| value.abs() > noise).map(|value| *value < 0.0);
    let Some(mut last) = signs.next() else { return 0 };
    let mut changes = 0;
    for sign in signs {
        changes += usize::from(sign != last);
        last = sign;
    }
    changes
}

fn value_at(c: &[f64], scratch: &mut [f64], t: f64) -> f64 {
    scratch.copy_from_slice(c);
    collapse(scratch, t)
}

/// The zero of `p` between `low` and `high`, at which it has different signs: Newton's method, or a bisection where
/// Newton's step leaves the bracket or is longer than half the step before.
fn bracketed_zero(c: &[f64], scratch: &mut [f64], mut low: f64, mut high: f64) -> f64 {
    let n = c.len() - 1;
    let negative_below = value_at(c, scratch, low) < 0.0;
    let (mut t, mut step) = (0.5 * (low + high), high - low);
    // A bisection takes at most 53 + 1022 halvings; Newton's method rarely ten steps.
    for _ in 0..1100 {
        scratch.copy_from_slice(c);
        // Both points of the last but one level give value and derivative.
        let first = collapse(&mut scratch[..n], t);
        scratch[..n].copy_from_slice(&c[1..]);
        let second = collapse(&mut scratch[..n], t);
        let value = (1.0 - t) * first + t * second;
        if value == 0.0 {
            return t;
        }
        if (value < 0.0) == negative_below {
            low = t;
        } else {
            high = t;
        }
        let newton = t - value / (n as f64 * (second - first));
        let next = if low < newton && newton < high && (newton - t).abs() < 0.5 * step.abs() {
            newton
        } else {
            0.5 * (low + high)
        };
        step = next - t;
        if next == t || next <= low || next >= high {
            return next;
        }
        t = next;
    }
    t
}

/// The zero of a polynomial whose coefficients, overwritten, have one sign before index `k` and not from there on, see [`single_zeros`].
pub(in crate::core) fn single_zero(c: &mut [f64], k: usize) -> f64 {
    single_zeros::<1>(c.as_chunks_mut().0, [k])[0]
}

/// The zeros of `L` polynomials of one degree, `c[j]` being their coefficients number `j`, which are overwritten. Those of polynomial `i` have one sign before index `k[i]`
/// and not from there on. Newton's method in a bracket, from where the control polygon is 0; the polynomials go side by side, because one alone waits for every operation.
///
/// With `s = t/(1 − t)` the polynomial is `(1 − t)ᴺ Σ C(N,k) cₖ sᵏ`. Over the half of `[0, 1]` where the zero is, counted from the nearer end, `s` is at most 1, and the
/// sum has no larger rounding errors than de Casteljau's algorithm.
pub(in crate::core) fn single_zeros<const L: usize>(c: &mut [[f64; L]], k: [usize; L]) -> [f64; L] {
    let n = c.len() - 1;
    let guess: [f64; L] = std::array::from_fn(|i| {
        let (before, behind) = (c[k[i] - 1][i], c[k[i]][i]);
        ((k[i] - 1) as f64 + before / (before - behind)) / n as f64
    });
    let (mut binomial, mut sums) = (1.0, [0.0; L]);
    for (j, row) in c.iter_mut().enumerate() {
        for i in 0..L {
            row[i] *= binomial;
            sums[i] += row[i];
        }
        binomial *= (n - j) as f64 / (j + 1) as f64;
    }
    let (mut is_right, mut s) = ([false; L], [0.0; L]);
    for i in 0..L {
        let falls = c[0][i] > 0.0;
        is_right[i] = (sums[i] < 0.0) != falls;
        // From the nearer end, where it is positive.
        if is_right[i] {
            for j in 0..c.len() / 2 {
                (c[j][i], c[n - j][i]) = (c[n - j][i], c[j][i]);
            }
        }
        let sign = if is_right[i] == falls { -1.0 } else { 1.0 };
        c.iter_mut().for_each(|row| row[i] *= sign);
        let start = if is_right[i] { 1.0 - guess[i] } else { guess[i] };
        s[i] = (start / (1.0 - start)).min(1.0);
    }
    let mut ends = ([0.0; L], [1.0; L]);
    // The first step alone says nothing about the next one.
    let (mut before, mut done) = ([0.0; L], [false; L]);
    // Halving alone takes 53 steps to the last digit.
    for _ in 0..60 {
        let (mut value, mut slope) = ([0.0; L], [0.0; L]);
        for row in c.iter().rev() {
            for i in 0..L {
                slope[i] = slope[i] * s[i] + value[i];
                value[i] = value[i] * s[i] + row[i];
            }
        }
        for i in 0..L {
            let newton = s[i] - value[i] / slope[i];
            let is_beyond = value[i] < 0.0;
            let low = if is_beyond { ends.0[i] } else { s[i] };
            let high = if is_beyond { s[i] } else { ends.1[i] };
            let is_inside = ((low < newton) & (newton < high)) | (newton == s[i]) | (value[i] == 0.0);
            let next = if is_inside { newton } else { 0.5 * (low + high) };
            let next = if done[i] | (value[i] == 0.0) { s[i] } else { next };
            let step = (next - s[i]).abs();
            // Steps of a quadratically convergent sequence shrink like 1, C, C³ …: the next one would be step³/before².
            let is_last = is_inside & (step * step * step <= 0.5 * f64::EPSILON * before[i] * before[i]);
            done[i] |= is_last | (step <= 2.0 * f64::EPSILON) | (high - low <= f64::EPSILON);
            (ends.0[i], ends.1[i], s[i], before[i]) = (low, high, next, step);
        }
        if done.iter().fold(true, |all, done| all & done) {
            break;
        }
    }
    std::array::from_fn(|i| if is_right[i] { 1.0 / (1.0 + s[i]) } else { s[i] / (1.0 + s[i]) })
}

/// The index at which coefficients above `noise` in modulus have their only change of sign; `None` if there are more, or the first or last one is within the noise, or there
/// are more than 64.
pub(in crate::core) fn single_sign_change(c: &[f64], noise: f64) -> Option<usize> {
    if !(1..=64).contains(&c.len()) {
        return None;
    }
    // One bit each, without a branch.
    let (mut above, mut below) = (0_u64, 0_u64);
    for (j, &a) in c.iter().enumerate() {
        above |= u64::from(a > noise) << j;
        below |= u64::from(a < -noise) << j;
    }
    let (start, end) = if above & 1 == 1 { (above, below) } else { (below, above) };
    let is_one = start & 1 == 1 && end >> (c.len() - 1) == 1 && start < (end & end.wrapping_neg());
    is_one.then_some(end.trailing_zeros() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Coefficients of the product of `(t − r)` over `roots` and of `(t − x)² + y²` over `pairs`.
    fn with_zeros(roots: &[f64], pairs: &[(f64, f64)]) -> Vec<f64> {
        let mut c = vec![1.0];
        for &r in roots {
            c = product(&c, &[-r, 1.0 - r]);
        }
        for &(x, y) in pairs {
            let s = y * y;
            c = product(&c, &[x * x + s, x * x - x + s, (1.0 - x) * (1.0 - x) + s]);
        }
        c
    }

    fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
        let binomial =
            |n: usize, k: usize| (0..k).fold(1.0, |value, i| value * (n - i) as f64 / (i + 1) as f64);
        let (m, n) = (a.len() - 1, b.len() - 1);
        let mut c = vec![0.0; m + n + 1];
        for i in 0..=m {
            for j in 0..=n {
                c[i + j] += a[i] * b[j] * binomial(m, i) * binomial(n, j) / binomial(m + n, i + j);
            }
        }
        c
    }

    #[test]
    fn multiple_zeros_are_told_with_their_multiplicity() {
        for (roots, expected) in [
            (vec![0.3, 0.3], vec![(0.3, 2)]),
            (vec![0.7, 0.7, 0.7], vec![(0.7, 3)]),
            (vec![0.0, 0.0, 0.4, 1.0], vec![(0.0, 2), (0.4, 1), (1.0, 1)]),
            (vec![0.2, 0.2, 0.9, 0.9], vec![(0.2, 2), (0.9, 2)]),
            (vec![0.0, 0.0, 0.0], vec![(0.0, 3)]),
            (vec![-0.5, 1.5], vec![]),
        ] {
            let zeros = bernstein_zeros(&with_zeros(&roots, &[]), 0.0);
            let found = zeros.isolated();
            assert_eq!(found.len(), expected.len(), "{roots:?}: {found:?}");
            for (zero, (at, multiplicity)) in found.iter().zip(expected) {
                assert_eq!(zero.multiplicity, multiplicity, "{roots:?}: {zero:?}");
                assert!((zero.at - at).abs() < 1e-7, "{roots:?}: {zero:?}");
            }
        }
    }

    #[test]
    fn a_polynomial_without_a_value_has_no_zeros() {
        assert_eq!(bernstein_zeros(&[], 0.0), Zeros::Isolated(Vec::new()), "no coefficients");
        assert_eq!(bernstein_zeros(&[f64::NAN, 1.0], 0.0), Zeros::Isolated(Vec::new()), "NaN");
        assert_eq!(bernstein_zeros(&[0.0, 0.0], 0.0), Zeros::Everywhere, "zero");
        assert_eq!(bernstein_zeros(&[1e-14, -1e-14], 1e-13), Zeros::Everywhere, "zero up to noise");
        assert_eq!(bernstein_zeros(&[1e300, -1e300], 0.0).isolated()[0].at, 0.5, "huge");
        assert_eq!(bernstein_zeros(&[-5e-324, 5e-324], 0.0).isolated()[0].at, 0.5, "tiny");
    }

    #[test]
    fn a_raised_degree_brings_no_zeros() {
        let mut c = with_zeros(&[0.25, 0.5, 0.8], &[]);
        for _ in 0..20 {
            c = product(&c, &[1.0, 1.0]);
        }
        let zeros = bernstein_zeros(&c, 0.0);
        let at: Vec<f64> = zeros.sign_changes().collect();
        assert_eq!(at.len(), 3, "{zeros:?}");
        for (found, exact) in at.iter().zip([0.25, 0.5, 0.8]) {
            assert!((found - exact).abs() < 1e-12, "{found} for {exact}");
        }
    }

    #[test]
    fn noise_that_the_derivatives_magnify_hides_no_zeros() {
        for degree in [12, 21, 29] {
            let mut c = with_zeros(&[0.48, 0.96], &[]);
            while c.len() <= degree {
                c = product(&c, &[1.0, 0.7]);
            }
            for noise in [0.0, 1e-13, 1e-10, 1e-7] {
                let zeros = bernstein_zeros(&c, noise * largest(&c));
                let at: Vec<f64> = zeros.sign_changes().collect();
                assert_eq!(at.len(), 2, "degree {degree}, noise {noise}: {zeros:?}");
                assert!((at[0] - 0.48).abs() < 1e-9 && (at[1] - 0.96).abs() < 1e-9, "{at:?}");
            }
        }
    }

    #[test]
    fn multiple_zeros_of_a_high_degree_are_told() {
        for (roots, expected) in
            [(vec![0.3, 0.3], vec![(0.3, 2)]), (vec![0.5, 0.5, 0.5, 0.9], vec![(0.5, 3), (0.9, 1)])]
        {
            let mut c = with_zeros(&roots, &[]);
            while c.len() < 20 {
                c = product(&c, &[1.0, 0.8]);
            }
            let zeros = bernstein_zeros(&c, 0.0);
            let found: Vec<_> = zeros.isolated().iter().map(|zero| zero.multiplicity).collect();
            assert_eq!(found, expected.iter().map(|zero| zero.1).collect::<Vec<_>>(), "{zeros:?}");
            for (zero, (at, _)) in zeros.isolated().iter().zip(&expected) {
                assert!((zero.at - at).abs() < 1e-4, "{zero:?} for {at}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn planted_zeros_are_found(
            gaps in prop::collection::vec(0.05..1.0_f64, 1..8),
            pairs in prop::collection::vec((-1.0..2.0_f64, 0.2..1.0_f64), 0..4),
        ) {
            let total: f64 = gaps.iter().sum::<f64>() + 0.05;
            let planted: Vec<f64> = gaps.iter().scan(0.0, |sum, gap| { *sum += gap; Some(*sum / total) }).collect();
            let c = with_zeros(&planted, &pairs);
            let zeros = bernstein_zeros(&c, 0.0);
            prop_assert_eq!(zeros.isolated().len(), planted.len(), "{:?} {:?}", zeros, planted);
            for (zero, exact) in zeros.isolated().iter().zip(&planted) {
                prop_assert_eq!(zero.multiplicity, 1, "{:?}", zero);
                prop_assert!((zero.at - exact).abs() < 1e-8, "{} for {exact}", zero.at);
            }
        }

        #[test]
        fn the_number_of_zeros_has_the_parity_of_the_sign_changes(c in prop::collection::vec(-1.0..1.0_f64, 2..14)) {
            let count: usize = bernstein_zeros(&c, 0.0).isolated().iter().map(|zero| zero.multiplicity).sum();
            let changes = strict_sign_changes(&c, 0.0);
            prop_assert!(count <= changes && (changes - count).is_multiple_of(2), "{count} zeros, {changes} changes");
        }
    }

    proptest! {
        #[test]
        fn zeros_side_by_side_are_those_of_each_polynomial_alone(
            degree in 1_usize..9,
            sizes in prop::array::uniform4(prop::collection::vec(1e-3..1.0_f64, 10)),
            parts in prop::array::uniform4(0.0..1.0_f64),
            signs in prop::array::uniform4(any::<bool>()),
        ) {
            let changes = parts.map(|part| 1 + (part * degree as f64) as usize);
            let coefficient = |i: usize, j: usize| {
                if (j < changes[i]) == signs[i] { sizes[i][j] } else { -sizes[i][j] }
            };
            let mut rows: Vec<[f64; 4]> = (0..=degree).map(|j| std::array::from_fn(|i| coefficient(i, j))).collect();
            let together = single_zeros(&mut rows, changes);
            for i in 0..4 {
                let mut c: Vec<f64> = (0..=degree).map(|j| coefficient(i, j)).collect();
                prop_assert_eq!(single_sign_change(&c, 1e-4), Some(changes[i]), "{:?}", c);
                let general = bernstein_zeros(&c, 0.0);
                let mut scratch = c.clone();
                let value = value_at(&c, &mut scratch, together[i]);
                prop_assert!(value.abs() < 1e-14, "{c:?}: {value} at {}", together[i]);
                prop_assert!((general.isolated()[0].at - together[i]).abs() < 1e-7, "{c:?}: {general:?}");
                prop_assert_eq!(single_zero(&mut c, changes[i]), together[i], "alone");
            }
        }

        #[test]
        fn a_single_change_of_sign_is_told_if_the_ends_are_certain(c in prop::collection::vec(-1.0..1.0_f64, 1..8)) {
            let noise = 0.3;
            let is_single = strict_sign_changes(&c, noise) == 1 && c[0].abs() > noise && c[c.len() - 1].abs() > noise;
            let found = single_sign_change(&c, noise);
            prop_assert_eq!(found.is_some(), is_single, "{:?}", c);
            if let Some(k) = found {
                let differs = |a: &f64| a.abs() > noise && a * c[0] < 0.0;
                prop_assert_eq!(c.iter().position(differs), Some(k), "{:?}", c);
            }
        }
    }
}
