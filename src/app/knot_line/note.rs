//! What is said about a knot beside the pointer: where it stands, what its move does, and why it does not follow.

use eframe::egui::{Area, Color32, Frame, Id, LayerId, Order, Pos2, RichText, Shape, Stroke, Ui, vec2};

use crate::app::knot_line::Scene;
use crate::app::knot_line::hand::{Stack, continuity, is_inside};
use crate::app::lab::Lab;
use crate::app::number_text::{compact, short};
use crate::app::painter::color32;
use crate::core::bspline::SplineError;
use crate::document::{EditError, ObjectId, ShapeChange};

/// Place, effect and refusal of a drag, beside the pointer.
pub(super) fn show(
    lab: &Lab,
    ui: &Ui,
    object: ObjectId,
    knot: f64,
    effect: Option<String>,
    refusal: Option<String>,
) {
    let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) else { return };
    let curve = lab.history.document().curve(object);
    let copies = curve.map_or(1, |curve| curve.space().multiplicity(knot));
    let mut first = format!("knot {}", short(knot));
    if copies > 1 {
        first = format!("{first}, {copies} copies");
    }
    if let Some(curve) = curve.filter(|curve| is_inside(curve.space(), knot)) {
        first = format!("{first} \u{b7} {}", continuity(curve.degree(), copies));
    }
    let lines = [
        (first, color32(lab.theme.text)),
        (effect.unwrap_or_default(), color32(lab.theme.muted_text)),
        (refusal.unwrap_or_default(), color32(lab.theme.error)),
    ];
    beside_pointer(ui, pointer, &lines, 12.0 * lab.theme.text_scale as f32);
}

/// A small note above and right of the pointer; nothing can be clicked on it.
fn beside_pointer(ui: &Ui, pointer: Pos2, lines: &[(String, Color32)], size: f32) {
    Area::new(Id::unique("note on a knot"))
        .order(Order::Tooltip)
        .interactable(false)
        .constrain(true)
        .pivot(eframe::egui::Align2::LEFT_BOTTOM)
        .fixed_pos(pointer + vec2(14.0, -12.0))
        .show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 2.0;
                for (text, color) in lines.iter().filter(|(text, _)| !text.is_empty()) {
                    let text = RichText::new(text).color(*color).size(size);
                    ui.add(eframe::egui::Label::new(text).extend());
                }
            });
        });
}

/// From the knot that does not follow to the pointer.
pub(super) fn leash(lab: &Lab, ui: &Ui, knot: Pos2) {
    let Some(pointer) = ui.input(|input| input.pointer.latest_pos()) else { return };
    let pen = Stroke::new(1.4 * lab.theme.stroke_scale as f32, color32(lab.theme.error));
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Foreground, Id::unique("leash of a knot")));
    painter.extend(Shape::dashed_line(&[knot, pointer], pen, 4.0, 3.0));
    painter.circle_stroke(pointer, 4.0, pen);
}

/// What a moved knot does to the curve, in a few words.
pub(super) fn effect(shape: &ShapeChange, keep_curve: bool) -> Option<String> {
    let ShapeChange::Changed { deviation, .. } = shape else { return None };
    Some(match (deviation, keep_curve) {
        (Some(deviation), true) => format!("curve kept within {} (certified)", compact(*deviation)),
        (Some(deviation), false) => {
            format!("control points kept, curve moves by up to {}", compact(*deviation))
        }
        (None, true) => "curve nearly kept".to_owned(),
        (None, false) => "control points kept, curve moves".to_owned(),
    })
}

/// Why knots do not go somewhere, as people say it.
pub(super) fn reason(error: &EditError) -> String {
    match error {
        EditError::Spline(SplineError::KnotMultiplicityTooHigh { value, multiplicity, degree, .. }) => {
            format!(
                "{} is full: with {multiplicity} copies a curve of degree {degree} would fall apart",
                short(*value)
            )
        }
        EditError::Spline(SplineError::KnotsNotRegular { side: Some(_), value, .. }) => {
            format!("No room: the curve would have an empty interval at its end {}", short(*value))
        }
        EditError::Spline(SplineError::PeriodTooShort { .. }) => {
            "The first and the last knot of a period stay apart".to_owned()
        }
        EditError::KnotBlocked { low, high, .. } => {
            format!("A whole stack stays strictly between {} and {}", short(*low), short(*high))
        }
        EditError::IntervalChanged { left, right, .. } => format!(
            "Keeping the curve keeps its interval [{}, {}]: choose \u{201c}Keep points\u{201d} to move an end",
            short(*left),
            short(*right)
        ),
        EditError::Spline(SplineError::WeightNotPositive { .. }) => {
            "No positive weights keep the curve there".to_owned()
        }
        other => other.to_string(),
    }
}

/// What can be done with a knot, for a tooltip.
pub(super) fn hint(scene: &Scene, stack: &Stack) -> String {
    let (value, multiplicity) = (short(stack.value), stack.multiplicity);
    let mut what = format!("Knot {value}, multiplicity {multiplicity}");
    if is_inside(scene.curve.space(), stack.value) {
        let order = continuity(scene.curve.degree(), multiplicity);
        what = format!("{what}: the curve is {order} here");
    }
    format!(
        "{what}\nDrag: move one copy; Shift: the whole stack; Alt: without snapping\nDelete: remove one copy"
    )
}
