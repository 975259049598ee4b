//! De Boor's algorithm: the active control points are mixed until one point is left.
//!
//! `pⁱ⁺¹ₖ = γ pⁱₖ + (1 − γ) pⁱₖ₋₁` with `γ = (t − ξₖ)/(ξₖ₊ₙ₋ᵢ − ξₖ)`; at a knot of multiplicity `μ` the point is reached after `n − μ`
//! steps. Course: sections 4.5, 4.6 and 6.1.

use glam::{DVec2, DVec3};

use crate::core::bspline::{DeBoorScheme, SplineError};
use crate::core::spline_curve::Nurbs;
use crate::course::number_text::{formula_number, formula_point, short_number, short_point};
use crate::course::stepper::narration::{
    Name, Shares, counted, difference, multiplicity_word, place_in_interval, range_of,
};
use crate::course::stepper::teller::{Net, Teller, extent};
use crate::course::stepper::{Entry, Stepper, StepperKind, Tie};

/// De Boor's algorithm for `curve` at `t`, told step by step.
///
/// A rational curve is evaluated in homogeneous coordinates; the table shows the projected points and their weights.
/// For a closed curve `t` is reduced into one period.
///
/// # Errors
///
/// `NonFinite`, `OutsideInterval`.
pub fn de_boor_stepper(curve: &Nurbs<DVec2>, t: f64) -> Result<Stepper, SplineError> {
    let net = Net::of(curve)?;
    let scheme = net.spline.de_boor_scheme(t)?;
    let (n, knots, span, t) =
        (curve.degree(), curve.space().evaluation_knots(), scheme.span, scheme.parameter);
    let shortcut = Shortcut::find(n, &knots[..=span], &knots[span + 1..], t);
    let mut teller = Teller { note: shortcut.note(t), ..Teller::default() };
    teller.row(net.active(span, n + 1));
    teller.scheme(&scheme.triangle, net.rational, |level, position| {
        Name::of_level(scheme.coefficients[level + position], level)
    });
    for entry in teller.levels.iter_mut().flatten() {
        entry.needed = shortcut.needs(entry.level, entry.position);
    }
    open(&mut teller, t, (knots[span], knots[span + 1]));
    for level in 1..=n {
        for position in 0..=n - level {
            if shortcut.needs(level, position) {
                let low = span - n + level + position;
                let shares = Shares::Fraction { at: t, low: knots[low], high: knots[low + n + 1 - level] };
                teller.tell_mixture((level, position), &shares);
            }
        }
    }
    if shortcut.multiplicity > 0 {
        rest(&mut teller, &shortcut);
    }
    close(&mut teller, &net, &scheme, &shortcut);
    Ok(teller.end(StepperKind::DeBoor, t, shortcut.apex))
}

/// Frame 0: the coefficients that the point depends on.
fn open(teller: &mut Teller, t: f64, (left, right): (f64, f64)) {
    let needed: Vec<Entry> = teller.levels[0].iter().filter(|entry| entry.needed).cloned().collect();
    let named = match &needed[..] {
        [only] => format!("The point depends on {} alone.", only.plain_label),
        several => format!(
            "The point depends on {}, {}.",
            counted(several.len(), "control point"),
            range_of(several)
        ),
    };
    let (place, formula) = place_in_interval(t, left, right);
    let note = teller.note.as_ref().map(|note| format!(" {note}")).unwrap_or_default();
    let ties: Vec<Tie> = needed.iter().map(Entry::tie).collect();
    teller.tell(format!("{place} {named}{note}"), formula, ties.clone(), ties);
}

/// At a knot: the entries on which the point does not depend, all at once.
fn rest(teller: &mut Teller, shortcut: &Shortcut) {
    let apex = teller.levels[shortcut.apex.0][shortcut.apex.1].clone();
    let last = teller.levels.len() - 1;
    let others = teller.levels[..last].iter().flatten().filter(|entry| !entry.needed);
    let reveals = others.map(Entry::tie).collect();
    let caption = format!(
        "The point of the curve is reached: {} = {}. The other entries serve the tangent only.",
        apex.plain_label,
        short_point(&apex.coordinates)
    );
    let formula = format!("p = {} = {}", apex.label, formula_point(&apex.coordinates));
    teller.tell(caption, formula, reveals, vec![apex.tie()]);
}

