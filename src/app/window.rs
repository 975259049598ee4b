//! The window: panels around a workspace, shortcuts, and the order of work in one frame.

use std::path::PathBuf;

use eframe::egui::{self, Panel, Ui};

use crate::app::command::Command;
use crate::app::directories::Directories;
use crate::app::files::Files;
use crate::app::lab::{Lab, SidePage, Tone};
use crate::app::painter::color32;
use crate::app::palette::Palette;
use crate::app::shortcut_sheet::ShortcutSheet;
use crate::app::side_rooms;
use crate::app::smoke_log::SmokeLog;
use crate::app::workspace::{self, Room, Workspace};
use crate::app::{
    LEFT_PANEL, RIGHT_PANEL, files, lesson_panel, look, menu_bar, object_list, scene_view, status_bar,
    stepper_panel, toolbar,
};
use crate::document::{StepperKind, first_scene};
use crate::figure::theme::Theme;

/// The program with its window.
pub struct LabApp {
    lab: Lab,
    /// In the order of [`Room::ALL`].
    workspaces: Vec<Box<dyn Workspace>>,
    files: Files,
    palette: Palette,
    shortcut_sheet: ShortcutSheet,
    notices: egui_notify::Toasts,
    smoke_log: Option<SmokeLog>,
    styled: Option<&'static str>,
}

impl std::fmt::Debug for LabApp {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LabApp").field("lab", &self.lab).finish_non_exhaustive()
    }
}

/// Opens the window, with the document in `file` or the first scene.
///
/// # Errors
///
/// What eframe reports when there is no display or no graphics adapter.
pub fn run(file: Option<PathBuf>) -> eframe::Result {
    let viewport = egui::ViewportBuilder::default()
        .with_title("Spline Lab")
        .with_app_id("spline-lab")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([640.0, 420.0])
        .with_drag_and_drop(true);
    // Nothing here has colours that run so slowly that bands would be seen; without a GPU it would take a quarter of a frame.
    let options = eframe::NativeOptions { viewport, dithering: false, ..Default::default() };
    let start = |cc: &eframe::CreationContext<'_>| -> Box<dyn eframe::App> {
        scene_view::offer_gpu(&cc.egui_ctx, cc.wgpu_render_state.as_ref());
        Box::new(LabApp::new(&cc.egui_ctx, file))
    };
    eframe::run_native("spline-lab", options, Box::new(|cc| Ok(start(cc))))
}

impl LabApp {
    /// The program as it starts, with the document in `file` or the first scene.
    pub fn new(ctx: &egui::Context, file: Option<PathBuf>) -> Self {
        Self::in_directories(ctx, file, Directories::of_user())
    }

    fn in_directories(ctx: &egui::Context, file: Option<PathBuf>, directories: Directories) -> Self {
        ctx.set_fonts(look::fonts());
        ctx.options_mut(|options| {
            options.zoom_with_keyboard = false;
            // As most desktops have it; shorter ones fail where software draws a frame in a tenth of a second.
            options.input_options.max_double_click_delay = 0.5;
        });
        let (document, view) = first_scene();
        let mut lab = Lab::new(document, view);
        let files = Files::in_directories(file, &mut lab, directories);
        Self {
            lab,
            workspaces: workspace::all(),
            files,
            palette: Palette::default(),
            shortcut_sheet: ShortcutSheet::default(),
            notices: egui_notify::Toasts::default()
                .with_anchor(egui_notify::Anchor::BottomRight)
                // Above the status line.
                .with_margin(egui::vec2(12.0, 40.0)),
            smoke_log: SmokeLog::from_environment(),
            styled: None,
        }
    }

    /// The program with the first scene, without the files and preferences of whoever runs the tests.
    pub fn for_tests(ctx: &egui::Context) -> Self {
        let mut app = Self::in_directories(ctx, None, Directories::none());
        app.lab.at_once = true;
        app
    }

    /// The shared state.
    pub fn lab(&self) -> &Lab {
        &self.lab
    }

    /// The shared state, to be changed by tests and by what starts the program.
    pub fn lab_mut(&mut self) -> &mut Lab {
        &mut self.lab
    }

