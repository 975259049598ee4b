//! Data in increasing order, a typed function, and the methods that approximate them, to be compared.

mod error;
mod method;
mod presets;

use std::sync::Arc;

use crate::core::formula::Formula;

pub use error::DataError;
pub use method::{CubicEnds, KnotChoice, MAX_DEGREE, Method, Scheme};
pub use presets::Preset;

/// The largest number of data, and of knots that are given with a method.
pub const MAX_DATA: usize = 100_000;
/// The largest number of methods.
pub const MAX_METHODS: usize = 16;
/// The longest formula in bytes.
const MAX_FORMULA: usize = 4000;

/// A function that somebody typed, with the interval where it is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct TypedFunction {
    formula: Formula,
    interval: (f64, f64),
}

impl TypedFunction {
    /// Reads `text` as a formula in `x` for the interval `[left, right]`.
    ///
    /// # Errors
    ///
    /// `Formula` with the position of the mistake, `TooMany` for a text beyond all sense, `NonFinite`, `EmptyInterval`.
    pub fn new(text: &str, left: f64, right: f64) -> Result<Self, DataError> {
        if text.len() > MAX_FORMULA {
            return Err(DataError::TooMany {
                what: "bytes of the formula",
                value: text.len(),
                limit: MAX_FORMULA,
            });
        }
        for (index, value) in [left, right].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(DataError::NonFinite { what: "end of the interval", index, value });
            }
        }
        // The length must be a number too.
        if !(left < right && (right - left).is_finite()) {
            return Err(DataError::EmptyInterval { left, right });
        }
        Ok(Self { formula: Formula::parse(text, &["x"])?, interval: (left, right) })
    }

    /// The text as typed.
    pub fn text(&self) -> &str {
        self.formula.text()
    }

    /// The interval.
    pub fn interval(&self) -> (f64, f64) {
        self.interval
    }

    /// `f(x)`; NaN where the function is not defined.
    pub fn value(&self, x: f64) -> f64 {
        self.formula.value(&[x])
    }
}

/// How the error is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ErrorPlot {
    /// Not at all.
    Hidden,
    /// With its sign.
    #[default]
    Linear,
    /// Its size on a logarithmic axis.
    Logarithmic,
}

/// Data `(xᵢ, yᵢ)` with `x₀ < x₁ < …`, weights if wanted, a function if wanted, and methods.
///
/// Copies share the data. All methods that change something give a changed copy.
#[derive(Clone, Debug, PartialEq)]
pub struct Approximation {
    sites: Arc<[f64]>,
    values: Arc<[f64]>,
    weights: Option<Arc<[f64]>>,
    function: Option<Arc<TypedFunction>>,
    methods: Vec<Method>,
    error_plot: ErrorPlot,
}

impl Default for Approximation {
    fn default() -> Self {
        Self {
            sites: Arc::new([]),
            values: Arc::new([]),
            weights: None,
            function: None,
            methods: Vec::new(),
            error_plot: ErrorPlot::default(),
        }
    }
}

impl Approximation {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The sites `xᵢ`, increasing.
    pub fn sites(&self) -> &[f64] {
        &self.sites
    }

    /// The values `yᵢ`.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The weights, if not all are 1.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The weight of datum `index`.
    pub fn weight(&self, index: usize) -> f64 {
        self.weights.as_ref().and_then(|weights| weights.get(index)).copied().unwrap_or(1.0)
    }

    /// The function, if there is one.
    pub fn function(&self) -> Option<&TypedFunction> {
        self.function.as_deref()
    }

    /// The methods.
    pub fn methods(&self) -> &[Method] {
        &self.methods
    }

    /// How the error is shown.
    pub fn error_plot(&self) -> ErrorPlot {
        self.error_plot
    }

    /// Number of data.
    pub fn len(&self) -> usize {
        self.sites.len()
    }

    /// Whether there are no data.
    pub fn is_empty(&self) -> bool {
        self.sites.is_empty()
    }

    /// Whether both have the same data and the same function, so that a method gives the same.
    pub fn has_same_data(&self, other: &Self) -> bool {
        let same = |a: &Arc<[f64]>, b: &Arc<[f64]>| Arc::ptr_eq(a, b) || a == b;
        same(&self.sites, &other.sites)
            && same(&self.values, &other.values)
            && self.weights == other.weights
            && self.function == other.function
    }

