//! The layers of a spline surface.

use glam::DVec3;

use crate::core::progress::{Stopped, Watcher};
use crate::core::surface::{NurbsSurface, SurfaceError};
use crate::document::{SurfaceColoring, SurfaceObject};
use crate::figure::error::FigureError;
use crate::figure::picture::{MarkerShape, Stroke};
use crate::figure::scene::{Line, Points, SceneItem, Triangles};
use crate::figure::surfaces::{Fault, Legend, Shape, coloring, layer};
use crate::figure::theme::Theme;

/// Length of a normal as a part of the surface's size.
const NORMAL: f64 = 0.07;
/// Normals for every knot interval, and at most along a direction.
const NORMALS: (usize, usize) = (3, 24);

/// Where a surface is singular its curvatures are taken this part of the way to the middle.
const INSIDE: f64 = 1e-3;
/// The watcher is asked after so many curvatures.
const WATCHED: usize = 4096;

/// The shape of a surface; what cannot be computed is missing, and the reason is told.
pub(super) fn shape(
    name: &str,
    object: &SurfaceObject,
    theme: &Theme,
    watcher: &dyn Watcher,
) -> Result<Shape, Stopped> {
    let mut shape = Shape::default();
    let mut parts: Vec<(&str, Result<Vec<SceneItem>, Fault>)> = Vec::new();
    let (surface, display) = (object.surface(), object.display());
    match triangles(object, theme, watcher) {
        Ok((triangles, legend)) => {
            shape.legend = legend;
            parts.push(("surface", Ok(vec![SceneItem::Triangles(triangles)])));
        }
        Err(Fault::Stopped(stopped)) => return Err(stopped),
        Err(fault) => parts.push(("surface", Err(fault))),
    }
    watcher.check(0.9)?;
    if display.isolines > 0 {
        let lines = |axis: usize| between(&surface.space().axes()[axis].breaks(), display.isolines);
        let stroke = theme.stroke(theme.surface_line.with_opacity(0.7), 0.6);
        parts.push(("isolines", isolines(object, [lines(0), lines(1)], &stroke)));
    }
    if display.knot_lines {
        let breaks = surface.space().axes().each_ref().map(|axis| axis.breaks());
        parts.push(("knot lines", isolines(object, breaks, &theme.stroke(theme.surface_line, 1.1))));
    }
    if display.normals {
        parts.push(("normals", normals(surface, theme)));
    }
    if display.net {
        parts.push(("control net", net(surface, theme).map_err(Fault::from)));
    }
    for (part, items) in parts {
        match items {
            Ok(items) => shape.layers.extend(layer(name, part, items)),
            Err(fault) => shape.problem = Some(format!("{name}: {fault}")),
        }
    }
    Ok(shape)
}

fn triangles(
    object: &SurfaceObject,
    theme: &Theme,
    watcher: &dyn Watcher,
) -> Result<(Triangles, Option<Legend>), Fault> {
    let (surface, display) = (object.surface(), object.display());
    watcher.check(0.0)?;
    let grid = surface.tessellate([display.density; 2])?;
    watcher.check(0.1)?;
    let color = theme.surface_color(display.color);
    let mut triangles = Triangles::new(grid.points, grid.triangles, color)?;
    // Coordinates so large that normals overflow leave the faces flat.
    if grid.normals.iter().all(|normal| normal.is_finite()) {
        triangles = triangles.with_normals(grid.normals)?;
    }
    if display.coloring == SurfaceColoring::Plain {
        // The inside of a surface that is closed in both directions is not seen, whichever way its normals point.
        let is_closed = surface.space().axes().iter().all(|axis| axis.is_periodic());
        triangles.back_color = (!is_closed).then_some(theme.surface_back);
        return Ok((triangles, None));
    }
    let middle = surface.space().axes().each_ref().map(|axis| {
        let (low, high) = axis.parameter_interval();
        0.5 * low + 0.5 * high
    });
    let value = |at: &glam::DVec2| {
        // Where a row of the net is one point the curvatures nearby tell what the formulas cannot.
        let inside = at.lerp(glam::DVec2::from_array(middle), INSIDE);
        let curvatures = surface.curvatures(at.to_array()).or_else(|_| surface.curvatures(inside.to_array()));
        let curvatures = curvatures.ok()?;
        display.coloring.value(curvatures.gaussian, curvatures.principal)
    };
    let count = grid.parameters.len();
    let mut values = Vec::with_capacity(count);
    for some in grid.parameters.chunks(WATCHED) {
        watcher.check(0.1 + 0.8 * values.len() as f64 / count as f64)?;
        values.extend(some.iter().map(|at| value(at).unwrap_or(f64::NAN)));
    }
    let (colors, legend) = coloring::colors(&values, display.coloring, display.color_limit, theme);
    triangles = triangles.with_colors(colors)?;
    triangles.is_lit = false;
    Ok((triangles, legend))
}

/// `count` parameters inside every interval between neighbours.
fn between(breaks: &[f64], count: usize) -> Vec<f64> {
    let share = |k: usize| k as f64 / (count + 1) as f64;
    let inside = |pair: &[f64]| {
        let (a, b) = (pair[0], pair[1]);
        (1..=count).map(move |k| a + (b - a) * share(k)).collect::<Vec<f64>>()
    };
    breaks.windows(2).flat_map(inside).collect()
}

