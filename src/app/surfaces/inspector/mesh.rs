//! A mesh: level, counts, boundary, edges, stencils, what is shown.

use std::sync::Arc;

use eframe::egui::{ComboBox, Frame, Grid, RichText, Slider, Ui};

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::painter::color32;
use crate::app::surfaces::canvas::Canvas;
use crate::app::surfaces::inspector::{check_boxes, color_limit, coloring, section};
use crate::app::surfaces::stencil::weight_text;
use crate::app::surfaces::{Picked, commands};
use crate::core::surface::catmull_clark::{BoundaryRule, Origin};
use crate::document::{MeshDisplay, MeshObject, Object, SurfaceColoring};
use crate::figure::surfaces::{MAX_WIREFRAME, valence_color};

/// Largest sharpness of the slider; infinity is a button.
const SLIDER: f64 = 5.0;
/// Rows of a stencil that are listed.
const ROWS: usize = 60;

/// Shows the sections.
pub(super) fn show(lab: &mut Lab, canvas: &mut Canvas, ui: &mut Ui, object: &Arc<Object>, mesh: &MeshObject) {
    if let Picked::Edge(id, ends) = canvas.picked
        && id == object.id
    {
        edge(lab, ui, mesh, ends);
    }
    stencil(canvas, ui);
    section(ui, "Subdivision", |ui| subdivision(lab, canvas, ui, object, mesh));
    section(ui, "Shown", |ui| shown(lab, ui, object, mesh));
}

fn subdivision(lab: &mut Lab, canvas: &Canvas, ui: &mut Ui, object: &Arc<Object>, mesh: &MeshObject) {
    ui.horizontal(|ui| {
        ui.label("Level");
        for level in 0..=MeshObject::MAX_LEVEL {
            let possible = level <= mesh.highest_level();
            let button = eframe::egui::Button::selectable(level == mesh.level(), level.to_string());
            let hint = if possible { "Steps of subdivision" } else { "This level would have too many faces" };
            let response = ui.add_enabled(possible, button).on_hover_text(hint).on_disabled_hover_text(hint);
            response.widget_info(|| {
                let name = format!("Level {level}");
                eframe::egui::WidgetInfo::selected(
                    eframe::egui::Role::RadioButton,
                    possible,
                    level == mesh.level(),
                    name,
                )
            });
            if response.clicked() {
                commands::change(lab, &format!("Level {level}"), |content| {
                    commands::on_mesh(content, |mesh| mesh.with_level(level))
                });
            }
        }
    });
    let refined = canvas.store.shape(object.id).and_then(|(made_of, shape)| {
        let is_current = made_of.mesh().is_some_and(|made| made.level() == mesh.level());
        let steps = shape.steps.last().filter(|_| is_current);
        steps.map(|step| step.mesh.counts())
    });
    Grid::new("counts").num_columns(5).spacing([9.0, 2.0]).show(ui, |ui| {
        for head in ["", "V", "E", "F", "V−E+F"] {
            ui.label(RichText::new(head).weak());
        }
        ui.end_row();
        for (name, counts) in [("control", Some(mesh.cage().counts())), ("refined", refined)] {
            let Some(counts) = counts else { continue };
            ui.label(name);
            for count in counts {
                ui.label(count.to_string());
            }
            ui.end_row();
        }
    });
    ui.horizontal(|ui| {
        ui.label("Boundary");
        let rules = [
            (BoundaryRule::Standard { fix_corners: false }, "spline curve"),
            (BoundaryRule::Standard { fix_corners: true }, "spline curve, corners fixed"),
            (BoundaryRule::Discard, "discarded"),
        ];
        let mut rule = mesh.rule();
        let text = rules.iter().find(|(other, _)| *other == rule).map_or("", |(_, text)| text);
        let combo = ComboBox::from_id_salt("boundary").width((ui.available_width() - 8.0).min(190.0));
        let combo = combo.selected_text(text).show_ui(ui, |ui| {
            for (choice, text) in rules {
                ui.selectable_value(&mut rule, choice, text);
            }
        });
        combo.response.accessible_name("Boundary rule");
        if rule != mesh.rule() {
            commands::change(lab, "Change boundary rule", |content| {
                commands::on_mesh(content, |mesh| mesh.with_rule(rule))
            });
        }
    });
    ui.horizontal(|ui| {
        crate::app::toolbar::button("Import OBJ…", Command::ImportMesh, lab, ui);
        crate::app::toolbar::button("Export OBJ…", Command::ExportMesh, lab, ui);
    });
    let tips =
        "Click an edge of the control mesh to make it sharp, the refined mesh to see a vertex's stencil.";
    ui.label(RichText::new(tips).weak());
}

