//! The selected control points as numbers.

use std::sync::Arc;

use eframe::egui::{Frame, RichText, Ui};
use glam::DVec3;

use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberField, positive};
use crate::app::surfaces::commands;
use crate::document::Object;
use crate::figure::surfaces::control_points;

/// Coordinates and, of a surface, the weight.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, object: &Arc<Object>) {
    let points = control_points(object);
    let chosen = lab.selection.points.clone();
    let places: Vec<DVec3> = chosen.iter().filter_map(|&point| points.get(point).copied()).collect();
    let Some(&first) = chosen.first().filter(|_| !places.is_empty()) else { return };
    let center = places.iter().copied().sum::<DVec3>() / places.len() as f64;
    let frame = Frame::group(ui.style()).inner_margin(6.0).fill(ui.visuals().faint_bg_color);
    frame.show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        let word = if object.mesh().is_some() { "Vertex" } else { "Point" };
        let title = match (places.len(), object.surface()) {
            (1, Some(surface)) => {
                let [row, column] = surface.surface().space().multi_index(first);
                format!("{word} {first}  (row {row}, column {column})")
            }
            (1, None) => format!("{word} {first}"),
            (count, _) => format!("{count} selected, their centre"),
        };
        ui.label(RichText::new(title).strong());
        let width = ((ui.available_width() - 3.0 * 16.0 - 2.0 * 8.0) / 3.0).clamp(40.0, 110.0);
        let step = lab.view.eye.distance / 800.0;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            for axis in 0..3 {
                ui.label(RichText::new(["x", "y", "z"][axis]).weak().italics());
                let name =
                    ["x of the selected point", "y of the selected point", "z of the selected point"][axis];
                let field = NumberField::new(name, center[axis]).width(width).drag(Drag::PerPixel(step));
                let field = field.show(ui, ("coordinate", object.id, first, axis));
                commands::apply(lab, field.event, "Move point", |content, to| {
                    let now = center[axis];
                    commands::moved(content, &chosen, DVec3::AXES[axis] * (to - now))
                });
            }
        });
        if let Some(surface) = object.surface() {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                ui.label(RichText::new("w").weak().italics());
                let weight = surface.surface().weights()[first.min(points.len() - 1)];
                let field = NumberField::new("Weight of the selected point", weight).width(width);
                let field = field.drag(Drag::Factor).check(positive).show(ui, ("weight", object.id, first));
                commands::apply(lab, field.event, "Change weight", |content, weight| {
                    commands::on_surface(content, |surface| surface.with_weights(&chosen, weight))
                });
            });
        }
    });
}
