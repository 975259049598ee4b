//! The methods and their settings.

use serde::{Deserialize, Serialize};

use crate::document::approximation::{DataError, MAX_DATA};

/// The highest degree of a method.
pub const MAX_DEGREE: usize = 12;

/// What a cubic interpolant does at the ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum CubicEnds {
    /// The second and the last but one site are no knots.
    #[default]
    NotAKnot,
    /// No second derivative.
    Natural,
    /// Given slopes.
    Clamped {
        /// Slope at the first site.
        start: f64,
        /// Slope at the last site.
        end: f64,
    },
    /// Given second derivatives.
    SecondDerivatives {
        /// At the first site.
        start: f64,
        /// At the last site.
        end: f64,
    },
    /// Periodic: the last value must repeat the first.
    Periodic,
}

/// Where the knots of a method come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum KnotChoice {
    /// End-interpolating knots with averages of the sites inside: interpolation is always possible.
    Averaged,
    /// End-interpolating knots with these inner ones.
    Inner(Vec<f64>),
    /// All knots, those outside the interval too.
    All(Vec<f64>),
}

/// A method of approximation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Scheme {
    /// The cubic spline through the data, with knots at the sites.
    Cubic {
        /// What it does at the ends.
        ends: CubicEnds,
    },
    /// The spline of any degree through the data.
    Interpolation {
        /// Degree.
        degree: usize,
        /// Knots.
        knots: KnotChoice,
    },
    /// The spline with the least weighted sum of squared differences.
    LeastSquares {
        /// Degree.
        degree: usize,
        /// Knots.
        knots: KnotChoice,
    },
    /// The smoothing spline.
    Smoothing {
        /// σ from 0, the natural interpolant, to 1, the line.
        sigma: f64,
    },
    /// Schoenberg's scheme for the function or, without one, for the broken line through the data.
    Schoenberg {
        /// Degree.
        degree: usize,
        /// Knots.
        knots: KnotChoice,
    },
}

/// A method with its settings, its colour, and whether it is shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Method {
    /// What it does.
    pub scheme: Scheme,
    /// Index into the palette.
    pub color: usize,
    /// Whether it is drawn.
    pub visible: bool,
}

impl Scheme {
    /// Its name in a few words.
    pub fn title(&self) -> String {
        match self {
            Self::Cubic { ends } => match ends {
                CubicEnds::NotAKnot => "Cubic, not-a-knot".to_owned(),
                CubicEnds::Natural => "Cubic, natural".to_owned(),
                CubicEnds::Clamped { .. } => "Cubic, clamped".to_owned(),
                CubicEnds::SecondDerivatives { .. } => "Cubic, second derivatives".to_owned(),
                CubicEnds::Periodic => "Cubic, periodic".to_owned(),
            },
            Self::Interpolation { degree, .. } => format!("Interpolation, degree {degree}"),
            Self::LeastSquares { degree, .. } => format!("Least squares, degree {degree}"),
            Self::Smoothing { .. } => "Smoothing spline".to_owned(),
            Self::Schoenberg { degree, .. } => format!("Schoenberg, degree {degree}"),
        }
    }

    /// Degree and knots, if they are settings of the method.
    pub fn space(&self) -> Option<(usize, &KnotChoice)> {
        match self {
            Self::Interpolation { degree, knots }
            | Self::LeastSquares { degree, knots }
            | Self::Schoenberg { degree, knots } => Some((*degree, knots)),
            Self::Cubic { .. } | Self::Smoothing { .. } => None,
        }
    }

    /// The same method with another degree and other knots; itself if it has none to set.
    #[must_use]
    pub fn with_space(&self, degree: usize, knots: KnotChoice) -> Self {
        match self {
            Self::Interpolation { .. } => Self::Interpolation { degree, knots },
            Self::LeastSquares { .. } => Self::LeastSquares { degree, knots },
            Self::Schoenberg { .. } => Self::Schoenberg { degree, knots },
            Self::Cubic { .. } | Self::Smoothing { .. } => self.clone(),
        }
    }
}

