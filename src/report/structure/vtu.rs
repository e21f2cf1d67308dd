//! The structure as lines for ParaView: positions, displacements and forces at every station, utilisation of every rib.

use std::io::{self, Write};

use super::{Courses, FORCES};
use crate::mesh::formats::{Polylines, Values, write_vtu_lines};

/// Writes one line cell between neighbouring stations. By point and case: `CASE displacement` (three components), `CASE N`, `CASE Vy`, …;
/// by cell: `rib` (its number in the file, from 1) and `utilisation` (NaN where no limit speaks of it).
///
/// # Errors
/// Whatever the writer says.
pub fn write_vtu(courses: &Courses, utilisation: &[Option<f64>], mut out: &mut dyn Write) -> io::Result<()> {
    let per_line = courses.stations.len();
    let places = (0..courses.members.len()).flat_map(|member| (0..per_line).map(move |station| (member, station)));
    let points = places.map(|(member, station)| courses.point(member, station)).collect();
    let mut by_point = Vec::new();
    for case in &courses.cases {
        let moved = case.moved.iter().flatten().copied().collect();
        by_point.push(Values { name: format!("{} displacement", case.name), components: 3, values: moved });
        for (at, force) in FORCES.iter().enumerate() {
            let values: Vec<f64> = case.forces.iter().map(|forces| forces[at]).collect();
            // What no member carries, a plane has not.
            if values.iter().any(|value| *value != 0.0) {
                by_point.push(Values { name: format!("{} {force}", case.name), components: 1, values });
            }
        }
    }
    let by_cell = |name: &str, value: &dyn Fn(usize) -> f64| {
        let values = courses.members.iter().flat_map(|member| std::iter::repeat_n(value(member.rib), per_line.max(1) - 1));
        Values { name: name.into(), components: 1, values: values.collect() }
    };
    let used = |rib: usize| utilisation.get(rib).copied().flatten().unwrap_or(f64::NAN);
    let by_cell = vec![by_cell("rib", &|rib| rib as f64 + 1.0), by_cell("utilisation", &used)];
    write_vtu_lines(&mut out, &Polylines { points, per_line }, &by_point, &by_cell)
}
