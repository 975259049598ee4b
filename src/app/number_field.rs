//! A number that can be typed, and dragged where that makes sense.
//!
//! At rest it shows a short form; when it is clicked, all digits. Enter and Tab take the number, Escape leaves it as it
//! was. A text that is no number stays as it is, red, with the reason beside it, until it is mended or given up.

use eframe::egui::{
    self, Align2, CursorIcon, FontId, Id, Key, Response, Role, Sense, StrokeKind, TextEdit, TextStyle, Ui,
    WidgetInfo, vec2,
};

use crate::app::lab::Lab;
use crate::app::number_text::{full, round_to_step, short};
use crate::course::number_text::parse_number;
use crate::document::Edit;

/// How dragging sideways changes the number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Drag {
    /// Not at all.
    Off,
    /// By so much per pixel.
    PerPixel(f64),
    /// By a factor; 100 pixels double the number. Keeps its sign.
    Factor,
}

/// What happened to the number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NumberEvent {
    /// It was typed.
    Typed {
        /// The number that stood there.
        from: f64,
        /// The number typed.
        to: f64,
    },
    /// It is being dragged.
    Dragged {
        /// The number at the beginning of the drag.
        from: f64,
        /// Where it stands now.
        to: f64,
    },
    /// The drag is over.
    DragEnded,
}

/// The field and what happened to it.
#[derive(Debug)]
pub(crate) struct NumberResponse {
    /// The field.
    pub(crate) response: Response,
    /// What happened.
    pub(crate) event: Option<NumberEvent>,
}

/// A text that is being typed, or one that could not be taken.
#[derive(Clone, Debug)]
struct Draft {
    text: String,
    /// Bits of the number that the draft started from: if it changes from outside, the draft is void.
    started_from: u64,
    reason: Option<String>,
}

/// A number field under construction.
#[derive(Debug)]
pub(crate) struct NumberField<'a> {
    label: &'a str,
    value: f64,
    width: f32,
    drag: Drag,
    check: fn(f64) -> Result<(), String>,
}

/// Weights and other numbers that must be positive.
pub(crate) fn positive(value: f64) -> Result<(), String> {
    if value > 0.0 { Ok(()) } else { Err(format!("{value} is not positive")) }
}

impl<'a> NumberField<'a> {
    /// A field that is called `label` (for screen readers and tests) and shows `value`.
    pub(crate) fn new(label: &'a str, value: f64) -> Self {
        Self { label, value, width: 64.0, drag: Drag::Off, check: |_| Ok(()) }
    }

    /// Width in points.
    pub(crate) fn width(mut self, width: f32) -> Self {
        self.width = width;
        self
    }

    /// How it is dragged.
    pub(crate) fn drag(mut self, drag: Drag) -> Self {
        self.drag = drag;
        self
    }

    /// What the number must be; the reason is shown when it is not.
    pub(crate) fn check(mut self, check: fn(f64) -> Result<(), String>) -> Self {
        self.check = check;
        self
    }

    /// Shows the field; `salt` tells it from others in the same `ui`.
    pub(crate) fn show(self, ui: &mut Ui, salt: impl egui::AsIdSalt) -> NumberResponse {
        let id = ui.make_persistent_id(salt);
        let height = ui.spacing().interact_size.y;
        let (rect, _) = ui.allocate_exact_size(vec2(self.width, height), Sense::hover());
        let mut draft: Option<Draft> = ui.data(|data| data.get_temp(id));
        if draft.as_ref().is_some_and(|draft| draft.started_from != self.value.to_bits()) {
            draft = None;
        }
        // Escape and Tab take the focus away before the frame begins; the editor then says what becomes of the text.
        let editing =
            ui.memory(|memory| memory.has_focus(id) || (draft.is_some() && memory.had_focus_last_frame(id)));
        let result = if editing {
            self.show_editor(ui, id, rect, &mut draft)
        } else {
            self.show_resting(ui, id, rect, &mut draft)
        };
        ui.data_mut(|data| match draft {
            Some(draft) => {
                data.insert_temp(id, draft);
            }
            None => data.remove::<Draft>(id),
        });
        result
    }

    fn read(&self, text: &str) -> Result<f64, String> {
        let value = parse_number(text).map_err(|error| error.to_string())?;
        (self.check)(value).map(|()| value)
    }

