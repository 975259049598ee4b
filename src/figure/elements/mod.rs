//! The picture of a boundary value problem: what the canvas of the Finite elements room shows and the exporters write.
//!
//! Layers from back to front: the grid, the colours of the field, cells, isolines, the nodes of the quadrature, stream lines,
//! the outline, the nodes of the B-splines, the net, the legend.

mod field_layers;
mod sampling;
mod solve;
mod study;

use glam::DVec2;

use crate::core::progress::Unwatched;
use crate::document::{Document, FieldColors, Membrane, MembraneDisplay, Object, Region, Shape, Shown, View};
use crate::figure::color_bar::color_bar;
use crate::figure::color_map::{ColorMap, ColorScale};
use crate::figure::composition::GRID;
use crate::figure::field::Field;
use crate::figure::picture::{Anchor, Item, Label, Layer, Path, Picture, Viewport};
use crate::figure::theme::Theme;
use crate::figure::ticks::{grid_labels, grid_lines};

pub use sampling::Samples;
pub use solve::{Facts, MAX_FUNCTIONS, Solution, SolveError, Solved, solve};
pub use study::{ErrorStudy, StudyLine, error_study};

/// Name of the room in [`View::workspace`].
pub const WORKSPACE: &str = "elements";

/// Points of a full circle.
const CIRCLE: usize = 96;

/// The object that the room shows: the selected one, or the last visible problem.
pub fn shown_object<'a>(document: &'a Document, view: &View) -> Option<&'a Object> {
    let mut problems = document.objects().iter().filter(|object| object.membrane().is_some());
    let selected = view.selected_object.and_then(|id| document.object(id)).filter(|o| o.membrane().is_some());
    selected.or_else(|| problems.rfind(|object| object.visible)).map(|object| &**object)
}

/// Whether the picture of `document` is that of this room.
pub fn is_shown(document: &Document, view: &View) -> bool {
    let other = || document.objects().iter().any(|object| object.visible && object.membrane().is_none());
    view.workspace == WORKSPACE
        || (view.workspace.is_empty() && !other() && shown_object(document, view).is_some())
}

/// Width of the legend in pt, nearly.
const LEGEND: f64 = 64.0;

/// The viewport drawn together to the left, so that the legend covers nothing that it shows.
pub fn beside_legend(viewport: &Viewport) -> Viewport {
    let scale = viewport.scale * (1.0 - LEGEND / viewport.size.x).max(0.25);
    Viewport { scale, center: viewport.center + DVec2::new(0.5 * LEGEND / scale, 0.0), ..*viewport }
}

/// Solves the problem that the room shows, and composes its picture.
pub fn compose(document: &Document, view: &View, theme: &Theme, viewport: &Viewport) -> Picture {
    let mut picture = ground(view, theme, viewport);
    if let Some(object) = shown_object(document, view)
        && let Some((membrane, display)) = object.membrane()
    {
        match solve(membrane, &Unwatched) {
            Ok(solved) => {
                picture.layers.extend(field(&solved, display, theme));
                if display.net {
                    picture.push_layer("net", net(membrane, theme));
                }
                picture.layers.extend(legend(&solved, display, theme, viewport));
            }
            Err(error) => {
                picture.push_layer("net", net(membrane, theme));
                let at = viewport.world_from_page(DVec2::new(0.5 * viewport.size.x, 24.0));
                picture.push_layer("problem", vec![note(at, &error.to_string(), theme)]);
            }
        }
    }
    picture
}

/// What lies behind the field: the ground and the lines of the grid.
pub fn ground(view: &View, theme: &Theme, viewport: &Viewport) -> Picture {
    let mut picture = Picture::new(Some(theme.background));
    if view.panels.get(GRID).copied().unwrap_or(true) {
        picture.push_layer("grid", grid_lines(viewport, theme));
        picture.push_layer("scale", grid_labels(viewport, theme));
    }
    picture
}

