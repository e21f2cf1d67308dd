//! One cross-section in numbers: its dimensions, its properties, its outline.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use crate::expression::ast::Collection;
use crate::geometry::polygon::Ring;
use crate::problem::Problem;
use crate::problem::evaluate::Evaluation;
use crate::report::number::short;
use crate::report::text::TextTable;
use crate::sections::{self, Form};

/// A section at numeric dimensions.
#[derive(Debug, Clone, Serialize)]
pub struct CrossSection {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: &'static str,
    /// Names and values of the given dimensions.
    #[serde(serialize_with = "as_map")]
    pub dimensions: Vec<(&'static str, f64)>,
    /// Names and values of everything else it offers; `None` where there is no value.
    #[serde(serialize_with = "as_map")]
    pub properties: Vec<(&'static str, Option<f64>)>,
    /// What is wrong with it at these dimensions.
    pub defect: Option<String>,
    /// Points it is drawn by, for each ring: the outer one or the line, then the holes.
    #[serde(flatten, serialize_with = "as_points_and_holes")]
    pub outline: Vec<Ring>,
    #[serde(skip)]
    form: &'static Form,
}

/// Pairs as a JSON object, in their order.
fn as_map<T: Serialize, S: Serializer>(pairs: &[(&'static str, T)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}

/// `points` and `holes`, as in the problem file.
fn as_points_and_holes<S: Serializer>(outline: &[Ring], serializer: S) -> Result<S::Ok, S::Error> {
    let (points, holes) = outline.split_first().map_or((&[][..], &[][..]), |(first, holes)| (first.as_slice(), holes));
    let mut object = serializer.serialize_struct("outline", 2)?;
    object.serialize_field("points", points)?;
    object.serialize_field("holes", holes)?;
    object.end()
}

impl CrossSection {
    /// A section by form, dimensions in the form's order, and rings of points.
    ///
    /// ```
    /// use ribopt::{report::cross_section::CrossSection, sections::kind};
    /// let form = &kind("rectangle").unwrap().forms()[0];
    /// let section = CrossSection::new("s", form, &[0.2, 0.5], &[]).unwrap();
    /// assert_eq!(section.properties[0], ("A", Some(0.1)));
    /// assert!(CrossSection::new("s", form, &[0.2], &[]).is_none());
    /// ```
    pub fn new(name: &str, form: &'static Form, given: &[f64], outline: &[Ring]) -> Option<CrossSection> {
        let kind = sections::kind(form.kind).filter(|_| given.len() == form.dimensions.len())?;
        let known = sections::values(kind, form, given, outline);
        let value = |name: &'static str| known.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
        let offered = |name: &&'static str| !form.dimensions.contains(name) && sections::offers(form, name);
        let others = kind.properties().iter().copied().filter(offered);
        Some(CrossSection {
            name: name.to_owned(),
            kind: kind.name(),
            dimensions: form.dimensions.iter().copied().zip(given.iter().copied()).collect(),
            properties: others.map(|name| (name, value(name).filter(|value| value.is_finite()))).collect(),
            defect: kind.defect(form, given, outline),
            outline: outline.to_vec(),
            form,
        })
    }

    /// Section s of a problem where the variables are x; `None` where a dimension has no value.
    pub fn of(problem: &Problem, s: u32, x: &[f64]) -> Option<CrossSection> {
        let form = sections::form(*problem.sections.form.get(s as usize)?);
        let evaluation = Evaluation::at(problem, x);
        let given: Option<Vec<f64>> =
            problem.dimensions(s as usize).iter().map(|&dimension| evaluation.dimension(s, dimension)).collect();
        CrossSection::new(problem.item_name(Collection::Sections, s), form, &given?, problem.outline(s))
    }

    /// A property or dimension.
    pub fn value(&self, name: &str) -> Option<f64> {
        let given = self.dimensions.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
        given.or_else(|| self.properties.iter().find(|(known, _)| *known == name)?.1)
    }

    /// The boundary: outer ring anticlockwise, holes clockwise, about the centroid; curves to a thousandth of the section's size.
    pub fn rings(&self) -> Vec<Ring> {
        let given: Vec<f64> = self.dimensions.iter().map(|(_, value)| *value).collect();
        if self.defect.is_some() {
            return Vec::new();
        }
        let size = self.value("height").unwrap_or(0.0).max(self.value("width").unwrap_or(0.0));
        sections::kind(self.kind).map_or_else(Vec::new, |kind| kind.rings(self.form, &given, &self.outline, 1e-3 * size))
    }

    /// The numbers as a table for people.
    pub fn table(&self) -> String {
        let mut table = TextTable::new(1, &["name", "value"]);
        for (name, value) in &self.dimensions {
            table.add(vec![(*name).to_owned(), short(*value)]);
        }
        for (name, value) in &self.properties {
            table.add(vec![(*name).to_owned(), short(value.unwrap_or(f64::NAN))]);
        }
        let defect = self.defect.iter().map(|defect| format!("not valid: {defect}\n")).collect::<String>();
        format!("{} ({})\n{defect}{table}", self.name, self.kind)
    }
}
