//! EN 1993-1-1:2005, 6.3.2 and 6.3.3: lateral-torsional buckling, and its interaction with flexural buckling by Annex B.
//!
//! M_cr = C1·π²E·Iz/L²·√(Iw/Iz + L²·G·It/(π²E·Iz)) of a doubly symmetric section loaded in its shear centre, with forked ends (k = k_w = 1).
//! χ_LT by (6.56) or (6.57): at most 1 and, by the latter, at most 1/λ̄_LT²; f of 6.3.2.3 (2) is left at 1, which is safe.

use super::en1993::En;
use super::lets::plain;
use super::{Axis, Effects, Lets, Places, Row, Where};

/// Data of a check's moments.
pub(in crate::input) struct Bending {
    /// 1, 2 or 3.
    pub class: u8,
    /// Lateral-torsional buckling.
    pub ltb: Ltb,
    /// C_my, C_mz and C_mLT, where interaction is checked.
    pub cm: Option<[f64; 3]>,
}

/// Lateral-torsional buckling.
pub(in crate::input) enum Ltb {
    /// There is none: the compressed flange is held, or the section is hollow or solid.
    Held,
    Given {
        length: String,
        c1: f64,
        alpha: f64,
        /// λ̄_LT,0 and β: 0.2 and 1 of 6.3.2.2, or those of 6.3.2.3.
        plateau: [f64; 2],
        /// Whether 1/λ̄_LT² limits χ_LT too (6.3.2.3).
        rolled: bool,
    },
}

/// What is known of the rib beyond its names.
#[derive(Clone, Copy)]
pub(in crate::input) struct Known {
    /// Three dimensions: moments about both axes.
    pub space: bool,
    /// Whether its sections are H beams rather than hollow or solid.
    pub open: bool,
    /// λ̄ about y and z above 1 at the start: there the other bound of Annex B's factors is the smaller one.
    pub slender: [bool; 2],
    /// Whether λ̄_y, λ̄_z and λ̄_LT may come below the plateau, where χ = 1.
    pub stocky: [bool; 3],
}

const LETTERS: [(f64, &str); 2] = [(1.0, "+"), (-1.0, "-")];

impl Bending {
    fn moduli(&self, section: &str) -> [String; 2] {
        let names = if self.class < 3 { ["Wplx", "Wply"] } else { ["Wx", "Wy"] };
        names.map(|name| format!("{section}.{name}"))
    }

    /// M_cr, λ̄_LT, Φ_LT and χ_LT.
    pub fn lateral(&self, at: Where, lets: &mut Lets) {
        let Ltb::Given { length, c1, alpha, plateau: [least, beta], .. } = &self.ltb else {
            return lets.name("chi_LT", "1");
        };
        let (c, [w, _]) = (at.critical, self.moduli(at.section));
        lets.name("N_z", format!("pi^2*material.E*{c}.Iy/({length})^2"));
        lets.name("M_cr", format!("{c1}*$N_z*sqrt({c}.Iw/{c}.Iy + material.G*{c}.J/$N_z)"));
        lets.name("lambda_LT", format!("sqrt({w}*$fy/$M_cr)"));
        lets.name("phi_LT", format!("0.5*(1 + {alpha}*($lambda_LT - {least}) + {beta}*$lambda_LT^2)"));
        lets.name("chi_LT", format!("1/($phi_LT + sqrt($phi_LT^2 - {beta}*$lambda_LT^2))"));
    }

    /// The expressions of which χ_LT is the least.
    fn bounds(&self, known: Known) -> Vec<Option<&'static str>> {
        let Ltb::Given { rolled, .. } = self.ltb else { return vec![None] };
        let stocky = known.stocky[2].then_some(Some("1"));
        let slender = rolled.then_some(Some("1/$lambda_LT^2"));
        [None].into_iter().chain(stocky).chain(slender).collect()
    }
}

