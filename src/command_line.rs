//! The command line: opens the window, or does one job without it.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use glam::DVec2;

use crate::core::progress::Unwatched;
use crate::course::lessons;
use crate::document::{self, Document, StepperKind};
use crate::exchange::by_ending::{self, FigureFormat, figure, read_document};
use crate::exchange::frames;
use crate::figure::elements;
use crate::figure::page::{has_free_height, page};
use crate::figure::picture::Viewport;
use crate::figure::theme::Theme;

/// Points (1/72 inch) in a millimetre.
const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Room around the objects of a figure, in pt.
const MARGIN: f64 = 24.0;

#[derive(Debug, Parser)]
#[command(
    name = "spline-lab",
    version,
    about = "Take hold of splines",
    args_conflicts_with_subcommands = true
)]
struct Arguments {
    /// The document to open: a .spline file, or an SVG figure that was made from one
    file: Option<PathBuf>,
    #[command(subcommand)]
    job: Option<Job>,
}

#[derive(Debug, Subcommand)]
enum Job {
    /// Writes a figure of a document: SVG, PDF, PNG or TikZ (.tex) by the ending of OUT
    Figure {
        /// The document
        file: PathBuf,
        /// The figure
        #[arg(short, long, value_name = "OUT")]
        output: PathBuf,
        /// Width of the figure in mm
        #[arg(long, default_value_t = 160.0, value_name = "MM")]
        width: f64,
        /// Height of the figure in mm; as the objects need by default
        #[arg(long, value_name = "MM")]
        height: Option<f64>,
        /// The look
        #[arg(long, value_enum, default_value_t = Look::Light)]
        theme: Look,
        /// Pixels per pt of a PNG
        #[arg(long, default_value_t = 3.0, value_name = "N")]
        scale: f64,
        /// All frames of the algorithm of the document instead: numbered .svg or .png, one .pdf, or a .tex slide of beamer
        #[arg(long)]
        frames: bool,
        /// The algorithm of the frames; that of the document by default
        #[arg(long, value_name = "NAME", requires = "frames", value_parser = algorithm)]
        algorithm: Option<StepperKind>,
        /// The parameter of the frames; that of the document by default
        #[arg(long, value_name = "T", requires = "frames", allow_negative_numbers = true)]
        at: Option<f64>,
    },
    /// Writes a document in another format: .spline, or .svg with the document inside
    Convert {
        /// The document to read
        input: PathBuf,
        /// The file to write
        output: PathBuf,
    },
    /// Reads a document and says what is in it, or where it is wrong
    Check {
        /// The document
        file: PathBuf,
    },
    /// Lists the lessons
    Lessons,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Look {
    Light,
    Dark,
    Presentation,
}

impl Look {
    fn theme(self) -> Theme {
        match self {
            Self::Light => Theme::light(),
            Self::Dark => Theme::dark(),
            Self::Presentation => Theme::presentation(),
        }
    }
}

/// Does what the arguments of the program ask for.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.job {
        None => open_window(arguments.file),
        Some(Job::Figure { file, output, width, height, theme, scale, frames: true, algorithm, at }) => {
            write_all_frames(&file, &output, (width, height), &theme.theme(), scale, (algorithm, at))
        }
        Some(Job::Figure { file, output, width, height, theme, scale, .. }) => {
            write_figure(&file, &output, width, height, &theme.theme(), scale)
        }
        Some(Job::Convert { input, output }) => convert(&input, &output),
        Some(Job::Check { file }) => check(&file),
        Some(Job::Lessons) => list_lessons(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            // Where standard error is closed there is nobody to tell.
            let _ = writeln!(io::stderr(), "spline-lab: {message}");
            ExitCode::FAILURE
        }
    }
}

fn say(text: &str) -> Result<(), String> {
    match writeln!(io::stdout(), "{text}") {
        // A reader that has seen enough, such as head, is no failure.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.to_string()),
        _ => Ok(()),
    }
}

#[cfg(feature = "app")]
fn open_window(file: Option<PathBuf>) -> Result<(), String> {
    crate::app::run(file).map_err(|error| without_window(&error.to_string()))
}

/// What to say to somebody whose machine cannot show the window.
#[cfg(feature = "app")]
fn without_window(error: &str) -> String {
    format!(
        "the window cannot be opened: {error}\n\
         A display (X11 or Wayland) and a Vulkan or OpenGL driver are needed. Without a graphics card Mesa's software\n\
         drivers do, on Debian: apt install mesa-vulkan-drivers, or libgl1-mesa-dri with libegl1\n\
         These work without a window: spline-lab figure, convert, check, lessons"
    )
}

#[cfg(not(feature = "app"))]
fn open_window(_file: Option<PathBuf>) -> Result<(), String> {
    Err("this build has no window; build with: cargo build --release --features app".to_owned())
}

fn write_figure(
    file: &Path,
    output: &Path,
    width: f64,
    height: Option<f64>,
    theme: &Theme,
    scale: f64,
) -> Result<(), String> {
    let format = FigureFormat::of(output).map_err(|error| error.to_string())?;
    let saved = read_document(file).map_err(|error| error.to_string())?;
    let mut viewport = paper(&saved.document, width, height)?;
    if has_free_height(&saved.document, &saved.view) {
        viewport.size.y = height.map_or(0.75 * viewport.size.x, |_| viewport.size.y);
    }
    if elements::is_shown(&saved.document, &saved.view) {
        viewport = elements::beside_legend(&viewport);
    }
    let (picture, viewport) =
        page(&saved.document, &saved.view, theme, &viewport).map_err(|error| error.to_string())?;
    let bytes = figure(format, &picture, &viewport, &saved.document, &saved.view, scale);
    let bytes = bytes.map_err(|error| error.to_string())?;
    by_ending::write_file(output, &bytes).map_err(|error| error.to_string())
}

