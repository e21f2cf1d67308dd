//! What a load does: read from the keys that are given.

use super::super::super::Assembly;
use crate::input::declaration::Name;
use crate::input::declaration::structure::LoadEntry;
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::structure::Axes;
use crate::problem::words::brief;

/// What a load does, before its targets are known.
#[derive(Clone)]
pub(in crate::input::check) enum Effect {
    /// Force and moment at nodes.
    Nodal {
        force: [f64; 3],
        moment: [f64; 3],
    },
    /// Displacements of supported directions.
    Displacement(Vec<(u8, f64)>),
    Distributed {
        axes: Axes,
        force: [f64; 3],
        force_end: [f64; 3],
        from: f64,
        to: f64,
    },
    Point {
        axes: Axes,
        force: [f64; 3],
        moment: [f64; 3],
        at: f64,
    },
    SelfWeight,
    Temperature(f64),
    Gradient(f64),
    Pretension(f64),
}

impl Effect {
    /// Whether it bends a member between its ends, which a bar cannot bear.
    pub(super) fn bends(&self) -> Option<&'static str> {
        match self {
            Effect::Distributed { .. } => Some("a load along a bar"),
            Effect::Point { .. } => Some("a load within a bar"),
            Effect::Gradient(_) => Some("a gradient of temperature in a bar"),
            _ => None,
        }
    }
}

