//! A spline surface: its directions, what is shown, how large it is.

use std::sync::Arc;

use eframe::egui::{Id, RichText, Ui};

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField};
use crate::app::surfaces::commands;
use crate::app::surfaces::inspector::{check_boxes, color_limit, coloring, section};
use crate::app::surfaces::measures::Measures;
use crate::app::toolbar::button;
use crate::document::{Content, Object, SurfaceColoring, SurfaceDisplay, SurfaceObject};
use crate::figure::composition::short_number;

/// Knots that are written in full.
const KNOTS: usize = 24;

/// Shows the sections.
pub(super) fn show(
    lab: &mut Lab,
    measures: &mut Measures,
    ui: &mut Ui,
    object: &Arc<Object>,
    surface: &SurfaceObject,
) {
    section(ui, "Directions", |ui| {
        for axis in 0..2 {
            direction(lab, ui, surface, axis);
        }
    });
    section(ui, "Shown", |ui| shown(lab, ui, object, surface));
    section(ui, "Measured", |ui| {
        let text = measures.of(object, lab, ui.ctx()).unwrap_or("…");
        ui.label(text);
    });
}

fn direction(lab: &mut Lab, ui: &mut Ui, surface: &SurfaceObject, axis: usize) {
    let space = &surface.surface().space().axes()[axis];
    let (low, high) = space.parameter_interval();
    let letter = ["u", "v"][axis];
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(letter).strong().italics());
        let closed = if space.is_periodic() { "closed" } else { "open" };
        ui.label(format!(
            "degree {}, from {} to {}, {closed}",
            space.degree(),
            short_number(low),
            short_number(high)
        ));
    });
    let knots = space.knots();
    let mut text: Vec<String> = knots.iter().take(KNOTS).map(|&knot| short_number(knot)).collect();
    if knots.len() > KNOTS {
        text.push(format!("… ({})", knots.len()));
    }
    ui.label(RichText::new(format!("Knots  {}", text.join("  "))).weak());
    let id = Id::unique(("knot to insert", axis));
    let breaks = space.breaks();
    let longest = breaks.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    let middle = longest.map_or(low, |ends| 0.5 * ends[0] + 0.5 * ends[1]);
    let mut knot =
        ui.data(|data| data.get_temp::<f64>(id)).filter(|t| (low..=high).contains(t)).unwrap_or(middle);
    ui.horizontal_wrapped(|ui| {
        let name = ["New knot in u", "New knot in v"][axis];
        let field = NumberField::new(name, knot).width(58.0).drag(Drag::PerPixel((high - low) / 300.0));
        let field = field.show(ui, ("new knot", axis));
        if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = field.event {
            knot = to.clamp(low, high);
            ui.data_mut(|data| data.insert_temp(id, knot));
        }
        let hint = "Insert this knot; the surface is kept, its net comes nearer";
        if ui.button(format!("Insert knot in {letter}")).on_hover_text(hint).clicked() {
            commands::change(lab, &format!("Insert knot {} in {letter}", short_number(knot)), |content| {
                commands::on_surface(content, |surface| surface.with_knot(axis, knot))
            });
        }
    });
    ui.horizontal_wrapped(|ui| {
        let [refine, elevate, reverse] = [
            [Command::RefineU, Command::ElevateU, Command::ReverseU],
            [Command::RefineV, Command::ElevateV, Command::ReverseV],
        ][axis];
        button(&format!("Refine {letter}"), refine, lab, ui);
        button("Raise degree", elevate, lab, ui);
        button("Reverse", reverse, lab, ui);
    });
    ui.add_space(4.0);
}

fn shown(lab: &mut Lab, ui: &mut Ui, object: &Arc<Object>, surface: &SurfaceObject) {
    let mut display = surface.display().clone();
    check_boxes(
        ui,
        "surface shown",
        &mut display,
        &[
            ("Control net", |d: &mut SurfaceDisplay| &mut d.net),
            ("Knot lines", |d| &mut d.knot_lines),
            ("Normals", |d| &mut d.normals),
        ],
    );
    coloring(ui, &mut display.coloring);
    if display != *surface.display() {
        commands::change(lab, "Change display", |content| {
            commands::on_surface(content, |surface| surface.with_display(display))
        });
        return;
    }
    if display.coloring != SurfaceColoring::Plain {
        color_limit(lab, ui, object, display.color_limit);
    }
    ui.horizontal(|ui| {
        ui.label("Lines between knots");
        let field = NumberField::new("Lines between knots", display.isolines as f64).width(40.0);
        let field = field.drag(Drag::PerPixel(0.05)).check(line_count).show(ui, ("isolines", object.id));
        commands::apply(lab, field.event, "Change isolines", |content, count| {
            with(content, |display| display.isolines = count.round() as usize)
        });
    });
    ui.horizontal(|ui| {
        ui.label("Pieces between knots").on_hover_text("How fine the surface is drawn");
        let field = NumberField::new("Pieces between knots", display.density as f64).width(40.0);
        let field = field.drag(Drag::PerPixel(0.1)).check(piece_count).show(ui, ("density", object.id));
        commands::apply(lab, field.event, "Change fineness", |content, count| {
            with(content, |display| display.density = count.round() as usize)
        });
    });
}

fn with(
    content: &Content,
    change: impl FnOnce(&mut SurfaceDisplay),
) -> Result<Content, crate::document::EditError> {
    commands::on_surface(content, |surface| {
        let mut display = surface.display().clone();
        change(&mut display);
        surface.with_display(display)
    })
}

fn line_count(count: f64) -> Result<(), String> {
    if (0.0..=20.0).contains(&count) { Ok(()) } else { Err("between 0 and 20 lines".to_owned()) }
}

fn piece_count(count: f64) -> Result<(), String> {
    if (1.0..=100.0).contains(&count) { Ok(()) } else { Err("between 1 and 100 pieces".to_owned()) }
}
