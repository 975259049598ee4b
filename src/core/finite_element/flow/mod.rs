//! Potential flow through a channel: velocity `V = −grad u` with `Δu = 0`.
//!
//! The fluid enters through the left side of the patch with normal speed `s` and leaves through the right side; top and
//! bottom are walls. In weak form
//!
//! ```text
//! ∫ grad u · grad v = s ∫_left v − s′ ∫_right v,   s |left| = s′ |right|,
//! ```
//!
//! and `u` is the solution with mean value 0. Course: section 9.5.

mod stream_line;

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::form::{Coefficient, EllipticForm};
use crate::core::finite_element::geometry::{Orientation, PatchSide, PlanePatch};
use crate::core::finite_element::isogeometric::{
    IsogeometricSolution, IsogeometricSpace, SideFlux, solve_patch,
};
use crate::core::progress::Watcher;
use crate::core::quadrature::gauss_legendre;
pub use stream_line::{StreamEnd, StreamLine, StreamPoint};

/// Gauss points in each knot interval for lengths of sides and fluxes.
const POINTS: usize = 12;

/// The flow through a channel.
#[derive(Clone, Debug)]
pub struct PotentialFlow {
    potential: IsogeometricSolution,
    inflow: f64,
    outflow: f64,
}

impl PotentialFlow {
    /// Solves for the potential with splines of `degree` whose knots divide every knot interval of the patch into
    /// `divisions` parts.
    ///
    /// `inflow` is the normal speed on the left side; `outflow` that on the right side, or `None` for the one that balances.
    ///
    /// # Errors
    ///
    /// `NonFinite` for the speeds, `IncompatibleData` if inflow and outflow do not balance; those of
    /// [`IsogeometricSpace::refined`] and [`solve_patch`].
    pub fn solve(
        patch: &PlanePatch,
        degree: usize,
        divisions: [usize; 2],
        inflow: f64,
        outflow: Option<f64>,
        watcher: &dyn Watcher,
    ) -> Result<Self, FiniteElementError> {
        for (index, value) in [inflow, outflow.unwrap_or(0.0)].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(SplineError::NonFinite { what: "speed", index, value }.into());
            }
        }
        let (left, right) = (side_length(patch, PatchSide::Left)?, side_length(patch, PatchSide::Right)?);
        let outflow = outflow.unwrap_or(inflow * left / right);
        let space = IsogeometricSpace::refined(patch, degree, divisions, &[])?;
        let form = EllipticForm::poisson(Coefficient::Constant(0.0));
        let (enters, leaves) = (move |_| inflow, move |_| -outflow);
        let fluxes = [
            SideFlux { side: PatchSide::Left, flux: &enters },
            SideFlux { side: PatchSide::Right, flux: &leaves },
        ];
        let potential = solve_patch(space, &form, &fluxes, watcher)?;
        Ok(Self { potential, inflow, outflow })
    }

    /// The potential `u`, with mean value 0.
    pub fn potential(&self) -> &IsogeometricSolution {
        &self.potential
    }

    /// The normal speeds on the left and on the right.
    pub fn speeds(&self) -> (f64, f64) {
        (self.inflow, self.outflow)
    }

    /// The velocity `−grad u` at the parameter `t`.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn velocity(&self, t: DVec2) -> Result<DVec2, FiniteElementError> {
        Ok(-self.potential.jet(t)?.gradient)
    }

    /// The velocity at a point of the plane; `None` outside the channel.
    pub fn velocity_at(&self, place: DVec2) -> Option<DVec2> {
        Some(-self.potential.jet_at(place)?.gradient)
    }

    /// The pressure relative to that of fluid with the speed of the inflow, by Bernoulli for density 1: `(s² − |V|²)/2`.
    ///
    /// # Errors
    ///
    /// As [`Self::velocity`].
    pub fn pressure(&self, t: DVec2) -> Result<f64, FiniteElementError> {
        Ok(0.5 * (self.inflow * self.inflow - self.velocity(t)?.length_squared()))
    }

    /// The flux through the section with first parameter `t1`, positive from left to right.
    ///
    /// # Errors
    ///
    /// `NonFinite`, `OutsideInterval`.
    pub fn flux(&self, t1: f64) -> Result<f64, FiniteElementError> {
        let sign = match self.potential.space().orientation() {
            Orientation::Positive => 1.0,
            Orientation::Negative => -1.0,
        };
        let rule = gauss_legendre(POINTS)?;
        let mut flux = 0.0;
        for pair in self.potential.space().spaces()[1].breaks().windows(2) {
            for (t2, weight) in rule.on(pair[0], pair[1]) {
                let jet = self.potential.jet(DVec2::new(t1, t2))?;
                // The normal is the tangent of the section turned to the right.
                flux += sign * weight * jet.geometry.tangents[1].perp_dot(jet.gradient);
            }
        }
        Ok(flux)
    }
}

fn side_length(patch: &PlanePatch, side: PatchSide) -> Result<f64, FiniteElementError> {
    let along = 1 - side.axis();
    let rule = gauss_legendre(POINTS)?;
    let mut length = 0.0;
    for pair in patch.spaces()[along].breaks().windows(2) {
        for (t, weight) in rule.on(pair[0], pair[1]) {
            length += weight * patch.jet(patch.side_parameter(side, t))?.tangents[along].length();
        }
    }
    Ok(length)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

    use super::*;
    use crate::core::finite_element::sample_geometries as sample;
    use crate::core::progress::Unwatched;

    #[test]
    fn through_a_straight_channel_the_flow_is_uniform() {
        let flow = PotentialFlow::solve(&sample::unit_square(), 2, [3, 2], 2.0, None, &Unwatched).unwrap();
        for t in [DVec2::ZERO, DVec2::new(0.3, 0.8), DVec2::ONE] {
            let velocity = flow.velocity(t).unwrap();
            assert!((velocity - DVec2::new(2.0, 0.0)).length() < 1e-11, "{velocity} at {t}");
            assert!(flow.pressure(t).unwrap().abs() < 1e-10, "no pressure difference at {t}");
        }
        let line = flow.stream_line(DVec2::new(0.0, 0.25), 1e-8).unwrap();
        let end = line.points.last().unwrap();
        assert!((end.point - DVec2::new(1.0, 0.25)).length() < 1e-10, "it goes straight: {end:?}");
        assert!((end.time - 0.5).abs() < 1e-9, "length 1 at speed 2: {}", end.time);
    }

    #[test]
    fn the_flux_is_the_same_through_every_section() {
        let patch = sample::channel();
        let flow = PotentialFlow::solve(&patch, 3, [16, 8], 1.0, None, &Unwatched).unwrap();
        for t1 in [0.0, 0.4, 1.0, 1.7, 2.0] {
            let flux = flow.flux(t1).unwrap();
            assert!((flux - 10.0).abs() < 5e-3, "through t1 = {t1}: {flux}");
        }
    }

    #[test]
    fn unbalanced_flow_and_bad_speeds_are_refused() {
        let solve = |inflow, outflow| {
            PotentialFlow::solve(&sample::unit_square(), 1, [2, 2], inflow, outflow, &Unwatched)
                .map(|_| ())
                .map_err(|error| error.name())
        };
        assert_eq!(solve(1.0, Some(2.0)), Err("IncompatibleData"), "more out than in");
        assert_eq!(solve(f64::NAN, None), Err("NonFinite"), "no speed");
        assert_eq!(solve(0.0, None), Ok(()), "water at rest");
    }
}
