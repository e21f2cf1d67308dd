//! Who is at work on a chain. Claims only spare double work: a chain worked on twice gives the same file twice.
//!
//! A claim is a file that is made by one worker alone (`O_EXCL`) and locked while that worker lives. On the same machine the lock tells
//! whether it still does; from another machine the file's age does, which a living worker keeps young.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::{Store, StoreError};

/// How often a worker makes its claims young again.
pub const BEAT: Duration = Duration::from_secs(10);

/// A claim of another machine this old is nobody's: six beats may be late, by busy disks or clocks that differ.
const LEASE: Duration = Duration::from_secs(60);

/// Room for a point's number, so that every write is as long as the one before.
const DIGITS: usize = 20;

/// A chain that this process works on.
#[derive(Debug)]
pub struct Claim<'a> {
    store: &'a Store,
    pub(super) path: PathBuf,
    file: File,
    /// The points at which workers have ended, each as often as that happened.
    deaths: Vec<usize>,
}

impl Store {
    fn claim_file(&self, chain: usize) -> PathBuf {
        self.folder.join(format!("claims/{chain:06}"))
    }

    pub(super) fn death_file(&self, chain: usize) -> PathBuf {
        self.folder.join(format!("deaths/{chain:06}"))
    }

    /// Claims a chain; `None` where somebody else is at work on it.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn claim(&self, chain: usize) -> Result<Option<Claim<'_>>, StoreError> {
        let path = self.claim_file(chain);
        self.taken(chain, &path).map_err(|cause| StoreError::Unwritable { path, cause })
    }

    fn taken(&self, chain: usize, path: &Path) -> io::Result<Option<Claim<'_>>> {
        let made = OpenOptions::new().read(true).write(true).create_new(true).open(path);
        let file = match made {
            Ok(file) => {
                // Where there are no locks, age alone tells.
                let _ = file.try_lock();
                file
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => match self.inherited(chain, path)? {
                Some(file) => file,
                None => return Ok(None),
            },
            Err(error) => return Err(error),
        };
        let claim = Claim { store: self, path: path.into(), file, deaths: self.deaths(chain) };
        self.held.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).insert(path.into());
        claim.write("")?;
        Ok(Some(claim))
    }

    /// The claim of a worker that has ended without letting go of it; where it ended is noted.
    fn inherited(&self, chain: usize, path: &Path) -> io::Result<Option<File>> {
        let Some((file, point)) = self.abandoned(path)? else { return Ok(None) };
        if let Some(point) = point {
            let mut deaths = OpenOptions::new().create(true).append(true).open(self.death_file(chain))?;
            deaths.write_all(format!("{point}\n").as_bytes())?;
        }
        Ok(Some(file))
    }

    /// A claim whose worker has ended, and the point it was at.
    fn abandoned(&self, path: &Path) -> io::Result<Option<(File, Option<usize>)>> {
        let mut file = match OpenOptions::new().read(true).write(true).open(path) {
            Ok(file) => file,
            // Let go of just now: the next round claims it.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error),
        };
        let mut text = String::new();
        file.read_to_string(&mut text)?;
        let mut lines = text.lines();
        let is_ours = lines.next() == Some(&self.host);
        let is_left = if is_ours { file.try_lock().is_ok() } else { is_old(&file)? };
        let point = lines.next().and_then(|point| point.trim_end().parse().ok());
        Ok(is_left.then_some((file, point)))
    }

    /// Takes away the claim of a worker that ended between finishing its chain and letting go of it.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn clear(&self, chain: usize) -> Result<(), StoreError> {
        let path = self.claim_file(chain);
        match self.abandoned(&path) {
            Ok(Some(_)) => {
                // Where somebody else took it away meanwhile, it is gone all the same.
                let _ = fs::remove_file(&path);
                Ok(())
            }
            Ok(None) => Ok(()),
            Err(cause) => Err(StoreError::Unwritable { path, cause }),
        }
    }

    fn deaths(&self, chain: usize) -> Vec<usize> {
        let text = fs::read_to_string(self.death_file(chain)).unwrap_or_default();
        text.lines().filter_map(|line| line.parse().ok()).collect()
    }

    /// Makes all claims of this process young again.
    pub fn beat(&self) {
        for path in self.held.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).iter() {
            // A claim that cannot be touched is thought dead by others: work is done twice, and nothing worse.
            let _ = OpenOptions::new().write(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
        }
    }

    /// How many chains somebody has claimed.
    pub fn claims(&self) -> usize {
        fs::read_dir(self.folder.join("claims")).map_or(0, Iterator::count)
    }
}

fn is_old(file: &File) -> io::Result<bool> {
    let age = file.metadata()?.modified()?.elapsed();
    // A file from the future is a clock that differs, not a dead worker.
    Ok(age.is_ok_and(|age| age > LEASE))
}

impl Claim<'_> {
    /// Notes that a point begins; `false` where two workers have ended at it.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn begin(&self, point: usize) -> Result<bool, StoreError> {
        if self.deaths.iter().filter(|&&death| death == point).count() >= 2 {
            return Ok(false);
        }
        self.write(&point.to_string()).map_err(|cause| StoreError::Unwritable { path: self.path.clone(), cause })?;
        Ok(true)
    }

    /// Over what was there, in one write: a worker that is killed leaves the one or the other, and never a claim of nobody.
    fn write(&self, point: &str) -> io::Result<()> {
        let mut file = &self.file;
        file.rewind()?;
        file.write_all(format!("{}\n{point:<DIGITS$}\n", self.store.host).as_bytes())
    }
}

impl Drop for Claim<'_> {
    fn drop(&mut self) {
        self.store.held.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).remove(&self.path);
        // Gone already, or thought dead by the others in a minute.
        let _ = fs::remove_file(&self.path);
    }
}
