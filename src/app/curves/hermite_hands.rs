//! Hands on the ends of geometric Hermite interpolation: point, direction and curvature of both ends.

use eframe::egui::{self, Align2, Painter, Pos2, Rect, Stroke, StrokeKind, Ui, vec2};
use glam::DVec2;

use crate::app::hands;
use crate::app::lab::{Lab, Tool};
use crate::app::painter::{color32, paint_note, screen_from_world, world_from_screen};
use crate::app::side_rooms::{End, Hermite, SideRoom};
use crate::figure::composition::short_number;
use crate::figure::picture::Viewport;

/// Distance in pt up to which a handle is under the pointer.
const REACH: f32 = 9.0;
/// Distance in pt from a point to the handle of its direction.
const ARM: f64 = 78.0;
/// Share of the arm where the handle of the curvature stands.
const ELBOW: f64 = 0.55;
/// How far the curvature 1 over the chord bends the arm, in pt.
const BEND: f64 = 14.0;
/// With Shift directions turn to multiples of this angle, in degrees.
const ANGLE_STEP: f64 = 15.0;

/// A handle of an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Grip {
    Direction,
    Curvature,
    Point,
}

impl Grip {
    /// Those that are found first lie on top.
    const ALL: [Self; 3] = [Self::Direction, Self::Curvature, Self::Point];

    fn label(self, end: usize) -> String {
        let name = match self {
            Self::Direction => "Direction",
            Self::Curvature => "Curvature",
            Self::Point => "Point",
        };
        format!("{name} handle of the {}", ["start", "end"][end])
    }
}

/// The hands.
#[derive(Debug, Default)]
pub(super) struct HermiteHands {
    held: Option<(usize, Grip)>,
}

impl HermiteHands {
    /// Drags a handle; whether the pointer is taken by it.
    pub(super) fn drag(
        &mut self,
        lab: &mut Lab,
        response: &egui::Response,
        viewport: &Viewport,
        rect: Rect,
        ui: &Ui,
    ) -> bool {
        let Some(mut hermite) = shown(lab) else {
            self.held = None;
            return false;
        };
        let (down, pointer, keys) =
            ui.input(|input| (input.pointer.primary_down(), input.pointer.latest_pos(), input.modifiers));
        if let Some(at) = hands::pressed_at(ui).filter(|at| rect.contains(*at) && response.contains_pointer())
        {
            let near = |&(end, grip): &(usize, Grip)| {
                place(&hermite, end, grip, viewport, rect).distance(at) <= REACH
            };
            self.held = all().find(near);
        }
        let Some(((index, grip), pointer)) = self.held.zip(pointer) else { return false };
        if !down {
            self.held = None;
        }
        let world = world_from_screen(viewport, rect, pointer);
        let bend = bend(&hermite, viewport);
        let end = &mut hermite.ends[index];
        let way = world - end.point;
        match grip {
            Grip::Point => {
                end.point +=
                    hands::constrained(way, end.point, viewport, egui::Modifiers { shift: false, ..keys });
            }
            Grip::Direction if way.length() > 0.0 => {
                let angle = way.to_angle().to_degrees();
                end.angle = if keys.shift { (angle / ANGLE_STEP).round() * ANGLE_STEP } else { angle };
            }
            Grip::Curvature if bend > 0.0 => {
                let across = way.dot(end.direction().perp());
                // Close to the arm the curvature is held at 0.
                end.curvature = if across.abs() * viewport.scale < 2.0 { 0.0 } else { across / bend };
            }
            Grip::Direction | Grip::Curvature => {}
        }
        lab.rooms.hermite = Some(hermite);
        true
    }

    /// Shows the handles.
    pub(super) fn paint(&self, lab: &Lab, viewport: &Viewport, rect: Rect, painter: &Painter, ui: &Ui) {
        let Some(hermite) = shown(lab) else { return };
        let (ink, ground) = (color32(lab.theme.text), color32(lab.theme.background));
        for (index, grip) in all().collect::<Vec<_>>().into_iter().rev() {
            let at = place(&hermite, index, grip, viewport, rect);
            let from = place(&hermite, index, Grip::Point, viewport, rect);
            let stroke = Stroke::new(if self.held == Some((index, grip)) { 3.0 } else { 1.8 }, ink);
            match grip {
                Grip::Point => {
                    let body = Rect::from_center_size(at, vec2(9.0, 9.0));
                    painter.rect(body, 1.0, ground, stroke, StrokeKind::Middle);
                }
                Grip::Direction => {
                    painter.line_segment([from + (at - from) * 0.08, at], Stroke::new(1.4, ink));
                    painter.circle(at, 5.0, ground, stroke);
                }
                Grip::Curvature => {
                    let elbow = from
                        + (place(&hermite, index, Grip::Direction, viewport, rect) - from) * ELBOW as f32;
                    let warning = color32(lab.theme.warning);
                    painter.line_segment([elbow, at], Stroke::new(1.2, warning));
                    let corners = [vec2(0.0, -6.0), vec2(6.0, 0.0), vec2(0.0, 6.0), vec2(-6.0, 0.0)];
                    let corners = corners.map(|corner| at + corner).to_vec();
                    painter.add(egui::Shape::convex_polygon(
                        corners,
                        ground,
                        Stroke::new(stroke.width, warning),
                    ));
                }
            }
            let area = Rect::from_center_size(at, vec2(2.0 * REACH, 2.0 * REACH));
            if rect.contains_rect(area) {
                let label = grip.label(index);
                let response =
                    ui.interact(area, ui.make_persistent_id(("handle", &label)), egui::Sense::hover());
                response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
            }
        }
        if let Some((index, grip)) = self.held {
            let end = &hermite.ends[index];
            let text = match grip {
                Grip::Point => format!("{}; {}", short_number(end.point.x), short_number(end.point.y)),
                Grip::Direction => format!("{}\u{b0}", short_number(end.angle)),
                Grip::Curvature => format!("\u{3ba} = {}", short_number(end.curvature)),
            };
            let at = place(&hermite, index, grip, viewport, rect) + vec2(14.0, 14.0);
            let (theme, size) = (&lab.theme, 12.0 * lab.theme.text_scale as f32);
            paint_note(painter, at, Align2::LEFT_TOP, &text, size, theme.text, theme.background);
        }
    }
}

fn shown(lab: &Lab) -> Option<Hermite> {
    lab.rooms.hermite.filter(|_| lab.rooms.shows(SideRoom::Hermite) && lab.tool == Tool::Select)
}

fn all() -> impl Iterator<Item = (usize, Grip)> {
    Grip::ALL.into_iter().flat_map(|grip| [(0, grip), (1, grip)])
}

/// Way across the arm in the world for the curvature 1.
fn bend(hermite: &Hermite, viewport: &Viewport) -> f64 {
    let [start, end] = hermite.ends;
    BEND * start.point.distance(end.point) / viewport.scale
}

fn place(hermite: &Hermite, index: usize, grip: Grip, viewport: &Viewport, rect: Rect) -> Pos2 {
    let end: &End = &hermite.ends[index];
    let arm = end.direction() * (ARM / viewport.scale);
    let at: DVec2 = match grip {
        Grip::Point => end.point,
        Grip::Direction => end.point + arm,
        Grip::Curvature => {
            end.point + arm * ELBOW + end.direction().perp() * (end.curvature * bend(hermite, viewport))
        }
    };
    screen_from_world(viewport, rect, at)
}
