//! From space to a panel: planes as they are, space isometrically, with nodes, supports and ribs.

use super::super::canvas::{Canvas, Ink, Style, through};
use crate::problem::structure::Plane;
use crate::report::structure::Courses;

/// A panel on the sheet, and the scale of the structure in it.
pub struct Drawing {
    plane: Plane,
    scale: f64,
    shift: [f64; 2],
    /// Pixels the panel takes.
    pub height: f64,
}

/// Room around the structure for supports and what is drawn beside ribs.
const AROUND: f64 = 54.0;

/// A panel is at most this high for its width.
const HIGHEST: f64 = 0.9;

/// Structures with more ribs than this are drawn in thinner lines, and their nodes without names.
const MANY: usize = 40;

/// Nodes up to which their names are written.
const FEW_NODES: usize = 14;

impl Drawing {
    /// Fits the structure into a panel of this width.
    pub fn fit(courses: &Courses, width: f64) -> Drawing {
        let flat = |p: [f64; 3]| flat(courses.plane, p);
        let ends = courses.members.iter().flat_map(|member| member.ends).map(flat);
        let points = courses.nodes.iter().map(|node| flat(node.position)).chain(ends);
        let ([mut low, mut high], finite) =
            ([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |p: &[f64; 2]| p.iter().all(|v| v.is_finite()));
        for p in points.filter(finite) {
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
        }
        let size = [high[0] - low[0], high[1] - low[1]];
        let room = [width - 2.0 * AROUND, HIGHEST * width - 2.0 * AROUND];
        let scale = (0..2).map(|d| room[d] / size[d]).filter(|scale| *scale > 0.0).fold(f64::INFINITY, f64::min);
        if !scale.is_finite() {
            return Drawing { plane: courses.plane, scale: 0.0, shift: [0.0; 2], height: 2.0 * AROUND };
        }
        let shift = [(width - size[0] * scale) / 2.0 - low[0] * scale, AROUND - low[1] * scale];
        Drawing { plane: courses.plane, scale, shift, height: size[1] * scale + 2.0 * AROUND }
    }

    /// Pixels per unit of length.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Where a point of the structure stands in a panel whose upper left corner is here.
    pub fn at(&self, [left, top]: [f64; 2], p: [f64; 3]) -> [f64; 2] {
        let [x, y] = flat(self.plane, p);
        [left + x * self.scale + self.shift[0], top + y * self.scale + self.shift[1]]
    }

    /// A direction of the structure on the sheet; not longer than it.
    pub fn direction(&self, v: [f64; 3]) -> [f64; 2] {
        flat(self.plane, v)
    }

    /// The structure before anything acts: ribs, rigid arms and supports.
    pub fn structure(&self, canvas: &mut Canvas, corner: [f64; 2], courses: &Courses, style: Style) {
        let mut all = String::new();
        for member in &courses.members {
            let ends = member.ends.map(|end| self.at(corner, end));
            all.push_str(&through(ends, false));
            for (end, node) in member.nodes.into_iter().enumerate() {
                let node = self.at(corner, courses.nodes[node as usize].position);
                if (node[0] - ends[end][0]).hypot(node[1] - ends[end][1]) > 0.5 {
                    canvas.path(&through([node, ends[end]], false), Style::line(Ink::Middle, 2.5));
                }
            }
        }
        canvas.path(&all, style);
        let size = if courses.members.len() > MANY { 3.0 } else { 6.0 };
        courses.nodes.iter().for_each(|node| {
            let at = self.at(corner, node.position);
            support(canvas, at, self.plane, node.held, size);
        });
    }

    /// Names of nodes, where there are few.
    pub fn node_names(&self, canvas: &mut Canvas, corner: [f64; 2], courses: &Courses) {
        if courses.nodes.len() > FEW_NODES {
            return;
        }
        for node in &courses.nodes {
            let [x, y] = self.at(corner, node.position);
            let below = if node.held.contains(&true) { 22.0 } else { -6.0 };
            canvas.note(x + 5.0, y + below, "start", &node.name);
        }
    }
}

/// Widths of lines: structures of many ribs are drawn finely.
pub fn line_width(courses: &Courses) -> f64 {
    if courses.members.len() > MANY { 0.8 } else { 1.8 }
}

/// A square where rotations are held too, a triangle where all displacements are, else a circle.
fn support(canvas: &mut Canvas, [x, y]: [f64; 2], plane: Plane, held: [bool; 6], size: f64) {
    let known = plane.directions();
    let all =
        |range: std::ops::Range<usize>| range.clone().any(|at| known[at]) && range.into_iter().all(|at| held[at] || !known[at]);
    let style = Style { filled: true, ..Style::line(Ink::Strong, 1.0) };
    if !held.contains(&true) {
        return;
    }
    match (all(0..3), all(3..6)) {
        (true, true) => canvas
            .path(&format!("M{:.1} {:.1}h{:.1}v{:.1}h{:.1}Z", x - size, y - size, 2.0 * size, 2.0 * size, -2.0 * size), style),
        (true, false) => canvas.path(&format!("M{x:.1} {y:.1}l{size:.1} {:.1}h{:.1}Z", 1.6 * size, -2.0 * size), style),
        _ => canvas.dot([x, y + size / 2.0 + 1.0], size / 2.0, Ink::Strong, false),
    }
}

/// y downwards as on screens. The plane x–z as it is, x–y seen from above, space from (1, 1, 1).
fn flat(plane: Plane, [x, y, z]: [f64; 3]) -> [f64; 2] {
    match plane {
        Plane::Xz => [x, -z],
        Plane::Xy => [x, -y],
        // Lengths across the line of sight are as they are in space.
        Plane::Space => [(y - x) / 2f64.sqrt(), ((x + y) - 2.0 * z) / 6f64.sqrt()],
    }
}
