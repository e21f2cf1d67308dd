//! The sized ribs as a page shows them in space: `network.json`.

use std::collections::HashMap;
use std::io::{self, Write};

use serde::Serialize;

use super::pictures::Load;
use super::result::write_value;
use crate::mesh::Vector;
use crate::mesh::solids::{Ring, SizedRib};

/// Ribs that a page shows in space; more make pages that browsers are slow to open.
pub const MOST_RIBS: usize = 20_000;

/// A network: outlines, and ribs that refer to them. Single precision is more than a screen shows.
#[derive(Serialize)]
struct Network<'a> {
    format: &'static str,
    /// Rings of corners across and along the height, each kept once.
    outlines: Vec<Vec<Vec<[f32; 2]>>>,
    ribs: Vec<Rib<'a>>,
}

#[derive(Serialize)]
struct Rib<'a> {
    name: &'a str,
    section: &'a str,
    ends: [[f32; 3]; 2],
    /// Across it, and along its height.
    y: [f32; 3],
    z: [f32; 3],
    outlines: [usize; 2],
    /// How far it is used, and by which constraint.
    share: Option<f32>,
    limit: &'a str,
}

/// Writes the ribs with the names of their sections and what uses them most.
///
/// # Errors
/// Whatever the writer says.
pub fn write(ribs: &[SizedRib], sections: &[String], loads: &[Load], out: &mut dyn Write) -> io::Result<()> {
    let (mut outlines, mut known) = (Vec::new(), HashMap::new());
    let mut outline = |rings: &[Ring]| {
        let rounded: Vec<Vec<[f32; 2]>> =
            rings.iter().map(|ring| ring.iter().map(|point| point.map(|value| value as f32)).collect()).collect();
        let key: Vec<Vec<[u32; 2]>> =
            rounded.iter().map(|ring| ring.iter().map(|point| point.map(f32::to_bits)).collect()).collect();
        *known.entry(key).or_insert_with(|| {
            outlines.push(rounded);
            outlines.len() - 1
        })
    };
    let single = |vector: &Vector| [vector.x as f32, vector.y as f32, vector.z as f32];
    let placed = ribs.iter().zip(sections).zip(loads).map(|((rib, section), load)| Rib {
        name: &rib.geometry.name,
        section,
        ends: rib.geometry.ends.each_ref().map(single),
        y: single(&rib.geometry.frame.y),
        z: single(&rib.geometry.frame.z),
        outlines: [outline(&rib.rings[0]), outline(&rib.rings[1])],
        share: load.share.filter(|share| share.is_finite()).map(|share| share as f32),
        limit: &load.limit,
    });
    let ribs = placed.collect();
    write_value(&Network { format: "ribopt-network/1", outlines, ribs }, out)
}