impl Assembly<'_> {
    /// What a load does; `None` after a mistake.
    pub(super) fn effect(&mut self, entry: &LoadEntry) -> Option<Effect> {
        self.one_kind(entry)?;
        if entry.self_weight.is_some() {
            return Some(Effect::SelfWeight);
        }
        if let Some(scalar) = &entry.temperature {
            return self.finite(scalar).map(Effect::Temperature);
        }
        if let Some(scalar) = &entry.gradient {
            return self.finite(scalar).map(Effect::Gradient);
        }
        if let Some(scalar) = &entry.pretension {
            return self.finite(scalar).map(Effect::Pretension);
        }
        if let Some(list) = &entry.displacement {
            return self.displacements(list).map(Effect::Displacement);
        }
        match &entry.nodes {
            Some(_) => self.nodal(entry),
            None => self.spanning(entry),
        }
    }

    /// A load is of exactly one kind.
    pub(super) fn one_kind(&mut self, entry: &LoadEntry) -> Option<()> {
        let force = entry.force.as_ref().or(entry.moment.as_ref()).map(|vector| ("`force`", vector.place));
        let scalar = |scalar: &Option<Scalar>, word| scalar.as_ref().map(|scalar| (word, scalar.place()));
        let displacement = entry.displacement.as_ref().map(|list| list.first().map_or(entry.place, |(name, _)| name.place));
        let kinds: Vec<(&str, Place)> = [
            entry.self_weight.map(|place| ("`self_weight`", place)),
            force,
            scalar(&entry.temperature, "`temperature`"),
            scalar(&entry.gradient, "`gradient`"),
            scalar(&entry.pretension, "`pretension`"),
            displacement.map(|place| ("`displacement`", place)),
        ]
        .into_iter()
        .flatten()
        .collect();
        match kinds.as_slice() {
            [_] => Some(()),
            [] if entry.acts => None,
            [] => {
                let help = "known: force, moment, self_weight, temperature, gradient, pretension, displacement";
                self.findings.mistake(MistakeCode::Load, entry.place, "this load says nothing that acts", help);
                None
            }
            [(first, _), (second, place), ..] => {
                let message = format!("{first} and {second} in one load");
                self.findings.mistake(MistakeCode::BothGiven, *place, message, "write a [[loads]] of its own for each");
                None
            }
        }
    }

    pub(super) fn nodal(&mut self, entry: &LoadEntry) -> Option<Effect> {
        let along = [&entry.from, &entry.to, &entry.at].into_iter().flatten().map(Scalar::place);
        let along = along.chain(entry.force_end.as_ref().map(|vector| vector.place));
        for place in along.chain(entry.axes.as_ref().map(|axes| axes.place)) {
            self.findings.mistake(
                MistakeCode::Load,
                place,
                "this belongs to a load on ribs",
                "leave it out: forces at nodes have global axes",
            );
        }
        let force = entry.force.as_ref().map_or(Some([0.0; 3]), |force| self.along(force, "force"));
        let moment = entry.moment.as_ref().map_or(Some([0.0; 3]), |moment| self.about(moment, false));
        Some(Effect::Nodal { force: force?, moment: moment? })
    }

    pub(super) fn spanning(&mut self, entry: &LoadEntry) -> Option<Effect> {
        let axes = entry.axes.as_ref().map_or(Some(Axes::Global), |written| self.axes(written));
        let local = axes == Some(Axes::Local);
        let mut along = |vector: &Option<_>, what: &str| match vector {
            Some(vector) if local => self.along_member(vector, what).map(Some),
            Some(vector) => self.along(vector, what).map(Some),
            None => Some(None),
        };
        let (force, force_end) = (along(&entry.force, "force"), along(&entry.force_end, "force_end"));
        let moment = entry.moment.as_ref().map_or(Some(None), |moment| self.about(moment, local).map(Some));
        let (axes, force, force_end, moment) = (axes?, force?, force_end?, moment?);
        if let Some(at) = &entry.at {
            return self.point(entry, axes, at, force, moment);
        }
        if let Some(moment) = &entry.moment {
            self.findings.mistake(
                MistakeCode::Load,
                moment.place,
                "a moment on a rib needs `at`",
                "add at = …, a fraction of the rib's length",
            );
            return None;
        }
        let force = force?;
        let from = entry.from.as_ref().map_or(Some(0.0), |from| self.fraction(from, "from"));
        let to = entry.to.as_ref().map_or(Some(1.0), |to| self.fraction(to, "to"));
        let (from, to) = (from?, to?);
        if from >= to {
            let place = entry.to.as_ref().or(entry.from.as_ref()).map_or(entry.place, Scalar::place);
            self.findings.mistake(
                MistakeCode::OutOfRange,
                place,
                format!("a load from {from} to {to}"),
                "`from` comes before `to`",
            );
            return None;
        }
        Some(Effect::Distributed { axes, force, force_end: force_end.unwrap_or(force), from, to })
    }

    pub(super) fn point(
        &mut self,
        entry: &LoadEntry,
        axes: Axes,
        at: &Scalar,
        force: Option<[f64; 3]>,
        moment: Option<[f64; 3]>,
    ) -> Option<Effect> {
        let along = [&entry.from, &entry.to].into_iter().flatten().map(Scalar::place);
        for place in along.chain(entry.force_end.as_ref().map(|vector| vector.place)) {
            self.findings.mistake(
                MistakeCode::BothGiven,
                place,
                "a force at a point has no extent",
                "keep either `at` or `from`, `to`, `force_end`",
            );
        }
        let at = self.fraction(at, "at")?;
        Some(Effect::Point { axes, force: force.unwrap_or_default(), moment: moment.unwrap_or_default(), at })
    }

    pub(in crate::input::check) fn axes(&mut self, written: &Written) -> Option<Axes> {
        match written.text.as_str() {
            "global" => Some(Axes::Global),
            "local" => Some(Axes::Local),
            "projected" => Some(Axes::Projected),
            _ => self.unknown_word(written, "axes", &["global", "local", "projected"]),
        }
    }

    /// A fraction of a rib's length.
    pub(in crate::input::check) fn fraction(&mut self, scalar: &Scalar, key: &str) -> Option<f64> {
        let value = self.finite(scalar)?;
        if (0.0..=1.0).contains(&value) {
            return Some(value);
        }
        let message = format!("`{key}` cannot be {}", brief(value));
        self.findings.mistake(
            MistakeCode::OutOfRange,
            scalar.place(),
            message,
            "expected a fraction of the rib's length, from 0 to 1",
        );
        None
    }

    pub(super) fn displacements(&mut self, list: &[(Name, Scalar)]) -> Option<Vec<(u8, f64)>> {
        let each = list.iter().map(|(name, scalar)| {
            let (direction, value) = (self.direction(&name.text, name.place), self.finite(scalar));
            Some((direction? as u8, value?))
        });
        each.collect::<Vec<_>>().into_iter().collect()
    }
}
