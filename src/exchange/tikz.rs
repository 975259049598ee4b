//! TikZ: a picture as a LaTeX file of its own, and a slide of beamer on which the frames of a picture follow each other as overlays.
//!
//! One unit is a point of 1/72 inch (`bp`), y up. Layers that all frames share are drawn once; of the others, frames `a` to `b` that agree
//! share one `\only<a-b>`. Formulas stay LaTeX. Images have no place: frames leave them out, pictures that have any are refused.

use std::fmt::Write as _;

use glam::DVec2;

use crate::exchange::frames::FramePage;
use crate::exchange::page::{Medium, PageItem, PageLayer, lay_out};
use crate::figure::picture::{Anchor, Color, Path, Picture, Segment, Stroke, Viewport};

/// Options of the environment of every picture.
const PICTURE_OPTIONS: &str = "x=1bp,y=1bp,line join=round,every node/.style={inner sep=0pt,outer sep=0pt}";

/// A LaTeX file of the class `standalone` with the picture alone, as large as the view; it can be included by others, and its environment
/// `tikzpicture` copied.
///
/// # Errors
///
/// The number of images in the picture, if there are any.
pub fn write_tikz(picture: &Picture, viewport: &Viewport) -> Result<String, usize> {
    let layers = lay_out(picture, viewport, Medium::Vectors);
    let items = layers.iter().flat_map(|layer| &layer.items);
    let images = items.filter(|item| matches!(item, PageItem::Image { .. })).count();
    if images > 0 {
        return Err(images);
    }
    let mut tex = String::from(
        "% A figure of Spline Lab.\n\\documentclass{standalone}\n\\usepackage{amsmath,amssymb,tikz}\n\\begin{document}\n",
    );
    put(&mut tex, format_args!("\\begin{{tikzpicture}}[{PICTURE_OPTIONS}]\n"));
    put_ground(&mut tex, viewport.size, picture.background);
    for layer in &layers {
        put(&mut tex, format_args!("% {}\n{}", printable(layer.name), code(layer, viewport.size.y)));
    }
    tex.push_str("\\end{tikzpicture}\n\\end{document}\n");
    Ok(tex)
}

/// What is outside is cut off, what is inside has the colour of the background.
fn put_ground(tex: &mut String, size: DVec2, background: Option<Color>) {
    let (width, height) = (Number(size.x), Number(size.y));
    put(tex, format_args!("\\clip (0,0) rectangle ({width},{height});\n"));
    if let Some(color) = background {
        put(tex, format_args!("\\fill[{}] (0,0) rectangle ({width},{height});\n", Paint("fill", color)));
    }
}

fn printable(name: &str) -> String {
    name.chars().filter(|letter| !letter.is_control()).collect()
}

/// A LaTeX file with one slide; `pages` have the same size and layers.
pub(super) fn write_overlays(pages: &[FramePage]) -> String {
    let Some(first) = pages.first() else { return String::new() };
    let (size, count) = (first.viewport.size, pages.len());
    let mut names: Vec<&str> = Vec::new();
    let mut drawn: Vec<Vec<(&str, String)>> = Vec::with_capacity(count);
    for page in pages {
        let layers = lay_out(&page.picture, &page.viewport, Medium::Vectors);
        drawn.push(layers.iter().map(|layer| (name_of(page, layer), code(layer, size.y))).collect());
    }
    // Where a frame lacks a layer, the others keep their order.
    for (name, _) in drawn.iter().flatten() {
        if !names.contains(name) {
            names.push(name);
        }
    }
    names.sort_by_key(|name| {
        drawn.iter().filter_map(|layers| layers.iter().position(|(other, _)| other == name)).max()
    });
    let (width, height) = (Number(size.x), Number(size.y));
    let mut tex = String::from(
        "% Frames of Spline Lab. The picture can be copied into any frame of beamer.\n\\documentclass{beamer}\n\\usepackage{amsmath,amssymb,tikz}\n",
    );
    put(&mut tex, format_args!("\\geometry{{paperwidth={width}bp,paperheight={height}bp,margin=0bp}}\n"));
    tex.push_str("\\setbeamertemplate{navigation symbols}{}\n\\setbeamersize{text margin left=0bp,text margin right=0bp}\n");
    tex.push_str("\\begin{document}\n\\begin{frame}[plain]\n");
    put(&mut tex, format_args!("\\begin{{tikzpicture}}[{PICTURE_OPTIONS},\n"));
    tex.push_str("  remember picture,overlay,shift={(current page.south west)}]\n");
    put_ground(&mut tex, size, first.picture.background);
    for name in names {
        let of_frame =
            |frame: usize| drawn[frame].iter().find(|(other, _)| *other == name).map_or("", |(_, code)| code);
        put(&mut tex, format_args!("% {}\n", printable(name)));
        let mut start = 0;
        while start < count {
            let end = (start..count)
                .take_while(|&frame| of_frame(frame) == of_frame(start))
                .last()
                .unwrap_or(start);
            match (of_frame(start), (start, end)) {
                ("", _) => {}
                (code, (0, end)) if end + 1 == count => tex.push_str(code),
                (code, _) => put(&mut tex, format_args!("\\only<{}-{}>{{%\n{code}}}\n", start + 1, end + 1)),
            }
            start = end + 1;
        }
    }
    tex.push_str("\\end{tikzpicture}\n\\end{frame}\n\\end{document}\n");
    tex
}

