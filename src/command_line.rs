<<<<<<< HEAD
//! The command line: which window or headless job is asked for, and what it says.

use std::fmt;
=======
//! The command line: opens the window, or does one job without it.

>>>>>>> app-shell
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

<<<<<<< HEAD
use clap::builder::PossibleValuesParser;
use clap::{Parser, Subcommand};
use glam::DVec2;
use spline_lab::course;
use spline_lab::document::{self, Content, Document, EXTENSION, Object, Saved};
use spline_lab::exchange::by_ending::{self, ByEndingError, FIGURE_ENDINGS, FigureFormat, read_document};
use spline_lab::figure::composition::compose;
use spline_lab::figure::picture::Viewport;
use spline_lab::figure::theme::Theme;

/// Points (pt) in a millimetre.
=======
use clap::{Parser, Subcommand, ValueEnum};
use glam::DVec2;

use crate::course::lessons;
use crate::document::{self, Content, Document};
use crate::exchange::by_ending::{self, FigureFormat, figure, read_document};
use crate::figure::composition::compose;
use crate::figure::picture::Viewport;
use crate::figure::theme::Theme;

/// Points (1/72 inch) in a millimetre.
>>>>>>> app-shell
const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Room around the objects of a figure, in pt.
const MARGIN: f64 = 24.0;

<<<<<<< HEAD
/// A figure is at least this part of its width high, and at most the second.
const HEIGHT_OF_WIDTH: (f64, f64) = (0.3, 1.5);

/// Take hold of splines: an interactive laboratory for B-splines.
#[derive(Debug, Parser)]
#[command(name = "spline-lab", version, about, args_conflicts_with_subcommands = true)]
struct CommandLine {
    #[command(subcommand)]
    job: Option<Job>,
    /// The document to open in the window: a .spline file, or an SVG that the lab wrote.
    file: Option<PathBuf>,
=======
#[derive(Debug, Parser)]
#[command(name = "spline-lab", version, about = "Take hold of splines", args_conflicts_with_subcommands = true)]
struct Arguments {
    /// The document to open: a .spline file, or an SVG figure that was made from one
    file: Option<PathBuf>,
    #[command(subcommand)]
    job: Option<Job>,
>>>>>>> app-shell
}

#[derive(Debug, Subcommand)]
enum Job {
<<<<<<< HEAD
    /// Write a figure of a document as SVG, PDF or PNG.
    Figure {
        /// The document.
        file: PathBuf,
        /// The figure; its ending says the format: .svg, .pdf or .png.
        #[arg(short, long, value_name = "OUT")]
        output: PathBuf,
        /// Width of the page in mm.
        #[arg(long, value_name = "MM", default_value_t = 160.0, allow_negative_numbers = true)]
        width: f64,
        /// The look.
        #[arg(long, value_parser = PossibleValuesParser::new(["light", "dark", "presentation"]), default_value = "light")]
        theme: String,
        /// Pixels of a PNG per point (1/72 inch).
        #[arg(long, value_name = "N", default_value_t = 2.0, allow_negative_numbers = true)]
        scale: f64,
    },
    /// Convert between a document and an SVG that holds it.
    Convert {
        /// The file to read: .spline or .svg.
        input: PathBuf,
        /// The file to write: .spline or .svg.
        output: PathBuf,
    },
    /// Check a document and list what is in it.
    Check {
        /// The document.
        file: PathBuf,
    },
    /// List the lessons.
    Lessons,
}

/// Why a job was not done.
#[derive(Debug)]
enum Failure {
    /// A file could not be read or written.
    File(ByEndingError),
    /// The document could not be saved.
    Document(document::FileError),
    /// What was asked for is not possible.
    Request(String),
    /// The answer could not be printed.
    Output(io::Error),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(error) => error.fmt(f),
            Self::Document(error) => error.fmt(f),
            Self::Request(text) => f.write_str(text),
            Self::Output(error) => write!(f, "the answer could not be printed: {error}"),
=======
    /// Writes a figure of a document: SVG, PDF or PNG by the ending of OUT
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
>>>>>>> app-shell
        }
    }
}

