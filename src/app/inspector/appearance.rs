//! What of the curve is shown.

use eframe::egui::{ComboBox, Grid, RichText, Ui};

use crate::app::inspector::Subject;
use crate::app::lab::Lab;
use crate::app::number_field::{self, Drag, NumberField, positive};
use crate::document::{CurveDisplay, Edit, PointLabels};

/// Shows the choices.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let object = subject.object;
    let mut display = subject.display.clone();
    let half = (ui.available_width() - 8.0) * 0.5;
    Grid::new("shown ".trim_end()).num_columns(2).min_col_width(half).spacing([8.0, 3.0]).show(ui, |ui| {
        ui.checkbox(&mut display.polygon, "Control polygon");
        ui.checkbox(&mut display.points, "Control points");
        ui.end_row();
        ui.checkbox(&mut display.knots, "Knots");
        ui.checkbox(&mut display.pieces, "Pieces in colours");
        ui.end_row();
        ui.checkbox(&mut display.bezier_points, "Bezier points").on_hover_text("Show or hide the Bezier points of all pieces");
        ui.checkbox(&mut display.blossom_labels, "Blossom labels").on_hover_text("Write the knots of each control point beside it, as arguments of the blossom");
        ui.end_row();
        ui.checkbox(&mut display.distance_tube, "Distance tube").on_hover_text("Show or hide the tube around the polygon that holds the curve, with the bound and what is measured");
        ui.checkbox(&mut display.comb, "Curvature comb");
        ui.end_row();
    });
    ui.label(RichText::new("At t").weak());
    Grid::new("shown At t".trim_end()).num_columns(2).min_col_width(half).spacing([8.0, 3.0]).show(
        ui,
        |ui| {
            ui.checkbox(&mut display.construction, "Construction at t");
            ui.checkbox(&mut display.hull, "Convex hull at t");
            ui.end_row();
            ui.checkbox(&mut display.frame, "Frame at t")
                .on_hover_text("The unit tangent T and the unit normal N at t");
            ui.checkbox(&mut display.osculating_circle, "Circle of curvature");
            ui.end_row();
            ui.checkbox(&mut display.hodograph, "Hodograph")
                .on_hover_text("Show or hide the curve of the derivative, with its vector at t");
            ui.end_row();
        },
    );
    ui.label(RichText::new("Measured").weak());
    Grid::new("shown Measured".trim_end()).num_columns(2).min_col_width(half).spacing([8.0, 3.0]).show(
        ui,
        |ui| {
            ui.checkbox(&mut display.inflections, "Inflections")
                .on_hover_text("Mark where the curvature changes its sign");
            ui.checkbox(&mut display.vertices, "Curvature extrema")
                .on_hover_text("Mark where the curvature is locally largest or smallest");
            ui.end_row();
            ui.checkbox(&mut display.symmetry, "Symmetry").on_hover_text(
                "Show the nearest axis or centre of symmetry, and how far the curve is from it",
            );
            ui.checkbox(&mut display.probe_line, "Probe line")
                .on_hover_text("A line that counts its crossings with the curve and with its polygon");
            ui.end_row();
        },
    );
    ui.horizontal(|ui| {
        ui.label("Labels");
        let width = (ui.available_width() - 8.0).min(130.0);
        let label = |labels: PointLabels| match labels {
            PointLabels::None => "none",
            PointLabels::Index => "index",
            PointLabels::Weight => "weight",
            PointLabels::Coordinates => "coordinates",
        };
        let chosen = display.labels;
        let combo = ComboBox::from_id_salt(("labels", object))
            .width(width)
            .selected_text(label(chosen))
            .show_ui(ui, |ui| {
                for labels in
                    [PointLabels::None, PointLabels::Index, PointLabels::Weight, PointLabels::Coordinates]
                {
                    ui.selectable_value(&mut display.labels, labels, label(labels));
                }
            });
        combo.response.accessible_name("Labels of the control points");
    });
    if display != *subject.display {
        lab.edit(Edit::SetDisplay { object, display });
        return;
    }
    numbers(lab, ui, subject);
}

fn numbers(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let (object, display) = (subject.object, subject.display);
    let set = |display: CurveDisplay| Edit::SetDisplay { object, display };
    ui.horizontal(|ui| {
        ui.label("Line width");
        let width =
            NumberField::new("Line width in points", display.width).width(52.0).drag(Drag::PerPixel(0.05));
        let width = width.check(line_width).show(ui, ("width", object));
        number_field::apply(lab, width.event, "Change line width", |_, width| {
            set(CurveDisplay { width, ..display.clone() })
        });
        ui.label(RichText::new("pt").weak());
    });
    if !display.comb {
        return;
    }
    ui.horizontal(|ui| {
        ui.label("Comb scale");
        let scale = NumberField::new("Scale of the comb", display.comb_scale)
            .width(60.0)
            .drag(Drag::Factor)
            .check(positive);
        let scale = scale.show(ui, ("comb scale", object));
        number_field::apply(lab, scale.event, "Change comb scale", |_, comb_scale| {
            set(CurveDisplay { comb_scale, ..display.clone() })
        });
        scale.response.on_hover_text("Length of a tooth where the curvature is 1");
        ui.label("teeth");
        let teeth = NumberField::new("Teeth per knot span", display.comb_teeth as f64)
            .width(44.0)
            .drag(Drag::PerPixel(0.2));
        let teeth = teeth.check(tooth_count).show(ui, ("comb teeth", object));
        number_field::apply(lab, teeth.event, "Change comb teeth", |_, teeth| {
            set(CurveDisplay { comb_teeth: teeth.round() as usize, ..display.clone() })
        });
        teeth.response.on_hover_text("Teeth between two knots");
    });
}

fn line_width(width: f64) -> Result<(), String> {
    if (0.2..=20.0).contains(&width) { Ok(()) } else { Err("between 0.2 and 20 pt".to_owned()) }
}

fn tooth_count(count: f64) -> Result<(), String> {
    if (1.0..=200.0).contains(&count) { Ok(()) } else { Err("between 1 and 200 teeth".to_owned()) }
}
