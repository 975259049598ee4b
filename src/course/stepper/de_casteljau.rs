//! De Casteljau's algorithm: the legs of a Bezier polygon are divided in the same ratio again and again.
//!
//! `pⁱ⁺¹ⱼ = (1 − s) pⁱⱼ + s pⁱⱼ₊₁`. Course: section 2.3.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::stepper::bezier_piece::BezierPiece;
use crate::course::stepper::de_boor::close_with_tangent;
use crate::course::stepper::narration::Shares;
use crate::course::stepper::teller::Teller;
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    if !curve.is_polynomial() {
        return Err("This curve has weights: choose the rational algorithm of de Casteljau.".to_owned());
    }
    let piece = BezierPiece::at(curve, t)?;
    let mut teller = piece.table();
    open(&mut teller, &piece, "Every new point divides a leg in the ratio s : 1 − s.");
    steps(&mut teller, &piece);
    close_with_tangent(&mut teller, &piece.net, piece.interval, "");
    teller.note = piece.note();
    let n = curve.degree();
    Ok(teller.end(StepperKind::DeCasteljau, piece.parameter, (n, 0)))
}

/// Frame 0: the control points, and the rule.
pub(super) fn open(teller: &mut Teller, piece: &BezierPiece, rule: &str) {
    let (caption, formula) = piece.opening(&teller.levels[0]);
    let ties: Vec<Tie> = teller.levels[0].iter().map(Entry::tie).collect();
    teller.tell(format!("{caption} {rule}"), formula, ties.clone(), ties);
}

/// One frame for each new point.
pub(super) fn steps(teller: &mut Teller, piece: &BezierPiece) {
    let degree = teller.levels.len() - 1;
    for level in 1..=degree {
        for position in 0..=degree - level {
            teller.tell_mixture((level, position), &Shares::Number(piece.share));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::Side;
    use crate::course::stepper::samples::{bezier, polynomial_curves, weighted};

    #[test]
    fn the_last_point_is_that_of_the_curve_with_its_tangent() {
        for curve in polynomial_curves() {
            let (left, right) = curve.space().parameter_interval();
            for share in [0.0, 0.2, 0.5, 0.73] {
                let t = left + share * (right - left);
                let stepper = story(&curve, t).unwrap();
                let expected = curve.derivatives(t, 1, Side::Right).unwrap();
                let found = stepper.apex().at.unwrap();
                assert!(found.distance(expected[0]) < 1e-11, "degree {}, t = {t}: {found}", curve.degree());
                let tangent = stepper.tangent().unwrap();
                assert!(
                    tangent.distance(expected[1]) < 1e-9,
                    "degree {}, t = {t}: {tangent}",
                    curve.degree()
                );
            }
        }
    }

    #[test]
    fn a_bezier_curve_names_its_own_control_points_and_new_points_after_the_left_parent() {
        let stepper = story(&bezier(), 0.5).unwrap();
        let names: Vec<&str> = stepper.levels()[0].iter().map(|entry| entry.label.as_str()).collect();
        assert_eq!(names, ["c_0", "c_1", "c_2", "c_3"], "control points");
        assert_eq!(stepper.apex().label, "p_0^3", "apex");
        let formula = &stepper.frames()[1].formula;
        assert!(formula.starts_with("p_0^1 = 0.5 \\, c_0 + 0.5 \\, c_1 = "), "{formula}");
        assert_eq!(stepper.frames().len(), 1 + 6 + 1, "control points, six new points, the tangent");
    }

    #[test]
    fn weights_ask_for_the_rational_algorithm() {
        assert!(story(&weighted(), 0.5).unwrap_err().contains("rational"), "a curve with weights");
    }
}
