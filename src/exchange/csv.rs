//! Tables of data: two columns x and y, or three with weights.
//!
//! Columns are separated by commas, semicolons, tabs or spaces; whatever stands in the first line with numbers decides. Between semicolons and tabs
//! a comma is a decimal sign. Empty lines and lines that begin with `#` are passed over, and one line of titles at the top.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::document::MAX_DATA;

/// Largest file that is read, in bytes.
const MAX_BYTES: u64 = 64 << 20;
/// Characters of a field that a message repeats.
const REPEATED: usize = 40;

/// A table, valid as data of an approximation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The first column, increasing.
    pub sites: Vec<f64>,
    /// The second column.
    pub values: Vec<f64>,
    /// The third column, if there is one.
    pub weights: Option<Vec<f64>>,
}

/// What is wrong with a table. Lines count from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CsvError {
    /// The file cannot be read.
    #[error("{path}: {message}")]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        message: String,
    },
    /// The file is too large.
    #[error("{path}: the file has {bytes} bytes, more than the limit {MAX_BYTES}")]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// The bytes are no text.
    #[error("line {line}: this is no text in UTF-8")]
    NotText {
        /// The line.
        line: u64,
    },
    /// There is no line with numbers.
    #[error("there are no numbers in this table")]
    Empty,
    /// A line has another number of columns.
    #[error("line {line}: {found} columns; {expected}")]
    Columns {
        /// The line.
        line: u64,
        /// How many it has.
        found: usize,
        /// What was expected, in words.
        expected: String,
    },
    /// A field is no number.
    #[error("line {line}, column {column}: {text:?} is not a number")]
    NotANumber {
        /// The line.
        line: u64,
        /// The column, from 1.
        column: usize,
        /// What stands there.
        text: String,
    },
    /// A number is infinite or not a number.
    #[error("line {line}, column {column}: {text} is not finite")]
    NotFinite {
        /// The line.
        line: u64,
        /// The column, from 1.
        column: usize,
        /// What stands there.
        text: String,
    },
    /// The first column does not increase.
    #[error("line {line}: x is {value}, not above {previous} in line {before}")]
    NotIncreasing {
        /// The line.
        line: u64,
        /// Its x.
        value: f64,
        /// The x before.
        previous: f64,
        /// The line of that.
        before: u64,
    },
    /// A weight is not positive.
    #[error("line {line}: the weight is {value}; weights must be positive")]
    WeightNotPositive {
        /// The line.
        line: u64,
        /// The weight.
        value: f64,
    },
    /// There are too many lines.
    #[error("line {line}: more than {MAX_DATA} data")]
    TooMany {
        /// The first line too many.
        line: u64,
    },
}

impl CsvError {
    /// The name of the error.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Io { .. } => "Io",
            Self::TooLarge { .. } => "TooLarge",
            Self::NotText { .. } => "NotText",
            Self::Empty => "Empty",
            Self::Columns { .. } => "Columns",
            Self::NotANumber { .. } => "NotANumber",
            Self::NotFinite { .. } => "NotFinite",
            Self::NotIncreasing { .. } => "NotIncreasing",
            Self::WeightNotPositive { .. } => "WeightNotPositive",
            Self::TooMany { .. } => "TooMany",
        }
    }
}

/// Reads the table in a file.
///
/// # Errors
///
/// [`CsvError`] with the line and what stands there.
pub fn read_csv_file(path: &Path) -> Result<Table, CsvError> {
    let said = |error: std::io::Error| CsvError::Io { path: path.to_owned(), message: error.to_string() };
    let file = File::open(path).map_err(said)?;
    let bytes = file.metadata().map_err(said)?.len();
    if bytes > MAX_BYTES {
        return Err(CsvError::TooLarge { path: path.to_owned(), bytes });
    }
    let mut content = Vec::new();
    // The limit holds too for a file that grows while it is read.
    file.take(MAX_BYTES).read_to_end(&mut content).map_err(said)?;
    match std::str::from_utf8(&content) {
        Ok(text) => read_csv(text),
        Err(error) => {
            let before = content[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
            Err(CsvError::NotText { line: before as u64 + 1 })
        }
    }
}

/// Reads a table.
///
/// # Errors
///
/// [`CsvError`] with the line and what stands there.
pub fn read_csv(text: &str) -> Result<Table, CsvError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let separator = Separator::of(text);
    let mut reader = Reader::new(separator);
    // Spaces in a row are one separator, which is not what a reader of comma separated values takes them for.
    if separator == Separator::Spaces {
        for (index, line) in text.lines().enumerate() {
            if !line.trim_start().starts_with('#') {
                let fields: Vec<&str> = line.split_whitespace().collect();
                reader.line(index as u64 + 1, &fields)?;
            }
        }
        return reader.finish();
    }
    let mut records = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(separator.byte())
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let mut record = csv::StringRecord::new();
    // The text is valid, so that reading cannot fail.
    while records.read_record(&mut record).unwrap_or(false) {
        let line = record.position().map_or(0, |start| line_of_record(text, start));
        let fields: Vec<&str> = record.iter().take(5).collect();
        reader.line(line, &fields)?;
    }
    reader.finish()
}

