//! What the canvas adds to the picture: handles, selection, and everything that lights up under the pointer.

use std::collections::BTreeSet;

use eframe::egui::{self, Align2, Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};
use glam::DVec2;

use crate::app::curves::weight_handles::{edge_end, ring_place, weight_points};
use crate::app::lab::{Hovered, Lab};
use crate::app::painter::{color32, paint_note, screen_from_world};
use crate::core::bspline::MAX_DEGREE;
use crate::core::spline_curve::Nurbs;
use crate::document::Object;
use crate::figure::composition::{Arrangement, short_number};
use crate::figure::picture::Viewport;

/// Above this many points the single handles are not announced to assistive programs.
const ANNOUNCED: usize = 200;

/// Above this many points of all curves together only those of the selected curve are announced.
const ANNOUNCED_IN_ALL: usize = 600;

/// The curve without the point `index` at the parameter where that point has most influence: the place it would pull
/// from, and what the weight bead needs: `r = (1 − s)·base + s·c` with `s = w b/(rest + w b)`.
struct Pull {
    base: DVec2,
    point: DVec2,
    /// `Σ wⱼ bⱼ` over the other points.
    rest: f64,
    /// `b` of this point.
    influence: f64,
}

fn pull(curve: &Nurbs<DVec2>, index: usize) -> Option<Pull> {
    let (left, right) = curve.space().parameter_interval();
    let weight = *curve.weights().get(index)?;
    let greville = curve.space().greville_abscissa(index);
    let parameter = if curve.space().is_periodic() { greville } else { greville.clamp(left, right) };
    let mut values = [0.0; MAX_DEGREE + 1];
    let values = &mut values[..=curve.degree()];
    let first = curve.space().write_active_basis(parameter, values).ok()?;
    // On a short closed curve the point may have several of them.
    let own = |&(j, _): &(usize, &f64)| curve.space().coefficient_index(first + j) == index;
    let influence: f64 = values.iter().enumerate().filter(own).map(|(_, value)| value).sum();
    let lifted = curve.homogeneous().evaluate(parameter).ok()?;
    let rest = lifted.z - weight * influence;
    let point = curve.points()[index];
    let numerator = lifted.truncate() - point * (weight * influence);
    // A point that the curve passes through (an end, an n-fold knot) cannot be weighed there.
    (influence > 1e-9 && rest > 1e-9 * lifted.z).then(|| Pull {
        base: numerator / rest,
        point,
        rest,
        influence,
    })
}

/// The selected point that has a weight bead, and where the bead is.
pub(super) fn bead_place(lab: &Lab, object: &Object) -> Option<(usize, DVec2)> {
    let index = *lab.selection.points.first()?;
    if lab.selection.points.len() != 1 || lab.selection.object != Some(object.id) {
        return None;
    }
    let curve = object.curve()?;
    let weight = *curve.weights().get(index)?;
    let pull = pull(curve, index)?;
    let share = weight * pull.influence / (pull.rest + weight * pull.influence);
    Some((index, pull.base + (pull.point - pull.base) * share))
}

/// The weight that brings the bead of point `index` as near as possible to `wanted`.
pub(super) fn weight_for_bead(curve: &Nurbs<DVec2>, index: usize, wanted: DVec2) -> Option<f64> {
    let pull = pull(curve, index)?;
    let ray = pull.point - pull.base;
    let share = (wanted - pull.base).dot(ray) / ray.length_squared();
    // From nearly no influence to nearly all of it; the ends themselves need weights 0 and ∞.
    let share = if share.is_finite() { share.clamp(0.01, 0.99) } else { return None };
    Some(share * pull.rest / (pull.influence * (1.0 - share)))
}

