//! Load cases, what acts in them, and combinations.

use super::super::RunError;
use super::converter::Converter;
use super::sections::Shapes;
use super::weight::Weights;
use crate::problem::structure::{Action, Axes, DIRECTIONS, Structure};
use crate::report::sheets::{Cell, Sheet};

/// The only group: which cases exclude one another the problem file says by its combinations alone.
const GROUP: &str = "cases";

const GROUPS: [&str; 3] = ["Name", "Load group type", "Relation"];
const CASES: [&str; 5] = ["Name", "Description", "Action type", "Load group", "Load type"];

/// Where along a member, in both sheets of point loads.
const PLACE: [&str; 4] = ["Origin", "Coordinate definition", "Position x [m]", "Repeat (n)"];
const TARGET: [&str; 5] = ["Name", "Direction", "Force action", "Reference node", "Reference member"];

const LINES: [&str; 17] = [
    "Name",
    "Force action",
    "Distribution",
    "Direction",
    "Value 1 [kN/m]",
    "Value 2 [kN/m]",
    "Member",
    "Load case",
    "Coordinate system",
    "Location",
    "Coordinate definition",
    "Origin",
    "Extent",
    "Start point [m]",
    "End point [m]",
    "Eccentricity ey [mm]",
    "Eccentricity ez [mm]",
];

const THERMAL: [&str; 13] = [
    "Name",
    "Force action",
    "Variation",
    "deltaT [°C]",
    "TempL [°C]",
    "TempR [°C]",
    "TempT [°C]",
    "TempB [°C]",
    "Member",
    "Load case",
    "Coordinate definition",
    "Origin",
    "Start point [m]",
];

/// The sheets of loads; none where the structure has no case.
///
/// # Errors
/// A load that the format has no word for, with the remedy; a base unit that is not given.
pub(super) fn sheets(
    structure: &Structure,
    names: &dyn Fn(u32) -> String,
    shapes: &Shapes<'_>,
    units: &Converter<'_>,
) -> Result<Vec<Sheet>, RunError> {
    if structure.cases.is_empty() {
        return Ok(Vec::new());
    }
    let weights = Weights::of(structure);
    let mut actions = Actions::new(structure, names, units);
    for load in &structure.loads {
        let case = &structure.cases[load.case as usize];
        match &load.action {
            Action::SelfWeight { member } => {
                if let Some(force) = weights.line_load(structure, load.case, *member, shapes, names)? {
                    actions.line(case, *member, Axes::Global, [force, force], [0.0, 1.0])?;
                }
            }
            other => actions.add(case, other)?,
        }
    }
    let mut groups = Sheet::new("StructuralLoadGroup", &GROUPS);
    groups
        .rows
        .push(["Permanent", "Standard"].into_iter().fold(vec![GROUP.into()], |row, word| [row, vec![word.into()]].concat()));
    let mut sheets = vec![groups, cases(structure, &weights), combinations(structure, &weights)];
    sheets.extend(actions.sheets());
    sheets.retain(|sheet| !sheet.rows.is_empty());
    Ok(sheets)
}

/// The file's cases, and one more where a case has a weight of all ribs beside other loads.
fn cases(structure: &Structure, weights: &Weights) -> Sheet {
    let mut sheet = Sheet::new("StructuralLoadCase", &CASES);
    let told = "What kind of action it is the problem file does not say; the combinations are complete";
    for (case, name) in structure.cases.iter().enumerate() {
        let own = weights.case_of(case).is_some_and(|weight| weight == &**name);
        let kind = if own { "Self weight" } else { "Standard" };
        sheet.rows.push([&**name, told, "Permanent", GROUP, kind].map(Cell::from).into());
    }
    for weight in weights.further(structure) {
        sheet.rows.push([weight, told, "Permanent", GROUP, "Self weight"].map(Cell::from).into());
    }
    sheet
}

