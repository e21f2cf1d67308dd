//! Several workers, workers that are killed, folders that are not the study's own.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use tempfile::TempDir;

use crate::{RIB, STUDY, command, folder, said, sweep, table, without_seconds};

#[test]
fn any_number_of_workers_leaves_the_same_table() {
    let reference = folder(STUDY);
    assert!(sweep(reference.path(), &["--jobs", "1", "-q"]).status.success());
    let shared = folder(STUDY);
    let outputs = ["1/3", "2/3", "3/3"].map(|share| sweep(shared.path(), &["--shard", share]));
    assert!(outputs.iter().all(|output| output.status.success()));
    assert!(!shared.path().join("out/table.csv").exists());
    assert!(sweep(shared.path(), &["--merge"]).status.success());
    assert_eq!(without_seconds(shared.path()), without_seconds(reference.path()));
    // Two at once on everything.
    let both = folder(STUDY);
    let begun: Vec<Child> = (0..2).map(|_| command(both.path(), &["--worker"]).stdout(Stdio::null()).spawn().unwrap()).collect();
    begun.into_iter().for_each(|mut child| assert!(child.wait().unwrap().success()));
    assert!(sweep(both.path(), &["--merge"]).status.success());
    assert_eq!(without_seconds(both.path()), without_seconds(reference.path()));
}

/// A study of a nonlinear problem that takes some seconds.
fn long_study() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::copy("problems/haunched-floor-rib.toml", folder.path().join("rib.toml")).unwrap();
    let study = r#"
problem = "rib.toml"
[vary]
sag_limit = { from = 0.018, to = 0.045, count = 160 }
[run]
cold_every = 1
"#;
    fs::write(folder.path().join("study.toml"), study).unwrap();
    folder
}

#[test]
fn a_killed_study_goes_on_where_it_was() {
    let reference = long_study();
    assert!(sweep(reference.path(), &["-q"]).status.success());
    let folder = long_study();
    for _ in 0..3 {
        let mut child = command(folder.path(), &["--jobs", "2"]).stdout(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(700));
        // SIGKILL.
        let _ = child.kill();
        child.wait().unwrap();
    }
    let output = sweep(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(without_seconds(folder.path()), without_seconds(reference.path()));
    let left = |name: &str| fs::read_dir(folder.path().join("out").join(name)).unwrap().count();
    assert_eq!(left("claims"), 0);
}

#[test]
fn a_study_that_was_changed_is_not_mixed_with_what_it_was() {
    let folder = folder(STUDY);
    assert!(sweep(folder.path(), &["-q"]).status.success());
    fs::write(folder.path().join("study.toml"), STUDY.replace("count = 9", "count = 5")).unwrap();
    for arguments in [&[][..], &["--merge"], &["--status"]] {
        let output = sweep(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2));
        assert!(said(&output).contains("--fresh"), "{}", said(&output));
    }
    let output = sweep(folder.path(), &["--fresh"]);
    assert!(output.status.success() && table(folder.path()).len() == 10, "{}", said(&output));
    fs::write(folder.path().join("rib.toml"), RIB.replace("8e3", "9e3")).unwrap();
    assert_eq!(sweep(folder.path(), &[]).status.code(), Some(2));
}

/// A disk of a few kilobytes; mounting one takes rights that not every machine gives.
#[test]
fn a_full_disk_loses_nothing_that_was_finished() {
    let folder = long_study();
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", "size=40k", "tmpfs"]).arg(&out).output();
    if !mounted.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: no small disk can be mounted here");
        return;
    }
    let full = sweep(folder.path(), &[]);
    let bigger = Command::new("mount").args(["-o", "remount,size=16m"]).arg(&out).status().unwrap().success();
    let finished = fs::read_dir(out.join("chains")).unwrap().count();
    let again = sweep(folder.path(), &[]);
    let rows = without_seconds(folder.path());
    let _ = Command::new("umount").arg(&out).status();
    assert!(full.status.code() == Some(2) && said(&full).contains("goes on from there"), "{}", said(&full));
    assert!(bigger && finished > 0 && finished < 10, "{finished} chains");
    assert_eq!(again.status.code(), Some(0), "{}", said(&again));
    assert_eq!(rows.len(), 160);
}

#[test]
fn folders_of_others_are_left_alone() {
    let own = folder(STUDY);
    fs::create_dir(own.path().join("out")).unwrap();
    fs::write(own.path().join("out/notes.txt"), "mine").unwrap();
    let output = sweep(own.path(), &[]);
    assert!(output.status.code() == Some(2) && said(&output).contains("not empty"), "{}", said(&output));
    let output = sweep(folder(STUDY).path(), &["--merge"]);
    assert!(output.status.code() == Some(2) && said(&output).contains("nothing has been begun"), "{}", said(&output));
}
