//! What is seen while a curve is drawn: the points, the curve they would make, and its size beside the pointer.

use eframe::egui::{Modifiers, Painter, Pos2, Rect, Shape, Stroke};
use glam::DVec2;

use crate::app::curves::draw_shapes::{circle_through, conic_weight, construct, half_axes, shoulder};
use crate::app::curves::draw_tool::{CLOSING_REACH, Drawing};
use crate::app::hands::DEAD_ZONE;
use crate::app::lab::{DrawMode, Lab};
use crate::app::painter::{color32, paint_note_at_pointer, screen_from_world};
use crate::core::spline_curve::Nurbs;
use crate::figure::composition::short_number;
use crate::figure::picture::Viewport;

impl Drawing {
    /// The points so far, the curve they would make with the one under the pointer, and its size.
    pub(super) fn paint(
        &self,
        pointer: Option<Pos2>,
        lab: &Lab,
        viewport: &Viewport,
        rect: Rect,
        painter: &Painter,
        keys: Modifiers,
    ) {
        let (ink, thin) = (color32(lab.theme.accent), Stroke::new(1.0, color32(lab.theme.muted_text)));
        let on_screen = |world: DVec2| screen_from_world(viewport, rect, world);
        if !self.stroke.is_empty() && self.pressed.is_some() && self.mode == DrawMode::Stroke {
            let line = self.stroke.iter().map(|&at| on_screen(at)).collect();
            painter.add(Shape::line(line, Stroke::new(2.5, ink)));
            return;
        }
        let mut places = self.points.clone();
        if let (Some(pressed), Some(needed)) = (self.pressed, self.mode.clicks())
            && places.len() + 2 <= needed
            && pointer.is_some_and(|pointer| pointer.distance(pressed) >= DEAD_ZONE)
        {
            places.push(self.place(pressed, viewport, rect, keys));
        }
        let clicked = places.len();
        if let Some(pointer) = pointer.filter(|_| self.mode != DrawMode::Stroke) {
            let with_pressed = Self::of(self.mode, places.clone());
            places.push(with_pressed.place(pointer, viewport, rect, keys));
        }
        let closing = self.mode.clicks().is_none()
            && self.points.len() >= 3
            && pointer.is_some_and(|pointer| on_screen(self.points[0]).distance(pointer) <= CLOSING_REACH);
        if closing {
            places.pop();
        }
        let curves = if places.len() >= 2 { construct(self.mode, &places, closing) } else { Ok(Vec::new()) };
        for curve in curves.iter().flatten() {
            painter
                .add(Shape::line(samples(curve).into_iter().map(on_screen).collect(), Stroke::new(2.5, ink)));
        }
        let help: Vec<Pos2> = match (self.mode, &places[..]) {
            (DrawMode::Arc, &[start, way]) => [start, way].map(on_screen).to_vec(),
            (DrawMode::Through | DrawMode::Arc | DrawMode::ConicFive, _) => Vec::new(),
            (DrawMode::Ellipse, &[center, first, second]) => {
                let (u, v) = half_axes(center, first, second);
                [center + u, center, center + v].map(on_screen).to_vec()
            }
            (DrawMode::Conic, &[start, middle, end, place]) => {
                let at = shoulder([start, middle, end], conic_weight([start, middle, end], place));
                painter.circle_filled(on_screen(at), 4.0, ink);
                [start, middle, end].map(on_screen).to_vec()
            }
            _ => places.iter().map(|&at| on_screen(at)).collect(),
        };
        painter.add(Shape::line(help, thin));
        for (index, &place) in places.iter().enumerate().take(clicked) {
            let radius = if index == 0 && self.mode.clicks().is_none() { 6.0 } else { 4.5 };
            painter.circle(on_screen(place), radius, color32(lab.theme.background), Stroke::new(2.0, ink));
        }
        if let Some(pointer) = pointer {
            let note = if self.typed.is_empty() {
                self.size_note(&places)
            } else {
                Some(format!("{}|", self.typed))
            };
            if let Some(note) = note {
                paint_note_at_pointer(painter, pointer, rect, &note, &lab.theme);
            }
        }
    }

    /// The size of what is being drawn.
    fn size_note(&self, places: &[DVec2]) -> Option<String> {
        let number = short_number;
        let &place = places.last()?;
        let length = |from: DVec2| number(place.distance(from));
        Some(match (self.mode, places) {
            (DrawMode::Circle, &[center, _]) => format!("r = {}", length(center)),
            (DrawMode::Ellipse, &[center, _]) => format!("a = {}", length(center)),
            (DrawMode::Ellipse, &[center, first, second]) => {
                let (u, v) = half_axes(center, first, second);
                format!("a = {}, b = {}", number(u.length()), number(v.length()))
            }
            (DrawMode::Arc, &[start, way, end]) => match circle_through(start, way, end) {
                Some((_, radius)) => format!("r = {}", number(radius)),
                None => "on one line".to_owned(),
            },
            (DrawMode::Conic, &[start, middle, end, at]) => {
                let weight = conic_weight([start, middle, end], at);
                let kind = match weight {
                    w if (w - 1.0).abs() < 0.005 => "parabola",
                    w if w < 1.0 => "ellipse",
                    _ => "hyperbola",
                };
                format!("w = {}, {kind}", number(weight))
            }
            (_, &[.., before, _]) => {
                format!("{}; {}   length {}", number(place.x), number(place.y), length(before))
            }
            _ => format!("{}; {}", number(place.x), number(place.y)),
        })
    }
}

/// Points of the curve, close enough for a preview.
fn samples(curve: &Nurbs<DVec2>) -> Vec<DVec2> {
    let breaks = curve.space().breaks();
    let steps = (4000 / breaks.len()).clamp(2, 32);
    let mut line = Vec::with_capacity(breaks.len() * steps);
    for ends in breaks.windows(2) {
        let at = |step: usize| ends[0] + (ends[1] - ends[0]) * step as f64 / steps as f64;
        line.extend((0..steps).filter_map(|step| curve.evaluate(at(step)).ok()));
    }
    line.extend(breaks.last().and_then(|&end| curve.evaluate(end).ok()));
    line
}
