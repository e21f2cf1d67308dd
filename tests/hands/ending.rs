//! Every run ends when told.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::place::{BOX, LONG, Place, RIBS, SECTIONS, TWO};

/// Takes every solver seconds, and a check of its derivatives too.
const WIDE: &str =
    "minimize = \"sum(cos(7*x)*sum(x)) + sum(x)^2\"\n[variables]\nx = { size = 1500, lower = -5, upper = 5, start = 2.5 }\n";

#[cfg(unix)]
fn ended_by_one_signal(child: &mut std::process::Child) -> Option<i32> {
    std::thread::sleep(Duration::from_millis(300));
    Command::new("kill").args(["-TERM", &child.id().to_string()]).status().expect("kill");
    let until = Instant::now() + Duration::from_secs(20);
    while Instant::now() < until {
        if let Some(status) = child.try_wait().expect("a child") {
            return status.code();
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().expect("a child");
    None
}

#[cfg(unix)]
#[test]
fn a_blocked_read_ends_at_the_first_signal() {
    let place = Place::new(&[("b.toml", BOX)]);
    Command::new("mkfifo").arg(place.0.path().join("ff")).status().expect("mkfifo");
    for arguments in ["solve ff", "solve -", "solve b.toml --start ff", "verify b.toml ff", "compare ff"] {
        let mut child = place.command(arguments).stdin(Stdio::piped()).stderr(Stdio::null()).spawn().expect("a child");
        assert_eq!(ended_by_one_signal(&mut child), Some(5), "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn commands_that_were_interrupted_say_so() {
    let place = Place::new(&[("long.toml", LONG), ("wide.toml", WIDE)]);
    for arguments in ["compare long.toml", "solve long.toml --starts 100000", "bounds wide.toml", "check wide.toml"] {
        let mut child = place.command(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("a child");
        assert_eq!(ended_by_one_signal(&mut child), Some(5), "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn files_without_end_are_not_read_without_limit() {
    let place = Place::new(&[("b.toml", BOX), ("ov/p.toml", TWO), ("ov/s.csv", SECTIONS), ("ov/r.csv", RIBS)]);
    for name in ["zero.obj", "zero.ply", "zero.off", "zero.stl", "zero.csv", "zero.json", "ov/geometry.csv"] {
        std::os::unix::fs::symlink("/dev/zero", place.0.path().join(name)).expect("a link");
    }
    for arguments in [
        "mesh check zero.obj",
        "mesh check zero.ply",
        "mesh check zero.off",
        "verify b.toml zero.csv",
        "verify b.toml zero.json",
        "solve b.toml --start zero.csv",
        "solve ov/p.toml --solids s.obj",
        "check zero.csv",
    ] {
        let begun = Instant::now();
        let (code, _, err) = place.said(arguments);
        assert!(code == 2 && begun.elapsed() < Duration::from_secs(60), "{arguments}: {code} {err}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn sizes_that_cannot_fit_are_refused_with_the_estimate() {
    let place = Place::new(&[("big.toml", "minimize = \"sum(x)\"\n[variables]\nx = { size = 1e8, lower = 0 }\n")]);
    let limited = format!("ulimit -v 8000000; exec {} check big.toml", env!("CARGO_BIN_EXE_ribopt"));
    let output = Command::new("sh").args(["-c", &limited]).current_dir(place.0.path()).output().expect("sh");
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && err.contains("30.0 GB"), "{err}");
    place.write("big.toml", "minimize = \"sum(x)\"\n[variables]\nx = { size = 1e300, lower = 0 }\n");
    let (code, _, err) = place.said("check big.toml");
    assert!(code == 2 && err.contains("1e300") && err.len() < 1000, "{err}");
}

#[test]
fn tools_that_mutate_and_interrupt_are_there() {
    for tool in ["fuzz/mutate.py", "fuzz/signals.py"] {
        assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join(tool).is_file(), "{tool}");
    }
}