    /// The interval of the data; `None` for fewer than two.
    pub fn data_interval(&self) -> Option<(f64, f64)> {
        (self.len() >= 2).then(|| (self.sites[0], self.sites[self.len() - 1]))
    }

    /// The interval where the methods are looked at: that of the function and the data together.
    pub fn interval(&self) -> Option<(f64, f64)> {
        let data = self.sites.first().copied().zip(self.sites.last().copied());
        match (data, self.function().map(TypedFunction::interval)) {
            (Some((a, b)), Some((left, right))) => Some((a.min(left), b.max(right))),
            (data, function) => data.or(function),
        }
    }

    /// Other data.
    ///
    /// # Errors
    ///
    /// `SizeMismatch`, `NonFinite`, `NotIncreasing`, `WeightNotPositive` with the index, `TooMany`.
    pub fn with_data(
        &self,
        sites: Vec<f64>,
        values: Vec<f64>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, DataError> {
        error::check_data(&sites, &values, weights.as_deref())?;
        let weights = weights.filter(|weights| weights.iter().any(|weight| weight.to_bits() != ONE));
        Ok(Self {
            sites: sites.into(),
            values: values.into(),
            weights: weights.map(Into::into),
            ..self.clone()
        })
    }

    /// One datum more, and its index.
    ///
    /// # Errors
    ///
    /// As [`Self::with_data`]; `NotIncreasing` if there is one at this site.
    pub fn with_point(&self, x: f64, y: f64) -> Result<(Self, usize), DataError> {
        let index = self.sites.partition_point(|&site| site < x);
        let mut sites = self.sites.to_vec();
        let mut values = self.values.to_vec();
        let mut weights = self.weights.as_ref().map(|weights| weights.to_vec());
        sites.insert(index, x);
        values.insert(index, y);
        if let Some(weights) = &mut weights {
            weights.insert(index, 1.0);
        }
        Ok((self.with_data(sites, values, weights)?, index))
    }

    /// Some data moved by the same step.
    ///
    /// # Errors
    ///
    /// `NoSuchPoint`; as [`Self::with_data`], `NotIncreasing` if one would pass its neighbour.
    pub fn moved(&self, points: &[usize], by: (f64, f64)) -> Result<Self, DataError> {
        self.check_points(points)?;
        let (mut sites, mut values) = (self.sites.to_vec(), self.values.to_vec());
        for &point in points {
            sites[point] += by.0;
            values[point] += by.1;
        }
        self.with_data(sites, values, self.weights.as_ref().map(|weights| weights.to_vec()))
    }

    /// The part of `step` that the sites of `points`, without repetition and increasing, can go without reaching a neighbour.
    pub fn free_step(&self, points: &[usize], step: f64) -> f64 {
        let moves = |index: usize| points.binary_search(&index).is_ok();
        let room = points.iter().filter(|&&point| point < self.len()).filter_map(|&point| {
            let neighbour = if step < 0.0 { point.checked_sub(1)? } else { point + 1 };
            let site = *self.sites.get(neighbour)?;
            (!moves(neighbour)).then(|| (site - self.sites[point]).abs())
        });
        let least = room.fold(f64::INFINITY, f64::min);
        if step.abs() < least { step } else { step.signum() * least * (1.0 - 1e-3) }
    }

    /// Datum `point` put elsewhere.
    ///
    /// # Errors
    ///
    /// As [`Self::moved`].
    pub fn with_point_at(&self, point: usize, x: f64, y: f64) -> Result<Self, DataError> {
        self.check_points(&[point])?;
        let (mut sites, mut values) = (self.sites.to_vec(), self.values.to_vec());
        (sites[point], values[point]) = (x, y);
        self.with_data(sites, values, self.weights.as_ref().map(|weights| weights.to_vec()))
    }

    /// Another weight of some data.
    ///
    /// # Errors
    ///
    /// `NoSuchPoint`, `WeightNotPositive`, `NonFinite`.
    pub fn with_weight(&self, points: &[usize], weight: f64) -> Result<Self, DataError> {
        self.check_points(points)?;
        let mut weights = self.weights.as_ref().map_or_else(|| vec![1.0; self.len()], |old| old.to_vec());
        for &point in points {
            weights[point] = weight;
        }
        self.with_data(self.sites.to_vec(), self.values.to_vec(), Some(weights))
    }

    /// Without some of the data.
    ///
    /// # Errors
    ///
    /// `NoSuchPoint`.
    pub fn without_points(&self, points: &[usize]) -> Result<Self, DataError> {
        self.check_points(points)?;
        let mut stays = vec![true; self.len()];
        for &point in points {
            stays[point] = false;
        }
        let kept = |numbers: &[f64]| -> Vec<f64> {
            numbers.iter().zip(&stays).filter(|(_, stays)| **stays).map(|(&number, _)| number).collect()
        };
        self.with_data(kept(&self.sites), kept(&self.values), self.weights().map(kept))
    }

    /// Another function, or none.
    #[must_use]
    pub fn with_function(&self, function: Option<TypedFunction>) -> Self {
        Self { function: function.map(Arc::new), ..self.clone() }
    }

    /// Data from the function, at `count` equidistant sites of its interval.
    ///
    /// # Errors
    ///
    /// `NoFunction`; `TooFew` for fewer than two; as [`Self::with_data`], `NonFinite` where the function is undefined.
    pub fn sampled(&self, count: usize) -> Result<Self, DataError> {
        let function = self.function.as_ref().ok_or(DataError::NoFunction)?;
        if count < 2 {
            return Err(DataError::TooFew { what: "samples", value: count, least: 2 });
        }
        if count > MAX_DATA {
            return Err(DataError::TooMany { what: "data", value: count, limit: MAX_DATA });
        }
        let (left, right) = function.interval();
        let last = (count - 1) as f64;
        let sites: Vec<f64> = (0..count)
            .map(|i| if i + 1 == count { right } else { left + (right - left) * (i as f64 / last) })
            .collect();
        let values = sites.iter().map(|&x| function.value(x)).collect();
        self.with_data(sites, values, None)
    }

    /// One method more, the last.
    ///
    /// # Errors
    ///
    /// Those of [`Method::check`], `TooMany`.
    pub fn with_method(&self, method: Method) -> Result<Self, DataError> {
        method.check()?;
        if self.methods.len() >= MAX_METHODS {
            return Err(DataError::TooMany {
                what: "methods",
                value: self.methods.len() + 1,
                limit: MAX_METHODS,
            });
        }
        let mut changed = self.clone();
        changed.methods.push(method);
        Ok(changed)
    }

    /// Another method in place of number `index`.
    ///
    /// # Errors
    ///
    /// Those of [`Method::check`], `NoSuchMethod`.
    pub fn replacing_method(&self, index: usize, method: Method) -> Result<Self, DataError> {
        method.check()?;
        self.check_method(index)?;
        let mut changed = self.clone();
        changed.methods[index] = method;
        Ok(changed)
    }

    /// Without method number `index`.
    ///
    /// # Errors
    ///
    /// `NoSuchMethod`.
    pub fn without_method(&self, index: usize) -> Result<Self, DataError> {
        self.check_method(index)?;
        let mut changed = self.clone();
        changed.methods.remove(index);
        Ok(changed)
    }

    /// Another way to show the error.
    #[must_use]
    pub fn with_error_plot(&self, error_plot: ErrorPlot) -> Self {
        Self { error_plot, ..self.clone() }
    }

    /// The colour index for the next method: the first that no method has.
    pub fn free_color(&self) -> usize {
        (0..).find(|color| self.methods.iter().all(|method| method.color != *color)).unwrap_or(0)
    }

    /// Smallest and largest numbers of the data.
    pub fn data_box(&self) -> Option<((f64, f64), (f64, f64))> {
        let (&low, &high) = self.sites.first().zip(self.sites.last())?;
        let y = self.values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
        Some(((low, high), y))
    }

    /// What it is in half a line.
    pub fn summary(&self) -> String {
        let counted = |count: usize, one: &str, more: &str| match count {
            0 => format!("no {more}"),
            1 => format!("1 {one}"),
            _ => format!("{count} {more}"),
        };
        format!(
            "approximation, {}, {}",
            counted(self.len(), "datum", "data"),
            counted(self.methods.len(), "method", "methods")
        )
    }

    /// Estimated memory in bytes.
    pub(in crate::document) fn byte_size(&self) -> usize {
        let numbers = self.len() * if self.weights.is_some() { 3 } else { 2 };
        let knots: usize = self.methods.iter().map(|method| method.knots().len() + 16).sum();
        let text = self.function.as_ref().map_or(0, |function| 40 * function.text().len());
        (numbers + knots) * size_of::<f64>() + text
    }

    fn check_points(&self, points: &[usize]) -> Result<(), DataError> {
        match points.iter().find(|&&point| point >= self.len()) {
            Some(&index) => Err(DataError::NoSuchPoint { index, count: self.len() }),
            None => Ok(()),
        }
    }

    fn check_method(&self, index: usize) -> Result<(), DataError> {
        let count = self.methods.len();
        if index < count { Ok(()) } else { Err(DataError::NoSuchMethod { index, count }) }
    }
}

/// Bits of the weight that need not be written.
const ONE: u64 = 1.0_f64.to_bits();

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;