impl En {
    /// Rows of 6.3.2 and 6.3.3 of a rib under a case.
    pub fn moment_rows(
        &self,
        bending: &Bending,
        effects: &Effects,
        places: &Places,
        at: Where,
        known: Known,
        tag: &str,
    ) -> Vec<Row> {
        let mut rows = self.alone(bending, effects, places, at, known.space, tag);
        if let Some(cm) = bending.cm {
            for (n, y, z) in places.joined(known.space) {
                for (sy, letter) in LETTERS {
                    for (sz, other) in if z.is_some() { &LETTERS[..] } else { &LETTERS[..1] } {
                        let mut lets = self.lets(effects, n, at);
                        bending.lateral(at, &mut lets);
                        lets.name("M_y", effects.force("My", y, sy));
                        let about_z = z.map(|z| format!(", {other}Mz at {z}")).unwrap_or_default();
                        if let Some(z) = z {
                            lets.name("M_z", effects.force("Mz", z, *sz));
                        }
                        let detail = format!("{}, {y}, {letter}My{about_z}, N at {n}{tag}", effects.case);
                        rows.extend(self.joined(bending, cm, &lets, at, known, (detail, y)));
                    }
                }
            }
        }
        rows
    }

    /// Each moment alone: 6.3.2, and the section's own resistance.
    fn alone(&self, bending: &Bending, effects: &Effects, places: &Places, at: Where, space: bool, tag: &str) -> Vec<Row> {
        let (mut rows, [w_y, w_z], gamma) = (Vec::new(), bending.moduli(at.section), self.gamma);
        for &station in &places.bending {
            for (sign, letter) in LETTERS {
                let mut lets = self.lets(effects, 0.0, at);
                bending.lateral(at, &mut lets);
                lets.name("M_y", effects.force("My", station, sign));
                lets.name("M_z", effects.force("Mz", station, sign));
                let mut row = |clause: &str, moment: &str, short: String| {
                    let detail = format!("{}, {station}, {letter}{moment}{tag}", effects.case);
                    rows.push(Row::new(&lets, clause, detail, &short, Some(station)));
                };
                if let Ltb::Given { rolled, .. } = bending.ltb {
                    let clause = if rolled { "6.3.2.3" } else { "6.3.2.2" };
                    row(clause, "My", format!("$M_y <= $chi_LT*{w_y}*$fy/{gamma}"));
                    if rolled {
                        row("6.3.2.3 slender", "My", format!("$M_y <= $M_cr/{gamma}"));
                    }
                }
                row("6.3.2 cap", "My", format!("$M_y <= {w_y}*$fy/{gamma}"));
                if space {
                    row("6.3.3 cap", "Mz", format!("$M_z <= {w_z}*$fy/{gamma}"));
                }
            }
        }
        rows
    }

    /// (6.61) and (6.62), once for every set of bounds on χ and k that may be the one.
    fn joined(
        &self,
        bending: &Bending,
        cm: [f64; 3],
        lets: &Lets,
        at: Where,
        known: Known,
        (detail, station): (String, f64),
    ) -> Vec<Row> {
        let mut rows: Vec<Row> = Vec::new();
        for (clause, short) in [
            ("6.61", ["$n_y + $k_yy*$m_y <= 1", "$n_y + $k_yy*$m_y + $k_yz*$m_z <= 1"]),
            ("6.62", ["$n_z + $k_zy*$m_y <= 1", "$n_z + $k_zy*$m_y + $k_zz*$m_z <= 1"]),
        ] {
            for bounds in self.bounds(bending, known, clause == "6.61") {
                let mut lets = lets.clone();
                bounds.name(&mut lets);
                factors(self, bending, cm, at, known, bounds.turn, &mut lets);
                let words = bounds.words();
                let detail = if words.is_empty() { detail.clone() } else { format!("{detail}, {words}") };
                rows.push(Row::new(&lets, clause, detail, short[usize::from(known.space)], Some(station)));
            }
        }
        rows
    }

