//! Everything about the selected problem as numbers and choices.

use eframe::egui::{CollapsingHeader, ComboBox, Grid, RichText, ScrollArea, Ui};
use glam::DVec2;

use crate::app::elements::{Elements, Subject, add, canvas, capital, results};
use crate::app::icon::{self, Icon};
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::text_field::TextField;
use crate::core::finite_element::PatchSide;
use crate::document::{
    FieldColors, HandleId, Membrane, MembraneDisplay, MembraneError, Operation, Region, Shape, Shown,
    read_formula,
};

/// Shows the inspector.
pub(super) fn show(room: &mut Elements, lab: &mut Lab, ui: &mut Ui) {
    let Some(subject) = Subject::of(lab) else {
        ui.add_space(8.0);
        ui.label(RichText::new("Choose a problem to start with on the canvas.").weak());
        return;
    };
    ScrollArea::vertical().id_salt("elements").auto_shrink([false, false]).show(ui, |ui| {
        ui.add_space(2.0);
        match &subject.membrane.setting().region {
            Region::Parts { .. } => section(ui, "Domain", |ui| domain(&subject, lab, ui)),
            _ => section(ui, "Patch", |ui| patch(room, &subject, lab, ui)),
        }
        section(ui, "Equation", |ui| equation(&subject, lab, ui));
        section(ui, "Elements", |ui| elements(&subject, lab, ui));
        section(ui, "Solution", |ui| results::solution(room, &subject, ui));
        if !matches!(subject.membrane.setting().region, Region::Channel { .. }) {
            section(ui, "Errors", |ui| results::errors(room, &subject, lab, ui));
        }
        section(ui, "Shown", |ui| shown(&subject, lab, ui));
        ui.add_space(8.0);
    });
}

fn section(ui: &mut Ui, title: &str, add: impl FnOnce(&mut Ui)) {
    ui.add_space(2.0);
    CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, add);
}

/// A number of the problem: typed it is one step, dragged one step too.
fn number(
    subject: &Subject,
    lab: &mut Lab,
    ui: &mut Ui,
    (label, value, drag): (&str, f64, Drag),
    change: impl FnOnce(f64) -> Result<Membrane, MembraneError>,
) {
    let field = NumberField::new(label, value).width(58.0).drag(drag).show(ui, (label, subject.object));
    let name = format!("Change {}", label.to_lowercase());
    match field.event {
        None => {}
        Some(NumberEvent::Typed { to, .. }) => subject.apply(lab, &name, change(to)),
        Some(NumberEvent::Dragged { to, .. }) => subject.update(lab, &name, change(to)),
        Some(NumberEvent::DragEnded) => lab.commit(),
    }
}

fn domain(subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    let parts = subject.membrane.parts();
    for (index, part) in parts.iter().enumerate() {
        let place = index + 1;
        ui.horizontal(|ui| {
            ui.label(RichText::new(format!("{place}")).weak());
            ui.label(part.shape.word());
            if index > 0 {
                let mut operation = part.operation;
                let combo = ComboBox::from_id_salt(("operation", index))
                    .width(96.0)
                    .selected_text(operation.word())
                    .show_ui(ui, |ui| {
                        for choice in Operation::ALL {
                            ui.selectable_value(&mut operation, choice, choice.word());
                        }
                    });
                combo.response.accessible_name(format!("Operation of part {place}"));
                if operation != part.operation {
                    let changed = subject.membrane.with_parts(|parts| parts[index].operation = operation);
                    subject.apply(lab, "Change operation", changed);
                }
            }
            let swap = |a: usize, b: usize| subject.membrane.with_parts(|parts| parts.swap(a, b));
            if icon::button(ui, Icon::Up, &format!("Move part {place} up"), index > 0).clicked() {
                subject.apply(lab, "Reorder parts", swap(index, index - 1));
            }
            let is_last = place == parts.len();
            if icon::button(ui, Icon::Down, &format!("Move part {place} down"), !is_last).clicked() {
                subject.apply(lab, "Reorder parts", swap(index, place));
            }
            if ui
                .small_button("\u{d7}")
                .on_hover_text("Remove")
                .accessible_name(format!("Remove part {place}"))
                .clicked()
            {
                let changed = subject.membrane.with_parts(|parts| drop(parts.remove(index)));
                subject.apply(lab, "Remove part", changed);
            }
        });
        Grid::new(("numbers", index)).num_columns(4).spacing([6.0, 3.0]).show(ui, |ui| {
            for (slot, (name, value)) in numbers(&part.shape).into_iter().enumerate() {
                ui.label(RichText::new(name.clone()).small().weak());
                let label = format!("{name} of part {place}");
                let drag = Drag::PerPixel(0.01);
                number(subject, lab, ui, (&label, value, drag), |to| {
                    subject.membrane.with_parts(|parts| set_number(&mut parts[index].shape, slot, to))
                });
                if slot % 2 == 1 {
                    ui.end_row();
                }
            }
        });
        ui.add_space(3.0);
    }
    ui.menu_button("Add a part", |ui| {
        let at = canvas::camera(lab).center;
        add::menu(at, subject, lab, ui);
    });
}

