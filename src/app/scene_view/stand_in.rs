//! A scene by the processor, for windows without a usable GPU: a thread of its own draws surfaces as an image and cuts lines,
//! marks and texts where something hides them; egui paints those sharply. While the view changes the image is coarse.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use eframe::egui::{Color32, ColorImage, Context, Rect, TextureHandle, TextureOptions, Ui, pos2};
use glam::DVec2;

use crate::app::painter::{paint_note, paint_picture};
use crate::app::scene_view::gpu::Order;
use crate::app::scene_view::upright;
use crate::figure::error::FigureError;
use crate::figure::mesh::{Image, PlacedImage};
use crate::figure::picture::{Color, Item, Picture};
use crate::figure::scene::{EyeView, Light, Paper, Scene, SceneItem};

/// Pixels of the image while the view changes.
const COARSE_PIXELS: f64 = 90_000.0;
/// A frame waits so long for its picture, so that small scenes follow the hand without lag.
const PATIENCE: Duration = Duration::from_millis(30);
/// A view that has not changed for so many seconds is drawn finely.
const REST: f64 = 0.12;
/// With more segments lines are drawn into the image.
const MOST_VECTOR_SEGMENTS: usize = 6000;

/// What is to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Page {
    version: u64,
    view: EyeView,
    light: Light,
    ground: Color,
    pixels_per_point: f64,
}

/// What was drawn, and how long it took.
struct Drawn {
    page: Page,
    result: Result<(Option<ColorImage>, Picture), FigureError>,
    took: Duration,
}

struct Shown {
    page: Page,
    image: Option<TextureHandle>,
    picture: Picture,
}

struct Worker {
    requests: Sender<(Arc<Scene>, Page)>,
    answers: Receiver<Drawn>,
}

/// The view drawn by the processor.
#[derive(Default)]
pub(super) struct StandIn {
    worker: Option<Worker>,
    scene: Option<(u64, Arc<Scene>)>,
    asked: Option<Page>,
    shown: Option<Shown>,
    problem: Option<String>,
    /// The view of the last frame and the time at which it changed.
    last: Option<(Page, f64)>,
    /// How long a fine picture takes.
    fine: Duration,
    #[cfg(test)]
    pub(super) drawn: usize,
}

impl StandIn {
    pub(super) fn paint(&mut self, order: &Order<'_>, rect: Rect, ui: &Ui) {
        let fine = Page {
            version: order.version,
            view: *order.view,
            light: *order.light,
            ground: order.ground,
            pixels_per_point: order.pixels_per_point.clamp(0.5, 2.0),
        };
        let now = ui.input(|input| input.time);
        let since = self.last.filter(|(page, _)| *page == fine).map_or(now, |(_, since)| since);
        self.last = Some((fine, since));
        self.take_answers(Duration::ZERO, ui.ctx());
        if self.shown.as_ref().is_none_or(|shown| shown.page != fine) {
            let coarse = (COARSE_PIXELS / (fine.view.size.x * fine.view.size.y)).sqrt();
            let rests = self.shown.is_none() || now - since >= REST;
            let page = if rests || self.fine < PATIENCE {
                fine
            } else {
                ui.request_repaint_after_secs(REST as f32);
                Page { pixels_per_point: fine.pixels_per_point.min(coarse), ..fine }
            };
            self.ask(page, order.scene, ui.ctx());
        }
        let painter = ui.painter_at(rect);
        if let Some(shown) = &self.shown {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            if let Some(image) = &shown.image {
                painter.image(image.id(), rect, whole, Color32::WHITE);
            }
            paint_picture(&shown.picture, &upright(shown.page.view.size), rect, &painter);
        }
        if let Some(problem) = &self.problem {
            let align = eframe::egui::Align2::CENTER_CENTER;
            paint_note(&painter, rect.center(), align, problem, 13.0, Color::hex(0x80_80_80), order.ground);
        }
    }

    /// Asks for a picture, once; waits a little for it.
    fn ask(&mut self, page: Page, scene: &Scene, ctx: &Context) {
        if self.asked != Some(page) {
            let scene = match &self.scene {
                Some((version, scene)) if *version == page.version => scene.clone(),
                _ => Arc::new(scene.clone()),
            };
            self.scene = Some((page.version, scene.clone()));
            let worker = self.worker.get_or_insert_with(|| Worker::start(ctx.clone()));
            if worker.requests.send((scene, page)).is_err() {
                // The thread ended unexpectedly; the next frame starts another.
                self.worker = None;
                return;
            }
            self.asked = Some(page);
            self.take_answers(PATIENCE, ctx);
        }
    }

