//! Scalable Vector Graphics 1.1: layers, exact cubics, text as text, and the document inside.
//!
//! All lengths are in pt, also the view box. Coordinates are rounded to a millionth of a point. The document, if given, stands
//! as JSON in `<metadata><lab:document>` with the namespace [`NAMESPACE`], so that the figure opens again in the lab.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;
use glam::DVec2;
use resvg::tiny_skia::{IntSize, Pixmap};
use resvg::usvg::roxmltree;
use thiserror::Error;

use crate::exchange::page::{Medium, PageItem, lay_out};
use crate::figure::font_metrics::{FontFace, runs, text_width};
use crate::figure::formula::FormulaLayout;
use crate::figure::mesh::Image;
use crate::figure::picture::{Anchor, Color, Path, Picture, Segment, Stroke, Viewport};

/// Namespace of the embedded document.
pub const NAMESPACE: &str = "urn:spline-lab:figure";

/// Larger files are not read.
const LARGEST_FILE: usize = 256 << 20;
/// Files with more elements and texts are not read.
const MOST_NODES: u32 = 5_000_000;
/// Files with elements further within each other are not read.
const DEEPEST_ELEMENT: usize = 200;

/// Why an SVG file does not open as a document.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SvgReadError {
    /// The file is too large.
    #[error("the file has {bytes} bytes, more than the limit {limit}")]
    TooLarge {
        /// Size of the file.
        bytes: usize,
        /// Largest possible size.
        limit: usize,
    },
    /// Elements within elements beyond the limit.
    #[error("line {line}, column {column}: more than {limit} elements within each other")]
    TooDeep {
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// The limit.
        limit: usize,
    },
    /// The file is not well-formed XML.
    #[error("not an XML file: {reason}")]
    NotXml {
        /// What is wrong, with line and column.
        reason: String,
    },
    /// The file is XML, but not SVG.
    #[error("line {line}, column {column}: <svg> expected, found <{found}>")]
    NotSvg {
        /// The root element.
        found: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
    },
    /// There is no document inside.
    #[error("no Spline Lab document inside: {missing}")]
    NoDocument {
        /// Which element is missing, and where.
        missing: String,
    },
    /// There is more than one document inside.
    #[error("line {line}, column {column}: a second Spline Lab document")]
    SecondDocument {
        /// Line of the second, from 1.
        line: usize,
        /// Column of the second, from 1.
        column: usize,
    },
    /// The document is not plain text.
    #[error("line {line}, column {column}: the document must be text, found <{found}>")]
    ElementInDocument {
        /// The element.
        found: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
    },
}

/// The picture as an SVG file, with `embedded_document` (JSON) inside if given.
///
/// The text of the document comes back from [`read_embedded_document`] as it was, except that characters which XML forbids
/// come back as JSON escapes (`\u0000`), and a carriage return, white space to JSON, as a line feed.
pub fn write_svg(picture: &Picture, view: &Viewport, embedded_document: Option<&str>) -> String {
    write_svg_with(picture, view, embedded_document, Medium::Vectors)
}

