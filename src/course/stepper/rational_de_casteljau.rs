//! De Casteljau's algorithm for a rational Bezier curve: points and weights in one column, divided at the end.
//!
//! The homogeneous points `(w c, w)` run through the scheme, and `r = p/w`. Course: section 3.3.

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{formula_number, formula_point, short_number, short_point};
use crate::course::stepper::bezier_piece::BezierPiece;
use crate::course::stepper::de_boor::close_with_tangent;
use crate::course::stepper::de_casteljau::{open, steps};
use crate::course::stepper::narration::{homogeneous_label, weight_label};
use crate::course::stepper::{Stepper, StepperKind};

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, String> {
    if curve.is_polynomial() {
        return Err(
            "All weights are equal, so the curve is polynomial: choose the algorithm of de Casteljau without weights, or \
             change a weight."
                .to_owned(),
        );
    }
    let piece = BezierPiece::at(curve, t)?;
    let n = curve.degree();
    let mut teller = piece.table();
    for entry in teller.levels.iter_mut().flatten() {
        let (weight, [x, y]) = (entry.weight.unwrap_or(1.0), [entry.coordinates[0], entry.coordinates[1]]);
        let column = [("wx", weight * x), ("wy", weight * y), ("w", weight)];
        entry.lines = column.map(|(name, value)| format!("{name} {}", short_number(value))).to_vec();
        entry.lines.extend([format!("x {}", short_number(x)), format!("y {}", short_number(y))]);
    }
    open(&mut teller, &piece, "Each becomes a column (w x, w y, w), and the columns are mixed.");
    steps(&mut teller, &piece);
    let top = &teller.levels[n][0];
    let weight = top.weight.unwrap_or(1.0);
    let lifted: Vec<f64> = top.coordinates.iter().map(|coordinate| coordinate * weight).collect();
    let caption = format!(
        "The last column is divided by its weight {}: the point is {}.",
        short_number(weight),
        short_point(&top.coordinates)
    );
    let formula = format!(
        "r = \\frac{{{}}}{{{}}} = \\frac{{1}}{{{}}} {} = {}",
        homogeneous_label(top),
        weight_label(top),
        formula_number(weight),
        formula_point(&lifted),
        formula_point(&top.coordinates)
    );
    teller.tell(caption, formula, Vec::new(), vec![(n, 0)]);
    close_with_tangent(&mut teller, &piece.net, piece.interval, "");
    teller.note = piece.note();
    Ok(teller.end(StepperKind::RationalDeCasteljau, piece.parameter, (n, 0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::Side;
    use crate::course::stepper::samples::{bezier, rational_curves, weighted};

    #[test]
    fn the_quotient_is_the_point_of_the_curve_and_the_tangent_its_derivative() {
        for curve in rational_curves() {
            let (left, right) = curve.space().parameter_interval();
            for share in [0.0, 0.31, 0.5, 0.9] {
                let t = left + share * (right - left);
                let stepper = story(&curve, t).unwrap();
                let expected = curve.derivatives(t, 1, Side::Right).unwrap();
                let (point, tangent) = (stepper.apex().at.unwrap(), stepper.tangent().unwrap());
                assert!(point.distance(expected[0]) < 1e-11, "t = {t}: {point}");
                assert!(tangent.distance(expected[1]) < 1e-9, "t = {t}: {tangent}");
            }
        }
    }

    #[test]
    fn the_column_of_weights_runs_through_the_same_scheme() {
        let stepper = story(&weighted(), 0.25).unwrap();
        for entry in stepper.table().filter(|entry| entry.level > 0) {
            let [left, right] = &entry.parents[..] else { panic!("two parents") };
            let weight = |tie: (usize, usize)| stepper.entry(tie.0, tie.1).unwrap().weight.unwrap();
            let expected = left.factor * weight(left.tie) + right.factor * weight(right.tie);
            assert!((entry.weight.unwrap() - expected).abs() < 1e-14, "{}", entry.label);
            assert_eq!(entry.lines.len(), 5, "the column and the point");
        }
    }

    #[test]
    fn equal_weights_need_no_column() {
        assert!(story(&bezier(), 0.5).unwrap_err().contains("equal"), "a polynomial curve");
    }
}
