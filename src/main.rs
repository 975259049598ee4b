fn main() { spline_lab::app::run(std::env::args().nth(1).map(Into::into)).unwrap(); }
