//! Commands that change the selected surface or mesh, and helpers to change contents.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::number_field::NumberEvent;
use crate::document::{
    Content, Edit, EditError, MeshDisplay, MeshObject, Object, SurfaceColoring, SurfaceDisplay, SurfaceObject,
};

/// The selected object.
pub(super) fn selected(lab: &Lab) -> Option<&Arc<Object>> {
    lab.selection.object.and_then(|id| lab.history.document().object(id))
}

/// `content` with some of its control points moved.
pub(super) fn moved(content: &Content, points: &BTreeSet<usize>, delta: DVec3) -> Result<Content, EditError> {
    match content {
        Content::Surface(surface) => surface.moved(points, delta).map(Content::Surface),
        Content::Mesh(mesh) => mesh.moved(points, delta).map(Content::Mesh),
        other => Ok(other.clone()),
    }
}

/// Changes the selected object in one step called `label`.
pub(super) fn change(
    lab: &mut Lab,
    label: &str,
    change: impl FnOnce(&Content) -> Result<Content, EditError>,
) {
    let Some(object) = selected(lab) else { return };
    let id = object.id;
    match change(&object.content) {
        Ok(content) if content == object.content => {}
        Ok(content) => {
            lab.edit(Edit::SetContent { object: id, content, label: label.to_owned() });
        }
        Err(error) => lab.problem(error.to_string()),
    }
}

/// Changes the selected object as part of the running interaction called `label`, which is begun if need be.
pub(super) fn drag(lab: &mut Lab, label: &str, change: impl FnOnce(&Content) -> Result<Content, EditError>) {
    let Some(object) = selected(lab) else { return };
    let id = object.id;
    match change(&object.content) {
        Ok(content) => {
            lab.begin(label);
            lab.update(Edit::SetContent { object: id, content, label: label.to_owned() });
        }
        // The thing stays at the last possible place; the status line says why.
        Err(error) => lab.shape_note = Some(error.to_string()),
    }
}

/// Carries out what happened to a number field. `with` makes the content that has the number, whatever stood there before.
pub(super) fn apply(
    lab: &mut Lab,
    event: Option<NumberEvent>,
    label: &str,
    with: impl FnOnce(&Content, f64) -> Result<Content, EditError>,
) {
    match event {
        None => {}
        Some(NumberEvent::Typed { to, .. }) => change(lab, label, |content| with(content, to)),
        Some(NumberEvent::Dragged { to, .. }) => drag(lab, label, |content| with(content, to)),
        Some(NumberEvent::DragEnded) => lab.commit(),
    }
}

/// Changes the surface; meshes stay as they are.
pub(super) fn on_surface(
    content: &Content,
    change: impl FnOnce(&SurfaceObject) -> Result<SurfaceObject, EditError>,
) -> Result<Content, EditError> {
    match content {
        Content::Surface(surface) => change(surface).map(Content::Surface),
        other => Ok(other.clone()),
    }
}

/// Changes the mesh; surfaces stay as they are.
pub(super) fn on_mesh(
    content: &Content,
    change: impl FnOnce(&MeshObject) -> Result<MeshObject, EditError>,
) -> Result<Content, EditError> {
    match content {
        Content::Mesh(mesh) => change(mesh).map(Content::Mesh),
        other => Ok(other.clone()),
    }
}

/// Deletes vertices of the selected control mesh; the faces around an inner one become one polygon.
pub(super) fn delete_vertices(lab: &mut Lab, vertices: BTreeSet<usize>) {
    let label = match vertices.len() {
        1 => "Delete vertex".to_owned(),
        count => format!("Delete {count} vertices"),
    };
    let before = lab.history.revision();
    change(lab, &label, |content| on_mesh(content, |mesh| mesh.without_vertices(&vertices)));
    if lab.history.revision() != before {
        lab.selection.points.clear();
    }
}

/// Changes how the selected object is shown.
fn show(lab: &mut Lab, on_surface: impl FnOnce(&mut SurfaceDisplay), on_mesh: impl FnOnce(&mut MeshDisplay)) {
    change(lab, "Change display", |content| match content {
        Content::Surface(surface) => {
            let mut display = surface.display().clone();
            on_surface(&mut display);
            surface.with_display(display).map(Content::Surface)
        }
        Content::Mesh(mesh) => {
            let mut display = mesh.display().clone();
            on_mesh(&mut display);
            mesh.with_display(display).map(Content::Mesh)
        }
        other => Ok(other.clone()),
    });
}

fn next(coloring: SurfaceColoring) -> SurfaceColoring {
    let place = SurfaceColoring::ALL.iter().position(|&other| other == coloring).unwrap_or(0);
    SurfaceColoring::ALL[(place + 1) % SurfaceColoring::ALL.len()]
}