    fn three() -> Approximation {
        Approximation::new().with_data(vec![0.0, 1.0, 3.0], vec![2.0, 4.0, 8.0], None).unwrap()
    }

    #[test]
    fn data_that_are_none_are_refused_with_the_place() {
        let empty = Approximation::new();
        let name = |x: &[f64], y: &[f64], w: Option<Vec<f64>>| {
            empty.with_data(x.to_vec(), y.to_vec(), w).unwrap_err()
        };
        assert_eq!(
            name(&[0.0, 2.0, 2.0], &[0.0; 3], None),
            DataError::NotIncreasing { index: 2, value: 2.0, previous: 2.0 },
            "equal sites"
        );
        assert!(
            matches!(name(&[0.0, f64::NAN], &[0.0; 2], None), DataError::NonFinite { index: 1, .. }),
            "NaN"
        );
        assert!(matches!(name(&[0.0], &[], None), DataError::SizeMismatch { .. }), "lengths");
        assert!(
            matches!(
                name(&[0.0, 1.0], &[0.0; 2], Some(vec![1.0, 0.0])),
                DataError::WeightNotPositive { index: 1, .. }
            ),
            "weight"
        );
        let many = vec![0.0; MAX_DATA + 1];
        assert!(matches!(name(&many, &many, None), DataError::TooMany { .. }), "too many");
    }

