//! Everything about the selected curve as numbers and choices.

mod appearance;
mod conic;
mod knots;
mod measurements;
mod points;
mod shape;
mod whole;

use eframe::egui::{CollapsingHeader, RichText, ScrollArea, Ui};
use glam::DVec2;

use crate::app::lab::Lab;
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, ObjectId};

pub(crate) use measurements::copyable;

/// The selected curve, as it was at the beginning of the frame.
#[derive(Clone, Debug)]
struct Subject<'a> {
    object: ObjectId,
    name: &'a str,
    display: &'a CurveDisplay,
    curve: &'a Nurbs<DVec2>,
}

/// Shows the inspector.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    let selected = lab.selected();
    let subject = selected.as_ref().and_then(|object| {
        let (display, curve) = (object.curve_display()?, object.curve()?);
        Some(Subject { object: object.id, name: &object.name, display, curve })
    });
    let Some(subject) = subject else {
        ui.add_space(8.0);
        ui.label(RichText::new("Select a curve to see and type its numbers.").weak());
        return;
    };
    ScrollArea::vertical().id_salt("inspector").auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        shape::show(lab, ui, &subject);
        points::show_selected(lab, ui, &subject);
        section(ui, "Control points", true, |ui| points::show_table(lab, ui, &subject));
        section(ui, "Knots", true, |ui| knots::show(lab, ui, &subject));
        section(ui, "Shown", true, |ui| appearance::show(lab, ui, &subject));
        section(ui, "At the parameter t", true, |ui| measurements::show(lab, ui, &subject));
        let at_parameter = lab.parameter(subject.object).and_then(|t| conic::piece(subject.curve, t));
        if let Some(piece) = at_parameter {
            section(ui, "Conic at t", true, |ui| conic::show(lab, ui, &subject, &piece));
        }
        section(ui, "Whole curve", true, |ui| whole::show(lab, ui, &subject));
        ui.add_space(8.0);
    });
}

fn section(ui: &mut Ui, title: &str, open: bool, add: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    CollapsingHeader::new(RichText::new(title).strong()).default_open(open).show_unindented(ui, add);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::test_bench;
    use egui_kittest::kittest::Queryable as _;

    const SIZE: (f32, f32) = (280.0, 1100.0);

    #[test]
    fn a_weight_is_typed_with_a_decimal_comma() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        test_bench::type_into(&mut window, "Weight of point 2", "1,5");
        assert_eq!(window.state().curve().unwrap().weights()[2], 1.5, "the weight");
        assert_eq!(window.state().history.steps().0, 1, "one undo step");
    }

    #[test]
    fn a_weight_that_is_not_positive_is_refused_and_stays_to_be_seen() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        test_bench::type_into(&mut window, "Weight of point 2", "-1");
        assert_eq!(window.state().curve().unwrap().weights()[2], 1.0, "nothing changed");
        assert_eq!(window.state().history.steps().0, 0, "no undo step");
        let shown = window.get_by_label("Weight of point 2").value();
        assert_eq!(shown.as_deref(), Some("-1"), "the text is not replaced");
    }

    #[test]
    fn knots_that_are_no_sequence_are_refused_with_the_reason() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        let before = test_bench::knots(window.state());
        window.get_by_label("Knot list").focus();
        window.run();
        window.key_press_modifiers(eframe::egui::Modifiers::COMMAND, eframe::egui::Key::A);
        window.run();
        window.get_by_label("Knot list").type_text("-1 0 0 0 2 1 3 4 4 4 5");
        window.run();
        window.key_press(eframe::egui::Key::Enter);
        window.run();
        assert_eq!(test_bench::knots(window.state()), before, "nothing applied");
        assert!(
            window.query_by_label_contains("smaller than the knot 2 before it").is_some(),
            "the reason is shown"
        );
    }

    #[test]
    fn typed_knots_are_applied_with_enter() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        window.get_by_label("Knot list").focus();
        window.run();
        window.key_press_modifiers(eframe::egui::Modifiers::COMMAND, eframe::egui::Key::A);
        window.run();
        window.get_by_label("Knot list").type_text("-1; 0; 0; 0; 0,5; 2; 3; 4; 4; 4; 5");
        window.run();
        window.key_press(eframe::egui::Key::Enter);
        window.run();
        assert_eq!(test_bench::knots(window.state())[4], 0.5, "the typed knot");
        assert_eq!(window.state().history.steps().0, 1, "one undo step");
    }

    #[test]
    fn dragging_a_number_of_the_selected_point_is_one_undo_step() {
        let mut lab = test_bench::lab();
        lab.selection.points.insert(3);
        let mut window = test_bench::window(lab, SIZE, show);
        test_bench::drag(&mut window, "x of the selected point", 40.0, 0.0);
        let x = window.state().curve().unwrap().points()[3].x;
        assert!(x > 4.2, "x went from 4 to {x}");
        assert_eq!(window.state().history.steps().0, 1, "one undo step");
    }
}
