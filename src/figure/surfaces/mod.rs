//! Surfaces and polygon meshes in space: what the Surfaces room shows and exporters write.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | [`Shape`]: one object as layers of a scene; all of them as a [`Scene`], as a picture |
//! | `surface_layers.rs` | a spline surface: triangles, knot lines, normals, control net |
//! | `mesh_layers.rs` | a subdivided mesh: faces, wireframe, control mesh, limits, valences |
//! | `mesh_faces.rs` | corners of a mesh with normals that respect creases; its edges as long lines |
//! | `mesh_curvature.rs` | curvatures of a mesh from its angles |
//! | `coloring.rs` | curvatures as colours |

mod coloring;
mod mesh_curvature;
mod mesh_faces;
mod mesh_layers;
mod surface_layers;

use glam::{DVec2, DVec3};

use crate::core::progress::{Stopped, Unwatched, Watcher};
use crate::core::surface::SurfaceError;
use crate::core::surface::catmull_clark::SubdivisionStep;
use crate::document::{Content, Document, Object, View};
use crate::figure::color_bar::color_bar;
use crate::figure::color_map::ColorScale;
use crate::figure::error::FigureError;
use crate::figure::picture::{Item, Picture, Viewport};
use crate::figure::scene::{Eye, EyeView, Paper, Scene, SceneItem, SceneLayer};
use crate::figure::theme::Theme;

pub use mesh_layers::{MAX_WIREFRAME, valence_color};

/// Name of the room in [`View::workspace`].
pub const WORKSPACE: &str = "surfaces";

/// What colours tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Values and colours.
    pub scale: ColorScale,
    /// The quantity.
    pub title: &'static str,
}

/// One object, ready to be drawn.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    /// Its layers, the surface first.
    pub layers: Vec<SceneLayer>,
    /// The scale of its colours.
    pub legend: Option<Legend>,
    /// The steps of a mesh, up to the level that is shown.
    pub steps: Vec<SubdivisionStep>,
    /// The vertices of a mesh as they are drawn: those of the last step, or their limits.
    pub vertices: Vec<DVec3>,
    /// Why something is missing.
    pub problem: Option<String>,
}

/// Why a part of an object cannot be drawn.
#[derive(Debug, thiserror::Error)]
enum Fault {
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    #[error(transparent)]
    Figure(#[from] FigureError),
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// The layers of a surface or a mesh; `None` for objects of other rooms.
pub fn shape(object: &Object, theme: &Theme) -> Option<Shape> {
    shape_watched(object, theme, &Unwatched).ok().flatten()
}

/// As [`shape`] with a watcher.
///
/// # Errors
///
/// [`Stopped`].
pub fn shape_watched(
    object: &Object,
    theme: &Theme,
    watcher: &dyn Watcher,
) -> Result<Option<Shape>, Stopped> {
    match &object.content {
        Content::Surface(surface) => surface_layers::shape(&object.name, surface, theme, watcher).map(Some),
        Content::Mesh(mesh) => mesh_layers::shape(&object.name, mesh, theme, watcher).map(Some),
        _ => Ok(None),
    }
}

/// All shapes as one scene.
pub fn scene<'a>(shapes: impl Iterator<Item = &'a Shape>, theme: &Theme) -> Scene {
    let mut scene = Scene::new(Some(theme.background));
    scene.layers.extend(shapes.flat_map(|shape| shape.layers.iter().cloned()));
    scene
}

/// Whether `view` looks at the room of surfaces.
pub fn is_shown(view: &View) -> bool {
    view.workspace == WORKSPACE
}

/// The corners of the smallest upright box around all control points of visible surfaces and meshes, which lie inside their hull;
/// `None` if there are none.
pub fn bounding_box(document: &Document) -> Option<(DVec3, DVec3)> {
    let visible = document.objects().iter().filter(|object| object.visible);
    let points = visible.flat_map(|object| control_points(object));
    points.fold(None, |found, &point| match found {
        None => Some((point, point)),
        Some((low, high)) => Some((point.min(low), point.max(high))),
    })
}

/// The control points of a surface or the vertices of a control mesh; none of other objects.
pub fn control_points(object: &Object) -> &[DVec3] {
    match &object.content {
        Content::Surface(surface) => surface.surface().points(),
        Content::Mesh(mesh) => mesh.cage().positions(),
        _ => &[],
    }
}

/// The legend of the selected object, or else of the last visible one that has one; `shapes` are those of the visible objects.
pub fn legend<'a>(
    shapes: impl DoubleEndedIterator<Item = (&'a Object, &'a Shape)> + Clone,
    view: &View,
) -> Option<&'a Legend> {
    let selected = shapes.clone().find(|(object, _)| Some(object.id) == view.selected_object);
    selected
        .and_then(|(_, shape)| shape.legend.as_ref())
        .or_else(|| shapes.rev().find_map(|(_, shape)| shape.legend.as_ref()))
}

