//! The tables of utilisation: `utilisation.csv` by rib, `limits.csv` by limit.

use super::super::number::exact;
use super::{Place, Table};
use std::io::{self, Write};

/// How `limits.csv` begins.
pub const LIMITS_HEADER: &str = "name,constraint,of,item,value,side,limit,percent";

/// How `utilisation.csv` begins.
pub const HEADER: &str = "rib,utilisation,governs,case,station,point,value,side,limit";

impl Table {
    /// Writes [`HEADER`] and one line per rib; what no limit speaks of has empty cells.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_ribs(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(HEADER.split(','))?;
        for (name, most) in &self.ribs {
            let name = super::super::text::cell(name);
            let found = most.and_then(|(at, share)| {
                let used = self.uses.get(at)?;
                Some((share, used, self.constraints.get(used.constraint)?))
            });
            let Some((share, used, declared)) = found else {
                table.write_record([&*name, "", "", "", "", "", "", "", ""])?;
                continue;
            };
            let Place { case, station, point } = &declared.place;
            let (governs, case) = (super::super::text::cell(declared.written()), super::super::text::cell(case));
            let station = station.map_or(String::new(), exact);
            let side = if used.from_above { "<=" } else { ">=" };
            let (share, value, limit) = (exact(share), exact(used.value), exact(used.limit));
            table.write_record([&*name, &share, &*governs, &*case, &station, point, &value, side, &limit])?;
        }
        table.flush()
    }

    /// Writes [`LIMITS_HEADER`] and one line per limit.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write_limits(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(LIMITS_HEADER.split(','))?;
        for used in &self.uses {
            let declared = self.constraints.get(used.constraint);
            let (name, of) = declared.map_or(("", ""), |declared| (declared.name.as_str(), declared.of));
            let side = if used.from_above { "<=" } else { ">=" };
            let percent = used.share.map_or(String::new(), |share| exact(100.0 * share));
            let row = super::super::text::cell(&self.row_name(used)).into_owned();
            let (name, item) = (super::super::text::cell(name), super::super::text::cell(&used.item));
            table.write_record([&*row, &*name, of, &*item, &exact(used.value), side, &exact(used.limit), &percent])?;
        }
        table.flush()
    }
}
