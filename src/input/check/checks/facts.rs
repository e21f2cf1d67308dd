//! What rows of a check depend on besides its data, rib by rib.

use std::collections::HashSet;

use super::super::Assembly;
use super::data::Code;
use super::{Effects, Known, Places, Row, Where};
use crate::expression::ast::Collection;
use crate::input::codes::{AXES, Axis, Bending, En, JOIN, Ltb};
use crate::input::declaration::checks::CheckEntry;
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::range::Ranges;
use crate::problem::resolve::ItemScope;
use crate::problem::structure::{Action, Plane, Structure};
use crate::sections;

/// Kinds that are symmetric about both axes, so that they buckle about these without twisting, or nearly so.
const DOUBLY_SYMMETRIC: [&str; 7] = ["h-beam", "box", "tube", "circle", "rectangle", "superellipse", "general"];
/// Kinds that Annex B has factors for.
const ANNEX_B: [&str; 3] = ["h-beam", "box", "tube"];

/// Ribs of which these are equal have the same rows.
#[derive(Clone, PartialEq)]
pub(super) struct Facts {
    case: String,
    rib: Option<String>,
    pub tapered: bool,
    bends: bool,
    loaded: bool,
    space: bool,
    open: bool,
    slender: [bool; 2],
    stocky: [bool; 3],
    stations: Vec<f64>,
}

impl Facts {
    /// The rows: of a tapered rib with the critical forces of either end.
    pub fn rows(&self, code: &Code) -> Vec<Row> {
        let effects = Effects { case: self.case.clone(), rib: self.rib.clone() };
        let places = Places::of(self.loaded, self.tapered, &self.stations);
        let known = Known { space: self.space, open: self.open, slender: self.slender, stocky: self.stocky };
        let ends: &[(Where, &str)] = if self.tapered {
            &[
                (Where { section: "at", critical: "from" }, ", as its start"),
                (Where { section: "at", critical: "to" }, ", as its end"),
            ]
        } else {
            &[(Where { section: "from", critical: "from" }, "")]
        };
        let mut rows = Vec::new();
        for &(at, tag) in ends {
            match code {
                Code::Euler(euler) => rows.extend(euler.rows(&effects, &places, at, tag)),
                Code::Aisc { aisc, .. } => rows.extend(aisc.rows(&effects, &places, at, self.slender, tag)),
                Code::En { en, bending, .. } => {
                    rows.extend(en.rows(&effects, &places, at, tag));
                    if let Some(bending) = bending.as_ref().filter(|_| self.bends) {
                        rows.extend(en.moment_rows(bending, &effects, &places, at, known, tag));
                    }
                }
            }
        }
        rows
    }
}

impl Facts {
    /// Which side of a code's joins was taken by where the design starts, in words.
    pub fn sides(&self, code: &Code) -> Option<String> {
        let side = |axis: usize, below: &str, above: &str| if self.slender[axis] { above.to_owned() } else { below.to_owned() };
        match code {
            Code::En { bending: Some(bending), .. } if bending.cm.is_some() && self.bends => {
                let (y, z) = (side(0, "at most 1", "above 1"), side(1, "at most 1", "above 1"));
                Some(format!("k_yy as for lambda_y {y}, k_zz as for lambda_z {z}, as at the start"))
            }
            Code::Aisc { .. } if self.slender.contains(&true) => {
                let (y, z) = (side(0, "below", "beyond"), side(1, "below", "beyond"));
                Some(format!("{y} the join of E3 about y, {z} it about z, as at the start"))
            }
            _ => None,
        }
    }
}

impl Code {
    /// The clauses, as reports name them.
    pub(super) fn clauses(&self) -> String {
        match self {
            Code::Euler(_) => "N ≤ π²EI/L² about both axes".into(),
            Code::Aisc { .. } => "E3 (flexural buckling), Table B4.1a".into(),
            Code::En { bending, class, .. } => {
                let mut list = vec!["6.3.1".to_owned()];
                if let Some(bending) = bending {
                    list.extend(match bending.ltb {
                        Ltb::Held => None,
                        Ltb::Given { rolled: true, .. } => Some("6.3.2.3".to_owned()),
                        Ltb::Given { .. } => Some("6.3.2.2".to_owned()),
                    });
                    list.extend(bending.cm.map(|_| "6.3.3 with Annex B".to_owned()));
                }
                list.push(format!("Table 5.2 class {class}"));
                list.join(", ")
            }
        }
    }
}

