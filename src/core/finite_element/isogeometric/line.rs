//! The integrands of the form at all quadrature points with one first parameter.
//!
//! With `φ′⁻¹ = adj/det` the integrals over the patch become integrals over the parameters,
//!
//! ```text
//! a(u, v) = ∫ (grad v)ᵗ C grad u + c |det| u v dt,   C = adj A adjᵗ / |det|,   λ(v) = ∫ f |det| v dt.
//! ```
//!
//! Geometry is evaluated by contracting the first direction once for the whole line.

use glam::{DMat2, DVec2, DVec3};

use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::form::{Coefficient, EllipticForm};
use crate::core::finite_element::geometry::PlanePatch;
use crate::core::finite_element::isogeometric::direction::{Direction, LANES};

/// Integrands, times the weights of both directions, at point `(q, e)` of the line: entry `q · stride + e`.
#[derive(Clone, Debug)]
pub(super) struct Line {
    stride: usize,
    /// Coordinates of the points, and homogeneous values and derivatives on the way to them.
    fields: [Vec<f64>; 9],
    /// `C₁₁`, `C₁₂`, `C₂₂`.
    pub(super) diffusion: [Vec<f64>; 3],
    /// `c |det|`.
    pub(super) reaction: Vec<f64>,
    /// `f |det|`.
    pub(super) load: Vec<f64>,
    /// `|det|`.
    pub(super) area: Vec<f64>,
    /// Products of the quadrature weights of the second direction.
    weights: Vec<f64>,
    contracted: Vec<[DVec3; 2]>,
}

/// What every line of an assembly shares.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integrand<'a> {
    pub(super) patch: &'a PlanePatch,
    pub(super) directions: &'a [Direction; 2],
    pub(super) form: &'a EllipticForm<'a>,
}

impl Line {
    pub(super) fn new(integrand: Integrand<'_>) -> Self {
        let second = &integrand.directions[1];
        let points = second.rule.count();
        let stride = second.stride;
        let zeros = || vec![0.0; points * stride];
        let mut weights = zeros();
        for q in 0..points {
            for e in 0..second.cells {
                weights[q * stride + e] = second.point(q, e).1;
            }
        }
        Self {
            stride,
            fields: std::array::from_fn(|_| zeros()),
            diffusion: std::array::from_fn(|_| zeros()),
            reaction: zeros(),
            load: zeros(),
            area: zeros(),
            weights,
            contracted: vec![[DVec3::ZERO; 2]; integrand.patch.spaces()[1].dimension()],
        }
    }

    /// The point of the plane of `(q, e)`, after [`Self::fill`].
    pub(super) fn place(&self, q: usize, e: usize) -> DVec2 {
        let at = q * self.stride + e;
        DVec2::new(self.fields[0][at], self.fields[1][at])
    }

    /// `φ′⁻ᵗ g` at `(q, e)`, after [`Self::fill`].
    pub(super) fn gradient(&self, q: usize, e: usize, g: DVec2) -> DVec2 {
        let at = q * self.stride + e;
        let [_, _, det, ax, ay, _, bx, by, _] = &self.fields;
        DVec2::new(by[at] * g.x - ay[at] * g.y, ax[at] * g.y - bx[at] * g.x) / det[at]
    }

    /// Evaluates everything at point `q1` of cell `e1` of the first direction.
    ///
    /// # Errors
    ///
    /// `SingularJacobian` or `FoldedParametrisation` where the determinant has not the sign `orientation`; `NonFinite`, `NotElliptic`.
    pub(super) fn fill(
        &mut self,
        integrand: Integrand<'_>,
        q1: usize,
        e1: usize,
        orientation: f64,
    ) -> Result<(), FiniteElementError> {
        let [first, second] = integrand.directions;
        self.contract(integrand.patch, first, q1, e1);
        let weight = first.point(q1, e1).1;
        let arch = pulp::Arch::new();
        let least = arch.dispatch(|| {
            self.interpolate(second);
            self.transform(second, weight, orientation)
        });
        if least.is_nan() || least <= 0.0 {
            return Err(self.bad_determinant(integrand, q1, e1));
        }
        self.apply_form(integrand)
    }

    /// Sums over the first direction: homogeneous coefficients of the line and of its derivative across.
    fn contract(&mut self, patch: &PlanePatch, first: &Direction, q1: usize, e1: usize) {
        let count = self.contracted.len();
        let table = &first.geometry;
        self.contracted.fill([DVec3::ZERO; 2]);
        for j in 0..=table.degree {
            let at = table.at(q1, j, e1);
            let (value, slope) = (table.values[at], table.slopes[at]);
            let row = &patch.homogeneous()[(table.first[e1] + j) * count..][..count];
            for (sum, coefficient) in self.contracted.iter_mut().zip(row) {
                sum[0] += *coefficient * value;
                sum[1] += *coefficient * slope;
            }
        }
    }

    /// Homogeneous values and derivatives at all points of the line: `X, Y, W`, then `∂₁`, then `∂₂`.
    #[inline(always)]
    fn interpolate(&mut self, second: &Direction) {
        let table = &second.geometry;
        for q in 0..second.rule.count() {
            for &(start, length) in &table.runs {
                let at = q * self.stride + start;
                for field in &mut self.fields {
                    field[at..at + length].fill(0.0);
                }
                for j in 0..=table.degree {
                    let [value, across] = self.contracted[table.first[start] + j];
                    let factors =
                        [value.x, value.y, value.z, across.x, across.y, across.z, value.x, value.y, value.z];
                    let from = table.at(q, j, start);
                    let (values, slopes) =
                        (&table.values[from..from + length], &table.slopes[from..from + length]);
                    for (index, field) in self.fields.iter_mut().enumerate() {
                        let basis = if index < 6 { values } else { slopes };
                        let factor = factors[index];
                        for (sum, b) in field[at..at + length].iter_mut().zip(basis) {
                            *sum += factor * b;
                        }
                    }
                }
            }
        }
    }

