//! The objects of the document: select, show and hide, rename, reorder.

use std::sync::Arc;

use eframe::egui::{
    Align, Button, Color32, Id, Key, Layout, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind,
    TextEdit, Ui, WidgetInfo, vec2,
};

use crate::app::command::Command;
use crate::app::icon::{self, Icon};
use crate::app::lab::Lab;
use crate::app::painter::color32;
use crate::app::workspace::Room;
use crate::document::{Edit, Object, ObjectId};

/// The name that is being typed.
#[derive(Clone, Debug)]
struct Renaming {
    object: ObjectId,
    text: String,
    fresh: bool,
}

/// Shows the list.
pub(crate) fn show(lab: &mut Lab, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.heading("Objects");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let start = match lab.room() {
                Room::Curves => Some(("New curve", Command::DrawTool)),
                Room::Approximation => Some(("New", Command::NewApproximation)),
                Room::Surfaces => Some(("Import mesh", Command::ImportMesh)),
                // The tools of that room offer every kind of problem.
                Room::Elements => None,
            };
            if let Some((word, command)) = start
                && ui.add(Button::new(word).small()).on_hover_text(command.text().1).clicked()
            {
                lab.commands.push(command);
            }
        });
    });
    let objects: Vec<Arc<Object>> = lab.history.document().objects().to_vec();
    if objects.is_empty() {
        let begin = match lab.room() {
            Room::Curves => "Draw a curve",
            Room::Approximation => "Make data",
            Room::Surfaces => "Add a surface or a mesh",
            Room::Elements => "Choose a problem",
        };
        ui.label(RichText::new(format!("Nothing here yet. {begin} or open a lesson.")).weak());
        return;
    }
    let id = ui.make_persistent_id("renaming");
    let mut renaming: Option<Renaming> = ui.data(|data| data.get_temp(id));
    let row = ui.spacing().interact_size.y;
    let most = (ui.available_height() * 0.45).max(4.0 * row);
    ScrollArea::vertical().id_salt("objects").max_height(most).auto_shrink([false, true]).show_rows(
        ui,
        row,
        objects.len(),
        |ui, range| {
            ui.spacing_mut().item_spacing.y = 2.0;
            for index in range {
                show_row(lab, ui, &objects, index, &mut renaming);
            }
        },
    );
    ui.data_mut(|data| match renaming {
        Some(renaming) => {
            data.insert_temp(id, renaming);
        }
        None => data.remove::<Renaming>(id),
    });
}

fn show_row(
    lab: &mut Lab,
    ui: &mut Ui,
    objects: &[Arc<Object>],
    index: usize,
    renaming: &mut Option<Renaming>,
) {
    let object = &objects[index];
    let id = object.id;
    let selected = lab.selection.object == Some(id);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let (sign, word) = if object.visible { (Icon::Shown, "Hide") } else { (Icon::Hidden, "Show") };
        if icon::button(ui, sign, &format!("{word} {}", object.name), true).clicked() {
            lab.edit(Edit::SetVisible { object: id, visible: !object.visible });
        }
        chip(ui, color32(lab.theme.basis_color(object.content.color())), object.visible);
        if renaming.as_ref().is_some_and(|renaming| renaming.object == id) {
            rename(lab, ui, renaming);
            return;
        }
        let buttons =
            if selected && objects.len() > 1 { 2.0 * (ui.spacing().interact_size.y + 2.0) } else { 0.0 };
        let size = vec2((ui.available_width() - buttons - 4.0).max(30.0), ui.spacing().interact_size.y);
        let mut text = RichText::new(&object.name);
        if !object.visible {
            text = text.weak();
        }
        let button = Button::selectable(selected, text).truncate().sense(Sense::click());
        let response = ui
            .allocate_ui_with_layout(size, Layout::top_down_justified(Align::LEFT), |ui| ui.add(button))
            .inner;
        if response.clicked() && !selected {
            lab.select(id);
        }
        if response.double_clicked() {
            *renaming = Some(Renaming { object: id, text: object.name.clone(), fresh: true });
        }
        let response = response.on_hover_text(format!("{}\nDouble click renames", object.content.summary()));
        menu(lab, &response, objects, index, renaming);
        if buttons > 0.0 {
            ui.spacing_mut().item_spacing.x = 1.0;
            if icon::button(ui, Icon::Up, "Move up", index > 0).clicked() {
                lab.edit(Edit::ReorderObject { object: id, to: index - 1 });
            }
            if icon::button(ui, Icon::Down, "Move down", index + 1 < objects.len()).clicked() {
                lab.edit(Edit::ReorderObject { object: id, to: index + 1 });
            }
        }
    });
}

fn chip(ui: &mut Ui, color: Color32, visible: bool) {
    let (rect, _) = ui.allocate_exact_size(vec2(11.0, 11.0), Sense::hover());
    if visible {
        ui.painter().rect_filled(rect, 3.0, color);
    } else {
        ui.painter().rect_stroke(rect, 3.0, Stroke::new(1.2, color), StrokeKind::Inside);
    }
}

fn rename(lab: &mut Lab, ui: &mut Ui, renaming: &mut Option<Renaming>) {
    let Some(current) = renaming else { return };
    let edit = TextEdit::singleline(&mut current.text)
        .id(Id::unique(("rename object", current.object)))
        .desired_width(f32::INFINITY);
    let response = ui.add(edit).accessible_name("Name of the object");
    if current.fresh {
        current.fresh = false;
        response.request_focus();
        return;
    }
    if response.lost_focus() {
        let name = current.text.trim().to_owned();
        let given_up = ui.input(|input| input.key_pressed(Key::Escape)) || name.is_empty();
        if !given_up {
            lab.edit(Edit::RenameObject { object: current.object, name });
        }
        *renaming = None;
    }
}

fn menu(
    lab: &mut Lab,
    response: &Response,
    objects: &[Arc<Object>],
    index: usize,
    renaming: &mut Option<Renaming>,
) {
    let object = &objects[index];
    let id = object.id;
    response.context_menu(|ui| {
        let item = |ui: &mut Ui, text: &str, enabled: bool| {
            let clicked = ui.add_enabled(enabled, Button::new(text)).clicked();
            if clicked {
                ui.close();
            }
            clicked
        };
        if item(ui, "Rename", true) {
            *renaming = Some(Renaming { object: id, text: object.name.clone(), fresh: true });
        }
        if item(ui, "Duplicate", true)
            && let Some(outcome) = lab.edit(Edit::DuplicateObject { object: id })
            && let Some(&created) = outcome.created.first()
        {
            lab.select(created);
        }
        if item(ui, if object.visible { "Hide" } else { "Show" }, true) {
            lab.edit(Edit::SetVisible { object: id, visible: !object.visible });
        }
        ui.separator();
        if item(ui, "Move up", index > 0) {
            lab.edit(Edit::ReorderObject { object: id, to: index - 1 });
        }
        if item(ui, "Move down", index + 1 < objects.len()) {
            lab.edit(Edit::ReorderObject { object: id, to: index + 1 });
        }
        ui.separator();
        if item(ui, "Delete", true) {
            lab.edit(Edit::RemoveObjects { objects: vec![id] });
        }
    });
    response.widget_info(|| {
        WidgetInfo::selected(Role::ListItem, true, lab.selection.object == Some(id), &object.name)
    });
}
