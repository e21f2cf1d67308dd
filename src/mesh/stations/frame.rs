//! Frames along ribs, and what lines run over.

use crate::mesh::{QuadMesh, Vector, unit};

/// A right-handed orthonormal frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Along the rib.
    pub x: Vector,
    /// Across it, in the surface.
    pub y: Vector,
    /// Out of the surface.
    pub z: Vector,
}

impl Frame {
    /// The frame with this tangent and, as nearly as possible, this normal; `None` where either is zero or they are parallel
    /// (to within 1e−6 of a radian).
    pub fn new(tangent: Vector, normal: Vector) -> Option<Frame> {
        let (x, normal) = (unit(tangent)?, unit(normal)?);
        let across = normal.cross(&x);
        let y = unit(across).filter(|_| across.norm() > 1e-6)?;
        Some(Frame { x, y, z: x.cross(&y) })
    }

    /// The frame of a line without a surface: z as near to the global z as can be; of a line that is vertical to within a
    /// thousandth, to the global x.
    pub fn upright(tangent: Vector) -> Option<Frame> {
        let x = unit(tangent)?;
        Frame::new(x, if x.x.hypot(x.y) < 1e-3 { Vector::x() } else { Vector::z() })
    }
}

/// Where the frames of a line come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frames {
    /// A smooth surface: a line without frames, or one where they turn over, is a mistake.
    Smooth,
    /// Any faces: where their normals give no frame, the line is upright.
    Faces,
    /// Nothing but the line itself: it is upright.
    Upright,
}

/// What lines run over: points, and the surface's normals there.
pub trait Support {
    /// Where vertex `v` is.
    fn position(&self, v: u32) -> Vector;
    /// The unit normal of the surface there, if there is one.
    fn normal(&self, v: u32) -> Option<Vector>;
    /// The frame of a line with this tangent, where the surface has this normal.
    fn frame(&self, tangent: Vector, normal: Option<Vector>) -> Option<Frame> {
        Frame::new(tangent, normal?)
    }
    /// Where frames come from.
    fn frames(&self) -> Frames {
        Frames::Smooth
    }
    /// Whether only flagged edges carry ribs.
    fn has_flags(&self) -> bool;
}

impl Support for QuadMesh {
    fn position(&self, v: u32) -> Vector {
        self.positions[v as usize]
    }

    fn normal(&self, v: u32) -> Option<Vector> {
        self.normal_at(v)
    }

    fn has_flags(&self) -> bool {
        QuadMesh::has_flags(self)
    }
}
