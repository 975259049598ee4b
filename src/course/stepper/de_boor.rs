//! Steppers of curves: de Boor at a parameter, de Casteljau on a control polygon.

use glam::DVec2;

use crate::core::bspline::SplineError;
use crate::core::rational_bezier::Projective as _;
use crate::core::spline_curve::Nurbs;
use crate::core::triangular_scheme::TriangularScheme;
use crate::course::stepper::{Algorithm, SchemeContext, Stepper};

/// De Boor's algorithm for `curve` at `t`, told step by step.
///
/// A rational curve is evaluated in homogeneous coordinates; the table shows the projected points and their weights.
/// For a closed curve `t` is reduced into one period.
///
/// # Errors
///
/// `NonFinite`, `OutsideInterval`.
///
/// Course: sections 4.5, 4.6 and 6.1.
pub fn de_boor_stepper(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, SplineError> {
    let knots = curve.space().evaluation_knots();
    if curve.is_polynomial() {
        let scheme = curve.without_weights().de_boor_scheme(t)?;
        return Stepper::new(
            &scheme.triangle,
            &SchemeContext {
                algorithm: Algorithm::DeBoor { knots, span: scheme.span },
                parameter: scheme.parameter,
                coefficients: &scheme.coefficients,
                weights: None,
            },
        );
    }
    let scheme = curve.de_boor_scheme(t)?;
    let weights: Vec<Vec<f64>> =
        scheme.triangle.levels().iter().map(|level| level.iter().map(|point| point.z).collect()).collect();
    Stepper::new(
        &scheme.triangle.map(|point| DVec2::project(point).0),
        &SchemeContext {
            algorithm: Algorithm::DeBoor { knots, span: scheme.span },
            parameter: scheme.parameter,
            coefficients: &scheme.coefficients,
            weights: Some(&weights),
        },
    )
}

/// De Casteljau's algorithm for the Bezier curve over `[0, 1]` with the control points `points`.
///
/// # Errors
///
/// `Empty`; `DegreeZero` for a single point; `NonFinite`; `OutsideInterval` for `t` outside `[0, 1]`.
///
/// Course: section 2.2.
pub fn de_casteljau_stepper(points: &[DVec2], t: f64) -> Result<Stepper, SplineError> {
    if let Some(index) = points.iter().position(|point| !point.is_finite()) {
        let point = points[index];
        let value = if point.x.is_finite() { point.y } else { point.x };
        return Err(SplineError::NonFinite { what: "control point", index, value });
    }
    if t.is_finite() && !(0.0..=1.0).contains(&t) {
        return Err(SplineError::OutsideInterval { value: t, left: 0.0, right: 1.0 });
    }
    let coefficients: Vec<usize> = (0..points.len()).collect();
    let scheme = TriangularScheme::run(points.to_vec(), points.len().saturating_sub(1), |_, _| t);
    Stepper::new(
        &scheme,
        &SchemeContext {
            algorithm: Algorithm::DeCasteljau,
            parameter: t,
            coefficients: &coefficients,
            weights: None,
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::{Side, SplineSpace};

    const KNOTS: [f64; 11] = [0.0, 0.0, 0.0, 1.0, 4.0, 6.0, 7.0, 8.0, 8.0, 8.0, 9.0];
    const COEFFICIENTS: [f64; 7] = [-3.0, 1.0, -5.0, 4.0, 4.0, -7.0, 9.0];

    /// The graph of the spline of example 4.5-a: control points (knot average, coefficient).
    fn graph(weights: Option<Vec<f64>>) -> Nurbs<DVec2> {
        let space = SplineSpace::new(3, KNOTS.to_vec()).unwrap();
        let points: Vec<DVec2> =
            space.greville_abscissae().into_iter().zip(COEFFICIENTS).map(DVec2::from).collect();
        Nurbs::new(space, points, weights.unwrap_or_else(|| vec![1.0; 7])).unwrap()
    }

    fn closed(degree: usize, weights: Vec<f64>) -> Nurbs<DVec2> {
        let knots = vec![0.0, 1.0, 2.5, 3.0, 4.0];
        let space = SplineSpace::periodic(degree, 5.0, knots).unwrap();
        let points = [(0.0, 0.0), (4.0, 1.0), (5.0, 4.0), (1.0, 5.0), (-2.0, 2.0)].map(DVec2::from).to_vec();
        Nurbs::new(space, points, weights).unwrap()
    }

    fn assert_near(found: &[f64], expected: DVec2, what: &str) {
        let distance = (found[0] - expected.x).hypot(found[1] - expected.y);
        assert!(distance < 1e-12 * (1.0 + expected.length()), "{what}: {found:?} instead of {expected}");
    }

    #[test]
    fn the_table_holds_the_numbers_of_the_worked_example() {
        let stepper = de_boor_stepper(&graph(None), 5.0).unwrap();
        let heights: Vec<Vec<f64>> = stepper
            .levels()
            .iter()
            .map(|level| level.iter().map(|entry| entry.coordinates[1]).collect())
            .collect();
        let expected = [vec![1.0, -5.0, 4.0, 4.0], vec![-4.0, 1.0, 4.0], vec![0.0, 2.0], vec![1.0]];
        for (found, expected) in heights.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-14, "{heights:?}");
        }
        assert_eq!(stepper.entry(2, 1).map(|entry| entry.label.as_str()), Some("p_4^2"), "name");
        assert_eq!(stepper.steps_needed(), 3, "inside an interval all steps are needed");
        assert_near(stepper.tangent(), DVec2::new(1.0, 3.0), "slope 3 of the graph");
    }

    #[test]
    fn a_step_shows_its_knots_as_a_fraction() {
        let stepper = de_boor_stepper(&graph(None), 5.0).unwrap();
        let formula = &stepper.frames()[2].formula;
        let expected = "p_3^1 = \\frac{5-1}{7-1} \\, c_3 + \\frac{7-5}{7-1} \\, c_2 = ";
        assert!(formula.starts_with(expected), "{formula}");
    }

    #[test]
    fn every_entry_appears_once_and_one_by_one_inside_an_interval() {
        let stepper = de_boor_stepper(&graph(None), 5.0).unwrap();
        let frames = stepper.frames();
        assert_eq!(frames.len(), 1 + 6 + 1, "coefficients, six new entries, point and tangent");
        let mut seen = stepper.revealed(frames.len());
        let count = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!((seen.len(), count), (10, 10), "the triangle has ten entries");
    }

    #[test]
    fn parents_are_visible_before_their_entry() {
        for (curve, t) in
            [(graph(None), 5.0), (graph(None), 4.0), (graph(None), 8.0), (closed(4, vec![1.0; 5]), 2.5)]
        {
            let stepper = de_boor_stepper(&curve, t).unwrap();
            for (index, frame) in stepper.frames().iter().enumerate() {
                let visible = stepper.revealed(index);
                for tie in &frame.highlights {
                    assert!(visible.contains(tie), "t = {t}, frame {index} speaks of hidden {tie:?}");
                }
            }
            let all = stepper.revealed(stepper.frames().len());
            assert_eq!(all.len(), stepper.table().count(), "t = {t}: in the end everything is visible");
        }
    }

    #[test]
    fn a_simple_knot_saves_one_step() {
        let stepper = de_boor_stepper(&graph(None), 4.0).unwrap();
        assert_eq!(stepper.steps_needed(), 2, "degree 3, multiplicity 1");
        assert_eq!(stepper.apex().label, "p_3^2", "p(x) = p_{{l-mu}}^{{n-mu}} with l = 4");
        assert!((stepper.apex().coordinates[1] + 1.5).abs() < 1e-14, "{:?}", stepper.apex());
        assert_eq!(stepper.note(), Some("t = 4 is a simple knot: 2 steps instead of 3 suffice."), "note");
        let needed: Vec<&str> = stepper.levels()[0]
            .iter()
            .filter(|entry| entry.needed)
            .map(|entry| entry.label.as_str())
            .collect();
        assert_eq!(needed, ["c_1", "c_2", "c_3"], "example 4.5-b");
    }

    #[test]
    fn a_triple_end_knot_needs_no_step() {
        let stepper = de_boor_stepper(&graph(None), 8.0).unwrap();
        assert_eq!((stepper.steps_needed(), stepper.apex().label.as_str()), (0, "c_6"), "right end");
        assert_eq!(stepper.apex().coordinates[1], 9.0, "the last coefficient");
    }

    #[test]
    fn apex_and_tangent_agree_with_the_curve() {
        let weighted = graph(Some(vec![1.0, 2.0, 0.5, 3.0, 1.0, 1.5, 1.0]));
        let mut curves = vec![graph(None), weighted];
        curves.extend((1..=7).map(|degree| closed(degree, vec![1.0, 3.0, 1.0, 0.25, 2.0])));
        for curve in &curves {
            let (left, right) = curve.space().parameter_interval();
            for step in 0..=40 {
                let t = left + (right - left) * f64::from(step) / 40.0;
                let stepper = de_boor_stepper(curve, t).unwrap();
                let side = if step == 40 { Side::Left } else { Side::Right };
                let expected = curve.derivatives(t, 1, side).unwrap();
                assert_near(&stepper.apex().coordinates, expected[0], &format!("point at {t}"));
                assert_near(stepper.tangent(), expected[1], &format!("tangent at {t}"));
            }
        }
    }

    #[test]
    fn closed_curves_name_control_points_by_their_own_index() {
        let stepper = de_boor_stepper(&closed(3, vec![1.0; 5]), 0.5).unwrap();
        let names: Vec<usize> = stepper.levels()[0].iter().map(|entry| entry.index).collect();
        assert_eq!(names, [2, 3, 4, 0], "the window wraps around");
    }

    #[test]
    fn rational_entries_show_their_weights() {
        let stepper = de_boor_stepper(&graph(Some(vec![1.0, 2.0, 0.5, 3.0, 1.0, 1.5, 1.0])), 5.0).unwrap();
        let entry = stepper.entry(1, 0).unwrap();
        // w = (1 - 5/6)*2 + 5/6*0.5
        assert!((entry.weight.unwrap() - 0.75).abs() < 1e-15, "{entry:?}");
        assert_eq!(entry.texts.len(), 2, "point and weight");
        assert!(
            stepper.frames()[1].formula.starts_with("w_2^1 \\, p_2^1 = \\frac{5-0}{6-0} \\, w_2 \\, c_2"),
            "homogeneous"
        );
    }

    #[test]
    fn de_casteljau_names_entries_after_the_left_parent() {
        let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)].map(DVec2::from);
        let stepper = de_casteljau_stepper(&points, 0.5).unwrap();
        assert_eq!(stepper.apex().label, "p_0^3", "apex");
        assert_near(&stepper.apex().coordinates, DVec2::new(2.0, 1.5), "point");
        assert_near(stepper.tangent(), DVec2::new(4.5, 0.0), "tangent");
        assert_eq!(de_casteljau_stepper(&points, 0.0).unwrap().steps_needed(), 0, "t = 0 is c_0");
    }

    #[test]
    fn bad_input_is_an_error() {
        assert_eq!(de_boor_stepper(&graph(None), 9.0).unwrap_err().name(), "OutsideInterval", "beyond D");
        assert_eq!(de_boor_stepper(&graph(None), f64::NAN).unwrap_err().name(), "NonFinite", "NaN");
        assert_eq!(de_casteljau_stepper(&[], 0.5).unwrap_err().name(), "Empty", "no points");
        assert_eq!(de_casteljau_stepper(&[DVec2::ZERO], 0.5).unwrap_err().name(), "DegreeZero", "one point");
    }

    #[test]
    fn numbers_are_told_as_well_as_points() {
        let space = SplineSpace::new(3, KNOTS.to_vec()).unwrap();
        let spline = crate::core::bspline::Spline::new(space, COEFFICIENTS.to_vec()).unwrap();
        let scheme = spline.de_boor_scheme(5.0).unwrap();
        let context = SchemeContext {
            algorithm: Algorithm::DeBoor { knots: &KNOTS, span: scheme.span },
            parameter: 5.0,
            coefficients: &scheme.coefficients,
            weights: None,
        };
        let stepper = Stepper::new(&scheme.triangle, &context).unwrap();
        assert_eq!(stepper.entry(2, 1).map(|entry| entry.texts.clone()), Some(vec!["2".to_owned()]), "p_4^2");
        assert!(stepper.frames()[5].formula.ends_with("= 2"), "{}", stepper.frames()[5].formula);
    }

    #[test]
    fn every_formula_can_be_typeset() {
        let tiny = {
            let knots = vec![-1e-9, 0.0, 0.0, 2e-9, 1e12, 1e12, 2e12];
            let space = SplineSpace::new(2, knots).unwrap();
            let points = [(-1.0, 1e-12), (3.0, -4e20), (5.0, 6.0), (-0.5, 0.0)].map(DVec2::from).to_vec();
            Nurbs::new(space, points, vec![1.0, 1e-8, 3.0, 2.0]).unwrap()
        };
        let weighted = graph(Some(vec![1.0, 2.0, 0.5, 3.0, 1.0, 1.5, 1.0]));
        for (curve, t) in [
            (&graph(None), 5.0),
            (&weighted, 4.0),
            (&weighted, 8.0),
            (&tiny, 1e-9),
            (&closed(12, vec![1.0; 5]), 0.5),
        ] {
            let stepper = de_boor_stepper(curve, t).unwrap();
            let labels = stepper.table().map(|entry| &entry.label);
            for source in stepper.frames().iter().map(|frame| &frame.formula).chain(labels) {
                if let Err(error) = crate::figure::formula::layout(source, 12.0) {
                    panic!("t = {t}: {source}: {error}");
                }
            }
        }
    }
}
