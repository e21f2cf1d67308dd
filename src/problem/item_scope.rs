//! The items whose own names hold in an expression.

use std::collections::BTreeSet;

use crate::expression::ast::Collection;
use crate::problem::Problem;
use crate::sections;

/// Sections or ribs, and the kinds of section met among them.
#[derive(Debug, Clone)]
pub struct ItemScope {
    /// Sections or ribs.
    pub collection: Collection,
    /// Their numbers, ascending.
    pub members: Vec<u32>,
    /// Forms of the sections (of ribs: at their ends), ascending.
    forms: BTreeSet<u16>,
    /// True where the rows are groups of items.
    pub grouped: bool,
    /// The dimension whose expression this is. Its own name, and properties that follow from it, give way to global ones:
    /// `b = "b"`, `b = "width"`.
    pub itself: Option<&'static str>,
}

impl ItemScope {
    /// The scope of these items.
    pub fn of(problem: &Problem, collection: Collection, members: Vec<u32>) -> ItemScope {
        let form = |s: u32| problem.sections.form.get(s as usize).copied();
        let forms = match collection {
            Collection::Sections => members.iter().filter_map(|&s| form(s)).collect(),
            Collection::Ribs => {
                let ends = members.iter().flat_map(|&r| [&problem.ribs.from, &problem.ribs.to].map(|end| end.get(r as usize)));
                ends.flatten().filter_map(|&s| form(s)).collect()
            }
        };
        ItemScope { collection, members, forms, grouped: false, itself: None }
    }

    /// The scope of every item.
    pub fn all(problem: &Problem, collection: Collection) -> ItemScope {
        ItemScope::of(problem, collection, (0..problem.count(collection)).collect())
    }

    /// True where every section concerned offers this property.
    pub fn offers(&self, property: &str) -> bool {
        !self.forms.is_empty() && self.forms().all(|form| sections::offers(form, property))
    }

    /// True in a dimension's expression for names that could only lead back to it.
    pub fn yields(&self, name: &str) -> bool {
        let given = |&form: &u16| sections::form(form).dimensions.contains(&name);
        self.itself.is_some_and(|itself| itself == name || (self.offers(name) && !self.forms.iter().all(given)))
    }

    /// The name of a kind that does not offer a property some other kind here does.
    pub fn lacking(&self, property: &str) -> Option<&'static str> {
        let some = self.forms().any(|form| sections::offers(form, property));
        self.forms().find(|form| some && !sections::offers(form, property)).map(|form| form.kind)
    }

    /// Names of properties of the first kind, for suggestions.
    pub fn properties(&self) -> impl Iterator<Item = &'static str> {
        self.kinds().next().into_iter().flat_map(|kind| kind.properties().iter().copied())
    }

    fn forms(&self) -> impl Iterator<Item = &'static sections::Form> {
        self.forms.iter().map(|&form| sections::form(form))
    }

    fn kinds(&self) -> impl Iterator<Item = &'static dyn sections::Kind> {
        self.forms.iter().map(|&form| sections::kind_of(form))
    }
}
