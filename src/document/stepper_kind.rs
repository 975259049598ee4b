//! Which algorithm is told step by step, and what it needs beside a curve and a parameter.

use glam::DVec2;
use serde::{Deserialize, Serialize};

/// An algorithm for curves that can be told step by step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StepperKind {
    /// Section 2.3: repeated division of the legs of a Bezier polygon.
    DeCasteljau,
    /// Section 2.6: the control points of both halves on the edges of de Casteljau's triangle.
    BezierSubdivision,
    /// Section 3.3: de Casteljau's algorithm for points and weights.
    RationalDeCasteljau,
    /// Section 4.1: the B-splines that are not zero at a parameter, from degree 0 on.
    Recurrence,
    /// Sections 4.2 and 4.5: differences of control points and the derivative.
    Differentiation,
    /// Section 4.5: repeated mixing of the active control points.
    #[default]
    DeBoor,
    /// Section 6.3: the control points for one knot more.
    KnotInsertion,
    /// Section 6.3: doubling and averaging.
    UniformSubdivision,
    /// Section 6.3: where the curve meets a line, by bisection.
    Intersection,
    /// Section 6.4: every knot raised to the degree, one insertion after the other.
    BezierForm,
    /// Section 6.4: de Boor's triangle with another argument in every step.
    Blossom,
}

impl StepperKind {
    /// All algorithms, in the order of the course.
    pub const ALL: [Self; 11] = [
        Self::DeCasteljau,
        Self::BezierSubdivision,
        Self::RationalDeCasteljau,
        Self::Recurrence,
        Self::Differentiation,
        Self::DeBoor,
        Self::KnotInsertion,
        Self::UniformSubdivision,
        Self::Intersection,
        Self::BezierForm,
        Self::Blossom,
    ];

    /// The name in files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::DeCasteljau => "de-casteljau",
            Self::BezierSubdivision => "bezier-subdivision",
            Self::RationalDeCasteljau => "rational-de-casteljau",
            Self::Recurrence => "recurrence",
            Self::Differentiation => "differentiation",
            Self::DeBoor => "de-boor",
            Self::KnotInsertion => "knot-insertion",
            Self::UniformSubdivision => "uniform-subdivision",
            Self::Intersection => "intersection",
            Self::BezierForm => "bezier-form",
            Self::Blossom => "blossom",
        }
    }

    /// The name people know it by.
    pub const fn name(self) -> &'static str {
        match self {
            Self::DeCasteljau => "De Casteljau",
            Self::BezierSubdivision => "Bézier subdivision",
            Self::RationalDeCasteljau => "Rational de Casteljau",
            Self::Recurrence => "Recurrence of B-splines",
            Self::Differentiation => "Differentiation",
            Self::DeBoor => "De Boor",
            Self::KnotInsertion => "Knot insertion",
            Self::UniformSubdivision => "Uniform subdivision",
            Self::Intersection => "Intersection with a line",
            Self::BezierForm => "Bézier form",
            Self::Blossom => "Blossom",
        }
    }

    /// The sections of the course.
    pub const fn section(self) -> &'static str {
        match self {
            Self::DeCasteljau => "2.3",
            Self::BezierSubdivision => "2.6",
            Self::RationalDeCasteljau => "3.3",
            Self::Recurrence => "4.1",
            Self::Differentiation => "4.2, 4.5",
            Self::DeBoor => "4.5",
            Self::KnotInsertion | Self::UniformSubdivision | Self::Intersection => "6.3",
            Self::BezierForm | Self::Blossom => "6.4",
        }
    }
}

/// A straight line of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepperLine {
    /// A point on it.
    pub through: DVec2,
    /// Its direction: the angle from the x axis, in degrees.
    pub angle: f64,
}

impl StepperLine {
    /// The unit vector along the line.
    pub fn direction(&self) -> DVec2 {
        // The sine of π is not quite zero; lines along the axes are to be exact.
        match self.angle.rem_euclid(360.0) {
            0.0 => DVec2::X,
            90.0 => DVec2::Y,
            180.0 => DVec2::NEG_X,
            270.0 => DVec2::NEG_Y,
            angle => DVec2::from_angle(angle.to_radians()),
        }
    }
}

/// What some algorithms need beside a curve and a parameter; saved with the view.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct StepperChoices {
    /// The line that is intersected; the horizontal one through the middle of the control points if nothing is chosen.
    pub line: Option<StepperLine>,
    /// The arguments of the blossom, as many as the degree; otherwise ends of the knot interval and the parameter.
    pub arguments: Vec<f64>,
}
