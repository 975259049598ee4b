//! The knot line: parameter axis, knots and basis functions of the selected curve, tied to the canvas by colour and hover.

mod actions;
mod axis;
mod bars;
mod basis;
mod builder;
mod dial;
mod hand;
pub(crate) mod header;
mod knots;
mod note;
mod plot;
mod pyramid;

use eframe::egui::{Color32, Rect, RichText, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use glam::DVec2;

use crate::app::chart_panel;
use crate::app::command::Command;
use crate::app::knot_line::axis::Axis;
use crate::app::knot_line::basis::Active;
use crate::app::knot_line::hand::Track;
use crate::app::lab::{Hovered, Lab};
use crate::app::painter::color32;
use crate::core::spline_curve::{KnotRule, Nurbs};
use crate::document::ObjectId;

/// Height of the strip with the knots beneath the axis, in points.
const KNOT_STRIP: f32 = 46.0;

/// What all parts of one frame of the knot line need.
#[derive(Clone, Debug)]
struct Scene<'a> {
    object: ObjectId,
    curve: &'a Nurbs<DVec2>,
    /// The parameter.
    t: f64,
    axis: Axis,
    /// Where the functions are drawn; its lower edge is the axis.
    plot: Rect,
    /// Where the knots stand.
    strip: Rect,
    active: Active,
    /// Whether a knot is held.
    busy: bool,
}

impl Scene<'_> {
    /// Screen y of a function value.
    fn y(&self, value: f64) -> f32 {
        let height = self.plot.height() - 6.0;
        self.plot.bottom() - (value.clamp(-0.1, 1.1) as f32) * height
    }

    /// Colour of the function and control point `k`.
    fn color(lab: &Lab, k: usize) -> Color32 {
        color32(lab.theme.basis_color(k))
    }

    /// Whether the function of control point `k` is lit up by what is under the pointer anywhere.
    fn is_lit(&self, lab: &Lab, k: usize) -> bool {
        match lab.hovered {
            Hovered::Point(object, point) => object == self.object && point == k,
            Hovered::Entry(object, ..) => object == self.object && lab.entry_partners.contains(&k),
            _ => false,
        }
    }

    /// Whether something lights functions up, so that the others step back.
    fn any_lit(&self, lab: &Lab) -> bool {
        matches!(lab.hovered, Hovered::Point(object, _) | Hovered::Entry(object, ..) if object == self.object)
    }
}

/// Shows the knot line of the selected curve.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    let selected = lab.selected();
    let Some((object, curve)) = selected.as_ref().and_then(|found| Some((found.id, found.curve()?))) else {
        ui.horizontal(|ui| chart_panel::tabs(lab, ui));
        ui.centered_and_justified(|ui| {
            ui.label(RichText::new("Select a curve to see its knots and B-splines").weak());
        });
        return;
    };
    let Some(t) = lab.parameter(object) else { return };
    builder::follow_panel(lab);
    let id = ui.make_persistent_id("knot line axis").with(object);
    let zoomed = ui.data(|data| data.get_temp::<bool>(id.with("zoomed"))).unwrap_or(false);
    header::show(lab, ui, object, curve, t, zoomed.then_some(id));
    actions::arrows(lab, ui);
    builder::keys(lab, ui, curve.points().len(), curve.degree());

    let whole = ui.available_rect_before_wrap();
    if whole.width() < 60.0 || whole.height() < KNOT_STRIP + 16.0 {
        return;
    }
    // What the row above has just done counts.
    let selected = lab.selected();
    let Some(curve) = selected.as_ref().and_then(|found| found.curve()) else { return };
    let Some(t) = lab.parameter(object) else { return };
    let building = lab.knots.builder.is_some();
    // The builder needs the whole width.
    let dial_width = dial::width(whole.size(), curve.space().is_periodic() && !building);
    let area = Rect::from_min_max(whole.min + vec2(dial_width, 0.0), whole.max);
    let active = basis::active(curve, t);
    let bars_width = if building {
        0.0
    } else {
        bars::width(area.width(), active.values.len(), lab.theme.text_scale as f32)
    };
    let inner = Rect::from_min_max(area.min, area.max - vec2(bars_width, 0.0)).shrink2(vec2(4.0, 0.0));
    let split = inner.bottom() - KNOT_STRIP;
    let plot = Rect::from_min_max(inner.min, pos2(inner.right(), split));
    let strip = Rect::from_min_max(pos2(inner.left(), split), inner.max);

    // The axis stands still during a drag, even if D changes.
    let axis = match hand::frozen(ui, id) {
        Some(Track::Line(axis)) => axis,
        _ => Axis::new(ui, id, curve.space(), plot),
    };
    let busy = [id, id.with("dial")].into_iter().any(|id| hand::frozen(ui, id).is_some());
    let response = ui.allocate_rect(area, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Basis functions"));
    let zoomed_now = axis::navigate(ui, id, inner, &response);
    ui.data_mut(|data| data.insert_temp(id.with("zoomed"), zoomed_now));

    let scene = Scene { object, curve, t, axis, plot, strip, active, busy };
    builder::tidy(lab, &scene);
    plot::show(lab, ui, &scene);
    if !knots::show(lab, ui, id, &scene) && !busy {
        plot::interact(lab, ui, &scene, &response);
    }
    if bars_width > 0.0 {
        let rect = Rect::from_min_max(pos2(inner.right() + 8.0, area.top()), area.max);
        bars::show(lab, ui, &scene, rect);
    }
    if dial_width > 0.0 {
        let rect = Rect::from_min_size(whole.min, vec2(dial_width, whole.height()));
        dial::show(lab, ui, id, &scene, rect);
    }
}

