//! What tables and finite elements say.

use super::*;

#[test]
fn warping_and_the_weaker_axis_as_in_tables() {
    let of = |kind_name: &str, given: &[f64], name: &str| {
        let kind = kind(kind_name).unwrap();
        evaluate(kind, &kind.forms()[0], given, &[], name).unwrap()
    };
    // HEA 200 without its fillets; tables (EN 10365) give Iw = 108 000 cm⁶ and Wpl,y = 429.5 cm³ with them.
    let hea = [0.65, 17.0, 20.0, 1.0];
    assert!((of("h-beam", &hea, "Iw") / 108_000.0 - 1.0).abs() < 0.01);
    assert!((of("h-beam", &hea, "Wplx") / 429.5 - 1.0).abs() < 0.06);
    // Equal flanges make the I the H.
    let i = [0.65, 17.0, 20.0, 1.0, 20.0, 1.0];
    for name in ["Iw", "Ix", "Iy", "J", "perimeter", "Wx", "Wplx", "Wply"] {
        assert!((of("i-section", &i, name) / of("h-beam", &hea, name) - 1.0).abs() < 1e-12, "{name}");
    }
    // L 100 × 100 × 10 without its fillets; tables (EN 10056) give i_v = 1.95 cm with them.
    assert!((of("angle", &[10.0, 10.0, 1.0], "imin") / 1.95 - 1.0).abs() < 0.01);
    // U 200 with parallel flanges (UPE 200), without its fillets; tables give Iw = 11 900 cm⁶.
    assert!((of("channel", &[0.6, 17.8, 8.0, 1.1], "Iw") / 11_900.0 - 1.0).abs() < 0.05);
}

/// Torsion constants and shear areas by finite elements, see tests/data/make_sections.py.
#[derive(serde::Deserialize)]
struct Reference {
    kinds: Vec<FiniteElements>,
}

#[derive(serde::Deserialize)]
struct FiniteElements {
    kind: String,
    given: Vec<f64>,
    torsion: f64,
    /// Along x and along y, Poisson's ratio 0.
    shear_areas: [f64; 2],
}

#[test]
fn torsion_and_shear_as_accurate_as_documented() {
    let reference: Reference = serde_json::from_str(include_str!("../../../tests/data/sections.json")).unwrap();
    // Relative errors of J, Asx, Asy that the kinds' docs state, with the finite elements' own.
    let stated = |kind: &str| match kind {
        "rectangle" => [0.011, 1e-4, 1e-4],
        "h-beam" => [0.04, 0.04, 0.05],
        "tee" => [0.06, 0.05, 0.085],
        "box" => [0.1, 0.19, 0.19],
        "circle" | "tube" => [2e-3, 5e-3, 5e-3],
        _ => [0.082, 0.0, 0.0],
    };
    for case in reference.kinds {
        let kind = kind(&case.kind).unwrap();
        let theirs = [case.torsion, case.shear_areas[0], case.shear_areas[1]];
        for ((name, theirs), stated) in ["J", "Asx", "Asy"].into_iter().zip(theirs).zip(stated(&case.kind)) {
            let Some(ours) = evaluate(kind, &kind.forms()[0], &case.given, &[], name) else { continue };
            assert!((ours / theirs - 1.0).abs() <= stated, "{} {:?} {name}: {ours} {theirs}", case.kind, case.given);
        }
    }
}
