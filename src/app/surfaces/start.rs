//! Shapes to start with: the menu of the toolbar and the buttons on an empty canvas.

use eframe::egui::{self, Align2, Area, Button, Frame, Id, Rect, RichText, Ui};

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::core::surface::{mesh_shapes, samples};
use crate::document::{Content, Edit, EditError, MeshDisplay, MeshObject, SurfaceDisplay, SurfaceObject};

/// The surfaces of the course by name.
const SURFACES: [&str; 5] = ["Torus", "Sphere", "Helical staircase", "Partially closed", "Sphere octant"];

/// The meshes that an empty canvas offers.
const FIRST_MESHES: [&str; 4] = ["Cube", "L-block", "Open sheet", "Creased cube"];

fn surface(name: &str, color: usize) -> Result<Content, EditError> {
    let surface = match name {
        "Torus" => samples::torus().into(),
        "Helical staircase" => samples::helical_staircase().into(),
        "Sphere" => samples::sphere(),
        "Partially closed" => samples::partially_closed().into(),
        _ => samples::sphere_octant(),
    };
    let display = SurfaceDisplay { color, density: 20, ..SurfaceDisplay::default() };
    SurfaceObject::new(surface, display).map(Content::Surface)
}

fn mesh(name: &str, color: usize) -> Option<Result<Content, EditError>> {
    let (_, cage) = mesh_shapes::named_shapes().into_iter().find(|(shape, _)| *shape == name)?;
    let display = MeshDisplay { color, ..MeshDisplay::default() };
    Some(MeshObject::from_cage(cage, display).map(Content::Mesh))
}

/// Adds the shape called `name` and selects it.
pub(super) fn add(name: &str, lab: &mut Lab) {
    let color = lab.history.document().len();
    let content = mesh(name, color).unwrap_or_else(|| surface(name, color));
    match content {
        Ok(content) => {
            let was_empty = crate::figure::surfaces::bounding_box(lab.history.document()).is_none();
            let made = lab.edit(Edit::AddObject { name: name.to_owned(), content });
            if let Some(&id) = made.as_ref().and_then(|made| made.created.first()) {
                lab.select(id);
            }
            if was_empty {
                lab.commands.push(Command::Fit);
            }
        }
        Err(error) => lab.problem(error.to_string()),
    }
}

/// The menu of all shapes.
pub(super) fn menu(lab: &mut Lab, ui: &mut Ui) {
    ui.menu_button("Add", |ui| {
        ui.set_min_width(170.0);
        ui.label(RichText::new("Spline surfaces").weak());
        for name in SURFACES {
            entry(name, lab, ui);
        }
        ui.separator();
        ui.label(RichText::new("Meshes").weak());
        for (name, _) in mesh_shapes::named_shapes() {
            entry(name, lab, ui);
        }
        ui.separator();
        if ui.button("Mesh from an OBJ file…").clicked() {
            lab.commands.push(Command::ImportMesh);
            ui.close();
        }
    })
    .response
    .on_hover_text("Add a surface or a mesh");
}

fn entry(name: &str, lab: &mut Lab, ui: &mut Ui) {
    if ui.button(name).clicked() {
        add(name, lab);
        ui.close();
    }
}

/// The buttons on an empty canvas.
pub(super) fn offer(rect: Rect, lab: &mut Lab, ui: &Ui) {
    let area = Area::new(Id::unique("start with")).pivot(Align2::CENTER_CENTER).fixed_pos(rect.center());
    area.order(egui::Order::Middle).constrain_to(rect).show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).inner_margin(18.0).show(ui, |ui| {
            ui.set_width(372.0_f32.min(rect.width() - 60.0));
            ui.heading("Start with…");
            for (title, names) in
                [("a spline surface", &SURFACES[..4]), ("a mesh that is subdivided", &FIRST_MESHES[..])]
            {
                ui.add_space(8.0);
                ui.label(RichText::new(title).weak());
                ui.horizontal_wrapped(|ui| {
                    for name in names {
                        if ui.add(Button::new(*name).min_size(egui::vec2(0.0, 28.0))).clicked() {
                            add(name, lab);
                        }
                    }
                });
            }
            ui.add_space(8.0);
            ui.horizontal_wrapped(|ui| {
                if ui.button("Open an OBJ file…").clicked() {
                    lab.commands.push(Command::ImportMesh);
                }
                ui.label(RichText::new("or drop one here").weak());
            });
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_of_the_menus_can_be_made() {
        for name in SURFACES {
            assert!(surface(name, 0).is_ok(), "{name}");
        }
        for name in FIRST_MESHES {
            assert!(mesh(name, 0).is_some_and(|made| made.is_ok()), "{name}");
        }
    }
}
