//! New problems, new parts, and their removal.

use std::collections::BTreeSet;

use eframe::egui::{Button, RichText, Ui, vec2};
use glam::DVec2;

use crate::app::elements::Subject;
use crate::app::lab::Lab;
use crate::app::workspace::Room;
use crate::document::{Content, Edit, HandleId, Membrane, MembranePreset, Operation, Part, Shape};

/// Adds a prepared problem to the document and selects it.
pub(super) fn preset(preset: MembranePreset, lab: &mut Lab) {
    let content = Content::Membrane { membrane: preset.membrane(), display: preset.display() };
    if let Some(outcome) = lab.edit(Edit::AddObject { name: preset.title().to_owned(), content })
        && let Some(&created) = outcome.created.first()
    {
        lab.selection.object = Some(created);
        lab.enter(Room::Elements);
    }
}

/// Buttons for all prepared problems, one below the other.
pub(super) fn preset_buttons(width: f32, lab: &mut Lab, ui: &mut Ui) {
    for choice in MembranePreset::ALL {
        let button = Button::new(RichText::new(choice.title())).min_size(vec2(width, 26.0));
        if ui.add(button).on_hover_text(choice.hint()).clicked() {
            preset(choice, lab);
            ui.close();
        }
    }
}

/// The primitives that can be added, of a size that suits the problem, around `at`.
pub(super) fn primitives(membrane: &Membrane, at: DVec2) -> [Shape; 5] {
    let (low, high) = membrane.bounding_box().unwrap_or((DVec2::splat(-1.0), DVec2::ONE));
    let size = nice(0.2 * (high - low).max_element().max(1e-6));
    let around = |x: f64, y: f64| at + size * DVec2::new(x, y);
    [
        Shape::Disc { center: at, radius: size },
        Shape::Ellipse { center: at, half_axes: DVec2::new(1.5, 0.75) * size, angle: 0.0 },
        Shape::Rectangle { lower: around(-1.0, -0.75), upper: around(1.0, 0.75) },
        Shape::HalfPlane { point: at, normal: DVec2::Y * size },
        Shape::Polygon { vertices: vec![around(-1.0, -0.75), around(1.0, -0.75), around(0.0, 1.0)] },
    ]
}

/// The largest of 1, 2, 5 times a power of ten that is no larger.
fn nice(size: f64) -> f64 {
    let power = 10f64.powf(size.log10().floor());
    [5.0, 2.0].into_iter().map(|factor| factor * power).find(|step| *step <= size).unwrap_or(power)
}

/// Entries of a menu that add a primitive around `at`.
pub(super) fn menu(at: DVec2, subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    for shape in primitives(&subject.membrane, at) {
        if ui.button(super::capital(shape.word())).clicked() {
            part(shape, subject, lab);
            ui.close();
        }
    }
}

/// Adds a primitive to the domain: to an empty one as its first part, else to what there is.
pub(super) fn part(shape: Shape, subject: &Subject, lab: &mut Lab) {
    let label = format!("Add {}", shape.word());
    let added = Part { operation: Operation::Union, shape };
    subject.apply(lab, &label, subject.membrane.with_parts(|parts| parts.push(added)));
}

/// Deletes selected vertices of polygons; else the parts of selected handles; else the object.
pub(super) fn delete(selected: &BTreeSet<HandleId>, subject: &Subject, lab: &mut Lab) {
    if selected.is_empty() || subject.membrane.patch().is_some() {
        lab.edit(Edit::RemoveObjects { objects: vec![subject.object] });
        return;
    }
    let mut gone = BTreeSet::new();
    let changed = subject.membrane.with_parts(|parts| {
        for (index, part) in parts.iter_mut().enumerate() {
            let own: Vec<usize> = selected.iter().filter(|id| id.part == index).map(|id| id.index).collect();
            match &mut part.shape {
                Shape::Polygon { vertices }
                    if !own.is_empty() && !own.contains(&0) && vertices.len() >= own.len() + 3 =>
                {
                    let mut place = 0;
                    vertices.retain(|_| {
                        place += 1;
                        !own.contains(&place)
                    });
                }
                _ if !own.is_empty() => {
                    gone.insert(index);
                }
                _ => {}
            }
        }
        let mut place = 0;
        parts.retain(|_| {
            place += 1;
            !gone.contains(&(place - 1))
        });
    });
    let label = if gone.is_empty() { "Delete vertices" } else { "Delete part" };
    subject.apply(lab, label, changed);
}
