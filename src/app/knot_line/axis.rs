//! The horizontal axis of the knot line: which parameters are seen, and where. Zoom and pan in f64.

use eframe::egui::{Id, PointerButton, Rect, Response, Ui};

use crate::core::bspline::SplineSpace;

/// Largest magnification of the axis.
const MAX_ZOOM: f64 = 1e6;

/// The visible part of the parameter axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    /// Parameters at the left and right edge.
    low: f64,
    high: f64,
    /// Screen x of the edges.
    left: f64,
    right: f64,
}

/// Zoom and pan of the axis as shares of the whole: kept between frames.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Window {
    start: f64,
    length: f64,
}

impl Axis {
    /// The axis across `rect`, with the zoom that was chosen for `id`.
    pub(super) fn new(ui: &Ui, id: Id, space: &SplineSpace, rect: Rect) -> Self {
        let (low, high) = extent(space);
        let window =
            ui.data(|data| data.get_temp::<Window>(id)).unwrap_or(Window { start: 0.0, length: 1.0 });
        let length = high - low;
        Self {
            low: low + window.start * length,
            high: low + (window.start + window.length) * length,
            left: f64::from(rect.left()),
            right: f64::from(rect.right()),
        }
    }

    /// The screen x of `parameter`, kept within reach of f32.
    pub(super) fn x(&self, parameter: f64) -> f32 {
        let share = (parameter - self.low) / (self.high - self.low);
        (self.left + share * (self.right - self.left)).clamp(-1e5, 1e5) as f32
    }

    /// The parameter at screen `x`.
    pub(super) fn parameter(&self, x: f32) -> f64 {
        let share = (f64::from(x) - self.left) / (self.right - self.left).max(1.0);
        self.low + share * (self.high - self.low)
    }

    /// Length in parameter of one pixel.
    pub(super) fn per_pixel(&self) -> f64 {
        (self.high - self.low) / (self.right - self.left).max(1.0)
    }

    /// The parameters at both edges.
    pub(super) fn visible(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// What is shown when nothing is zoomed: D, and as much beyond it as its outer knots need, up to a quarter of its length.
fn extent(space: &SplineSpace) -> (f64, f64) {
    let (left, right) = space.parameter_interval();
    let length = right - left;
    if space.is_periodic() {
        return (left - 0.12 * length, right + 0.12 * length);
    }
    let knots = space.knots();
    let outer =
        |edge: f64, knot: f64| (edge - knot).abs().clamp(0.02 * length, 0.25 * length) + 0.02 * length;
    (left - outer(left, knots[0]), right + outer(right, knots[knots.len() - 1]))
}

/// Wheel zooms at the pointer, middle drag pans. Returns whether anything is zoomed.
pub(super) fn navigate(ui: &Ui, id: Id, rect: Rect, response: &Response) -> bool {
    let whole = Window { start: 0.0, length: 1.0 };
    let old = ui.data(|data| data.get_temp::<Window>(id)).unwrap_or(whole);
    let mut window = old;
    if response.contains_pointer()
        && let Some(pointer) = response.hover_pos()
    {
        let (scroll, zoom) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let factor = f64::from(zoom) * (f64::from(scroll.y) / 200.0).exp();
        if (factor - 1.0).abs() > 1e-6 {
            let share = f64::from((pointer.x - rect.left()) / rect.width().max(1.0));
            let fixed = window.start + share * window.length;
            window.length = (window.length / factor).clamp(1.0 / MAX_ZOOM, 1.0);
            window.start = fixed - share * window.length;
        }
        window.start -= f64::from(scroll.x / rect.width().max(1.0)) * window.length;
    }
    if response.dragged_by(PointerButton::Middle) {
        window.start -= f64::from(response.drag_delta().x / rect.width().max(1.0)) * window.length;
    }
    window.start = window.start.clamp(0.0, 1.0 - window.length);
    if window != old {
        ui.data_mut(|data| data.insert_temp(id, window));
        ui.ctx().request_repaint();
    }
    window.length < 1.0
}

/// Shows the whole axis again.
pub(super) fn reset(ui: &Ui, id: Id) {
    ui.data_mut(|data| data.remove::<Window>(id));
}