impl KnotChoice {
    /// The knots that are given.
    pub fn given(&self) -> &[f64] {
        match self {
            Self::Averaged => &[],
            Self::Inner(knots) | Self::All(knots) => knots,
        }
    }

    /// The same kind of choice with other knots.
    #[must_use]
    pub fn with(&self, knots: Vec<f64>) -> Self {
        match self {
            Self::All(_) => Self::All(knots),
            Self::Averaged | Self::Inner(_) => Self::Inner(knots),
        }
    }
}

impl Method {
    /// A method that is shown.
    pub fn new(scheme: Scheme, color: usize) -> Self {
        Self { scheme, color, visible: true }
    }

    /// The knots that are given with it.
    pub fn knots(&self) -> &[f64] {
        self.scheme.space().map_or(&[], |(_, knots)| knots.given())
    }

    /// Checks the numbers.
    ///
    /// # Errors
    ///
    /// `DegreeOutsideWindow`, `NonFinite`, `KnotsDecreasing` with the index in the list, `TooMany`, `SigmaOutOfRange`.
    pub fn check(&self) -> Result<(), DataError> {
        if let Some((degree, _)) = self.scheme.space()
            && !(1..=MAX_DEGREE).contains(&degree)
        {
            return Err(DataError::DegreeOutsideWindow { degree });
        }
        let knots = self.knots();
        if knots.len() > MAX_DATA {
            return Err(DataError::TooMany { what: "knots", value: knots.len(), limit: MAX_DATA });
        }
        if let Some(index) = knots.iter().position(|knot| !knot.is_finite()) {
            return Err(DataError::NonFinite { what: "knot", index, value: knots[index] });
        }
        if let Some(index) = knots.windows(2).position(|pair| pair[0] > pair[1]) {
            let (previous, value) = (knots[index], knots[index + 1]);
            return Err(DataError::KnotsDecreasing { index: index + 1, value, previous });
        }
        match self.scheme {
            Scheme::Smoothing { sigma } if !(0.0..=1.0).contains(&sigma) => {
                Err(DataError::SigmaOutOfRange { value: sigma })
            }
            Scheme::Cubic {
                ends: CubicEnds::Clamped { start, end } | CubicEnds::SecondDerivatives { start, end },
            } if !(start.is_finite() && end.is_finite()) => {
                let (index, value) = if start.is_finite() { (1, end) } else { (0, start) };
                Err(DataError::NonFinite { what: "end condition", index, value })
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_that_are_none_are_refused_by_name() {
        let name = |scheme: Scheme| Method::new(scheme, 0).check().map_err(|error| error.name());
        let inner = |knots: &[f64]| KnotChoice::Inner(knots.to_vec());
        for (scheme, error) in [
            (Scheme::Interpolation { degree: 0, knots: KnotChoice::Averaged }, "DegreeOutsideWindow"),
            (Scheme::LeastSquares { degree: 13, knots: inner(&[]) }, "DegreeOutsideWindow"),
            (Scheme::LeastSquares { degree: 3, knots: inner(&[1.0, 0.0]) }, "KnotsDecreasing"),
            (Scheme::Schoenberg { degree: 3, knots: inner(&[f64::NAN]) }, "NonFinite"),
            (Scheme::Smoothing { sigma: 1.5 }, "SigmaOutOfRange"),
            (Scheme::Smoothing { sigma: f64::NAN }, "SigmaOutOfRange"),
            (Scheme::Cubic { ends: CubicEnds::Clamped { start: 0.0, end: f64::INFINITY } }, "NonFinite"),
        ] {
            assert_eq!(name(scheme.clone()), Err(error), "{scheme:?}");
        }
        assert_eq!(name(Scheme::Cubic { ends: CubicEnds::Natural }), Ok(()), "a good one");
    }
}