impl Assembly<'_> {
    pub(super) fn facts(&mut self, code: &Code, rib: u32, case: u32, loaded: &HashSet<u32>) -> Facts {
        let structure = self.problem.structure.clone().unwrap_or_default();
        let own = ItemScope::of(&self.problem, Collection::Ribs, vec![rib]);
        let (from, to) = (self.problem.ribs.from[rib as usize], self.problem.ribs.to[rib as usize]);
        let member = structure.member(rib).unwrap_or_default();
        let of_forces = ["N", "My", "Mz"].iter().any(|word| self.names.ribs.find(&self.problem.ribs.names, word).is_some());
        let name = self.problem.item_name(Collection::Ribs, rib).to_owned();
        let (slender, stocky) = self.slenderness(code, &own, rib);
        Facts {
            case: structure.load_set_name(case).to_owned(),
            rib: of_forces.then_some(name),
            tapered: from != to,
            bends: structure.members.get(member as usize).is_some_and(|member| !member.pinned),
            loaded: loaded.contains(&member),
            space: structure.plane == Plane::Space,
            open: self.kind_at(rib) == "h-beam",
            slender,
            stocky,
            stations: structure.stations.clone(),
        }
    }

    pub(super) fn kind_at(&self, rib: u32) -> &'static str {
        sections::kind_of(self.problem.sections.form[self.problem.ribs.from[rib as usize] as usize]).name()
    }

    /// On which side of the codes' joins the rib starts, and which plateaus it may reach.
    fn slenderness(&mut self, code: &Code, own: &ItemScope, rib: u32) -> ([bool; 2], [bool; 3]) {
        let at = Where { section: "from", critical: "from" };
        let effects = Effects { case: String::new(), rib: None };
        match code {
            Code::Euler(_) => ([false; 2], [true; 3]),
            Code::Aisc { aisc, .. } => {
                let beyond = [0, 1].map(|axis| {
                    let lets = aisc.lets(axis, &effects, 0.0, at);
                    let text = lets.map(|lets| lets.whole(&format!("$Fy/$Fe_{}", AXES[axis].0)));
                    text.and_then(|text| self.at_start(&text, own, rib))
                        .is_some_and(|value| value > (JOIN / std::f64::consts::PI).powi(2))
                });
                (beyond, [true; 3])
            }
            Code::En { en, bending, .. } => {
                let slender = [0, 1].map(|axis| match &en.axes[axis] {
                    Axis::Length { .. } => {
                        let text = en.lets(&effects, 0.0, at).whole(&format!("$lambda_{}", AXES[axis].0));
                        self.at_start(&text, own, rib).is_some_and(|value| value > 1.0)
                    }
                    _ => false,
                });
                (slender, self.stocky(en, bending.as_ref(), own, rib))
            }
        }
    }

    fn at_start(&mut self, text: &str, own: &ItemScope, rib: u32) -> Option<f64> {
        let formula = self.quietly(text, own)?;
        Evaluation::at_start(&self.problem).value(&formula, Item::Rib(rib))
    }

    /// Whether λ̄_y, λ̄_z, λ̄_LT may lie below their plateaus somewhere within the bounds. A radius of gyration is at most half the extent.
    fn stocky(&mut self, en: &En, bending: Option<&Bending>, own: &ItemScope, rib: u32) -> [bool; 3] {
        let square = |length: &str, extent: &str| format!("4*({})*({length})^2/(pi^2*material.E*{extent}^2)", en.fy);
        let mut least = |text: String, plateau: f64| {
            let formula = self.quietly(&text, own);
            !formula
                .is_some_and(|formula| Ranges::default().of(&self.problem, &formula, Item::Rib(rib)).lower >= plateau * plateau)
        };
        let mut of_axis = |axis: usize, extent: &str| match &en.axes[axis] {
            // The larger extent of the two ends: both have to be slender.
            Axis::Length { length, .. } => {
                ["from", "to"].iter().any(|end| least(square(length, &format!("{end}.{extent}")), 0.2))
            }
            _ => true,
        };
        let (y, z) = (of_axis(0, "height"), of_axis(1, "width"));
        let lateral = match bending.map(|bending| (&bending.ltb, bending)) {
            Some((Ltb::Given { plateau: [plateau, _], .. }, bending)) => ["from", "to"].iter().any(|end| {
                let mut lets = en.lets(&Effects { case: String::new(), rib: None }, 0.0, Where { section: end, critical: end });
                bending.lateral(Where { section: end, critical: end }, &mut lets);
                least(lets.whole("$lambda_LT^2"), *plateau)
            }),
            _ => true,
        };
        [y, z, lateral]
    }

    /// Whether the code speaks of such ribs: mistakes where it does not, warnings where it is stretched.
    pub(super) fn suits(&mut self, entry: &CheckEntry, code: &Code, scope: &ItemScope, what: &str) -> bool {
        let place = entry.place;
        let tapered: Vec<u32> = scope.members.iter().copied().filter(|&rib| self.is_tapered(rib)).collect();
        if let (Some(&rib), false) = (tapered.first(), matches!(code, Code::Euler(_))) {
            let name = self.problem.item_name(Collection::Ribs, rib);
            let more = if tapered.len() > 1 { format!(" (and {} more)", tapered.len() - 1) } else { String::new() };
            let clauses = if matches!(code, Code::En { .. }) { "6.3.1 to 6.3.3 are" } else { "E3 is" };
            let message = format!("rib `{name}`{more} of {what} is tapered, and {clauses} for uniform members");
            let help = "every station is held by its own A, W and forces, with the critical forces of a uniform rib of either end's section, \
                        which is safe but no rule of the code; cut the rib into uniform ones, or use length = \"system\"";
            self.findings.warning(MistakeCode::BeyondCode, place, message, help);
        }
        let planar = self.problem.structure.as_deref().is_some_and(|structure| structure.plane != Plane::Space);
        if let (true, Code::En { en, .. }) = (planar, code)
            && matches!(en.axes[1], Axis::System { .. })
        {
            let message =
                format!("{what}: a plane structure's factor knows nothing of buckling out of its plane, which is about z");
            self.findings.mistake(MistakeCode::Check, place, message, "give z a length, or \"held\"");
            return false;
        }
        let kinds: Vec<&str> = scope.members.iter().map(|&rib| self.kind_at(rib)).collect();
        let stranger = |known: &[&str]| kinds.iter().copied().find(|kind| !known.contains(kind));
        if let Some(kind) = stranger(&DOUBLY_SYMMETRIC) {
            let message = format!("{what}: sections of kind {kind} may twist as they buckle, which is not checked");
            self.findings.warning(
                MistakeCode::BeyondCode,
                place,
                message,
                "only buckling about the section's own axes x and y is",
            );
        }
        let bending = if let Code::En { bending, .. } = code { bending.as_ref() } else { None };
        let Some(bending) = bending else { return true };
        if let (Ltb::Given { .. }, Some(kind)) = (&bending.ltb, stranger(&["h-beam"])) {
            let message = format!("{what}: M_cr is known for doubly symmetric H beams, not for kind {kind}");
            self.findings.mistake(
                MistakeCode::Check,
                place,
                message,
                "write ltb = \"held\" for hollow and solid sections, or check these ribs apart",
            );
            return false;
        }
        if let (Some(_), Some(kind)) = (bending.cm, stranger(&ANNEX_B)) {
            let message = format!("{what}: Annex B has no factors for sections of kind {kind}");
            self.findings.mistake(
                MistakeCode::Check,
                place,
                message,
                format!("it has them for {}; leave `Cm` out", ANNEX_B.join(", ")),
            );
            return false;
        }
        true
    }

    fn is_tapered(&self, rib: u32) -> bool {
        self.problem.ribs.from[rib as usize] != self.problem.ribs.to[rib as usize]
    }
}

/// The members on whose spans something acts in one of the cases of a load set.
pub(super) fn loaded(structure: &Structure, set: u32) -> HashSet<u32> {
    let first = structure.cases.len() as u32;
    let combination = set.checked_sub(first).and_then(|at| structure.combinations.get(at as usize));
    let counts = |case: u32| match combination {
        None => case == set,
        Some(combination) => combination.factors.iter().any(|(one, factor)| *one == case && *factor != 0.0),
    };
    let spans = structure.loads.iter().filter(|load| counts(load.case)).filter_map(|load| match load.action {
        Action::Distributed { member, .. } | Action::Point { member, .. } | Action::SelfWeight { member } => Some(member),
        Action::Nodal { .. }
        | Action::Displacement { .. }
        | Action::Temperature { .. }
        | Action::Gradient { .. }
        | Action::Pretension { .. } => None,
    });
    spans.collect()
}