    /// From homogeneous values to points, tangents, determinant and the integrands of Poisson's form; returns the
    /// least determinant times `orientation`. Field 2 becomes the determinant.
    #[inline(always)]
    fn transform(&mut self, second: &Direction, weight: f64, orientation: f64) -> f64 {
        let mut least = [f64::INFINITY; LANES];
        for q in 0..second.rule.count() {
            let range = q * self.stride..q * self.stride + second.cells;
            let count = second.cells;
            let [x, y, w, ax, ay, aw, bx, by, bw] = &mut self.fields;
            let [x, y, w] = [&mut x[range.clone()], &mut y[range.clone()], &mut w[range.clone()]];
            let (ax, ay, aw) = (&mut ax[range.clone()], &mut ay[range.clone()], &aw[range.clone()]);
            let (bx, by, bw) = (&mut bx[range.clone()], &mut by[range.clone()], &bw[range.clone()]);
            let [c11, c12, c22] = &mut self.diffusion;
            let [c11, c12, c22] = [&mut c11[range.clone()], &mut c12[range.clone()], &mut c22[range.clone()]];
            let (area, weights) = (&mut self.area[range.clone()], &self.weights[range]);
            for e in 0..count {
                let inverse = 1.0 / w[e];
                x[e] *= inverse;
                y[e] *= inverse;
                ax[e] = (ax[e] - x[e] * aw[e]) * inverse;
                ay[e] = (ay[e] - y[e] * aw[e]) * inverse;
                bx[e] = (bx[e] - x[e] * bw[e]) * inverse;
                by[e] = (by[e] - y[e] * bw[e]) * inverse;
                let det = ax[e] * by[e] - ay[e] * bx[e];
                w[e] = det;
                let modulus = det * orientation;
                let total = weight * weights[e];
                let factor = total / modulus;
                c11[e] = factor * (bx[e] * bx[e] + by[e] * by[e]);
                c12[e] = -factor * (ax[e] * bx[e] + ay[e] * by[e]);
                c22[e] = factor * (ax[e] * ax[e] + ay[e] * ay[e]);
                area[e] = total * modulus;
            }
            for (block, det) in w.chunks(LANES).flat_map(|chunk| chunk.iter().enumerate()) {
                let modulus = det * orientation;
                least[block] = if modulus >= least[block] { least[block] } else { modulus };
            }
        }
        least.into_iter().fold(f64::INFINITY, |a, b| if b >= a { a } else { b })
    }

    /// Replaces the Laplacian by the form's coefficients, and evaluates the load.
    fn apply_form(&mut self, integrand: Integrand<'_>) -> Result<(), FiniteElementError> {
        let form = integrand.form;
        let second = &integrand.directions[1];
        let laplacian = matches!(form.diffusion, Coefficient::Constant(a) if a == DMat2::IDENTITY)
            && matches!(form.reaction, Coefficient::Constant(c) if c.to_bits() == 0);
        for q in 0..second.rule.count() {
            let start = q * self.stride;
            let range = start..start + second.cells;
            if laplacian {
                match form.load {
                    Coefficient::Constant(f) => {
                        for (load, area) in self.load[range.clone()].iter_mut().zip(&self.area[range.clone()])
                        {
                            *load = f * area;
                        }
                    }
                    Coefficient::Function(f) => {
                        for at in range.clone() {
                            self.load[at] =
                                f(DVec2::new(self.fields[0][at], self.fields[1][at])) * self.area[at];
                        }
                    }
                }
                let finite: f64 = self.load[range.clone()].iter().map(|load| load * 0.0).sum();
                if finite == 0.0 {
                    continue;
                }
            }
            for at in range {
                let place = DVec2::new(self.fields[0][at], self.fields[1][at]);
                let sample = form.at(place)?;
                self.load[at] = sample.load * self.area[at];
                self.reaction[at] = sample.reaction * self.area[at];
                let [_, _, det, ax, ay, _, bx, by, _] = &self.fields;
                let (r1, r2) = (DVec2::new(by[at], -bx[at]), DVec2::new(-ay[at], ax[at]));
                let factor = self.area[at] / (det[at] * det[at]);
                self.diffusion[0][at] = factor * r1.dot(sample.diffusion * r1);
                self.diffusion[1][at] = factor * r1.dot(sample.diffusion * r2);
                self.diffusion[2][at] = factor * r2.dot(sample.diffusion * r2);
            }
        }
        Ok(())
    }

    /// The error for a determinant that vanishes or has the wrong sign on this line.
    #[cold]
    fn bad_determinant(&self, integrand: Integrand<'_>, q1: usize, e1: usize) -> FiniteElementError {
        if let Err(error) = integrand.patch.check_regular() {
            return error;
        }
        let t = integrand.directions[0].point(q1, e1).0;
        let second = integrand.directions[1].breaks[0];
        FiniteElementError::SingularJacobian { patch: 0, parameter: DVec2::new(t, second) }
    }
}