/// Lines on the surface where the parameter of either direction has the given values, as fine as the triangles.
fn isolines(object: &SurfaceObject, values: [Vec<f64>; 2], stroke: &Stroke) -> Result<Vec<SceneItem>, Fault> {
    let surface = object.surface();
    let mut items = Vec::new();
    for (axis, values) in values.iter().enumerate() {
        let mut breaks = surface.space().axes()[1 - axis].breaks();
        breaks.extend(between(&breaks, object.display().density - 1));
        breaks.sort_by(f64::total_cmp);
        for &value in values {
            let curve = surface.iso_curve(axis, value)?;
            let points: Result<Vec<DVec3>, _> = breaks.iter().map(|&t| curve.evaluate(t)).collect();
            let points = points.map_err(|error| {
                SurfaceError::from(crate::core::tensor::TensorError::Axis { axis: 1 - axis, source: error })
            })?;
            items.push(SceneItem::Line(Line::new(points, stroke.clone())?));
        }
    }
    Ok(items)
}

fn normals(surface: &NurbsSurface, theme: &Theme) -> Result<Vec<SceneItem>, Fault> {
    let length = NORMAL * surface.size();
    let middles = surface.space().axes().each_ref().map(|axis| {
        let all = between(&axis.breaks(), NORMALS.0);
        let step = all.len().div_ceil(NORMALS.1).max(1);
        all.into_iter().step_by(step).collect::<Vec<f64>>()
    });
    let mut items = Vec::new();
    for &u in &middles[0] {
        for &v in &middles[1] {
            // Where there is no tangent plane there is no normal to be shown.
            if let (Ok(from), Ok(normal)) = (surface.evaluate([u, v]), surface.normal([u, v])) {
                let line = Line::new(vec![from, from + normal * length], theme.stroke(theme.comb, 1.2))?;
                items.push(SceneItem::Line(line));
            }
        }
    }
    Ok(items)
}

/// Rows and columns of the net, closed where the surface is, and its points.
fn net(surface: &NurbsSurface, theme: &Theme) -> Result<Vec<SceneItem>, FigureError> {
    let [rows, columns] = surface.shape();
    let closed = surface.space().axes().each_ref().map(|axis| axis.is_periodic());
    let point = |i: usize, j: usize| surface.points()[(i % rows) * columns + j % columns];
    let stroke = theme.stroke(theme.polygon, 1.0);
    let mut items = Vec::new();
    for i in 0..rows {
        let line = (0..columns + usize::from(closed[1])).map(|j| point(i, j));
        items.push(SceneItem::Line(Line::new(line.collect(), stroke.clone())?));
    }
    for j in 0..columns {
        let line = (0..rows + usize::from(closed[0])).map(|i| point(i, j));
        items.push(SceneItem::Line(Line::new(line.collect(), stroke.clone())?));
    }
    items.push(SceneItem::Points(handles(surface.points().to_vec(), theme)?));
    Ok(items)
}

/// Control points as they are shown everywhere.
pub(super) fn handles(points: Vec<DVec3>, theme: &Theme) -> Result<Points, FigureError> {
    let mut points =
        Points::new(points, MarkerShape::Disc, 7.0 * theme.stroke_scale.sqrt(), theme.background)?;
    points.outline = Some(theme.stroke(theme.polygon, 1.6));
    Ok(points)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::progress::Unwatched;
    use crate::core::surface::samples;
    use crate::document::SurfaceDisplay;

    #[test]
    fn a_sphere_has_the_colour_of_its_curvature_everywhere() {
        let display = SurfaceDisplay {
            coloring: SurfaceColoring::Gaussian,
            color_limit: 2.0,
            density: 5,
            ..SurfaceDisplay::default()
        };
        let object = SurfaceObject::new(samples::sphere_octant(), display).unwrap();
        let shape = shape("Sphere", &object, &Theme::light(), &Unwatched).unwrap();
        let SceneItem::Triangles(triangles) = &shape.layers[0].items[0] else { panic!("no triangles") };
        let expected = shape.legend.unwrap().scale.color(1.0);
        // The formulas fail at the pole, where u has no meaning; it has the colour of what is around it.
        assert_eq!(triangles.colors().len(), 36, "6 × 6 points");
        for color in triangles.colors() {
            let near = [(color.r, expected.r), (color.g, expected.g), (color.b, expected.b)];
            assert!(near.iter().all(|(a, b)| a.abs_diff(*b) <= 1), "{color:?}, not {expected:?}");
        }
    }

    #[test]
    fn the_net_of_a_torus_is_closed_in_both_directions() {
        let object = SurfaceObject::new(samples::torus().into(), SurfaceDisplay::default()).unwrap();
        let items = net(object.surface(), &Theme::light()).unwrap();
        assert_eq!(items.len(), 9, "four rows, four columns, the points");
        for item in &items[..8] {
            let SceneItem::Line(line) = item else { panic!("not a line") };
            assert_eq!(line.points().len(), 5, "once around");
            assert_eq!(line.points()[0], line.points()[4], "closed");
        }
    }
}
