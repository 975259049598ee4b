//! Drawing a new curve, click by click.

use eframe::egui::{Key, Painter, Pos2, Rect, Shape, Stroke, Ui};
use glam::DVec2;

use crate::app::lab::{Lab, Tool};
use crate::app::painter::{color32, screen_from_world};
use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, Edit};
use crate::figure::picture::Viewport;

/// The degree of a drawn curve as soon as it has enough points.
const DEGREE: usize = 3;

/// Pixels within which a click on the first point closes the curve.
const CLOSING_REACH: f32 = 10.0;

/// The control points clicked so far.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    points: Vec<DVec2>,
}

impl Drawing {
    /// A click at `world`; on the first point it closes the curve.
    pub(super) fn click(
        &mut self,
        world: DVec2,
        pointer: Pos2,
        lab: &mut Lab,
        viewport: &Viewport,
        rect: Rect,
    ) {
        let on_first = self.points.len() >= 3
            && screen_from_world(viewport, rect, self.points[0]).distance(pointer) <= CLOSING_REACH;
        if on_first {
            self.finish(true, lab);
        } else {
            self.points.push(world);
        }
    }

    /// Enter ends, Backspace drops the last point, Escape gives up; these keys are used up while something is drawn.
    pub(super) fn keys(&mut self, lab: &mut Lab, ui: &Ui) {
        if self.points.is_empty() {
            return;
        }
        let pressed = |key: Key| ui.input_mut(|input| input.consume_key(eframe::egui::Modifiers::NONE, key));
        if pressed(Key::Enter) {
            self.finish(false, lab);
        } else if pressed(Key::Backspace) {
            self.points.pop();
        } else if pressed(Key::Escape) {
            self.points.clear();
        }
    }

    /// Makes the curve; with fewer than two points there is none yet, and drawing goes on.
    pub(super) fn finish(&mut self, closed: bool, lab: &mut Lab) {
        // A double click leaves the same point twice.
        self.points.dedup_by(|a, b| a.distance(*b) <= 1e-12 * (1.0 + b.length()));
        if self.points.len() < 2 {
            return;
        }
        let name = next_name(lab);
        let color = lab.history.document().len();
        match drawn_curve(&self.points, closed) {
            Ok(curve) => {
                let display = CurveDisplay { color, ..CurveDisplay::default() };
                if let Some(outcome) = lab.edit(Edit::AddCurve { name, curve, display }) {
                    lab.selection.object = outcome.created.first().copied();
                    lab.selection.points.clear();
                    lab.tool = Tool::Select;
                    self.points.clear();
                }
            }
            Err(error) => lab.problem(error.to_string()),
        }
    }

    /// The polygon so far, the curve it would make, and the line to the pointer.
    pub(super) fn paint(
        &self,
        pointer: Option<Pos2>,
        lab: &Lab,
        viewport: &Viewport,
        rect: Rect,
        painter: &Painter,
    ) {
        let ink = color32(lab.theme.accent);
        let mut corners: Vec<Pos2> =
            self.points.iter().map(|&at| screen_from_world(viewport, rect, at)).collect();
        let mut places = self.points.clone();
        if let Some(pointer) = pointer {
            corners.push(pointer);
            places.push(crate::app::painter::world_from_screen(viewport, rect, pointer));
        }
        if places.len() >= 2
            && let Ok(curve) = drawn_curve(&places, false)
        {
            let (left, right) = curve.space().parameter_interval();
            let steps = 40 * places.len();
            let line = (0..=steps).filter_map(|step| {
                let parameter = left + (right - left) * step as f64 / steps as f64;
                curve.evaluate(parameter).ok().map(|at| screen_from_world(viewport, rect, at))
            });
            painter.add(Shape::line(line.collect(), Stroke::new(2.5, ink)));
        }
        painter.add(Shape::line(corners.clone(), Stroke::new(1.0, color32(lab.theme.muted_text))));
        for (index, &corner) in corners.iter().enumerate().take(self.points.len()) {
            let radius = if index == 0 { 6.0 } else { 4.5 };
            painter.circle(corner, radius, color32(lab.theme.background), Stroke::new(2.0, ink));
        }
    }
}

/// The curve with these control points: cubic, or of the highest degree they allow; ends interpolated, or closed.
pub(super) fn drawn_curve(
    points: &[DVec2],
    closed: bool,
) -> Result<Nurbs<DVec2>, crate::core::bspline::SplineError> {
    let count = points.len();
    let degree = DEGREE.min(count.saturating_sub(1)).max(1);
    let space = if closed {
        SplineSpace::periodic(degree, count as f64, (0..count).map(|k| k as f64).collect())?
    } else {
        let intervals = count - degree;
        let inner = (1..intervals).map(|k| k as f64);
        let end = intervals as f64;
        let mut knots = vec![-1.0];
        knots.extend(std::iter::repeat_n(0.0, degree));
        knots.extend(inner);
        knots.extend(std::iter::repeat_n(end, degree));
        knots.push(end + 1.0);
        SplineSpace::new(degree, knots)?
    };
    Nurbs::polynomial(space, points.to_vec())
}

fn next_name(lab: &Lab) -> String {
    let taken = |name: &str| lab.history.document().objects().iter().any(|object| object.name == name);
    (1..)
        .map(|number| format!("Curve {number}"))
        .find(|name| !taken(name))
        .unwrap_or_else(|| "Curve".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_curve_starts_and_ends_at_its_first_and_last_point() {
        for count in 2..9 {
            let points: Vec<DVec2> =
                (0..count).map(|k| DVec2::new(f64::from(k), f64::from(k * k % 5))).collect();
            let curve = drawn_curve(&points, false).unwrap();
            let (left, right) = curve.space().parameter_interval();
            assert_eq!(curve.evaluate(left).unwrap(), points[0], "{count} points: start");
            assert!(
                curve.evaluate(right).unwrap().distance(points[points.len() - 1]) < 1e-14,
                "{count} points: end"
            );
        }
    }

    #[test]
    fn three_points_make_a_closed_curve() {
        let points = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
        let curve = drawn_curve(&points, true).unwrap();
        assert!(curve.space().is_periodic(), "closed");
        assert_eq!(curve.evaluate(0.0).unwrap(), curve.evaluate(3.0).unwrap(), "one period later");
    }
}
