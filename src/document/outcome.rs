//! What an edit did, and what it did to the shape.

use crate::document::edit::short;
use crate::document::object::ObjectId;

/// What an edit did.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// What happened to the shape of the curve.
    pub shape: ShapeChange,
    /// New objects.
    pub created: Vec<ObjectId>,
}

/// What an edit did to the shape of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShapeChange {
    /// There is nothing to say: no curve changed, or changing it was the purpose.
    None,
    /// The shape should be the same.
    Kept {
        /// A certified upper bound of the distance between old and new curve at equal parameters, in world units.
        deviation: f64,
    },
    /// The shape is another one.
    Changed {
        /// An upper bound of the distance at equal parameters; `None` if the parameter intervals differ or there are too many
        /// points to measure while one drags.
        deviation: Option<f64>,
        /// A parameter where the distance is largest among those sampled.
        at: Option<f64>,
    },
    /// A new curve approximates one that no spline is.
    Approximated {
        /// The largest distance measured.
        deviation: f64,
    },
}

impl ShapeChange {
    /// One sentence for the status line; `None` if there is nothing to say.
    pub fn sentence(&self) -> Option<String> {
        match *self {
            Self::None => None,
            Self::Approximated { deviation: 0.0 } => Some("The new curve is exact.".to_owned()),
            Self::Approximated { deviation } => Some(format!(
                "The new curve is an approximation (measured deviation at most {deviation:.1e})."
            )),
            Self::Kept { deviation: 0.0 } => Some("The shape is kept exactly.".to_owned()),
            Self::Kept { deviation } => {
                Some(format!("The shape is kept (deviation at most {deviation:.1e})."))
            }
            Self::Changed { deviation: Some(deviation), at: Some(at) } => Some(format!(
                "The shape changes by at most {}, most near t = {}.",
                short(deviation),
                short(at)
            )),
            Self::Changed { deviation: Some(deviation), at: None } => {
                Some(format!("The shape changes by at most {}.", short(deviation)))
            }
            Self::Changed { deviation: None, .. } => Some("The shape changes.".to_owned()),
        }
    }
}