    /// Every set of bounds that may decide (6.61), `first`, or (6.62).
    fn bounds(&self, bending: &Bending, known: Known, first: bool) -> Vec<Bounds> {
        let torsion = matches!(bending.ltb, Ltb::Given { .. });
        let of_axis = |axis: usize, counts: bool| match (&self.axes[axis], counts && known.stocky[axis]) {
            (Axis::Held, _) | (_, false) => vec![false],
            _ => vec![false, true],
        };
        let turns: &[Option<&'static str>] = if first || !torsion { &[None] } else { &[Some("$lambda_z"), Some("1")] };
        let mut list = Vec::new();
        for y in of_axis(0, first || !torsion) {
            for z in of_axis(1, !first || known.space) {
                for lateral in bending.bounds(known) {
                    list.extend(turns.iter().map(|&turn| Bounds { whole: [y, z], lateral, turn }));
                }
            }
        }
        list
    }
}

/// Which of several bounds a row takes.
struct Bounds {
    /// χ = 1 about y and z.
    whole: [bool; 2],
    /// What χ_LT is, where it is not its formula.
    lateral: Option<&'static str>,
    /// λ̄_z of k_zy in Table B.2, or 1 beyond which it no longer counts.
    turn: Option<&'static str>,
}

impl Bounds {
    fn name(&self, lets: &mut Lets) {
        let whole = self.whole.iter().zip(["chi_y", "chi_z"]).filter(|(whole, _)| **whole).map(|(_, name)| (name, "1"));
        whole.chain(self.lateral.map(|bound| ("chi_LT", bound))).for_each(|(name, text)| lets.name(name, text));
    }

    fn words(&self) -> String {
        let parts = [
            self.whole[0].then(|| "chi_y = 1".to_owned()),
            self.whole[1].then(|| "chi_z = 1".to_owned()),
            self.lateral.map(|bound| format!("chi_LT = {}", plain(bound))),
            self.turn.filter(|turn| *turn == "1").map(|_| "k_zy at lambda_z = 1".to_owned()),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// Utilisations n and m, and k of Tables B.1 and B.2; `turn` as in [`Bounds`].
fn factors(en: &En, bending: &Bending, [cy, cz, clt]: [f64; 3], at: Where, known: Known, turn: Option<&str>, lets: &mut Lets) {
    let ([w_y, w_z], gamma, a) = (bending.moduli(at.section), en.gamma, at.section);
    let elastic = bending.class == 3;
    lets.name("n_y", format!("$N*{gamma}/($chi_y*{a}.A*$fy)"));
    lets.name("n_z", format!("$N*{gamma}/($chi_z*{a}.A*$fy)"));
    lets.name("m_y", format!("$M_y*{gamma}/($chi_LT*{w_y}*$fy)"));
    lets.name("m_z", format!("$M_z*{gamma}/({w_z}*$fy)"));
    let slope = |axis: usize, n: &str, doubled: bool| match (elastic, known.slender[axis], doubled) {
        (true, false, _) => format!("0.6*$lambda_{n}"),
        (true, true, _) => "0.6".to_owned(),
        (false, false, false) => format!("($lambda_{n} - 0.2)"),
        (false, true, false) => "0.8".to_owned(),
        (false, false, true) => format!("(2*$lambda_{n} - 0.6)"),
        (false, true, true) => "1.4".to_owned(),
    };
    lets.name("k_yy", format!("{cy}*(1 + {}*$n_y)", slope(0, "y", false)));
    lets.name("k_zz", format!("{cz}*(1 + {}*$n_z)", slope(1, "z", known.open)));
    lets.name("k_yz", if elastic { "$k_zz" } else { "0.6*$k_zz" });
    let factor = if elastic { 0.05 } else { 0.1 };
    match turn {
        None => lets.name("k_zy", if elastic { "0.8*$k_yy" } else { "0.6*$k_yy" }),
        Some(slenderness) => lets.name("k_zy", format!("1 - {factor}*{slenderness}*$n_z/({clt} - 0.25)")),
    }
}
