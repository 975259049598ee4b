//! The Finite elements workspace: domains and patches by hand, the membrane over them, its solution as it changes.

mod add;
mod canvas;
mod context_menu;
mod gesture;
mod hit;
mod inspector;
mod live;
mod marks;
mod results;
mod tools;

use std::collections::BTreeSet;

use eframe::egui;
use glam::DVec2;

use crate::app::command::Command;
use crate::app::lab::Lab;
use crate::app::workspace::{Room, Workspace};
use crate::document::{Content, Edit, HandleId, Membrane, MembraneDisplay, MembraneError, ObjectId, Region};
use crate::figure::composition::short_number;
use crate::figure::elements::WORKSPACE;

use canvas::Canvas;
use live::{Live, Study};

/// The workspace of finite elements.
#[derive(Debug, Default)]
pub(crate) struct Elements {
    canvas: Canvas,
    live: Live,
    study: Study,
    /// The selected handles of the selected object.
    selected: BTreeSet<HandleId>,
}

/// The selected problem, as it was at the beginning of the frame.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    object: ObjectId,
    name: String,
    membrane: Membrane,
    display: MembraneDisplay,
}

impl Subject {
    /// The selected object, if it is a problem.
    fn of(lab: &Lab) -> Option<Self> {
        let object = lab.history.document().object(lab.selection.object?)?;
        let (membrane, display) = object.membrane()?;
        Some(Self {
            object: object.id,
            name: object.name.clone(),
            membrane: membrane.clone(),
            display: display.clone(),
        })
    }

    /// The edit that puts `membrane` in the place of the problem.
    fn edit(&self, label: &str, membrane: Membrane) -> Edit {
        let content = Content::Membrane { membrane, display: self.display.clone() };
        Edit::SetContent { object: self.object, content, label: label.to_owned() }
    }

    /// The edit that changes how the problem is shown.
    fn show(&self, display: MembraneDisplay) -> Edit {
        let content = Content::Membrane { membrane: self.membrane.clone(), display };
        Edit::SetContent { object: self.object, content, label: "Change display".to_owned() }
    }

    /// Carries `change` out as one undo step, or says why it cannot be.
    fn apply(&self, lab: &mut Lab, label: &str, change: Result<Membrane, MembraneError>) {
        match change {
            Ok(membrane) if membrane == self.membrane => {}
            Ok(membrane) => {
                lab.edit(self.edit(label, membrane));
            }
            Err(error) => lab.problem(capital(&error.to_string())),
        }
    }

    /// A running interaction now amounts to `change`; an impossible one leaves it where it was.
    fn update(&self, lab: &mut Lab, label: &str, change: Result<Membrane, MembraneError>) {
        match change {
            Ok(membrane) => {
                lab.begin(label);
                lab.update(self.edit(label, membrane));
            }
            Err(error) => lab.shape_note = Some(capital(&error.to_string())),
        }
    }
}

/// The sentence with a capital letter.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    first + letters.as_str()
}

impl Workspace for Elements {
    fn room(&self) -> Room {
        Room::Elements
    }

    fn tools(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        tools::show(lab, ui);
    }

    fn inspector(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        inspector::show(self, lab, ui);
    }

    fn canvas(&mut self, lab: &mut Lab, ui: &mut egui::Ui) {
        let subject = Subject::of(lab);
        match &subject {
            Some(subject) => {
                self.selected.retain(|&id| subject.membrane.handle(id).is_some());
                self.live.follow(subject.object, &subject.membrane, lab.at_once, ui.ctx());
            }
            None => self.selected.clear(),
        }
        self.study.follow();
        canvas::show(self, subject.as_ref(), lab, ui);
    }

