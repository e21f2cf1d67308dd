//! Volumes of ribs with gradient and Hessian in closed form (note 2.3, 2.4, misprints corrected).
//!
//! Every part of a section that is a product of two lengths (a rectangle; web and flanges of an H beam) is one [`Part`];
//! an H beam is two of them. Other shapes get their volume from their area, as an expression ([`law`]).

mod frusta;
pub mod law;
mod part;
mod row;

pub use part::Part;