fn name_of<'a>(page: &'a FramePage, layer: &PageLayer<'_>) -> &'a str {
    let found = page.picture.layers.iter().find(|other| other.name == layer.name);
    found.map_or("", |layer| &layer.name)
}

fn put(tex: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a string does not fail.
    let _ = tex.write_fmt(text);
}

fn code(layer: &PageLayer<'_>, height: f64) -> String {
    let mut tex = String::new();
    for item in &layer.items {
        match item {
            PageItem::Path(path) => put_path(&mut tex, path, height),
            PageItem::Disc { center, radius, stroke, fill } => {
                let options = options(stroke.as_ref(), *fill);
                let place = Place(*center, height);
                put(
                    &mut tex,
                    format_args!("\\path[{options}] {place} circle[radius={}];\n", Number(*radius)),
                );
            }
            PageItem::Text { at, text, size, color, anchor } => {
                put_node(&mut tex, Place(*at, height), *size, *color, *anchor, &escaped(text));
            }
            PageItem::Formula { at, source, size, color, .. } => {
                let formula = format!("$\\displaystyle {source}$");
                put_node(&mut tex, Place(*at, height), *size, *color, Anchor::Start, &formula);
            }
            PageItem::Image { .. } => {}
        }
    }
    tex
}

fn put_path(tex: &mut String, path: &Path, height: f64) {
    put(tex, format_args!("\\path[{}]", options(path.stroke.as_ref(), path.fill)));
    for segment in &path.segments {
        match *segment {
            Segment::Move(to) => put(tex, format_args!(" {}", Place(to, height))),
            Segment::Line(to) => put(tex, format_args!(" -- {}", Place(to, height))),
            Segment::Cubic(a, b, to) => put(
                tex,
                format_args!(
                    " .. controls {} and {} .. {}",
                    Place(a, height),
                    Place(b, height),
                    Place(to, height)
                ),
            ),
            Segment::Close => tex.push_str(" -- cycle"),
        }
        // TeX reads lines of any length, people do not.
        if tex.len() - tex.rfind('\n').map_or(0, |end| end + 1) > 160 {
            tex.push('\n');
        }
    }
    tex.push_str(";\n");
}

fn put_node(tex: &mut String, at: Place, size: f64, color: Color, anchor: Anchor, text: &str) {
    let anchor = match anchor {
        Anchor::Start => "base west",
        Anchor::Middle => "base",
        Anchor::End => "base east",
    };
    let (size, pitch) = (Number(size), Number(1.2 * size));
    let paint = Paint("text", color);
    put(
        tex,
        format_args!(
            "\\node[anchor={anchor},{paint},font=\\fontsize{{{size}bp}}{{{pitch}bp}}\\selectfont] at {at} {{{text}}};\n"
        ),
    );
}

fn options(stroke: Option<&Stroke>, fill: Option<Color>) -> String {
    let mut options = Vec::new();
    if let Some(color) = fill {
        options.push(Paint("fill", color).to_string());
    }
    if let Some(stroke) = stroke {
        options.push(format!("{},line width={}bp", Paint("draw", stroke.color), Number(stroke.width)));
        if !stroke.dashes.is_empty() {
            let pattern: Vec<String> = stroke
                .dashes
                .iter()
                .enumerate()
                .map(|(i, &length)| format!("{} {}bp", if i % 2 == 0 { "on" } else { "off" }, Number(length)))
                .collect();
            options.push(format!("dash pattern={}", pattern.join(" ")));
        }
    }
    options.join(",")
}

