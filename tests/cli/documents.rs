//! What is handed on: the page about a run, completions, manual pages.

use std::fs;

use super::{RIB, code, err, folder, out, ribopt};

#[test]
fn a_run_leaves_a_page_and_the_page_can_be_made_later() {
    let folder = folder(RIB);
    let solved = ribopt(&folder, "solve rib.toml --report");
    assert_eq!((code(&solved), err(&solved)), (0, String::new()));
    assert!(out(&solved).contains("report: results/rib/report.html"));
    let page = fs::read_to_string(folder.path().join("results/rib/report.html")).unwrap();
    for part in ["<h1>One rib</h1>", "certified, global", "What governs", "data:image/svg+xml", "SHA-256", "left.Ix &gt;= 1e-4"] {
        assert!(page.contains(part), "{part} is missing");
    }
    assert!(!page.contains("src=\"http") && !page.contains("<link") && !page.contains("have changed since"));
    let again = ribopt(&folder, "report results/rib -o later.html");
    assert_eq!((code(&again), err(&again)), (0, String::new()));
    assert_eq!(fs::read_to_string(folder.path().join("later.html")).unwrap(), page);
}

#[test]
fn a_page_says_where_its_input_has_changed() {
    let folder = folder(RIB);
    assert_eq!(code(&ribopt(&folder, "solve rib.toml --quiet")), 0);
    fs::write(folder.path().join("rib.toml"), RIB.replace("1e-4", "2e-4")).unwrap();
    assert_eq!(code(&ribopt(&folder, "report results/rib/result.json")), 0);
    let page = fs::read_to_string(folder.path().join("results/rib/report.html")).unwrap();
    assert!(page.contains("they have changed since"));
}

#[test]
fn a_page_needs_a_run_and_spares_what_it_reads() {
    let folder = folder(RIB);
    let nothing = ribopt(&folder, "report .");
    assert_eq!(code(&nothing), 2);
    assert!(err(&nothing).contains("give the folder of a run"), "{}", err(&nothing));
    assert_eq!(code(&ribopt(&folder, "solve rib.toml --quiet")), 0);
    for input in ["rib.toml", "results/rib/result.json"] {
        let before = fs::read(folder.path().join(input)).unwrap();
        assert_eq!(code(&ribopt(&folder, &format!("report results/rib -o {input}"))), 2, "{input}");
        assert_eq!(fs::read(folder.path().join(input)).unwrap(), before, "{input}");
    }
}

#[test]
fn shells_and_manuals_know_the_commands() {
    let folder = folder(RIB);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let completions = ribopt(&folder, &format!("completions {shell}"));
        assert_eq!(code(&completions), 0, "{shell}");
        assert!(out(&completions).contains("optimality-tolerance"), "{shell}");
    }
    assert_eq!(code(&ribopt(&folder, "man pages")), 0);
    for page in ["ribopt.1", "ribopt-solve.1", "ribopt-mesh-ribs.1"] {
        assert!(fs::read_to_string(folder.path().join("pages").join(page)).unwrap().contains(".TH"), "{page}");
    }
}

#[test]
fn the_version_names_the_features() {
    let version = out(&ribopt(&folder(RIB), "--version"));
    assert_eq!(version.contains("features: nlopt"), cfg!(feature = "nlopt"), "{version}");
    assert_eq!(out(&ribopt(&folder(RIB), "-V")).trim(), concat!("ribopt ", env!("CARGO_PKG_VERSION")));
}

#[test]
fn units_of_a_file_are_told() {
    let measured = RIB
        .replace("length = 3.0", "length = \"3 m\"")
        .replace("units = { length = \"m\" }", "units = { length = \"m\", force = \"kN\" }\n[parameters]\nE = \"210 GPa\"");
    let told = ribopt(&folder(&measured), "check rib.toml --units");
    assert_eq!((code(&told), err(&told)), (0, String::new()));
    let line = out(&told).lines().nth(1).map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    assert_eq!(line.as_deref(), Some("E force/length² 210 GPa"), "{}", out(&told));
}

#[test]
fn help_lists_every_example() {
    let help = out(&ribopt(&folder(RIB), "new --help"));
    let listed = |name: &str| help.split([' ', ',', '\n']).any(|word| word == name);
    for name in ::ribopt::input::examples() {
        assert!(listed(name), "{name}");
    }
}
