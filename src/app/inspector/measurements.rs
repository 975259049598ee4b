//! Point, tangent, speed, curvature and radius at the parameter; a click copies the number.

use eframe::egui::{Button, Grid, RichText, Ui};
use glam::DVec2;

use crate::app::inspector::Subject;
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::number_text::{full, short};
use crate::core::bspline::Side;
use crate::core::spline_curve::Nurbs;

/// One line: a name, numbers or the reason why there are none, a unit of explanation.
struct Line {
    name: &'static str,
    hint: &'static str,
    numbers: Result<Vec<f64>, &'static str>,
}

/// Shows the measurements.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let object = subject.object;
    let Some(t) = lab.parameter(object) else { return };
    let (left, right) = subject.curve.space().parameter_interval();
    Grid::new("measurements").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        ui.label("Parameter");
        let field = NumberField::new("Parameter of the measurements", t).width(80.0);
        let field = field.drag(Drag::PerPixel((right - left) / 500.0)).show(ui, "measured parameter");
        if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = field.event {
            lab.set_parameter(object, to);
        }
        ui.end_row();
        for line in lines(subject.curve, t) {
            ui.label(line.name).on_hover_text(line.hint);
            match line.numbers {
                Ok(numbers) => copyable(lab, ui, line.name, &numbers),
                Err(reason) => {
                    ui.label(RichText::new(reason).weak());
                }
            }
            ui.end_row();
        }
    });
}

/// Numbers that a click copies with all their digits.
pub(crate) fn copyable(lab: &mut Lab, ui: &mut Ui, name: &str, numbers: &[f64]) {
    let join =
        |write: fn(f64) -> String| numbers.iter().map(|&number| write(number)).collect::<Vec<_>>().join(", ");
    let response =
        ui.add(Button::new(join(short)).frame(false)).on_hover_text(format!("{}\nClick to copy", join(full)));
    if response.clicked() {
        ui.ctx().copy_text(join(full));
        lab.done(format!("{name} copied"));
    }
}

/// The quantities at `t`, from the right at a knot (from the left at the right end of an open curve).
fn lines(curve: &Nurbs<DVec2>, t: f64) -> Vec<Line> {
    let Ok(derivatives) = curve.derivatives(t, 2, Side::Right) else { return Vec::new() };
    let (point, first, second) = (derivatives[0], derivatives[1], derivatives[2]);
    let speed = first.length();
    let undefined = "undefined where the speed is 0";
    let tangent = first.try_normalize().map(|tangent| vec![tangent.x, tangent.y]).ok_or(undefined);
    let curvature = first.perp_dot(second) / speed.powi(3);
    let curvature = if curvature.is_finite() { Ok(curvature) } else { Err(undefined) };
    let radius = curvature.and_then(|curvature| {
        let radius = 1.0 / curvature.abs();
        if radius.is_finite() { Ok(vec![radius]) } else { Err("none: the curvature is 0") }
    });
    vec![
        Line { name: "Point", hint: "r(t)", numbers: Ok(vec![point.x, point.y]) },
        Line { name: "Tangent", hint: "r\u{2032}/|r\u{2032}|, from the right at a knot", numbers: tangent },
        Line { name: "Speed", hint: "|r\u{2032}(t)|", numbers: Ok(vec![speed]) },
        Line {
            name: "Curvature",
            hint: "Positive where the curve turns left",
            numbers: curvature.map(|value| vec![value]),
        },
        Line { name: "Radius", hint: "Radius of the circle of curvature", numbers: radius },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    #[test]
    fn a_quarter_circle_has_curvature_one() {
        let space = SplineSpace::new(2, vec![-1.0, 0.0, 0.0, 1.0, 1.0, 2.0]).unwrap();
        let points = vec![DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0), DVec2::new(0.0, 1.0)];
        let curve = Nurbs::new(space, points, vec![1.0, 0.5_f64.sqrt(), 1.0]).unwrap();
        for t in [0.0, 0.3, 1.0] {
            let lines = lines(&curve, t);
            let curvature = lines[3].numbers.clone().unwrap()[0];
            assert!((curvature - 1.0).abs() < 1e-12, "curvature {curvature} at {t}");
        }
    }
}