/// Carries out commands about knots; `false` for other commands.
pub(crate) fn execute(command: Command, lab: &mut Lab) -> bool {
    match command {
        Command::UniformKnots => actions::generate(lab, KnotRule::Uniform),
        Command::EndInterpolatingKnots => actions::generate(lab, KnotRule::EndInterpolating),
        Command::ChordLengthKnots => actions::generate(lab, KnotRule::ChordLength),
        Command::CentripetalKnots => actions::generate(lab, KnotRule::Centripetal),
        Command::AveragedKnots => actions::generate(lab, KnotRule::Averaged),
        Command::RemoveKnotsWithin => actions::remove_within(lab),
        Command::NextKnot => actions::select_neighbour(lab, true),
        Command::PreviousKnot => actions::select_neighbour(lab, false),
        Command::ToggleKeepCurve => lab.knots.keep_curve = !lab.knots.keep_curve,
        Command::ToggleBuilder => {
            builder::toggle(lab);
            lab.view.panels.insert(crate::app::KNOT_LINE.to_owned(), true);
        }
        _ => return false,
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::test_bench;
    use egui_kittest::kittest::Queryable as _;

    const SIZE: (f32, f32) = (900.0, 180.0);

    #[test]
    fn a_dragged_knot_moves_alone_and_undo_brings_it_back() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        let before = test_bench::knots(window.state());
        test_bench::drag(&mut window, "Knot 2", 30.0, 0.0);
        let after = test_bench::knots(window.state());
        assert!(after[5] > 2.1 && after[5] < 2.9, "knot 5 went from 2 to {}", after[5]);
        assert_eq!(after[6..], before[6..], "the knots behind stay");
        assert_eq!(window.state().history.steps().0, 1, "one undo step");
        window.state_mut().history.undo();
        assert_eq!(test_bench::knots(window.state()), before, "undone");
    }

    #[test]
    fn a_knot_near_its_neighbour_snaps_onto_it() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        let two = window.get_by_label("Knot 2").rect().center().x;
        let three = window.get_by_label("Knot 3").rect().center().x;
        test_bench::drag(&mut window, "Knot 2", three - two - 4.0, 0.0);
        assert_eq!(test_bench::knots(window.state())[5..7], [3.0, 3.0], "a double knot");
        test_bench::drag(&mut window, "Knot 3, 2 copies", -40.0, 0.0);
        let knots = test_bench::knots(window.state());
        assert!(knots[5] < 2.9 && knots[6] == 3.0, "one copy is torn off: {knots:?}");
    }

    #[test]
    fn a_knot_stops_at_its_neighbour() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        test_bench::drag(&mut window, "Knot 2", 500.0, 0.0);
        assert_eq!(test_bench::knots(window.state())[5..7], [3.0, 3.0], "far beyond is as far as it goes");
    }

    #[test]
    fn the_cursor_changes_t_and_nothing_else() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        let object = window.state().selection.object.unwrap();
        let before = window.state().parameter(object).unwrap();
        test_bench::drag(&mut window, "Cursor of t", 50.0, 0.0);
        let after = window.state().parameter(object).unwrap();
        assert!(after > before + 0.1, "t went from {before} to {after}");
        assert_eq!(window.state().history.steps().0, 0, "the parameter is no part of the document");
    }

    #[test]
    fn a_typed_parameter_is_taken_with_a_comma() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        test_bench::type_into(&mut window, "Parameter t", "1,25");
        let object = window.state().selection.object.unwrap();
        assert_eq!(window.state().parameter(object), Some(1.25), "t");
    }

    #[test]
    fn a_double_click_on_the_axis_inserts_a_knot() {
        let mut window = test_bench::window(test_bench::lab(), SIZE, show);
        let one = window.get_by_label("Knot 1").rect().center();
        let two = window.get_by_label("Knot 2").rect().center();
        let at = one.lerp(two, 0.5);
        window.hover_at(at);
        window.step();
        for pressed in [true, false, true, false] {
            let button = eframe::egui::PointerButton::Primary;
            let modifiers = eframe::egui::Modifiers::NONE;
            window.event(eframe::egui::Event::PointerButton { pos: at, button, pressed, modifiers });
            window.step();
        }
        window.run();
        let knots = test_bench::knots(window.state());
        assert_eq!(knots.len(), 12, "{knots:?}, messages {:?}", window.state().messages);
        assert!((knots[5] - 1.5).abs() < 0.02, "{knots:?}");
    }

    #[test]
    fn thousands_of_knots_are_shown() {
        let count = 4000;
        let knots = (0..count + 4).map(f64::from).collect();
        let space = crate::core::bspline::SplineSpace::new(3, knots).unwrap();
        let points = (0..count).map(|k| DVec2::new(f64::from(k), f64::from(k % 7))).collect();
        let lab = test_bench::lab_with(Nurbs::polynomial(space, points).unwrap());
        let window = test_bench::window(lab, SIZE, show);
        let handles = window.query_all_by_label_contains("Knot ").count();
        assert!((50..400).contains(&handles), "{handles} handles");
    }
}
