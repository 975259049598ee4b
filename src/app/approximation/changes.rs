//! Changes of the selected approximation as edits with names.

use crate::app::lab::{Lab, Selection};
use crate::app::workspace::Room;
use crate::document::{Approximation, Content, DataError, Edit, KnotChoice, Method, ObjectId, Preset};
use crate::exchange::csv::Table;

/// The edit that puts `changed` into `object`.
pub(super) fn set(object: ObjectId, changed: Approximation, label: impl Into<String>) -> Edit {
    Edit::SetContent { object, content: Content::Approximation(changed), label: label.into() }
}

/// Changes the selected approximation as one step; says why if that is not possible.
pub(super) fn change(
    lab: &mut Lab,
    label: impl Into<String>,
    change: impl FnOnce(&Approximation) -> Result<Approximation, DataError>,
) -> bool {
    let Some((object, approximation)) = lab.selection.object.zip(lab.approximation()) else { return false };
    match change(approximation) {
        Ok(changed) => lab.edit(set(object, changed, label)).is_some(),
        Err(error) => {
            lab.problem(error.to_string());
            false
        }
    }
}

/// Changes one method of the selected approximation.
pub(super) fn change_method(lab: &mut Lab, index: usize, label: &str, edit: impl FnOnce(&mut Method)) {
    change(lab, label, |approximation| {
        let mut method = approximation
            .methods()
            .get(index)
            .cloned()
            .ok_or(DataError::NoSuchMethod { index, count: approximation.methods().len() })?;
        edit(&mut method);
        approximation.replacing_method(index, method)
    });
}

/// Adds an approximation, empty or prepared, selects it and goes to its room.
pub(crate) fn new_approximation(lab: &mut Lab, preset: Option<Preset>) {
    let name = preset.map_or("Approximation", Preset::title).to_owned();
    let content = Content::Approximation(preset.map_or_else(Approximation::new, Preset::build));
    add(lab, name, content);
}

fn add(lab: &mut Lab, name: String, content: Content) {
    let created = lab.edit(Edit::AddObject { name, content });
    if let Some(&created) = created.as_ref().and_then(|outcome| outcome.created.first()) {
        lab.selection = Selection { object: Some(created), ..Selection::default() };
        lab.enter(Room::Approximation);
    }
}

/// Takes a table as the data of the selected approximation, or of a new one.
pub(crate) fn take_table(lab: &mut Lab, table: Table, from: &str) {
    let count = table.sites.len();
    let Table { sites, values, weights } = table;
    if lab.room() == Room::Approximation && lab.approximation().is_some() {
        let taken = change(lab, "Import data", |approximation| {
            let changed = approximation.with_data(sites, values, weights)?;
            if changed.methods().is_empty() { changed.with_method(first_method()) } else { Ok(changed) }
        });
        if !taken {
            return;
        }
    } else {
        let made = Approximation::new().with_data(sites, values, weights);
        match made.and_then(|made| made.with_method(first_method())) {
            Ok(made) => add(lab, "Data".to_owned(), Content::Approximation(made)),
            Err(error) => {
                lab.problem(error.to_string());
                return;
            }
        }
    }
    lab.selection.points.clear();
    show_everything(lab);
    lab.done(format!("{count} data from {from}"));
}

fn first_method() -> Method {
    Method::new(crate::document::Scheme::Cubic { ends: crate::document::CubicEnds::NotAKnot }, 0)
}

/// Forgets the ranges of the plots, so that they are fitted.
pub(super) fn show_everything(lab: &mut Lab) {
    if let Some(object) = lab.selection.object {
        lab.view.plots.remove(&object);
    }
}

/// Replaces the data by `count` values of the function.
pub(super) fn sample(lab: &mut Lab, count: usize) {
    if change(lab, format!("Sample at {count} points"), |approximation| approximation.sampled(count)) {
        lab.selection.points.clear();
        show_everything(lab);
    }
}

/// The knots of method `index` as they can be changed, `all` of them as shown on its line.
pub(super) fn with_knots(
    approximation: &Approximation,
    index: usize,
    knots: Vec<f64>,
) -> Result<Approximation, DataError> {
    let count = approximation.methods().len();
    let mut method =
        approximation.methods().get(index).cloned().ok_or(DataError::NoSuchMethod { index, count })?;
    if let Some((degree, choice)) = method.scheme.space() {
        let choice: KnotChoice = choice.with(knots);
        method.scheme = method.scheme.with_space(degree, choice);
    }
    approximation.replacing_method(index, method)
}
