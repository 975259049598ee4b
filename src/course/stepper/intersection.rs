//! Where the curve meets a line: bisection of the Bezier pieces, guided by the changes of side of their polygons.
//!
//! A polygon that stays on one side has no point of the curve on the other; every halving inserts a knot, which cannot raise the
//! number `V` of changes. One meeting is followed, that next to the parameter. Course: section 6.3.

use glam::{DVec2, DVec3};

use crate::core::bspline::SplineError;
use crate::core::point::Point as _;
use crate::core::spline_curve::{Hyperplane, HyperplaneIntersection, Nurbs};
use crate::core::triangular_scheme::collapse_both;
use crate::course::number_text::{formula_number, formula_operand, short_number, short_point};
use crate::course::stepper::narration::{Name, counted, sentence};
use crate::course::stepper::teller::{Net, Teller, extent};
use crate::course::stepper::{Entry, Look, Stepper, StepperKind};
use crate::document::StepperLine;
use crate::figure::composition::{StepDrawing, StepInk};

/// So many halvings are shown.
const HALVINGS: usize = 9;
/// Tolerance of the exact meetings, as a part of the extent of the curve.
const TOLERANCE: f64 = 1e-9;

/// The horizontal line through the middle of the control points.
pub fn default_line(curve: &Nurbs<DVec2>) -> StepperLine {
    let points = curve.points();
    let sum: DVec2 = points.iter().copied().sum();
    StepperLine { through: sum / points.len().max(1) as f64, angle: 0.0 }
}

/// A part of the curve in Bezier form.
#[derive(Clone)]
struct Part {
    interval: (f64, f64),
    points: Vec<DVec3>,
}

impl Part {
    fn halves(&self) -> (Self, Self) {
        let (mut right, mut left) = (self.points.clone(), self.points.clone());
        collapse_both(&mut right, 0.5, &mut left);
        let (a, b) = self.interval;
        let middle = a.mix(b, 0.5);
        (Self { interval: (a, middle), points: left }, Self { interval: (middle, b), points: right })
    }

