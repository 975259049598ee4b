//! The record of an approximation:
//!
//! ```text
//! {"points": [[x, y], …], "weights": […] (unless all are 1), "function": {"formula": "sin(x)", "interval": [0, 1]} (if there is one),
//!  "methods": [{"scheme": {"kind": "smoothing", "sigma": 0.1}, "color": 0, "visible": true}, …], "error_plot": "linear"}
//! ```

use serde::Deserialize;
use serde_json::json;

use crate::document::approximation::{
    Approximation, DataError, ErrorPlot, MAX_DATA, MAX_METHODS, Method, TypedFunction,
};
use crate::document::file_error::FileError;
use crate::document::json::entry;
use crate::document::json::writer::Node;
use crate::document::object::Content;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ApproximationRecord {
    points: Vec<[f64; 2]>,
    #[serde(default)]
    weights: Option<Vec<f64>>,
    #[serde(default)]
    function: Option<FunctionRecord>,
    methods: Vec<Method>,
    #[serde(default)]
    error_plot: ErrorPlot,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FunctionRecord {
    formula: String,
    interval: [f64; 2],
}

pub(super) fn node(approximation: &Approximation) -> Node {
    let points = approximation.sites().iter().zip(approximation.values());
    let points = points.map(|(x, y)| Node::from(json!([x, y]))).collect();
    let mut entries = vec![("points".to_owned(), Node::List(points))];
    entries.extend(approximation.weights().map(|weights| entry("weights", json!(weights))));
    entries.extend(approximation.function().map(|function| {
        let (left, right) = function.interval();
        entry("function", json!({ "formula": function.text(), "interval": [left, right] }))
    }));
    let methods = approximation.methods().iter().map(|method| Node::from(json!(method))).collect();
    entries.push(("methods".to_owned(), Node::List(methods)));
    entries.push(entry("error_plot", json!(approximation.error_plot())));
    Node::Record(entries)
}

impl ApproximationRecord {
    pub(super) fn content(self, place: &str) -> Result<Content, FileError> {
        let at = |field: &str, error: DataError| FileError::value(format!("{place}.{field}"), error);
        for (field, what, value, limit) in [
            ("points", "data", self.points.len(), MAX_DATA),
            ("methods", "methods", self.methods.len(), MAX_METHODS),
        ] {
            if value > limit {
                return Err(at(field, DataError::TooMany { what, value, limit }));
            }
        }
        let (sites, values) = self.points.into_iter().map(|[x, y]| (x, y)).unzip();
        let mut all = Approximation::new().with_data(sites, values, self.weights).map_err(|error| {
            let field = match &error {
                DataError::NonFinite { what: "weight", index, .. }
                | DataError::WeightNotPositive { index, .. } => format!("weights[{index}]"),
                DataError::SizeMismatch { .. } => "weights".to_owned(),
                DataError::NonFinite { index, .. } | DataError::NotIncreasing { index, .. } => {
                    format!("points[{index}]")
                }
                _ => "points".to_owned(),
            };
            at(&field, error)
        })?;
        if let Some(FunctionRecord { formula, interval: [left, right] }) = self.function {
            let function = TypedFunction::new(&formula, left, right).map_err(|error| {
                let field = match error {
                    DataError::Formula(_) | DataError::TooMany { .. } => "function.formula",
                    _ => "function.interval",
                };
                at(field, error)
            })?;
            all = all.with_function(Some(function));
        }
        for (index, method) in self.methods.into_iter().enumerate() {
            all = all.with_method(method).map_err(|error| at(&format!("methods[{index}]"), error))?;
        }
        Ok(Content::Approximation(all.with_error_plot(self.error_plot)))
    }
}
