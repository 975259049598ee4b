//! Reading an example of the specification so that no expected number can be overlooked.

use std::cell::RefCell;
use std::collections::BTreeSet;

use glam::DVec2;
use serde_json::Value;

/// One example, and which leaves of its `expect` have been compared.
pub(crate) struct Example {
    /// Its id, such as `4.5-a`.
    pub(crate) id: String,
    /// Its section, such as `4.5`.
    pub(crate) section: String,
    input: Value,
    expect: Value,
    relative: f64,
    absolute: f64,
    read: RefCell<BTreeSet<String>>,
    failures: RefCell<Vec<String>>,
}

/// A computed value: a number, a list of values, a word, or whether an inequality holds.
#[derive(Clone, Debug)]
pub(crate) enum Got {
    Number(f64),
    List(Vec<Self>),
    Word(String),
    Truth(bool),
}

impl From<bool> for Got {
    fn from(value: bool) -> Self {
        Self::Truth(value)
    }
}

impl From<f64> for Got {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<usize> for Got {
    fn from(value: usize) -> Self {
        Self::Number(value as f64)
    }
}

impl From<&str> for Got {
    fn from(value: &str) -> Self {
        Self::Word(value.to_owned())
    }
}

impl From<DVec2> for Got {
    fn from(value: DVec2) -> Self {
        Self::List(vec![value.x.into(), value.y.into()])
    }
}

impl From<(f64, f64)> for Got {
    fn from(value: (f64, f64)) -> Self {
        Self::List(vec![value.0.into(), value.1.into()])
    }
}

impl<T: Into<Self>> From<Vec<T>> for Got {
    fn from(values: Vec<T>) -> Self {
        Self::List(values.into_iter().map(Into::into).collect())
    }
}

impl<T: Into<Self> + Clone> From<&[T]> for Got {
    fn from(values: &[T]) -> Self {
        Self::List(values.iter().cloned().map(Into::into).collect())
    }
}

impl Example {
    /// The example in one entry of the file.
    pub(crate) fn new(entry: &Value) -> Self {
        let text = |key: &str| entry[key].as_str().unwrap_or_else(|| panic!("{entry}: no {key}")).to_owned();
        let tolerance = |key: &str| entry[key].as_f64().unwrap_or_else(|| panic!("{}: no {key}", text("id")));
        Self {
            id: text("id"),
            section: text("section"),
            input: entry["input"].clone(),
            expect: entry["expect"].clone(),
            relative: tolerance("relative_tolerance"),
            absolute: tolerance("absolute_tolerance"),
            read: RefCell::default(),
            failures: RefCell::default(),
        }
    }

    /// The input at `key`.
    pub(crate) fn input(&self, key: &str) -> &Value {
        self.input.get(key).unwrap_or_else(|| panic!("{}: no input {key}", self.id))
    }

    /// A number of the input.
    pub(crate) fn number(&self, key: &str) -> f64 {
        number(self.input(key)).unwrap_or_else(|| panic!("{}: {key} is no number", self.id))
    }

    /// A count of the input.
    pub(crate) fn count(&self, key: &str) -> usize {
        self.number(key) as usize
    }

    /// A list of numbers of the input.
    pub(crate) fn numbers(&self, key: &str) -> Vec<f64> {
        numbers(self.input(key))
    }

    /// A list of points of the plane of the input.
    pub(crate) fn points(&self, key: &str) -> Vec<DVec2> {
        lists(self.input(key)).into_iter().map(|row| DVec2::new(row[0], row[1])).collect()
    }

    /// A list of lists of numbers of the input.
    pub(crate) fn rows(&self, key: &str) -> Vec<Vec<f64>> {
        lists(self.input(key))
    }

    /// Compares what was computed with everything under `expect[key]`.
    pub(crate) fn expect(&self, key: &str, got: impl Into<Got>) {
        self.expect_at(&[key], got);
    }

    /// Compares with the part of `expect` that the keys, or the indices of lists, lead to; with all of it if there are none.
    pub(crate) fn expect_at(&self, keys: &[&str], got: impl Into<Got>) {
        let found = keys.iter().try_fold(&self.expect, |value, key| match value {
            Value::Array(list) => list.get(key.parse::<usize>().ok()?),
            _ => value.get(key),
        });
        let path: String = keys.iter().map(|key| format!("/{key}")).collect();
        match found {
            Some(wanted) => self.compare(&path, wanted, &got.into()),
            None => self.fail(format!("nothing is expected under {path}")),
        }
    }