    fn execute(&mut self, command: Command, lab: &mut Lab) -> bool {
        let subject = Subject::of(lab);
        match command {
            Command::Fit => self.canvas.fit(lab),
            Command::ZoomIn => self.canvas.zoom(lab, 1.25),
            Command::ZoomOut => self.canvas.zoom(lab, 0.8),
            Command::ToggleGrid => {
                let shown = lab.view.panels.get(crate::figure::composition::GRID).copied().unwrap_or(true);
                lab.view.panels.insert(crate::figure::composition::GRID.to_owned(), !shown);
            }
            Command::Escape => {
                if self.canvas.give_up() {
                    lab.history.cancel();
                } else {
                    self.selected.clear();
                }
            }
            _ => return subject.is_some_and(|subject| self.execute_on(command, &subject, lab)),
        }
        true
    }

    fn status(&self, lab: &Lab) -> String {
        let scale = format!("{} px per unit", short_number(canvas::camera(lab).scale));
        match self.canvas.under_pointer() {
            Some(under) => format!("{under}   {scale}"),
            None => scale,
        }
    }

    fn handles(&self, lab: &Lab) -> Vec<(String, egui::Pos2)> {
        let Some(subject) = Subject::of(lab) else { return Vec::new() };
        let named = |(_, name, at): (HandleId, String, DVec2)| {
            Some((format!("{name} of {}", subject.name), self.canvas.screen_from_world(at, lab)?))
        };
        subject.membrane.handles().into_iter().filter_map(named).collect()
    }

    fn screen_from_world(&self, world: DVec2, lab: &Lab) -> Option<egui::Pos2> {
        self.canvas.screen_from_world(world, lab)
    }
}

impl Elements {
    fn execute_on(&mut self, command: Command, subject: &Subject, lab: &mut Lab) -> bool {
        let show = |lab: &mut Lab, change: fn(&mut MembraneDisplay)| {
            let mut display = subject.display.clone();
            change(&mut display);
            lab.edit(subject.show(display));
        };
        match command {
            Command::ToggleField => show(lab, |display| display.fill = !display.fill),
            Command::ToggleIsolines => {
                show(lab, |display| display.isolines = if display.isolines == 0 { 10 } else { 0 });
            }
            Command::ToggleNodes => show(lab, |display| display.nodes = !display.nodes),
            Command::ToggleCells => show(lab, |display| display.cells = !display.cells),
            Command::ToggleQuadrature => show(lab, |display| display.quadrature = !display.quadrature),
            Command::RefineElements => subject.apply(lab, "Refine", scaled(&subject.membrane, true)),
            Command::CoarsenElements => subject.apply(lab, "Coarsen", scaled(&subject.membrane, false)),
            Command::RaiseElementDegree => {
                subject.apply(lab, "Raise degree", subject.membrane.with(|setting| setting.degree += 1));
            }
            Command::LowerElementDegree => {
                let lower = |setting: &mut crate::document::Setting| {
                    setting.degree = setting.degree.saturating_sub(1);
                };
                subject.apply(lab, "Lower degree", subject.membrane.with(lower));
            }
            Command::SelectAll => {
                self.selected = subject.membrane.handles().into_iter().map(|(id, ..)| id).collect();
            }
            Command::Delete => {
                let selected = std::mem::take(&mut self.selected);
                add::delete(&selected, subject, lab);
            }
            Command::Duplicate => {
                if let Some(outcome) = lab.edit(Edit::DuplicateObject { object: subject.object })
                    && let Some(&created) = outcome.created.first()
                {
                    lab.selection.object = Some(created);
                }
            }
            _ => return false,
        }
        true
    }
}

/// The problem with half the grid width or the double.
fn scaled(membrane: &Membrane, finer: bool) -> Result<Membrane, MembraneError> {
    membrane.with(|setting| match &mut setting.region {
        Region::Parts { width, .. } => *width *= if finer { 0.5 } else { 2.0 },
        Region::Patch { divisions, .. } | Region::Channel { divisions, .. } => {
            *divisions = if finer { *divisions * 2 } else { (*divisions / 2).max(1) };
        }
    })
}

/// The name under which the room's camera is kept.
const CAMERA: &str = WORKSPACE;
