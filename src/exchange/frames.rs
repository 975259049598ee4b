//! All frames of an algorithm on paper: numbered SVG or PNG files, one PDF with a page for each, or TikZ with beamer's overlays.
//!
//! Under the picture stand the sentence and the formula of the frame. All pages have the same size.

use std::path::{Path, PathBuf};

use glam::DVec2;
use thiserror::Error;

use crate::core::progress::{Stopped, Watcher};
use crate::core::spline_curve::Nurbs;
use crate::course::stepper::{Frame, Stepper, stepper};
use crate::document::{self, Document, Object, ObjectId, View};
use crate::exchange::by_ending::{ByEndingError, ending_of, unknown_ending, write_file};
use crate::exchange::pdf::write_pdf_pages;
use crate::exchange::png::write_png;
use crate::exchange::svg::write_svg;
use crate::exchange::tikz::write_overlays;
use crate::figure::composition::{Composition, Measurements, compose_with, parameter_of};
use crate::figure::font_metrics::{FontFace, text_width};
use crate::figure::formula;
use crate::figure::picture::{Anchor, Item, Label, Path as Line, Picture, Viewport};
use crate::figure::theme::Theme;

/// Endings of exported frames, the usual one first.
pub const FRAME_ENDINGS: &[&str] = &["svg", "pdf", "tex", "png"];

/// Room on both sides of the text, in pt.
const MARGIN: f64 = 16.0;
/// Size of type of sentences and of formulas, in pt.
const TEXT_SIZE: f64 = 11.0;
const FORMULA_SIZE: f64 = 13.0;
/// Distance of base lines, as a multiple of the size.
const LINE_PITCH: f64 = 1.4;

/// Why frames could not be written.
#[derive(Debug, Error)]
pub enum FramesError {
    /// There is no curve to step through.
    #[error("there is no visible curve to step through")]
    NoCurve,
    /// The algorithm does not apply to the curve.
    #[error("{kind} on {curve}: {reason}")]
    DoesNotApply {
        /// The algorithm.
        kind: &'static str,
        /// Name of the curve.
        curve: String,
        /// The sentence that says why.
        reason: String,
    },
    /// A file could not be made.
    #[error(transparent)]
    File(#[from] ByEndingError),
    /// The watcher stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// A frame on its page.
#[derive(Clone, Debug, PartialEq)]
pub struct FramePage {
    /// The picture with sentence and formula.
    pub picture: Picture,
    /// The page.
    pub viewport: Viewport,
}

/// Writes all frames of the algorithm of `view` on its selected curve, or else the first visible one, and returns the files.
///
/// `.svg` and `.png` give numbered files, `steps.svg` becomes `steps-01.svg`, …; `.pdf` gives one file with a page for each frame, `.tex`
/// a beamer slide with a TikZ picture and overlays. `viewport` is the picture without the text under it.
///
/// # Errors
///
/// [`FramesError`]; files already written before an error stay.
pub fn write_frames(
    path: &Path,
    document: &Document,
    view: &View,
    theme: &Theme,
    viewport: &Viewport,
    pixels_per_point: f64,
    watcher: &dyn Watcher,
) -> Result<Vec<PathBuf>, FramesError> {
    let ending = ending_of(path);
    if !FRAME_ENDINGS.contains(&ending.as_str()) {
        return Err(unknown_ending(path, FRAME_ENDINGS).into());
    }
    let pages = frame_pages(document, view, theme, viewport)?;
    let whole = match ending.as_str() {
        "pdf" => Some(
            write_pdf_pages(pages.iter().map(|page| (&page.picture, &page.viewport)))
                .map_err(ByEndingError::from)?,
        ),
        "tex" => Some(write_overlays(&pages).into_bytes()),
        _ => None,
    };
    if let Some(bytes) = whole {
        watcher.check(0.9)?;
        write_file(path, &bytes)?;
        return Ok(vec![path.to_owned()]);
    }
    let json = document::to_json(document, view);
    let mut written = Vec::with_capacity(pages.len());
    for (index, page) in pages.iter().enumerate() {
        watcher.check(index as f64 / pages.len() as f64)?;
        let bytes = if ending == "png" {
            write_png(&page.picture, &page.viewport, pixels_per_point).map_err(ByEndingError::from)?
        } else {
            write_svg(&page.picture, &page.viewport, Some(&json)).into_bytes()
        };
        let name = numbered(path, index + 1, pages.len());
        write_file(&name, &bytes)?;
        written.push(name);
    }
    Ok(written)
}

/// `steps.svg` with the number of a page: `steps-03.svg`; as many digits as the last needs, two at least.
fn numbered(path: &Path, number: usize, count: usize) -> PathBuf {
    let digits = count.to_string().len().max(2);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number:0digits$}.{ending}"))
}

/// The pages of all frames; see [`write_frames`].
///
/// # Errors
///
/// [`FramesError::NoCurve`], [`FramesError::DoesNotApply`].
pub fn frame_pages(
    document: &Document,
    view: &View,
    theme: &Theme,
    viewport: &Viewport,
) -> Result<Vec<FramePage>, FramesError> {
    let (object, story) = story(document, view)?;
    let frames = story.frames();
    let room = (viewport.size.x - 2.0 * MARGIN).max(1.0);
    let texts: Vec<Text> = frames.iter().map(|frame| Text::of(frame, room, theme)).collect();
    let strip = texts.iter().map(|text| text.height).fold(0.0, f64::max) + 1.5 * MARGIN;
    let page = Viewport {
        center: viewport.center - DVec2::Y * (0.5 * strip / viewport.scale),
        size: viewport.size + DVec2::Y * strip,
        ..*viewport
    };
    let measurements = Measurements::default();
    let pages = texts.iter().enumerate().map(|(index, text)| {
        let choices = Composition { step: Some((object, story.drawing(index))), ..Composition::default() };
        // The scale of the axes stands at the edge of the picture, not of the page.
        let mut picture = compose_with(document, view, theme, viewport, &choices, &measurements);
        let number = format!("{} / {}", index + 1, frames.len());
        picture.push_layer("ground of the text", ground(&page, viewport.size.y, theme));
        picture.push_layer("text", text.items(&page, viewport.size.y, &number, theme));
        FramePage { picture, viewport: page }
    });
    Ok(pages.collect())
}

/// The curve that is stepped through: the selected one, or else the first that is visible.
///
/// # Errors
///
/// [`FramesError::NoCurve`].
pub fn curve_of_frames<'a>(
    document: &'a Document,
    view: &View,
) -> Result<(&'a Object, &'a Nurbs<DVec2>), FramesError> {
    let mut curves = document.objects().iter().filter(|object| object.visible).filter_map(|object| {
        let curve = object.curve()?;
        Some((&**object, curve))
    });
    let first = curves.next().ok_or(FramesError::NoCurve)?;
    let is_selected = |object: &Object| Some(object.id) == view.selected_object;
    Ok(if is_selected(first.0) {
        first
    } else {
        curves.find(|(object, _)| is_selected(object)).unwrap_or(first)
    })
}

