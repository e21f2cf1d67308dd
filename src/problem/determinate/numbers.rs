//! Members of known forces, with sections of which every property is 1: what stands above A, I, J and the shear areas.

use crate::expression::graph::{Graph, NodeId};
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use crate::sections::{self, Form};
use crate::structure::algebra::Numbers;
use crate::structure::beam::{Bending, Force};
use crate::structure::deformation::BASIC;
use crate::structure::loads::MemberLoads;
use crate::structure::quadrature::TAPERED;
use crate::structure::{Beam, Tapered};

/// What is below this share of the terms it is the sum of is rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// A member, a case or combination, and its basic forces there.
pub(super) struct Loaded {
    pub set: u32,
    pub member: u32,
    pub forces: [f64; BASIC],
}

/// A prismatic member as numbers.
pub(super) struct Numbered<'a> {
    structure: &'a Structure,
    statics: &'a Statics,
    loaded: Loaded,
    loads: MemberLoads<f64>,
}

/// What a quantity is divided by, besides a modulus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stiffness {
    /// E·A
    Axial,
    /// E·Iy
    Lateral,
    /// E·Ix
    Vertical,
    /// G·Asx
    LateralShear,
    /// G·Asy
    VerticalShear,
    /// G·J
    Torsion,
}

/// Numbers over stiffnesses.
pub(super) type Shares = Vec<(Stiffness, f64)>;

impl<'a> Numbered<'a> {
    pub fn new(structure: &'a Structure, statics: &'a Statics, loaded: Loaded) -> Self {
        let frame = &statics.members[loaded.member as usize].frame;
        let mut loads = statics.member_loads(&mut Numbers, structure, (loaded.member, loaded.set), frame);
        // Strains deform a determinate structure, and that is all they do: what they do to displacements is not asked for.
        (loads.strain, loads.gradient, loads.pretension) = (None, None, None);
        Numbered { structure, statics, loaded, loads }
    }

    /// An internal force at a fraction of the length; what rounding leaves of one is none.
    pub fn force(&self, which: Force, x: f64) -> f64 {
        let value = self.with_beam(Known::Forces, false, |graph, beam| beam.force(graph, which, x));
        let loads = self.loads.terms.iter().map(|term| term.value.abs()).sum::<f64>();
        let terms = self.loaded.forces.iter().map(|force| force.abs()).sum::<f64>() + loads;
        let terms = if matches!(which, Force::Vy | Force::Vz) { terms / self.length() } else { terms };
        if value.abs() <= ROUNDING * terms { 0.0 } else { value }
    }

    /// The forces its supports exert on the simply supported member.
    pub fn support_forces(&self) -> [f64; 6] {
        std::array::from_fn(|at| self.with_beam(Known::Forces, false, |graph, beam| beam.support_forces(graph)[at]))
    }

    /// The deflection from the chord in a plane, over what it has to be divided by.
    pub fn deflection(&self, vertical: bool, x: f64) -> Shares {
        let value = |shear: bool| {
            self.with_beam(Known::Forces, shear, |graph, beam| match vertical {
                true => Bending::vertical(beam).deflection(graph, x),
                false => Bending::lateral(beam).deflection(graph, x),
            })
        };
        Self::shares(vertical, value(false), self.deforms_in_shear().then(|| value(true)))
    }

    /// The deformations e that go with the basic forces, each over what it has to be divided by.
    pub fn deformations(&self) -> [Shares; BASIC] {
        let (bending, both) = (self.deformed(false), self.deforms_in_shear().then(|| self.deformed(true)));
        std::array::from_fn(|component| match component {
            0 => vec![(Stiffness::Axial, bending[0])],
            5 => vec![(Stiffness::Torsion, bending[5])],
            plane => Self::shares(plane > 2, bending[plane], both.map(|both| both[plane])),
        })
    }

    /// What bending makes of a quantity in a plane and, beside what both make, shear.
    fn shares(vertical: bool, bending: f64, both: Option<f64>) -> Shares {
        let [by_bending, by_shear] = planes(vertical);
        let shear = both.map(|both| (by_shear, both - bending));
        std::iter::once((by_bending, bending)).chain(shear).collect()
    }

