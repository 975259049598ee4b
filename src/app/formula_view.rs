//! Typeset formulas and paragraphs with formulas in them, painted with egui.

use std::sync::Arc;

use eframe::egui::{
    Color32, FontFamily, FontId, Galley, Painter, Pos2, Rect, Response, Role, Sense, Ui, WidgetInfo, cache,
    pos2, vec2,
};

use crate::app::look::{MATH, SEMIBOLD};
use crate::app::painter::baseline;
use crate::figure::formula::{self, FormulaError, FormulaLayout};

/// A formula that is too wide is set smaller, down to this share; beyond that it is scrolled.
const SMALLEST_SHARE: f32 = 0.7;

type Cached = Result<Arc<FormulaLayout>, FormulaError>;

/// Typesets formulas that were not on screen in the frame before.
#[derive(Debug, Default)]
struct Typesetter;

impl cache::ComputerMut<(&str, u32, bool), Cached> for Typesetter {
    fn compute(&mut self, (source, size_bits, inline): (&str, u32, bool)) -> Cached {
        let size = f64::from(f32::from_bits(size_bits));
        let layout =
            if inline { formula::layout_inline(source, size) } else { formula::layout(source, size) };
        layout.map(Arc::new)
    }
}

type FormulaCache = cache::FrameCache<Cached, Typesetter>;

fn typeset(ui: &Ui, source: &str, size: f32, inline: bool) -> Cached {
    ui.memory_mut(|memory| {
        memory.caches.cache::<FormulaCache>().get((source, size.to_bits(), inline)).clone()
    })
}

/// Paints a typeset formula; `origin` is the left end of its base line.
pub(crate) fn paint_formula(painter: &Painter, origin: Pos2, layout: &FormulaLayout, color: Color32) {
    for run in &layout.glyphs {
        let font = FontId::new(run.size as f32, FontFamily::Name(MATH.into()));
        let galley = painter.layout_no_wrap(run.text.clone(), font, color);
        let place = origin + vec2(run.x as f32, -(run.y as f32) - baseline(&galley));
        painter.galley(place, galley, color);
    }
    for rule in &layout.rules {
        let low = origin + vec2(rule.x as f32, -(rule.y as f32));
        let rect = Rect::from_min_max(
            pos2(low.x, low.y - rule.height as f32),
            pos2(low.x + rule.width as f32, low.y),
        );
        painter.rect_filled(rect, 0.0, color);
    }
}

/// Shows a displayed formula with letters of `size` points; smaller where it would not fit.
pub(crate) fn formula(ui: &mut Ui, source: &str, size: f32) -> Response {
    let room = ui.available_width();
    let layout = typeset(ui, source, size, false).and_then(|layout| {
        let share = (room / layout.width as f32).clamp(SMALLEST_SHARE, 1.0);
        if share < 1.0 { typeset(ui, source, size * share, false) } else { Ok(layout) }
    });
    let layout = match layout {
        Ok(layout) => layout,
        Err(error) => return broken(ui, source, &error),
    };
    let extent = vec2(layout.width as f32, (layout.ascent + layout.descent) as f32 + 2.0);
    if extent.x <= room + 0.5 {
        return place_formula(ui, source, &layout, extent);
    }
    eframe::egui::ScrollArea::horizontal()
        .id_salt(("wide formula", source))
        .auto_shrink([false, true])
        .show(ui, |ui| place_formula(ui, source, &layout, extent))
        .inner
}

fn place_formula(ui: &mut Ui, source: &str, layout: &FormulaLayout, extent: eframe::egui::Vec2) -> Response {
    let (rect, response) = ui.allocate_exact_size(extent, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, source));
    let color = ui.visuals().text_color();
    paint_formula(ui.painter(), rect.min + vec2(0.0, layout.ascent as f32 + 1.0), layout, color);
    response
}

fn broken(ui: &mut Ui, source: &str, error: &FormulaError) -> Response {
    ui.colored_label(ui.visuals().error_fg_color, source).on_hover_text(error.to_string())
}

/// A piece of a paragraph on the base line.
enum Piece {
    Text(Arc<Galley>),
    Formula(Arc<FormulaLayout>),
}

impl Piece {
    fn width(&self) -> f32 {
        match self {
            Self::Text(galley) => galley.size().x,
            Self::Formula(layout) => layout.width as f32,
        }
    }

    fn ascent(&self) -> f32 {
        match self {
            Self::Text(galley) => baseline(galley),
            Self::Formula(layout) => layout.ascent as f32,
        }
    }

    fn descent(&self) -> f32 {
        match self {
            Self::Text(galley) => galley.size().y - baseline(galley),
            Self::Formula(layout) => layout.descent as f32,
        }
    }
}

/// Pieces that stand together without a space.
#[derive(Default)]
struct Word {
    pieces: Vec<Piece>,
}

impl Word {
    fn width(&self) -> f32 {
        self.pieces.iter().map(Piece::width).sum()
    }
}