/// A colour as an option, with its opacity if it is not opaque.
struct Paint(&'static str, Color);

impl std::fmt::Display for Paint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(name, Color { r, g, b, a }) = *self;
        write!(f, "{name}={{rgb,255:red,{r};green,{g};blue,{b}}}")?;
        if a < 255 {
            write!(f, ",{name} opacity={}", Number(f64::from(a) / 255.0))?;
        }
        Ok(())
    }
}

/// A place on the page; TikZ counts from the lower left corner.
#[derive(Clone, Copy)]
struct Place(DVec2, f64);

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "({},{})", Number(self.0.x), Number(self.1 - self.0.y))
    }
}

/// A number with at most three decimals: TeX has no more than 16 bits for the whole part and five digits behind.
struct Number(f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let rounded = (self.0.clamp(-16_000.0, 16_000.0) * 1e3).round() / 1e3;
        write!(f, "{}", if rounded == 0.0 { 0.0 } else { rounded })
    }
}

/// Text for LaTeX; digits above and below the line become mathematics.
fn escaped(text: &str) -> String {
    const BELOW: &str = "₀₁₂₃₄₅₆₇₈₉";
    // The last one is the sign of negative powers.
    const ABOVE: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let digit = |digits: &str, letter: char| digits.chars().position(|other| other == letter);
    let mut tex = String::new();
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if digit(BELOW, letter).or_else(|| digit(ABOVE, letter)).is_some() {
            let mut scripts = [String::new(), String::new()];
            let mut next = Some(letter);
            while let Some(letter) = next {
                let place = usize::from(digit(ABOVE, letter).is_some());
                let value = digit(BELOW, letter).or_else(|| digit(ABOVE, letter)).unwrap_or(0);
                if value < 10 {
                    put(&mut scripts[place], format_args!("{value}"));
                } else {
                    scripts[place].push('-');
                }
                next = letters
                    .next_if(|&letter| digit(BELOW, letter).or_else(|| digit(ABOVE, letter)).is_some());
            }
            tex.push('$');
            for (sign, script) in
                ["_", "^"].into_iter().zip(&scripts).filter(|(_, script)| !script.is_empty())
            {
                put(&mut tex, format_args!("{sign}{{{script}}}"));
            }
            tex.push('$');
            continue;
        }
        match letter {
            '\\' => tex.push_str("\\textbackslash{}"),
            '~' => tex.push_str("\\textasciitilde{}"),
            '^' => tex.push_str("\\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                tex.push('\\');
                tex.push(letter);
            }
            '−' => tex.push_str("$-$"),
            '<' | '>' | '|' => put(&mut tex, format_args!("${letter}$")),
            letter if letter.is_control() => tex.push(' '),
            letter => match mathematics(letter) {
                Some(code) => put(&mut tex, format_args!("${code}$")),
                None => tex.push(letter),
            },
        }
    }
    tex
}

