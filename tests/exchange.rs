//! Figures on paper: one picture written as SVG, PNG and PDF.

use glam::DVec2;
use resvg::tiny_skia::Pixmap;
use resvg::usvg::roxmltree::Document;
use spline_lab::core::bspline::{Side, SplineSpace};
use spline_lab::core::spline_curve::Nurbs;
use spline_lab::exchange::pdf::{PdfError, write_pdf};
use spline_lab::exchange::png::{PngError, write_png};
use spline_lab::exchange::svg::{read_embedded_document, write_svg};
use spline_lab::figure::curve::{cubic_point, curve_path};
use spline_lab::figure::picture::{
    Anchor, Color, Item, Label, Marker, MarkerShape, Path, Picture, Stroke, Viewport,
};
use spline_lab::figure::theme::Theme;

fn view() -> Viewport {
    Viewport { center: DVec2::new(3.5, 0.0), scale: 40.0, size: DVec2::new(320.0, 200.0) }
}

fn cubic_curve() -> Nurbs<DVec2> {
    let points = (0..8).map(|k| DVec2::new(f64::from(k), (f64::from(k) * 1.9).sin())).collect();
    let space = SplineSpace::new(3, (0..12).map(f64::from).collect()).expect("knots 0 to 11");
    Nurbs::polynomial(space, points).expect("eight control points")
}

fn label(text: &str, math: bool) -> Item {
    let (text, color, anchor) = (text.to_owned(), Theme::light().text, Anchor::Middle);
    Item::Label(Label {
        at: DVec2::new(3.5, 1.5),
        offset: DVec2::new(0.0, 4.0),
        text,
        size: 12.0,
        color,
        anchor,
        math,
    })
}

fn sample() -> Picture {
    let theme = Theme::light();
    let curve = cubic_curve();
    let mut picture = Picture::new(Some(theme.background));
    let polygon = Path::polyline(curve.points(), theme.dashed_stroke(theme.polygon, 1.0, 4.0, 3.0));
    picture.push_layer("curve 1: control polygon", vec![Item::Path(polygon)]);
    let stroke = Some(theme.stroke(theme.palette[0], 2.0));
    picture.push_layer(
        "curve 1",
        vec![Item::Path(Path { segments: curve_path(&curve, 1e-3), stroke, fill: None })],
    );
    let shapes = [
        MarkerShape::Disc,
        MarkerShape::Square,
        MarkerShape::Diamond,
        MarkerShape::Triangle,
        MarkerShape::Cross,
    ];
    let markers = curve.points().iter().zip(shapes.iter().cycle()).map(|(&at, &shape)| {
        let (fill, stroke) = (Some(theme.basis_color(1)), Some(theme.stroke(theme.background, 1.0)));
        Item::Marker(Marker { at, shape, size: 7.0, fill, stroke })
    });
    picture.push_layer("curve 1: control points", markers.collect());
    picture.push_layer("text", vec![label(r"\frac{c_k}{\sqrt{\xi}}", true), label("Knots ξ & 𝑥", false)]);
    picture
}

#[test]
fn svg_cubics_run_on_the_curve() {
    let svg = write_svg(&sample(), &view(), Some("{}"));
    let tree = Document::parse(&svg).unwrap();
    let layers: Vec<&str> = tree
        .root_element()
        .children()
        .filter_map(|node| node.attribute(("http://www.inkscape.org/namespaces/inkscape", "label")))
        .collect();
    let expected = ["curve 1: control polygon", "curve 1", "curve 1: control points", "text"];
    assert_eq!(layers, expected, "layers in order");
    let path =
        tree.descendants().filter_map(|node| node.attribute("d")).find(|steps| steps.contains('C')).unwrap();
    let numbers: Vec<f64> = path
        .split(|letter: char| !(letter.is_ascii_digit() || ".-".contains(letter)))
        .filter(|number| !number.is_empty())
        .map(|number| number.parse().unwrap())
        .collect();
    let places: Vec<DVec2> = numbers.chunks(2).map(|pair| DVec2::new(pair[0], pair[1])).collect();
    assert_eq!(places.len(), 1 + 3 * 5, "five cubics: {path}");
    let curve = cubic_curve();
    for (piece, ends) in curve.space().breaks().windows(2).enumerate() {
        let cubic: [DVec2; 4] = places[3 * piece..3 * piece + 4].try_into().unwrap();
        for i in 0..=10 {
            let s = f64::from(i) / 10.0;
            let t = ends[0] + (ends[1] - ends[0]) * s;
            let side = if i == 0 { Side::Right } else { Side::Left };
            let expected = view().page_from_world(curve.derivatives(t, 0, side).unwrap()[0]);
            let error = (cubic_point(cubic, s) - expected).length();
            assert!(error < 1e-6, "piece {piece} at {s}: {error:e} pt, coordinates are rounded to 1e-6 pt");
        }
    }
}

#[test]
fn documents_survive_the_svg_of_a_full_picture() {
    let document = r#"{"name":"]]> & <svg> \"ξ\" 𝑥","points":[[0.1,1e-300]]}"#;
    let svg = write_svg(&sample(), &view(), Some(document));
    assert_eq!(read_embedded_document(&svg).as_deref(), Ok(document), "document");
}

