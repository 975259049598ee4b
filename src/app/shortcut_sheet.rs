//! The shortcut sheet: all keys by menu, and what the mouse does.

use eframe::egui::{self, Grid, Key, Modifiers, RichText, ScrollArea, Ui, Window};

use crate::app::command::{Command, Menu};
use crate::app::command_state::key_text;
use crate::app::lab::Lab;

/// What the mouse and the arrow keys do.
const HANDS: [(&str, &str); 25] = [
    ("Click", "Select; with Shift add to the selection"),
    ("Drag a point or a knot", "Move it; Shift keeps to an axis, Ctrl snaps to the grid"),
    ("Drag a curve", "Move it where it was grabbed; only the nearest control points move"),
    ("Drag the ring of a point", "Change its weight: outwards more, inwards less"),
    ("Drag on empty ground", "Select what is inside the frame"),
    ("Double click on a curve", "Insert a knot there, shape kept"),
    ("Double click on an edge", "Insert a control point there"),
    ("Right click", "Menu of the thing under the pointer"),
    ("Wheel", "Zoom at the pointer"),
    ("Alt + wheel over a point", "Change its weight"),
    ("Middle drag", "Pan"),
    ("Space + drag", "Pan"),
    ("Digits while drawing", "Type x; y, a step @x; y, a length, or a weight; Enter takes it"),
    ("Ctrl + Z while drawing", "Take back the last point"),
    ("Right click while drawing", "End the curve"),
    ("Arrow keys", "Nudge the selected points"),
    ("Shift + arrow keys", "Nudge by ten steps"),
    ("Ctrl + arrow keys", "Nudge by a tenth of a step"),
    ("Arrow keys, knot selected", "Move one copy; up adds one, down removes one"),
    ("Arrow keys, basis builder", "Up and down: degree; left and right: function"),
    ("Drag a knot on line or dial", "Move one copy, with Shift all; Alt does not snap"),
    ("Double click on the knot line", "Insert a knot there, shape kept"),
    ("Escape while dragging", "Take the drag back"),
    ("Ctrl + Y", "Redo"),
    ("Drop a file on the window", "Open it"),
];

/// Width with two columns, in logical pixels.
const WIDE: f32 = 760.0;

/// Width with one column.
const NARROW: f32 = 380.0;

/// The sheet; shut at first.
#[derive(Debug, Default)]
pub(crate) struct ShortcutSheet {
    open: bool,
}

impl ShortcutSheet {
    /// Opens or shuts it.
    pub(crate) fn toggle(&mut self) {
        self.open = !self.open;
    }

    /// Shows it if it is open.
    pub(crate) fn show(&mut self, _lab: &Lab, ui: &mut Ui) {
        if !self.open {
            return;
        }
        if !ui.text_edit_focused() && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            self.open = false;
            return;
        }
        let room = ui.ctx().content_rect().size();
        let wide = room.x > WIDE + 100.0;
        Window::new("Shortcuts")
            .open(&mut self.open)
            .collapsible(false)
            .resizable(false)
            .frame(egui::Frame::window(&ui.ctx().global_style()).inner_margin(12.0))
            .default_size([if wide { WIDE } else { NARROW }, room.y - 60.0])
            .pivot(egui::Align2::CENTER_CENTER)
            .default_pos(ui.ctx().content_rect().center())
            .show(ui.ctx(), |ui| {
                ui.set_width(if wide { WIDE } else { NARROW.min(room.x - 60.0) });
                ScrollArea::vertical().max_height(room.y - 110.0).show(ui, |ui| {
                    if wide {
                        ui.columns(2, |columns| {
                            for menu in Menu::ALL.into_iter().filter(|&menu| menu != Menu::View) {
                                keys(menu, &mut columns[0]);
                            }
                            keys(Menu::View, &mut columns[1]);
                            hands(&mut columns[1]);
                        });
                    } else {
                        Menu::ALL.into_iter().for_each(|menu| keys(menu, ui));
                        hands(ui);
                    }
                });
            });
    }
}

fn keys(menu: Menu, ui: &mut Ui) {
    let lines = Command::ALL.into_iter().filter(|command| command.menu() == menu).filter_map(|command| {
        let key = key_text(command, ui.ctx())?;
        Some((key, command.text().0.trim_end_matches('…').to_owned()))
    });
    let lines: Vec<(String, String)> = lines.collect();
    section(menu.title(), &lines, ui);
}

fn hands(ui: &mut Ui) {
    let lines: Vec<(String, String)> =
        HANDS.iter().map(|&(hand, does)| (hand.to_owned(), does.to_owned())).collect();
    section("Mouse and arrows", &lines, ui);
}

fn section(title: &str, lines: &[(String, String)], ui: &mut Ui) {
    if lines.is_empty() {
        return;
    }
    ui.add_space(6.0);
    ui.label(RichText::new(title).heading());
    ui.add_space(2.0);
    Grid::new(title).num_columns(2).spacing([14.0, 3.0]).min_col_width(96.0).min_row_height(16.0).show(
        ui,
        |ui| {
            for (key, does) in lines {
                ui.label(RichText::new(key).weak());
                ui.add(egui::Label::new(does).wrap());
                ui.end_row();
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::app::test_bench::lab;

    #[test]
    fn every_command_with_a_key_is_on_the_sheet() {
        let state = (ShortcutSheet { open: true }, lab());
        let show = |ui: &mut Ui, state: &mut (ShortcutSheet, Lab)| state.0.show(&state.1, ui);
        let mut harness = Harness::builder().with_size([1280.0, 1400.0]).build_ui_state(show, state);
        harness.run();
        for command in Command::ALL.into_iter().filter(|command| command.shortcut().is_some()) {
            let name = command.text().0.trim_end_matches('…');
            assert!(harness.query_all_by_label(name).count() > 0, "{name} is missing");
        }
        harness.key_press(Key::Escape);
        harness.run();
        assert!(!harness.state().0.open, "Escape leaves it open");
    }
}