/// The numbers of a shape with their names, in the order of [`set_number`].
fn numbers(shape: &Shape) -> Vec<(String, f64)> {
    let named =
        |pairs: &[(&str, f64)]| pairs.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    match shape {
        Shape::Disc { center: c, radius } => named(&[("x", c.x), ("y", c.y), ("radius", *radius)]),
        Shape::Ellipse { center: c, half_axes: h, angle } => {
            named(&[("x", c.x), ("y", c.y), ("a", h.x), ("b", h.y), ("angle", angle.to_degrees())])
        }
        Shape::Rectangle { lower: l, upper: u } => {
            named(&[("left", l.x), ("bottom", l.y), ("right", u.x), ("top", u.y)])
        }
        Shape::HalfPlane { point: p, normal: n } => {
            named(&[("x", p.x), ("y", p.y), ("normal x", n.x), ("normal y", n.y)])
        }
        Shape::Polygon { vertices } => {
            let vertex = |(i, at): (usize, &DVec2)| [(format!("x{i}"), at.x), (format!("y{i}"), at.y)];
            vertices.iter().enumerate().flat_map(vertex).collect()
        }
    }
}

fn set_number(shape: &mut Shape, slot: usize, to: f64) {
    let place: Option<&mut f64> = match shape {
        Shape::Disc { center, radius } => [&mut center.x, &mut center.y, radius].into_iter().nth(slot),
        Shape::Ellipse { half_axes: h, center: c, angle } => {
            if slot == 4 {
                *angle = to.to_radians();
                return;
            }
            [&mut c.x, &mut c.y, &mut h.x, &mut h.y].into_iter().nth(slot)
        }
        Shape::Rectangle { lower: a, upper: b } | Shape::HalfPlane { point: a, normal: b } => {
            [&mut a.x, &mut a.y, &mut b.x, &mut b.y].into_iter().nth(slot)
        }
        Shape::Polygon { vertices } => vertices.get_mut(slot / 2).map(|vertex| &mut vertex[slot % 2]),
    };
    if let Some(place) = place {
        *place = to;
    }
}

fn patch(room: &Elements, subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    let Some(patch) = subject.membrane.patch() else { return };
    if let Region::Patch { fixed, .. } = &subject.membrane.setting().region {
        ui.label("u = 0 on");
        ui.horizontal_wrapped(|ui| {
            for (index, side) in PatchSide::ALL.into_iter().enumerate() {
                let mut on = fixed[index];
                if ui.checkbox(&mut on, capital(&side.to_string().replace(" side", ""))).changed() {
                    let changed = subject.membrane.with(|setting| {
                        if let Region::Patch { fixed, .. } = &mut setting.region {
                            fixed[index] = on;
                        }
                    });
                    subject.apply(lab, "Change fixed sides", changed);
                }
            }
        });
    }
    Grid::new("control points").num_columns(4).spacing([6.0, 3.0]).show(ui, |ui| {
        for (index, (&point, &weight)) in patch.points().iter().zip(patch.weights()).enumerate().take(100) {
            let is_selected = room.selected.contains(&HandleId { part: 0, index });
            let name = RichText::new(format!("{index}"));
            ui.label(if is_selected { name.strong() } else { name.weak() });
            for axis in 0..2 {
                let label = format!("{} of point {index}", ["x", "y"][axis]);
                number(subject, lab, ui, (&label, point[axis], Drag::PerPixel(0.01)), |to| {
                    let mut point = point;
                    point[axis] = to;
                    subject.membrane.with_patch(patch.with_point(index, point)?)
                });
            }
            let label = format!("Weight of point {index}");
            number(subject, lab, ui, (&label, weight, Drag::Factor), |to| {
                subject.membrane.with_weight(index, to)
            });
            ui.end_row();
        }
    });
}

