//! What of the curve is shown.

use eframe::egui::{ComboBox, Grid, RichText, Ui};

use crate::app::command::Command;
use crate::app::command_state::key_text;
use crate::app::inspector::Subject;
use crate::app::lab::Lab;
use crate::app::number_field::{self, Drag, NumberField, positive};
use crate::document::{CurveDisplay, Edit, PointLabels};

/// A box: its words, the command that does the same, and what it switches.
type Choice = (&'static str, Option<Command>, fn(&mut CurveDisplay) -> &mut bool);

const SHAPE: &[Choice] = &[
    ("Control polygon", Some(Command::TogglePolygon), |display| &mut display.polygon),
    ("Control points", None, |display| &mut display.points),
    ("Knots", None, |display| &mut display.knots),
    ("Pieces in colours", None, |display| &mut display.pieces),
    ("Bezier points", Some(Command::ToggleBezierPoints), |display| &mut display.bezier_points),
    ("Blossom labels", Some(Command::ToggleBlossomLabels), |display| &mut display.blossom_labels),
    ("Distance tube", Some(Command::ToggleDistanceTube), |display| &mut display.distance_tube),
    ("Curvature comb", Some(Command::ToggleComb), |display| &mut display.comb),
];

const AT_T: &[Choice] = &[
    ("Construction at t", Some(Command::ToggleConstruction), |display| &mut display.construction),
    ("Convex hull at t", Some(Command::ToggleHull), |display| &mut display.hull),
    ("Frame at t", Some(Command::ToggleFrame), |display| &mut display.frame),
    ("Circle of curvature", Some(Command::ToggleCircle), |display| &mut display.osculating_circle),
    ("Hodograph", Some(Command::ToggleHodograph), |display| &mut display.hodograph),
];

const MEASURED: &[Choice] = &[
    ("Inflections", Some(Command::ToggleInflections), |display| &mut display.inflections),
    ("Curvature extrema", Some(Command::ToggleVertices), |display| &mut display.vertices),
    ("Symmetry", Some(Command::ToggleSymmetry), |display| &mut display.symmetry),
    ("Probe line", Some(Command::ToggleProbeLine), |display| &mut display.probe_line),
];

/// Shows the choices.
pub(super) fn show(lab: &mut Lab, ui: &mut Ui, subject: &Subject) {
    let object = subject.object;
    let mut display = subject.display.clone();
    boxes("shown of the shape", SHAPE, &mut display, ui);
    ui.label(RichText::new("At t").weak());
    boxes("shown at t", AT_T, &mut display, ui);
    ui.label(RichText::new("Measured").weak());
    boxes("shown as measured", MEASURED, &mut display, ui);
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

/// A box for each choice, two in a row, with what the command says and its key when the pointer rests on it.
fn boxes(salt: &str, choices: &[Choice], display: &mut CurveDisplay, ui: &mut Ui) {
    let half = (ui.available_width() - 8.0) * 0.5;
    Grid::new(salt).num_columns(2).min_col_width(half).spacing([8.0, 3.0]).show(ui, |ui| {
        for pair in choices.chunks(2) {
            for &(words, command, field) in pair {
                let response = ui.checkbox(field(display), words);
                if let Some(command) = command {
                    let key = key_text(command, ui.ctx()).map(|key| format!("  ({key})"));
                    response.on_hover_text(format!("{}{}", command.text().1, key.unwrap_or_default()));
                }
            }
            ui.end_row();
        }
    });
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