<<<<<<< HEAD
impl From<ByEndingError> for Failure {
    fn from(error: ByEndingError) -> Self {
        Self::File(error)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

/// Does what the arguments of the program ask for. The exit code is 0 if it was done, 1 if not, and 2 if the arguments
/// make no sense.
pub(crate) fn run() -> ExitCode {
    let asked = CommandLine::parse();
    let mut output = io::stdout().lock();
    let done = match asked.job {
        None => {
            // The window writes to the terminal too when it has something to say.
            drop(output);
            open_window(asked.file)
        }
        Some(Job::Figure { file, output: figure, width, theme, scale }) => write_figure(&file, &figure, width, &theme, scale),
        Some(Job::Convert { input, output }) => convert(&input, &output),
        Some(Job::Check { file }) => check(&file, &mut output),
        Some(Job::Lessons) => list_lessons(&mut output),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads our answer has heard enough, as `head` does.
        Err(Failure::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            // There is no one else to tell when this fails.
            let _ = writeln!(io::stderr(), "spline-lab: {failure}");
=======
/// Does what the arguments of the program ask for.
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.job {
        None => open_window(arguments.file),
        Some(Job::Figure { file, output, width, height, theme, scale }) => {
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
>>>>>>> app-shell
            ExitCode::FAILURE
        }
    }
}

<<<<<<< HEAD
#[cfg(feature = "app")]
fn open_window(file: Option<PathBuf>) -> Result<(), Failure> {
    spline_lab::app::run(file).map_err(|error| {
        Failure::Request(format!(
            "the window could not be opened: {error}\n\
             It needs a display and a graphics driver. On Debian or Ubuntu, mesa-vulkan-drivers has one for every\n\
             machine: apt install mesa-vulkan-drivers\n\
             The commands figure, convert, check and lessons work without; see spline-lab --help."
        ))
=======
fn say(text: &str) -> Result<(), String> {
    match writeln!(io::stdout(), "{text}") {
        // A reader that has seen enough, such as head, is no failure.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.to_string()),
        _ => Ok(()),
    }
}

#[cfg(feature = "app")]
fn open_window(file: Option<PathBuf>) -> Result<(), String> {
    crate::app::run(file).map_err(|error| {
        format!(
            "the window cannot be opened: {error}\n\
             A display (X11 or Wayland) and a Vulkan or OpenGL driver are needed. Without a graphics card Mesa's software\n\
             drivers do, on Debian: apt install mesa-vulkan-drivers libgl1-mesa-dri\n\
             These work without a window: spline-lab figure, convert, check, lessons"
        )
>>>>>>> app-shell
    })
}

#[cfg(not(feature = "app"))]
<<<<<<< HEAD
fn open_window(_file: Option<PathBuf>) -> Result<(), Failure> {
    Err(Failure::Request(
        "this program was built without the window; build it with: cargo build --release --features app\n\
         The commands figure, convert, check and lessons work without; see spline-lab --help."
            .to_owned(),
    ))
}

fn write_figure(file: &Path, output: &Path, width: f64, theme: &str, scale: f64) -> Result<(), Failure> {
    for (option, value) in [("--width", width), ("--scale", scale)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(Failure::Request(format!("{option} is {value}, not a positive number")));
        }
    }
    let format = FigureFormat::of(output)?;
    let Saved { document, view } = read_document(file)?;
    let theme = Theme::by_name(theme).ok_or_else(|| Failure::Request(format!("there is no look {theme:?}")))?;
    let viewport = fitting(&document, width * POINTS_PER_MM);
    let picture = compose(&document, &view, &theme, &viewport);
    let bytes = by_ending::figure(format, &picture, &viewport, &document, &view, scale)?;
    Ok(by_ending::write_file(output, &bytes)?)
}

/// A page `width` pt wide that shows all visible objects.
fn fitting(document: &Document, width: f64) -> Viewport {
    let (low, high) = document.bounding_box().unwrap_or((DVec2::ZERO, DVec2::ONE));
    let extent = high - low;
    // The margin gives way on a page that is hardly wider than it.
    let margin = MARGIN.min(0.2 * width);
    let inside = if extent.x > 0.0 { (width - 2.0 * margin) * extent.y / extent.x } else { width };
    let height = (inside + 2.0 * margin).clamp(HEIGHT_OF_WIDTH.0 * width, HEIGHT_OF_WIDTH.1 * width);
    Viewport::fitting(low, high, DVec2::new(width, height), margin)
}

fn convert(input: &Path, output: &Path) -> Result<(), Failure> {
    let ending = output.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if ending != EXTENSION && ending != "svg" {
        let hint = if FIGURE_ENDINGS.contains(&ending.as_str()) {
            "; for a figure use: spline-lab figure FILE -o OUT"
        } else {
            ""
        };
        return Err(Failure::Request(format!(
            "{}: the ending {ending:?} cannot be written; convert reads and writes .{EXTENSION} and .svg{hint}",
            output.display()
        )));
    }
    if ending == "svg" {
        return write_figure(input, output, 160.0, "light", 1.0);
    }
    let saved = read_document(input)?;
    document::save(output, &saved.document, &saved.view).map_err(Failure::Document)
}

fn check(file: &Path, output: &mut impl Write) -> Result<(), Failure> {
    let Saved { document, .. } = read_document(file)?;
    let count = document.len();
    writeln!(output, "{}: {count} {}", file.display(), if count == 1 { "object" } else { "objects" })?;
    for object in document.objects() {
        writeln!(output, "  {}", describe(object))?;
=======
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
    let viewport = page(&saved.document, width, height)?;
    let picture = compose(&saved.document, &saved.view, theme, &viewport);
    let bytes = figure(format, &picture, &viewport, &saved.document, &saved.view, scale);
    let bytes = bytes.map_err(|error| error.to_string())?;
    by_ending::write_file(output, &bytes).map_err(|error| error.to_string())
}

/// The page of the given width that shows all visible objects; its height follows from theirs unless it is given.
fn page(document: &Document, width: f64, height: Option<f64>) -> Result<Viewport, String> {
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
    let natural = if extent.x > 0.0 { (width - 2.0 * MARGIN) * extent.y / extent.x + 2.0 * MARGIN } else { width };
    let height = height.map_or_else(|| natural.clamp(0.25 * width, 1.5 * width), |height| height * POINTS_PER_MM);
    Ok(Viewport::fitting(low, high, DVec2::new(width, height), MARGIN))
}

fn convert(input: &Path, output: &Path) -> Result<(), String> {
    let saved = read_document(input).map_err(|error| error.to_string())?;
    if by_ending::is_document(output) {
        return document::save(output, &saved.document, &saved.view).map_err(|error| error.to_string());
    }
    match FigureFormat::of(output) {
        Ok(FigureFormat::Svg) => write_figure(input, output, 160.0, None, &Theme::light(), 1.0),
        _ => Err(format!("{}: convert writes .spline and .svg; for .pdf and .png use spline-lab figure", output.display())),
    }
}

fn check(file: &Path) -> Result<(), String> {
    let saved = read_document(file).map_err(|error| error.to_string())?;
    let objects = saved.document.objects();
    let count = objects.len();
    say(&format!("{}: {count} {}", file.display(), if count == 1 { "object" } else { "objects" }))?;
    for object in objects {
        let Content::Curve(curve) = &object.content;
        let space = curve.space();
        let (left, right) = space.parameter_interval();
        say(&format!(
            "  {}: {} {} curve of degree {}, {} control points, {} knots, interval [{left}, {right}]{}",
            object.name,
            if space.is_periodic() { "closed" } else { "open" },
            if curve.is_polynomial() { "polynomial" } else { "rational" },
            curve.degree(),
            curve.points().len(),
            space.knots().len(),
            if object.visible { "" } else { ", hidden" },
        ))?;
>>>>>>> app-shell
    }
    Ok(())
}

<<<<<<< HEAD
fn describe(object: &Object) -> String {
    let Object { id, name, content, visible, .. } = object;
    let Content::Curve(curve) = content;
    let ends = if curve.space().is_periodic() { "closed" } else { "open" };
    let kind = if curve.is_polynomial() { "polynomial" } else { "rational" };
    let (degree, points, knots) = (curve.degree(), curve.points().len(), curve.space().knots().len());
    let hidden = if *visible { "" } else { ", hidden" };
    format!("{} {name:?}: curve of degree {degree}, {points} points, {knots} knots, {ends}, {kind}{hidden}", id.0)
}

fn list_lessons(output: &mut impl Write) -> Result<(), Failure> {
    for lesson in course::lessons() {
        writeln!(output, "{}", lesson.heading())?;
    }
    Ok(())
=======
fn list_lessons() -> Result<(), String> {
    lessons().iter().try_for_each(|lesson| say(&lesson.heading()))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_page_shows_every_control_point_and_refuses_absurd_sizes() {
        let (document, _) = document::first_scene();
        let viewport = page(&document, 160.0, None).unwrap();
        let (low, high) = document.bounding_box().unwrap();
        for corner in [low, high] {
            let place = viewport.page_from_world(corner);
            assert!(place.cmpge(DVec2::ZERO).all() && place.cmple(viewport.size).all(), "{corner} is at {place}");
        }
        for width in [0.0, -3.0, f64::NAN, 1e9] {
            assert!(page(&document, width, None).is_err(), "width {width}");
        }
    }
>>>>>>> app-shell
}
