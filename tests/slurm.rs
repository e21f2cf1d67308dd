//! A study on a real Slurm of two nodes on this machine. Skipped, and said so, where its packages are not installed or this is not root.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use tempfile::TempDir;

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/slurm/cluster.sh");

/// A cluster that ends with the test.
struct Cluster(TempDir);

impl Cluster {
    /// `None` where there is no Slurm.
    fn start() -> Option<Cluster> {
        let is_there = |name: &str| ["/usr/sbin", "/usr/bin"].iter().any(|folder| Path::new(folder).join(name).exists());
        if !["slurmctld", "slurmd", "sbatch", "munged"].into_iter().all(is_there) {
            eprintln!("skipped: the packages slurmctld, slurmd, slurm-client and munge are not installed");
            return None;
        }
        let folder = TempDir::new().unwrap();
        let started = Command::new(SCRIPT).arg("start").arg(folder.path()).output().unwrap();
        if !started.status.success() {
            eprintln!("skipped: Slurm does not start here: {}", String::from_utf8_lossy(&started.stderr));
            return None;
        }
        Some(Cluster(folder))
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("SLURM_CONF", self.0.path().join("slurm.conf"));
        command
    }

    fn said(&self, program: &str, arguments: &[&str]) -> String {
        let output = self.command(program).args(arguments).output().unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
    }

    /// Waits until nothing is queued.
    fn empty(&self) {
        let begun = Instant::now();
        while !self.said("squeue", &["--noheader"]).trim().is_empty() {
            assert!(begun.elapsed() < Duration::from_secs(240), "{}", self.said("squeue", &[]));
            std::thread::sleep(Duration::from_millis(200));
        }
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        let _ = Command::new(SCRIPT).arg("stop").arg(self.0.path()).status();
    }
}

const STUDY: &str = r#"
problem = "rib.toml"
[vary]
sag_limit = { from = 0.018, to = 0.045, count = 960 }
[run]
cold_every = 1
"#;

/// Of 16 points each.
const CHAINS: usize = 60;

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::copy("problems/haunched-floor-rib.toml", folder.path().join("rib.toml")).unwrap();
    fs::write(folder.path().join("study.toml"), STUDY).unwrap();
    folder
}

fn sweep(mut command: Command, folder: &Path, arguments: &[&str]) -> Output {
    command.current_dir(folder).args(["sweep", "study.toml", "--out", "out"]).args(arguments).output().unwrap()
}

/// The table without its seconds.
fn table(folder: &Path) -> Vec<String> {
    let mut reader = csv::Reader::from_path(folder.join("out/table.csv")).unwrap();
    let seconds = reader.headers().unwrap().iter().position(|name| name == "seconds").unwrap();
    let line = |record: csv::StringRecord| {
        record.iter().enumerate().filter(|(at, _)| *at != seconds).map(|(_, cell)| cell).collect::<Vec<_>>().join(",")
    };
    reader.records().map(|record| line(record.unwrap())).collect()
}

/// The workers of this study that run now.
fn workers(folder: &Path) -> Vec<String> {
    let out = folder.join("out").display().to_string();
    let mut found = Vec::new();
    for entry in fs::read_dir("/proc").unwrap().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let line = fs::read_to_string(entry.path().join("cmdline")).unwrap_or_default();
        if line.contains(&out)
            && line.contains("--worker")
            && line.split('\0').next().is_some_and(|program| program.ends_with("ribopt"))
        {
            found.push(name);
        }
    }
    found
}

fn finished(folder: &Path) -> usize {
    fs::read_dir(PathBuf::from(folder).join("out/chains")).map_or(0, |entries| {
        entries.filter_map(Result::ok).filter(|entry| !entry.file_name().to_string_lossy().starts_with('.')).count()
    })
}

/// An array of shards; one worker is killed while it works, a node is set down; run again, the merged table is that of one process.
#[test]
fn an_array_with_a_killed_worker_and_a_lost_node_gives_the_same_table() {
    let Some(cluster) = Cluster::start() else { return };
    let program = env!("CARGO_BIN_EXE_ribopt");
    let (reference, study) = (folder(), folder());
    assert!(sweep(Command::new(program), reference.path(), &["-q"]).status.success());
    let submitted = sweep(cluster.command(program), study.path(), &["--slurm", "--shards", "4", "--", "--ntasks=1"]);
    assert!(submitted.status.success(), "{}", String::from_utf8_lossy(&submitted.stderr));
    // While two are at work, one is killed and the other one's node goes.
    let begun = Instant::now();
    loop {
        assert!(begun.elapsed() < Duration::from_secs(60), "{}", cluster.said("squeue", &[]));
        assert!(finished(study.path()) < CHAINS, "the array was over before a worker could be killed");
        let running = if finished(study.path()) < 2 { Vec::new() } else { workers(study.path()) };
        let killed = |process: &String| Command::new("kill").args(["-9", process]).status().unwrap().success();
        if running.first().is_some_and(killed) {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    cluster.said("scontrol", &["update", "nodename=n2", "state=down", "reason=test"]);
    cluster.said("scancel", &["--user", "root"]);
    cluster.empty();
    assert!(finished(study.path()) < CHAINS, "the array was over before its node went");
    cluster.said("scontrol", &["update", "nodename=n2", "state=idle"]);
    let again = sweep(cluster.command(program), study.path(), &["--slurm", "--shards", "4"]);
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
    cluster.empty();
    assert_eq!(finished(study.path()), CHAINS);
    assert_eq!(table(study.path()), table(reference.path()));
}
