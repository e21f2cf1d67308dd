//! Structures read from files: what the checked declaration holds, and what is only warned of.

use std::fs;

use ribopt::input::{Input, read};
use ribopt::problem::Dimension;
use ribopt::problem::structure::{Action, Axes, Plane, Shear, Structure};

/// Reads a problem file with tables beside it.
fn input(files: &[(&str, &str)]) -> Input {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a writable folder");
    }
    read(&folder.path().join("problem.toml")).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn structure(input: &Input) -> &Structure {
    input.problem.structure.as_deref().expect("a structure")
}

const FRAME: &str = r#"
minimize = "volume"
[structure]
plane = "xz"
gravity = [0, -9.81]
stations = [0, 0.5, 1]
[parameters]
H = 3
[variables]
rise = { lower = 1, upper = 2, start = 1.5 }
[definitions]
top = "H + rise"
[materials]
steel = { E = 210e6, nu = 0.3, density = 7.85, alpha = 1.2e-5, fy = "235e3" }
[nodes]
a = [0, 0]
b = { at = [0, "H"], data = { edge = 1 } }
ridge = [4, "top"]
c = [8, "H"]
d = [8, 0]
[supports]
"?" = ["x"]
a = "fixed"
d = { fix = ["z"], springs = { x = 5e3 } }
b = []
[masses]
ridge = 0.3
[sections.s]
kind = "rectangle"
b = 0.2
h = { lower = 0.1, upper = 1, start = 0.4 }
[[ribs]]
name = "c1"
start = "a"
end = "b"
section = "s"
hinges = { end = ["My"] }
[[ribs]]
name = "r1"
start = "b"
end = "ridge"
section = "s"
offset = { start = [0, 0.1] }
shear = true
[[ribs]]
name = "r2"
start = "ridge"
end = "c"
section = "s"
roll = 90
[[ribs]]
name = "c2"
start = "c"
end = "d"
section = "s"
joints = "rigid"
[[ribs]]
name = "tie"
start = "b"
end = "c"
section = "s"
joints = "pinned"
[[loads]]
case = "dead"
self_weight = true
[[loads]]
case = "snow"
ribs = ["r*", "r1"]
axes = "projected"
force = [0, -8]
force_end = [0, "-2*8"]
from = 0.25
[[loads]]
case = "snow"
nodes = ["ridge"]
force = [1, 2]
moment = 3
[[loads]]
case = "shift"
nodes = ["d"]
displacement = { z = -0.01 }
[[loads]]
case = "warm"
ribs = ["tie"]
temperature = 20
[combinations]
ULS = { dead = 1.35, snow = 1.5 }
"#;

#[test]
fn everything_of_a_structure_is_read() {
    let input = input(&[("problem.toml", FRAME)]);
    let read = structure(&input);
    assert_eq!((read.plane, read.gravity, read.buckling_pieces), (Plane::Xz, [0.0, 0.0, -9.81], 4));
    assert_eq!(read.stations, [0.0, 0.5, 1.0]);
    assert_eq!(read.materials[0].shear, Some(Shear::Poisson(0.3)));
    assert_eq!(read.materials[0].data, [("fy".into(), 235e3)]);
    assert_eq!(read.nodes.position[1], [0.0, 0.0, 3.0].map(Dimension::Constant));
    assert!(matches!(read.nodes.position[2][2], Dimension::Formula(_)), "a definition made of variables");
    let support = |node: u32| read.supports.iter().find(|support| support.node == node).expect("a support");
    assert_eq!(support(0).fixed, [true, false, true, false, true, false], "its own entry, not the pattern's");
    assert_eq!((support(1).fixed, support(3).fixed), ([false; 6], [true, false, false, false, false, false]));
    assert_eq!((support(4).fixed[2], support(4).springs[0]), (true, 5e3));
    assert_eq!(read.masses, [(2, 0.3)]);
    assert!(read.members[0].hinges[1].my && !read.members[0].hinges[0].my && read.members[4].pinned);
    assert_eq!((read.members[1].offset[0], read.members[1].shear), ([0.0, 0.0, 0.1], true));
    assert_eq!(input.problem.ribs.length[1], 4.0f64.hypot(1.5), "where the variables start");
    assert_eq!(read.cases, ["dead", "snow", "shift", "warm"].map(Box::from));
    assert_eq!(read.combinations[0].factors, [(0, 1.35), (1, 1.5)]);
    let snow: Vec<&Action> = read.loads.iter().filter(|load| load.case == 1).map(|load| &load.action).collect();
    let along = |member| Action::Distributed {
        member,
        axes: Axes::Projected,
        force: [0.0, 0.0, -8.0],
        force_end: [0.0, 0.0, -16.0],
        from: 0.25,
        to: 1.0,
    };
    assert_eq!(snow, [&along(1), &along(2), &Action::Nodal { node: 2, force: [1.0, 0.0, 2.0], moment: [0.0, 3.0, 0.0] }]);
}

