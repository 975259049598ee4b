//! PDF pages: vector paths, and text with the lab's own fonts inside the file.
//!
//! Every page has the size of its view. Layers keep their order. Coordinates are those of PDF, about seven decimal digits.

use glam::DVec2;
use krilla::Document;
use krilla::color::rgb;
use krilla::geom::{PathBuilder, Point, Size, Transform};
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{Fill, LineCap, LineJoin, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use thiserror::Error;

use crate::exchange::page::{Medium, PageItem, lay_out};
use crate::figure::font_metrics::{FontFace, letter_metrics, runs, text_width};
use crate::figure::formula::{FormulaLayout, Rule};
use crate::figure::mesh::Image;
use crate::figure::picture::{Anchor, Color, Path, Picture, Segment, Stroke, Viewport};

/// Longest side of a page in pt: the 200 inches that PDF viewers agree on.
pub const LONGEST_SIDE: f64 = 14_400.0;

/// How far the handles of a cubic quarter circle reach, as a part of the radius: `4/3·(√2 − 1)`.
const QUARTER_CIRCLE: f64 = 0.552_284_749_830_793_4;

/// Why there is no PDF file.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PdfError {
    /// A side of the page cannot be.
    #[error("the {what} of the page is {value} pt; it must be between 3 and {LONGEST_SIDE} pt")]
    BadSize {
        /// `width` or `height`.
        what: &'static str,
        /// Its value in pt.
        value: f64,
    },
    /// A font or the file could not be made.
    #[error("the PDF file cannot be made: {reason}")]
    Failed {
        /// What the PDF library says.
        reason: String,
    },
}

/// The picture as a PDF file of one page.
///
/// # Errors
///
/// `BadSize`, `Failed`.
pub fn write_pdf(picture: &Picture, view: &Viewport) -> Result<Vec<u8>, PdfError> {
    write_pdf_pages([(picture, view)])
}

/// The pictures as a PDF file, a page for each.
///
/// # Errors
///
/// `BadSize`, `Failed`.
pub fn write_pdf_pages<'a>(
    pages: impl IntoIterator<Item = (&'a Picture, &'a Viewport)>,
) -> Result<Vec<u8>, PdfError> {
    let failed = |reason: &str| PdfError::Failed { reason: reason.to_owned() };
    let fonts = Fonts::new().ok_or_else(|| failed("a font is damaged"))?;
    let mut document = Document::new();
    for (picture, view) in pages {
        for (what, value) in [("width", view.size.x), ("height", view.size.y)] {
            if !(3.0..=LONGEST_SIDE).contains(&value) {
                return Err(PdfError::BadSize { what, value });
            }
        }
        let size = PageSettings::from_wh(view.size.x as f32, view.size.y as f32)
            .ok_or_else(|| failed("the page has no size"))?;
        let mut page = document.start_page_with(size);
        let mut surface = page.surface();
        if let Some(color) = picture.background {
            let corners =
                [DVec2::ZERO, DVec2::new(view.size.x, 0.0), view.size, DVec2::new(0.0, view.size.y)];
            draw_path(&mut surface, &Path::polygon(&corners, None, Some(color)));
        }
        for layer in lay_out(picture, view, Medium::Vectors) {
            for item in &layer.items {
                draw_item(&mut surface, item, &fonts);
            }
        }
        surface.finish();
        page.finish();
    }
    document.finish().map_err(|error| PdfError::Failed { reason: format!("{error:?}") })
}

struct Fonts([Font; 3]);

impl Fonts {
    fn new() -> Option<Self> {
        let load = |font: FontFace| Font::new(font.bytes().into(), 0);
        let [regular, semi_bold, math] = FontFace::ALL;
        Some(Self([load(regular)?, load(semi_bold)?, load(math)?]))
    }

    fn get(&self, font: FontFace) -> Font {
        self.0[font as usize].clone()
    }
}

fn draw_item(surface: &mut Surface<'_>, item: &PageItem<'_>, fonts: &Fonts) {
    match item {
        PageItem::Path(path) => draw_path(surface, path),
        PageItem::Disc { center, radius, stroke, fill } => {
            let segments = circle(*center, *radius);
            draw_path(surface, &Path { segments, stroke: stroke.clone(), fill: *fill });
        }
        PageItem::Text { at, text, size, color, anchor } => {
            draw_line(surface, fonts, *at, text, *size, *color, *anchor);
        }
        PageItem::Formula { at, layout, color, .. } => draw_formula(surface, fonts, *at, layout, *color),
        PageItem::Image { corner, size, image } => draw_image(surface, *corner, *size, image),
    }
}

fn draw_image(surface: &mut Surface<'_>, corner: DVec2, size: DVec2, image: &Image) {
    let Some(extent) = Size::from_wh(size.x as f32, size.y as f32) else { return };
    let pixels = krilla::image::Image::from_rgba8(image.pixels().to_vec(), image.width(), image.height());
    surface.push_transform(&Transform::from_translate(corner.x as f32, corner.y as f32));
    surface.draw_image(pixels, extent);
    surface.pop();
}

