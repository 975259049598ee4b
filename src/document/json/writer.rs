//! JSON that people can read and compare line by line: records over several lines, lists of numbers in one, lists of points
//! with one point a line.

use std::fmt::Write as _;

use serde_json::Value;

/// A JSON value whose records keep their order.
#[derive(Clone, Debug)]
pub(in crate::document) enum Node {
    /// A value as `serde_json` writes it: numbers in the shortest form that reads back as the same number.
    Leaf(Value),
    /// `[…]`
    List(Vec<Self>),
    /// `{…}`
    Record(Vec<(String, Self)>),
}

impl Node {
    /// The whole text, ending with a line break.
    pub(in crate::document) fn to_text(&self) -> String {
        let mut text = String::new();
        self.write(0, &mut text);
        text.push('\n');
        text
    }

    fn write(&self, depth: usize, text: &mut String) {
        match self {
            Self::Leaf(value) => {
                // Writing into a string cannot fail.
                let _ = write!(text, "{value}");
            }
            Self::List(items) => {
                let flat = items.iter().all(|item| matches!(item, Self::Leaf(_)));
                text.push('[');
                for (index, item) in items.iter().enumerate() {
                    separate(index, flat, depth, text);
                    item.write(depth + 1, text);
                }
                close(flat || items.is_empty(), depth, ']', text);
            }
            Self::Record(entries) => {
                text.push('{');
                for (index, (key, value)) in entries.iter().enumerate() {
                    separate(index, false, depth, text);
                    let _ = write!(text, "{}: ", Value::from(key.as_str()));
                    value.write(depth + 1, text);
                }
                close(entries.is_empty(), depth, '}', text);
            }
        }
    }
}

impl From<Value> for Node {
    fn from(value: Value) -> Self {
        match value {
            Value::Array(items) => Self::List(items.into_iter().map(Self::from).collect()),
            Value::Object(entries) => {
                Self::Record(entries.into_iter().map(|(key, value)| (key, Self::from(value))).collect())
            }
            leaf => Self::Leaf(leaf),
        }
    }
}

fn separate(index: usize, flat: bool, depth: usize, text: &mut String) {
    if index > 0 {
        text.push(',');
    }
    match (flat, index) {
        (true, 0) => {}
        (true, _) => text.push(' '),
        (false, _) => new_line(depth + 1, text),
    }
}

fn close(flat: bool, depth: usize, bracket: char, text: &mut String) {
    if !flat {
        new_line(depth, text);
    }
    text.push(bracket);
}

fn new_line(depth: usize, text: &mut String) {
    text.push('\n');
    text.extend(std::iter::repeat_n("  ", depth));
}