    /// One frame.
    pub fn frame(&mut self, ui: &mut Ui) {
        if self.styled != Some(self.lab.theme.name) {
            look::apply(&self.lab.theme, ui.ctx());
            self.styled = Some(self.lab.theme.name);
        }
        self.lab.hovered = std::mem::take(&mut self.lab.hovering);
        self.lab.tidy_selection();
        let busy = self.files.is_asking() || self.palette.is_open();
        Panel::top("menu").show(ui, |ui| {
            menu_bar::show(&mut self.lab, &mut self.files, ui);
            let current = self.current();
            toolbar::show(&mut self.lab, &mut *self.workspaces[current], ui);
        });
        let current = self.current();
        let said = self.workspaces[current].status(&self.lab);
        Panel::bottom("status").show(ui, |ui| status_bar::show(&self.lab, &said, ui));
        self.side_panels(ui);
        // A click in the list of objects may have led to another room.
        let current = self.current();
        let workspace = &mut self.workspaces[current];
        workspace.panels(&mut self.lab, ui);
        egui::CentralPanel::default()
            .frame(egui::Frame::NONE)
            .show(ui, |ui| workspace.canvas(&mut self.lab, ui));
        self.palette.show(&mut self.lab, ui);
        self.shortcut_sheet.show(&self.lab, ui);
        self.files.ui(&mut self.lab, ui);
        if !busy {
            self.read_shortcuts(ui);
        }
        for command in std::mem::take(&mut self.lab.commands) {
            self.execute(command, ui.ctx());
        }
        self.say(ui.ctx());
        if let Some(log) = &mut self.smoke_log {
            log.frame(&self.lab, &*self.workspaces[current], ui.ctx());
        }
    }

    /// Index of the workspace of the room that the lab shows.
    fn current(&self) -> usize {
        let room = self.lab.room();
        self.workspaces.iter().position(|workspace| workspace.room() == room).unwrap_or(0)
    }

    fn side_panels(&mut self, ui: &mut Ui) {
        let current = self.current();
        let (lab, files) = (&mut self.lab, &mut self.files);
        let workspace = &mut self.workspaces[current];
        // Larger type needs wider panels.
        let scale = lab.theme.text_scale as f32;
        let open = |lab: &Lab, name: &str| lab.view.panels.get(name).copied().unwrap_or(true);
        if open(lab, LEFT_PANEL) {
            let size = files.panel_size(LEFT_PANEL, 214.0);
            let panel = Panel::left(LEFT_PANEL)
                .default_size(size)
                .size_range(170.0 * scale..=360.0 * scale)
                .show(ui, |ui| {
                    object_list::show(lab, ui);
                    ui.add_space(10.0);
                    lesson_panel::show_list(lab, ui);
                });
            files.note_panel_size(LEFT_PANEL, panel.response.rect.width());
        }
        if open(lab, RIGHT_PANEL) {
            let size = files.panel_size(RIGHT_PANEL, 290.0);
            let panel = Panel::right(RIGHT_PANEL)
                .default_size(size)
                .size_range(272.0 * scale..=560.0 * scale)
                .show(ui, |ui| {
                    ui.add_space(4.0);
                    ui.horizontal(|ui| {
                        for (page, text) in [
                            (SidePage::Inspector, "Inspector"),
                            (SidePage::Stepper, "Stepper"),
                            (SidePage::Rooms, "Rooms"),
                            (SidePage::Lesson, "Lesson"),
                        ] {
                            // Algorithms step by step and rooms are shown for curves.
                            if matches!(page, SidePage::Stepper | SidePage::Rooms)
                                && lab.room() != Room::Curves
                            {
                                continue;
                            }
                            ui.selectable_value(&mut lab.side, page, text);
                        }
                    });
                    ui.separator();
                    if matches!(lab.side, SidePage::Stepper | SidePage::Rooms) && lab.room() != Room::Curves {
                        lab.side = SidePage::Inspector;
                    }
                    lab.stepper.open = lab.side == SidePage::Stepper;
                    lab.rooms.open = lab.side == SidePage::Rooms;
                    match lab.side {
                        SidePage::Inspector => workspace.inspector(lab, ui),
                        SidePage::Stepper => stepper_panel::show(lab, ui),
                        SidePage::Rooms => side_rooms::show(lab, ui),
                        SidePage::Lesson => lesson_panel::show(lab, ui),
                    }
                });
            files.note_panel_size(RIGHT_PANEL, panel.response.rect.width());
        } else {
            lab.stepper.open = false;
            lab.rooms.open = false;
        }
    }

    /// Shortcuts act unless somebody is typing.
    fn read_shortcuts(&mut self, ui: &Ui) {
        if ui.text_edit_focused() {
            return;
        }
        // A shortcut with more modifiers must be asked for first, or Ctrl+Z would answer to Ctrl+Shift+Z.
        let mut commands: Vec<Command> =
            Command::ALL.into_iter().filter(|command| command.shortcut().is_some()).collect();
        commands.retain(|command| command.room().is_none_or(|room| room == self.lab.room()));
        commands.sort_by_key(|command| {
            command.shortcut().map_or(0, |shortcut| {
                let keys = shortcut.modifiers;
                -(i32::from(keys.shift) + i32::from(keys.command) + i32::from(keys.alt))
            })
        });
        for command in commands {
            if let Some(shortcut) = command.shortcut()
                && ui.input_mut(|input| input.consume_shortcut(&shortcut))
            {
                self.lab.commands.push(command);
            }
        }
        let redo = egui::KeyboardShortcut::new(egui::Modifiers::COMMAND, egui::Key::Y);
        if ui.input_mut(|input| input.consume_shortcut(&redo)) {
            self.lab.commands.push(Command::Redo);
        }
    }

