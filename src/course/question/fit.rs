//! Questions about approximations: numbers that the methods give, and goals that they must meet.

use serde::Deserialize;

use crate::core::approximation::ApproximationError;
use crate::course::number_text::short_number;
use crate::course::question::{Answer, Verdict, judge, sentence, typed};
use crate::document::{Approximation, Scheme};
use crate::figure::approximation::fit;

/// What is asked about one method, numbered from 0.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "of", rename_all = "kebab-case", deny_unknown_fields)]
pub enum FitTask {
    /// Type the value `p(x)`.
    Value {
        /// The place.
        x: f64,
        /// The largest difference that counts as right.
        tolerance: f64,
    },
    /// Type the index of the first site that violates the condition of Schoenberg and Whitney.
    ViolatingSite,
    /// Bring the largest error down to a limit, with at most so many inner knots.
    ErrorBelow {
        /// The limit.
        limit: f64,
        /// The most inner knots.
        most_knots: usize,
    },
}

/// Judges `answer` for method number `method` of `approximation`.
pub(super) fn check(
    approximation: &Approximation,
    method: usize,
    task: &FitTask,
    answer: &Answer,
    feedback: &str,
) -> Verdict {
    let Some(scheme) = approximation.methods().get(method).map(|method| &method.scheme) else {
        return Verdict::wrong(None, "The method of this question is gone. Go back to the example.");
    };
    match *task {
        FitTask::ErrorBelow { limit, most_knots } => {
            goal(approximation, scheme, (limit, most_knots), feedback)
        }
        FitTask::Value { .. } | FitTask::ViolatingSite => {
            typed(answer, |value| judge_number(approximation, scheme, task, value, feedback))
        }
    }
}

fn judge_number(
    approximation: &Approximation,
    scheme: &Scheme,
    task: &FitTask,
    value: f64,
    feedback: &str,
) -> Verdict {
    let (right, tolerance) = match right_number(approximation, scheme, task) {
        Ok((right, tolerance)) => (Ok(right), tolerance),
        Err(reason) => (Err(reason), 0.0),
    };
    judge(value, right, tolerance, feedback, |right| {
        let hint = match task {
            FitTask::ViolatingSite => {
                "Compare every $x_k$ with both ends of the support of $b_k$, beginning with $k = 0$."
            }
            _ if value < right => "The number is larger.",
            _ => "The number is smaller.",
        };
        hint.to_owned()
    })
}

/// The right number and the difference that counts as right.
pub(super) fn right_number(
    approximation: &Approximation,
    scheme: &Scheme,
    task: &FitTask,
) -> Result<(f64, f64), String> {
    let result = fit(approximation, scheme);
    match (task, result) {
        (FitTask::ViolatingSite, Err(ApproximationError::SchoenbergWhitney { index, .. })) => {
            Ok((index as f64, 0.0))
        }
        (FitTask::ViolatingSite, Ok(_)) => {
            Err("The interpolant exists: no site violates the condition any more.".to_owned())
        }
        (FitTask::Value { x, tolerance }, Ok(fit)) => fit
            .spline
            .evaluate(*x)
            .map(|value| (value, *tolerance))
            .map_err(|error| sentence(&error.to_string())),
        (FitTask::ErrorBelow { .. }, Ok(_)) => Err("No number is asked for.".to_owned()),
        (_, Err(error)) => Err(sentence(&error.to_string())),
    }
}

fn goal(
    approximation: &Approximation,
    scheme: &Scheme,
    (limit, most): (f64, usize),
    feedback: &str,
) -> Verdict {
    let knots = scheme.space().map_or(0, |(_, knots)| knots.given().len());
    if knots > most {
        return Verdict::wrong(None, format!("There are {knots} inner knots; at most {most} are allowed."));
    }
    let error = match fit(approximation, scheme) {
        Ok(fit) => fit.error(),
        Err(error) => return Verdict::wrong(None, sentence(&error.to_string())),
    };
    let Some(error) = error else {
        return Verdict::wrong(None, "There is no function to compare with. Go back to the example.");
    };
    if error.size <= limit {
        return Verdict::right(error.size, feedback);
    }
    let message = format!(
        "The largest error is {}, at $x = {}$; {} is the limit.",
        short_number(error.size),
        short_number(error.at),
        short_number(limit)
    );
    Verdict::wrong(Some(error.size), message)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::document::{KnotChoice, Method, Preset, TypedFunction};

    #[test]
    fn the_violating_site_is_that_of_the_core() {
        let data = Approximation::new();
        let data = data.with_data(vec![0.0, 0.25, 0.5, 0.75, 3.0], vec![0.0; 5], None).unwrap();
        let knots = KnotChoice::Inner(vec![1.0, 2.0]);
        let all = data.with_method(Method::new(Scheme::Interpolation { degree: 2, knots }, 0)).unwrap();
        let ask = |text: &str| {
            check(&all, 0, &FitTask::ViolatingSite, &Answer::Text(text.to_owned()), "yes").correct
        };
        assert!(ask("3") && !ask("2") && !ask("x"), "example 5.5-f");
    }

    #[test]
    fn graded_knots_meet_the_goal_and_equidistant_ones_do_not() {
        let all = Preset::SquareRoot.build();
        let task = FitTask::ErrorBelow { limit: 0.02, most_knots: 7 };
        let judge = |method: usize| check(&all, method, &task, &Answer::Curve, "yes");
        assert!(!judge(0).correct && judge(1).correct, "{:?} {:?}", judge(0), judge(1));
        let few = FitTask::ErrorBelow { limit: 0.02, most_knots: 6 };
        assert!(!check(&all, 1, &few, &Answer::Curve, "yes").correct, "too many knots");
        let none = all.with_function(None::<TypedFunction>);
        assert!(!check(&none, 1, &task, &Answer::Curve, "yes").correct, "nothing to compare with");
    }
}
