//! The examples of the specification, asserted by id: every expected number of every section built so far.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod beyond_conics;
mod beyond_curves;
mod beyond_fitting;
mod beyond_intersections;
mod beyond_length;
mod beyond_measure;
mod chapter1;
mod chapter2;
mod chapter3;
mod chapter4;
mod chapter5;
mod chapter6;
mod chapter7;
mod chapter8;
mod chapter9;
mod chapter9_isogeometric;
mod example;

use std::collections::BTreeMap;
use std::io::Write as _;

use example::Example;

/// The sections built so far. An example of one of them without a test is a failure; of sections built in part, such as 9.5,
/// only the examples with a test are asserted.
const SECTIONS: [&str; 48] = [
    "1.4", "1.5", "2.1", "2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "3.1", "3.2", "3.3", "3.4", "4.1", "4.2",
    "4.3", "4.4", "4.5", "4.6", "5.1", "5.5", "5.6", "6.1", "6.2", "6.3", "6.4", "7.3", "7.4", "8.2", "8.3",
    "9.1", "9.2", "9.3", "9.4", "B.1", "B.2", "B.3", "B.4", "B.5", "B.6", "B.7", "B.8", "B.9", "B.11",
    "B.12", "B.14", "B.15", "B.16",
];

/// What computes an example and compares.
type Check = fn(&Example);

#[test]
fn every_example_of_the_sections_built_is_asserted() {
    let files = [include_str!("../data/examples.json"), include_str!("../data/examples_beyond.json")];
    let examples: Vec<Example> = files
        .iter()
        .flat_map(|text| serde_json::from_str::<Vec<serde_json::Value>>(text).expect("the file is a list"))
        .map(|entry| Example::new(&entry))
        .collect();
    let checks: BTreeMap<&str, Check> = [
        chapter1::CHECKS,
        beyond_curves::CHECKS,
        beyond_fitting::CHECKS,
        beyond_intersections::CHECKS,
        beyond_length::CHECKS,
        beyond_measure::CHECKS,
        chapter2::CHECKS,
        chapter3::CHECKS,
        beyond_conics::CHECKS,
        chapter4::CHECKS,
        chapter5::CHECKS,
        chapter6::CHECKS,
        chapter7::CHECKS,
        chapter8::CHECKS,
        chapter9::CHECKS,
        chapter9_isogeometric::CHECKS,
    ]
    .concat()
    .into_iter()
    .collect();
    let mut wrong = Vec::new();
    for id in checks.keys() {
        if !examples.iter().any(|example| example.id == *id) {
            wrong.push(format!("{id}: there is a test but no such example"));
        }
    }
    let mut asserted = 0;
    for example in &examples {
        let Some(check) = checks.get(example.id.as_str()) else {
            if SECTIONS.contains(&example.section.as_str()) {
                wrong.push(format!("{}: no test", example.id));
            }
            continue;
        };
        check(example);
        let verdict = example.verdict();
        asserted += usize::from(verdict.is_empty());
        wrong.extend(verdict);
    }
    // Written past the test harness, which would keep it to itself.
    let line = format!("spec examples: {asserted} asserted of {}\n", examples.len());
    std::io::stdout().write_all(line.as_bytes()).expect("standard output takes a line");
    assert!(wrong.is_empty(), "{} faults:\n{}", wrong.len(), wrong.join("\n"));
}