    fn execute(&mut self, command: Command, ctx: &egui::Context) {
        let current = self.current();
        let lab = &mut self.lab;
        if self.workspaces[current].execute(command, lab) || self.files.execute(command, lab, ctx) {
            return;
        }
        match command {
            Command::Undo | Command::Redo => {
                let step = if command == Command::Undo { lab.history.undo() } else { lab.history.redo() };
                if step.is_some() {
                    lab.shape_note = None;
                    lab.before = None;
                    lab.tidy_selection();
                }
            }
            Command::ToggleLeftPanel => toggle(lab, LEFT_PANEL),
            Command::ToggleRightPanel => toggle(lab, RIGHT_PANEL),
            Command::ToggleKnotLine => toggle(lab, crate::app::KNOT_LINE),
            Command::LookLight => lab.theme = Theme::light(),
            Command::LookDark => lab.theme = Theme::dark(),
            Command::LookPresentation => lab.theme = Theme::presentation(),
            Command::StepperPlay => {
                open_stepper(lab);
                lab.stepper.playing = !lab.stepper.playing;
                let last = last_frame(lab);
                if lab.stepper.playing && lab.stepper.frame >= last {
                    lab.stepper.frame = 0;
                }
            }
            Command::StepForward => {
                open_stepper(lab);
                lab.stepper.playing = false;
                lab.stepper.frame = (lab.stepper.frame + 1).min(last_frame(lab));
            }
            Command::StepBack => {
                open_stepper(lab);
                lab.stepper.playing = false;
                lab.stepper.frame = lab.stepper.frame.saturating_sub(1);
            }
            Command::NextAlgorithm => turn_algorithm(lab, 1),
            Command::PreviousAlgorithm => turn_algorithm(lab, StepperKind::ALL.len() - 1),
            Command::NextLesson => turn_page(lab, 1),
            Command::PreviousLesson => turn_page(lab, -1),
            Command::BackToExample => files::back_to_example(lab),
            Command::Palette => self.palette.open(),
            Command::ShortcutSheet => self.shortcut_sheet.toggle(),
            _ => {}
        }
    }

    fn say(&mut self, ctx: &egui::Context) {
        for message in self.lab.messages.drain(..) {
            let seconds = 4.0 + 0.06 * message.text.len() as f32;
            let theme = &self.lab.theme;
            let (sign, color) = match message.tone {
                Tone::Done => ("•", theme.accent),
                Tone::Problem => ("!", theme.error),
            };
            // The signs that the notices bring along are in none of our fonts.
            let notice = self.notices.custom(message.text, sign.to_owned(), color32(color));
            notice
                .closable(false)
                .show_progress_bar(false)
                .duration(std::time::Duration::from_secs_f32(seconds));
        }
        self.notices.show(ctx);
    }
}

impl eframe::App for LabApp {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.frame(ui);
    }

    fn on_exit(&mut self) {
        self.files.close(&mut self.lab);
    }
}

fn toggle(lab: &mut Lab, panel: &str) {
    let open = lab.view.panels.get(panel).copied().unwrap_or(true);
    lab.view.panels.insert(panel.to_owned(), !open);
}

fn open_stepper(lab: &mut Lab) {
    lab.view.panels.insert(RIGHT_PANEL.to_owned(), true);
    lab.side = SidePage::Stepper;
    lab.stepper.open = true;
}

/// Chooses the algorithm that comes `steps` later, around the list.
fn turn_algorithm(lab: &mut Lab, steps: usize) {
    open_stepper(lab);
    let all = StepperKind::ALL;
    let now = all.iter().position(|&kind| kind == lab.view.stepper).unwrap_or(0);
    lab.set_stepper(all[(now + steps) % all.len()]);
}

fn last_frame(lab: &Lab) -> usize {
    lab.scheme().map_or(0, |stepper| stepper.frames().len().saturating_sub(1))
}

fn turn_page(lab: &mut Lab, step: isize) {
    let count = crate::course::lessons().len();
    let next = match &lab.lesson {
        None => 0,
        Some(state) => state.index.saturating_add_signed(step).min(count.saturating_sub(1)),
    };
    if lab.lesson.as_ref().is_none_or(|state| state.index != next) {
        files::open_lesson(lab, next);
        lab.side = SidePage::Lesson;
    }
}
