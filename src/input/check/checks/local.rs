//! Local buckling: limits of width over thickness of every section concerned, once each.

use std::collections::HashSet;

use super::super::Assembly;
use super::Row;
use super::data::Code;
use crate::expression::ast::Collection;
use crate::input::codes::{Web, nonslender, table_5_2};
use crate::input::declaration::checks::CheckEntry;
use crate::input::fields::Scalar;
use crate::problem::Scope;
use crate::problem::checks::Check;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::resolve::ItemScope;

/// ε = √(235 MPa/fy) of Table 5.2.
const REFERENCE_MPA: f64 = 235.0;

impl Assembly<'_> {
    pub(super) fn local_rows(&mut self, entry: &CheckEntry, code: &Code, scope: &ItemScope, check: &mut Check) {
        let fy = match code {
            Code::Euler(_) => return,
            Code::En { fy, .. } | Code::Aisc { fy, .. } => fy,
        };
        if let Code::En { web: None, .. } = code
            && scope.members.iter().any(|&rib| ["h-beam", "box"].contains(&self.kind_at(rib)))
        {
            let message = format!("check `{}` does not say what webs carry: they are taken as compressed throughout", check.name);
            let help = "write web = \"compression\", or web = \"bending\" where the axial force is small";
            self.findings.warning(MistakeCode::BeyondCode, entry.place, message, help);
        }
        // By section and strength: the rows of Table 5.2 hold for all ribs alike.
        let mut known: HashSet<(u32, String)> = HashSet::new();
        let mut list: Vec<(u32, Row)> = Vec::new();
        for &rib in &scope.members {
            let Some(strength) = self.strength(fy, scope, rib) else { return };
            let Some(parts) = self.parts(entry, code, strength, rib, check) else { continue };
            for section in [self.problem.ribs.from[rib as usize], self.problem.ribs.to[rib as usize]] {
                for (clause, require) in &parts {
                    if known.insert((section, require.clone())) {
                        let row = Row {
                            clause: clause.clone(),
                            detail: String::new(),
                            short: require.clone(),
                            require: require.clone(),
                            station: None,
                            names: Vec::new(),
                        };
                        list.push((section, row));
                    }
                }
            }
        }
        for (section, row) in list {
            let items = ItemScope::of(&self.problem, Collection::Sections, vec![section]);
            self.push_row(entry, row, &items, Scope::Sections(vec![section]), check);
        }
    }

    /// The yield strength, which has to be a number here.
    fn strength(&mut self, fy: &Scalar, scope: &ItemScope, rib: u32) -> Option<f64> {
        let found = self.value_of(fy, scope, rib);
        if found.is_none() {
            let help = "limits of width over thickness need a number: give fy as one, or as \"material.fy\"";
            self.findings.mistake(MistakeCode::Check, fy.place(), "this yield strength varies with the design", help);
        }
        found
    }

    /// Clause and requirement of each part of the rib's sections.
    fn parts(&mut self, entry: &CheckEntry, code: &Code, fy: f64, rib: u32, check: &Check) -> Option<Vec<(String, String)>> {
        let kind = self.kind_at(rib);
        let (word, parts) = match code {
            Code::Euler(_) => return None,
            Code::En { class, web, unit, .. } => {
                let epsilon = (REFERENCE_MPA / (fy * unit)).sqrt();
                ("Table 5.2", table_5_2(kind, *class, epsilon, web.unwrap_or(Web::Compression)))
            }
            Code::Aisc { made, .. } => {
                let structure = self.problem.structure.clone()?;
                let material = structure.members.get(structure.member(rib)? as usize)?.material;
                let young = structure.material_number(material, "E");
                let Some(young) = young else {
                    let help = "limits of width over thickness need a number for E";
                    self.findings.mistake(
                        MistakeCode::Material,
                        entry.place,
                        format!("check `{}`: E varies with the design", check.name),
                        help,
                    );
                    return None;
                };
                ("B4.1a", nonslender(kind, young / fy, *made))
            }
        };
        let Some(parts) = parts else {
            let message =
                format!("check `{}`: limits of width over thickness of sections of kind {kind} are not checked", check.name);
            let help =
                "they are of h-beam, box, tee (EN 1993-1-1) and tube; see otherwise to it that these do not buckle locally";
            self.findings.warning(MistakeCode::BeyondCode, entry.place, message, help);
            return None;
        };
        Some(parts.into_iter().map(|(part, require)| (format!("{word} {part}"), require)).collect())
    }
}
