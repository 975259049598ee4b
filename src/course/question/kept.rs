//! What must stay as it was in the lesson's scene while a question is answered by changing the curve.

use glam::DVec2;
use serde::Deserialize;

use crate::core::spline_curve::Nurbs;
use crate::course::question::polygon_size;

/// Something that must not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kept {
    /// The control points.
    Points,
    /// The first and the last control point.
    Ends,
    /// The degree.
    Degree,
    /// The points of the curve, at all parameters.
    Shape,
}

/// The largest distance, as a share of the polygon's size, that counts as no change.
const SAME: f64 = 1e-6;
/// Samples of the parameter interval.
const SAMPLES: usize = 100;

impl Kept {
    /// What has changed from `original` to `curve`; `None` if nothing has.
    pub(super) fn violation(self, original: &Nurbs<DVec2>, curve: &Nurbs<DVec2>) -> Option<String> {
        let near = SAME * polygon_size(original);
        let moved = |from: &DVec2, to: &DVec2| from.distance(*to) > near;
        let (from, to) = (original.points(), curve.points());
        match self {
            Self::Points => {
                if from.len() != to.len() {
                    return Some("The control points must stay; their number has changed.".to_owned());
                }
                let index = from.iter().zip(to).position(|(from, to)| moved(from, to))?;
                Some(format!("The control points must stay, but $c_{{{index}}}$ has moved."))
            }
            Self::Ends => {
                let ends = [(from.first(), to.first(), "first"), (from.last(), to.last(), "last")];
                let (.., name) = ends
                    .into_iter()
                    .find(|(from, to, _)| from.zip(*to).is_none_or(|(from, to)| moved(from, to)))?;
                Some(format!("The {name} control point must stay where it was."))
            }
            Self::Degree => (original.degree() != curve.degree()).then(|| {
                format!("The degree must stay {}; it is {} now.", original.degree(), curve.degree())
            }),
            Self::Shape => {
                let (left, right) = original.space().parameter_interval();
                let changed = (0..=SAMPLES).map(|i| left + (right - left) * (i as f64 / SAMPLES as f64)).any(
                    |t| match (original.evaluate(t), curve.evaluate(t)) {
                        (Ok(from), Ok(to)) => moved(&from, &to),
                        _ => true,
                    },
                );
                changed.then(|| "The curve must keep its shape, but it has changed.".to_owned())
            }
        }
    }
}
