//! Limits of width over thickness, as rows linear in the dimensions.

use super::aisc360::Made;

/// What stresses a web is taken to carry.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::input) enum Web {
    Bending,
    Compression,
}

/// EN 1993-1-1:2005, Table 5.2: a name and a requirement per part of the section; `None` for a kind that it is not known for here.
/// Internal parts c/t ≤ 72, 83, 124·ε in bending and 33, 38, 42·ε in compression, outstands 9, 10, 14·ε, tubes d/t ≤ 50, 70, 90·ε².
///
/// Outstands and webs end at the root radius, where one is given (welds are not taken off).
pub(in crate::input) fn table_5_2(kind: &str, class: u8, epsilon: f64, web: Web) -> Option<Vec<(&'static str, String)>> {
    let of = |limits: [f64; 3]| limits[usize::from(class).clamp(1, 3) - 1];
    let (outstand, compressed) = (of([9.0, 10.0, 14.0]) * epsilon, of([33.0, 38.0, 42.0]) * epsilon);
    let web = if web == Web::Bending { of([72.0, 83.0, 124.0]) * epsilon } else { compressed };
    Some(match kind {
        "h-beam" => vec![("flange", format!("b - tw - 2*r <= {}*tf", 2.0 * outstand)), ("web", format!("hw - 2*r <= {web}*tw"))],
        "box" => vec![("flange", format!("b - 2*tw <= {compressed}*tf")), ("web", format!("h - 2*tf <= {web}*tw"))],
        "tee" => vec![("flange", format!("b - tw <= {}*tf", 2.0 * outstand)), ("web", format!("hw <= {outstand}*tw"))],
        "tube" => vec![("wall", format!("d <= {}*t", of([50.0, 70.0, 90.0]) * epsilon * epsilon))],
        "circle" | "rectangle" => Vec::new(),
        _ => return None,
    })
}

/// AISC 360-22, Table B4.1a: no slender elements. Flanges of rolled I b/2tf ≤ 0.56·√(E/Fy), of built-up ones 0.64·√(k_c·E/Fy), here with the
/// least k_c = 0.35; webs 1.49·√(E/Fy); walls of boxes 1.40·√(E/Fy), of round tubes 0.11·E/Fy. `ratio` is E/Fy.
pub(in crate::input) fn nonslender(kind: &str, ratio: f64, made: Made) -> Option<Vec<(&'static str, String)>> {
    let root = ratio.sqrt();
    let flange = if made == Made::Rolled { 0.56 * root } else { 0.64 * (0.35 * ratio).sqrt() };
    Some(match kind {
        "h-beam" => vec![("flange", format!("b <= {}*tf", 2.0 * flange)), ("web", format!("hw - 2*r <= {}*tw", 1.49 * root))],
        "box" => {
            vec![("flange", format!("b - 2*tw <= {}*tf", 1.4 * root)), ("web", format!("h - 2*tf <= {}*tw", 1.4 * root))]
        }
        "tube" => vec![("wall", format!("d <= {}*t", 0.11 * ratio))],
        "circle" | "rectangle" => Vec::new(),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn class_3_of_s355_in_an_h() {
        let epsilon = (235.0f64 / 355.0).sqrt();
        let rows = table_5_2("h-beam", 3, epsilon, Web::Bending).unwrap();
        // 28·0.81362 and 124·0.81362.
        assert!(rows[0].1.starts_with("b - tw - 2*r <= 22.78") && rows[1].1.starts_with("hw - 2*r <= 100.8"), "{rows:?}");
        assert_eq!(table_5_2("polygon", 3, epsilon, Web::Bending), None);
    }
}
