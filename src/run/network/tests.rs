use super::*;

/// Two sections of every kind, different in size, and a rib of 2 m between them; `k` makes the ends differ.
const KINDS: &[(&str, &str)] = &[
    ("rectangle", "b = 0.1\nh = { lower = 0.2, upper = 0.9, start = K }"),
    ("h-beam", "tw = 0.01\nhw = { lower = 0.2, upper = 0.9, start = K }\nb = 0.15\ntf = 0.02"),
    ("tee", "tw = 0.02\nhw = { lower = 0.2, upper = 0.9, start = K }\nb = 0.15\ntf = 0.03"),
    ("box", "b = 0.15\nh = { lower = 0.2, upper = 0.9, start = K }\ntw = 0.01\ntf = 0.02"),
    ("circle", "d = { lower = 0.2, upper = 0.9, start = K }"),
    ("tube", "d = { lower = 0.2, upper = 0.9, start = K }\nt = 0.01"),
    ("superellipse", "a = 0.1\nb = { lower = 0.2, upper = 0.9, start = K }\nr = 2.5"),
    (
        "polygon",
        "points = [[0, 0], [0.06, 0], [0.06, 0.01], [0.01, 0.01], [0.01, 0.1], [0, 0.1]]\nscale_x = 2\nscale_y = { lower = 0.2, upper = 0.9, start = K }",
    ),
    (
        "polyline",
        "points = [[0.1, 0], [0, 0], [0, 0.2], [0.1, 0.2]]\nthickness = [0.02, { lower = 0.002, upper = 0.9, start = K/20 }, 0.01]",
    ),
];

fn text(kind: &str, dimensions: &str) -> String {
    let section = |name: &str, k: &str| {
        let shape = dimensions.replace("K/20", if k == "0.3" { "0.015" } else { "0.02" }).replace('K', k);
        format!("[sections.{name}]\nkind = \"{kind}\"\n{shape}\n")
    };
    format!(
        "{}{}[[ribs]]\nname = \"only\"\nfrom = \"left\"\nto = \"right\"\nlength = 2.0\nvolume = \"prismatoid\"\n\
         [[constraints]]\nname = \"tall\"\nfor = \"sections\"\nrequire = \"height <= 2\"\n",
        section("left", "0.3"),
        section("right", "0.4")
    )
}

const HEADER: &str = "rib,line,x0,y0,z0,x1,y1,z1,nx,ny,nz,joint0,joint1\n";
const PLACE: &str = "only,L1,0,0,0,0,2,0,0,0,1,0,1\n";

fn subject(problem: &str, geometry: &str) -> (tempfile::TempDir, PathBuf, Subject) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("problem.toml");
    std::fs::write(&file, problem).unwrap();
    std::fs::write(folder.path().join(GEOMETRY), geometry).unwrap();
    let subject = Subject::read(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    (folder, file, subject)
}

#[test]
fn solids_of_every_kind_have_the_models_volume() {
    for (kind, dimensions) in KINDS {
        let (folder, file, subject) = subject(&text(kind, dimensions), &format!("{HEADER}{PLACE}"));
        let network = Network::beside(&file, subject.problem()).unwrap();
        let sized = network.sized(&subject, &subject.model().meta().start).unwrap_or_else(|error| panic!("{kind}: {error}"));
        for ending in ["obj", "stl", "vtu"] {
            let report = sized.write_solids(&folder.path().join(format!("solids.{ending}"))).unwrap();
            let most = report.largest_model_difference.unwrap();
            assert!(most < 1e-12 && report.largest_difference < 1e-12, "{kind}: {report:?}");
        }
    }
}

#[test]
fn a_superellipse_of_changing_exponent_is_near_the_model() {
    let problem =
        text("superellipse", "a = 0.1\nb = 0.2\nr = { lower = 0.1, upper = 9, start = K }").replace("start = 0.", "start = 2.");
    let (folder, file, subject) = subject(&problem, &format!("{HEADER}{PLACE}"));
    let sized = Network::beside(&file, subject.problem()).unwrap().sized(&subject, &subject.model().meta().start).unwrap();
    let report = sized.write_solids(&folder.path().join("solids.obj")).unwrap();
    assert!(report.largest_model_difference.unwrap() < 1e-3, "{report:?}");
}

#[test]
fn utilisation_and_dimensions_are_those_at_the_point() {
    let (_folder, file, subject) = subject(&text(KINDS[0].0, KINDS[0].1), &format!("{HEADER}{PLACE}"));
    let sized = Network::beside(&file, subject.problem()).unwrap().sized(&subject, &[0.5, 0.8]).unwrap();
    assert_eq!(sized.ribs[0].utilisation, Some(0.4));
    assert_eq!(sized.tag_names, ["from.b", "to.b", "from.h", "to.h", "length", "volume"]);
    assert_eq!(sized.ribs[0].tags[..5], [0.1, 0.1, 0.5, 0.8, 2.0]);
    assert!((sized.ribs[0].tags[5] - 0.13).abs() < 1e-15);
}

#[test]
fn tables_that_do_not_fit_say_what_and_where() {
    let message = |geometry: &str| {
        let (_folder, file, subject) = subject(&text(KINDS[0].0, KINDS[0].1), geometry);
        Network::beside(&file, subject.problem()).unwrap_err().to_string()
    };
    assert!(message(HEADER).contains("does not place rib 'only'"), "{}", message(HEADER));
    assert!(message(&format!("{HEADER}{PLACE}{PLACE}")).contains("more than once"));
    assert!(message(&format!("{HEADER}only,L1,0,0,0,0,3,0,0,0,1,0,1\n")).contains("is 2 long in the problem, but"));
    assert!(message(&format!("{HEADER}only,L1,0,0,0,0,x,0,0,0,1,0,1\n")).contains("row 1: 'y1' is no number"));
}

#[test]
fn a_point_without_a_section_names_it() {
    let (_folder, file, subject) = subject(&text(KINDS[0].0, KINDS[0].1), &format!("{HEADER}{PLACE}"));
    let failure = Network::beside(&file, subject.problem()).unwrap().sized(&subject, &[0.0, 0.8]).unwrap_err();
    assert!(failure.to_string().starts_with("section 'left' has no outline"), "{failure}");
}