/// The line of the record that is read from `start` on: empty lines and comments before it are passed over.
fn line_of_record(text: &str, start: &csv::Position) -> u64 {
    let rest = usize::try_from(start.byte()).ok().and_then(|byte| text.get(byte..)).unwrap_or_default();
    let passed = rest.lines().take_while(|line| line.is_empty() || line.starts_with('#')).count();
    start.line() + passed as u64
}

/// Writes a table: a line of titles, then a line for each datum; commas separate, points are decimal signs, and reading gives the same numbers.
pub fn write_csv(sites: &[f64], values: &[f64], weights: Option<&[f64]>) -> String {
    let mut text = String::from(if weights.is_some() { "x,y,weight\n" } else { "x,y\n" });
    for (index, (x, y)) in sites.iter().zip(values).enumerate() {
        text.push_str(&format!("{x:?},{y:?}"));
        if let Some(weight) = weights.and_then(|weights| weights.get(index)) {
            text.push_str(&format!(",{weight:?}"));
        }
        text.push('\n');
    }
    text
}

/// What stands between columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Separator {
    Comma,
    Semicolon,
    Tab,
    Spaces,
}

impl Separator {
    /// That of the first line with digits.
    fn of(text: &str) -> Self {
        let has_data = |line: &&str| line.contains(|c: char| c.is_ascii_digit()) && !line.starts_with('#');
        let line = text.lines().find(has_data).unwrap_or_default().trim();
        match line {
            _ if line.contains(';') => Self::Semicolon,
            _ if line.contains('\t') => Self::Tab,
            _ if line.contains(',') && !line.contains(' ') => Self::Comma,
            // `1,5 2,5` has decimal commas, `1, 2` has not.
            _ if line.contains(", ") || line.contains(" ,") => Self::Comma,
            _ => Self::Spaces,
        }
    }

    fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Spaces => b' ',
        }
    }
}

/// Takes lines one after the other.
struct Reader {
    separator: Separator,
    table: Table,
    columns: usize,
    /// Whether a line of titles may still come.
    at_top: bool,
    last_line: u64,
}

impl Reader {
    fn new(separator: Separator) -> Self {
        Self { separator, table: Table::default(), columns: 0, at_top: true, last_line: 0 }
    }

    fn line(&mut self, line: u64, fields: &[&str]) -> Result<(), CsvError> {
        // Programs for tables leave separators at the end of a line.
        let filled = fields.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1);
        let fields = &fields[..filled];
        if fields.is_empty() {
            return Ok(());
        }
        let is_title = |field: &&str| !field.contains(|c: char| c.is_ascii_digit()) && !is_special(field);
        if std::mem::take(&mut self.at_top) && fields.iter().all(is_title) {
            return Ok(());
        }
        if self.columns == 0 {
            self.columns = fields.len();
        }
        if !(2..=3).contains(&fields.len()) || fields.len() != self.columns {
            let expected = if (2..=3).contains(&self.columns) {
                format!("the lines before have {}", self.columns)
            } else {
                "x and y, or x, y and weight, are needed".to_owned()
            };
            return Err(CsvError::Columns { line, found: fields.len(), expected });
        }
        let mut numbers = [0.0; 3];
        for (column, field) in fields.iter().enumerate() {
            numbers[column] = self.number(line, column + 1, field)?;
        }
        if self.table.sites.len() >= MAX_DATA {
            return Err(CsvError::TooMany { line });
        }
        let [value, y, weight] = numbers;
        if let Some(&previous) = self.table.sites.last()
            && value <= previous
        {
            return Err(CsvError::NotIncreasing { line, value, previous, before: self.last_line });
        }
        if fields.len() == 3 {
            if weight <= 0.0 {
                return Err(CsvError::WeightNotPositive { line, value: weight });
            }
            self.table.weights.get_or_insert_default().push(weight);
        }
        self.table.sites.push(value);
        self.table.values.push(y);
        self.last_line = line;
        Ok(())
    }

    fn number(&self, line: u64, column: usize, field: &str) -> Result<f64, CsvError> {
        let shown = || field.chars().take(REPEATED).collect::<String>();
        let mut text = field.replace('\u{2212}', "-");
        if self.separator != Separator::Comma && text.matches(',').count() == 1 && !text.contains('.') {
            text = text.replace(',', ".");
        }
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(CsvError::NotFinite { line, column, text: shown() }),
            Err(_) => Err(CsvError::NotANumber { line, column, text: shown() }),
        }
    }

    fn finish(self) -> Result<Table, CsvError> {
        if self.table.sites.is_empty() { Err(CsvError::Empty) } else { Ok(self.table) }
    }
}