fn edge(lab: &mut Lab, ui: &mut Ui, mesh: &MeshObject, ends: [u32; 2]) {
    let Some(edge) = mesh.cage().topology().edge_between(ends[0], ends[1]) else { return };
    let sharpness = mesh.cage().sharpness(edge);
    let is_boundary = mesh.cage().topology().edge_faces(edge).count() == 1;
    let frame = Frame::group(ui.style()).inner_margin(6.0).fill(ui.visuals().faint_bg_color);
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.label(RichText::new(format!("Edge from vertex {} to {}", ends[0], ends[1])).strong());
        if is_boundary {
            ui.label(RichText::new("A boundary edge; the boundary rule decides.").weak());
            return;
        }
        let set = |sharpness: f64| {
            move |content: &crate::document::Content| {
                commands::on_mesh(content, |mesh| mesh.with_sharpness(ends, sharpness))
            }
        };
        ui.label("Sharpness");
        ui.horizontal(|ui| {
            let mut value = if sharpness.is_finite() { sharpness.min(SLIDER) } else { SLIDER };
            ui.spacing_mut().slider_width = (ui.available_width() - 110.0).max(60.0);
            let slider = ui.add(Slider::new(&mut value, 0.0..=SLIDER).max_decimals(2));
            let slider = slider.accessible_name("Sharpness of the edge");
            if slider.changed() {
                if slider.dragged() {
                    commands::drag(lab, "Change sharpness", set(value));
                } else {
                    commands::change(lab, "Change sharpness", set(value));
                }
            }
            if slider.drag_stopped() {
                lab.commit();
            }
            let infinite = sharpness.is_infinite();
            let button = ui.selectable_label(infinite, "∞").on_hover_text("Infinitely sharp");
            if button.clicked() {
                commands::change(lab, "Change sharpness", set(if infinite { 0.0 } else { f64::INFINITY }));
            }
        });
    });
}

fn stencil(canvas: &mut Canvas, ui: &mut Ui) {
    let Some(stencil) = canvas.stencil() else { return };
    let frame = Frame::group(ui.style()).inner_margin(6.0).fill(ui.visuals().faint_bg_color);
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        ui.label(RichText::new(format!("Vertex {} of level {}", stencil.vertex, stencil.level)).strong());
        let came = match stencil.origin {
            Some(Origin::Vertex(from)) => format!("image of vertex {from}"),
            Some(Origin::Edge(from)) => format!("point of edge {from}"),
            Some(Origin::Face(from)) => format!("point of face {from}"),
            None => String::new(),
        };
        ui.label(RichText::new(came).weak());
        if stencil.level > 1 {
            ui.horizontal(|ui| {
                ui.selectable_value(&mut canvas.one_step, false, "of the control mesh");
                ui.selectable_value(&mut canvas.one_step, true, "of the last step");
            });
        }
        let height = 9.5 * (ui.spacing().interact_size.y + 2.0);
        eframe::egui::ScrollArea::vertical().id_salt("stencil").max_height(height).show(ui, |ui| {
            Grid::new("stencil table").num_columns(3).spacing([16.0, 2.0]).striped(true).show(ui, |ui| {
                for head in ["vertex", "weight", ""] {
                    ui.label(RichText::new(head).weak());
                }
                ui.end_row();
                for &(vertex, _, weight) in stencil.parents.iter().take(ROWS) {
                    ui.label(vertex.to_string());
                    ui.label(weight_text(weight));
                    ui.label(RichText::new(format!("{weight:.5}")).weak());
                    ui.end_row();
                }
            });
        });
        if stencil.parents.len() > ROWS {
            ui.label(RichText::new(format!("and {} more", stencil.parents.len() - ROWS)).weak());
        }
    });
}

fn shown(lab: &mut Lab, ui: &mut Ui, object: &Arc<Object>, mesh: &MeshObject) {
    let mut display = mesh.display().clone();
    check_boxes(
        ui,
        "mesh shown",
        &mut display,
        &[
            ("Control mesh", |d: &mut MeshDisplay| &mut d.cage),
            ("Wireframe", |d| &mut d.wireframe),
            ("Smooth light", |d| &mut d.smooth),
            ("Limit points", |d| &mut d.limit),
            ("Valences", |d| &mut d.valences),
        ],
    );
    if display.valences {
        ui.horizontal_wrapped(|ui| {
            for (valence, text) in [(3, "3 faces"), (5, "5 faces"), (6, "6 or more")] {
                if let Some(color) = valence_color(valence, &lab.theme) {
                    ui.label(RichText::new("◆").color(color32(color)));
                    ui.label(text);
                }
            }
        });
    }
    if display.wireframe && mesh.refined_face_count() > MAX_WIREFRAME {
        ui.label(RichText::new(format!("The wireframe is drawn up to {MAX_WIREFRAME} faces.")).weak());
    }
    coloring(ui, &mut display.coloring);
    if display != *mesh.display() {
        commands::change(lab, "Change display", |content| {
            commands::on_mesh(content, |mesh| mesh.with_display(display))
        });
        return;
    }
    if display.coloring != SurfaceColoring::Plain {
        color_limit(lab, ui, object, display.color_limit);
    }
}