/// As [`write_svg`], for a medium.
pub(super) fn write_svg_with(
    picture: &Picture,
    view: &Viewport,
    embedded_document: Option<&str>,
    medium: Medium,
) -> String {
    let (width, height) = (Number(view.size.x), Number(view.size.y));
    let mut svg = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    put(
        &mut svg,
        format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
             xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:lab=\"{NAMESPACE}\" version=\"1.1\" width=\"{width}pt\" height=\"{height}pt\" \
             viewBox=\"0 0 {width} {height}\" fill=\"none\" stroke-linejoin=\"round\">\n"
        ),
    );
    if let Some(document) = embedded_document {
        svg.push_str("<metadata><lab:document type=\"application/json\"><![CDATA[");
        svg.push_str(&cdata(document));
        svg.push_str("]]></lab:document></metadata>\n");
    }
    if let Some(color) = picture.background {
        let fill = Paint("fill", color);
        put(
            &mut svg,
            format_args!("<rect id=\"background\" width=\"{width}\" height=\"{height}\"{fill}/>\n"),
        );
    }
    for (index, layer) in lay_out(picture, view, medium).iter().enumerate() {
        let (number, name) = (index + 1, Escaped(layer.name));
        put(
            &mut svg,
            format_args!(
                "<g id=\"layer-{number}\" inkscape:groupmode=\"layer\" inkscape:label=\"{name}\">\n"
            ),
        );
        for item in &layer.items {
            write_item(&mut svg, item);
        }
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

/// The document that [`write_svg`] put into the file.
///
/// # Errors
///
/// [`SvgReadError`]; files with a document type declaration, and with that all that could grow on reading, are refused as `NotXml`.
pub fn read_embedded_document(svg: &str) -> Result<String, SvgReadError> {
    if svg.len() > LARGEST_FILE {
        return Err(SvgReadError::TooLarge { bytes: svg.len(), limit: LARGEST_FILE });
    }
    check_depth(svg)?;
    let options = roxmltree::ParsingOptions { nodes_limit: MOST_NODES, ..Default::default() };
    let tree = roxmltree::Document::parse_with_options(svg, options)
        .map_err(|error| SvgReadError::NotXml { reason: error.to_string() })?;
    let place = |node: roxmltree::Node<'_, '_>| {
        let place = tree.text_pos_at(node.range().start);
        (place.row as usize, place.col as usize)
    };
    let root = tree.root_element();
    if root.tag_name().name() != "svg" {
        let (line, column) = place(root);
        return Err(SvgReadError::NotSvg { found: root.tag_name().name().to_owned(), line, column });
    }
    let mut documents = root.descendants().filter(|node| node.has_tag_name((NAMESPACE, "document")));
    let Some(document) = documents.next() else {
        let missing = match root.children().find(|node| node.tag_name().name() == "metadata") {
            None => "<svg> has no <metadata>".to_owned(),
            Some(metadata) => {
                let (line, column) = place(metadata);
                format!("<metadata> at line {line}, column {column} has no <document> of {NAMESPACE}")
            }
        };
        return Err(SvgReadError::NoDocument { missing });
    };
    if let Some(second) = documents.next() {
        let (line, column) = place(second);
        return Err(SvgReadError::SecondDocument { line, column });
    }
    if let Some(element) = document.children().find(roxmltree::Node::is_element) {
        let (line, column) = place(element);
        return Err(SvgReadError::ElementInDocument {
            found: element.tag_name().name().to_owned(),
            line,
            column,
        });
    }
    let text: String = document.children().filter_map(|node| node.text()).collect();
    if text.trim().is_empty() {
        let (line, column) = place(document);
        let missing = format!("<document> at line {line}, column {column} is empty");
        return Err(SvgReadError::NoDocument { missing });
    }
    Ok(text)
}

/// Refuses a file whose elements are so deep within each other that a parser could run out of stack.
///
/// Counts tags outside comments, CDATA sections and processing instructions; attribute values may hold `>`.
fn check_depth(svg: &str) -> Result<(), SvgReadError> {
    let bytes = svg.as_bytes();
    let (mut depth, mut at) = (0usize, 0usize);
    while let Some(found) = svg[at..].find('<') {
        let start = at + found;
        let rest = &svg[start..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .into_iter()
            .find(|(opening, _)| rest.starts_with(opening));
        if let Some((_, closing)) = skipped {
            let Some(length) = rest.find(closing) else { return Ok(()) };
            at = start + length + closing.len();
            continue;
        }
        let mut quote = None;
        let mut end = start + 1;
        while end < bytes.len() {
            match (quote, bytes[end]) {
                (None, b'>') => break,
                (None, mark @ (b'"' | b'\'')) => quote = Some(mark),
                (Some(mark), byte) if byte == mark => quote = None,
                _ => {}
            }
            end += 1;
        }
        if end >= bytes.len() {
            return Ok(());
        }
        if bytes.get(start + 1) == Some(&b'/') {
            depth = depth.saturating_sub(1);
        } else if bytes[end - 1] != b'/' {
            depth += 1;
        }
        if depth > DEEPEST_ELEMENT {
            let before = &svg[..start];
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
            return Err(SvgReadError::TooDeep { line, column, limit: DEEPEST_ELEMENT });
        }
        at = end + 1;
    }
    Ok(())
}

/// Text for a CDATA section.
fn cdata(document: &str) -> String {
    let mut text = String::with_capacity(document.len());
    for letter in document.chars() {
        if is_allowed_in_xml(letter) {
            text.push(letter);
        } else {
            put(&mut text, format_args!("\\u{:04x}", letter as u32));
        }
    }
    text.replace("]]>", "]]]]><![CDATA[>")
}

const fn is_allowed_in_xml(letter: char) -> bool {
    matches!(letter, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..)
}

fn write_item(svg: &mut String, item: &PageItem<'_>) {
    match item {
        PageItem::Path(path) => write_path(svg, path),
        PageItem::Disc { center, radius, stroke, fill } => {
            let (x, y, radius) = (Number(center.x), Number(center.y), Number(*radius));
            put(svg, format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\""));
            write_style(svg, stroke.as_ref(), *fill);
            svg.push_str("/>\n");
        }
        PageItem::Text { at, text, size, color, anchor } => {
            write_text(svg, *at, text, *size, *color, *anchor);
        }
        PageItem::Formula { at, layout, color, .. } => write_formula(svg, *at, layout, *color),
        PageItem::Image { corner, size, image } => write_image(svg, *corner, *size, image),
    }
}

fn write_image(svg: &mut String, corner: DVec2, size: DVec2, image: &Image) {
    // Nothing is written of an image for whose file there is no memory.
    let Some(png) = png_of(image) else { return };
    let (x, y, width, height) = (Number(corner.x), Number(corner.y), Number(size.x), Number(size.y));
    put(
        svg,
        format_args!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             xlink:href=\"data:image/png;base64,{}\"/>\n",
            BASE64.encode(png)
        ),
    );
}

