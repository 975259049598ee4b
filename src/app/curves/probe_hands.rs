//! Hands on the probe line: one handle at each end; the line itself is part of the display and of the undo.

use eframe::egui::{self, Key, Rect, Ui, vec2};
use glam::DVec2;

use crate::app::hands;
use crate::app::lab::{Lab, Tool};
use crate::app::painter::{screen_from_world, world_from_screen};
use crate::document::{CurveDisplay, Edit, ObjectId};
use crate::figure::composition::{MANY_FOR_LOOKS, probe_ends};
use crate::figure::picture::Viewport;

/// Distance in pt up to which a handle is under the pointer.
const REACH: f32 = 9.0;
/// The accessible names of the handles.
const LABELS: [&str; 2] = ["Start of the probe line", "End of the probe line"];

/// The hands on the probe line.
#[derive(Debug, Default)]
pub(super) struct ProbeHands {
    held: Option<usize>,
}

/// The selected curve with its display and the ends of its probe line, if that is shown.
fn shown(lab: &Lab) -> Option<(ObjectId, CurveDisplay, [DVec2; 2])> {
    let object = lab.history.document().object(lab.selection.object?)?;
    let (curve, display) = (object.curve()?, object.curve_display()?);
    let shown = object.visible && display.probe_line && lab.tool == Tool::Select;
    (shown && curve.points().len() <= MANY_FOR_LOOKS)
        .then(|| (object.id, display.clone(), probe_ends(curve, display)))
}

impl ProbeHands {
    /// Drags an end, with Alt the whole line; whether the pointer is taken by it.
    pub(super) fn drag(
        &mut self,
        lab: &mut Lab,
        response: &egui::Response,
        viewport: &Viewport,
        rect: Rect,
        ui: &Ui,
    ) -> bool {
        let Some((object, display, ends)) = shown(lab) else {
            if self.held.take().is_some() {
                lab.commit();
            }
            return false;
        };
        let (down, pointer, alt, escape) = ui.input(|input| {
            let pointer = &input.pointer;
            (
                pointer.primary_down(),
                pointer.latest_pos(),
                input.modifiers.alt,
                input.key_pressed(Key::Escape),
            )
        });
        if let Some(at) = hands::pressed_at(ui).filter(|at| rect.contains(*at) && response.contains_pointer())
        {
            let near = |end: &usize| screen_from_world(viewport, rect, ends[*end]).distance(at) <= REACH;
            self.held = (0..2).find(near);
        }
        let Some((end, pointer)) = self.held.zip(pointer) else { return false };
        let world = world_from_screen(viewport, rect, pointer);
        let mut probe = ends;
        probe[end] = world;
        if alt {
            probe[1 - end] = ends[1 - end] + world - ends[end];
        }
        if world.is_finite() && probe != ends && probe[0] != probe[1] && !escape {
            lab.begin("Move probe line");
            lab.update(Edit::SetDisplay { object, display: CurveDisplay { probe: Some(probe), ..display } });
        }
        if !down || escape {
            self.held = None;
            lab.commit();
        }
        true
    }

    /// Tells the names of the handles.
    pub(super) fn announce(lab: &Lab, viewport: &Viewport, rect: Rect, ui: &Ui) {
        let Some((_, _, ends)) = shown(lab) else { return };
        for (at, label) in ends.into_iter().zip(LABELS) {
            let at = screen_from_world(viewport, rect, at);
            let area = Rect::from_center_size(at, vec2(2.0 * REACH, 2.0 * REACH));
            if rect.contains_rect(area) {
                let id = ui.make_persistent_id(("handle", label));
                let response = ui.interact(area, id, egui::Sense::hover());
                response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, label));
            }
        }
    }
}
