//! Chapter 2: Bezier curves.
