//! A record for tests that drive the real window: where things are on the screen, line by line as they change.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;

use eframe::egui::{Context, Pos2};
use glam::DVec2;
use serde::Serialize;

use crate::app::lab::Lab;
use crate::app::workspace::{Room, Workspace};

/// Environment variable that names the file; without it nothing is written.
const VARIABLE: &str = "SPLINE_LAB_SMOKE_LOG";

/// Parameters at which a free place on the curve is looked for.
const SAMPLES: usize = 200;

/// Writes a JSON line whenever something that it tells has changed.
#[derive(Debug)]
pub(crate) struct SmokeLog {
    file: File,
    last: Option<Record>,
}

/// What a line tells besides its event. Places on the screen are in pixels of the window.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Record {
    room: &'static str,
    revision: u64,
    objects: usize,
    selected: Option<u64>,
    points: Vec<[f64; 2]>,
    world: Vec<[f64; 2]>,
    weights: Vec<f64>,
    knots: Vec<f64>,
    curve_at: Option<[f64; 2]>,
    handles: BTreeMap<String, [f64; 2]>,
    undo: Option<String>,
    redo: Option<String>,
    modified: bool,
    path: Option<PathBuf>,
    window: [f64; 2],
    #[serde(skip)]
    opened: u64,
    #[serde(skip)]
    saved: u64,
}

#[derive(Serialize)]
struct Line<'a> {
    event: &'static str,
    #[serde(flatten)]
    record: &'a Record,
}

impl SmokeLog {
    /// Starts the record that the environment asks for.
    pub(crate) fn from_environment() -> Option<Self> {
        let path = std::env::var_os(VARIABLE).filter(|path| !path.is_empty())?;
        Some(Self { file: File::create(path).ok()?, last: None })
    }

    /// Called at the end of every frame.
    pub(crate) fn frame(&mut self, lab: &Lab, workspace: &dyn Workspace, ctx: &Context) {
        let scale = f64::from(ctx.pixels_per_point());
        let pixel = |at: Pos2| [f64::from(at.x) * scale, f64::from(at.y) * scale];
        let handles: BTreeMap<String, [f64; 2]> =
            workspace.handles(lab).into_iter().map(|(name, at)| (name, pixel(at))).collect();
        let on_screen = |world: DVec2| workspace.screen_from_world(world, lab).map(pixel);
        let Some(record) = Record::of(lab, &on_screen, handles, ctx) else { return };
        let event = match &self.last {
            None => "ready",
            Some(last) if *last == record => return,
            Some(last) if last.saved != record.saved => "saved",
            Some(last) if last.opened != record.opened => "opened",
            Some(_) => "changed",
        };
        if let Ok(mut line) = serde_json::to_vec(&Line { event, record: &record }) {
            line.push(b'\n');
            // A record that cannot be written must not disturb the lab; whoever reads it will miss the line.
            let _ = self.file.write_all(&line);
        }
        self.last = Some(record);
    }
}

impl Record {
    fn of(
        lab: &Lab,
        pixel: &dyn Fn(DVec2) -> Option<[f64; 2]>,
        handles: BTreeMap<String, [f64; 2]>,
        ctx: &Context,
    ) -> Option<Self> {
        let scale = f64::from(ctx.pixels_per_point());
        let window = ctx.content_rect().size();
        // Nothing has been shown yet.
        if lab.room() == Room::Curves {
            pixel(DVec2::ZERO)?;
        }
        let world = lab.curve().map(|curve| curve.points().to_vec()).unwrap_or_default();
        Some(Self {
            room: lab.room().title(),
            revision: lab.history.revision(),
            objects: lab.history.document().len(),
            selected: lab.selection.object.map(|id| id.0),
            points: world.iter().filter_map(|&point| pixel(point)).collect(),
            world: world.iter().map(|point| point.to_array()).collect(),
            weights: lab.curve().map(|curve| curve.weights().to_vec()).unwrap_or_default(),
            knots: lab.curve().map(|curve| curve.space().knots().to_vec()).unwrap_or_default(),
            curve_at: free_place(lab, pixel),
            handles,
            undo: lab.history.undo_name().map(str::to_owned),
            redo: lab.history.redo_name().map(str::to_owned),
            modified: lab.is_modified(),
            path: lab.path.clone(),
            window: [f64::from(window.x) * scale, f64::from(window.y) * scale],
            opened: lab.shelf.opened,
            saved: lab.shelf.saved,
        })
    }
}

/// The sampled point of the selected curve that is farthest from all control points and knots.
fn free_place(lab: &Lab, pixel: &dyn Fn(DVec2) -> Option<[f64; 2]>) -> Option<[f64; 2]> {
    let curve = lab.curve()?;
    let space = curve.space();
    let (left, right) = space.parameter_interval();
    let on_screen = |world: DVec2| pixel(world).map(DVec2::from_array);
    let at = |t: f64| curve.evaluate(t).ok().and_then(on_screen);
    let knots =
        space.knots().iter().filter(|&&knot| left <= knot && knot <= right).filter_map(|&knot| at(knot));
    let handles: Vec<DVec2> =
        curve.points().iter().filter_map(|&point| on_screen(point)).chain(knots).collect();
    let distance =
        |place: DVec2| handles.iter().map(|&handle| handle.distance(place)).fold(f64::INFINITY, f64::min);
    (1..SAMPLES)
        .filter_map(|sample| at(left + (right - left) * sample as f64 / SAMPLES as f64))
        .map(|place| (distance(place), place))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, place)| place.to_array())
}
