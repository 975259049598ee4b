//! Everything about the selected surface or mesh as numbers and choices.

mod mesh;
mod points;
mod surface;

use std::sync::Arc;

use eframe::egui::{CollapsingHeader, ComboBox, Grid, RichText, ScrollArea, Ui};

use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberField};
use crate::app::surfaces::canvas::Canvas;
use crate::app::surfaces::commands;
use crate::app::surfaces::measures::Measures;
use crate::document::{Content, Object, SurfaceColoring};

/// Shows the inspector.
pub(super) fn show(lab: &mut Lab, canvas: &mut Canvas, measures: &mut Measures, ui: &mut Ui) {
    let subject =
        commands::selected(lab).filter(|object| object.surface().is_some() || object.mesh().is_some());
    let Some(subject) = subject.cloned() else {
        ui.add_space(8.0);
        ui.label(RichText::new("Select a surface or a mesh to see and type its numbers.").weak());
        return;
    };
    ScrollArea::vertical().id_salt("surface inspector").auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        ui.label(RichText::new(&subject.name).heading());
        ui.label(RichText::new(subject.content.summary()).weak());
        ui.add_space(4.0);
        points::show(lab, ui, &subject);
        match &subject.content {
            Content::Surface(surface) => surface::show(lab, measures, ui, &subject, surface),
            Content::Mesh(mesh) => mesh::show(lab, canvas, ui, &subject, mesh),
            _ => {}
        }
        ui.add_space(8.0);
    });
}

fn section(ui: &mut Ui, title: &str, add: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, add);
}

/// Two columns of check boxes; whether one was clicked.
fn check_boxes<T>(ui: &mut Ui, id: &str, display: &mut T, boxes: &[(&str, fn(&mut T) -> &mut bool)]) {
    let width = (ui.available_width() - 8.0) * 0.5;
    Grid::new(id).num_columns(2).min_col_width(width).spacing([8.0, 3.0]).show(ui, |ui| {
        for (index, (text, field)) in boxes.iter().enumerate() {
            ui.checkbox(field(display), *text);
            if index % 2 == 1 {
                ui.end_row();
            }
        }
    });
}

/// What the colours tell.
fn coloring(ui: &mut Ui, coloring: &mut SurfaceColoring) {
    ui.horizontal(|ui| {
        ui.label("Colours");
        let combo = ComboBox::from_id_salt("coloring")
            .width((ui.available_width() - 8.0).min(200.0))
            .selected_text(coloring.name())
            .show_ui(ui, |ui| {
                for choice in SurfaceColoring::ALL {
                    ui.selectable_value(coloring, choice, choice.name());
                }
            });
        combo.response.accessible_name("What the colours tell");
    });
}

/// The end of the colour scale.
fn color_limit(lab: &mut Lab, ui: &mut Ui, object: &Arc<Object>, limit: f64) {
    ui.horizontal(|ui| {
        ui.label("Scale up to");
        let field = NumberField::new("End of the colour scale", limit).width(64.0).drag(Drag::Off);
        let field = field.check(|limit| if limit >= 0.0 { Ok(()) } else { Err("not negative".to_owned()) });
        let field = field.show(ui, ("color limit", object.id));
        commands::apply(lab, field.event, "Change colour scale", |content, color_limit| match content {
            Content::Surface(surface) => {
                let display = crate::document::SurfaceDisplay { color_limit, ..surface.display().clone() };
                surface.with_display(display).map(Content::Surface)
            }
            Content::Mesh(mesh) => {
                let display = crate::document::MeshDisplay { color_limit, ..mesh.display().clone() };
                mesh.with_display(display).map(Content::Mesh)
            }
            other => Ok(other.clone()),
        });
        ui.label(RichText::new("0: as needed").weak());
    });
}
