//! Subdivision of a Bezier curve: de Casteljau's triangle has the control points of both halves on its edges.
//!
//! The part over `[0, s]` has the control points `p⁰₀, p¹₀, …, pⁿ₀`, that over `[s, 1]` has `pⁿ₀, pⁿ⁻¹₁, …, p⁰ₙ`. Course: section 2.6.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::short_number;
use crate::course::stepper::bezier_piece::BezierPiece;
use crate::course::stepper::de_casteljau::{open, steps};
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};
use crate::figure::composition::StepInk;

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    let piece = BezierPiece::at(curve, t)?;
    let n = curve.degree();
    let mut teller = piece.table();
    open(&mut teller, &piece, "The triangle of de Casteljau cuts the curve in two.");
    steps(&mut teller, &piece);
    let first: Vec<Tie> = (0..=n).map(|level| (level, 0)).collect();
    let second: Vec<Tie> = (0..=n).rev().map(|level| (level, n - level)).collect();
    let (from, to) = piece.interval;
    let mut polygons = Vec::new();
    for (edge, ties, interval, ink) in [
        ("left", first, (from, piece.parameter), StepInk::First),
        ("right", second, (piece.parameter, to), StepInk::Second),
    ] {
        let entries: Vec<Entry> =
            ties.iter().map(|&(level, position)| teller.levels[level][position].clone()).collect();
        let names: Vec<&str> = entries.iter().map(|entry| entry.label.as_str()).collect();
        let points = entries.iter().filter_map(|entry| entry.at).collect();
        let weights = if piece.net.rational { ", with the weights beside them" } else { "" };
        let caption = format!(
            "The {edge} edge of the triangle holds the control points of the part over [{}, {}]{weights}.",
            short_number(interval.0),
            short_number(interval.1)
        );
        teller.tell(caption, names.join(",\\; "), Vec::new(), ties);
        polygons.push((points, ink));
        for (points, ink) in polygons.clone() {
            teller.draw(|drawing| drawing.line(points, ink, 3.0));
        }
    }
    teller.note = piece.note();
    Ok(teller.end(StepperKind::BezierSubdivision, piece.parameter, (n, 0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::rational_bezier::RationalBezier;
    use crate::course::stepper::samples::all_curves;

    #[test]
    fn the_edges_are_the_control_points_of_both_parts() {
        for curve in all_curves() {
            let (left, right) = curve.space().parameter_interval();
            let t = left + 0.37 * (right - left);
            let stepper = story(&curve, t).unwrap();
            let lines = &stepper.frames().last().unwrap().drawing.lines;
            let segments = curve.bezier_form();
            let segment = segments.iter().rfind(|segment| segment.interval.0 <= t).unwrap();
            let whole = RationalBezier::on_interval(
                segment.points.clone(),
                segment.weights.clone(),
                segment.interval,
            )
            .unwrap();
            let (first, second) = whole.split(t).unwrap();
            for (line, half) in lines.iter().zip([first, second]) {
                assert_eq!(line.points.len(), curve.degree() + 1, "as many points as before");
                for (found, expected) in line.points.iter().zip(half.points()) {
                    let far = found.distance(*expected);
                    assert!(far < 1e-10, "degree {}: {found} instead of {expected}", curve.degree());
                }
            }
        }
    }
}
