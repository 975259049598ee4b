#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use super::*;
use crate::document::{KnotChoice, Method, Preset, Scheme, TypedFunction};

fn lines(picture: &Picture, layer: &str) -> usize {
    picture.layers.iter().filter(|found| found.name.starts_with(layer)).map(|found| found.items.len()).sum()
}

/// Examples 5.1-a and 5.1-b.
#[test]
fn the_square_root_has_the_errors_of_the_course() {
    for (exponent, error) in [(1.0, 6.55034e-2), (4.0, 8.01629e-3)] {
        let breaks = crate::core::approximation::graded_breaks(0.0, 1.0, 8, exponent).unwrap();
        let knots = KnotChoice::Inner(breaks[1..8].to_vec());
        let f = TypedFunction::new("sqrt(x)", 0.0, 1.0).unwrap();
        let all = Approximation::new().with_function(Some(f));
        let found = fit(&all, &Scheme::Schoenberg { degree: 2, knots }).unwrap().from_function.unwrap();
        assert!((found.size / error - 1.0).abs() < 1e-5, "exponent {exponent}: {found:?}");
    }
}

/// Example 5.1-f.
#[test]
fn all_knots_can_be_given() {
    let all = Preset::ThirdDerivative.build();
    let fit = fit(&all, &all.methods()[0].scheme).unwrap();
    assert_eq!(fit.spline.coefficients(), [8.0, 27.0, 125.0, 343.0], "cubes of the averages 2, 3, 5, 7");
}

/// Example 5.5-f.
#[test]
fn the_first_violation_is_named_and_drawn() {
    let data = Approximation::new();
    let data = data.with_data(vec![0.0, 0.25, 0.5, 0.75, 3.0], vec![0.0; 5], None).unwrap();
    let knots = KnotChoice::Inner(vec![1.0, 2.0]);
    let all = data.with_method(Method::new(Scheme::Interpolation { degree: 2, knots }, 0)).unwrap();
    let analysis = analyse(&all, None);
    let error = analysis.fits[0].as_ref().unwrap_err();
    assert!(error.to_string().starts_with("site 3 "), "{error}");
    let window = fitted_window(&all, &analysis);
    let layout = Layout::new(&all, &analysis, window, &Theme::light(), DVec2::new(600.0, 500.0));
    let picture = compose(&all, &analysis, &layout, &Theme::light(), true);
    assert_eq!(lines(&picture, "violations"), 1, "a ring around site 3");
}

#[test]
fn every_preset_is_drawn_with_all_its_curves_errors_and_knots() {
    for preset in Preset::ALL {
        let all = preset.build();
        let analysis = analyse(&all, None);
        assert!(analysis.fits.iter().all(Result::is_ok), "{preset:?}: {:?}", analysis.fits);
        let window = fitted_window(&all, &analysis);
        for theme in Theme::all() {
            let layout = Layout::new(&all, &analysis, window, &theme, DVec2::new(800.0, 600.0));
            let picture = compose(&all, &analysis, &layout, &theme, true);
            let methods = all.methods().len();
            assert!(lines(&picture, "curve: ") >= methods, "{preset:?}: curves");
            assert!(lines(&picture, "error: ") >= methods, "{preset:?}: errors");
            assert_eq!(layout.rows.len(), methods, "{preset:?}: one line of knots each");
        }
    }
}

#[test]
fn what_has_not_changed_is_not_computed_again() {
    let all = Preset::Runge.build();
    let first = analyse(&all, None);
    let changed = all.replacing_method(1, Method::new(Scheme::Smoothing { sigma: 0.5 }, 1)).unwrap();
    let second = analyse(&changed, Some((&all, &first)));
    let same =
        |i: usize| std::sync::Arc::ptr_eq(first.fits[i].as_ref().unwrap(), second.fits[i].as_ref().unwrap());
    assert_eq!((same(0), same(1), same(2)), (true, false, true), "only the second one is new");
}

#[test]
fn places_and_numbers_belong_to_each_other_far_from_zero() {
    let all = Preset::Runge.build();
    let analysis = analyse(&all, None);
    let window = crate::document::PlotWindow { x: [1e6, 1e6 + 1e-4], y: [-1e-9, 1e-9] };
    let layout = Layout::new(&all, &analysis, window, &Theme::dark(), DVec2::new(700.0, 500.0));
    let (x, y) = layout.main.numbers(layout.main.place(1e6 + 3e-5, 2e-10));
    assert!((x - 1e6 - 3e-5).abs() < 1e-9 && (y - 2e-10).abs() < 1e-20, "{x} {y}");
}

#[test]
fn strange_pages_and_windows_are_drawn() {
    let empty = Approximation::new();
    let one = empty.with_data(vec![3.0], vec![-2.0], None).unwrap();
    let hole = TypedFunction::new("1/(x - 1/2) + log(x - 0.2)", 0.0, 1.0).unwrap();
    let function = Preset::NoisySine.build().with_function(Some(hole));
    let huge = empty.with_data(vec![-1e308, 1e308], vec![-1e308, 1e308], None).unwrap();
    let huge = huge.with_method(Method::new(Scheme::Smoothing { sigma: 0.0 }, 0)).unwrap();
    for all in [empty, one, function, huge] {
        let analysis = analyse(&all, None);
        let fitted = fitted_window(&all, &analysis);
        assert!(fitted.check().is_ok(), "{fitted:?}");
        for size in [DVec2::ZERO, DVec2::splat(5.0), DVec2::new(900.0, 40.0), DVec2::new(1200.0, 900.0)] {
            for window in [fitted, crate::document::PlotWindow { x: [0.0, 5e-324], y: [-1e300, 1e300] }] {
                let layout = Layout::new(&all, &analysis, window, &Theme::light(), size);
                let picture = compose(&all, &analysis, &layout, &Theme::light(), true);
                assert!(picture.layers.len() < 40, "{size}");
            }
        }
    }
}
