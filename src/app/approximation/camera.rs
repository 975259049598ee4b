//! Panning and zooming the plots, each axis with a scale of its own.

use eframe::egui::{self, Rect, Ui};
use glam::DVec2;

use crate::app::approximation::canvas::{Canvas, page_from_screen};
use crate::app::hands;
use crate::app::lab::Lab;
use crate::document::{ObjectId, PlotWindow};

impl Canvas {
    pub(super) fn move_camera(
        &mut self,
        object: ObjectId,
        lab: &mut Lab,
        response: &egui::Response,
        rect: Rect,
        ui: &Ui,
    ) {
        let Some(layout) = self.painted.as_ref().map(|painted| painted.layout.clone()) else { return };
        if let Some(moved) = hands::panned(&mut self.panning, self.gesture.is_some(), response, ui) {
            let shift = moved * layout.main.per_point();
            let window = PlotWindow {
                x: layout.main.x.map(|end| end - shift.x),
                y: layout.main.y.map(|end| end - shift.y),
            };
            look(lab, object, window);
        }
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let factor = f64::from(pinch) * (f64::from(scroll.y) / 240.0).exp();
        if let Some(pointer) =
            ui.input(|input| input.pointer.hover_pos()).filter(|_| response.contains_pointer())
            && (factor - 1.0).abs() > 1e-9
        {
            self.zoom(lab, Some(page_from_screen(pointer, rect)), 1.0 / factor);
        }
    }

    /// Makes the ranges `factor` times as long around a place of the page: that of x alone below the plot, that of y alone left of it.
    pub(super) fn zoom(&self, lab: &mut Lab, about: Option<DVec2>, factor: f64) {
        let Some(painted) = &self.painted else { return };
        let main = &painted.layout.main;
        let about = about.unwrap_or((main.low + main.high) * 0.5);
        let (x, y) = main.numbers(about);
        let around = |[low, high]: [f64; 2], at: f64| [at + (low - at) * factor, at + (high - at) * factor];
        let mut window = PlotWindow { x: main.x, y: main.y };
        if about.x >= main.low.x {
            window.x = around(window.x, x);
        }
        if about.y >= main.low.y {
            window.y = around(window.y, y);
        }
        look(lab, painted.object.id, window);
    }
}

/// Looks at `window` if numbers can tell its places apart.
fn look(lab: &mut Lab, object: ObjectId, window: PlotWindow) {
    let fine = |[low, high]: [f64; 2]| {
        let length = high - low;
        length > 1e-11 * low.abs().max(high.abs()) && (1e-280..1e280).contains(&length)
    };
    if window.check().is_ok() && fine(window.x) && fine(window.y) {
        lab.view.plots.insert(object, window);
    }
}
