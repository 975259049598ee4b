//! What the tests of the panels stand on: a lab with one curve, and a panel in a window without a screen.

use eframe::egui::{Pos2, Ui, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;

use crate::app::lab::Lab;
use crate::app::look;
use crate::core::bspline::SplineSpace;
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, Document, Edit, View};

/// A lab with the curve of degree 3 over the knots −1 0 0 0 1 2 3 4 4 4 5, selected.
pub(crate) fn lab() -> Lab {
    let knots = vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 5.0];
    let points = [(0.0, 0.0), (1.0, 2.0), (2.5, 2.5), (4.0, -1.0), (5.0, 0.0), (6.0, 2.0), (7.5, 1.0)];
    let points = points.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
    let curve = Nurbs::polynomial(SplineSpace::new(3, knots).unwrap(), points).unwrap();
    lab_with(curve)
}

/// A lab with `curve`, selected.
pub(crate) fn lab_with(curve: Nurbs<DVec2>) -> Lab {
    let mut document = Document::new();
    let edit = Edit::AddCurve { name: "Wave".to_owned(), curve, display: CurveDisplay::default() };
    document.apply(&edit).unwrap();
    Lab::new(document, View::default())
}

/// The knots of the selected curve.
pub(crate) fn knots(lab: &Lab) -> Vec<f64> {
    lab.curve().map(|curve| curve.space().knots().to_vec()).unwrap_or_default()
}

/// A window of the given size with one panel in it.
pub(crate) fn window(lab: Lab, size: (f32, f32), panel: fn(&mut Lab, &mut Ui)) -> Harness<'static, Lab> {
    let mut styled = false;
    let mut harness = Harness::builder().with_size(vec2(size.0, size.1)).with_step_dt(0.1).build_ui_state(
        move |ui, lab: &mut Lab| {
            if !styled {
                ui.ctx().set_fonts(look::fonts());
                look::apply(&lab.theme, ui.ctx());
                styled = true;
                // The fonts are there from the next frame on.
                return;
            }
            lab.hovered = std::mem::take(&mut lab.hovering);
            lab.tidy_selection();
            panel(lab, ui);
        },
        lab,
    );
    harness.run();
    harness
}

/// Drags what is called `label` by `(dx, dy)` in four steps.
pub(crate) fn drag(harness: &mut Harness<'_, Lab>, label: &str, dx: f32, dy: f32) {
    let from: Pos2 = harness.get_by_label(label).rect().center();
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for part in 1..=4 {
        harness.hover_at(from + vec2(dx, dy) * (part as f32 / 4.0));
        harness.step();
    }
    harness.drop_at(from + vec2(dx, dy));
    harness.run();
}

/// Types `text` into the field called `label` and presses Enter.
pub(crate) fn type_into(harness: &mut Harness<'_, Lab>, label: &str, text: &str) {
    harness.get_by_label(label).click();
    harness.run();
    harness.get_by_label(label).type_text(text);
    harness.run();
    harness.key_press(eframe::egui::Key::Enter);
    harness.run();
}