/// The colour bar of `legend` on a page of `size` pt whose origin is the lower left corner.
pub fn legend_items(legend: &Legend, size: DVec2, theme: &Theme) -> Vec<Item> {
    let viewport = Viewport { center: size * 0.5, scale: 1.0, size };
    // A page without size has no room for it.
    color_bar(&legend.scale, legend.title, &viewport, theme).unwrap_or_default()
}

/// The picture of all visible surfaces and meshes on a page of `size` pt, and its viewport: 1 unit is 1 pt.
///
/// # Errors
///
/// `OutsideInterval` for an impossible eye, `StepLimit` for an impossible page.
pub fn compose(
    document: &Document,
    view: &View,
    theme: &Theme,
    size: DVec2,
) -> Result<(Picture, Viewport), FigureError> {
    let visible = document.objects().iter().filter(|object| object.visible);
    let shapes: Vec<(&Object, Shape)> =
        visible.filter_map(|object| Some((&**object, shape(object, theme)?))).collect();
    let scene = scene(shapes.iter().map(|(_, shape)| shape), theme);
    let eye = Eye::new(view.eye)?;
    let paper = Paper { view: EyeView { eye, size }, light: theme.light, pixels_per_point: 2.0 };
    let mut picture = paper.picture(&scene)?;
    if let Some(legend) = legend(shapes.iter().map(|(object, shape)| (*object, shape)), view) {
        picture.push_layer("colour scale", legend_items(legend, size, theme));
    }
    Ok((picture, paper.viewport()))
}

/// A layer of `name` called `part`.
fn layer(name: &str, part: &str, items: Vec<SceneItem>) -> Option<SceneLayer> {
    (!items.is_empty()).then(|| SceneLayer { name: format!("{name}: {part}"), items })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::core::surface::{mesh_shapes, samples};
    use crate::document::{Edit, MeshDisplay, MeshObject, SurfaceColoring, SurfaceDisplay, SurfaceObject};

    fn document(coloring: SurfaceColoring) -> Document {
        let mut document = Document::new();
        let display =
            SurfaceDisplay { coloring, density: 6, isolines: 1, normals: true, ..Default::default() };
        let surface = SurfaceObject::new(samples::torus().into(), display).unwrap();
        let display = MeshDisplay { coloring, limit: true, valences: true, ..Default::default() };
        let mesh =
            MeshObject::from_cage(mesh_shapes::creased_cube(), display).unwrap().with_level(2).unwrap();
        for (name, content) in [("Torus", Content::Surface(surface)), ("Cube", Content::Mesh(mesh))] {
            document.apply(&Edit::AddObject { name: name.to_owned(), content }).unwrap();
        }
        document
    }

    #[test]
    fn everything_switched_on_is_a_layer_of_its_own() {
        let document = document(SurfaceColoring::Mean);
        let (picture, _) =
            compose(&document, &View::default(), &Theme::light(), DVec2::new(300.0, 200.0)).unwrap();
        let names: Vec<&str> = picture.layers.iter().map(|layer| layer.name.as_str()).collect();
        for wanted in [
            "surfaces",
            "Torus: knot lines",
            "Torus: isolines",
            "Torus: normals",
            "Torus: control net",
            "Cube: wireframe",
            "Cube: control mesh",
            "Cube: sharp edges",
            "Cube: limits",
            "Cube: valences",
            "colour scale",
        ] {
            assert!(names.contains(&wanted), "{wanted} is missing among {names:?}");
        }
    }

    #[test]
    fn hidden_objects_and_other_kinds_are_not_in_the_box() {
        let (mut document, _) = crate::document::first_scene();
        assert_eq!(bounding_box(&document), None, "curves only");
        let content = Content::Mesh(MeshObject::from_cage(mesh_shapes::cube(), Default::default()).unwrap());
        let id = document.next_id();
        document.apply(&Edit::AddObject { name: "Cube".to_owned(), content }).unwrap();
        assert_eq!(bounding_box(&document), Some((DVec3::NEG_ONE, DVec3::ONE)), "the cube");
        document.apply(&Edit::SetVisible { object: id, visible: false }).unwrap();
        assert_eq!(bounding_box(&document), None, "hidden");
    }
}