/// The solution in the plane; the same at every zoom.
pub fn field(solved: &Solved, display: &MembraneDisplay, theme: &Theme) -> Vec<Layer> {
    let mut picture = Picture::new(None);
    let scale = scale(solved, display);
    if let (Some(scale), Ok(field)) = (scale, field_of(solved, display)) {
        if display.fill
            && let Ok(mesh) = field.mesh(&scale)
        {
            picture.push_layer("field", vec![Item::Mesh(mesh)]);
        }
        picture.push_layer("cells", field_layers::cells(solved, display, theme));
        picture.push_layer("isolines", field_layers::isolines(&field, &scale, display, theme));
    }
    picture.push_layer("quadrature", field_layers::quadrature(solved, display, theme));
    picture.push_layer("stream lines", field_layers::stream_lines(solved, display, theme));
    picture.push_layer("outline", field_layers::outline(solved, theme));
    picture.push_layer("nodes", field_layers::nodes(solved, display, theme));
    picture.layers
}

/// The colour bar.
pub fn legend(solved: &Solved, display: &MembraneDisplay, theme: &Theme, viewport: &Viewport) -> Vec<Layer> {
    let mut picture = Picture::new(None);
    let title = match (&solved.solution, display.shown) {
        (Solution::Flow(_), Shown::Value) => "potential",
        (Solution::Flow(_), Shown::Slope) => "speed",
        (_, Shown::Value) => "$u$",
        (_, Shown::Slope) => "$|\\nabla u|$",
    };
    if let Some(scale) = scale(solved, display).filter(|_| display.fill || display.isolines > 0)
        && let Ok(items) = color_bar(&scale, title, viewport, theme)
    {
        picture.push_layer("legend", items);
    }
    picture.layers
}

/// The boundaries of the primitives, or the control net of the patch.
pub fn net(membrane: &Membrane, theme: &Theme) -> Vec<Item> {
    let stroke = theme.dashed_stroke(theme.polygon, 1.0, 4.0, 3.0);
    let Region::Parts { parts, .. } = &membrane.setting().region else {
        return membrane.patch().map_or_else(Vec::new, |patch| field_layers::control_net(patch, theme));
    };
    let (low, high) = membrane.bounding_box().unwrap_or_default();
    let reach = (high - low).length().max(1.0);
    parts
        .iter()
        .map(|part| match &part.shape {
            Shape::HalfPlane { point, normal } => {
                let along = normal.perp().normalize_or_zero() * reach;
                Item::Path(Path::polyline(&[*point - along, *point + along], stroke.clone()))
            }
            shape => Item::Path(Path::polygon(&boundary(shape), Some(stroke.clone()), None)),
        })
        .collect()
}

/// The boundary of a bounded primitive as a polygon.
pub fn boundary(shape: &Shape) -> Vec<DVec2> {
    let ellipse = |center: DVec2, half_axes: DVec2, angle: f64| {
        let turn = DVec2::from_angle(angle);
        let point = |i: usize| {
            let at = DVec2::from_angle(std::f64::consts::TAU * i as f64 / CIRCLE as f64);
            center + turn.rotate(half_axes * at)
        };
        (0..CIRCLE).map(point).collect()
    };
    match shape {
        Shape::Disc { center, radius } => ellipse(*center, DVec2::splat(*radius), 0.0),
        Shape::Ellipse { center, half_axes, angle } => ellipse(*center, *half_axes, *angle),
        Shape::Rectangle { lower, upper } => {
            vec![*lower, DVec2::new(upper.x, lower.y), *upper, DVec2::new(lower.x, upper.y)]
        }
        Shape::Polygon { vertices } => vertices.clone(),
        Shape::HalfPlane { .. } => Vec::new(),
    }
}

fn field_of(solved: &Solved, display: &MembraneDisplay) -> Result<Field, crate::figure::error::FigureError> {
    let samples = &solved.samples;
    let values = match display.shown {
        Shown::Value => &samples.values,
        Shown::Slope => &samples.slopes,
    };
    Field::new(samples.points.clone(), values.clone(), samples.triangles.clone())
}

fn scale(solved: &Solved, display: &MembraneDisplay) -> Option<ColorScale> {
    let map = match display.colors {
        FieldColors::Viridis => ColorMap::Viridis,
        FieldColors::Cividis => ColorMap::Cividis,
        FieldColors::Diverging => ColorMap::Diverging,
    };
    let values = match display.shown {
        Shown::Value => &solved.samples.values,
        Shown::Slope => &solved.samples.slopes,
    };
    ColorScale::of_values(values, map).ok()
}