/// The algorithm that is called `name` in files.
fn algorithm(name: &str) -> Result<StepperKind, String> {
    let found = StepperKind::ALL.into_iter().find(|kind| kind.key() == name);
    found.ok_or_else(|| format!("it is one of {}", StepperKind::ALL.map(StepperKind::key).join(", ")))
}

fn write_all_frames(
    file: &Path,
    output: &Path,
    (width, height): (f64, Option<f64>),
    theme: &Theme,
    scale: f64,
    (algorithm, at): (Option<StepperKind>, Option<f64>),
) -> Result<(), String> {
    let mut saved = read_document(file).map_err(|error| error.to_string())?;
    saved.view.stepper = algorithm.unwrap_or(saved.view.stepper);
    if let Some(at) = at {
        let (object, curve) =
            frames::curve_of_frames(&saved.document, &saved.view).map_err(|error| error.to_string())?;
        let (left, right) = curve.space().parameter_interval();
        if !(left..=right).contains(&at) {
            return Err(format!("{at} lies outside [{left}, {right}], the interval of {}", object.name));
        }
        saved.view.parameters.insert(object.id, at);
    }
    let viewport = paper(&saved.document, width, height)?;
    let written =
        frames::write_frames(output, &saved.document, &saved.view, theme, &viewport, scale, &Unwatched)
            .map_err(|error| error.to_string())?;
    match &written[..] {
        [only] => say(&only.display().to_string()),
        [first, .., last] => say(&format!("{} to {}", first.display(), last.display())),
        [] => Ok(()),
    }
}

/// The page of the given width that shows all visible objects; its height follows from theirs unless it is given.
fn paper(document: &Document, width: f64, height: Option<f64>) -> Result<Viewport, String> {
    for (name, length) in [("width", Some(width)), ("height", height)] {
        if let Some(length) = length
            && !(10.0..=2000.0).contains(&length)
        {
            return Err(format!("the {name} is {length} mm; it must be between 10 and 2000 mm"));
        }
    }
    let (low, high) = document.bounding_box().unwrap_or((DVec2::ZERO, DVec2::ONE));
    let extent = high - low;
    let width = width * POINTS_PER_MM;
    let natural =
        if extent.x > 0.0 { (width - 2.0 * MARGIN) * extent.y / extent.x + 2.0 * MARGIN } else { width };
    let height =
        height.map_or_else(|| natural.clamp(0.25 * width, 1.5 * width), |height| height * POINTS_PER_MM);
    Ok(Viewport::fitting(low, high, DVec2::new(width, height), MARGIN))
}

fn convert(input: &Path, output: &Path) -> Result<(), String> {
    let saved = read_document(input).map_err(|error| error.to_string())?;
    if by_ending::is_document(output) {
        return document::save(output, &saved.document, &saved.view).map_err(|error| error.to_string());
    }
    match FigureFormat::of(output) {
        Ok(FigureFormat::Svg) => write_figure(input, output, 160.0, None, &Theme::light(), 1.0),
        _ => Err(format!(
            "{}: convert writes .spline and .svg; for .pdf, .png and .tex use spline-lab figure",
            output.display()
        )),
    }
}

fn check(file: &Path) -> Result<(), String> {
    let saved = read_document(file).map_err(|error| error.to_string())?;
    let objects = saved.document.objects();
    let count = objects.len();
    say(&format!("{}: {count} {}", file.display(), if count == 1 { "object" } else { "objects" }))?;
    for object in objects {
        let interval = object.curve().map(|curve| {
            let (left, right) = curve.space().parameter_interval();
            format!(", {} knots, interval [{left}, {right}]", curve.space().knots().len())
        });
        say(&format!(
            "  {}: {}{}{}",
            object.name,
            object.content.summary(),
            interval.unwrap_or_default(),
            if object.visible { "" } else { ", hidden" },
        ))?;
    }
    Ok(())
}

fn list_lessons() -> Result<(), String> {
    lessons().iter().try_for_each(|lesson| say(&lesson.heading()))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[cfg(feature = "app")]
    #[test]
    fn without_a_window_one_learns_what_to_install_and_what_works() {
        let message = without_window("no adapter");
        for part in
            ["no adapter", "mesa-vulkan-drivers", "libgl1-mesa-dri", "figure, convert, check, lessons"]
        {
            assert!(message.contains(part), "{part} is missing in: {message}");
        }
        assert!(message.lines().all(|line| !line.starts_with("     ")), "no stray indentation: {message}");
    }

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_page_shows_every_control_point_and_refuses_absurd_sizes() {
        let (document, _) = document::first_scene();
        let viewport = paper(&document, 160.0, None).unwrap();
        let (low, high) = document.bounding_box().unwrap();
        for corner in [low, high] {
            let place = viewport.page_from_world(corner);
            assert!(
                place.cmpge(DVec2::ZERO).all() && place.cmple(viewport.size).all(),
                "{corner} is at {place}"
            );
        }
        for width in [0.0, -3.0, f64::NAN, 1e9] {
            assert!(paper(&document, width, None).is_err(), "width {width}");
        }
    }
}