fn png_of(image: &Image) -> Option<Vec<u8>> {
    let premultiplied = image.pixels().chunks_exact(4).flat_map(|pixel| {
        let part = |k: usize| ((u32::from(pixel[k]) * u32::from(pixel[3]) + 127) / 255) as u8;
        [part(0), part(1), part(2), pixel[3]]
    });
    let size = IntSize::from_wh(image.width(), image.height())?;
    Pixmap::from_vec(premultiplied.collect(), size)?.encode_png().ok()
}

fn write_text(svg: &mut String, at: DVec2, text: &str, size: f64, color: Color, anchor: Anchor) {
    let runs = runs(FontFace::Regular, text);
    let fill = Paint("fill", color);
    if let [(font, run)] = runs[..] {
        let (x, y, size, run) = (Number(at.x), Number(at.y), Number(size), Escaped(run));
        let family = family(font);
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        put(
            svg,
            format_args!(
                "<text xml:space=\"preserve\" x=\"{x}\" y=\"{y}\" font-family=\"{family}\" font-size=\"{size}\" \
                 text-anchor=\"{anchor}\"{fill}>{run}</text>\n"
            ),
        );
        return;
    }
    // Each part gets its own place, so that no viewer takes a stand-in for all of them.
    let mut x = at.x - anchor.part_before() * text_width(FontFace::Regular, text, size);
    put(svg, format_args!("<text xml:space=\"preserve\" font-size=\"{}\"{fill}>", Number(size)));
    for (font, run) in runs {
        let (place, y, family, letters) = (Number(x), Number(at.y), family(font), Escaped(run));
        put(svg, format_args!("<tspan x=\"{place}\" y=\"{y}\" font-family=\"{family}\">{letters}</tspan>"));
        x += text_width(font, run, size);
    }
    svg.push_str("</text>\n");
}

fn write_formula(svg: &mut String, at: DVec2, layout: &FormulaLayout, color: Color) {
    let fill = Paint("fill", color);
    let family = family(FontFace::Math);
    svg.push_str("<g>");
    put(svg, format_args!("<text xml:space=\"preserve\" font-family=\"{family}\"{fill}>"));
    for glyph in &layout.glyphs {
        let (x, y, size) = (Number(at.x + glyph.x), Number(at.y - glyph.y), Number(glyph.size));
        let text = Escaped(&glyph.text);
        put(svg, format_args!("<tspan x=\"{x}\" y=\"{y}\" font-size=\"{size}\">{text}</tspan>"));
    }
    svg.push_str("</text>");
    for rule in &layout.rules {
        let (x, y) = (Number(at.x + rule.x), Number(at.y - rule.y - rule.height));
        let (width, height) = (Number(rule.width), Number(rule.height));
        put(svg, format_args!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{fill}/>"));
    }
    svg.push_str("</g>\n");
}

fn write_path(svg: &mut String, path: &Path) {
    svg.push_str("<path d=\"");
    for (index, segment) in path.segments.iter().enumerate() {
        if index > 0 {
            svg.push(' ');
        }
        match *segment {
            Segment::Move(to) => put(svg, format_args!("M{}", Place(to))),
            Segment::Line(to) => put(svg, format_args!("L{}", Place(to))),
            Segment::Cubic(a, b, to) => put(svg, format_args!("C{} {} {}", Place(a), Place(b), Place(to))),
            Segment::Close => svg.push('Z'),
        }
    }
    svg.push('"');
    write_style(svg, path.stroke.as_ref(), path.fill);
    svg.push_str("/>\n");
}

fn write_style(svg: &mut String, stroke: Option<&Stroke>, fill: Option<Color>) {
    if let Some(color) = fill {
        put(svg, format_args!("{}", Paint("fill", color)));
    }
    let Some(stroke) = stroke else { return };
    put(svg, format_args!("{} stroke-width=\"{}\"", Paint("stroke", stroke.color), Number(stroke.width)));
    if stroke.dashes.is_empty() {
        svg.push_str(" stroke-linecap=\"round\"");
    } else {
        let lengths: Vec<String> = stroke.dashes.iter().map(|&length| Number(length).to_string()).collect();
        put(svg, format_args!(" stroke-dasharray=\"{}\"", lengths.join(" ")));
    }
}

/// Family names with those that stand in where the fonts are not installed.
const fn family(font: FontFace) -> &'static str {
    match font {
        FontFace::Regular | FontFace::SemiBold => "Inter, Helvetica, Arial, sans-serif",
        FontFace::Math => "'STIX Two Math', 'STIX Two Text', 'Cambria Math', serif",
    }
}