/// Whether a field without digits is meant as a number all the same.
fn is_special(field: &str) -> bool {
    field.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;

    #[test]
    fn the_same_table_in_every_dress() {
        let wanted = Table { sites: vec![0.5, 1.0, 20.0], values: vec![-1.5, 2.0, 1e-3], weights: None };
        for text in [
            "0.5,-1.5\n1,2\n20,1e-3\n",
            "x,y\r\n0.5,-1.5\r\n1,2\r\n20,1e-3",
            "\u{feff}time; height\n0,5; -1,5\n1; 2\n20; 0,001\n",
            "0.5\t-1.5\n1\t2\n\n20\t1e-3\n",
            "x\ty\n0,5\t\u{2212}1,5\n1\t2\n20\t0,001",
            "# measured\n0.5, -1.5\n1, 2\n20, 1e-3\n",
            "  0.5   -1.5\n 1 2\n20 1e-3",
            "0,5 -1,5\n1 2\n20 0,001",
            "\"x\",\"y\"\n\"0.5\",\"-1.5\"\n1,2,\n20,1e-3,\n",
        ] {
            assert_eq!(read_csv(text), Ok(wanted.clone()), "{text:?}");
        }
        let weighted = read_csv("x;y;w\n1;2;0,5\n2;3;4").unwrap();
        assert_eq!(weighted.weights, Some(vec![0.5, 4.0]), "weights");
    }

    #[test]
    fn mistakes_are_named_with_their_line() {
        for (text, said) in [
            ("", "there are no numbers in this table"),
            ("x,y\n", "there are no numbers in this table"),
            ("1,2\n2,a\n", "line 2, column 2: \"a\" is not a number"),
            ("x,y\n1,2\n\n1,3\n", "line 4: x is 1, not above 1 in line 2"),
            ("3,2\n1,3\n", "line 2: x is 1, not above 3 in line 1"),
            ("1,2\n2,NaN\n", "line 2, column 2: NaN is not finite"),
            ("1,inf\n", "line 1, column 2: inf is not finite"),
            ("1,1e999\n", "line 1, column 2: 1e999 is not finite"),
            ("1,2\n2,3,4\n", "line 2: 3 columns; the lines before have 2"),
            ("1\n2\n", "line 1: 1 columns; x and y, or x, y and weight, are needed"),
            ("1,2,3,4\n", "line 1: 4 columns; x and y, or x, y and weight, are needed"),
            ("1,2,0\n", "line 1: the weight is 0; weights must be positive"),
            ("1,,2\n", "line 1, column 2: \"\" is not a number"),
            ("a,b\nc,d\n1,2", "line 2, column 1: \"c\" is not a number"),
        ] {
            assert_eq!(read_csv(text).map_err(|error| error.to_string()), Err(said.to_owned()), "{text:?}");
        }
        let many: String = (0..=MAX_DATA).map(|i| format!("{i},0\n")).collect();
        assert_eq!(read_csv(&many), Err(CsvError::TooMany { line: MAX_DATA as u64 + 1 }), "too many");
    }

    #[test]
    fn what_is_written_reads_back_as_the_same_numbers() {
        let table = Table {
            sites: vec![-1e300, 0.1, 1.0 / 3.0, 5e15],
            values: vec![5e-324, -0.0, 2.0, f64::MAX],
            weights: Some(vec![1.0, 0.25, 3.0, 1e-9]),
        };
        let text = write_csv(&table.sites, &table.values, table.weights.as_deref());
        assert_eq!(read_csv(&text), Ok(table), "{text}");
    }

    #[test]
    fn files_that_are_no_text_or_not_there_say_so() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("data.csv");
        assert_eq!(read_csv_file(&path).unwrap_err().name(), "Io", "not there");
        std::fs::write(&path, b"1,2\n2,\xff\n").unwrap();
        assert_eq!(read_csv_file(&path), Err(CsvError::NotText { line: 2 }), "no UTF-8");
    }

    proptest::proptest! {
        #[test]
        fn no_text_makes_the_reader_panic(text in "[0-9a-z,;\\t\\n\\r \"#.+-]{0,80}") {
            let _ = read_csv(&text);
        }
    }
}
