use std::collections::BTreeSet;

use super::*;
use crate::input::read_text;

#[test]
fn every_kind_has_a_rule_with_its_dimensions() {
    let section = schema()["properties"]["sections"]["additionalProperties"].clone();
    let rules = section["allOf"].as_array().cloned().unwrap_or_default();
    assert_eq!(rules.len(), sections::KINDS.len() + 1, "and the catalogue's");
    assert_eq!(rules[0]["then"]["required"], json!(["kind", "b", "h"]));
    for (kind, form) in sections::forms() {
        let rule = rules.iter().find(|rule| rule["if"]["properties"]["kind"]["const"] == kind.name()).expect("a rule");
        for name in form.dimensions {
            let key = list_name(name).unwrap_or(name);
            assert!(rule["then"]["properties"].get(key).is_some(), "{}: {key}", kind.name());
        }
    }
}

/// Tables of a file with a key that none knows, and where the schema lists the keys of each.
const TABLES: &[(&str, &str)] = &[
    ("QQQQQQQ = 1", "/properties"),
    ("[show]\nQQQQQQQ = 1", "/properties/show/properties"),
    ("[variables]\nx = { QQQQQQQ = 1 }", "/properties/variables/additionalProperties/properties"),
    ("[definitions]\nx = { QQQQQQQ = 1 }", "/properties/definitions/additionalProperties/properties"),
    ("[catalogues]\nc = { QQQQQQQ = 1 }", "/properties/catalogues/additionalProperties/properties"),
    ("[profiles]\np = { QQQQQQQ = 1 }", "/properties/profiles/additionalProperties/properties"),
    ("[[ribs]]\nQQQQQQQ = 1", "/properties/ribs/items/properties"),
    ("[[ribs]]\nhinges = { QQQQQQQ = 1 }", "/properties/ribs/items/properties/hinges/properties"),
    ("[[ribs]]\noffset = { QQQQQQQ = 1 }", "/properties/ribs/items/properties/offset/properties"),
    ("[structure]\nQQQQQQQ = 1", "/properties/structure/properties"),
    ("[nodes]\na = { QQQQQQQ = 1 }", "/properties/nodes/additionalProperties/properties"),
    ("[supports]\na = { QQQQQQQ = 1 }", "/properties/supports/additionalProperties/properties"),
    ("[[loads]]\nQQQQQQQ = 1", "/properties/loads/items/properties"),
    ("[[constraints]]\nQQQQQQQ = 1", "/properties/constraints/items/properties"),
    ("[[checks]]\nQQQQQQQ = 1", "/properties/checks/items/properties"),
    ("[[checks]]\nbuckling = { QQQQQQQ = 1 }", "/properties/checks/items/properties/buckling/properties"),
    ("[[checks]]\nbuckling = { y = { QQQQQQQ = 1 } }", "/properties/checks/items/properties/buckling/properties/y/properties"),
    ("[[checks]]\nltb = { QQQQQQQ = 1 }", "/properties/checks/items/properties/ltb/properties"),
    ("[[checks]]\nCm = { QQQQQQQ = 1 }", "/properties/checks/items/properties/Cm/properties"),
    ("[solver]\nQQQQQQQ = 1", "/properties/solver/properties"),
    ("[solver]\nnlopt = { QQQQQQQ = 1 }", "/properties/solver/properties/nlopt/properties"),
    ("[solver]\nargmin = { QQQQQQQ = 1 }", "/properties/solver/properties/argmin/properties"),
    ("[tables]\nQQQQQQQ = 1", "/properties/tables/properties"),
];

#[test]
fn the_schema_lists_the_keys_the_reader_knows_and_no_others() {
    let schema = schema();
    for (text, place) in TABLES {
        let mistakes = read_text("keys.toml", text).unwrap_err().list;
        let unknown =
            mistakes.iter().find(|mistake| mistake.message == "unknown key `QQQQQQQ`").unwrap_or_else(|| panic!("{text}"));
        let known =
            unknown.help.as_deref().and_then(|help| help.strip_prefix("known here: ")).unwrap_or_else(|| panic!("{text}"));
        let known: BTreeSet<&str> = known.split(", ").collect();
        let listed = schema.pointer(place).and_then(Value::as_object).unwrap_or_else(|| panic!("nothing at {place}"));
        assert_eq!(known, listed.keys().map(String::as_str).collect(), "{text}");
    }
}