/// Writing to a string does not fail.
fn put(svg: &mut String, arguments: std::fmt::Arguments<'_>) {
    let _ = svg.write_fmt(arguments);
}

/// A number rounded to a millionth, in the shortest form.
struct Number(f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let rounded = (self.0 * 1e6).round() / 1e6;
        // Adding 0 takes the sign off -0; a number too large to be multiplied has no decimals to round.
        if rounded.is_finite() { write!(f, "{}", rounded + 0.0) } else { write!(f, "{}", self.0) }
    }
}

/// `x,y`.
struct Place(DVec2);

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{},{}", Number(self.0.x), Number(self.0.y))
    }
}

/// An attribute with a colour, and its opacity if it is not opaque.
struct Paint(&'static str, Color);

impl std::fmt::Display for Paint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(name, Color { r, g, b, a }) = *self;
        write!(f, " {name}=\"#{r:02x}{g:02x}{b:02x}\"")?;
        if a < 255 {
            let opacity = (f64::from(a) / 255.0 * 1e4).round() / 1e4;
            write!(f, " {name}-opacity=\"{opacity}\"")?;
        }
        Ok(())
    }
}

/// Text for element content and attributes; characters that XML forbids become U+FFFD.
struct Escaped<'a>(&'a str);

impl std::fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for letter in self.0.chars() {
            match letter {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\t' | '\n' | '\r' => f.write_char(' ')?,
                _ if is_allowed_in_xml(letter) => f.write_char(letter)?,
                _ => f.write_char('\u{FFFD}')?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::picture::{Item, Label};

    fn view() -> Viewport {
        Viewport { center: DVec2::ZERO, scale: 50.0, size: DVec2::new(400.0, 300.0) }
    }

    fn picture(items: Vec<Item>) -> Picture {
        let mut picture = Picture::new(Some(Color::hex(0xFF_FF_FF)));
        picture.push_layer("curve \"1\" & <polygon>\u{1}", items);
        picture
    }

    #[test]
    fn documents_come_back_as_they_were() {
        for document in [
            r#"{"a":1}"#,
            r#"{"name":"]]> <b> & \"quoted\" 𝑥 ξ 한 ]]]]>"}"#,
            "{\n\t\"two lines\": [1.5, -2e-300]\n}",
            "]]>]]>",
        ] {
            let svg = write_svg(&picture(Vec::new()), &view(), Some(document));
            assert_eq!(read_embedded_document(&svg).as_deref(), Ok(document), "{svg}");
        }
    }

    #[test]
    fn characters_that_xml_forbids_become_json_escapes() {
        let svg = write_svg(&picture(Vec::new()), &view(), Some("{\"a\":\"\u{FFFF}\u{1}\"}"));
        let document = read_embedded_document(&svg);
        assert_eq!(document.as_deref(), Ok(r#"{"a":"\uffff\u0001"}"#), "the same JSON");
    }

    #[test]
    fn what_is_missing_is_named_with_its_place() {
        let none = read_embedded_document(&write_svg(&picture(Vec::new()), &view(), None));
        assert!(
            matches!(&none, Err(SvgReadError::NoDocument { missing }) if missing.contains("<metadata>")),
            "{none:?}"
        );
        let foreign = "<svg xmlns='http://www.w3.org/2000/svg'>\n  <metadata/></svg>";
        let found = read_embedded_document(foreign);
        assert!(
            matches!(&found, Err(SvgReadError::NoDocument { missing }) if missing.contains("line 2")),
            "{found:?}"
        );
        let html = read_embedded_document("<html/>");
        let expected = SvgReadError::NotSvg { found: "html".to_owned(), line: 1, column: 1 };
        assert_eq!(html, Err(expected), "not SVG");
    }

    #[test]
    fn hostile_files_get_errors() {
        let namespace = format!("xmlns='http://www.w3.org/2000/svg' xmlns:lab='{NAMESPACE}'");
        let twice =
            format!("<svg {namespace}><lab:document>1</lab:document><lab:document>2</lab:document></svg>");
        let within = format!("<svg {namespace}><lab:document>1<b/></lab:document></svg>");
        let empty = format!("<svg {namespace}><metadata><lab:document> </lab:document></metadata></svg>");
        let bomb =
            "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;'>]><svg>&b;</svg>".to_owned();
        let deep = format!("<svg>{}", "<g a='>'>".repeat(200_000));
        let deep_closed = format!("<svg>{}{}</svg>", "<g>".repeat(100_000), "</g>".repeat(100_000));
        for hostile in [twice, within, empty, bomb, deep, deep_closed, "\0\0<svg>".to_owned(), String::new()]
        {
            let found = read_embedded_document(&hostile);
            assert!(found.is_err(), "{:.80} gave {found:?}", hostile);
        }
        let whole = write_svg(&picture(Vec::new()), &view(), Some("{\"a\":[1,2,3]}"));
        for length in (0..whole.len() - 1).filter(|&length| whole.is_char_boundary(length)) {
            let found = read_embedded_document(&whole[..length]);
            assert!(length + 2 > whole.len() || found.is_err(), "cut at {length}: {found:?}");
        }
    }

    #[test]
    fn coordinates_are_rounded_to_a_millionth_and_short() {
        for (number, text) in
            [(0.1 + 0.2, "0.3"), (-1e-9, "0"), (200.0, "200"), (1.0 / 3.0, "0.333333"), (-0.5, "-0.5")]
        {
            assert_eq!(Number(number).to_string(), text, "{number}");
        }
    }

    #[test]
    fn cubics_are_written_where_they_are() {
        let segments = vec![
            Segment::Move(DVec2::ZERO),
            Segment::Cubic(DVec2::X, DVec2::ONE, DVec2::new(1.0 / 3.0, 2.0)),
        ];
        let stroke = Stroke::dashed(Color { r: 1, g: 2, b: 255, a: 51 }, 1.5, 3.0, 2.0);
        let svg = write_svg(
            &picture(vec![Item::Path(Path { segments, stroke: Some(stroke), fill: None })]),
            &view(),
            None,
        );
        assert!(svg.contains("d=\"M200,150 C250,150 250,100 216.666667,50\""), "{svg}");
        assert!(svg.contains("stroke=\"#0102ff\" stroke-opacity=\"0.2\" stroke-width=\"1.5\""), "{svg}");
        assert!(svg.contains("stroke-dasharray=\"3 2\""), "{svg}");
        assert!(svg.contains("width=\"400pt\" height=\"300pt\" viewBox=\"0 0 400 300\""), "{svg}");
    }

    #[test]
    fn names_and_texts_are_escaped_and_stay_text() {
        let label = |text: &str, math: bool| {
            let (text, color) = (text.to_owned(), Color::hex(0));
            let (at, offset, anchor) = (DVec2::ZERO, DVec2::ZERO, Anchor::Middle);
            Item::Label(Label { at, offset, text, size: 10.0, color, anchor, math })
        };
        let items = vec![label("1 < 2 & \"so\"", false), label("x_3", true), label(r"\wrong", true)];
        let svg = write_svg(&picture(items), &view(), None);
        let tree = roxmltree::Document::parse(&svg).unwrap();
        let texts: Vec<String> = tree
            .descendants()
            .filter(|node| node.has_tag_name("text"))
            .map(|node| {
                node.descendants().filter(roxmltree::Node::is_text).filter_map(|t| t.text()).collect()
            })
            .collect();
        assert_eq!(texts, ["1 < 2 & \"so\"", "𝑥3", r"\wrong"], "{svg}");
        let layer = tree.descendants().find(|node| node.attribute("id") == Some("layer-1")).unwrap();
        let name = layer.attribute(("http://www.inkscape.org/namespaces/inkscape", "label"));
        assert_eq!(name, Some("curve \"1\" & <polygon>\u{FFFD}"), "layer name");
    }

    #[test]
    fn places_that_are_not_numbers_are_left_out() {
        let stroke = Stroke::solid(Color::hex(0), 1.0);
        let items = vec![
            Item::Path(Path::polyline(&[DVec2::ZERO, DVec2::NAN], stroke.clone())),
            Item::Path(Path::polyline(&[DVec2::ZERO, DVec2::X], stroke)),
        ];
        let svg = write_svg(&picture(items), &view(), None);
        assert!(!svg.contains("NaN"), "{svg}");
        assert_eq!(svg.matches("<path").count(), 1, "{svg}");
    }
}
