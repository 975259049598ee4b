//! Approximations to start with.

use std::f64::consts::TAU;

use crate::core::approximation::graded_breaks;
use crate::document::approximation::{
    Approximation, CubicEnds, DataError, ErrorPlot, KnotChoice, Method, Scheme, TypedFunction,
};

/// Prepared data, function and methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// `1/(1 + 25x²)`, where polynomials through equidistant points fail.
    Runge,
    /// The square root, with equidistant and with graded knots. Course: section 5.1.
    SquareRoot,
    /// The exponential function and the end conditions of cubic interpolation. Course: section 5.5.
    Exponential,
    /// A sine with noise, to be smoothed. Course: section 5.6.
    NoisySine,
    /// Knots for which Schoenberg's scheme turns the sign of the third derivative. Course: section 5.1.
    ThirdDerivative,
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Runge, Self::SquareRoot, Self::Exponential, Self::NoisySine, Self::ThirdDerivative];

    /// A name for buttons and objects.
    pub fn title(self) -> &'static str {
        match self {
            Self::Runge => "Runge's function",
            Self::SquareRoot => "Square root",
            Self::Exponential => "Exponential",
            Self::NoisySine => "Noisy sine",
            Self::ThirdDerivative => "Third derivative",
        }
    }

    /// What it shows, in one sentence.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Runge => "A polynomial of degree 10 through 11 points, and splines through the same points",
            Self::SquareRoot => "Schoenberg's scheme with equidistant knots and with knots that crowd at 0",
            Self::Exponential => "Cubic interpolation: not-a-knot, natural and clamped ends compared",
            Self::NoisySine => "Smoothing and least squares for data with noise",
            Self::ThirdDerivative => "Schoenberg's scheme for x\u{b3} has the third derivative \u{2212}6",
        }
    }

    /// The approximation.
    pub fn build(self) -> Approximation {
        // The data are constants, and a test builds them all.
        self.compose().unwrap_or_default()
    }

    fn compose(self) -> Result<Approximation, DataError> {
        let with = |text: &str, left: f64, right: f64| -> Result<Approximation, DataError> {
            Ok(Approximation::new().with_function(Some(TypedFunction::new(text, left, right)?)))
        };
        let add = |to: Approximation, schemes: Vec<Scheme>| -> Result<Approximation, DataError> {
            schemes
                .into_iter()
                .enumerate()
                .try_fold(to, |all, (color, scheme)| all.with_method(Method::new(scheme, color)))
        };
        match self {
            Self::Runge => add(
                with("1/(1 + 25x^2)", -1.0, 1.0)?.sampled(11)?,
                vec![
                    Scheme::Cubic { ends: CubicEnds::NotAKnot },
                    Scheme::Interpolation { degree: 10, knots: KnotChoice::Averaged },
                    Scheme::Interpolation { degree: 5, knots: KnotChoice::Averaged },
                ],
            ),
            Self::SquareRoot => {
                let graded = graded_breaks(0.0, 1.0, 8, 4.0).unwrap_or_default();
                let inner = graded.get(1..graded.len().saturating_sub(1)).unwrap_or_default().to_vec();
                let uniform = (1..8).map(|k| f64::from(k) / 8.0).collect();
                let scheme =
                    |knots: Vec<f64>| Scheme::Schoenberg { degree: 2, knots: KnotChoice::Inner(knots) };
                let all = add(with("sqrt(x)", 0.0, 1.0)?, vec![scheme(uniform), scheme(inner)])?;
                Ok(all.with_error_plot(ErrorPlot::Logarithmic))
            }
            Self::Exponential => {
                let all = add(
                    with("exp(x)", 0.0, 1.0)?.sampled(9)?,
                    vec![
                        Scheme::Cubic { ends: CubicEnds::NotAKnot },
                        Scheme::Cubic { ends: CubicEnds::Natural },
                        Scheme::Cubic { ends: CubicEnds::Clamped { start: 1.0, end: std::f64::consts::E } },
                    ],
                )?;
                Ok(all.with_error_plot(ErrorPlot::Logarithmic))
            }
            Self::NoisySine => {
                let sites: Vec<f64> = (0..=40).map(|i| f64::from(i) / 40.0).collect();
                let noise = |i: usize| (((7919 * i) % 101) as f64 - 50.0) / 50.0;
                let values = (0..=40).map(|i| (TAU * sites[i]).sin() + 0.1 * noise(i)).collect();
                let data = with("sin(2 pi x)", 0.0, 1.0)?.with_data(sites, values, None)?;
                add(
                    data,
                    vec![
                        Scheme::Smoothing { sigma: 2.73e-4 },
                        Scheme::LeastSquares { degree: 3, knots: KnotChoice::Inner(vec![0.25, 0.5, 0.75]) },
                        Scheme::Cubic { ends: CubicEnds::Natural },
                    ],
                )
            }
            Self::ThirdDerivative => add(
                with("x^3", 3.0, 4.0)?,
                vec![Scheme::Schoenberg {
                    degree: 3,
                    knots: KnotChoice::All(vec![0.0, 1.0, 2.0, 3.0, 4.0, 8.0, 9.0, 10.0]),
                }],
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_can_be_built() {
        for preset in Preset::ALL {
            let built = preset.compose();
            assert!(built.is_ok(), "{preset:?}: {built:?}");
            assert!(!preset.build().methods().is_empty(), "{preset:?} has methods");
        }
    }
}