fn story(document: &Document, view: &View) -> Result<(ObjectId, Stepper), FramesError> {
    let (object, curve) = curve_of_frames(document, view)?;
    let t = parameter_of(curve, view.parameters.get(&object.id).copied());
    let told = stepper(view.stepper, curve, t, &view.stepper_choices);
    told.map(|story| (object.id, story)).map_err(|reason| FramesError::DoesNotApply {
        kind: view.stepper.name(),
        curve: object.name.clone(),
        reason,
    })
}

/// Sentence and formula of a frame, broken into lines.
struct Text {
    lines: Vec<String>,
    formula: String,
    formula_size: f64,
    /// From the top to the base line of the formula.
    formula_base: f64,
    height: f64,
}

impl Text {
    fn of(frame: &Frame, room: f64, theme: &Theme) -> Self {
        let size = TEXT_SIZE * theme.text_scale;
        // The number of the frame stands on the right of the first line.
        let lines = broken(&frame.caption, room - 4.0 * size, size);
        let mut formula_size = FORMULA_SIZE * theme.text_scale;
        let mut layout = formula::layout(&frame.formula, formula_size).ok();
        if let Some(wide) = layout.as_ref().filter(|layout| layout.width > room) {
            formula_size *= room / wide.width;
            layout = formula::layout(&frame.formula, formula_size).ok();
        }
        let text_height = lines.len() as f64 * LINE_PITCH * size;
        let (ascent, descent) = layout.map_or((0.0, 0.0), |layout| (layout.ascent, layout.descent));
        let formula_base = text_height + 6.0 + ascent;
        Self {
            lines,
            formula: frame.formula.clone(),
            formula_size,
            formula_base,
            height: formula_base + descent,
        }
    }

    fn items(&self, page: &Viewport, top: f64, number: &str, theme: &Theme) -> Vec<Item> {
        let size = TEXT_SIZE * theme.text_scale;
        let label = |x: f64, y: f64, text: &str, size: f64, anchor: Anchor, math: bool| {
            Item::Label(Label {
                at: page.world_from_page(DVec2::new(x, top + 0.5 * MARGIN + y)),
                offset: DVec2::ZERO,
                text: text.to_owned(),
                size,
                color: if anchor == Anchor::End { theme.muted_text } else { theme.text },
                anchor,
                math,
            })
        };
        let base = |line: usize| (line as f64 * LINE_PITCH + 1.0) * size;
        let lines = self.lines.iter().enumerate();
        let mut items: Vec<Item> =
            lines.map(|(i, line)| label(MARGIN, base(i), line, size, Anchor::Start, false)).collect();
        items.push(label(page.size.x - MARGIN, base(0), number, size, Anchor::End, false));
        items.push(label(MARGIN, self.formula_base, &self.formula, self.formula_size, Anchor::Start, true));
        items
    }
}

