//! Asking for a file: with the desktop's own dialog where there is one, else with [`PathDialog`].

use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::time::{Duration, Instant};

use eframe::egui;

use crate::app::path_dialog::PathDialog;

/// A dialog that gives nothing within this time was never seen by anybody: there is no desktop service to show it.
/// (Without one the answer takes about 50 ms; people are slower than 300 ms.)
const NOBODY_SAW_IT: Duration = Duration::from_millis(300);

/// How often an open dialog of the desktop is asked for its answer.
const POLL: Duration = Duration::from_millis(50);

/// What the file is wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To read a file that exists.
    Open,
    /// To write one.
    Save,
}

/// What to ask for.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// Reading or writing.
    pub(crate) purpose: Purpose,
    /// Title of the dialog.
    pub(crate) title: &'static str,
    /// What the files are, for people.
    pub(crate) kind: &'static str,
    /// Their endings without dots; the first one is added to a name without ending.
    pub(crate) extensions: &'static [&'static str],
    /// Folder that is shown first.
    pub(crate) folder: PathBuf,
    /// Name that is offered.
    pub(crate) file_name: String,
}

/// How the question was answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// With a file.
    Path(PathBuf),
    /// Not at all.
    Cancelled,
}

/// A question for a file that is being asked.
#[derive(Debug)]
pub(crate) struct FileDialog {
    request: Request,
    asked: Asked,
}

#[derive(Debug)]
enum Asked {
    Desktop { answer: Receiver<Option<PathBuf>>, since: Instant },
    Ours(Box<PathDialog>),
}

impl FileDialog {
    /// Asks; `desktop` says whether to try the desktop's dialog first.
    pub(crate) fn ask(request: Request, desktop: bool) -> Self {
        let asked = match desktop.then(|| ask_desktop(&request)).flatten() {
            Some(answer) => Asked::Desktop { answer, since: Instant::now() },
            None => Asked::Ours(Box::new(PathDialog::new(request.clone()))),
        };
        Self { request, asked }
    }

    /// Shows the dialog, or waits for the desktop's; the answer as soon as there is one.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui) -> Option<Answer> {
        match &mut self.asked {
            Asked::Ours(dialog) => dialog.show(ui),
            Asked::Desktop { answer, since } => {
                let path = match answer.try_recv() {
                    Ok(path) => path,
                    Err(TryRecvError::Disconnected) => None,
                    Err(TryRecvError::Empty) => {
                        ui.ctx().request_repaint_after(POLL);
                        return None;
                    }
                };
                match path {
                    Some(path) => Some(Answer::Path(with_extension(path, &self.request))),
                    None if since.elapsed() < NOBODY_SAW_IT => {
                        self.asked = Asked::Ours(Box::new(PathDialog::new(self.request.clone())));
                        ui.ctx().request_repaint();
                        None
                    }
                    None => Some(Answer::Cancelled),
                }
            }
        }
    }
}

/// Whether this looks like a desktop session with a service that shows file dialogs.
pub(crate) fn has_desktop() -> bool {
    std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some_and(|address| !address.is_empty())
}

/// `path` with the usual ending of what `request` saves, if it has none.
pub(crate) fn with_extension(path: PathBuf, request: &Request) -> PathBuf {
    match (request.purpose, request.extensions.first(), path.extension()) {
        (Purpose::Save, Some(extension), None) => path.with_extension(extension),
        _ => path,
    }
}

/// The dialog runs on a thread of its own, because its calls wait.
fn ask_desktop(request: &Request) -> Option<Receiver<Option<PathBuf>>> {
    let (send, receive) = mpsc::channel();
    let request = request.clone();
    let thread = std::thread::Builder::new().name("file dialog".to_owned());
    let started = thread.spawn(move || {
        let dialog = rfd::AsyncFileDialog::new()
            .set_title(request.title)
            .set_directory(&request.folder)
            .set_file_name(&request.file_name)
            .add_filter(request.kind, request.extensions);
        let chosen = match request.purpose {
            Purpose::Open => pollster::block_on(dialog.pick_file()),
            Purpose::Save => pollster::block_on(dialog.save_file()),
        };
        // Nobody listens any more when the window has been closed meanwhile.
        let _ = send.send(chosen.map(|file| file.path().to_owned()));
    });
    started.ok().map(|_| receive)
}
