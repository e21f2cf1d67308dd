//! What an earlier run left in a folder: the head of its `result.json`, however long its lists are.

use std::fmt;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, Visitor};

/// Whose answer it is, and what it is worth.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Earlier {
    /// The problem file.
    pub file: String,
    /// Of the file and its tables.
    pub sha256: String,
    /// Whether it was certified.
    pub certified: bool,
}

/// Reads the head of a result; `None` where there is none.
pub fn read(path: &Path) -> Option<Earlier> {
    let file = File::open(path).ok().filter(|file| file.metadata().is_ok_and(|metadata| metadata.is_file()))?;
    let mut head = Head::default();
    // The reading ends, as an error, where the head does.
    let _ = head.deserialize(&mut serde_json::Deserializer::from_reader(BufReader::new(file)));
    let Problem { file, sha256 } = head.problem?;
    Some(Earlier { file, sha256, certified: head.status? == "certified" })
}

#[derive(Default)]
struct Head {
    problem: Option<Problem>,
    status: Option<String>,
}

#[derive(Deserialize)]
struct Problem {
    file: String,
    sha256: String,
}

impl<'de> DeserializeSeed<'de> for &mut Head {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for &mut Head {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a result")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "problem" => self.problem = Some(map.next_value()?),
                "status" => self.status = Some(map.next_value()?),
                _ => _ = map.next_value::<IgnoredAny>()?,
            }
            if self.problem.is_some() && self.status.is_some() {
                break;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Option<Earlier> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        read(file.path())
    }

    #[test]
    fn the_head_is_enough() {
        let head = "{\"format\": \"ribopt-result/1\", \"problem\": {\"title\": \"t\", \"file\": \"a.toml\", \"sha256\": \"00\"}, \"status\": ";
        let earlier = of(&format!("{head}\"certified\", and this is no JSON")).unwrap();
        assert_eq!(earlier, Earlier { file: "a.toml".into(), sha256: "00".into(), certified: true });
        assert!(!of(&format!("{head}\"interrupted\"}}")).unwrap().certified);
    }

    #[test]
    fn anything_else_is_none() {
        assert_eq!((of(""), of("{}"), of("[1]"), read(Path::new("/dev/zero"))), (None, None, None, None));
    }
}
