//! The small window for operations that need numbers: trim, transform, offset.

use eframe::egui::{Align2, Button, Grid, Ui, Window, vec2};
use glam::DVec2;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::number_field::{Drag, NumberEvent, NumberField, positive};
use crate::core::spline_curve::Nurbs;
use crate::document::{CurveMap, Edit};

/// How lengths and parameters are dragged.
const LENGTH: Drag = Drag::PerPixel(0.01);

/// Which operation is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Trim,
    Transform,
    Offset,
}

/// Which map of the curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Map {
    #[default]
    Move,
    Rotate,
    Scale,
    Mirror,
}

/// The window and its numbers, which it remembers.
#[derive(Debug)]
pub(super) struct OperationForm {
    open: Option<Kind>,
    from: f64,
    to: f64,
    map: Map,
    by: DVec2,
    degrees: f64,
    factors: DVec2,
    about: DVec2,
    distance: f64,
    tolerance: f64,
}

impl Default for OperationForm {
    fn default() -> Self {
        Self {
            open: None,
            from: 0.0,
            to: 1.0,
            map: Map::Move,
            by: DVec2::X,
            degrees: 90.0,
            factors: DVec2::splat(2.0),
            about: DVec2::ZERO,
            distance: 0.5,
            tolerance: 1e-4,
        }
    }
}

impl OperationForm {
    /// Opens the window if `command` asks for it.
    pub(super) fn open(&mut self, command: Command, lab: &Lab) -> bool {
        let kind = match command {
            Command::Trim => Kind::Trim,
            Command::TransformCurve => Kind::Transform,
            Command::OffsetCurve => Kind::Offset,
            _ => return false,
        };
        let Some(curve) = lab.curve() else { return true };
        (self.from, self.to) = curve.space().parameter_interval();
        self.about = middle(curve);
        self.open = Some(kind);
        true
    }

    /// Closes the window; whether it was open.
    pub(super) fn close(&mut self) -> bool {
        self.open.take().is_some()
    }

    /// Shows the window in the corner of the canvas.
    pub(super) fn show(&mut self, lab: &mut Lab, ui: &Ui) {
        let Some(kind) = self.open else { return };
        if lab.curve().is_none() {
            self.open = None;
            return;
        }
        let title = match kind {
            Kind::Trim => "Trim curve",
            Kind::Transform => "Transform curve",
            Kind::Offset => "Offset curve",
        };
        let mut open = true;
        let mut wanted = None;
        Window::new(title)
            .id(eframe::egui::Id::unique(title))
            .open(&mut open)
            .collapsible(false)
            .auto_sized()
            .pivot(Align2::LEFT_TOP)
            .default_pos(ui.max_rect().left_top() + vec2(16.0, 44.0))
            .show(ui.ctx(), |ui| {
                if kind == Kind::Transform {
                    ui.horizontal(|ui| {
                        for (map, text) in [
                            (Map::Move, "Move"),
                            (Map::Rotate, "Rotate"),
                            (Map::Scale, "Scale"),
                            (Map::Mirror, "Mirror"),
                        ] {
                            ui.selectable_value(&mut self.map, map, text);
                        }
                    });
                }
                Grid::new(("numbers", title)).num_columns(2).show(ui, |ui| self.numbers(kind, ui));
                if let Some(hint) = self.hint(kind) {
                    ui.weak(hint);
                }
                ui.horizontal(|ui| {
                    if ui.add(Button::new("Apply")).clicked() {
                        wanted = self.edit(kind, lab);
                    }
                    if ui.button("Close").clicked() {
                        self.open = None;
                    }
                });
            });
        if !open {
            self.open = None;
        }
        if let Some(edit) = wanted
            && lab.edit(edit).is_some()
            && kind != Kind::Transform
        {
            self.open = None;
        }
    }

    fn numbers(&mut self, kind: Kind, ui: &mut Ui) {
        let any = |_| Ok(());
        match (kind, self.map) {
            (Kind::Trim, _) => {
                number("From t", &mut self.from, any, LENGTH, ui);
                number("To t", &mut self.to, any, LENGTH, ui);
            }
            (Kind::Offset, _) => {
                number("Distance", &mut self.distance, any, LENGTH, ui);
                number("Tolerance", &mut self.tolerance, positive, Drag::Factor, ui);
            }
            (Kind::Transform, Map::Move) => {
                number("Move x by", &mut self.by.x, any, LENGTH, ui);
                number("Move y by", &mut self.by.y, any, LENGTH, ui);
            }
            (Kind::Transform, map) => {
                if map == Map::Scale {
                    number("Factor in x", &mut self.factors.x, not_zero, Drag::Factor, ui);
                    number("Factor in y", &mut self.factors.y, not_zero, Drag::Factor, ui);
                } else {
                    number("Degrees", &mut self.degrees, any, Drag::PerPixel(1.0), ui);
                }
                let [x, y] = match map {
                    Map::Mirror => ["Line through x", "Line through y"],
                    _ => ["Centre x", "Centre y"],
                };
                number(x, &mut self.about.x, any, LENGTH, ui);
                number(y, &mut self.about.y, any, LENGTH, ui);
            }
        }
    }

    fn hint(&self, kind: Kind) -> Option<&'static str> {
        match (kind, self.map) {
            (Kind::Offset, _) => Some("Positive: to the left of the direction.\nThe original stays."),
            (Kind::Transform, Map::Rotate) => Some("Counterclockwise."),
            (Kind::Transform, Map::Mirror) => Some("0°: a horizontal line, 90°: a vertical one."),
            _ => None,
        }
    }

    fn edit(&self, kind: Kind, lab: &Lab) -> Option<Edit> {
        let object = lab.selection.object?;
        let map = match self.map {
            Map::Move => CurveMap::Move { by: self.by },
            Map::Rotate => CurveMap::Rotate { degrees: self.degrees, about: self.about },
            Map::Scale => CurveMap::Scale { factors: self.factors, about: self.about },
            Map::Mirror => CurveMap::Mirror { degrees: self.degrees, through: self.about },
        };
        Some(match kind {
            Kind::Trim => Edit::TrimCurve { object, from: self.from, to: self.to },
            Kind::Transform => Edit::TransformCurve { object, map },
            Kind::Offset => Edit::OffsetCurve { object, distance: self.distance, tolerance: self.tolerance },
        })
    }
}

fn number(label: &str, value: &mut f64, check: fn(f64) -> Result<(), String>, drag: Drag, ui: &mut Ui) {
    ui.label(label);
    let event = NumberField::new(label, *value).width(90.0).check(check).drag(drag).show(ui, label).event;
    if let Some(NumberEvent::Typed { to, .. } | NumberEvent::Dragged { to, .. }) = event {
        *value = to;
    }
    ui.end_row();
}

fn not_zero(value: f64) -> Result<(), String> {
    if value == 0.0 { Err("0 would flatten the curve".to_owned()) } else { Ok(()) }
}

/// The middle of the control points' box.
fn middle(curve: &Nurbs<DVec2>) -> DVec2 {
    let points = curve.points();
    let (low, high) = points.iter().fold((points[0], points[0]), |(low, high), &p| (low.min(p), high.max(p)));
    low.midpoint(high)
}
