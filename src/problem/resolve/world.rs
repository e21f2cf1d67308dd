//! What a formula is resolved against, and what comes of it beside the formula.

use super::super::Problem;
use super::super::mistake_code::MistakeCode;
use super::super::names::Names;
use super::Value;
use crate::expression::Span;
use crate::expression::ast::Collection;
use crate::units::System;

/// Something to be said about a part of an expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// The part.
    pub span: Span,
    /// What is wrong with it.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
}

/// What came to light besides the formula.
#[derive(Debug, Default)]
pub struct Report {
    /// Mistakes; where there is one, there is no formula.
    pub mistakes: Vec<(MistakeCode, Remark)>,
    /// Item names that hide a global one, and choices made at the start.
    pub warnings: Vec<(MistakeCode, Remark)>,
    /// What responses left open.
    pub open: Open,
    /// Whether a number with a unit occurs.
    pub quantities: bool,
    /// Data columns that occur.
    pub used: Vec<(Collection, u32)>,
}

/// Which names may occur.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Parameters only.
    Constants,
    /// Parameters, variables, and definitions made of these.
    Variables,
    /// Everything declared.
    All,
}

/// What names can refer to.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// Sections and ribs with their data; variables; definitions and dimensions as far as they are resolved.
    pub problem: &'a Problem,
    /// Who is who.
    pub names: &'a Names,
    /// Values of parameters; `None` where a mistake was reported.
    pub parameters: &'a [Option<Value>],
    /// For each entry of `[variables]`: its first scalar variable, and its size if it is an array.
    pub variables: &'a [(u32, Option<u32>)],
    /// Values of definitions; `None` where a mistake was reported.
    pub definitions: &'a [Option<Value>],
    /// What the file's numbers are in.
    pub units: &'a System,
    /// Which of these may occur.
    pub stage: Stage,
    /// The row a constraint is being spread over.
    pub chosen: Chosen<'a>,
}

/// The case, station and point of the row a constraint is being spread over.
#[derive(Debug, Clone, Copy, Default)]
pub struct Chosen<'a> {
    /// The case or combination that the word `case` stands for.
    pub case: Option<u32>,
    /// The station of responses that name none.
    pub station: Option<f64>,
    /// The point of stresses that name none.
    pub point: Option<&'a str>,
    /// The sign of torsion's share in shear stresses.
    pub sign: f64,
    /// The row's item, where each is resolved by itself.
    pub item: Option<(Collection, u32)>,
    /// The name and the number of a constraint's index.
    pub index: Option<(&'a str, f64)>,
}

/// What responses left open while a formula was resolved: the row has to be spread over it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Open {
    /// Some response names no station.
    pub station: bool,
    /// Some normal stress names no point.
    pub stress: bool,
    /// Some equivalent stress names no point.
    pub shear: bool,
    /// Sags occur: rows are those of the ribs of each line.
    pub sag: bool,
    /// Shear stresses occur, so that torsion may count either way.
    pub sign: bool,
    /// Cases and combinations that occur.
    pub sets: Vec<u32>,
    /// Forms of the sections whose points are left open.
    pub forms: Vec<u16>,
}
