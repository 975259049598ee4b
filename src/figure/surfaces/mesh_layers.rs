//! The layers of a subdivided polygon mesh.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::core::progress::{Part, Stopped, Watcher};
use crate::core::surface::{INFINITE_SHARPNESS, MeshError, PolygonMesh};
use crate::document::{MeshObject, SurfaceColoring};
use crate::figure::error::FigureError;
use crate::figure::picture::{Color, MarkerShape};
use crate::figure::scene::{Line, Points, SceneItem, Triangles};
use crate::figure::surfaces::mesh_curvature::curvatures;
use crate::figure::surfaces::mesh_faces::{Corners, edge_lines, flat_corners, smooth_corners};
use crate::figure::surfaces::surface_layers::handles;
use crate::figure::surfaces::{Fault, Legend, Shape, coloring, layer};
use crate::figure::theme::Theme;

/// The wireframe is drawn up to so many faces; more are closer than the lines are wide.
pub const MAX_WIREFRAME: usize = 30_000;
/// Ways to the limits are drawn up to so many vertices of the control mesh.
const MAX_WAYS: usize = 400;
/// Most marks of valences: a mesh of triangles has no end of them.
const MAX_MARKS: usize = 5000;

/// The shape of a mesh; what cannot be computed is missing, and the reason is told.
pub(super) fn shape(
    name: &str,
    object: &MeshObject,
    theme: &Theme,
    watcher: &dyn Watcher,
) -> Result<Shape, Stopped> {
    let mut shape = Shape::default();
    match object.steps_watched(&Part { whole: watcher, from: 0.0, to: 0.4 }) {
        Ok(steps) => shape.steps = steps,
        Err(MeshError::Stopped(stopped)) => return Err(stopped),
        Err(error) => shape.problem = Some(format!("{name}: {error}")),
    }
    watcher.check(0.4)?;
    let refined = shape.steps.last().map_or(object.cage(), |step| &step.mesh);
    shape.vertices = if object.display().limit {
        refined.limit_positions(object.fixes_corners())
    } else {
        refined.positions().to_vec()
    };
    watcher.check(0.5)?;
    match layers(name, object, refined, &shape.vertices, theme, watcher) {
        Ok((layers, legend)) => (shape.layers, shape.legend) = (layers, legend),
        Err(Fault::Stopped(stopped)) => return Err(stopped),
        Err(fault) => shape.problem = Some(format!("{name}: {fault}")),
    }
    watcher.check(1.0)?;
    Ok(shape)
}

type Layers = (Vec<crate::figure::scene::SceneLayer>, Option<Legend>);

fn layers(
    name: &str,
    object: &MeshObject,
    refined: &PolygonMesh,
    positions: &[DVec3],
    theme: &Theme,
    watcher: &dyn Watcher,
) -> Result<Layers, Fault> {
    let display = object.display();
    let (triangles, legend) = triangles(object, refined, positions, theme, watcher)?;
    watcher.check(0.85)?;
    let mut layers = vec![layer(name, "faces", vec![SceneItem::Triangles(triangles)])];
    let is_cage = object.level() == 0;
    if display.wireframe && !(is_cage && display.cage) && refined.topology().face_count() <= MAX_WIREFRAME {
        let width = if refined.topology().face_count() > 4000 { 0.5 } else { 0.8 };
        let stroke = theme.stroke(theme.surface_line.with_opacity(0.85), width);
        let line = |line: &Vec<u32>| {
            let points = line.iter().map(|&vertex| positions[vertex as usize]).collect();
            Line::new(points, stroke.clone()).map(SceneItem::Line)
        };
        let lines: Result<Vec<SceneItem>, FigureError> = edge_lines(refined).iter().map(line).collect();
        layers.push(layer(name, "wireframe", lines?));
    }
    let cage = object.cage();
    if display.cage {
        let stroke = theme.stroke(theme.polygon, 1.2);
        let mut items = Vec::new();
        for line in edge_lines(cage) {
            let points = line.iter().map(|&vertex| cage.positions()[vertex as usize]).collect();
            items.push(SceneItem::Line(Line::new(points, stroke.clone())?));
        }
        items.push(SceneItem::Points(handles(cage.positions().to_vec(), theme)?));
        layers.push(layer(name, "control mesh", items));
        layers.push(layer(name, "sharp edges", sharp_edges(cage, theme)?));
    }
    if display.limit {
        layers.push(layer(name, "limits", limits(object, theme)?));
    }
    if display.valences {
        layers.push(layer(name, "valences", valences(refined, positions, theme)?));
    }
    Ok((layers.into_iter().flatten().collect(), legend))
}

fn triangles(
    object: &MeshObject,
    refined: &PolygonMesh,
    positions: &[DVec3],
    theme: &Theme,
    watcher: &dyn Watcher,
) -> Result<(Triangles, Option<Legend>), Fault> {
    let display = object.display();
    let smooth = display.smooth && object.level() > 0;
    let Corners { vertices, normals, triangles } =
        if smooth { smooth_corners(refined, positions) } else { flat_corners(refined, positions) };
    watcher.check(0.65)?;
    let points = vertices.iter().map(|&vertex| positions[vertex as usize]).collect();
    let mut triangles = Triangles::new(points, triangles, theme.surface_color(display.color))?;
    if normals.iter().all(|normal| normal.is_finite()) {
        triangles = triangles.with_normals(normals)?;
    }
    if display.coloring == SurfaceColoring::Plain {
        // The inside of a closed mesh is not seen.
        triangles.back_color = (!refined.topology().is_closed()).then_some(theme.surface_back);
        return Ok((triangles, None));
    }
    watcher.check(0.75)?;
    let value = |(gaussian, principal)| display.coloring.value(gaussian, principal).unwrap_or(f64::NAN);
    let values: Vec<f64> = curvatures(refined, positions).into_iter().map(value).collect();
    let (colors, legend) = coloring::colors(&values, display.coloring, display.color_limit, theme);
    triangles = triangles.with_colors(vertices.iter().map(|&vertex| colors[vertex as usize]).collect())?;
    triangles.is_lit = false;
    Ok((triangles, legend))
}

