//! Hands on what the stepper draws: its points light up under the pointer, and the line of the intersection can be dragged.

use eframe::egui::{self, Painter, Pos2, Rect, Stroke, StrokeKind, Ui, vec2};
use glam::DVec2;

use crate::app::curves::hit::Target;
use crate::app::hands;
use crate::app::lab::{Hovered, Lab, Tool};
use crate::app::painter::{color32, screen_from_world, world_from_screen};
use crate::course::stepper::default_line;
use crate::document::{StepperKind, StepperLine};
use crate::figure::picture::Viewport;

/// Distance in pt up to which a handle or a point is under the pointer.
const REACH: f32 = 9.0;
/// Distance in pt from the handle that moves the line to the one that turns it.
const ARM: f64 = 110.0;
/// With Shift the line turns to multiples of this angle, in degrees.
const ANGLE_STEP: f64 = 15.0;

/// A handle of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Grip {
    /// Moves it.
    Through,
    /// Turns it.
    Direction,
}

impl Grip {
    const ALL: [Self; 2] = [Self::Through, Self::Direction];

    const fn label(self) -> &'static str {
        match self {
            Self::Through => "Point of the line",
            Self::Direction => "Direction of the line",
        }
    }
}

/// The hands on the drawing of the stepper.
#[derive(Debug, Default)]
pub(super) struct StepHands {
    held: Option<Grip>,
}

impl StepHands {
    /// Drags the line; whether the pointer is taken by it.
    pub(super) fn drag(
        &mut self,
        lab: &mut Lab,
        response: &egui::Response,
        viewport: &Viewport,
        rect: Rect,
        ui: &Ui,
    ) -> bool {
        let Some(line) = line(lab) else {
            self.held = None;
            return false;
        };
        let (down, pointer, shift) = ui
            .input(|input| (input.pointer.primary_down(), input.pointer.latest_pos(), input.modifiers.shift));
        if let Some(at) = hands::pressed_at(ui).filter(|at| rect.contains(*at) && response.contains_pointer())
        {
            let near = |grip: &Grip| place(&line, *grip, viewport, rect).distance(at) <= REACH;
            self.held = Grip::ALL.into_iter().find(near);
        }
        let Some((grip, pointer)) = self.held.zip(pointer) else { return false };
        let world = world_from_screen(viewport, rect, pointer);
        let dragged = match grip {
            Grip::Through => StepperLine { through: world, ..line },
            Grip::Direction => {
                let angle = (world - line.through).to_angle().to_degrees();
                let angle = if shift { (angle / ANGLE_STEP).round() * ANGLE_STEP } else { angle };
                StepperLine { angle: angle.rem_euclid(360.0), ..line }
            }
        };
        if dragged.through.is_finite() && dragged.angle.is_finite() && dragged != line {
            lab.view.stepper_choices.line = Some(dragged);
        }
        if !down {
            self.held = None;
        }
        true
    }

    /// Shows the handles of the line.
    pub(super) fn paint(&self, lab: &Lab, viewport: &Viewport, rect: Rect, painter: &Painter, ui: &Ui) {
        let Some(line) = line(lab) else { return };
        let (ink, ground) = (color32(lab.theme.text), color32(lab.theme.background));
        for grip in Grip::ALL {
            let at = place(&line, grip, viewport, rect);
            let stroke = Stroke::new(if self.held == Some(grip) { 3.0 } else { 1.8 }, ink);
            match grip {
                Grip::Through => {
                    let body = Rect::from_center_size(at, vec2(9.0, 9.0));
                    painter.rect(body, 1.0, ground, stroke, StrokeKind::Middle);
                }
                Grip::Direction => {
                    painter.circle(at, 5.0, ground, stroke);
                }
            }
            let area = Rect::from_center_size(at, vec2(2.0 * REACH, 2.0 * REACH));
            if rect.contains_rect(area) {
                let id = ui.make_persistent_id(("handle", grip.label()));
                let response = ui.interact(area, id, egui::Sense::hover());
                response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, grip.label()));
            }
        }
    }
}

/// The line, while the stepper shows its intersection.
fn line(lab: &Lab) -> Option<StepperLine> {
    let shown = lab.stepper.open && lab.view.stepper == StepperKind::Intersection && lab.tool == Tool::Select;
    let curve = lab.curve().filter(|_| shown)?;
    Some(lab.view.stepper_choices.line.unwrap_or_else(|| default_line(curve)))
}

fn place(line: &StepperLine, grip: Grip, viewport: &Viewport, rect: Rect) -> Pos2 {
    let world = match grip {
        Grip::Through => line.through,
        Grip::Direction => line.through + line.direction() * (ARM / viewport.scale),
    };
    screen_from_world(viewport, rect, world)
}

/// A point of the present frame under the pointer lights up everywhere, unless something to drag lies there.
pub(super) fn hover(lab: &mut Lab, target: Target, pointer: Option<Pos2>, viewport: &Viewport, rect: Rect) {
    let free = matches!(target, Target::Nothing | Target::Curve(..));
    let (Some(pointer), Some(object)) = (pointer, lab.selection.object) else { return };
    if !(free && lab.stepper.open) {
        return;
    }
    let Some(stepper) = lab.scheme() else { return };
    let distance = |at: DVec2| screen_from_world(viewport, rect, at).distance(pointer);
    let shown = stepper.revealed(lab.stepper.frame);
    let entries = shown.iter().filter_map(|&(level, position)| stepper.entry(level, position));
    let near = entries.filter(|entry| entry.is_drawn).filter_map(|entry| Some((entry, distance(entry.at?))));
    let nearest = near.filter(|&(_, far)| far <= REACH).min_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((entry, _)) = nearest {
        lab.hovering = Hovered::Entry(object, entry.level, entry.position);
        lab.entry_partners.clone_from(&entry.partners);
    }
}