/// Every combination, its cases and factors written out; and one for a case whose weight stands apart.
fn combinations(structure: &Structure, weights: &Weights) -> Sheet {
    let alone = |case: usize| (structure.cases[case].to_string(), vec![(case as u32, 1.0)]);
    let apart = (0..structure.cases.len()).filter(|case| weights.stands_apart(structure, *case)).map(alone);
    let declared = structure.combinations.iter().map(|known| (known.name.to_string(), known.factors.clone()));
    let all: Vec<(String, Vec<(String, f64)>)> = declared
        .chain(apart)
        .map(|(name, factors)| {
            (name, factors.iter().flat_map(|(case, factor)| weights.with(structure, *case, *factor)).collect())
        })
        .collect();
    let most = all.iter().map(|(_, factors)| factors.len()).max().unwrap_or(0);
    let mut sheet = Sheet::new("StructuralLoadCombination", &["Name", "Category", "Type"]);
    for at in 1..=most {
        sheet.header.extend(["Load factor", "Multiplier", "Load case name"].map(|title| format!("{title} {at}")));
    }
    for (name, factors) in all {
        let mut row: Vec<Cell> = vec![name.into(), "Not defined".into(), "Linear".into()];
        for (case, factor) in factors {
            row.extend([factor.into(), 1.0.into(), case.into()]);
        }
        sheet.rows.push(row);
    }
    sheet
}

/// The sheets of what acts, row by row.
struct Actions<'a> {
    structure: &'a Structure,
    names: &'a dyn Fn(u32) -> String,
    units: &'a Converter<'a>,
    points: Sheet,
    moments: Sheet,
    lines: Sheet,
    thermal: Sheet,
    settlements: Sheet,
}