/// Paints handles and highlights of the selected object, and what is hovered anywhere. The ring of a weight has been dragged `along` so many pixels.
/// The note of the parameter stands where `labels` found room for it.
pub(super) fn paint(
    lab: &Lab,
    viewport: &Viewport,
    rect: Rect,
    painter: &Painter,
    along: f64,
    labels: &Arrangement,
) {
    let place = |world: DVec2| screen_from_world(viewport, rect, world);
    let selection = color32(lab.theme.selection);
    for object in lab.history.document().objects().iter().filter(|object| object.visible) {
        let Some(curve) = object.curve() else { continue };
        paint_hover(lab, object, curve, viewport, rect, painter);
        if lab.selection.object != Some(object.id) {
            continue;
        }
        for &point in &lab.selection.points {
            painter.circle(
                place(curve.points()[point]),
                7.5,
                selection.gamma_multiply(0.35),
                Stroke::new(2.0, selection),
            );
        }
        if let Some((index, bead)) = bead_place(lab, object) {
            paint_bead(lab, curve, index, place(bead), place(curve.points()[index]), painter);
        }
        if let Some((index, ring)) = ring_place(lab, object, viewport, along) {
            let bead = bead_place(lab, object).is_some();
            paint_ring(lab, curve, index, place(ring), place(curve.points()[index]), bead, painter);
        }
        let warning = color32(lab.theme.warning);
        for at in weight_points(lab, object) {
            let at = place(at);
            let side = |x: f32, y: f32| at + vec2(x, y);
            let corners = vec![side(0.0, -6.5), side(6.5, 0.0), side(0.0, 6.5), side(-6.5, 0.0)];
            let ground = color32(lab.theme.background);
            painter.add(Shape::convex_polygon(corners, ground, Stroke::new(2.0, warning)));
        }
        if lab.edit_points
            && let Ok(places) = curve.edit_points()
        {
            let accent = color32(lab.theme.accent);
            for at in places.into_iter().map(place).filter(|&at| rect.expand(10.0).contains(at)) {
                painter.circle(at, 6.0, color32(lab.theme.background), Stroke::new(2.0, accent));
                painter.circle_filled(at, 2.5, accent);
            }
        }
        if let Some(knot) = lab.selection.knot
            && let Ok(at) = curve.evaluate(knot)
        {
            painter.circle_stroke(place(at), 9.0, Stroke::new(2.0, selection));
        }
        if let Some(parameter) = lab.parameter(object.id)
            && let Ok(at) = curve.evaluate(parameter)
        {
            let shift = labels.notes.get(&object.id).copied().unwrap_or(DVec2::splat(10.0));
            paint_parameter(lab, parameter, place(at), shift, painter);
        }
    }
}

fn paint_bead(lab: &Lab, curve: &Nurbs<DVec2>, index: usize, bead: Pos2, point: Pos2, painter: &Painter) {
    let ink = color32(lab.theme.warning);
    painter.extend(Shape::dashed_line(&[bead, point], Stroke::new(1.0, ink.gamma_multiply(0.8)), 4.0, 3.0));
    painter.circle(bead, 5.5, color32(lab.theme.background), Stroke::new(2.5, ink));
    let text = format!("w = {}", short_number(curve.weights()[index]));
    let theme = &lab.theme;
    paint_note(
        painter,
        bead + vec2(12.0, 12.0),
        Align2::LEFT_TOP,
        &text,
        12.0 * theme.text_scale as f32,
        theme.text,
        theme.background,
    );
}

/// The ring, its ray, and the weight where no bead shows it.
fn paint_ring(
    lab: &Lab,
    curve: &Nurbs<DVec2>,
    index: usize,
    ring: Pos2,
    point: Pos2,
    has_bead: bool,
    painter: &Painter,
) {
    let ink = color32(lab.theme.warning);
    let way = (ring - point).normalized();
    painter.line_segment([point + way * 8.0, ring - way * 6.0], Stroke::new(1.5, ink.gamma_multiply(0.8)));
    painter.circle_stroke(ring, 6.0, Stroke::new(2.5, ink));
    if !has_bead {
        let text = format!("w = {}", short_number(curve.weights()[index]));
        let (theme, size) = (&lab.theme, 12.0 * lab.theme.text_scale as f32);
        let at = ring + vec2(12.0, 0.0);
        paint_note(painter, at, Align2::LEFT_CENTER, &text, size, theme.text, theme.background);
    }
}

