//! The schedule of ribs as sheets: sizes at both ends, volume, mass and utilisation, with units in the headers.

use std::collections::HashMap;

use super::About;
use super::sheets::{Cell, Sheet};
use super::sizes::{RibVolume, Size};
use super::utilisation::Table;

/// Rows of a sheet, by what Excel and LibreOffice take (2²⁰), less the header.
pub const MOST_ROWS: usize = (1 << 20) - 1;

/// What the sheets are made of.
pub struct Schedule<'a> {
    /// The problem's origin and words.
    pub about: &'a About,
    /// The verdict in a word.
    pub status: &'a str,
    /// Ribs with their volumes.
    pub ribs: Vec<RibVolume<'a>>,
    /// Dimensions and properties, section by section.
    pub sizes: Vec<Size<'a>>,
    /// What uses every rib most.
    pub used: Option<&'a Table>,
}

impl Schedule<'_> {
    /// Ribs, sections where there are any, and where the numbers come from.
    pub fn sheets(&self) -> Vec<Sheet> {
        let mut sheets = vec![self.ribs()];
        if !self.sizes.is_empty() {
            sheets.push(self.sections());
        }
        sheets.push(self.origin());
        sheets
    }

    fn ribs(&self) -> Sheet {
        let length = self.about.unit("length");
        let with_unit =
            |name: &str, unit: Option<String>| unit.map_or_else(|| name.to_owned(), |unit| format!("{name} [{unit}]"));
        let dimensions = names(self.sizes.iter().filter(|size| size.given != "derived"));
        let mut sheet = Sheet::new("ribs", &["rib", "from", "to"]);
        sheet.header.push(with_unit("length", length.map(str::to_owned)));
        sheet.header.extend(dimensions.iter().flat_map(|name| [format!("{name} from"), format!("{name} to")]));
        sheet.header.push(with_unit("volume", length.map(|length| format!("{length}³"))));
        sheet.header.push(with_unit("mass", self.about.unit("mass").map(str::to_owned)));
        sheet.header.extend(["utilisation", "governs", "case", "station", "point"].map(String::from));
        let values: HashMap<(&str, &str), f64> = self.sizes.iter().map(|size| ((size.section, size.name), size.value)).collect();
        for (at, rib) in self.ribs.iter().enumerate() {
            let of_ends = dimensions.iter().flat_map(|name| rib.ends.map(|section| values.get(&(section, *name)).copied()));
            let numbers = [Some(rib.length)].into_iter().chain(of_ends).chain([Some(rib.volume), rib.mass()]);
            let texts = [rib.rib, rib.ends[0], rib.ends[1]].map(Cell::from);
            let row = texts.into_iter().chain(numbers.map(|number| Cell::Number(number.unwrap_or(f64::NAN))));
            sheet.rows.push(row.chain(self.used_by(at)).collect());
        }
        sheet
    }

    /// How far a rib is used, by what, and where.
    fn used_by(&self, rib: usize) -> Vec<Cell> {
        let found = || {
            let table = self.used?;
            let (at, share) = table.ribs.get(rib)?.1?;
            let declared = table.constraints.get(table.uses.get(at)?.constraint)?;
            let (place, station) = (&declared.place, declared.place.station.unwrap_or(f64::NAN));
            Some(vec![
                share.into(),
                declared.written().into(),
                place.case.as_str().into(),
                station.into(),
                place.point.as_str().into(),
            ])
        };
        found().unwrap_or_default()
    }

    fn sections(&self) -> Sheet {
        let names = names(self.sizes.iter());
        let mut sheet = Sheet::new("sections", &["section", "kind"]);
        sheet.header.extend(names.iter().map(|name| (*name).to_owned()));
        let mut last = None;
        for size in &self.sizes {
            if last != Some(size.section) {
                last = Some(size.section);
                let empty = names.iter().map(|_| Cell::Number(f64::NAN));
                sheet.rows.push([Cell::from(size.section), Cell::from(size.kind)].into_iter().chain(empty).collect());
            }
            if let (Some(row), Some(at)) = (sheet.rows.last_mut(), names.iter().position(|name| *name == size.name)) {
                row[at + 2] = size.value.into();
            }
        }
        sheet
    }

    fn origin(&self) -> Sheet {
        let about = self.about;
        let units: Vec<String> = about.units.iter().map(|(key, label)| format!("{key} in {label}")).collect();
        let lines = [
            ("title", about.title.clone()),
            ("file", about.file.clone()),
            ("SHA-256 of the file and its tables", about.sha256.clone()),
            ("verdict", self.status.to_owned()),
            ("units", units.join(", ")),
            ("changes", about.changes.join(", ")),
            ("made by", format!("ribopt {}", env!("CARGO_PKG_VERSION"))),
        ];
        let rows = lines.into_iter().map(|(name, text)| vec![name.into(), text.into()]).collect();
        Sheet { rows, ..Sheet::new("origin", &[]) }
    }
}

/// Names in the order in which they occur.
fn names<'a>(sizes: impl Iterator<Item = &'a Size<'a>>) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for size in sizes {
        if !names.contains(&size.name) {
            names.push(size.name);
        }
    }
    names
}