    /// What the basic forces have beyond those that the loads make between held ends.
    pub fn beyond_held(&self) -> [f64; BASIC] {
        let held = self.basic_forces([0.0; BASIC], false);
        std::array::from_fn(|at| self.loaded.forces[at] - held[at])
    }

    /// Whether nothing acts on the member between its ends.
    pub fn is_unloaded(&self) -> bool {
        self.loads.terms.is_empty()
    }

    pub fn deforms_in_shear(&self) -> bool {
        self.structure.members[self.loaded.member as usize].shear
    }

    fn length(&self) -> f64 {
        self.statics.members[self.loaded.member as usize].frame.length
    }

    /// e = K⁻¹(q − q₀), plane by plane.
    fn deformed(&self, shear: bool) -> [f64; BASIC] {
        let held = self.basic_forces([0.0; BASIC], shear);
        let columns: [[f64; BASIC]; BASIC] = std::array::from_fn(|at| {
            let moved = self.basic_forces(std::array::from_fn(|other| f64::from(u8::from(other == at))), shear);
            std::array::from_fn(|row| moved[row] - held[row])
        });
        let components = &self.statics.members[self.loaded.member as usize].components;
        let rest: [f64; BASIC] = std::array::from_fn(|at| self.loaded.forces[at] - held[at]);
        let mut deformed = [0.0; BASIC];
        for group in [&[0][..], &[1, 2], &[3, 4], &[5]] {
            match *group.iter().copied().filter(|&at| components[at]).collect::<Vec<usize>>() {
                [i] => deformed[i] = rest[i] / columns[i][i],
                [i, j] => {
                    let determinant = columns[i][i] * columns[j][j] - columns[i][j] * columns[j][i];
                    deformed[i] = (columns[j][j] * rest[i] - columns[j][i] * rest[j]) / determinant;
                    deformed[j] = (columns[i][i] * rest[j] - columns[i][j] * rest[i]) / determinant;
                }
                _ => {}
            }
        }
        deformed
    }

    fn basic_forces(&self, deformations: [f64; BASIC], shear: bool) -> [f64; BASIC] {
        std::array::from_fn(|at| {
            self.with_beam(Known::Deformations(deformations), shear, |graph, beam| beam.basic_force(graph, at))
        })
    }

    /// A value of the member with unit properties, unit moduli and what is known of it.
    fn with_beam(&self, known: Known, shear: bool, value: impl FnOnce(&mut Graph, &Beam<'_>) -> NodeId) -> f64 {
        let (loaded, prepared) = (&self.loaded, &self.statics.members[self.loaded.member as usize]);
        let mut graph = Graph::new();
        let loads = self.loads.map(|value| graph.constant(value));
        let one = graph.constant(1.0);
        let form = unit_form();
        let ones = vec![one; form.dimensions.len()];
        let (deformations, forces) = match known {
            Known::Forces => ([graph.constant(0.0); BASIC], Some(loaded.forces.map(|force| graph.constant(force)))),
            Known::Deformations(deformations) => (deformations.map(|value| graph.constant(value)), None),
        };
        let beam = Beam {
            section: Tapered { form, outline: &[], start: &ones, end: &ones },
            length: graph.constant(prepared.frame.length),
            young: one,
            shear: Some(one),
            components: prepared.components,
            deforms_in_shear: shear,
            grading: &[],
            points: TAPERED,
            loads,
            deformations,
            forces,
        };
        let root = value(&mut graph, &beam);
        graph.evaluate(root, &[], &[])
    }
}

/// What a member's state is told by.
enum Known {
    Forces,
    Deformations([f64; BASIC]),
}

/// What bending and shear in a plane are divided by.
fn planes(vertical: bool) -> [Stiffness; 2] {
    match vertical {
        true => [Stiffness::Vertical, Stiffness::VerticalShear],
        false => [Stiffness::Lateral, Stiffness::LateralShear],
    }
}

/// A form of `general` with every property that members ask for.
fn unit_form() -> &'static Form {
    let forms = sections::kind("general").map_or(&[][..], |kind| kind.forms());
    let asked = ["A", "Ix", "Iy", "J", "Asx", "Asy"];
    let has_all = |form: &&Form| asked.iter().all(|name| form.dimensions.contains(name));
    // `sections::general` has such a form, see its table.
    forms.iter().find(has_all).expect("general sections have a form with all properties")
}