/// Part of a paragraph as written.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part<'a> {
    Plain(&'a str),
    Bold(&'a str),
    Formula(&'a str),
}

/// Splits at `$…$` and `**…**`; a sign without its partner is text.
fn parts(text: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let dollar = rest.find('$').and_then(|at| rest[at + 1..].find('$').map(|length| (at, 1, length)));
        let stars = rest.find("**").and_then(|at| rest[at + 2..].find("**").map(|length| (at, 2, length)));
        let first = match (dollar, stars) {
            (Some(a), Some(b)) => Some(if a.0 < b.0 { a } else { b }),
            (a, b) => a.or(b),
        };
        let Some((at, sign, length)) = first else {
            parts.push(Part::Plain(rest));
            break;
        };
        if at > 0 {
            parts.push(Part::Plain(&rest[..at]));
        }
        let inner = &rest[at + sign..at + sign + length];
        parts.push(if sign == 1 { Part::Formula(inner) } else { Part::Bold(inner) });
        rest = &rest[at + sign + length + sign..];
    }
    parts
}

/// Shows wrapped text with formulas between dollar signs and bold words between double stars; an empty line starts a
/// new paragraph.
pub(crate) fn rich_paragraph(ui: &mut Ui, text: &str) -> Response {
    rich_text(ui, text, ui.visuals().text_color())
}

/// As [`rich_paragraph`] in another colour.
pub(crate) fn rich_text(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let mut response: Option<Response> = None;
    for paragraph in text.split("\n\n").filter(|paragraph| !paragraph.trim().is_empty()) {
        let one = flow(ui, paragraph, color);
        response = Some(match response {
            Some(before) => before.union(one),
            None => one,
        });
    }
    response.unwrap_or_else(|| ui.allocate_response(vec2(0.0, 0.0), Sense::hover()))
}

fn flow(ui: &mut Ui, text: &str, color: Color32) -> Response {
    let body = eframe::egui::TextStyle::Body.resolve(ui.style());
    let words = words(ui, text, &body, color);
    let room = ui.available_width().max(40.0);
    let space =
        ui.painter().layout_no_wrap(" ".to_owned(), body.clone(), color).size().x.max(body.size * 0.25);

    // Lines: words with their left ends.
    let mut lines: Vec<Vec<(f32, Word)>> = vec![Vec::new()];
    let mut x = 0.0;
    for word in words {
        let width = word.width();
        if x > 0.0 && x + width > room {
            lines.push(Vec::new());
            x = 0.0;
        }
        if let Some(line) = lines.last_mut() {
            line.push((x, word));
        }
        x += width + space;
    }
    let (least_ascent, least_descent) = (body.size * 0.95, body.size * 0.3);
    let extents: Vec<(f32, f32)> = lines
        .iter()
        .map(|line| {
            let pieces = || line.iter().flat_map(|(_, word)| &word.pieces);
            (
                pieces().map(Piece::ascent).fold(least_ascent, f32::max),
                pieces().map(Piece::descent).fold(least_descent, f32::max),
            )
        })
        .collect();
    let leading = body.size * 0.2;
    let height: f32 = extents.iter().map(|(ascent, descent)| ascent + descent + leading).sum();
    let (rect, response) = ui.allocate_exact_size(vec2(room, height), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let mut top = rect.top();
    for (line, (ascent, descent)) in lines.iter().zip(&extents) {
        let base = top + ascent;
        for (left, word) in line {
            let mut x = rect.left() + left;
            for piece in &word.pieces {
                match piece {
                    Piece::Text(galley) => {
                        ui.painter().galley(pos2(x, base - baseline(galley)), galley.clone(), color);
                    }
                    Piece::Formula(layout) => paint_formula(ui.painter(), pos2(x, base), layout, color),
                }
                x += piece.width();
            }
        }
        top = base + descent + leading;
    }
    response
}

fn words(ui: &Ui, text: &str, body: &FontId, color: Color32) -> Vec<Word> {
    let bold = FontId::new(body.size, FontFamily::Name(SEMIBOLD.into()));
    let mut words: Vec<Word> = Vec::new();
    let mut joined = false;
    let mut put = |piece: Piece, joined: bool| match words.last_mut() {
        Some(word) if joined => word.pieces.push(piece),
        _ => words.push(Word { pieces: vec![piece] }),
    };
    for part in parts(text) {
        let (plain, font) = match part {
            Part::Plain(plain) => (plain, body),
            Part::Bold(plain) => (plain, &bold),
            Part::Formula(source) => {
                let piece = match typeset(ui, source, body.size * 1.08, true) {
                    Ok(layout) => Piece::Formula(layout),
                    // The source in the error colour says more than a gap.
                    Err(_) => {
                        let red = ui.visuals().error_fg_color;
                        Piece::Text(ui.painter().layout_no_wrap(source.to_owned(), body.clone(), red))
                    }
                };
                put(piece, joined);
                joined = true;
                continue;
            }
        };
        joined &= !plain.starts_with(char::is_whitespace);
        for word in plain.split_whitespace() {
            put(Piece::Text(ui.painter().layout_no_wrap(word.to_owned(), font.clone(), color)), joined);
            joined = false;
        }
        joined = !plain.ends_with(char::is_whitespace) && (joined || !plain.trim().is_empty());
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_splits_at_pairs_of_signs_only() {
        assert_eq!(
            parts("The knot $\\xi_k$, **once**."),
            [
                Part::Plain("The knot "),
                Part::Formula("\\xi_k"),
                Part::Plain(", "),
                Part::Bold("once"),
                Part::Plain(".")
            ],
            "formula and bold"
        );
        assert_eq!(parts("5 $ each"), [Part::Plain("5 $ each")], "a single dollar");
        assert_eq!(parts(""), [], "nothing");
    }
}
