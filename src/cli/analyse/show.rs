//! The analysis as text.

use std::io::{self, Write};

use ribopt::problem::Problem;
use ribopt::problem::structure::{DIRECTIONS, Structure};
use ribopt::report::number::short;
use ribopt::report::structure::AXES;
use ribopt::report::text::TextTable;
use ribopt::run::analyse::{Analysis, CaseResponses, Extreme};

/// Rows of a table shown on the console; JSON has all.
const MOST: usize = 40;

/// Tables by case, then definitions.
pub fn text(analysis: &Analysis, problem: &Problem, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{AXES}")?;
    let Some(structure) = problem.structure.as_deref() else { return Ok(()) };
    for case in &analysis.cases {
        writeln!(out, "\n{}", case.name)?;
        by_node("displacements", &case.displacements, structure, out)?;
        by_node("reactions", &case.reactions, structure, out)?;
        ribs(case, problem, out)?;
    }
    lowest(analysis, out)?;
    if !analysis.definitions.is_empty() {
        writeln!(out)?;
        analysis.definitions.iter().try_for_each(|(name, value)| writeln!(out, "{name} = {}", short(*value)))?;
    }
    if !analysis.gradient.is_empty() {
        gradient(analysis, out)?;
    }
    writeln!(out, "\nequilibrium residual: {}", short(analysis.equilibrium_residual))
}

fn by_node(title: &str, list: &[(u32, usize, f64)], structure: &Structure, out: &mut dyn Write) -> io::Result<()> {
    let directions: Vec<usize> = (0..6).filter(|at| list.iter().any(|(_, direction, _)| direction == at)).collect();
    let header: Vec<&str> = [title].into_iter().chain(directions.iter().map(|&at| DIRECTIONS[at])).collect();
    let mut table = TextTable::new(1, &header);
    let (mut nodes, mut left_out) = (0, 0);
    for group in list.chunk_by(|a, b| a.0 == b.0) {
        if nodes == MOST {
            left_out += 1;
            continue;
        }
        nodes += 1;
        let value =
            |at: &usize| group.iter().find(|(_, direction, _)| direction == at).map_or(String::new(), |found| short(found.2));
        let name = structure.nodes.names[group[0].0 as usize].to_owned();
        table.add([name].into_iter().chain(directions.iter().map(value)).collect());
    }
    write!(out, "{table}")?;
    more(left_out, "nodes", out)
}

fn ribs(case: &CaseResponses, problem: &Problem, out: &mut dyn Write) -> io::Result<()> {
    let mut table = TextTable::new(2, &["rib", "", "least", "at", "most", "at", ""]);
    let nothing = |extreme: &&Extreme| extreme.least.0 == 0.0 && extreme.most.0 == 0.0;
    let all: Vec<&Extreme> = case.forces.iter().chain(&case.stresses).filter(|extreme| !nothing(extreme)).collect();
    let mut sorted = all.clone();
    sorted.sort_by_key(|extreme| extreme.rib);
    for extreme in sorted.iter().take(6 * MOST) {
        let ((least, at_least, low), (most, at_most, high)) = (extreme.least, extreme.most);
        let of = if extreme.of.is_empty() { "stress" } else { extreme.of };
        let points = if low == high { low.to_owned() } else { format!("{low}, {high}") };
        let name = problem.ribs.names[extreme.rib as usize].to_owned();
        table.add(vec![name, of.into(), short(least), short(at_least), short(most), short(at_most), points]);
    }
    write!(out, "{table}")?;
    more(all.len().saturating_sub(6 * MOST), "lines", out)
}

/// Buckling factors and frequencies, with what finer pieces make of them.
fn lowest(analysis: &Analysis, out: &mut dyn Write) -> io::Result<()> {
    if analysis.modes.is_empty() {
        return Ok(());
    }
    let mut table = TextTable::new(1, &["lowest", "mode", "value", "with twice the pieces"]);
    for found in &analysis.modes {
        let what = found.case.as_ref().map_or("frequency".into(), |case| format!("buckling factor, {case}"));
        for (at, &value) in found.values.iter().enumerate() {
            let refined = found.refined.get(at).map_or(String::new(), |&value| short(value));
            table.add(vec![what.clone(), (at + 1).to_string(), short(value), refined]);
        }
    }
    write!(out, "\n{table}")
}

fn gradient(analysis: &Analysis, out: &mut dyn Write) -> io::Result<()> {
    for ((name, _), row) in analysis.definitions.iter().zip(&analysis.gradient) {
        writeln!(out, "\nd({name})")?;
        let shown = analysis.variables.iter().zip(row).filter(|(_, slope)| **slope != 0.0);
        shown.take(MOST).try_for_each(|(variable, slope)| writeln!(out, "  by {variable}: {}", short(*slope)))?;
    }
    Ok(())
}

fn more(left_out: usize, what: &str, out: &mut dyn Write) -> io::Result<()> {
    if left_out == 0 { Ok(()) } else { writeln!(out, "  … and {left_out} more {what}; --json has all") }
}