impl<'a> Actions<'a> {
    fn new(structure: &'a Structure, names: &'a dyn Fn(u32) -> String, units: &'a Converter<'a>) -> Actions<'a> {
        let at_points = |sheet: &str, value: &str| {
            Sheet::new(sheet, &[&TARGET[..], &[value, "Load case", "Coordinate system"], &PLACE].concat())
        };
        let mut thermal = Sheet::new("StructuralCurveActionThermal", &THERMAL);
        thermal.header.push("End point [m]".into());
        let settled = ["Name", "Point support", "Direction", "Translation value [mm]", "Rotation value [mrad]", "Load case"];
        Actions {
            structure,
            names,
            units,
            points: at_points("StructuralPointAction", "Value [kN]"),
            moments: at_points("StructuralPointMoment", "Value [kNm]"),
            lines: Sheet::new("StructuralCurveAction", &LINES),
            thermal,
            settlements: Sheet::new("StructuralPointSupportDef", &settled),
        }
    }

    fn sheets(self) -> [Sheet; 5] {
        [self.points, self.moments, self.lines, self.thermal, self.settlements]
    }

    fn add(&mut self, case: &str, action: &Action) -> Result<(), RunError> {
        match action {
            Action::Nodal { node, force, moment } => {
                let node = self.structure.nodes.names[*node as usize].to_string();
                let target = [Cell::from("In node"), node.into(), "".into()];
                self.at_point(case, &target, "Global", [*force, *moment], None)
            }
            Action::Point { member, axes, force, moment, at } => {
                let target = [Cell::from("On beam"), "".into(), (self.names)(*member).into()];
                let system = if *axes == Axes::Local { "Local" } else { "Global" };
                self.at_point(case, &target, system, [*force, *moment], Some(*at))
            }
            Action::Distributed { member, axes, force, force_end, from, to } => {
                self.line(case, *member, *axes, [*force, *force_end], [*from, *to])
            }
            Action::Displacement { node, direction, value } => self.settlement(case, *node, usize::from(*direction), *value),
            Action::Temperature { member, change } => self.warmth(case, *member, [*change, f64::NAN]),
            Action::Gradient { member, difference } => self.warmth(case, *member, [f64::NAN, *difference]),
            Action::Pretension { member, .. } => {
                let rib = (self.names)(*member);
                Err(RunError::Choice(format!(
                    "no SAF file: load case `{case}` pretensions rib `{rib}`, for which the format has no word; a change of temperature \
                     of -force/(E·A·alpha) does the same: give `temperature` in its place"
                )))
            }
            Action::SelfWeight { .. } => Ok(()),
        }
    }

    /// A row for each component of force and moment.
    fn at_point(
        &mut self,
        case: &str,
        target: &[Cell; 3],
        system: &str,
        parts: [[f64; 3]; 2],
        at: Option<f64>,
    ) -> Result<(), RunError> {
        let words = [["X", "Y", "Z"], ["Mx", "My", "Mz"]];
        let sheets = [(&mut self.points, "P", "kN"), (&mut self.moments, "M", "kN*m")];
        for ((sheet, letter, unit), (values, words)) in sheets.into_iter().zip(parts.into_iter().zip(words)) {
            for (value, word) in values.into_iter().zip(words).filter(|(value, _)| *value != 0.0) {
                let mut row: Vec<Cell> = vec![format!("{letter}{}", sheet.rows.len() + 1).into(), word.into()];
                row.extend(target.iter().cloned());
                row.extend([self.units.to(value, unit)?.into(), case.into(), system.into()]);
                if let Some(at) = at {
                    row.extend(["From start".into(), "Relative".into(), Cell::from(at), 1.0.into()]);
                }
                sheet.rows.push(row);
            }
        }
        Ok(())
    }

    /// A row for each component, at its start and at its end.
    fn line(
        &mut self,
        case: &str,
        member: u32,
        axes: Axes,
        [force, force_end]: [[f64; 3]; 2],
        [from, to]: [f64; 2],
    ) -> Result<(), RunError> {
        let (system, location) = match axes {
            Axes::Global => ("Global", "Length"),
            Axes::Local => ("Local", "Length"),
            Axes::Projected => ("Global", "Projection"),
        };
        for (axis, word) in ["X", "Y", "Z"].into_iter().enumerate() {
            let [first, last] = [force[axis], force_end[axis]];
            if first == 0.0 && last == 0.0 {
                continue;
            }
            let even = first == last;
            let name = format!("L{}", self.lines.rows.len() + 1);
            let mut row: Vec<Cell> =
                vec![name.into(), "On beam".into(), if even { "Uniform" } else { "Trapez" }.into(), word.into()];
            let end = if even { f64::NAN } else { self.units.to(last, "kN/m")? };
            row.extend([self.units.to(first, "kN/m")?.into(), end.into(), (self.names)(member).into(), case.into()]);
            row.extend([system, location, "Relative", "From start", "Full"].map(Cell::from));
            row.extend([from, to, 0.0, 0.0].map(Cell::from));
            self.lines.rows.push(row);
        }
        Ok(())
    }

    /// Warmer all over, or warmer on top than below.
    fn warmth(&mut self, case: &str, member: u32, [change, difference]: [f64; 2]) -> Result<(), RunError> {
        let [change, half] = [self.units.to(change, "K")?, self.units.to(0.5 * difference, "K")?];
        let sides = if half.is_nan() { [f64::NAN; 4] } else { [0.0, 0.0, half, -half] };
        let variation = if half.is_nan() { "Constant" } else { "Linear" };
        let name = format!("T{}", self.thermal.rows.len() + 1);
        let mut row: Vec<Cell> = vec![name.into(), "On beam".into(), variation.into(), change.into()];
        row.extend(sides.map(Cell::from));
        row.extend([(self.names)(member).into(), case.into(), "Relative".into(), "From start".into()]);
        row.extend([0.0, 1.0].map(Cell::from));
        self.thermal.rows.push(row);
        Ok(())
    }

    /// A support that moves, which the format knows of rigid ones alone.
    fn settlement(&mut self, case: &str, node: u32, direction: usize, value: f64) -> Result<(), RunError> {
        let name = &self.structure.nodes.names[node as usize];
        let rigid = self.structure.supports.iter().any(|support| support.node == node && support.fixed[direction]);
        if !rigid {
            return Err(RunError::Choice(format!(
                "no SAF file: load case `{case}` moves node `{name}` along {}, where a spring holds it, and the format moves rigid supports \
                 alone; give the force of the spring, stiffness times displacement, in its place",
                DIRECTIONS[direction]
            )));
        }
        let turns = direction >= 3;
        let word = if turns { ["Rx", "Ry", "Rz"][direction - 3] } else { ["X", "Y", "Z"][direction] };
        let [moved, turned] = if turns { [f64::NAN, 1e3 * value] } else { [self.units.to(value, "mm")?, f64::NAN] };
        let row = format!("D{}", self.settlements.rows.len() + 1);
        let support = super::support_name(name);
        self.settlements.rows.push(vec![row.into(), support.into(), word.into(), moved.into(), turned.into(), case.into()]);
        Ok(())
    }
}
