//! The command palette: a few letters find a command, Enter carries it out.

use eframe::egui::{
    self, Align, Button, Id, Key, Layout, Modal, Modifiers, RichText, ScrollArea, TextEdit, Ui, vec2,
};

use crate::app::command::Command;
use crate::app::command_state::{is_possible, key_text};
use crate::app::lab::Lab;

/// The palette; shut at first.
#[derive(Debug, Default)]
pub(crate) struct Palette {
    open: bool,
    typed: String,
    chosen: usize,
    fresh: bool,
}

impl Palette {
    /// Opens it, empty.
    pub(crate) fn open(&mut self) {
        *self = Self { open: true, fresh: true, ..Self::default() };
    }

    /// Whether it is open and takes the keys.
    pub(crate) fn is_open(&self) -> bool {
        self.open
    }

    /// Shows it if it is open; a chosen command is pushed to `lab.commands`.
    pub(crate) fn show(&mut self, lab: &mut Lab, ui: &mut Ui) {
        if !self.open {
            return;
        }
        let take = |key: Key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        let (down, up) = (take(Key::ArrowDown), take(Key::ArrowUp));
        let (enter, escape) = (take(Key::Enter) > 0, take(Key::Escape) > 0);
        let found = found(&self.typed, lab);
        let last = found.len().saturating_sub(1);
        self.chosen = (self.chosen + down).min(last).saturating_sub(up);
        let mut picked = enter.then(|| found.get(self.chosen).copied()).flatten();
        let top = egui::Align2::CENTER_TOP;
        let area = Modal::default_area(Id::unique("command palette")).anchor(top, vec2(0.0, 72.0));
        let modal = Modal::new(Id::unique("command palette")).area(area).show(ui.ctx(), |ui| {
            ui.set_width(440.0_f32.min(ui.ctx().content_rect().width() - 40.0));
            let field = TextEdit::singleline(&mut self.typed)
                .id(Id::unique("command palette field"))
                .hint_text("Find a command")
                .desired_width(f32::INFINITY);
            let response = ui.add(field);
            let typed = self.typed.clone();
            response.widget_info(|| {
                let mut info = egui::WidgetInfo::text_edit(true, "", &typed, "");
                info.label = Some("Find a command".to_owned());
                info
            });
            if self.fresh {
                response.request_focus();
            }
            if response.changed() {
                self.chosen = 0;
            }
            ui.add_space(4.0);
            let moved = self.fresh || down + up > 0 || response.changed();
            if let Some(command) = self.list(&found, moved, ui) {
                picked = Some(command);
            }
        });
        self.fresh = false;
        if let Some(command) = picked {
            lab.commands.push(command);
        }
        if picked.is_some() || escape || modal.backdrop_response.clicked() {
            self.open = false;
        }
    }

    fn list(&self, found: &[Command], moved: bool, ui: &mut Ui) -> Option<Command> {
        let mut picked = None;
        if found.is_empty() {
            ui.label(RichText::new("No command of that name").weak());
        }
        ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
            ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
                ui.spacing_mut().item_spacing.y = 1.0;
                for (place, &command) in found.iter().enumerate() {
                    let (text, hint) = command.text();
                    let mut button = Button::selectable(place == self.chosen, text);
                    if let Some(key) = key_text(command, ui.ctx()) {
                        button = button.shortcut_text(key);
                    }
                    let line = ui.add(button).on_hover_text(hint);
                    line.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, text));
                    if place == self.chosen && moved {
                        line.scroll_to_me(None);
                    }
                    if line.clicked() {
                        picked = Some(command);
                    }
                }
            });
        });
        picked
    }
}

/// The possible commands that fit `typed`, the best first.
fn found(typed: &str, lab: &Lab) -> Vec<Command> {
    let possible = |command: &Command| *command != Command::Palette && is_possible(*command, lab);
    let mut fitting: Vec<(i32, Command)> = Command::ALL
        .into_iter()
        .filter(possible)
        .filter_map(|command| Some((score(typed, command)?, command)))
        .collect();
    // A stable sort keeps the order of the menus among equals.
    fitting.sort_by_key(|(score, _)| -score);
    fitting.into_iter().map(|(_, command)| command).collect()
}

/// How well `typed` fits a command; its name counts more than the sentence that explains it.
fn score(typed: &str, command: Command) -> Option<i32> {
    let (text, hint) = command.text();
    let name = subsequence_score(typed, text);
    let menu =
        subsequence_score(typed, &format!("{} {text}", command.menu().title())).map(|score| score - 20);
    // In a sentence nearly every letter is found somewhere; only whole pieces count.
    let explained = (typed.len() > 2 && hint.to_lowercase().contains(&typed.to_lowercase())).then_some(-40);
    name.into_iter().chain(menu).chain(explained).max()
}