fn note(at: DVec2, text: &str, theme: &Theme) -> Item {
    Item::Label(Label {
        at,
        offset: DVec2::ZERO,
        text: text.to_owned(),
        size: 11.0 * theme.text_scale,
        color: theme.error,
        anchor: Anchor::Middle,
        math: false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Content, Edit, MembranePreset};

    fn picture(preset: MembranePreset, change: fn(&mut MembraneDisplay)) -> Picture {
        let mut document = Document::new();
        let mut display = preset.display();
        change(&mut display);
        let content = Content::Membrane { membrane: preset.membrane(), display };
        document.apply(&Edit::AddObject { name: preset.title().to_owned(), content }).unwrap();
        let (low, high) = document.bounding_box().unwrap();
        let viewport = Viewport::fitting(low, high, DVec2::new(400.0, 300.0), 20.0);
        let view = View::default();
        assert!(is_shown(&document, &view), "a document without curves is shown here");
        compose(&document, &view, &Theme::light(), &viewport)
    }

    fn count(picture: &Picture, layer: &str) -> usize {
        picture.layers.iter().filter(|found| found.name == layer).map(|found| found.items.len()).sum()
    }

    #[test]
    fn the_mushroom_shows_its_nodes_by_class_and_its_cells() {
        let all = picture(MembranePreset::Mushroom, |display| display.quadrature = true);
        for layer in ["grid", "field", "isolines", "cells", "quadrature", "outline", "net", "nodes", "legend"]
        {
            assert!(count(&all, layer) > 0, "{layer}");
        }
        let solved = solve(&MembranePreset::Mushroom.membrane(), &Unwatched).unwrap();
        assert_eq!(count(&all, "nodes"), solved.facts.unknowns, "a marker for each relevant B-spline");
        let none = picture(MembranePreset::Mushroom, |display| {
            *display = MembraneDisplay { fill: false, isolines: 0, net: false, ..MembraneDisplay::default() };
        });
        for layer in ["field", "isolines", "cells", "nodes", "net", "legend"] {
            assert_eq!(count(&none, layer), 0, "{layer}");
        }
    }

    #[test]
    fn isolines_of_the_disc_are_circles() {
        let picture = picture(MembranePreset::Disc, |display| display.isolines = 3);
        let lines = picture.layers.iter().find(|layer| layer.name == "isolines").unwrap();
        let mut radii = Vec::new();
        for item in &lines.items {
            let Item::Path(path) = item else { panic!("{item:?}") };
            for segment in &path.segments {
                let (crate::figure::picture::Segment::Move(at) | crate::figure::picture::Segment::Line(at)) =
                    segment
                else {
                    continue;
                };
                radii.push(at.length());
            }
        }
        // u = 1 − r² at 1/4, 1/2, 3/4.
        let expected = [0.75_f64, 0.5, 0.25].map(f64::sqrt);
        for radius in radii {
            let nearest = expected.iter().map(|e| (radius - e).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 2e-3, "radius {radius}");
        }
    }

    #[test]
    fn the_channel_has_stream_lines_and_a_broken_problem_a_sentence() {
        let channel = picture(MembranePreset::Channel, |display| display.stream_lines = 5);
        assert!(count(&channel, "stream lines") >= 5, "five lines");
        let mut document = Document::new();
        let membrane = MembranePreset::Disc.membrane().with_parts(Vec::clear).unwrap();
        let content = Content::Membrane { membrane, display: MembraneDisplay::default() };
        document.apply(&Edit::AddObject { name: "Nothing".to_owned(), content }).unwrap();
        let viewport = Viewport::fitting(DVec2::ZERO, DVec2::ONE, DVec2::splat(200.0), 10.0);
        let view = View { workspace: WORKSPACE.to_owned(), ..View::default() };
        let picture = compose(&document, &view, &Theme::dark(), &viewport);
        assert_eq!(count(&picture, "problem"), 1, "the reason is written");
    }
}
