//! The picture of a document: what the canvas shows and the exporters write.
//!
//! Layers from back to front: the grid, then for every visible object comb, hull, polygon, curve, construction, knots,
//! points and labels, each in a layer named after the object.

mod construction;
mod crowd;
mod curve_layers;
mod labels;
mod looks;
mod marks;
mod measured;
mod probe;

use std::sync::Arc;

use glam::DVec2;

use crate::core::spline_curve::Nurbs;
use crate::document::{Content, CurveDisplay, Document, Object, ObjectId, View};
use crate::figure::composition::crowd::Crowd;
use crate::figure::picture::{Picture, Viewport};
use crate::figure::theme::Theme;
use crate::figure::ticks::{grid_labels, grid_lines};

pub use construction::{StepDot, StepDrawing, StepInk, StepLine, construction_items};
pub use crowd::left_out;
pub use curve_layers::short_number;
pub use labels::{Arrangement, LabelMemory};
pub use looks::MANY_FOR_LOOKS;
pub use marks::{MarkNote, marks_near};
pub use measured::Measurements;
pub use probe::{Probe, probe, probe_ends};

/// Name of the entry of [`View::panels`] that says whether the grid is drawn; it is if there is no entry.
pub const GRID: &str = "grid";

/// What is drawn beside what the document says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Composition {
    /// The object on which an algorithm is being stepped through, and its present step, drawn instead of de Boor's construction.
    pub step: Option<(ObjectId, StepDrawing)>,
    /// Whether the ground is left clear.
    pub transparent: bool,
    /// The curve whose parameter has a handle and a note, for which room is kept; if `None` the selected one of the view.
    pub handle: Option<ObjectId>,
    /// Where labels stood, so that they do not jump while something is dragged.
    pub former: LabelMemory,
}

/// The picture of all visible curves of `document` for `viewport`.
pub fn compose(document: &Document, view: &View, theme: &Theme, viewport: &Viewport) -> Picture {
    compose_with(document, view, theme, viewport, &Composition::default(), &Measurements::default())
}

/// As [`compose`], with choices; what was measured before in `measurements` is not measured again.
pub fn compose_with(
    document: &Document,
    view: &View,
    theme: &Theme,
    viewport: &Viewport,
    choices: &Composition,
    measurements: &Measurements,
) -> Picture {
    compose_arranged(document, view, theme, viewport, choices, measurements).0
}

/// As [`compose_with`], and what became of the labels.
pub fn compose_arranged(
    document: &Document,
    view: &View,
    theme: &Theme,
    viewport: &Viewport,
    choices: &Composition,
    measurements: &Measurements,
) -> (Picture, Arrangement) {
    measurements.tidy(document);
    let mut picture = Picture::new((!choices.transparent).then_some(theme.background));
    if view.panels.get(GRID).copied().unwrap_or(true) {
        picture.push_layer("grid", grid_lines(viewport, theme));
        picture.push_layer("scale", grid_labels(viewport, theme));
    }
    let shown = || {
        document.objects().iter().filter(|object| object.visible).filter_map(|object| match &object.content {
            Content::Curve { curve, display } => Some((object, curve, display)),
            _ => None,
        })
    };
    let parameter = |object: &Object, curve| parameter_of(curve, view.parameters.get(&object.id).copied());
    let sheet = Sheet { theme, viewport, measurements, crowd: Crowd::of(document, viewport) };
    for (object, curve, display) in shown() {
        let step = choices.step.as_ref().filter(|(id, _)| *id == object.id).map(|(_, step)| step);
        let t = parameter(object, curve);
        push_curve(&mut picture, object, (curve, display), t, step, &sheet);
    }
    let handle = choices.handle.or(view.selected_object).and_then(|id| {
        let (object, curve, _) = shown().find(|(object, ..)| object.id == id)?;
        let t = parameter(object, curve);
        Some(labels::Handle { object: id, at: curve.evaluate(t).ok()?, words: labels::note_words(t) })
    });
    let with_inset: Vec<_> = shown().filter(|(_, _, display)| display.hodograph).collect();
    let ids: Vec<ObjectId> = with_inset.iter().map(|(object, ..)| object.id).collect();
    let insets = labels::insets(&picture, &ids, viewport, &choices.former);
    for (&(object, curve, display), &(_, area)) in with_inset.iter().zip(&insets) {
        let t = parameter(object, curve);
        let items = looks::hodograph(curve, t, display, theme, viewport, area);
        picture.push_layer(format!("{}: hodograph", object.name), items);
    }
    let areas: Vec<_> = insets.iter().map(|&(_, area)| area).collect();
    let mut arrangement =
        labels::arrange(&mut picture, handle.as_ref(), &areas, viewport, theme, &choices.former);
    arrangement.memory.corners = ids.into_iter().zip(insets.iter().map(|&(corner, _)| corner)).collect();
    (picture, arrangement)
}

