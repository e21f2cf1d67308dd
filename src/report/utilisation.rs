//! How far limits are used: what uses every rib most, and every limit row by row, as CSV; grouped on the console.

mod tables;

use std::collections::HashMap;
use std::io::{self, Write};

use super::number::{short, significant};
use super::text::{TextTable, count};
use crate::units::{Label, Shown};
pub use tables::{HEADER, LIMITS_HEADER};

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
    /// `section`, `rib`, `node`, `group`, or nothing.
    pub of: &'static str,
    /// Where and when it looks at the structure.
    pub place: Place,
}

impl Declared {
    /// The name in the file: without the `#2` of a row that an abs, min or max of it made.
    pub fn written(&self) -> &str {
        match self.name.rsplit_once('#') {
            Some((name, number)) if !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit()) => name,
            _ => &self.name,
        }
    }
}

/// The case, the station and the point of a structure's response; empty where a constraint names none, or several.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Place {
    /// A case or combination.
    pub case: String,
    /// A fraction of the rib's length.
    pub station: Option<f64>,
    /// A point of the section.
    pub point: String,
}

impl Place {
    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.case.is_empty() && self.station.is_none() && self.point.is_empty()
    }
}

/// A section or a rib and the limit that uses it most.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// `section` or `rib`.
    pub of: &'static str,
    /// Its name.
    pub name: String,
    /// The limit, among [`Table::uses`].
    pub at: usize,
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
    /// All ribs in the file's order: the name, and the limit that uses it most among [`Table::uses`] with its share.
    pub ribs: Vec<(String, Option<(usize, f64)>)>,
    /// The constraint of every row, among [`Table::constraints`].
    pub rows: Vec<u32>,
}

impl Table {
    /// The row's name as in `constraints.csv`.
    pub fn row_name(&self, used: &Use) -> String {
        let Some(declared) = self.constraints.get(used.constraint) else { return String::new() };
        let parts: Vec<&str> =
            [used.item.as_str(), declared.detail.as_str()].into_iter().filter(|part| !part.is_empty()).collect();
        if parts.is_empty() { declared.name.clone() } else { format!("{}[{}]", declared.name, parts.join(", ")) }
    }

    /// Where row number `row` looks at the structure.
    pub fn place(&self, row: usize) -> Option<&Place> {
        Some(&self.constraints.get(*self.rows.get(row)? as usize)?.place)
    }

    /// Whether some limit looks at a structure.
    pub fn is_of_structure(&self) -> bool {
        self.constraints.iter().any(|declared| !declared.place.is_empty())
    }

    /// One line per constraint with its most used row, then sections and ribs.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write(&self, shown: &Shown, out: &mut dyn Write) -> io::Result<()> {
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
        let mut units = Vec::new();
        for (used, rows) in lines.iter().take(MOST_LINES) {
            let row = self.row_name(used);
            let (factor, unit) = Label::parts(shown.row(&row));
            let side = if used.from_above { "<=" } else { ">=" };
            let share = per_cent(used.share);
            let [value, limit] = [used.value, used.limit].map(|number| short(factor * number));
            table.add(vec![row, rows.to_string(), value, side.into(), limit, share]);
            units.push(unit);
        }
        table.note("unit", units);
        write!(out, "{table}")?;
        if lines.len() > MOST_LINES {
            writeln!(out, "  … {} in limits.csv", count(lines.len() - MOST_LINES, "more constraint"))?;
        }
        self.write_items(out)
    }

    fn write_items(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.items.len() < 2 {
            return Ok(());
        }
        writeln!(out, "  by section and rib, the limit that uses each most")?;
        let analysed = self.is_of_structure();
        let columns: &[&str] = match analysed {
            true => &["", "name", "limit", "case", "point", "at", "per cent"],
            false => &["", "name", "limit", "per cent"],
        };
        let mut table = TextTable::new(if analysed { 5 } else { 3 }, columns);
        for item in self.items.iter().take(MOST_LINES) {
            table.add(self.item_line(item, analysed));
        }
        write!(out, "{table}")?;
        if self.items.len() > MOST_LINES {
            let ribs = if self.ribs.is_empty() { "" } else { "; utilisation.csv has all ribs" };
            writeln!(out, "  … {} used less{ribs}", self.items.len() - MOST_LINES)?;
        }
        Ok(())
    }

    fn item_line(&self, item: &Loaded, analysed: bool) -> Vec<String> {
        let declared = self.uses.get(item.at).and_then(|used| self.constraints.get(used.constraint));
        let mut cells = vec![item.of.to_owned(), item.name.clone()];
        match declared.map(|declared| (declared.written(), &declared.place)) {
            Some((name, place)) if analysed && !place.is_empty() => {
                let station = place.station.map_or("-".into(), short);
                let or_dash = |text: &str| if text.is_empty() { "-".to_owned() } else { text.to_owned() };
                cells.extend([name.to_owned(), or_dash(&place.case), or_dash(&place.point), station]);
            }
            _ => {
                cells.push(self.uses.get(item.at).map_or_else(String::new, |used| self.row_name(used)));
                if analysed {
                    cells.extend(["-", "-", "-"].map(String::from));
                }
            }
        }
        cells.push(per_cent(Some(item.share)));
        cells
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
        let declared = |name: &str, of, place| Declared { name: name.into(), detail: String::new(), of, place };
        Table {
            constraints: vec![
                declared("stress#2", "rib", Place { case: "ULS".into(), station: Some(0.5), point: "top".into() }),
                declared("=sag", "", Place::default()),
            ],
            uses: vec![used(0, "r1", 100.0, 235.0, 0.4255), used(0, "r2", 235.0, 235.0, 1.0), used(1, "", 3.0, 4.0, 0.75)],
            items: Vec::new(),
            ribs: vec![("r1".into(), Some((0, 0.4255))), ("r2".into(), Some((1, 1.0))), ("r3".into(), None)],
            rows: vec![0, 0, 1],
        }
    }

    #[test]
    fn the_most_used_row_stands_for_its_constraint() {
        let mut text = Vec::new();
        table().write(&Shown::default(), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains("stress#2[r2]     2    235  <=    235       100"), "{text}");
        assert!(!text.contains("[r1]") && text.contains("75"), "{text}");
    }

    #[test]
    fn every_row_is_in_the_csv_and_no_name_is_a_formula() {
        let mut text = Vec::new();
        table().write_limits(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text.lines().next(), Some(LIMITS_HEADER));
        assert!(
            text.contains("stress#2[r1],stress#2,rib,r1,100.0,<=,235.0,42.55") && text.contains("\n'=sag,'=sag,,,3.0,<="),
            "{text}"
        );
    }

    #[test]
    fn every_rib_has_one_line_with_what_governs_and_where() {
        let mut text = Vec::new();
        table().write_ribs(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let expected = [HEADER, "r1,0.4255,stress,ULS,0.5,top,100.0,<=,235.0", "r2,1.0,stress,ULS,0.5,top,235.0,<=,235.0"];
        assert_eq!(lines[..3], expected);
        assert_eq!(lines[3..], ["r3,,,,,,,,"]);
    }
}
