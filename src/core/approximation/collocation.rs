//! The matrix `bₖ(tᵢ)` of an interpolation, with derivatives at repeated sites.
//!
//! Its rows have at most `n + 1` consecutive entries. With simple sites it is totally positive, so that its inverse has signs like a chessboard: one solution with
//! the right-hand side `(1, −1, 1, …)` gives the norm of the inverse.
//!
//! C. de Boor, *A Practical Guide to Splines*, 1978, chapter XIII. Course: section 5.5.

use crate::core::approximation::data::check_length;
use crate::core::approximation::error::ApproximationError;
use crate::core::approximation::sites::{check_order, check_sites};
use crate::core::bspline::{MAX_DEGREE, SplineSpace};
use crate::core::linear_system::{BandLu, BandMatrix, CyclicLu, PivotedBandLu};
use crate::core::point::Point;

/// The matrix of interpolation in an open space: row `i` holds `bₖ(tᵢ)`, or at the `j`-th copy of a site the derivatives of order `j`; at knots those from the right, at the right end
/// of D from the left.
///
/// Any number of sites will do, and the condition of Schoenberg and Whitney is not asked for.
///
/// # Errors
///
/// `NonFinite`, `SitesNotSorted`, `OutsideInterval`; `SizeMismatch` for a periodic space.
pub fn collocation_matrix(space: &SplineSpace, sites: &[f64]) -> Result<BandMatrix, ApproximationError> {
    check_length(
        "columns of a band (the space is periodic)",
        space.dimension(),
        space.evaluation_dimension(),
    )?;
    check_order(space, sites)?;
    // A constant degree lets the compiler unroll the recurrence.
    match space.degree() {
        2 => assemble(2, space, sites),
        3 => assemble(3, space, sites),
        5 => assemble(5, space, sites),
        n => assemble(n, space, sites),
    }
}

#[inline(always)]
fn assemble(n: usize, space: &SplineSpace, sites: &[f64]) -> Result<BandMatrix, ApproximationError> {
    let (m, knots) = (space.dimension(), space.knots());
    let mut matrix = BandMatrix::with_capacity(sites.len(), m, n + 1);
    let mut values = [0.0; MAX_DEGREE + 1];
    let (mut span, mut copies) = (n, 0);
    for (i, &site) in sites.iter().enumerate() {
        copies = if i > 0 && sites[i - 1] >= site { copies + 1 } else { 0 };
        while span + 1 < m && knots[span + 1] <= site {
            span += 1;
        }
        space.write_basis_in_span(span, site, copies, &mut values[..=n]);
        matrix.push_row(span - n, &values[..=n])?;
    }
    Ok(matrix)
}

/// The factored matrix of an interpolation.
pub(super) enum Collocation {
    TotallyPositive(BandLu),
    /// Rows with derivatives are scaled by these factors.
    WithDerivatives(PivotedBandLu, Vec<f64>),
    Periodic(CyclicLu),
}

impl Collocation {
    /// The sites are as [`check_sites`] wants them.
    pub(super) fn new(space: &SplineSpace, sites: &[f64]) -> Result<Self, ApproximationError> {
        if space.is_periodic() {
            return periodic(space, sites);
        }
        let matrix = collocation_matrix(space, sites)?;
        if sites.windows(2).all(|pair| pair[0] < pair[1]) {
            return Ok(Self::TotallyPositive(BandLu::factor(matrix)?));
        }
        let largest = |i: usize| matrix.row(i).1.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
        let scale: Vec<f64> = (0..matrix.rows()).map(|i| largest(i).recip()).collect();
        let triplets: Vec<_> = matrix.iter().map(|(i, j, entry)| (i, j, entry * scale[i])).collect();
        Ok(Self::WithDerivatives(PivotedBandLu::factor(matrix.rows(), &triplets)?, scale))
    }

    /// Replaces the data by the coefficients.
    pub(super) fn solve<P: Point>(&self, data: &mut [P]) -> Result<(), ApproximationError> {
        match self {
            Self::TotallyPositive(factors) => factors.solve(data)?,
            Self::WithDerivatives(factors, scale) => {
                data.iter_mut().zip(scale).for_each(|(value, scale)| *value = *value * *scale);
                factors.solve(data)?;
            }
            Self::Periodic(factors) => factors.solve(data)?,
        }
        Ok(())
    }
}

fn periodic(space: &SplineSpace, sites: &[f64]) -> Result<Collocation, ApproximationError> {
    let n = space.degree();
    let mut values = [0.0; MAX_DEGREE + 1];
    let mut triplets = Vec::with_capacity(sites.len() * (n + 1));
    for (i, &site) in sites.iter().enumerate() {
        let first = space.write_active_basis(site, &mut values[..=n])?;
        for (j, &value) in values[..=n].iter().enumerate().filter(|(_, value)| **value > 0.0) {
            triplets.push((i, space.coefficient_index(first + j), value));
        }
    }
    let largest = triplets.iter().filter(|entry| entry.0 == 0).max_by(|a, b| a.2.total_cmp(&b.2));
    let shift = largest.map_or(0, |entry| entry.1);
    Ok(Collocation::Periodic(CyclicLu::factor(sites.len(), shift, &triplets)?))
}

/// `‖A⁻¹‖∞` of the interpolation: how much the coefficients can exceed the data.
///
/// One solution suffices for simple sites in an open space; else the inverse is computed column by column.
///
/// # Errors
///
/// Those of [`check_sites`], `Singular`.
pub fn inverse_norm(space: &SplineSpace, sites: &[f64]) -> Result<f64, ApproximationError> {
    check_sites(space, sites)?;
    let collocation = Collocation::new(space, sites)?;
    let size = sites.len();
    let mut sums = vec![0.0; size];
    if let Collocation::TotallyPositive(_) = collocation {
        sums = (0..size).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        collocation.solve(&mut sums)?;
    } else {
        let mut column = vec![0.0; size];
        for j in 0..size {
            column.fill(0.0);
            column[j] = 1.0;
            collocation.solve(&mut column)?;
            sums.iter_mut().zip(&column).for_each(|(sum, entry)| *sum += entry.abs());
        }
    }
    Ok(sums.iter().fold(0.0, |norm: f64, sum| norm.max(sum.abs())))
}

/// The bound `2 + 2/r` of `‖A⁻¹‖∞` for quadratic interpolation at the knot averages, with end-interpolating knots:
/// `r = minᵢ max(1/rᵢ₊₁, rᵢ₊₂)` with the ratios `rᵢ = (ξᵢ₊₁ − ξᵢ)/(ξᵢ − ξᵢ₋₁)` of neighbouring knot intervals.
///
/// # Errors
///
/// `SizeMismatch` unless the degree is 2 and the space is open.
pub fn quadratic_inverse_norm_bound(space: &SplineSpace) -> Result<f64, ApproximationError> {
    check_length("is the degree, which", 2, space.degree())?;
    check_length("knots beyond one period", space.dimension(), space.evaluation_dimension())?;
    let knots = space.knots();
    let ratio = |i: usize| (knots[i + 1] - knots[i]) / (knots[i] - knots[i - 1]);
    let larger = |i: usize| ratio(i + 1).recip().max(ratio(i + 2));
    Ok(2.0 + 2.0 / (0..space.dimension()).map(larger).fold(f64::INFINITY, f64::min))
}