/// What keeps the picture from running through the text.
fn ground(page: &Viewport, top: f64, theme: &Theme) -> Vec<Item> {
    let corner = |x: f64, y: f64| page.world_from_page(DVec2::new(x, y));
    let (width, bottom) = (page.size.x, page.size.y);
    let corners = [corner(0.0, top), corner(width, top), corner(width, bottom), corner(0.0, bottom)];
    vec![
        Item::Path(Line::polygon(&corners, None, Some(theme.background))),
        Item::Path(Line::polyline(&corners[..2], theme.stroke(theme.grid_major, 1.0))),
    ]
}

/// The words of `text` in lines no wider than `room`, if no word is.
fn broken(text: &str, room: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width(FontFace::Regular, &format!("{line} {word}"), size) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core::progress::Unwatched;
    use crate::document::{StepperKind, first_scene};

    fn viewport() -> Viewport {
        Viewport { center: DVec2::new(3.0, 1.0), scale: 40.0, size: DVec2::new(400.0, 260.0) }
    }

    fn pages(kind: StepperKind) -> Vec<FramePage> {
        let (document, view) = first_scene();
        let view = View { stepper: kind, ..view };
        frame_pages(&document, &view, &Theme::light(), &viewport()).unwrap()
    }

    #[test]
    fn every_frame_has_a_page_of_the_same_size_with_its_sentence() {
        let pages = pages(StepperKind::DeBoor);
        let (document, view) = first_scene();
        let (_, story) = story(&document, &view).unwrap();
        assert_eq!(pages.len(), story.frames().len(), "a page for each frame");
        for (page, frame) in pages.iter().zip(story.frames()) {
            assert_eq!(page.viewport, pages[0].viewport, "the same size");
            let text = page.picture.layers.iter().find(|layer| layer.name == "text").unwrap();
            let words = text.items.iter().filter_map(|item| match item {
                Item::Label(label) if !label.math && label.anchor == Anchor::Start => {
                    Some(label.text.as_str())
                }
                _ => None,
            });
            assert_eq!(words.collect::<Vec<_>>().join(" "), frame.caption, "all words");
            for item in &text.items {
                let Item::Label(label) = item else { continue };
                let at = page.viewport.page_from_world(label.at);
                assert!(at.y > viewport().size.y && at.y < page.viewport.size.y, "under the picture: {at}");
            }
        }
    }

    #[test]
    fn the_picture_stays_where_it_was() {
        let page = pages(StepperKind::KnotInsertion)[0].viewport;
        for corner in [DVec2::ZERO, DVec2::new(400.0, 0.0), DVec2::new(0.0, 260.0)] {
            let world = viewport().world_from_page(corner);
            assert!(page.page_from_world(world).distance(corner) < 1e-9, "{corner}");
        }
    }

    #[test]
    fn files_are_numbered_and_open_again_or_hold_everything() {
        let folder = tempfile::tempdir().unwrap();
        let (document, view) = first_scene();
        let view = View { stepper: StepperKind::Differentiation, ..view };
        let count = frame_pages(&document, &view, &Theme::light(), &viewport()).unwrap().len();
        let write = |name: &str| {
            let path = folder.path().join(name);
            write_frames(&path, &document, &view, &Theme::light(), &viewport(), 1.0, &Unwatched).unwrap()
        };
        let files = write("steps.svg");
        assert_eq!(files.len(), count, "a file for each frame");
        assert!(files[0].ends_with("steps-01.svg") && files[count - 1].exists(), "{files:?}");
        let read = crate::exchange::by_ending::read_document(&files[2]).unwrap();
        assert_eq!(read.document, document, "every file opens as the document");
        let pdf = std::fs::read(&write("steps.pdf")[0]).unwrap();
        let text = String::from_utf8_lossy(&pdf).replace("/Type/Pages", "").replace("/Type /Pages", "");
        assert_eq!(
            text.matches("/Type/Page").count() + text.matches("/Type /Page").count(),
            count,
            "pages of the PDF"
        );
        assert_eq!(write("steps.tex").len(), 1, "one slide");
        let wrong = write_frames(
            &folder.path().join("steps.doc"),
            &document,
            &view,
            &Theme::light(),
            &viewport(),
            1.0,
            &Unwatched,
        );
        assert!(wrong.unwrap_err().to_string().contains(".tex"), "the endings that are possible");
    }

    #[test]
    fn an_algorithm_that_does_not_apply_says_why() {
        let (document, view) = first_scene();
        let view = View { stepper: StepperKind::RationalDeCasteljau, ..view };
        let refused = frame_pages(&document, &view, &Theme::light(), &viewport()).unwrap_err().to_string();
        assert!(refused.contains("weights are equal"), "{refused}");
        let empty = frame_pages(&Document::new(), &view, &Theme::light(), &viewport()).unwrap_err();
        assert!(matches!(empty, FramesError::NoCurve), "{empty}");
    }
}
