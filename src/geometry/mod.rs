//! Chapter 2 of the note, and its 3.4 and 3.6: triangles, superellipses, polygons, polylines with thickness, surfaces.
//!
//! Sections lie in the x–y plane, x = width, y = height: `Ix = ∫y² dA`, `Iy = ∫x² dA`. Lengths are in the file's unit, areas in
//! its square, moments in its fourth power.

pub mod polygon;
pub mod polyline;
pub mod superellipse;
pub mod surface;
pub mod triangle;

pub use polygon::{Polygon, PolygonError};
pub use polyline::{Centreline, PolylineError};
pub use superellipse::Superellipse;
pub use surface::Surface;