    fn take_answers(&mut self, patience: Duration, ctx: &Context) {
        let end = Instant::now() + patience;
        loop {
            let Some(worker) = &self.worker else { return };
            let left = end.saturating_duration_since(Instant::now());
            let Ok(drawn) = worker.answers.recv_timeout(left) else { return };
            let was_asked = self.asked == Some(drawn.page);
            self.take(drawn, ctx);
            if was_asked {
                return;
            }
        }
    }

    /// Waits until what was asked for is there.
    #[cfg(test)]
    pub(super) fn finish(&mut self, ctx: &Context) {
        while self.asked.is_some() && self.shown.as_ref().map(|shown| shown.page) != self.asked {
            self.take_answers(Duration::from_secs(60), ctx);
        }
    }

    fn take(&mut self, drawn: Drawn, ctx: &Context) {
        if self.last.is_some_and(|(page, _)| page.pixels_per_point <= drawn.page.pixels_per_point) {
            self.fine = drawn.took;
        }
        #[cfg(test)]
        {
            self.drawn += 1;
        }
        match drawn.result {
            Ok((pixels, picture)) => {
                let image = pixels.map(|pixels| match self.shown.take().and_then(|shown| shown.image) {
                    Some(mut image) => {
                        image.set(pixels, TextureOptions::LINEAR);
                        image
                    }
                    None => ctx.load_texture("scene", pixels, TextureOptions::LINEAR),
                });
                self.shown = Some(Shown { page: drawn.page, image, picture });
                self.problem = None;
            }
            Err(error) => self.problem = Some(error.to_string()),
        }
    }
}

impl Worker {
    /// A thread that draws the newest request until the view is gone.
    fn start(ctx: Context) -> Self {
        let (requests, orders) = channel::<(Arc<Scene>, Page)>();
        let (results, answers) = channel();
        std::thread::spawn(move || {
            while let Ok(mut order) = orders.recv() {
                while let Ok(newer) = orders.try_recv() {
                    order = newer;
                }
                let (scene, page) = order;
                let start = Instant::now();
                let result = draw(&scene, &page);
                if results.send(Drawn { page, result, took: start.elapsed() }).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        });
        Self { requests, answers }
    }
}

/// Surfaces (and lines, if there are many) as an image; the rest as a picture without ground.
fn draw(scene: &Scene, page: &Page) -> Result<(Option<ColorImage>, Picture), FigureError> {
    let paper = Paper { view: page.view, light: page.light, pixels_per_point: page.pixels_per_point };
    let segments: usize = scene
        .layers
        .iter()
        .flat_map(|layer| &layer.items)
        .map(|item| if let SceneItem::Line(line) = item { line.points().len() } else { 0 })
        .sum();
    let mut picture = if segments > MOST_VECTOR_SEGMENTS {
        let mut rest = scene.clone();
        for layer in &mut rest.layers {
            layer.items.retain(|item| !matches!(item, SceneItem::Line(_)));
        }
        let mut picture = paper.picture_with_image(&rest)?;
        picture.layers.retain(|layer| !layer.items.iter().any(|item| matches!(item, Item::Image(_))));
        let (low, high) = (DVec2::ZERO, page.view.size);
        let image = Arc::new(paper.image(scene)?);
        picture.push_layer("surfaces", vec![Item::Image(PlacedImage { low, high, image })]);
        picture
    } else {
        paper.picture_with_image(scene)?
    };
    picture.background = None;
    let mut image = None;
    for layer in &mut picture.layers {
        layer.items.retain(|item| match item {
            Item::Image(placed) => {
                image = Some(pixels(&placed.image));
                false
            }
            _ => true,
        });
    }
    Ok((image, picture))
}

fn pixels(image: &Image) -> ColorImage {
    ColorImage::from_rgba_unmultiplied([image.width() as usize, image.height() as usize], image.pixels())
}

#[cfg(test)]
pub(super) fn draw_for_tests(scene: &Scene, size: DVec2) -> (Option<ColorImage>, Picture) {
    let view = EyeView { eye: crate::figure::scene::Eye::default(), size };
    let light = crate::figure::theme::Theme::light().light;
    draw(scene, &Page { version: 0, view, light, ground: Color::hex(0xFF_FF_FF), pixels_per_point: 1.0 })
        .unwrap()
}