    /// Changes of side, points on the line skipped.
    fn changes(&self, line: &Hyperplane<DVec2>) -> usize {
        let sides = self.points.iter().map(|&point| side(line, point)).filter(|&side| side != 0.0);
        let signs: Vec<bool> = sides.map(|side| side > 0.0).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// How far the parameter is from the interval.
    fn distance(&self, t: f64) -> f64 {
        (self.interval.0 - t).max(t - self.interval.1).max(0.0)
    }
}

/// Distances with three digits: their sign matters, and cells are narrow.
fn rough(distance: f64) -> f64 {
    format!("{distance:.2e}").parse().unwrap_or(distance)
}

/// The signed distance times the weight.
fn side(line: &Hyperplane<DVec2>, point: DVec3) -> f64 {
    line.normal().dot(point.truncate()) - line.offset() * point.z
}

pub(super) fn story(curve: &Nurbs<DVec2>, t: f64, chosen: Option<StepperLine>) -> Result<Stepper, String> {
    let told = |error: SplineError| sentence(&error);
    let net = Net::of(curve).map_err(told)?;
    let t = curve.space().reduce(t).map_err(told)?;
    let chosen = chosen.unwrap_or_else(|| default_line(curve));
    let direction = chosen.direction();
    let line = Hyperplane::new(direction.perp(), direction.perp().dot(chosen.through)).map_err(told)?;
    let size = extent(curve.points()).max(f64::MIN_POSITIVE);
    let meetings = curve.intersect_hyperplane(&line, TOLERANCE * size).map_err(told)?;
    let look = Look { joined: false, ..Look::default() };
    let mut teller = Teller { look, ..Teller::default() };
    let control = |k: usize| {
        let entry = net.control_point(k);
        let away = side(&line, net.spline.coefficients()[k]) / entry.weight.unwrap_or(1.0);
        Entry { lines: vec![format!("d {}", short_number(rough(away)))], ..entry }
    };
    let ties = teller.row((0..curve.points().len()).map(control).collect());
    let mut polygon: Vec<DVec3> = net.spline.coefficients().to_vec();
    if curve.space().is_periodic() {
        polygon.extend(polygon.first().copied());
    }
    let changes = Part { interval: (t, t), points: polygon }.changes(&line);
    let caption = format!(
        "The control polygon changes its side of the line {}, so the curve meets the line at most as often.",
        times(changes)
    );
    let formula = format!("V = {changes}");
    teller.tell(caption, formula, ties.clone(), ties);
    let parts = net.spline.bezier_pieces();
    let parts = parts.iter().map(|(interval, points)| Part { interval, points: points.to_vec() });
    let candidates = parts.filter(|part| part.changes(&line) > 0);
    let nearest = candidates.min_by(|a, b| a.distance(t).total_cmp(&b.distance(t)));
    match nearest {
        Some(part) => follow(&mut teller, &net, (curve, t), part, &line, &meetings)?,
        None => conclude(&mut teller, &meetings, None),
    }
    let reach = 1.5 * size + (chosen.through - curve.points()[0]).length();
    let ends = vec![chosen.through - direction * reach, chosen.through + direction * reach];
    for frame in &mut teller.frames {
        let mut drawing = StepDrawing::default().dashed(ends.clone(), StepInk::Line, 1.8);
        drawing.append(&frame.drawing);
        frame.drawing = drawing;
    }
    let last = teller.levels.len() - 1;
    Ok(teller.end(StepperKind::Intersection, t, (last, 0)))
}

fn times(count: usize) -> String {
    match count {
        0 => "never".to_owned(),
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        more => format!("{more} times"),
    }
}

/// Halves `part` again and again, and ends with the meeting in it.
fn follow(
    teller: &mut Teller,
    net: &Net,
    (curve, t): (&Nurbs<DVec2>, f64),
    mut part: Part,
    line: &Hyperplane<DVec2>,
    meetings: &[HyperplaneIntersection<DVec2>],
) -> Result<(), String> {
    let places = |part: &Part| -> Vec<DVec2> { part.points.iter().map(|&point| net.place(point)).collect() };
    for step in 1..=HALVINGS {
        let (a, b) = part.interval;
        let middle = a.mix(b, 0.5);
        let changes = part.changes(line);
        let mut entries = Vec::new();
        for (letter, value) in [('a', a), ('m', middle), ('b', b)] {
            let at = curve.evaluate(value).map_err(|error| sentence(&error))?;
            let entry = Entry::numbers(Name::new(letter, step, None), &[value]);
            let lines = vec![short_number(value), format!("d {}", short_number(rough(line.side(at))))];
            entries.push(Entry { at: Some(at), lines, ..entry });
        }
        let middle_side = line.side(entries[1].at.unwrap_or(DVec2::ZERO));
        let ties = teller.row(entries);
        let (first, second) = part.halves();
        let (in_first, in_second) = (first.changes(line), second.changes(line));
        let formula = format!(
            "m_{step} = \\frac{{1}}{{2}} ({} + {}) = {}, \\quad V = {changes} \\to {in_first} + {in_second}",
            formula_number(a),
            formula_operand(b),
            formula_number(middle)
        );
        let ends = (in_first == 0 && in_second == 0) || middle_side == 0.0 || step == HALVINGS;
        let takes_first = match (in_first, in_second) {
            (_, 0) => true,
            (0, _) => false,
            _ => first.distance(t) <= second.distance(t),
        };
        let other = if takes_first { in_second } else { in_first };
        let rest = match (ends, other) {
            (true, _) => "The halving ends here.".to_owned(),
            (false, 0) => {
                format!("Only the {} half changes its side.", if takes_first { "left" } else { "right" })
            }
            (false, _) => format!(
                "Both halves change sides; the {} one is nearer to t.",
                if takes_first { "left" } else { "right" }
            ),
        };
        let how = if step == 1 { ", as if this knot were inserted until it is full" } else { "" };
        let caption = format!(
            "Over [{}, {}] the Bézier polygon changes its side {}. It is halved at {}{how}. {rest}",
            short_number(a),
            short_number(b),
            times(changes),
            short_number(middle)
        );
        teller.tell(caption, formula, ties.clone(), ties);
        let (whole, left, right) = (places(&part), places(&first), places(&second));
        teller.draw(|drawing| {
            let drawing = drawing.line(whole, StepInk::Muted, 2.0);
            drawing.line(left, StepInk::First, 2.4).line(right, StepInk::Second, 2.4)
        });
        if ends {
            break;
        }
        part = if takes_first { first } else { second };
    }
    conclude(teller, meetings, Some(part.interval));
    Ok(())
}

/// The last frame: the meeting in `interval`, found by Newton's method, and all others.
fn conclude(teller: &mut Teller, meetings: &[HyperplaneIntersection<DVec2>], interval: Option<(f64, f64)>) {
    let slack = |(a, b): (f64, f64)| 1e-12 * (b - a).abs().max(a.abs()).max(b.abs());
    let here = interval.and_then(|(a, b)| {
        let margin = slack((a, b));
        meetings.iter().find(|found| (a - margin..=b + margin).contains(&found.parameter))
    });
    let all = match meetings.len() {
        0 => "The curve does not meet the line.".to_owned(),
        1 => "It is the only one.".to_owned(),
        count => format!("Altogether the curve meets the line at {count} places."),
    };
    let (caption, formula) = match here {
        Some(found) => (
            format!(
                "Newton's method, kept inside the interval, ends at t = {} with the point {}. {all}",
                short_number(found.parameter),
                short_point(&found.point.to_array())
            ),
            format!("t = {}", formula_number(found.parameter)),
        ),
        None if meetings.is_empty() => (all, "V = 0".to_owned()),
        None if interval.is_some() => (
            format!(
                "The changes of side have disappeared: here the curve does not meet the line. {}",
                counted(meetings.len(), "meeting") + " remain elsewhere."
            ),
            "V = 0".to_owned(),
        ),
        None => (
            format!("No piece changes its side inside, but an end lies on the line. {all}"),
            "V = 0".to_owned(),
        ),
    };
    let mut entries = Vec::new();
    for (i, found) in meetings.iter().enumerate() {
        let entry = Entry::numbers(Name::new('t', i, None), &[found.parameter]);
        entries.push(Entry { at: Some(found.point), ..entry });
    }
    let ties = if entries.is_empty() { Vec::new() } else { teller.row(entries) };
    teller.tell(caption, formula, ties.clone(), ties);
    if let Some(found) = here {
        let at = found.point;
        teller.draw(|drawing| drawing.dot(at, StepInk::Result, 11.0, None));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::stepper::samples::{all_curves, bezier};

    #[test]
    fn the_last_row_are_the_meetings_and_they_lie_on_the_line() {
        for curve in all_curves() {
            let (left, right) = curve.space().parameter_interval();
            let line = default_line(&curve);
            let stepper = story(&curve, left + 0.4 * (right - left), None).unwrap();
            let last = stepper.levels().last().unwrap();
            for entry in last.iter().filter(|entry| entry.label.starts_with('t')) {
                let at = curve.evaluate(entry.coordinates[0]).unwrap();
                let away = (at - line.through).dot(line.direction().perp());
                assert!(away.abs() < 1e-8, "degree {}: {at} is {away} away", curve.degree());
            }
        }
    }

    #[test]
    fn intervals_are_halved_and_keep_a_change_of_side() {
        let curve = bezier();
        let line = StepperLine { through: DVec2::new(0.0, 1.0), angle: 0.0 };
        let stepper = story(&curve, 0.1, Some(line)).unwrap();
        let rows = &stepper.levels()[1..stepper.levels().len() - 1];
        assert_eq!(rows.len(), HALVINGS, "so many halvings");
        for pair in rows.windows(2) {
            let numbers = |row: &[Entry]| [0, 1, 2].map(|i| row[i].coordinates[0]);
            let ([a, m, b], [c, _, d]) = (numbers(&pair[0]), numbers(&pair[1]));
            assert!((c, d) == (a, m) || (c, d) == (m, b), "a half of [{a}, {b}], not [{c}, {d}]");
        }
        // y = 6t(1 − t) = 1 at t = (3 − √3)/6.
        let expected = (3.0 - 3.0_f64.sqrt()) / 6.0;
        let [a, _, b] = [0, 1, 2].map(|i| rows[HALVINGS - 1][i].coordinates[0]);
        assert!((a..=b).contains(&expected), "{expected} lies in [{a}, {b}]");
        let found = stepper.levels().last().unwrap()[0].coordinates[0];
        assert!((found - expected).abs() < 1e-12, "{found}");
    }

    #[test]
    fn a_line_beside_the_curve_is_not_met() {
        let line = StepperLine { through: DVec2::new(0.0, 5.0), angle: 0.0 };
        let stepper = story(&bezier(), 0.1, Some(line)).unwrap();
        assert_eq!(stepper.frames().len(), 2, "the polygon and the answer");
        assert!(stepper.frames()[1].caption.contains("does not meet"), "{}", stepper.frames()[1].caption);
    }

    #[test]
    fn two_changes_of_side_can_disappear() {
        // y = 6t(1 − t) is at most 1.5, the polygon reaches 2.
        let line = StepperLine { through: DVec2::new(0.0, 1.75), angle: 0.0 };
        let stepper = story(&bezier(), 0.1, Some(line)).unwrap();
        assert!(stepper.frames().last().unwrap().caption.contains("does not meet"), "no meeting");
        assert_eq!(stepper.frames()[0].formula, "V = 2", "of the polygon");
    }
}
