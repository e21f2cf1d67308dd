//! Loads and their combinations, as they are declared.

/// Which axes the components of a load on a member are given in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Axes {
    /// Global axes, per length of the member.
    #[default]
    Global,
    /// The member's axes.
    Local,
    /// Global axes, per length of the member's projection normal to each component.
    Projected,
}

/// What acts where.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Force and moment at a node, global axes.
    Nodal {
        /// The node.
        node: u32,
        /// Force.
        force: [f64; 3],
        /// Moment.
        moment: [f64; 3],
    },
    /// A prescribed displacement of a supported direction.
    Displacement {
        /// The node.
        node: u32,
        /// The direction, 0 to 5.
        direction: u8,
        /// How far.
        value: f64,
    },
    /// A force per length, linear between two fractions of the member.
    Distributed {
        /// The member.
        member: u32,
        /// Axes of the components.
        axes: Axes,
        /// At `from`.
        force: [f64; 3],
        /// At `to`.
        force_end: [f64; 3],
        /// Where it begins, a fraction.
        from: f64,
        /// Where it ends, a fraction.
        to: f64,
    },
    /// A force and a moment at a fraction of a member.
    Point {
        /// The member.
        member: u32,
        /// Axes of the components.
        axes: Axes,
        /// Force.
        force: [f64; 3],
        /// Moment.
        moment: [f64; 3],
        /// Where, a fraction.
        at: f64,
    },
    /// The weight of a member: density times `gravity`.
    SelfWeight {
        /// The member.
        member: u32,
    },
    /// A uniform change of temperature.
    Temperature {
        /// The member.
        member: u32,
        /// How much warmer.
        change: f64,
    },
    /// A temperature that differs between top and bottom.
    Gradient {
        /// The member.
        member: u32,
        /// Top less bottom.
        difference: f64,
    },
    /// The force the member would have between locked ends.
    Pretension {
        /// The member.
        member: u32,
        /// Tension.
        force: f64,
    },
}

impl Action {
    /// Whether it strains members other than by forces.
    pub fn strains(&self) -> bool {
        matches!(
            self,
            Action::Displacement { .. } | Action::Temperature { .. } | Action::Gradient { .. } | Action::Pretension { .. }
        )
    }

    /// The member it acts on.
    pub fn member(&self) -> Option<u32> {
        match self {
            Action::Nodal { .. } | Action::Displacement { .. } => None,
            Action::Distributed { member, .. }
            | Action::Point { member, .. }
            | Action::SelfWeight { member }
            | Action::Temperature { member, .. }
            | Action::Gradient { member, .. }
            | Action::Pretension { member, .. } => Some(*member),
        }
    }
}

/// One load of one case.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// The case.
    pub case: u32,
    /// What it acts on and how.
    pub action: Action,
}

/// Factors over load cases.
#[derive(Debug, Clone)]
pub struct Combination {
    /// Its name.
    pub name: Box<str>,
    /// Cases and their factors.
    pub factors: Vec<(u32, f64)>,
}
