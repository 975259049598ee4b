//! Scenes and fields on paper: SVG, PDF and PNG without a window.

#![allow(clippy::unwrap_used, reason = "the functions that prepare a test fail it")]

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use resvg::tiny_skia::Pixmap;
use resvg::usvg::roxmltree::Document;
use spline_lab::exchange::pdf::write_pdf;
use spline_lab::exchange::png::write_png;
use spline_lab::exchange::svg::{read_embedded_document, write_svg};
use spline_lab::figure::color_bar::color_bar;
use spline_lab::figure::color_map::{ColorMap, ColorScale};
use spline_lab::figure::field::Field;
use spline_lab::figure::picture::{Item, MarkerShape, Picture, Viewport};
use spline_lab::figure::scene::{
    Eye, EyeView, Line, Paper, Points, Scene, SceneItem, SceneLabel, StandardView, Triangles,
};
use spline_lab::figure::theme::Theme;

/// A torus with `count` facets around and half as many across, its net, its corners and a name.
fn torus(count: u32, theme: &Theme) -> Scene {
    let across = count / 2;
    let circle = |k: u32, of: u32| DVec2::from_angle(TAU * f64::from(k) / f64::from(of));
    let place = |i: u32, j: u32, tube: f64| {
        let (around, up) = (circle(i, count), circle(j, across));
        (around * (2.0 + tube * up.x)).extend(tube * up.y)
    };
    let grid = || (0..count).flat_map(|i| (0..across).map(move |j| (i, j)));
    let positions: Vec<DVec3> = grid().map(|(i, j)| place(i, j, 0.8)).collect();
    let normals = grid().map(|(i, j)| place(i, j, 1.0) - place(i, j, 0.5)).collect();
    let index = |i: u32, j: u32| (i % count) * across + j % across;
    let triangles = grid().flat_map(|(i, j)| {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let surface = Triangles::new(positions, triangles.collect(), theme.surface).unwrap();
    let surface = surface.with_normals(normals).unwrap();
    let mut scene = Scene::new(Some(theme.background));
    scene.push_layer("torus", vec![SceneItem::Triangles(surface)]);
    let line = |points: Vec<DVec3>| {
        SceneItem::Line(Line::new(points, theme.stroke(theme.surface_line, 0.75)).unwrap())
    };
    let meridians = (0..8).map(|k| line((0..=across).map(|j| place(k * count / 8, j, 0.8)).collect()));
    let parallels = (0..4).map(|k| line((0..=count).map(|i| place(i, k * across / 4, 0.8)).collect()));
    scene.push_layer("torus: parameter lines", meridians.chain(parallels).collect());
    let corners = (0..8).map(|k| place(k * count / 8, 0, 1.2)).collect();
    let marks = Points::new(corners, MarkerShape::Disc, 6.0, theme.palette[1]).unwrap();
    scene.push_layer("torus: points", vec![SceneItem::Points(marks)]);
    let mut label = SceneLabel::new(DVec3::new(0.0, 0.0, 1.2), "T_{1}", 12.0, theme.text).unwrap();
    label.math = true;
    scene.push_layer("torus: name", vec![SceneItem::Label(label)]);
    scene
}

fn paper(scene: &Scene, theme: &Theme) -> Paper {
    let size = DVec2::new(320.0, 220.0);
    let (low, high) = scene.bounding_box().unwrap();
    let eye = Eye::default().turned_to(StandardView::Isometric).fitted(low, high, size, 12.0);
    Paper { view: EyeView { eye, size }, light: theme.light, pixels_per_point: 2.0 }
}

fn keep(name: &str, bytes: &[u8]) {
    if let Ok(folder) = std::env::var("SPLINE_LAB_KEEP") {
        std::fs::write(std::path::Path::new(&folder).join(name), bytes).unwrap();
    }
}

#[test]
fn svg_of_a_scene_is_well_formed_and_keeps_layers_and_document() {
    let theme = Theme::light();
    for (count, tag) in [(16, "path"), (96, "image")] {
        let scene = torus(count, &theme);
        let paper = paper(&scene, &theme);
        let picture = paper.picture(&scene).unwrap();
        let svg = write_svg(&picture, &paper.viewport(), Some(r#"{"a":1}"#));
        keep(&format!("torus-{count}.svg"), svg.as_bytes());
        assert_eq!(read_embedded_document(&svg).as_deref(), Ok(r#"{"a":1}"#), "document");
        let tree = Document::parse(&svg).unwrap();
        let layers: Vec<_> = tree
            .root_element()
            .children()
            .filter_map(|node| {
                Some((node.attribute(("http://www.inkscape.org/namespaces/inkscape", "label"))?, node))
            })
            .collect();
        let names: Vec<&str> = layers.iter().map(|layer| layer.0).collect();
        let expected = ["surfaces", "torus: parameter lines", "torus: points", "torus: name"];
        assert_eq!(names, expected, "{count} facets around");
        let surfaces = layers[0].1.children().filter(|node| node.has_tag_name(tag)).count();
        assert!(surfaces > 0, "{count} facets around: surfaces as {tag}");
        let lines = layers[1].1.children().filter(|node| node.has_tag_name("path")).count();
        assert!(lines > 8, "parameter lines are vectors in {lines} visible parts");
    }
}

#[test]
fn png_and_pdf_show_the_surface() {
    for (theme, counts) in Theme::all().into_iter().zip([&[16, 96][..], &[96], &[96]]) {
        for &count in counts {
            let scene = torus(count, &theme);
            let paper = paper(&scene, &theme);
            let picture = paper.picture(&scene).unwrap();
            let png = write_png(&picture, &paper.viewport(), 2.0).unwrap();
            keep(&format!("torus-{count}-{}.png", theme.name), &png);
            let image = Pixmap::decode_png(&png).unwrap();
            assert_eq!((image.width(), image.height()), (640, 440), "2 pixels per pt");
            let ground = image.pixel(0, 0).unwrap();
            let shown = image.pixels().iter().filter(|&&pixel| pixel != ground).count();
            let right = paper.image(&Scene { background: None, ..scene.clone() }).unwrap();
            let exact = right.pixels().chunks(4).filter(|pixel| pixel[3] > 0).count();
            // Marks and the name are not in the second image.
            assert!(shown >= exact && shown < exact + exact / 20, "{shown} and {exact} pixels");
            let pdf = write_pdf(&picture, &paper.viewport()).unwrap();
            keep(&format!("torus-{count}-{}.pdf", theme.name), &pdf);
            assert!(pdf.starts_with(b"%PDF-"), "a PDF file");
        }
    }
}

/// `r²` over the square [-1, 1]² in bands and isolines, with the legend.
#[test]
fn a_field_is_drawn_in_its_colours() {
    let theme = Theme::light();
    let count = 41;
    let points: Vec<DVec2> =
        (0..count * count).map(|k| DVec2::new((k % count) as f64, (k / count) as f64) / 20.0 - 1.0).collect();
    let values = points.iter().map(|point| point.length_squared()).collect();
    let field = Field::on_grid(count, count, points, values).unwrap();
    let scale = ColorScale::new(0.0, 2.0, ColorMap::Viridis).unwrap();
    let view = Viewport { center: DVec2::new(0.4, 0.0), scale: 90.0, size: DVec2::new(300.0, 200.0) };
    for (name, mesh) in [("smooth", field.mesh(&scale)), ("bands", field.bands(&scale, 10))] {
        let mut picture = Picture::new(Some(theme.background));
        picture.push_layer("field", vec![Item::Mesh(mesh.unwrap())]);
        let stroke = theme.stroke(theme.text, 0.75);
        let lines = (1..10).flat_map(|k| field.isolines(f64::from(k) * 0.2));
        picture.push_layer("isolines", lines.map(|line| Item::Path(line.path(stroke.clone()))).collect());
        picture.push_layer("legend", color_bar(&scale, "$r^2$", &view, &theme).unwrap());
        let png = write_png(&picture, &view, 2.0).unwrap();
        keep(&format!("field-{name}.png"), &png);
        keep(&format!("field-{name}.svg"), write_svg(&picture, &view, None).as_bytes());
        let image = Pixmap::decode_png(&png).unwrap();
        // Between the isolines r² = 0.4 and 0.6, at r² = 0.5 on a diagonal.
        let place = view.page_from_world(DVec2::new(-0.5, 0.5)) * 2.0;
        let found = image.pixel(place.x as u32, place.y as u32).unwrap();
        let expected = scale.color(0.5);
        let error = [(found.red(), expected.r), (found.green(), expected.g), (found.blue(), expected.b)]
            .map(|(a, b)| a.abs_diff(b));
        assert!(error.into_iter().max() <= Some(6), "{name}: {found:?}, {expected:?} expected");
        assert!(write_pdf(&picture, &view).is_ok(), "{name}: a page");
    }
}