/// The last frame: the point and its tangent through the last two points.
fn close(teller: &mut Teller, net: &Net, scheme: &DeBoorScheme<DVec3>, shortcut: &Shortcut) {
    let knots = net.spline.space().evaluation_knots();
    let (from, to) = (knots[scheme.span], knots[scheme.span + 1]);
    let side = match (shortcut.multiplicity >= shortcut.degree, shortcut.at_right_end) {
        (true, false) => " on the right of the knot",
        (true, true) => " on the left of the knot",
        _ => "",
    };
    close_with_tangent(teller, net, (from, to), side);
    if shortcut.multiplicity > 0
        && let Some(frame) = teller.frames.last_mut()
    {
        frame.reveals.push((shortcut.degree, 0));
    }
}

/// Point and tangent `n (pⁿ⁻¹ᵣ − pⁿ⁻¹ₗ)/(to − from)`, times `wₗ wᵣ/w²` for rational schemes, from the last two rows.
pub(super) fn close_with_tangent(teller: &mut Teller, net: &Net, (from, to): (f64, f64), side: &str) {
    let degree = teller.levels.len() - 1;
    let ([left, right, ..], [top, ..]) = (&teller.levels[degree - 1][..], &teller.levels[degree][..]) else {
        return;
    };
    let (left, right, top) = (left.clone(), right.clone(), top.clone());
    let caption = format!(
        "The point is {}. The last two points, {} and {}, span the tangent{side}.",
        short_point(&top.coordinates),
        left.plain_label,
        right.plain_label
    );
    let (mut factor, mut weights) = (degree as f64 / (to - from), String::new());
    if let (Some(left), Some(right), Some(top)) = (left.weight, right.weight, top.weight) {
        factor *= (left / top) * (right / top);
        let [left, right, top] = [left, right, top].map(formula_number);
        weights = format!("\\frac{{{left} \\cdot {right}}}{{{top}^2}} ");
    }
    let place = |entry: &Entry| DVec2::new(entry.coordinates[0], entry.coordinates[1]);
    let tangent = (place(&right) - place(&left)) * factor;
    let formula = format!(
        "p' = {degree} {weights}\\frac{{{} - {}}}{{{}}} = {}",
        right.label,
        left.label,
        difference(to, from),
        formula_point(&tangent.to_array())
    );
    teller.tell(caption, formula, Vec::new(), vec![left.tie(), right.tie(), top.tie()]);
    let reach = 0.25 * extent(&net.polygon(&net.spline));
    teller.draw_tangent(place(&top), tangent, reach);
    teller.tangent = Some(tangent);
}

/// Which entries the point depends on: at a knot of multiplicity `μ` the scheme ends after `n − μ` steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shortcut {
    degree: usize,
    /// `μ`; 0 inside a knot interval.
    multiplicity: usize,
    /// Whether the parameter is the right end of its interval.
    at_right_end: bool,
    apex: Tie,
}

impl Shortcut {
    /// With the knots up to the left end of the interval, and those from its right end on.
    fn find(degree: usize, before: &[f64], behind: &[f64], t: f64) -> Self {
        let same = |knot: &&f64| **knot == t;
        let left = before.iter().rev().take_while(same).count();
        let right = behind.iter().take_while(same).count();
        let multiplicity = left.max(right).min(degree);
        let at_right_end = right > 0;
        let apex = (degree - multiplicity, if at_right_end { multiplicity } else { 0 });
        Self { degree, multiplicity, at_right_end, apex }
    }

    fn needs(&self, level: usize, position: usize) -> bool {
        let (last, first) = self.apex;
        level <= last && position >= first && position <= first + last - level
    }

    fn note(&self, t: f64) -> Option<String> {
        if self.multiplicity == 0 {
            return None;
        }
        let suffice = match self.apex.0 {
            0 => "no step is needed".to_owned(),
            1 => format!("1 step instead of {} suffices", self.degree),
            several => format!("{several} steps instead of {} suffice", self.degree),
        };
        Some(format!("t = {} is {} knot: {suffice}.", short_number(t), multiplicity_word(self.multiplicity)))
    }
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
        assert_near(&stepper.tangent().unwrap().to_array(), DVec2::new(1.0, 3.0), "slope 3 of the graph");
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
                assert_near(&stepper.tangent().unwrap().to_array(), expected[1], &format!("tangent at {t}"));
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
        assert_eq!((entry.lines.len(), entry.lines[2].as_str()), (3, "w 0.75"), "point and weight");
        assert!(
            stepper.frames()[1].formula.starts_with("w_2^1 \\, p_2^1 = \\frac{5-0}{6-0} \\, w_2 \\, c_2"),
            "homogeneous"
        );
    }

    #[test]
    fn bad_input_is_an_error() {
        assert_eq!(de_boor_stepper(&graph(None), 9.0).unwrap_err().name(), "OutsideInterval", "beyond D");
        assert_eq!(de_boor_stepper(&graph(None), f64::NAN).unwrap_err().name(), "NonFinite", "NaN");
    }
}