/// Carries out a command on the selected object; `false` if it is none of this room's.
pub(super) fn execute(command: Command, lab: &mut Lab) -> bool {
    let shape_kept =
        |lab: &mut Lab, label: &str, f: &dyn Fn(&SurfaceObject) -> Result<SurfaceObject, EditError>| {
            let before = lab.history.revision();
            change(lab, label, |content| on_surface(content, f));
            if lab.history.revision() != before {
                lab.shape_note = Some("The surface is kept.".to_owned());
            }
        };
    match command {
        Command::LevelUp => {
            change(lab, "Refine", |content| on_mesh(content, |mesh| mesh.with_level(mesh.level() + 1)));
        }
        Command::LevelDown => change(lab, "Coarsen", |content| {
            on_mesh(content, |mesh| mesh.with_level(mesh.level().saturating_sub(1)))
        }),
        Command::ToggleNet => show(lab, |d| d.net = !d.net, |d| d.cage = !d.cage),
        Command::ToggleLines => show(lab, |d| d.knot_lines = !d.knot_lines, |d| d.wireframe = !d.wireframe),
        Command::ToggleNormals => show(lab, |d| d.normals = !d.normals, |_| ()),
        Command::ToggleSmooth => show(lab, |_| (), |d| d.smooth = !d.smooth),
        Command::ToggleLimits => show(lab, |_| (), |d| d.limit = !d.limit),
        Command::ToggleValences => show(lab, |_| (), |d| d.valences = !d.valences),
        Command::CycleColoring => {
            show(lab, |d| d.coloring = next(d.coloring), |d| d.coloring = next(d.coloring));
        }
        Command::RefineU => shape_kept(lab, "Refine u", &|surface| surface.refined(0)),
        Command::RefineV => shape_kept(lab, "Refine v", &|surface| surface.refined(1)),
        Command::ElevateU => shape_kept(lab, "Raise degree in u", &|surface| surface.elevated(0)),
        Command::ElevateV => shape_kept(lab, "Raise degree in v", &|surface| surface.elevated(1)),
        Command::ReverseU => change(lab, "Reverse u", |content| on_surface(content, |s| s.reversed(0))),
        Command::ReverseV => change(lab, "Reverse v", |content| on_surface(content, |s| s.reversed(1))),
        Command::Duplicate => {
            let Some(object) = lab.selection.object else { return true };
            let made = lab.edit(Edit::DuplicateObject { object });
            if let Some(&id) = made.as_ref().and_then(|made| made.created.first()) {
                lab.select(id);
            }
        }
        Command::Delete => {
            let Some(object) = lab.selection.object else { return true };
            if lab.selection.points.is_empty() {
                lab.edit(Edit::RemoveObjects { objects: vec![object] });
            } else if selected(lab).is_some_and(|object| object.mesh().is_some()) {
                delete_vertices(lab, lab.selection.points.clone());
            } else {
                lab.problem(
                    "Single points of a net cannot be deleted. Press Escape, then Delete removes the object.",
                );
            }
        }
        Command::SelectAll => {
            let count = selected(lab).map_or(0, |object| object.content.point_count());
            lab.selection.points = (0..count).collect();
        }
        _ => return false,
    }
    true
}

/// Whether the command has something to work on.
pub(crate) fn is_possible(command: Command, lab: &Lab) -> bool {
    let object = selected(lab);
    let mesh = object.and_then(|object| object.mesh());
    let surface = object.and_then(|object| object.surface());
    match command {
        Command::LevelUp => mesh.is_some_and(|mesh| mesh.level() < mesh.highest_level()),
        Command::LevelDown => mesh.is_some_and(|mesh| mesh.level() > 0),
        Command::ToggleSmooth | Command::ToggleLimits | Command::ToggleValences | Command::ExportMesh => {
            mesh.is_some()
        }
        Command::ToggleNet | Command::ToggleLines | Command::CycleColoring | Command::SelectAll => {
            mesh.is_some() || surface.is_some()
        }
        Command::ToggleNormals
        | Command::RefineU
        | Command::RefineV
        | Command::ElevateU
        | Command::ElevateV
        | Command::ReverseU
        | Command::ReverseV => surface.is_some(),
        _ => true,
    }
}

/// Whether what the command switches is on; `None` for a command of another kind.
pub(crate) fn is_on(command: Command, lab: &Lab) -> Option<bool> {
    let object = selected(lab);
    let mesh = object.and_then(|object| object.mesh()).map(MeshObject::display);
    let surface = object.and_then(|object| object.surface()).map(SurfaceObject::display);
    let either = |of_surface: fn(&SurfaceDisplay) -> bool, of_mesh: fn(&MeshDisplay) -> bool| {
        surface.map(of_surface).or_else(|| mesh.map(of_mesh)).unwrap_or(false)
    };
    Some(match command {
        Command::ToggleNet => either(|d| d.net, |d| d.cage),
        Command::ToggleLines => either(|d| d.knot_lines, |d| d.wireframe),
        Command::ToggleNormals => either(|d| d.normals, |_| false),
        Command::ToggleSmooth => either(|_| false, |d| d.smooth),
        Command::ToggleLimits => either(|_| false, |d| d.limit),
        Command::ToggleValences => either(|_| false, |d| d.valences),
        Command::ToggleParallel => !lab.view.eye.orthographic,
        _ => return None,
    })
}