fn equation(subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    let setting = subject.membrane.setting();
    if let Region::Channel { inflow, .. } = &setting.region {
        ui.horizontal(|ui| {
            ui.label("Inflow");
            number(subject, lab, ui, ("Inflow", *inflow, Drag::PerPixel(0.01)), |to| {
                subject.membrane.with(|setting| {
                    if let Region::Channel { inflow, .. } = &mut setting.region {
                        *inflow = to;
                    }
                })
            });
        });
        return;
    }
    ui.label(RichText::new("\u{2212}a \u{394}u + c u = f").weak());
    let check = |text: &str| read_formula(text, "f").map(drop).map_err(|error| error.to_string());
    ui.label("f(x, y)");
    let taken = TextField::new("Load", setting.load.text()).show(ui, ("load", subject.object), check);
    if let Some(formula) = taken.and_then(|text| read_formula(&text, "f").ok()) {
        subject.apply(lab, "Change load", subject.membrane.with(|setting| setting.load = formula));
    }
    ui.horizontal(|ui| {
        ui.label("a");
        number(subject, lab, ui, ("Coefficient a", setting.diffusion, Drag::Factor), |to| {
            subject.membrane.with(|setting| setting.diffusion = to)
        });
        ui.label("c");
        number(subject, lab, ui, ("Coefficient c", setting.reaction, Drag::PerPixel(0.1)), |to| {
            subject.membrane.with(|setting| setting.reaction = to)
        });
    });
}

fn elements(subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    let setting = subject.membrane.setting();
    ui.horizontal(|ui| {
        ui.label("Degree");
        number(subject, lab, ui, ("Degree", setting.degree as f64, Drag::PerPixel(0.03)), |to| {
            subject.membrane.with(|setting| setting.degree = to.round().max(0.0) as usize)
        });
        match &setting.region {
            Region::Parts { width, .. } => {
                ui.label("h");
                number(subject, lab, ui, ("Grid width", *width, Drag::Factor), |to| {
                    subject.membrane.with(|setting| {
                        if let Region::Parts { width, .. } = &mut setting.region {
                            *width = to;
                        }
                    })
                });
            }
            Region::Patch { divisions, .. } | Region::Channel { divisions, .. } => {
                ui.label("1/h");
                number(subject, lab, ui, ("Divisions", *divisions as f64, Drag::PerPixel(0.1)), |to| {
                    subject.membrane.with(|setting| match &mut setting.region {
                        Region::Patch { divisions, .. } | Region::Channel { divisions, .. } => {
                            *divisions = to.round().max(0.0) as usize;
                        }
                        Region::Parts { .. } => {}
                    })
                });
            }
        }
    });
}

fn shown(subject: &Subject, lab: &mut Lab, ui: &mut Ui) {
    let mut display = subject.display.clone();
    let is_flow = matches!(subject.membrane.setting().region, Region::Channel { .. });
    let words = if is_flow { ["potential", "speed"] } else { ["u", "|grad u|"] };
    ui.horizontal(|ui| {
        for (choice, word) in [Shown::Value, Shown::Slope].into_iter().zip(words) {
            ui.selectable_value(&mut display.shown, choice, word);
        }
        let maps = [
            (FieldColors::Viridis, "viridis"),
            (FieldColors::Cividis, "cividis"),
            (FieldColors::Diverging, "blue to red"),
        ];
        let chosen = maps.iter().find(|(map, _)| *map == display.colors).map_or("", |(_, word)| word);
        let combo = ComboBox::from_id_salt("colours").width(90.0).selected_text(chosen).show_ui(ui, |ui| {
            for (map, word) in maps {
                ui.selectable_value(&mut display.colors, map, word);
            }
        });
        combo.response.accessible_name("Colour map");
    });
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut display.fill, "Colours");
        ui.checkbox(&mut display.nodes, "Nodes");
        ui.checkbox(&mut display.cells, "Cells");
        ui.checkbox(&mut display.quadrature, "Quadrature");
        ui.checkbox(&mut display.net, "Net");
    });
    ui.horizontal(|ui| {
        let count = |ui: &mut Ui, label: &str, value: usize| {
            ui.label(label);
            let field = NumberField::new(label, value as f64).width(44.0).check(line_count);
            match field.show(ui, (label, subject.object)).event {
                Some(NumberEvent::Typed { to, .. }) => to.round() as usize,
                _ => value,
            }
        };
        display.isolines = count(ui, "Isolines", display.isolines);
        if is_flow {
            display.stream_lines = count(ui, "Stream lines", display.stream_lines);
        }
    });
    if display != subject.display {
        lab.edit(subject.show(display));
    }
}

fn line_count(count: f64) -> Result<(), String> {
    let most = MembraneDisplay::MAX_LINES;
    if (0.0..=most as f64).contains(&count) { Ok(()) } else { Err(format!("between 0 and {most}")) }
}
