//! What long work beside the window's thread says over a canvas: how far it is, with a button that stops it; or that it was stopped.

use eframe::egui::{ProgressBar, Rect, RichText, Ui, UiBuilder, vec2};

use crate::app::painter::color32;
use crate::figure::theme::Theme;

/// Seconds after which progress is shown.
pub(crate) const SHOWN_AFTER: f32 = 0.4;

/// How the work stands.
#[derive(Clone, Copy, Debug)]
pub(crate) enum State {
    /// The part done and the seconds since the start.
    Running(f32, f32),
    /// It was given up; the picture is that of before.
    Stopped,
}

/// Shows `state` at the lower edge of `rect`; `doing` and `again` are words such as "Solving" and "Solve". Says whether its button was clicked:
/// to stop the work that runs, or to do the stopped work after all.
pub(crate) fn show(state: State, doing: &str, again: &str, rect: Rect, theme: &Theme, ui: &mut Ui) -> bool {
    if let State::Running(_, seconds) = state {
        ui.ctx().request_repaint_after(std::time::Duration::from_millis(60));
        if seconds < SHOWN_AFTER {
            return false;
        }
    }
    // To the right of the little axes in the corner.
    let strip =
        Rect::from_min_size(rect.left_bottom() + vec2(108.0, -64.0), vec2(330.0, 26.0)).intersect(rect);
    let mut ui = ui.new_child(UiBuilder::new().max_rect(strip));
    let response = ui.horizontal(|ui| match state {
        State::Running(part, _) => {
            ui.add(ProgressBar::new(part).desired_width(220.0).text(doing));
            ui.button("Cancel").clicked()
        }
        State::Stopped => {
            let said = RichText::new("Stopped; the picture is that of before.");
            ui.label(said.color(color32(theme.warning)));
            ui.button(again).clicked()
        }
    });
    response.inner
}
