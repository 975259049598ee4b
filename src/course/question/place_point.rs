//! Questions whose answer is a point of de Boor's scheme, placed in the plane.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::short_number;
use crate::course::question::{Verdict, find_entry, name, parents, polygon_size};

/// The point that is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub(super) parameter: f64,
    pub(super) level: usize,
    pub(super) index: usize,
}

/// Judges a placed point by its distance from the true one, as a share of the polygon's size.
pub(super) fn check(
    curve: &Nurbs<DVec2>,
    wanted: Wanted,
    tolerance: f64,
    placed: DVec2,
    feedback: &str,
) -> Verdict {
    let (stepper, entry) = match find_entry(curve, wanted.parameter, wanted.level, wanted.index) {
        Ok(found) => found,
        Err(reason) => return Verdict::wrong(None, reason),
    };
    let size = polygon_size(curve);
    let Some(right) = entry.point() else { return Verdict::wrong(None, "The scheme holds no points.") };
    if size <= 0.0 {
        return Verdict::wrong(None, "All control points lie in one place. Go back to the example.");
    }
    let measured = placed.distance(right) / size;
    if measured <= tolerance {
        return Verdict::right(measured, feedback);
    }
    let hint = match parents(&stepper, &entry) {
        None => format!("${}$ is a control point.", name(curve, &entry)),
        Some((left, right_parent)) => {
            let (Some(from), Some(to)) = (left.point(), right_parent.point()) else {
                return Verdict::wrong(Some(measured), "The scheme holds no points.");
            };
            let leg = to - from;
            let along = if leg.length_squared() > 0.0 {
                ((placed - from).dot(leg) / leg.length_squared()).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let beside = placed.distance(from + leg * along) / size;
            let [own, left, right] = [&entry, left, right_parent].map(|entry| name(curve, entry));
            if beside > tolerance {
                format!("${own}$ lies on the segment from ${left}$ to ${right}$; yours is beside it.")
            } else {
                let true_share = if leg.length_squared() > 0.0 {
                    (entry_point(&entry) - from).length() / leg.length()
                } else {
                    0.0
                };
                format!(
                    "It is on the segment from ${left}$ to ${right}$, but {} % of the way along; ${own}$ is {}.",
                    short_number((100.0 * along).round()),
                    if along < true_share { "farther on" } else { "nearer to the start" }
                )
            }
        }
    };
    Verdict::wrong(Some(measured), hint)
}

fn entry_point(entry: &crate::course::stepper::Entry) -> DVec2 {
    entry.point().unwrap_or(DVec2::NAN)
}