/// The letters and signs of figures that text fonts of LaTeX lack.
fn mathematics(letter: char) -> Option<&'static str> {
    Some(match letter {
        'α' => "\\alpha",
        'β' => "\\beta",
        'γ' => "\\gamma",
        'θ' => "\\theta",
        'κ' => "\\kappa",
        'λ' => "\\lambda",
        'ξ' => "\\xi",
        'π' => "\\pi",
        'ρ' => "\\rho",
        'σ' => "\\sigma",
        'τ' => "\\tau",
        'φ' => "\\varphi",
        'ω' => "\\omega",
        'Δ' => "\\Delta",
        'Σ' => "\\Sigma",
        '·' => "\\cdot",
        '×' => "\\times",
        '±' => "\\pm",
        '≤' => "\\leq",
        '≥' => "\\geq",
        '≈' => "\\approx",
        '∞' => "\\infty",
        '→' => "\\to",
        '∂' => "\\partial",
        '∇' => "\\nabla",
        '…' => "\\ldots",
        '′' => "^{\\prime}",
        '″' => "^{\\prime\\prime}",
        '°' => "^{\\circ}",
        'ᵢ' => "_{i}",
        'ₖ' => "_{k}",
        'ₙ' => "_{n}",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::picture::{Item, Label};

    fn page(texts: &[&str]) -> FramePage {
        let mut picture = Picture::new(None);
        let stroke = Stroke::dashed(Color { r: 1, g: 2, b: 3, a: 51 }, 1.5, 3.0, 2.0);
        picture.push_layer("curve", vec![Item::Path(Path::polyline(&[DVec2::ZERO, DVec2::X], stroke))]);
        let label = |text: &&str| {
            let (at, offset, anchor, color) = (DVec2::ZERO, DVec2::ZERO, Anchor::End, Color::hex(0));
            Item::Label(Label {
                at,
                offset,
                text: (*text).to_owned(),
                size: 10.0,
                color,
                anchor,
                math: text.contains('\\'),
            })
        };
        picture.push_layer("text", texts.iter().map(label).collect());
        FramePage {
            picture,
            viewport: Viewport { center: DVec2::ZERO, scale: 50.0, size: DVec2::new(400.0, 300.0) },
        }
    }

    #[test]
    fn what_all_frames_share_is_drawn_once_and_the_rest_in_overlays() {
        let tex = write_overlays(&[page(&["a"]), page(&["a"]), page(&["b"]), page(&[])]);
        assert_eq!(tex.matches("(200,150) -- (250,150)").count(), 1, "the curve, y up: {tex}");
        assert!(tex.contains("\\only<1-2>{%") && tex.contains("\\only<3-3>{%"), "{tex}");
        assert!(!tex.contains("\\only<4"), "nothing to show on frame 4: {tex}");
        assert!(
            tex.contains("draw={rgb,255:red,1;green,2;blue,3},draw opacity=0.2,line width=1.5bp"),
            "{tex}"
        );
        assert!(tex.contains("dash pattern=on 3bp off 2bp"), "{tex}");
    }

    #[test]
    fn a_picture_alone_has_the_code_of_a_frame_and_no_slide() {
        let FramePage { picture, viewport, .. } = page(&["a"]);
        let tex = write_tikz(&picture, &viewport).unwrap();
        assert!(tex.contains("\\documentclass{standalone}") && !tex.contains("\\begin{frame}"), "{tex}");
        assert!(tex.contains("\\clip (0,0) rectangle (400,300);"), "as large as the view: {tex}");
        let slide = write_overlays(&[page(&["a"])]);
        let drawn = |tex: &str| -> Vec<String> {
            tex.lines()
                .filter(|line| line.starts_with("\\path") || line.starts_with("\\node"))
                .map(str::to_owned)
                .collect()
        };
        assert!(drawn(&tex).len() >= 2, "{tex}");
        assert_eq!(drawn(&tex), drawn(&slide), "the same drawing");
        check_nesting(&tex, &["document", "tikzpicture"]);
    }

    #[test]
    fn braces_balance_and_environments_close() {
        let tex = write_overlays(&[page(&["50 % {x} \\ #1"]), page(&["\\frac{1}{2}"])]);
        check_nesting(&tex, &["document", "frame", "tikzpicture"]);
    }

    fn check_nesting(tex: &str, environments: &[&str]) {
        let (mut depth, mut escaped) = (0_i32, false);
        for letter in tex.chars() {
            match letter {
                '{' if !escaped => depth += 1,
                '}' if !escaped => depth -= 1,
                _ => {}
            }
            escaped = letter == '\\' && !escaped;
            assert!(depth >= 0, "a brace too many: {tex}");
        }
        assert_eq!(depth, 0, "a brace is open: {tex}");
        for environment in environments {
            let count = |word: &str| tex.matches(&format!("\\{word}{{{environment}}}")).count();
            assert_eq!((count("begin"), count("end")), (1, 1), "{environment}");
        }
    }

    #[test]
    fn names_with_raised_and_lowered_digits_become_mathematics() {
        assert_eq!(escaped("κ × 10⁻⁶"), "$\\kappa$ $\\times$ 10$^{-6}$", "axes of charts");
        assert_eq!(escaped("|r′| ≤ 2°"), "$|$r$^{\\prime}$$|$ $\\leq$ 2$^{\\circ}$", "signs");
        assert_eq!(escaped("p₁₂³ lies 50 % of c₀"), "p$_{12}^{3}$ lies 50 \\% of c$_{0}$", "scripts");
        assert_eq!(escaped("a_b & −1"), "a\\_b \\& $-$1", "signs");
    }

    #[test]
    fn formulas_stay_latex() {
        let tex = write_overlays(&[page(&["\\frac{5-1}{7-1} \\, c_3"])]);
        assert!(tex.contains("{$\\displaystyle \\frac{5-1}{7-1} \\, c_3$}"), "{tex}");
    }
}