/// The chosen parameter kept inside the interval of `curve`; its middle if none was chosen.
pub fn parameter_of(curve: &Nurbs<DVec2>, chosen: Option<f64>) -> f64 {
    let (left, right) = curve.space().parameter_interval();
    chosen.unwrap_or(left + 0.5 * (right - left)).clamp(left, right)
}

/// What the parts of the picture of a curve are drawn with.
struct Sheet<'a> {
    theme: &'a Theme,
    viewport: &'a Viewport,
    measurements: &'a Measurements,
    crowd: Crowd,
}

fn push_curve(
    picture: &mut Picture,
    object: &Arc<Object>,
    (curve, display): (&Nurbs<DVec2>, &CurveDisplay),
    parameter: f64,
    step: Option<&StepDrawing>,
    sheet: &Sheet<'_>,
) {
    let Sheet { theme, viewport, measurements, crowd } = *sheet;
    let layer = |part: &str| format!("{}: {part}", object.name);
    let crowd = crowd.with(curve);
    if display.comb {
        picture.push_layer(layer("curvature comb"), curve_layers::comb(curve, display, theme, &crowd));
    }
    if display.hull {
        picture.push_layer(layer("convex hull"), curve_layers::hull(curve, parameter, display, theme));
    }
    if display.distance_tube {
        picture.push_layer(
            layer("distance tube"),
            looks::distance_tube(curve, &measurements.of(object), display, theme),
        );
    }
    if display.osculating_circle {
        picture.push_layer(layer("circle of curvature"), curve_layers::circle(curve, parameter, theme));
    }
    if display.polygon {
        picture.push_layer(layer("control polygon"), curve_layers::polygon(curve, theme));
    }
    if display.symmetry {
        picture
            .push_layer(layer("symmetry"), looks::symmetry(curve, &measurements.of(object), display, theme));
    }
    picture.push_layer(layer("curve"), curve_layers::curve(curve, display, theme, viewport));
    if let Some(step) = step {
        picture.push_layer(layer("construction"), step.items(display, theme));
    } else if display.construction {
        picture.push_layer(layer("construction"), construction_items(curve, parameter, display, theme));
    }
    if display.bezier_points {
        picture.push_layer(layer("Bezier points"), looks::bezier_points(curve, display, theme));
    }
    if display.inflections {
        picture.push_layer(layer("inflections"), looks::inflections(curve, &measurements.of(object), theme));
    }
    if display.vertices {
        picture
            .push_layer(layer("curvature extrema"), looks::vertices(curve, &measurements.of(object), theme));
    }
    if display.frame {
        picture.push_layer(layer("frame"), looks::frame(curve, parameter, theme, viewport));
    }
    if display.knots {
        picture.push_layer(layer("knots"), curve_layers::knots(curve, display, theme, &crowd));
    }
    if display.points {
        picture.push_layer(layer("control points"), curve_layers::points(curve, display, theme, &crowd));
    }
    picture.push_layer(layer("labels"), curve_layers::labels(curve, display, theme, &crowd));
    if display.blossom_labels {
        picture.push_layer(layer("blossom labels"), looks::blossom_labels(curve, theme));
    }
    if display.probe_line {
        let measured = measurements.of(object);
        picture.push_layer(layer("bisection"), probe::bisection(curve, &measured, display, theme));
        picture.push_layer(layer("probe line"), probe::items(curve, &measured, display, theme, viewport));
    }
}