/// Sharp edges of the control mesh, the wider the sharper.
fn sharp_edges(cage: &PolygonMesh, theme: &Theme) -> Result<Vec<SceneItem>, FigureError> {
    let line = |crease: &crate::core::surface::Crease| {
        let ends = cage.topology().edge(crease.edge as usize).map(|end| cage.positions()[end as usize]);
        let share = crease.sharpness.min(INFINITE_SHARPNESS) / INFINITE_SHARPNESS;
        let stroke = theme.stroke(theme.warning, 1.8 + 2.4 * share.sqrt());
        Line::new(ends.to_vec(), stroke).map(SceneItem::Line)
    };
    cage.creases().iter().map(line).collect()
}

/// Where the vertices of the control mesh tend to, and the way there.
fn limits(object: &MeshObject, theme: &Theme) -> Result<Vec<SceneItem>, FigureError> {
    let cage = object.cage();
    let limits = cage.limit_positions(object.fixes_corners());
    let mut items = Vec::new();
    if object.display().cage && limits.len() <= MAX_WAYS {
        for (&from, &to) in cage.positions().iter().zip(&limits) {
            let stroke = theme.dashed_stroke(theme.accent, 1.0, 3.0, 3.0);
            items.push(SceneItem::Line(Line::new(vec![from, to], stroke)?));
        }
    }
    let mut marks = Points::new(limits, MarkerShape::Disc, 6.0 * theme.stroke_scale.sqrt(), theme.accent)?;
    marks.outline = Some(theme.stroke(theme.background, 1.0));
    items.push(SceneItem::Points(marks));
    Ok(items)
}

/// The colour of marks at vertices with so many faces; `None` for the regular 4.
pub fn valence_color(valence: usize, theme: &Theme) -> Option<Color> {
    match valence {
        4 => None,
        0..=3 => Some(theme.basis_color(1)),
        5 => Some(theme.basis_color(2)),
        _ => Some(theme.basis_color(3)),
    }
}

fn valences(mesh: &PolygonMesh, positions: &[DVec3], theme: &Theme) -> Result<Vec<SceneItem>, FigureError> {
    let topology = mesh.topology();
    let mut groups: BTreeMap<usize, Vec<DVec3>> = BTreeMap::new();
    let inner = (0..positions.len()).filter(|&vertex| topology.valence(vertex) != 4);
    for vertex in inner.filter(|&vertex| !topology.is_boundary_vertex(vertex)).take(MAX_MARKS) {
        groups.entry(topology.valence(vertex).clamp(3, 6)).or_default().push(positions[vertex]);
    }
    let marks = groups.into_iter().map(|(valence, points)| {
        let color = valence_color(valence, theme).unwrap_or(theme.polygon);
        let mut marks = Points::new(points, MarkerShape::Diamond, 9.0 * theme.stroke_scale.sqrt(), color)?;
        marks.outline = Some(theme.stroke(theme.background, 1.0));
        Ok(SceneItem::Points(marks))
    });
    marks.collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::progress::Unwatched;
    use crate::core::surface::mesh_shapes;
    use crate::document::MeshDisplay;

    fn marks(level: usize) -> Vec<usize> {
        let display = MeshDisplay { valences: true, ..MeshDisplay::default() };
        let mesh = MeshObject::from_cage(mesh_shapes::cube(), display).unwrap().with_level(level).unwrap();
        let shape = shape("Cube", &mesh, &Theme::light(), &Unwatched).unwrap();
        let layer = shape.layers.iter().find(|layer| layer.name.ends_with("valences")).unwrap();
        layer
            .items
            .iter()
            .map(|item| if let SceneItem::Points(p) = item { p.points().len() } else { 0 })
            .collect()
    }

    #[test]
    fn subdivision_makes_no_new_extraordinary_vertices() {
        for level in 0..4 {
            assert_eq!(marks(level), [8], "the corners of the cube at level {level}");
        }
    }

    #[test]
    fn the_wireframe_stands_where_the_faces_do() {
        let display = MeshDisplay { limit: true, ..MeshDisplay::default() };
        let mesh = MeshObject::from_cage(mesh_shapes::cube(), display).unwrap();
        let shape = shape("Cube", &mesh, &Theme::light(), &Unwatched).unwrap();
        let expected = mesh.cage().limit_positions(false);
        for (vertex, limit) in expected.iter().enumerate() {
            assert!(shape.vertices[vertex].distance(*limit) < 1e-12, "a step does not change limits");
        }
        let wire = shape.layers.iter().find(|layer| layer.name.ends_with("wireframe")).unwrap();
        let SceneItem::Line(line) = &wire.items[0] else { panic!("no line") };
        assert!(line.points().iter().all(|point| shape.vertices.contains(point)), "on the vertices");
    }
}