fn circle(center: DVec2, radius: f64) -> Vec<Segment> {
    let mut segments = vec![Segment::Move(center + DVec2::X * radius)];
    let mut from = DVec2::X;
    for _ in 0..4 {
        let to = from.perp();
        let handles = [from + to * QUARTER_CIRCLE, to + from * QUARTER_CIRCLE, to];
        let [a, b, end] = handles.map(|point| center + point * radius);
        segments.push(Segment::Cubic(a, b, end));
        from = to;
    }
    segments.push(Segment::Close);
    segments
}

fn draw_path(surface: &mut Surface<'_>, path: &Path) {
    let mut builder = PathBuilder::new();
    for segment in &path.segments {
        match *segment {
            Segment::Move(to) => builder.move_to(to.x as f32, to.y as f32),
            Segment::Line(to) => builder.line_to(to.x as f32, to.y as f32),
            Segment::Cubic(a, b, to) => {
                builder.cubic_to(a.x as f32, a.y as f32, b.x as f32, b.y as f32, to.x as f32, to.y as f32);
            }
            Segment::Close => builder.close(),
        }
    }
    // A path of nothing but a start has no shape.
    let Some(shape) = builder.finish() else { return };
    surface.set_fill(path.fill.map(fill_of));
    surface.set_stroke(path.stroke.as_ref().map(stroke_of));
    surface.draw_path(&shape);
}

fn rgb_of(color: Color) -> rgb::Color {
    rgb::Color::new(color.r, color.g, color.b)
}

fn opacity_of(color: Color) -> NormalizedF32 {
    NormalizedF32::new(f32::from(color.a) / 255.0).unwrap_or(NormalizedF32::ONE)
}

fn fill_of(color: Color) -> Fill {
    Fill { paint: rgb_of(color).into(), opacity: opacity_of(color), rule: krilla::paint::FillRule::NonZero }
}

fn stroke_of(stroke: &Stroke) -> krilla::paint::Stroke {
    let is_solid = stroke.dashes.is_empty();
    let lengths = || stroke.dashes.iter().map(|&length| length as f32);
    // PDF and SVG both repeat an odd number of lengths, dashes and gaps swapped; written out, no reader gets it wrong.
    let array =
        if stroke.dashes.len() % 2 == 1 { lengths().chain(lengths()).collect() } else { lengths().collect() };
    krilla::paint::Stroke {
        paint: rgb_of(stroke.color).into(),
        width: stroke.width as f32,
        line_cap: if is_solid { LineCap::Round } else { LineCap::Butt },
        line_join: LineJoin::Round,
        opacity: opacity_of(stroke.color),
        dash: (!is_solid).then_some(StrokeDash { array, offset: 0.0 }),
        ..krilla::paint::Stroke::default()
    }
}

fn draw_line(
    surface: &mut Surface<'_>,
    fonts: &Fonts,
    at: DVec2,
    text: &str,
    size: f64,
    color: Color,
    anchor: Anchor,
) {
    let mut x = at.x - anchor.part_before() * text_width(FontFace::Regular, text, size);
    for (font, run) in runs(FontFace::Regular, text) {
        draw_run(surface, fonts, font, DVec2::new(x, at.y), run, size, color);
        x += text_width(font, run, size);
    }
}

fn draw_formula(surface: &mut Surface<'_>, fonts: &Fonts, at: DVec2, layout: &FormulaLayout, color: Color) {
    for glyph in &layout.glyphs {
        let place = at + DVec2::new(glyph.x, -glyph.y);
        draw_run(surface, fonts, FontFace::Math, place, &glyph.text, glyph.size, color);
    }
    for &Rule { x, y, width, height } in &layout.rules {
        let low = at + DVec2::new(x, -y);
        let corners = [
            low,
            low + DVec2::new(width, 0.0),
            low + DVec2::new(width, -height),
            low - DVec2::new(0.0, height),
        ];
        draw_path(surface, &Path::polygon(&corners, None, Some(color)));
    }
}

/// Letters of one face, set without kerning; `at` is the left end of their base line.
fn draw_run(
    surface: &mut Surface<'_>,
    fonts: &Fonts,
    font: FontFace,
    at: DVec2,
    text: &str,
    size: f64,
    color: Color,
) {
    let Some(face) = font.face() else { return };
    let glyphs: Vec<KrillaGlyph> = text
        .char_indices()
        .map(|(start, letter)| KrillaGlyph {
            glyph_id: GlyphId::new(u32::from(face.glyph_index(letter).unwrap_or_default().0)),
            text_range: start..start + letter.len_utf8(),
            x_advance: letter_metrics(font, letter).advance as f32,
            x_offset: 0.0,
            y_offset: 0.0,
            y_advance: 0.0,
            location: None,
        })
        .collect();
    surface.set_fill(Some(fill_of(color)));
    surface.set_stroke(None);
    let place = Point::from_xy(at.x as f32, at.y as f32);
    surface.draw_glyphs(place, &glyphs, fonts.get(font), text, size as f32, false);
}
