//! The row above the plot: t, what stays when knots move, rules and removal of knots, the builder, and what the space is.

use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{Button, Id, Label, PopupCloseBehavior, RichText, Role, Ui, WidgetInfo};
use glam::DVec2;

use crate::app::chart_panel;
use crate::app::command::Command;
use crate::app::knot_line::{actions, axis, builder};
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::number_text::short;
use crate::core::spline_curve::{KnotRule, Nurbs};
use crate::document::ObjectId;

/// Shows the row; `zoomed` is the axis if only a part of it is seen.
pub(super) fn show(
    lab: &mut Lab,
    ui: &mut Ui,
    object: ObjectId,
    curve: &Nurbs<DVec2>,
    t: f64,
    zoomed: Option<Id>,
) {
    // A narrow window takes a second row rather than controls beyond its edge.
    ui.horizontal_wrapped(|ui| {
        chart_panel::tabs(lab, ui);
        parameter(lab, ui, object, curve, t);
        ui.separator();
        let on = lab.knots.builder.is_some();
        // The builder's row needs the room.
        if !on {
            what_stays(lab, ui);
            // A click on the field of the tolerance must not close the menu.
            let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
            let (button, _) = MenuButton::new("Edit knots").config(stays).ui(ui, |ui| knots_menu(lab, ui));
            button.on_hover_text("Rules for all knots, and removal");
        }
        let toggle = ui
            .selectable_label(on, "Builder")
            .on_hover_text("One B-spline as two of lower degree times linear factors (section 4.1)");
        if toggle.clicked() {
            builder::toggle(lab);
        }
        if lab.knots.builder.is_some() {
            ui.separator();
            builder::controls(lab, ui, curve.points().len(), curve.degree());
        }
        if let Some(id) = zoomed
            && ui.small_button("Show all").on_hover_text("Show the whole parameter interval").clicked()
        {
            axis::reset(ui, id);
        }
        if lab.knots.builder.is_none() && ui.available_width() > 120.0 {
            ui.add(Label::new(RichText::new(description(curve)).weak()).truncate());
        }
    });
}

/// The field of t.
pub(crate) fn parameter(lab: &mut Lab, ui: &mut Ui, object: ObjectId, curve: &Nurbs<DVec2>, t: f64) {
    ui.label(RichText::new("t").italics());
    let (left, right) = curve.space().parameter_interval();
    let field = NumberField::new("Parameter t", t)
        .width(74.0)
        .drag(Drag::PerPixel((right - left) / 500.0))
        .show(ui, "parameter");
    field.response.on_hover_text("The parameter: drag, or click to type");
    if let Some(NumberEvent::Typed { to: value, .. } | NumberEvent::Dragged { to: value, .. }) = field.event {
        if value < left || value > right {
            lab.shape_note =
                Some(format!("{} lies outside [{}, {}]", short(value), short(left), short(right)));
        }
        lab.set_parameter(object, value);
    }
}

/// The switch between the control points and the curve.
fn what_stays(lab: &mut Lab, ui: &mut Ui) {
    ui.spacing_mut().item_spacing.x = 3.0;
    for (keep_curve, text, hint) in [
        (false, "Keep points", "While knots move, the control points stay and the curve changes"),
        (
            true,
            "Keep curve",
            "While knots move, the control points are recomputed so that the curve stays as near as it can; \
             the certified deviation is shown",
        ),
    ] {
        let on = lab.knots.keep_curve == keep_curve;
        if ui.selectable_label(on, text).on_hover_text(hint).clicked() {
            lab.knots.keep_curve = keep_curve;
        }
    }
    ui.spacing_mut().item_spacing.x = 8.0;
}

fn knots_menu(lab: &mut Lab, ui: &mut Ui) {
    ui.set_min_width(250.0);
    let kept = if lab.knots.keep_curve { "curve kept" } else { "control points kept" };
    ui.label(RichText::new(format!("All knots by a rule ({kept})")).weak().small());
    for rule in KnotRule::ALL {
        let (text, hint) = rule_command(rule).text();
        if ui.add(Button::new(text)).on_hover_text(hint).clicked() {
            actions::generate(lab, rule);
            ui.close();
        }
    }
    ui.separator();
    ui.label(RichText::new("Remove what the curve does not need").weak().small());
    ui.horizontal(|ui| {
        ui.label("within");
        let field = NumberField::new("Tolerance of removal", lab.knots.tolerance).check(not_negative);
        if let Some(NumberEvent::Typed { to, .. }) = field.width(80.0).show(ui, "tolerance").event {
            lab.knots.tolerance = to;
        }
        let remove = ui.button("Remove knots");
        remove.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Remove knots within the tolerance"));
        if remove.on_hover_text(Command::RemoveKnotsWithin.text().1).clicked() {
            actions::remove_within(lab);
            ui.close();
        }
    });
}

fn not_negative(value: f64) -> Result<(), String> {
    if value >= 0.0 { Ok(()) } else { Err(format!("{value} is negative")) }
}

/// The command of a rule.
fn rule_command(rule: KnotRule) -> Command {
    match rule {
        KnotRule::Uniform => Command::UniformKnots,
        KnotRule::EndInterpolating => Command::EndInterpolatingKnots,
        KnotRule::ChordLength => Command::ChordLengthKnots,
        KnotRule::Centripetal => Command::CentripetalKnots,
        KnotRule::Averaged => Command::AveragedKnots,
    }
}

fn description(curve: &Nurbs<DVec2>) -> String {
    let space = curve.space();
    let (left, right) = space.parameter_interval();
    let kind = match (space.is_periodic(), curve.is_polynomial()) {
        (false, true) => "",
        (false, false) => "rational, ",
        (true, true) => "closed, ",
        (true, false) => "closed, rational, ",
    };
    let (degree, count) = (space.degree(), space.dimension());
    format!("{kind}degree {degree}, {count} B-splines, D = [{}, {}]", short(left), short(right))
}
