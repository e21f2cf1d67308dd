//! What a form offers, in numbers: the formulas of all its properties are built once and evaluated for many sections.

use std::sync::{LazyLock, OnceLock};

use super::{Form, Given, Kind, form_number, forms, kind, kind_of};
use crate::expression::display::plain;
use crate::expression::graph::{Graph, NodeId};
use crate::geometry::polygon::Ring;

/// The properties of sections that are given in one form and drawn by the same points.
struct Properties {
    graph: Graph,
    nodes: Vec<(&'static str, NodeId)>,
}

impl Properties {
    fn new(kind: &dyn Kind, form: &'static Form, outline: &[Ring]) -> Properties {
        let mut properties = Properties { graph: Graph::new(), nodes: Vec::new() };
        for name in kind.properties() {
            if let Some(node) = properties.add(kind, form, outline, name) {
                properties.nodes.push((name, node));
            }
        }
        properties
    }

    fn add(&mut self, kind: &dyn Kind, form: &'static Form, outline: &[Ring], name: &str) -> Option<NodeId> {
        let dimensions: Vec<NodeId> = (0..form.dimensions.len() as u32).map(|slot| self.graph.input(slot)).collect();
        kind.property(&mut self.graph, &Given { form, dimensions: &dimensions, outline }, name)
    }

    /// Those of a form without points: made when they are first asked for.
    fn known(form: &Form) -> Option<&'static Properties> {
        static TABLE: LazyLock<Vec<OnceLock<Properties>>> = LazyLock::new(|| forms().map(|_| OnceLock::new()).collect());
        let number = form_number(form)?;
        let (kind, form) = (kind_of(number), super::form(number));
        Some(TABLE.get(usize::from(number))?.get_or_init(|| Properties::new(kind, form, &[])))
    }

    fn node(&self, name: &str) -> Option<NodeId> {
        self.nodes.iter().find(|(known, _)| *known == name).map(|(_, node)| *node)
    }
}

/// The value of a property at numeric dimensions, in the form's order; `None` for a name the kind does not offer.
///
/// ```
/// use ribopt::sections::{evaluate, kind};
/// let tube = kind("tube").unwrap();
/// let area = evaluate(tube, &tube.forms()[0], &[0.2, 0.01], &[], "A").unwrap();
/// assert!((area - std::f64::consts::PI * 0.01 * 0.19).abs() < 1e-17);
/// ```
pub fn evaluate(kind: &dyn Kind, form: &Form, given: &[f64], outline: &[Ring], name: &str) -> Option<f64> {
    let form = known_form(kind, form, given)?;
    let known = if kind.has_outline() { None } else { Properties::known(form) };
    if let Some((properties, node)) = known.and_then(|properties| Some((properties, properties.node(name)?))) {
        return Some(properties.graph.evaluate(node, given, &[]));
    }
    // Drawn by points of its own, or a name that kinds keep to themselves.
    let mut own = Properties { graph: Graph::new(), nodes: Vec::new() };
    let node = own.add(kind, form, outline, name)?;
    Some(own.graph.evaluate(node, given, &[]))
}

/// Names and values of all that sections given in this form offer.
///
/// ```
/// use ribopt::sections::{kind, values};
/// let rectangle = kind("rectangle").unwrap();
/// let all = values(rectangle, &rectangle.forms()[0], &[0.2, 0.5], &[]);
/// assert!(all.contains(&("A", 0.1)));
/// ```
pub fn values(kind: &dyn Kind, form: &Form, given: &[f64], outline: &[Ring]) -> Vec<(&'static str, f64)> {
    let Some(form) = known_form(kind, form, given) else { return Vec::new() };
    let of = |properties: &Properties| {
        let values = properties.graph.values(given, &[]);
        properties.nodes.iter().map(|&(name, node)| (name, values[node as usize])).collect()
    };
    if kind.has_outline() {
        return of(&Properties::new(kind, form, outline));
    }
    Properties::known(form).map(of).unwrap_or_default()
}

/// The kind's own form with as many dimensions as are given.
fn known_form(kind: &dyn Kind, form: &Form, given: &[f64]) -> Option<&'static Form> {
    kind.forms().iter().find(|known| *known == form).filter(|form| form.dimensions.len() == given.len())
}

/// Does a section given in this form offer this name? A kind's other dimensions need not follow from those of the form: a polygon with
/// `scale_x` and `scale_y` has no `scale`.
///
/// ```
/// use ribopt::sections::{kind, offers};
/// let polygon = kind("polygon").unwrap();
/// assert!(offers(&polygon.forms()[0], "Ix") && !offers(&polygon.forms()[0], "tw"));
/// ```
pub fn offers(form: &Form, name: &str) -> bool {
    if form.dimensions.contains(&name) {
        return true;
    }
    let Some(kind) = kind(form.kind).filter(|kind| kind.properties().contains(&name)) else { return false };
    // What follows from any of the forms follows from each, where a form says the whole shape.
    if kind.has_rings() && !kind.forms().iter().any(|other| other.dimensions.contains(&name)) {
        return true;
    }
    Properties::known(form).is_some_and(|properties| properties.node(name).is_some())
}

/// The first dimension, given or named by [`Kind::positive`], that is not positive and finite.
pub(super) fn not_positive(name: &str, form: &Form, given: &[f64], outline: &[Ring]) -> Option<String> {
    let kind = kind(name)?;
    let derived = kind.positive().iter().filter_map(|name| Some((*name, evaluate(kind, form, given, outline, name)?)));
    let mut all = form.dimensions.iter().copied().zip(given.iter().copied()).chain(derived);
    let (name, value) = all.find(|(_, value)| !(*value > 0.0 && value.is_finite()))?;
    Some(format!("{name} is {}; it must be positive", plain(value)))
}