/// `None` unless the letters of `typed` appear in `text` in this order; more for beginnings of words and for runs of
/// letters, less for letters that are skipped. Spaces and capitals do not count.
fn subsequence_score(typed: &str, text: &str) -> Option<i32> {
    let wanted: Vec<char> = typed.to_lowercase().chars().filter(|letter| !letter.is_whitespace()).collect();
    let letters: Vec<char> = text.to_lowercase().chars().collect();
    let starts_word = |place: usize| place == 0 || !letters[place - 1].is_alphanumeric();
    // best[k]: the best score of a match of the first k letters that ends at the letter before, and of any match.
    let mut ending = vec![None; wanted.len() + 1];
    let mut any: Vec<Option<i32>> = vec![None; wanted.len() + 1];
    any[0] = Some(0);
    for (place, letter) in letters.iter().enumerate() {
        let mut now = vec![None; wanted.len() + 1];
        for k in 1..=wanted.len() {
            if wanted[k - 1] == *letter {
                let gain = if starts_word(place) { 8 } else { 1 };
                let run: Option<i32> = ending[k - 1].map(|score: i32| score + gain + 6);
                let leap = any[k - 1].map(|score| score + gain);
                now[k] = run.max(leap);
            }
        }
        for k in 1..=wanted.len() {
            any[k] = any[k].max(now[k]);
        }
        ending = now;
    }
    any[wanted.len()].map(|score| 4 * score - letters.len() as i32)
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::app::test_bench::lab;

    fn harness() -> Harness<'static, (Palette, Lab)> {
        let mut palette = Palette::default();
        palette.open();
        let show = |ui: &mut Ui, state: &mut (Palette, Lab)| state.0.show(&mut state.1, ui);
        let mut harness = Harness::builder().with_size([700.0, 520.0]).build_ui_state(show, (palette, lab()));
        harness.run();
        harness
    }

    fn type_words(harness: &mut Harness<'static, (Palette, Lab)>, text: &str) {
        let field = egui::accesskit::Role::TextInput;
        harness.get_by_role_and_label(field, "Find a command").type_text(text);
        harness.run();
    }

    #[test]
    fn letters_in_order_are_found_and_others_are_not() {
        assert!(subsequence_score("rfn", "Refine all intervals").is_some(), "rfn");
        assert!(subsequence_score("nfr", "Refine all").is_none(), "nfr is not in order");
        let (run, leap) =
            (subsequence_score("comb", "Curvature comb"), subsequence_score("cuco", "Curvature comb"));
        assert!(run > subsequence_score("crtm", "Curvature comb"), "a whole word {run:?}");
        assert!(leap.is_some(), "beginnings of words");
        assert!(subsequence_score("", "anything").is_some(), "nothing typed fits everything");
    }

    #[test]
    fn typing_a_name_puts_its_command_first() {
        let lab = lab();
        for (typed, command) in [
            ("insert", Command::InsertKnot),
            ("comb", Command::ToggleComb),
            ("raise", Command::ElevateDegree),
            ("dark", Command::LookDark),
            ("exfig", Command::ExportFigure),
            ("save as", Command::SaveAs),
        ] {
            let found = found(typed, &lab);
            assert_eq!(found.first(), Some(&command), "{typed:?} gives {found:?}");
        }
    }

    #[test]
    fn every_command_is_found_by_its_own_name() {
        let lab = lab();
        for command in Command::ALL.into_iter().filter(|&command| command != Command::Palette) {
            let first = found(command.text().0, &lab).first().copied();
            assert!(!is_possible(command, &lab) || first == Some(command), "{command:?} is behind {first:?}");
        }
    }

    #[test]
    fn typing_and_enter_asks_for_the_command() {
        let mut harness = harness();
        type_words(&mut harness, "dark look");
        harness.key_press(Key::Enter);
        harness.run();
        assert_eq!(harness.state().1.commands, [Command::LookDark], "asked for");
        assert!(!harness.state().0.is_open(), "still open");
    }

    #[test]
    fn arrows_choose_and_escape_shuts() {
        let mut harness = harness();
        let second = found("", &harness.state().1)[1];
        harness.key_press(Key::ArrowDown);
        harness.key_press(Key::ArrowDown);
        harness.key_press(Key::ArrowUp);
        harness.run();
        harness.key_press(Key::Enter);
        harness.run();
        assert_eq!(harness.state().1.commands, [second], "asked for");
        harness.state_mut().0.open();
        harness.run();
        harness.key_press(Key::Escape);
        harness.run();
        assert!(!harness.state().0.is_open(), "still open");
        assert_eq!(harness.state().1.commands.len(), 1, "Escape asks for nothing");
    }

    #[test]
    fn a_click_asks_for_the_command() {
        let mut harness = harness();
        type_words(&mut harness, "light");
        harness.get_by_label("Light look").click();
        harness.run();
        assert_eq!(harness.state().1.commands, [Command::LookLight], "asked for");
    }
}
