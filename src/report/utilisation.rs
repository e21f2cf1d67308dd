//! How far every limit is used: value, limit and per cent, row by row as CSV, grouped on the console.

use std::collections::HashMap;
use std::io::{self, Write};

use super::number::{exact, short, significant};
use super::text::{TextTable, count};

/// How the table begins.
pub const HEADER: &str = "name,constraint,of,item,value,side,limit,percent";

/// Lines of a group on the console.
const MOST_LINES: usize = 12;

/// One limit of a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Use {
    /// Its constraint, among [`Table::constraints`].
    pub constraint: usize,
    /// What it is stated for, as in `slender[support]`; empty for a row of its own.
    pub item: String,
    /// The left side, or what stands on the side that varies most like one.
    pub value: f64,
    /// Whether the value is held from above.
    pub from_above: bool,
    /// What it is held against.
    pub limit: f64,
    /// value/limit from above, limit/value from below; `None` for limits of 0.
    pub share: Option<f64>,
}

/// A constraint: its name, and what it is repeated for.
#[derive(Debug, Clone, PartialEq)]
pub struct Declared {
    /// Its name.
    pub name: String,
    /// Case, station and point it is spread over; empty where it is not.
    pub detail: String,
    /// `section`, `rib`, `group`, or nothing.
    pub of: &'static str,
}

/// A section or a rib and the limit that uses it most.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// `section` or `rib`.
    pub of: &'static str,
    /// Its name.
    pub name: String,
    /// The row.
    pub row: String,
    /// Its share.
    pub share: f64,
}

/// All limits at a point.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// Constraints in the file's order.
    pub constraints: Vec<Declared>,
    /// Their limits.
    pub uses: Vec<Use>,
    /// Sections and ribs, those used most first.
    pub items: Vec<Loaded>,
}

impl Table {
    /// The row's name as in `constraints.csv`.
    pub fn row_name(&self, used: &Use) -> String {
        let Some(declared) = self.constraints.get(used.constraint) else { return String::new() };
        let parts: Vec<&str> =
            [used.item.as_str(), declared.detail.as_str()].into_iter().filter(|part| !part.is_empty()).collect();
        if parts.is_empty() { declared.name.clone() } else { format!("{}[{}]", declared.name, parts.join(", ")) }
    }

    /// Writes [`HEADER`] and one line per limit.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(HEADER.split(','))?;
        for used in &self.uses {
            let declared = self.constraints.get(used.constraint);
            let (name, of) = declared.map_or(("", ""), |declared| (declared.name.as_str(), declared.of));
            let side = if used.from_above { "<=" } else { ">=" };
            let percent = used.share.map_or(String::new(), |share| exact(100.0 * share));
            let row = super::text::cell(&self.row_name(used)).into_owned();
            let (name, item) = (super::text::cell(name), super::text::cell(&used.item));
            table.write_record([&*row, &*name, of, &*item, &exact(used.value), side, &exact(used.limit), &percent])?;
        }
        table.flush()
    }

    /// One line per constraint with its most used row, then sections and ribs.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut lines: Vec<(&Use, usize)> = Vec::new();
        // A constraint that is spread over cases, stations and points is one line.
        let mut known: HashMap<(&str, bool), usize> = HashMap::new();
        for used in &self.uses {
            let name = self.constraints.get(used.constraint).map_or("", |declared| declared.name.as_str());
            let at = *known.entry((name, used.from_above)).or_insert(lines.len());
            match lines.get_mut(at) {
                Some((most, rows)) => {
                    *rows += 1;
                    if used.share > most.share {
                        *most = used;
                    }
                }
                None => lines.push((used, 1)),
            }
        }
        if lines.is_empty() {
            return Ok(());
        }
        writeln!(out, "\nUtilisation: how far each limit is used, the most used row of each constraint")?;
        if lines.len() > MOST_LINES {
            lines.sort_by(|(a, _), (b, _)| b.share.unwrap_or(0.0).total_cmp(&a.share.unwrap_or(0.0)));
        }
        let mut table = TextTable::new(1, &["limit", "rows", "value", "", "limit", "per cent"]);
        for (used, rows) in lines.iter().take(MOST_LINES) {
            let side = if used.from_above { "<=" } else { ">=" };
            let share = per_cent(used.share);
            table.add(vec![self.row_name(used), rows.to_string(), short(used.value), side.into(), short(used.limit), share]);
        }
        write!(out, "{table}")?;
        if lines.len() > MOST_LINES {
            writeln!(out, "  … {} in utilisation.csv", count(lines.len() - MOST_LINES, "more constraint"))?;
        }
        self.write_items(out)
    }

    fn write_items(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.items.len() < 2 {
            return Ok(());
        }
        writeln!(out, "  by section and rib, the limit that uses each most")?;
        let mut table = TextTable::new(3, &["", "name", "limit", "per cent"]);
        for item in self.items.iter().take(MOST_LINES) {
            table.add(vec![item.of.into(), item.name.clone(), item.row.clone(), per_cent(Some(item.share))]);
        }
        write!(out, "{table}")?;
        if self.items.len() > MOST_LINES {
            writeln!(out, "  … {} used less", self.items.len() - MOST_LINES)?;
        }
        Ok(())
    }
}

fn per_cent(share: Option<f64>) -> String {
    share.map_or("-".into(), |share| significant((1000.0 * share).round() / 10.0, 6))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let used = |constraint, item: &str, value, limit, share| Use {
            constraint,
            item: item.into(),
            value,
            from_above: true,
            limit,
            share: Some(share),
        };
        Table {
            constraints: vec![
                Declared { name: "stress".into(), detail: String::new(), of: "rib" },
                Declared { name: "=sag".into(), detail: String::new(), of: "" },
            ],
            uses: vec![used(0, "r1", 100.0, 235.0, 0.4255), used(0, "r2", 235.0, 235.0, 1.0), used(1, "", 3.0, 4.0, 0.75)],
            items: Vec::new(),
        }
    }

    #[test]
    fn the_most_used_row_stands_for_its_constraint() {
        let mut text = Vec::new();
        table().write(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains("stress[r2]     2    235  <=    235       100"), "{text}");
        assert!(!text.contains("stress[r1]") && text.contains("75"), "{text}");
    }

    #[test]
    fn every_row_is_in_the_csv_and_no_name_is_a_formula() {
        let mut text = Vec::new();
        table().write_csv(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text.lines().next(), Some(HEADER));
        assert!(
            text.contains("stress[r1],stress,rib,r1,100.0,<=,235.0,42.55") && text.contains("\n'=sag,'=sag,,,3.0,<="),
            "{text}"
        );
    }
}
