//! The ends of a cubic as numbers, and all cubics that have them.

use eframe::egui::{Button, Grid, RichText, ScrollArea, Sense, Stroke, Ui, vec2};
use glam::DVec2;

use crate::app::inspector::copyable;
use crate::app::lab::{Lab, Selection};
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::number_text::short;
use crate::app::painter::color32;
use crate::app::side_rooms::hermite::{End, Hermite, color};
use crate::app::side_rooms::parabolas;
use crate::core::bezier::GeometricHermite;
use crate::core::rational_bezier::RationalBezier;
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveDisplay, Edit};

/// Shows the room.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui) {
    let example = Hermite::example_in(&lab.view.camera, lab.canvas_size);
    let mut hermite = lab.rooms.hermite.unwrap_or(example);
    ScrollArea::vertical().id_salt("hermite").auto_shrink([false, false]).show(ui, |ui| {
        let scale = 1.0 / lab.view.camera.scale;
        Grid::new("hermite ends").num_columns(3).spacing([8.0, 4.0]).show(ui, |ui| {
            ui.label("");
            ui.label(RichText::new("Start").strong());
            ui.label(RichText::new("End").strong());
            ui.end_row();
            row(&mut hermite, ui, "x", scale, |end| &mut end.point.x);
            row(&mut hermite, ui, "y", scale, |end| &mut end.point.y);
            row(&mut hermite, ui, "Direction", 0.5, |end| &mut end.angle);
            row(&mut hermite, ui, "Curvature", 0.005, |end| &mut end.curvature);
        });
        ui.horizontal(|ui| {
            let of_curve = lab.curve().and_then(Hermite::of);
            let button = ui.add_enabled(of_curve.is_some(), Button::new("Ends of the curve"));
            let button = button.on_hover_text("Takes the data at both ends of the selected curve");
            if let Some(of_curve) = of_curve.filter(|_| button.clicked()) {
                hermite = of_curve;
            }
            if ui.button("Example").on_hover_text("Data with three solutions").clicked() {
                hermite = example;
            }
        });
        ui.separator();
        let (headline, reason) = hermite.verdict();
        ui.label(RichText::new(headline).strong());
        ui.label(RichText::new(reason).weak());
        let solutions = hermite.solutions().unwrap_or_default();
        hermite.chosen = hermite.chosen.min(solutions.len().saturating_sub(1));
        list(lab, ui, &solutions, &mut hermite.chosen);
        if let Some(equations) = hermite.equations() {
            ui.add_space(4.0);
            let clicked = ui.horizontal(|ui| {
                let clicked = parabolas::show(ui, &lab.theme, &equations, &solutions, hermite.chosen);
                ui.vertical(|ui| {
                    for (text, ink) in [("start", lab.theme.comb), ("end", lab.theme.warning)] {
                        ui.label(RichText::new(text).color(color32(ink)))
                            .on_hover_text("The equation of this end");
                    }
                    ui.label(RichText::new("in chords").weak().small());
                });
                clicked
            });
            hermite.chosen = clicked.inner.unwrap_or(hermite.chosen);
        }
        ui.add_space(8.0);
    });
    lab.rooms.hermite = Some(hermite);
}

fn row(hermite: &mut Hermite, ui: &mut Ui, name: &str, step: f64, number: fn(&mut End) -> &mut f64) {
    let unit = if name == "Direction" { "Direction \u{b0}" } else { name };
    ui.label(unit);
    for (k, of) in ["start", "end"].into_iter().enumerate() {
        let label = format!("{name} of the {of}");
        let now = *number(&mut hermite.ends[k]);
        let field = NumberField::new(&label, now).width(74.0).drag(Drag::PerPixel(step));
        let event = field.show(ui, ("hermite", name, k)).event;
        if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = event {
            *number(&mut hermite.ends[k]) = to;
        }
    }
    ui.end_row();
}

fn list(lab: &mut Lab, ui: &mut Ui, solutions: &[GeometricHermite], chosen: &mut usize) {
    for (k, solution) in solutions.iter().enumerate() {
        ui.horizontal(|ui| {
            let (swatch, _) = ui.allocate_exact_size(vec2(16.0, 12.0), Sense::hover());
            let stroke = Stroke::new(3.0, color32(color(&lab.theme, k)));
            ui.painter().hline(swatch.x_range(), swatch.center().y, stroke);
            ui.selectable_value(chosen, k, format!("Cubic {}", k + 1));
            ui.label(RichText::new("speeds").weak());
            copyable(lab, ui, "Speeds", &solution.speeds);
        });
    }
    let Some(solution) = solutions.get(*chosen) else { return };
    let points: Vec<String> = solution.curve.points()[1..3]
        .iter()
        .map(|at| format!("({}; {})", short(at.x), short(at.y)))
        .collect();
    ui.label(RichText::new(format!("Inner control points {}", points.join(", "))).weak().small());
    if ui.button("Add to the document").on_hover_text("Makes the chosen cubic a curve").clicked() {
        add(lab, solution);
    }
}

fn add(lab: &mut Lab, solution: &GeometricHermite) {
    let curve: Nurbs<DVec2> =
        match Nurbs::from_rational_bezier_curves(&[RationalBezier::polynomial(&solution.curve)]) {
            Ok(curve) => curve,
            Err(error) => return lab.problem(error.to_string()),
        };
    let taken = |name: &str| lab.history.document().objects().iter().any(|object| object.name == name);
    let name = (1..).map(|k| format!("Hermite cubic {k}")).find(|name| !taken(name)).unwrap_or_default();
    let done = lab.edit(Edit::AddCurve { name: name.clone(), curve, display: CurveDisplay::default() });
    if let Some(&created) = done.as_ref().and_then(|outcome| outcome.created.first()) {
        lab.selection = Selection { object: Some(created), ..Selection::default() };
        lab.done(format!("{name} added"));
    }
}
