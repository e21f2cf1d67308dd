//! What a run leaves, whole or cut short.

use super::*;

#[test]
fn a_solved_problem_exits_with_0_and_leaves_its_files() {
    let folder = folder(RIB);
    let output = ribopt(&folder, "solve rib.toml");
    assert_eq!(code(&output), 0, "{}{}", out(&output), err(&output));
    let results = folder.path().join("results/rib");
    for name in ["result.json", "variables.csv", "constraints.csv", "log-argmin.csv"] {
        assert!(fs::metadata(results.join(name)).unwrap().len() > 0, "{name}");
    }
    assert!(fs::read_dir(&results).unwrap().all(|file| !file.unwrap().path().display().to_string().ends_with("unfinished")));
}

#[test]
fn logs_read_back_bit_for_bit() {
    let folder = folder(RIB);
    assert_eq!(code(&ribopt(&folder, "solve rib.toml")), 0);
    let mut logs = 0;
    for entry in fs::read_dir(folder.path().join("results/rib")).unwrap() {
        let path = entry.unwrap().path();
        if !path.file_name().unwrap().to_string_lossy().starts_with("log-") {
            continue;
        }
        logs += 1;
        let mut reader = csv::Reader::from_path(&path).unwrap();
        let header: Vec<String> = reader.headers().unwrap().iter().map(String::from).collect();
        let columns =
            "iteration,evaluations,objective,feasibility,optimality,step_norm,seconds,attempt,left.b,left.h,right.b,right.h";
        assert_eq!(header.join(","), columns);
        let mut rows = 0;
        for record in reader.records() {
            rows += 1;
            let counts = [0, 1, 7];
            let record = record.unwrap();
            let numbers = record.iter().enumerate().filter(|(at, cell)| !counts.contains(at) && !cell.is_empty());
            for (_, cell) in numbers {
                assert_eq!(format!("{:?}", cell.parse::<f64>().unwrap()), cell);
            }
        }
        assert!(rows > 0, "{}", path.display());
    }
    assert!(logs >= 1);
}

#[test]
fn two_runs_into_one_folder_do_not_mix() {
    let folder = folder(RIB);
    let results = folder.path().join("results/rib");
    fs::create_dir_all(&results).unwrap();
    let lock = File::create(results.join(".lock")).unwrap();
    lock.lock().unwrap();
    let output = ribopt(&folder, "solve rib.toml");
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("another run") && err(&output).contains("--out"), "{}", err(&output));
    drop(lock);
    assert_eq!(code(&ribopt(&folder, "solve rib.toml")), 0);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_stops_with_its_best_point_and_whole_rows() {
    let folder = folder(LONG);
    let arguments = if cfg!(feature = "nlopt") { "solve rib.toml --backend nlopt --algorithm isres --json" } else { return };
    let child = command(folder.path(), arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let log = folder.path().join("results/rib/log-nlopt.csv");
    let rows = || fs::read_to_string(&log).map_or(0, |text| text.lines().count());
    for _ in 0..600 {
        if rows() > 3 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    assert!(rows() > 3, "the log is current while the run goes on");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), json(&output)["status"].as_str()), (5, Some("interrupted")));
    let text = fs::read_to_string(&log).unwrap();
    let cells = text.lines().next().unwrap().split(',').count();
    assert!(text.ends_with('\n') && text.lines().all(|line| line.split(',').count() == cells));
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_panic() {
    let folder = folder(RIB);
    for arguments in ["solve rib.toml", "solve rib.toml --json", "schema", "new", "check rib.toml", "--help"] {
        let mut child = command(folder.path(), arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((code(&output), err(&output)), (0, String::new()), "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let folder = folder(RIB);
    for arguments in ["solve rib.toml", "schema"] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = command(folder.path(), arguments).stdout(full).output().unwrap();
        assert_eq!(code(&output), 2, "{arguments}");
        assert!(err(&output).contains("cannot write to standard output"), "{}", err(&output));
    }
}
