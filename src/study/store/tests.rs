use super::*;

fn study(fingerprint: &str) -> Study {
    Study { fingerprint: fingerprint.into(), ..Study::default() }
}

fn rows(point: usize) -> Vec<Row> {
    vec![Row::without_numbers(&Point { number: point, values: vec![Some(0.1 + 0.2)] }, "certified", Some(0), "yes".into())]
}

#[test]
fn chains_come_back_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(&study("a"), folder.path(), false).unwrap();
    assert!(store.rows(3).is_none());
    store.finish(3, rows(7)).unwrap();
    assert_eq!(store.rows(3).unwrap(), rows(7));
    store.undo(3).unwrap();
    assert!(store.rows(3).is_none());
}

#[test]
fn another_study_is_refused_until_it_is_to_begin_anew() {
    let folder = tempfile::tempdir().unwrap();
    Store::open(&study("a"), folder.path(), false).unwrap().finish(0, rows(0)).unwrap();
    assert!(Store::open(&study("a"), folder.path(), false).unwrap().rows(0).is_some());
    assert!(matches!(Store::open(&study("b"), folder.path(), false), Err(StoreError::Other(_))));
    assert!(matches!(Store::existing(&study("b"), folder.path()), Err(StoreError::Other(_))));
    let store = Store::open(&study("b"), folder.path(), true).unwrap();
    assert!(store.rows(0).is_none());
}

#[test]
fn folders_of_others_are_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(Store::existing(&study("a"), folder.path()), Err(StoreError::Missing(_))));
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    for fresh in [false, true] {
        assert!(matches!(Store::open(&study("a"), folder.path(), fresh), Err(StoreError::Foreign(_))));
    }
    assert!(folder.path().join("notes.txt").exists());
}

#[test]
fn a_chain_is_claimed_by_one_and_let_go_of() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) =
        (Store::open(&study("a"), folder.path(), false).unwrap(), Store::open(&study("a"), folder.path(), false).unwrap());
    let claim = one.claim(5).unwrap().unwrap();
    assert!(two.claim(5).unwrap().is_none() && one.claim(5).unwrap().is_none());
    assert_eq!(two.claims(), 1);
    drop(claim);
    assert!(two.claim(5).unwrap().is_some());
}

#[test]
fn a_point_that_ends_two_workers_is_not_begun_again() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(&study("a"), folder.path(), false).unwrap();
    for expected in [true, true, false] {
        let claim = store.claim(5).unwrap().unwrap();
        assert!(claim.begin(8).unwrap());
        assert_eq!(claim.begin(9).unwrap(), expected);
        // A worker that ends without letting go leaves its file, and the system takes its lock away.
        let path = claim.path.clone();
        let text = fs::read(&path).unwrap();
        drop(claim);
        fs::write(&path, text).unwrap();
    }
}

#[test]
fn claims_of_other_machines_are_judged_by_their_age() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(&study("a"), folder.path(), false).unwrap();
    let path = folder.path().join("claims/000002");
    fs::write(&path, "somewhere-else\n4\n").unwrap();
    assert!(store.claim(2).unwrap().is_none());
    let hour_ago = std::time::SystemTime::now() - std::time::Duration::from_secs(3600);
    fs::OpenOptions::new().write(true).open(&path).unwrap().set_modified(hour_ago).unwrap();
    let claim = store.claim(2).unwrap().unwrap();
    assert!(claim.begin(4).unwrap());
    assert_eq!(fs::read_to_string(folder.path().join("deaths/000002")).unwrap(), "4\n");
}

#[test]
fn a_finished_chain_keeps_no_claim_of_a_worker_that_has_ended() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(&study("a"), folder.path(), false).unwrap();
    let claim = store.claim(5).unwrap().unwrap();
    store.finish(5, rows(8)).unwrap();
    store.clear(5).unwrap();
    // Its worker lives.
    assert_eq!(store.claims(), 1);
    let (path, text) = (claim.path.clone(), fs::read(&claim.path).unwrap());
    drop(claim);
    fs::write(&path, text).unwrap();
    store.clear(5).unwrap();
    assert_eq!(store.claims(), 0);
    store.clear(5).unwrap();
}