    #[test]
    fn a_point_finds_its_place_and_leaves_again() {
        let (more, index) = three().with_point(2.0, 5.0).unwrap();
        assert_eq!((index, more.sites()), (2, [0.0, 1.0, 2.0, 3.0].as_slice()), "in order");
        assert_eq!(more.without_points(&[2]).unwrap(), three(), "and back");
        assert!(three().with_point(1.0, 0.0).is_err(), "there is one at 1");
    }

    #[test]
    fn a_datum_does_not_pass_its_neighbour() {
        let data = three();
        assert_eq!(data.free_step(&[1], 0.5), 0.5, "there is room");
        let step = data.free_step(&[1], 7.0);
        assert!(step < 2.0 && step > 1.9, "up to 3: {step}");
        assert_eq!(data.free_step(&[1, 2], 7.0), 7.0, "the last ones together");
        assert!(data.moved(&[1], (7.0, 0.0)).is_err(), "beyond the neighbour");
        assert!(data.moved(&[1], (step, 0.0)).is_ok(), "as far as there is room");
    }

    #[test]
    fn samples_reach_both_ends_exactly_and_say_where_there_is_no_value() {
        let function = TypedFunction::new("sqrt(x)", -1.0, 0.7).unwrap();
        let data = Approximation::new().with_function(Some(function));
        assert!(matches!(data.sampled(5), Err(DataError::NonFinite { index: 0, .. })), "no root at -1");
        let function = TypedFunction::new("x^2", 0.1, 0.7).unwrap();
        let data = data.with_function(Some(function)).sampled(8).unwrap();
        assert_eq!((data.sites()[0], data.sites()[7]), (0.1, 0.7), "ends");
        assert!(TypedFunction::new("x+", 0.0, 1.0).is_err(), "no formula");
        assert!(TypedFunction::new("x", 1.0, 1.0).is_err(), "no interval");
    }
}