/// The handle of the parameter, and its note with its lower left corner at `shift` (pt, y up).
fn paint_parameter(lab: &Lab, parameter: f64, at: Pos2, shift: DVec2, painter: &Painter) {
    let marker = Rect::from_center_size(at, vec2(11.0, 11.0));
    painter.rect(
        marker,
        2.0,
        color32(lab.theme.accent),
        Stroke::new(1.5, color32(lab.theme.background)),
        egui::StrokeKind::Outside,
    );
    let text = format!("t = {}", short_number(parameter));
    let theme = &lab.theme;
    paint_note(
        painter,
        at + vec2(shift.x as f32, -shift.y as f32),
        Align2::LEFT_BOTTOM,
        &text,
        12.0 * theme.text_scale as f32,
        theme.text,
        theme.background,
    );
}

fn paint_hover(
    lab: &Lab,
    object: &Object,
    curve: &Nurbs<DVec2>,
    viewport: &Viewport,
    rect: Rect,
    painter: &Painter,
) {
    let place = |world: DVec2| screen_from_world(viewport, rect, world);
    let glow = color32(lab.theme.selection);
    match lab.hovered {
        Hovered::Point(id, point) if id == object.id && point < curve.points().len() => {
            let (from, to) = curve.space().support(point);
            paint_part(curve, from, to, glow.gamma_multiply(0.35), viewport, rect, painter);
            painter.circle_stroke(place(curve.points()[point]), 9.0, Stroke::new(2.5, glow));
        }
        Hovered::Knot(id, value) if id == object.id => {
            if let Ok(at) = curve.evaluate(value) {
                painter.circle_stroke(place(at), 9.0, Stroke::new(2.5, glow));
            }
        }
        Hovered::Curve(id, parameter) if id == object.id => {
            if let Ok(scheme) = curve.de_boor_scheme(parameter) {
                let knots = curve.space().evaluation_knots();
                let (from, to) = (knots[scheme.span], knots[scheme.span + 1]);
                paint_part(curve, from, to, glow.gamma_multiply(0.35), viewport, rect, painter);
                let active: BTreeSet<usize> = scheme.coefficients.into_iter().collect();
                for point in active {
                    painter.circle_stroke(place(curve.points()[point]), 8.0, Stroke::new(1.5, glow));
                }
            }
            if let Ok(at) = curve.evaluate(parameter) {
                painter.circle(at_screen(at, viewport, rect), 3.5, glow, Stroke::NONE);
            }
        }
        Hovered::Entry(id, level, position) if id == object.id => {
            let entry = lab.scheme().and_then(|stepper| stepper.entry(level, position).cloned());
            if let Some(at) = entry.as_ref().and_then(|entry| entry.at) {
                painter.circle_stroke(place(at), 10.0, Stroke::new(2.5, glow));
            }
            for point in entry.into_iter().flat_map(|entry| entry.partners) {
                if let Some(&at) = curve.points().get(point) {
                    painter.circle_stroke(place(at), 8.0, Stroke::new(1.5, glow.gamma_multiply(0.7)));
                }
            }
        }
        _ => {}
    }
}

fn at_screen(world: DVec2, viewport: &Viewport, rect: Rect) -> Pos2 {
    screen_from_world(viewport, rect, world)
}

/// A broad line under the part of the curve over `[from, to]`.
fn paint_part(
    curve: &Nurbs<DVec2>,
    from: f64,
    to: f64,
    ink: Color32,
    viewport: &Viewport,
    rect: Rect,
    painter: &Painter,
) {
    let (left, right) = curve.space().parameter_interval();
    let (from, to) = if curve.space().is_periodic() {
        (from, to.min(from + right - left))
    } else {
        (from.max(left), to.min(right))
    };
    let steps = 96;
    let point = |step: i32| {
        let parameter = from + (to - from) * f64::from(step) / f64::from(steps);
        curve.evaluate(parameter).ok().map(|at| screen_from_world(viewport, rect, at))
    };
    let line: Vec<Pos2> = (0..=steps).filter_map(point).collect();
    painter.add(Shape::line(line, Stroke::new(8.0, ink)));
}

