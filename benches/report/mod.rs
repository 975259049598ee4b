//! One JSON line per measurement: median, fastest run, and how. The numbers that other libraries were measured with.

#![allow(clippy::print_stdout, reason = "the lines are what a benchmark is for")]
#![allow(dead_code, reason = "not every benchmark needs everything")]

use std::path::Path;
use std::time::Instant;

/// Runs `work` once to warm up, then until two seconds or 25 runs are over, at least five times; prints one line for `items` items.
pub(crate) fn measure(workload: &str, items: usize, how: &str, mut work: impl FnMut()) {
    work();
    let (mut seconds, mut spent): (Vec<f64>, f64) = (Vec::new(), 0.0);
    while seconds.len() < 5 || (spent < 2.0 && seconds.len() < 25) {
        let start = Instant::now();
        work();
        let run = start.elapsed().as_secs_f64();
        seconds.push(run);
        spent += run;
    }
    seconds.sort_by(f64::total_cmp);
    let median = seconds[seconds.len() / 2];
    println!(
        "{{\"workload\": \"{workload}\", \"peer\": \"spline-lab {}\", \"n\": {items}, \"median_s\": {median:e}, \"min_s\": {:e}, \
         \"reps\": {}, \"threads\": 1, \"how\": \"{how}\", \"items_per_s\": {:e}}}",
        env!("CARGO_PKG_VERSION"),
        seconds[0],
        seconds.len(),
        items as f64 / median,
    );
}

/// Prints one line of a check, `fields` being JSON members.
pub(crate) fn check(workload: &str, fields: &str) {
    println!(
        "{{\"workload\": \"{workload}-check\", \"peer\": \"spline-lab {}\", {fields}}}",
        env!("CARGO_PKG_VERSION")
    );
}

/// The numbers of `$PEERS_HOME/data/NAME.f64`, little-endian `f64`.
pub(crate) fn load(name: &str) -> Option<Vec<f64>> {
    let home = std::env::var_os("PEERS_HOME")?;
    let bytes = std::fs::read(Path::new(&home).join("data").join(format!("{name}.f64"))).ok()?;
    Some(bytes.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect())
}
