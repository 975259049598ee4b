//! Chapter 8: surfaces.
//!
//! | file | what |
//! |---|---|
//! | `spline_surface`, `nurbs_surface` | 8.2 polynomial and rational surfaces, their derivatives and normals |
//! | `surface_editing` | 8.2 other points and weights, knot insertion, degree elevation, parts |
//! | `grid` | 8.2 points and normals on a grid |
//! | `measure` | 8.2 area and enclosed volume |
//! | `tessellation` | 8.2 triangles within a tolerance |
//! | `curvature` | B.9 fundamental forms, Gaussian, mean and principal curvature |
//! | `samples` | 8.1, 8.2 surfaces of the course |
//! | `mesh_topology`, `polygon_mesh` | 8.3 connectivity; meshes with positions and creases |
//! | `mesh_deletion` | 8.3 meshes without some vertices or faces |
//! | `mesh_shapes` | 8.3 meshes to start from |
//! | `catmull_clark` | 8.3 subdivision, limits, stencils |

pub mod catmull_clark;
mod curvature;
mod error;
mod grid;
mod measure;
mod mesh_deletion;
mod mesh_error;
pub mod mesh_shapes;
mod mesh_topology;
mod nurbs_surface;
mod polygon_mesh;
pub mod samples;
mod spline_surface;
mod surface_editing;
mod tessellation;

pub use curvature::{Curvatures, FundamentalForms, PointKind, SurfaceJet};
pub use error::SurfaceError;
pub use mesh_error::MeshError;
pub use mesh_topology::{MAX_FACES, MeshTopology, VertexRing, mesh_faults};
pub use nurbs_surface::{NurbsSurface, RationalPatch};
pub use polygon_mesh::{Crease, INFINITE_SHARPNESS, PolygonMesh};
pub use spline_surface::SplineSurface;
pub use tessellation::{MAX_TRIANGLES, SurfaceTriangles};