    fn show_editor(self, ui: &mut Ui, id: Id, rect: egui::Rect, draft: &mut Option<Draft>) -> NumberResponse {
        let starts = draft.is_none();
        let mut current = draft.take().unwrap_or_else(|| Draft {
            text: full(self.value),
            started_from: self.value.to_bits(),
            reason: None,
        });
        if starts {
            select_all(ui, id, &current.text);
        }
        current.reason = self.read(&current.text).err();
        let ink =
            if current.reason.is_some() { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
        let editor = TextEdit::singleline(&mut current.text)
            .id(id)
            .font(TextStyle::Body)
            .text_color(ink)
            .margin(vec2(4.0, 2.0))
            .desired_width(rect.width() - 8.0);
        let response = ui.put(rect, editor).accessible_name(self.label);
        let mut event = None;
        if response.lost_focus() {
            // The key that takes the number is no shortcut.
            ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::Enter));
            if ui.input(|input| input.key_pressed(Key::Escape)) {
                return NumberResponse { response, event };
            }
            match self.read(&current.text) {
                Ok(to) => {
                    if to.to_bits() != self.value.to_bits() {
                        event = Some(NumberEvent::Typed { from: self.value, to });
                    }
                }
                Err(reason) => {
                    current.reason = Some(reason);
                    *draft = Some(current);
                }
            }
        } else {
            if let Err(reason) = self.read(&current.text) {
                response.show_tooltip_text(&reason);
            }
            *draft = Some(current);
        }
        NumberResponse { response, event }
    }

    fn show_resting(
        self,
        ui: &mut Ui,
        id: Id,
        rect: egui::Rect,
        draft: &mut Option<Draft>,
    ) -> NumberResponse {
        let sense = if self.drag == Drag::Off { Sense::click() } else { Sense::click_and_drag() };
        let mut response = ui.interact(rect, id, sense);
        response = response.on_hover_cursor(match self.drag {
            Drag::Off => CursorIcon::Text,
            _ => CursorIcon::ResizeHorizontal,
        });
        let text = draft.as_ref().map_or_else(|| short(self.value), |draft| draft.text.clone());
        if ui.is_rect_visible(rect) {
            let visuals = ui.style().interact(&response);
            let broken = draft.is_some();
            let outline =
                if broken { egui::Stroke::new(1.0, ui.visuals().error_fg_color) } else { visuals.bg_stroke };
            let ground = ui.visuals().text_edit_bg_color();
            ui.painter().rect(rect, 3.0, ground, outline, StrokeKind::Inside);
            let ink = if broken { ui.visuals().error_fg_color } else { visuals.text_color() };
            let mut font: FontId = TextStyle::Body.resolve(ui.style());
            let wide = ui.painter().layout_no_wrap(text.clone(), font.clone(), ink).size().x;
            // A long number is set smaller rather than cut.
            font.size *= ((rect.width() - 6.0) / wide.max(1.0)).clamp(0.7, 1.0);
            ui.painter_at(rect.shrink(1.0)).text(
                rect.right_center() - vec2(4.0, 0.0),
                Align2::RIGHT_CENTER,
                &text,
                font,
                ink,
            );
        }
        let label = self.label;
        let shown = text.clone();
        response.widget_info(|| WidgetInfo {
            current_text_value: Some(shown.clone()),
            ..WidgetInfo::labeled(Role::TextInput, true, label)
        });
        if let Some(Draft { reason: Some(reason), .. }) = draft {
            response = response.on_hover_text(reason.as_str());
        }
        if response.clicked() {
            response.request_focus();
        }
        let event = self.dragged(ui, id, &response);
        if event.is_some() {
            *draft = None;
        }
        NumberResponse { response, event }
    }

    fn dragged(&self, ui: &Ui, id: Id, response: &Response) -> Option<NumberEvent> {
        if self.drag == Drag::Off {
            return None;
        }
        let start_id = id.with("start of drag");
        if response.drag_started() {
            ui.data_mut(|data| data.insert_temp(start_id, self.value));
        }
        if response.drag_stopped() {
            return Some(NumberEvent::DragEnded);
        }
        if !response.dragged() {
            return None;
        }
        let start = ui.data(|data| data.get_temp::<f64>(start_id)).unwrap_or(self.value);
        let slow = if ui.input(|input| input.modifiers.shift) { 0.1 } else { 1.0 };
        let pixels = f64::from(response.total_drag_delta().unwrap_or_default().x) * slow;
        let value = match self.drag {
            Drag::Off => return None,
            Drag::PerPixel(step) => round_to_step(start + pixels * step, step * slow),
            Drag::Factor => {
                let value = start * (pixels / 100.0).exp2();
                round_to_step(value, value * 0.005 * slow)
            }
        };
        (value.is_finite() && (self.check)(value).is_ok())
            .then_some(NumberEvent::Dragged { from: start, to: value })
    }
}

/// Carries `event` out on the document: typing is one undo step, a whole drag is one, called `name`.
///
/// `edit` makes the edit from the number at the beginning and the new one.
pub(crate) fn apply(
    lab: &mut Lab,
    event: Option<NumberEvent>,
    name: &str,
    edit: impl FnOnce(f64, f64) -> Edit,
) {
    match event {
        None => {}
        Some(NumberEvent::Typed { from, to }) => {
            lab.edit(edit(from, to));
        }
        Some(NumberEvent::Dragged { from, to }) => {
            lab.begin(name);
            lab.update(edit(from, to));
        }
        Some(NumberEvent::DragEnded) => lab.commit(),
    }
}

fn select_all(ui: &Ui, id: Id, text: &str) {
    let mut state = egui::text_edit::TextEditState::load(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(egui::text::CCursorRange::select_all_str(text)));
    state.store(ui.ctx(), id);
}