    /// Compares the name of an error; `Ok` is a failure.
    pub(crate) fn expect_error<T>(&self, result: Result<T, &str>) {
        match result {
            Ok(_) => self.fail(format!("no error, expected {}", self.expect["error"])),
            Err(name) => self.expect("error", name),
        }
    }

    /// What is wrong: numbers that differ, and leaves that nothing has read.
    pub(crate) fn verdict(&self) -> Vec<String> {
        let mut leaves = Vec::new();
        collect_leaves(String::new(), &self.expect, &mut leaves);
        let read = self.read.borrow();
        let mut wrong = self.failures.borrow().clone();
        wrong.extend(
            leaves
                .iter()
                .filter(|leaf| !read.contains(*leaf))
                .map(|leaf| format!("{}: expect{leaf} is not asserted", self.id)),
        );
        wrong
    }

    fn compare(&self, path: &str, wanted: &Value, got: &Got) {
        match (wanted, got) {
            (Value::Array(wanted), Got::List(got)) => {
                if wanted.len() != got.len() {
                    self.fail(format!("{path}: {} entries, expected {}", got.len(), wanted.len()));
                }
                for (index, (wanted, got)) in wanted.iter().zip(got).enumerate() {
                    self.compare(&format!("{path}/{index}"), wanted, got);
                }
            }
            (Value::String(wanted), Got::Word(got)) => {
                self.read.borrow_mut().insert(path.to_owned());
                if wanted != got {
                    self.fail(format!("{path}: {got}, expected {wanted}"));
                }
            }
            (Value::Bool(wanted), Got::Truth(got)) => {
                self.read.borrow_mut().insert(path.to_owned());
                if wanted != got {
                    self.fail(format!("{path}: {got}, expected {wanted}"));
                }
            }
            (wanted, Got::Number(got)) => {
                self.read.borrow_mut().insert(path.to_owned());
                let Some(wanted) = number(wanted) else {
                    return self.fail(format!("{path}: {got} is compared with {wanted}"));
                };
                let exact = self.relative == 0.0 && self.absolute == 0.0;
                let near = (got - wanted).abs() <= self.relative * wanted.abs() + self.absolute;
                if if exact { got.to_bits() != wanted.to_bits() } else { !near } {
                    self.fail(format!("{path}: {got}, expected {wanted}"));
                }
            }
            (wanted, got) => self.fail(format!("{path}: {got:?} is compared with {wanted}")),
        }
    }

    fn fail(&self, what: String) {
        self.failures.borrow_mut().push(format!("{}: {what}", self.id));
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => match text.as_str() {
            "NaN" => Some(f64::NAN),
            "Infinity" => Some(f64::INFINITY),
            "-Infinity" => Some(f64::NEG_INFINITY),
            _ => None,
        },
        _ => None,
    }
}

/// The numbers of a list.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap_or_else(|| panic!("{value} is no list"));
    list.iter().map(|entry| number(entry).unwrap_or_else(|| panic!("{entry} is no number"))).collect()
}

/// The numbers of a list of lists.
pub(crate) fn lists(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().unwrap_or_else(|| panic!("{value} is no list")).iter().map(numbers).collect()
}

fn collect_leaves(path: String, value: &Value, leaves: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            for (index, entry) in list.iter().enumerate() {
                collect_leaves(format!("{path}/{index}"), entry, leaves);
            }
        }
        Value::Object(map) => {
            for (key, entry) in map {
                collect_leaves(format!("{path}/{key}"), entry, leaves);
            }
        }
        _ => leaves.push(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Example {
        Example::new(&serde_json::json!({
            "id": "0.0-a", "section": "0.0", "input": {}, "expect": {"a": [1.0, 2.0], "b": 3.0},
            "relative_tolerance": 1e-12, "absolute_tolerance": 0.0
        }))
    }

    #[test]
    fn a_leaf_that_nothing_reads_is_reported() {
        let example = sample();
        example.expect("a", vec![1.0, 2.0]);
        assert_eq!(example.verdict(), ["0.0-a: expect/b is not asserted"], "b was left out");
    }

    #[test]
    fn a_wrong_number_and_a_short_list_are_reported() {
        let example = sample();
        example.expect("a", vec![1.1]);
        example.expect("b", 3.0);
        assert_eq!(example.verdict().len(), 3, "{:?}", example.verdict());
    }
}
