//! Lines, stations and sections as CSV; sections as SVG.

use std::fmt::Write as _;
use std::io::Write;

use crate::mesh::section::{Piece, PieceReport};
use crate::mesh::stations::StationLine;
use crate::mesh::trace::Line;
use crate::mesh::{NONE, Vector};

/// `L3`, or `L3_closed`.
pub(super) fn line_name(at: usize, line: &Line) -> String {
    format!("L{}{}", at + 1, if line.closed { "_closed" } else { "" })
}

pub(super) fn lines(out: impl Write, positions: &[Vector], lines: &[Line]) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(["line", "closed", "point", "vertex", "x", "y", "z"])?;
    for (at, line) in lines.iter().enumerate() {
        for (point, &v) in line.vertices.iter().enumerate() {
            let head = [format!("L{}", at + 1), line.closed.to_string(), (point + 1).to_string(), (v + 1).to_string()];
            table.write_record(head.into_iter().chain(numbers([positions[v as usize]])))?;
        }
    }
    Ok(table.flush()?)
}

pub(super) fn stations(out: impl Write, lines: &[StationLine]) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record("line,closed,station,vertex,s,x,y,z,tx,ty,tz,nx,ny,nz".split(','))?;
    for line in lines {
        for (at, station) in line.stations.iter().enumerate() {
            let vertex = if station.vertex == NONE { String::new() } else { (station.vertex + 1).to_string() };
            let head = [line.name.clone(), line.closed.to_string(), (at + 1).to_string(), vertex, station.s.to_string()];
            let vectors = [station.position, station.frame.x, station.frame.z];
            table.write_record(head.into_iter().chain(numbers(vectors)))?;
        }
    }
    Ok(table.flush()?)
}

fn numbers<const N: usize>(vectors: [Vector; N]) -> impl Iterator<Item = String> {
    vectors.into_iter().flat_map(|v| [v.x, v.y, v.z]).map(|number| number.to_string())
}

pub(super) fn pieces(out: impl Write, pieces: &[PieceReport]) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record("piece,area,cx,cy,Ix,Iy,Ixy,I1,I2,angle,holes".split(','))?;
    for (at, p) in pieces.iter().enumerate() {
        let [cx, cy] = p.centroid;
        let [first, second] = p.principal;
        let numbers = [p.area, cx, cy, p.ix, p.iy, p.ixy, first, second, p.angle].map(|number| number.to_string());
        table.write_record([(at + 1).to_string()].into_iter().chain(numbers).chain([p.holes.to_string()]))?;
    }
    Ok(table.flush()?)
}

/// The outlines, filled, the centroids marked; y upwards.
pub(super) fn section_svg(pieces: &[Piece]) -> String {
    let points = || pieces.iter().flat_map(|piece| piece.polygon.rings()).flatten();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in points() {
        low = [low[0].min(p[0]), low[1].min(p[1])];
        high = [high[0].max(p[0]), high[1].max(p[1])];
    }
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let scale = if size > 0.0 && size.is_finite() { 560.0 / size } else { 1.0 };
    let place = |p: &[f64; 2]| format!("{:.3},{:.3}", 20.0 + (p[0] - low[0]) * scale, 580.0 - (p[1] - low[1]) * scale);
    let mut text = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 600 600\">\n");
    text.push_str("<rect width=\"600\" height=\"600\" fill=\"white\"/>\n");
    for piece in pieces {
        let ring = |ring: &Vec<[f64; 2]>| format!("M {} Z", ring.iter().map(place).collect::<Vec<_>>().join(" L "));
        let path = piece.polygon.rings().iter().map(ring).collect::<Vec<_>>().join(" ");
        let centre = place(&piece.properties.centroid);
        let (cx, cy) = centre.split_once(',').unwrap_or(("0", "0"));
        let _ = writeln!(text, "<path d=\"{path}\" fill=\"#9ecae1\" stroke=\"#08519c\" fill-rule=\"evenodd\"/>");
        let _ = writeln!(text, "<circle cx=\"{cx}\" cy=\"{cy}\" r=\"3\"/>");
    }
    text.push_str("</svg>\n");
    text
}
