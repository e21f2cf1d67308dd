use super::*;
use crate::mesh::network::RibGeometry;
use crate::mesh::stations::Frame;

fn rib(name: &str, ends: [[f64; 3]; 2], height: f64, z: f64) -> SizedRib {
    let ends = ends.map(Vector::from);
    let frame = Frame { x: (ends[1] - ends[0]).normalize(), y: Vector::y(), z: Vector::new(0.0, 0.0, z) };
    let ring = vec![vec![[-0.05, 0.0], [0.05, 0.0], [0.05, height], [-0.05, height]]];
    SizedRib {
        geometry: RibGeometry { name: name.into(), line: "L1".into(), ends, frame, joints: [0, 1] },
        rings: [ring.clone(), ring],
        tags: Vec::new(),
        utilisation: None,
        model_volume: None,
    }
}

fn two(heights: [f64; 2]) -> Vec<SizedRib> {
    let ends = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.5]];
    vec![rib("a<b", [ends[0], ends[1]], heights[0], 1.0), rib("c", [ends[1], ends[2]], heights[1], -1.0)]
}

fn loads(shares: [f64; 2], limits: [&str; 2]) -> Vec<Load> {
    shares.iter().zip(limits).map(|(share, limit)| Load { share: Some(*share), limit: limit.into() }).collect()
}

fn about() -> About {
    About { title: "Two ribs".into(), units: vec![("length".into(), "m".into())], ..About::default() }
}

#[test]
fn shares_are_shown_where_they_differ_and_above_one() {
    for shares in [[0.3, 0.9], [1.01, 1.01]] {
        let svg = network(&two([0.2, 0.3]), &loads(shares, ["sag", "sag"]), &about());
        assert!(svg.contains("coloured by how far their limits are used") && svg.contains("used 0 to 100 %"), "{svg}");
        assert!(svg.contains("<title>Two ribs</title>") && svg.contains("prefers-color-scheme: dark"));
        assert!(svg.contains("<title>a&lt;b: heights 0.2 m and 0.2 m, area 0.02 m², used"), "{svg}");
        assert!(svg.contains("height 0.3 m") && !svg.contains("NaN") && !svg.contains("inf"));
    }
    let over = network(&two([0.2, 0.3]), &loads([1.01, 1.01], ["sag", "sag"]), &about());
    assert!(over.matches("class=\"over\"").count() == 3, "both ribs, and the legend");
}

#[test]
fn where_all_are_used_alike_what_governs_is_shown_or_the_size() {
    let limits = network(&two([0.2, 0.3]), &loads([1.0, 0.99], ["sag", "bending"]), &about());
    assert!(limits.contains("the limit that governs") && limits.contains(">bending</text>") && limits.contains(">sag</text>"));
    let size = network(&two([0.2, 0.3]), &loads([1.0, 1.0], ["sag", "sag"]), &about());
    assert!(size.contains("section area 0.02 m² to 0.03 m²") && size.contains("all are used alike"), "{size}");
    let same = network(&two([0.2, 0.2]), &loads([1.0, 1.0], ["sag", "sag"]), &about());
    assert!(same.contains("used 0 to 100 %"));
}

#[test]
fn ribs_seen_from_their_inner_side_are_paler_and_that_is_said() {
    let svg = network(&two([0.2, 0.3]), &loads([0.1, 0.9], ["sag", "sag"]), &about());
    assert!(svg.contains("paler: seen from the inner side") && svg.matches("fill-opacity=\"0.3\"").count() == 1, "{svg}");
}

#[test]
fn none_and_one_without_extent_are_pictures_still() {
    for ribs in [vec![], vec![rib("dot", [[1.0, 1.0, 1.0], [2.0, 2.0, 2.0]], f64::NAN, 1.0)]] {
        let svg = network(&ribs, &vec![Load::default(); ribs.len()], &About::default());
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}