#[test]
fn png_shows_ground_curve_and_text() {
    let image = Pixmap::decode_png(&write_png(&sample(), &view(), 2.0).unwrap()).unwrap();
    assert_eq!((image.width(), image.height()), (640, 400), "2 pixels per pt");
    let theme = Theme::light();
    let count = |color: Color| {
        let close = |a: u8, b: u8| a.abs_diff(b) <= 2;
        let pixels = image.pixels().iter();
        pixels
            .filter(|p| close(p.red(), color.r) && close(p.green(), color.g) && close(p.blue(), color.b))
            .count()
    };
    let [ground, curve, text] = [theme.background, theme.palette[0], theme.text].map(count);
    assert!(ground > 200_000, "{ground} pixels of ground");
    assert!(curve > 800, "{curve} pixels of curve");
    assert!(text > 50, "{text} pixels of text");
}

#[test]
fn clear_grounds_stay_clear() {
    let picture = Picture::new(None);
    let image = Pixmap::decode_png(&write_png(&picture, &view(), 1.0).unwrap()).unwrap();
    assert!(image.pixels().iter().all(|pixel| pixel.alpha() == 0), "nothing drawn");
}

#[test]
fn pdf_holds_its_fonts_and_is_the_same_every_time() {
    let pdf = write_pdf(&sample(), &view()).unwrap();
    assert!(pdf.starts_with(b"%PDF-"), "{:?}", &pdf[..8]);
    let holds = |name: &str| pdf.windows(name.len()).any(|part| part == name.as_bytes());
    for name in ["Inter-Regular", "STIXTwoMath-Regular", "/MediaBox", "%%EOF"] {
        assert!(holds(name), "{name} is missing");
    }
    assert!(!holds("Semi"), "a font that is not used");
    assert_eq!(pdf, write_pdf(&sample(), &view()).unwrap(), "no dates, no random numbers");
}

#[test]
fn impossible_sizes_are_named() {
    let sized = |x: f64, y: f64| Viewport { size: DVec2::new(x, y), ..view() };
    for (bad, resolution, name) in [
        (sized(0.0, 10.0), 1.0, "width"),
        (sized(10.0, f64::NAN), 1.0, "height"),
        (view(), -1.0, "resolution"),
        (view(), f64::INFINITY, "resolution"),
    ] {
        let found = write_png(&sample(), &bad, resolution);
        assert!(matches!(&found, Err(PngError::BadSize { what, .. }) if *what == name), "{name}: {found:?}");
    }
    for (size, resolution) in [(sized(1e5, 10.0), 1.0), (sized(2e4, 2e4), 1.0), (view(), 1000.0)] {
        let found = write_png(&sample(), &size, resolution);
        assert!(matches!(found, Err(PngError::TooLarge { .. })), "{found:?}");
    }
    for size in [sized(0.0, 100.0), sized(100.0, 20_000.0), sized(f64::NAN, 100.0)] {
        let found = write_pdf(&sample(), &size);
        assert!(matches!(found, Err(PdfError::BadSize { .. })), "{found:?}");
    }
}

#[test]
fn strange_pictures_are_written() {
    let stroke = |width: f64, dashes: Vec<f64>| Some(Stroke { color: Color::hex(0), width, dashes });
    let line = |ends: &[DVec2], stroke| {
        Item::Path(Path { stroke, ..Path::polyline(ends, Stroke::solid(Color::hex(0), 1.0)) })
    };
    let far = [DVec2::splat(-1e30), DVec2::splat(1e30)];
    let huge = [DVec2::splat(-1e306), DVec2::splat(1e306)];
    let here = [DVec2::ZERO, DVec2::ONE];
    let items = vec![
        line(&[], stroke(1.0, vec![])),
        line(&[DVec2::ZERO], stroke(1.0, vec![])),
        line(&[DVec2::NAN, DVec2::ZERO], stroke(1.0, vec![])),
        line(&far, stroke(1.0, vec![])),
        line(&huge, stroke(1.0, vec![])),
        line(&here, stroke(f64::NAN, vec![])),
        line(&here, stroke(-1.0, vec![])),
        line(&here, stroke(1.0, vec![0.0, 0.0])),
        line(&here, stroke(1.0, vec![f64::NAN, 1.0])),
        line(&here, stroke(1.0, vec![1.0, 2.0, 3.0])),
        line(&here, None),
        label("", false),
        label("", true),
        label(r"\wrong{", true),
        label("\0\u{FFFF}\u{10FFFF} line\nbreak", false),
        Item::Marker(Marker {
            at: DVec2::ZERO,
            shape: MarkerShape::Cross,
            size: f64::INFINITY,
            fill: None,
            stroke: None,
        }),
    ];
    let mut picture = Picture::new(None);
    picture.push_layer("\0", items);
    let svg = write_svg(&picture, &view(), None);
    assert!(Document::parse(&svg).is_ok(), "{svg}");
    assert!(write_png(&picture, &view(), 1.0).is_ok(), "an image");
    assert!(write_pdf(&picture, &view()).is_ok(), "a page");
}
