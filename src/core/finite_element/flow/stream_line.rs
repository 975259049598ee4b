//! Stream lines: `t′ = φ′⁻¹ V` in the parameters, by the embedded pair of Dormand and Prince with adaptive steps.
//!
//! J. R. Dormand, P. J. Prince, *A family of embedded Runge-Kutta formulae*, 1980.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::finite_element::error::FiniteElementError;
use crate::core::finite_element::flow::PotentialFlow;

/// Most steps of one line.
const MAX_STEPS: usize = 10_000;

/// Coefficients of the stages; the last row is the solution of order 5.
const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Differences of the weights of orders 5 and 4.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// A point of a stream line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StreamPoint {
    /// Time since the start.
    pub time: f64,
    /// The parameter.
    pub parameter: DVec2,
    /// The point of the plane.
    pub point: DVec2,
}

/// Why a stream line ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StreamEnd {
    /// It leaves through the right side.
    Outflow,
    /// The speed is 0, or the steps have become too small or too many.
    Stagnation,
}

/// The path of a particle.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamLine {
    /// Its points, the start first.
    pub points: Vec<StreamPoint>,
    /// Why it ends.
    pub end: StreamEnd,
}

impl PotentialFlow {
    /// The stream line from a point of the channel to its right side, with the error of every step below `tolerance`
    /// times the size of the parameter rectangle.
    ///
    /// # Errors
    ///
    /// `InvalidTolerance`; `OutsideInterval` if the point is not in the channel (also if it is no point).
    pub fn stream_line(&self, start: DVec2, tolerance: f64) -> Result<StreamLine, FiniteElementError> {
        if tolerance.is_nan() || tolerance <= 0.0 {
            return Err(SplineError::InvalidTolerance { value: tolerance }.into());
        }
        let patch = self.potential.space().patch();
        let [low, high] = patch.parameter_rectangle();
        let size = (high - low).max_element();
        let outside = SplineError::OutsideInterval { value: start.x, left: f64::NAN, right: f64::NAN };
        let mut t = patch.invert(start).ok_or(outside)?;
        let mut time = 0.0;
        let mut points = vec![StreamPoint { time, parameter: t, point: patch.evaluate(t)? }];
        let speed = self.drift(t)?.length();
        let mut step = 0.02 * size / speed;
        let mut end = StreamEnd::Stagnation;
        // Where a step shorter than this is asked for, the particle rests.
        let shortest = 1e-12 * step;
        for _ in 0..MAX_STEPS {
            // Not a number or infinite where nothing moves.
            if !(step > shortest && step.is_finite()) {
                break;
            }
            let (next, error) = self.step(t, step)?;
            if error > tolerance * size {
                step *= (0.9 * (tolerance * size / error).powf(0.2)).max(0.2);
                continue;
            }
            if next.x >= high.x {
                let (last, part) = self.step_to_end(t, step, next, high.x)?;
                (t, time, end) = (last, time + part, StreamEnd::Outflow);
                points.push(StreamPoint { time, parameter: t, point: patch.evaluate(t)? });
                break;
            }
            // Walls are stream lines; only rounding and the tolerance carry a particle through.
            t = next.clamp(low, high);
            time += step;
            points.push(StreamPoint { time, parameter: t, point: patch.evaluate(t)? });
            step *= (0.9 * (tolerance * size / error.max(1e-300)).powf(0.2)).clamp(0.2, 4.0);
        }
        Ok(StreamLine { points, end })
    }

    /// Velocity of the parameters; outside the rectangle that of the nearest parameter.
    fn drift(&self, t: DVec2) -> Result<DVec2, FiniteElementError> {
        let [low, high] = self.potential.space().patch().parameter_rectangle();
        let jet = self.potential.jet(t.clamp(low, high))?;
        Ok(jet.geometry.parameter_velocity(-jet.gradient))
    }

    /// The parameter after `step`, and the estimated error.
    fn step(&self, t: DVec2, step: f64) -> Result<(DVec2, f64), FiniteElementError> {
        let mut slopes = [DVec2::ZERO; 7];
        slopes[0] = self.drift(t)?;
        let mut next = t;
        for (stage, row) in STAGES.iter().enumerate() {
            next = t + step * row.iter().zip(slopes).map(|(a, slope)| *a * slope).sum::<DVec2>();
            if !next.is_finite() {
                return Ok((next, f64::INFINITY));
            }
            slopes[stage + 1] = self.drift(next)?;
        }
        let error = ERROR.iter().zip(slopes).map(|(e, slope)| *e * slope).sum::<DVec2>() * step;
        Ok((next, error.length()))
    }

    /// The part of `step` that ends on the right side, by the secant rule.
    fn step_to_end(
        &self,
        t: DVec2,
        step: f64,
        next: DVec2,
        right: f64,
    ) -> Result<(DVec2, f64), FiniteElementError> {
        let (mut low, mut high) = ((0.0, t.x), (step, next.x));
        let mut best = (next, step);
        for _ in 0..60 {
            let part = low.0 + (high.0 - low.0) * ((right - low.1) / (high.1 - low.1));
            let (trial, _) = self.step(t, part)?;
            best = (trial, part);
            if (trial.x - right).abs() <= 1e-13 * right.abs().max(1.0) || part <= low.0 || part >= high.0 {
                break;
            }
            if trial.x < right { low = (part, trial.x) } else { high = (part, trial.x) }
        }
        let [least, greatest] = self.potential.space().patch().parameter_rectangle();
        let mut end = best.0.clamp(least, greatest);
        end.x = right;
        Ok((end, best.1))
    }
}