#[test]
fn tables_say_the_same_as_the_file() {
    let (head, tail) = FRAME.split_once("[nodes]").expect("nodes");
    let (supports, sections) = tail.split_once("[masses]").expect("masses");
    let (sections, ribs) = sections.split_once("[[ribs]]").expect("ribs");
    let loads = &ribs[ribs.find("[[loads]]").expect("loads")..];
    let _ = supports;
    let tables = "[tables]\nnodes = \"n.csv\"\nribs = \"r.csv\"\nsupports = \"s.csv\"\nloads = \"l.csv\"\n";
    let (dead, combinations) = (
        &loads[..loads.find("[[loads]]\ncase = \"snow\"").expect("snow")],
        "[combinations]\nULS = { dead = 1.35, snow = 1.5 }\n",
    );
    let problem = format!("{head}{tables}[masses]{sections}{dead}{combinations}");
    let by_tables = input(&[
        ("problem.toml", &problem),
        ("n.csv", "name,x,z,edge\na,0,0,\nb,0,H,1\nridge,4,top,\nc,8,H,\nd,8,0,\n"),
        (
            "r.csv",
            "name,start,end,section,joints,hinges_end,offset_start_z,shear,roll,line\nc1,a,b,s,,My,,,,l\nr1,b,ridge,s,,,0.1,true,,l\nr2,ridge,c,s,,,,,90,l\nc2,c,d,s,rigid,,,,,\ntie,b,c,s,pinned,,,,,\n",
        ),
        ("s.csv", "node,fix,kx\n?,x,\na,fixed,\nd,z,5e3\nb,,\n"),
        (
            "l.csv",
            "case,node,rib,line,fx,fz,my,axes,temperature\nsnow,,r*,,0,-8,,projected,\nsnow,ridge,,,1,2,3,,\nsnow,,,l,0,-1,,local,\nwarm,,tie,,,,,,20\n",
        ),
    ]);
    let by_file = input(&[("problem.toml", FRAME)]);
    let (tables, file) = (structure(&by_tables), structure(&by_file));
    assert_eq!(tables.members, file.members);
    let support = |read: &Structure, node: u32| read.supports.iter().find(|support| support.node == node).copied();
    assert!((0..5).all(|node| support(tables, node) == support(file, node)));
    assert_eq!(by_tables.problem.ribs.length, by_file.problem.ribs.length);
    let local = tables.loads.iter().filter(|load| matches!(load.action, Action::Distributed { axes: Axes::Local, .. }));
    assert_eq!(local.count(), 3, "the ribs of line l");
}

#[test]
fn what_is_unusual_is_warned_of() {
    let text = r#"
minimize = "volume"
[structure]
gravity = [0, 0, -1]
[materials]
s = { E = 1, nu = 0.3, density = 1 }
[nodes]
a = [0, 0, 0]
b = [0, 0, 4]
b2 = [0, 0, 4]
c = [4, 0, 4]
[supports]
a = "fixed"
[sections.r]
kind = "rectangle"
b = 0.2
h = { lower = 0.1, upper = 1 }
[[ribs]]
name = "column"
start = "a"
end = "b"
section = "r"
[[ribs]]
name = "beam"
start = "b"
end = "c"
section = "r"
[[ribs]]
name = "loose"
length = 3
section = "r"
[[loads]]
case = "dead"
self_weight = true
[[loads]]
case = "never"
nodes = ["c"]
force = [0, 0, -1]
[[constraints]]
name = "sag"
require = "disp(dead, c, z) >= -1"
"#;
    let warnings: Vec<String> = input(&[("problem.toml", text)]).warnings.into_iter().map(|warning| warning.message).collect();
    assert_eq!(
        warnings,
        [
            "node `b2` is used by no rib",
            "nodes `b` and `b2` are at one place",
            "rib `column` is within 3° of vertical without `up`: its section's height points along x, as vertical ribs have it",
            "rib `loose` has no nodes and is no part of the structure",
            "load case `never` is in no combination and no response",
        ]
    );
}

#[test]
fn a_structure_on_which_nothing_acts_is_no_mechanism_and_says_so() {
    let text = r#"
minimize = "mass"
[structure]
plane = "xz"
[materials.s]
E = 2.1e8
density = 77
[nodes]
a = [0, 0]
b = [3, 0]
[supports]
a = "fixed"
[sections.r]
kind = "rectangle"
b = 0.1
h = { lower = 0.1, upper = 0.5, start = 0.2 }
[[ribs]]
name = "m"
start = "a"
end = "b"
section = "r"
[definitions]
own = "mass"
"#;
    let subject = ribopt::run::Subject::of_text("nothing.toml", text).unwrap();
    let found = ribopt::run::analyse::analyse(&subject, None, false).unwrap();
    assert!(found.remarks.iter().any(|remark| remark.contains("nothing acts")), "{:?}", found.remarks);
    assert!((found.definitions[0].1 - 77.0 * 0.1 * 0.2 * 3.0).abs() < 1e-12);
}

#[test]
fn combinations_that_no_response_asks_for_are_warned_of_and_case_is_no_matter_in_suggestions() {
    let text = |node: &str| {
        format!(
            "minimize = \"mass\"\n[structure]\nplane = \"xz\"\n[materials.s]\nE = 2.1e8\ndensity = 77\n[nodes]\na = [0, 0]\nb = [3, 0]\n[supports]\n\
             a = \"fixed\"\n[sections.r]\nkind = \"rectangle\"\nb = 0.1\nh = {{ lower = 0.1, upper = 0.5, start = 0.2 }}\n[[ribs]]\nname = \"m\"\nstart = \"a\"\n\
             end = \"b\"\nsection = \"r\"\n[[loads]]\ncase = \"P\"\nnodes = [\"{node}\"]\nforce = [0, -10]\n[combinations]\nU = {{ P = 1.5 }}\nV = {{ P = 1 }}\n\
             [[constraints]]\nname = \"s\"\nrequire = \"abs(stress(U, m, 0, top)) <= 2e5\"\n"
        )
    };
    let input = ribopt::input::read_text("t.toml", &text("b")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let warnings: Vec<&str> = input.warnings.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(warnings, ["combination `V` is in no response: nothing is limited under it"]);
    let message = ribopt::input::read_text("t.toml", &text("B")).unwrap_err().to_string();
    assert!(message.contains("did you mean `b`?"), "{message}");
}
