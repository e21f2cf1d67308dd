//! Linear structures of straight members: axes, deformations, loads, and tapered bars and beams as expression graphs, so that every
//! derivative of every response is exact.
//!
//! Conventions. Global axes are right-handed, z up. Member axes: x from start to end, z the direction of the section's height, y = z × x
//! that of its width; the section's own coordinates (X, Y) are the member's (y, z), so that `Ix` resists bending in the x–z plane.
//! N is positive in tension. M = E·I·w'' in both planes: My (with Ix) > 0 sags, tension at the bottom; Mz (with Iy) > 0: tension at
//! −y. V = dM/dx. T is right-handed about +x on the face that looks to +x.
//!
//! A member is known by six *basic forces* q = (N, Mz_i, Mz_j, My_i, My_j, T) and the deformations e = a·u that go with them; q = f⁻¹(e − v)
//! with the flexibility f and the deformations v that loads cause in the simply supported member (Spacone, Ciampi and Filippou,
//! *Mixed formulation of nonlinear beam finite element*, 1996, in the linear case; Przemieniecki, *Theory of Matrix Structural
//! Analysis*, 1968, for prismatic members).

pub mod algebra;
pub mod axes;
pub mod beam;
pub mod deformation;
pub mod loads;
pub mod quadrature;

pub use beam::{Beam, Components, Tapered};