/// Tells assistive programs (and tests) what can be dragged.
pub(super) fn announce(named: Vec<(String, DVec2)>, viewport: &Viewport, rect: Rect, ui: &egui::Ui) {
    let reach = vec2(18.0, 18.0);
    for (name, at) in named {
        let area = Rect::from_center_size(screen_from_world(viewport, rect, at), reach);
        if rect.contains_rect(area) {
            let id = ui.make_persistent_id(("handle", &name));
            let response = ui.interact(area, id, egui::Sense::hover());
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        }
    }
}

/// The handles of the visible curves: accessible name and place in the world.
pub(super) fn named(lab: &Lab, viewport: &Viewport) -> Vec<(String, DVec2)> {
    let mut named = Vec::new();
    let objects = lab.history.document().objects();
    let visible = || objects.iter().filter(|object| object.visible);
    let in_all: usize = visible().filter_map(|object| object.curve()).map(|curve| curve.points().len()).sum();
    for object in visible() {
        let Some(curve) = object.curve() else { continue };
        let is_one_of_few = in_all <= ANNOUNCED_IN_ALL || lab.selection.object == Some(object.id);
        if curve.points().len() <= ANNOUNCED && is_one_of_few {
            let points = curve.points().iter().enumerate();
            named
                .extend(points.map(|(index, &at)| (format!("Control point {index} of {}", object.name), at)));
        }
        if lab.selection.object == Some(object.id) {
            let ring = ring_place(lab, object, viewport, 0.0);
            named.extend(
                ring.map(|(index, at)| {
                    (format!("Weight ring of control point {index} of {}", object.name), at)
                }),
            );
            let count = curve.points().len();
            if count <= ANNOUNCED {
                let edges = weight_points(lab, object).into_iter().enumerate();
                named.extend(edges.map(|(k, at)| {
                    (format!("Weight point {k} to {} of {}", edge_end(curve, k), object.name), at)
                }));
                if let Some(places) = lab.edit_points.then(|| curve.edit_points().ok()).flatten() {
                    let places = places.into_iter().enumerate();
                    named.extend(places.map(|(k, at)| (format!("Edit point {k} of {}", object.name), at)));
                }
            }
            let parameter = lab.parameter(object.id).and_then(|parameter| curve.evaluate(parameter).ok());
            named.extend(parameter.map(|at| (format!("Parameter of {}", object.name), at)));
            let bead = bead_place(lab, object);
            named.extend(
                bead.map(|(index, at)| (format!("Weight of control point {index} of {}", object.name), at)),
            );
        }
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::bspline::SplineSpace;

    #[test]
    fn the_bead_sits_on_the_curve_and_gives_the_weight_back() {
        let space = SplineSpace::new(3, vec![-1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0, 4.0]).unwrap();
        let points = [(0.0, 0.0), (1.0, 3.0), (3.0, 3.0), (4.0, -1.0), (6.0, 0.0), (7.0, 2.0)];
        let points = points.map(|(x, y)| DVec2::new(x, y)).to_vec();
        let curve = Nurbs::new(space, points, vec![1.0, 2.0, 0.5, 3.0, 1.0, 1.0]).unwrap();
        for index in 1..5 {
            let found = pull(&curve, index).unwrap();
            let share = curve.weights()[index] * found.influence
                / (found.rest + curve.weights()[index] * found.influence);
            let bead = found.base + (found.point - found.base) * share;
            let greville = curve.space().greville_abscissae()[index];
            let on_curve = curve.evaluate(greville).unwrap();
            assert!(bead.distance(on_curve) < 1e-12, "point {index}: {bead} is not {on_curve}");
            let weight = weight_for_bead(&curve, index, bead).unwrap();
            assert!((weight - curve.weights()[index]).abs() < 1e-10, "point {index}: weight {weight}");
        }
    }
}
